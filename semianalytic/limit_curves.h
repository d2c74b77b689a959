/* Parts of instability lines that run along a branch curve without damping (limit_meeting.h), found from the
 * sign of Im zeta at the rim of the gap that the map keeps from the curve (map.h). With Im B of the sign of
 * the Doppler factor S = sign(q - alpha p)
 *
 *     at zero mass    on the side without waves, where Re zeta goes to + infinity at the curve
 *     at finite mass  on the side of the waves, where Im zeta goes to -S infinity and so vanishes within the
 *                     gap, nearer than double resolves: waves that hardly move the rail; Re zeta = Re B */
#ifndef CRITVEL_SEMIANALYTIC_LIMIT_CURVES_H
#define CRITVEL_SEMIANALYTIC_LIMIT_CURVES_H

#include "semianalytic/limit_meeting.h"
#include "semianalytic/lines_parts.h"

typedef enum {
    SA_RUN_RANGE,   /* the end of the range of velocities */
    SA_RUN_RIM,     /* Im zeta changes its sign at the rim: a line comes to the curve there */
    SA_RUN_SINKS,   /* Re zeta falls below the floor */
    SA_RUN_SPECIAL, /* a special velocity */
    SA_RUN_SHEAR    /* the shear speed "alpha", with q -> 0: Re zeta goes on to 0 there */
} sa_run_end_kind;

typedef struct {
    sa_run_end_kind kind;
    long special; /* number of the special velocity */
    double alpha;
} sa_run_end;

typedef struct {
    int arc;
    int zero_mass;     /* 0: at finite mass */
    int direction;     /* 1: N is larger above it, so that the line runs towards larger alpha; -1: smaller */
    sa_run_end end[2]; /* lower, upper alpha */
    size_t first, count; /* samples, alpha ascending; re = INFINITY at zero mass */
} sa_curve_run;

typedef struct {
    size_t count, room;
    sa_curve_run *item;
    sa_line_samples samples;
    int hidden; /* some end on curves that the map leaves out (map_build.h), e.g. at hidden_at */
    double hidden_at[2];
} sa_curve_runs;

/* All runs of an undamped map with Re zeta above the floor. meeting: of every special velocity; level: Re
 * zeta, ascending, at the ends of the range of eta_M, where there are samples marked SA_MARK_CUT; rim: the
 * velocities, ascending, at which lines come to the rim of a curve. out must be zero; clear it on any status.
 * CV_UNDECIDED: the sign at a rim could not be had. */
cv_status sa_curve_runs_find(sa_curve_runs *out, const sa_map *map, sa_field *field, double re_floor,
                             const sa_meeting *meeting, const double level[2], size_t rim_count,
                             const double *rim);
void sa_curve_runs_clear(sa_curve_runs *runs);

/* The signed distance of (alpha, q) from the curve of an arc, positive on the side of its waves; NAN where
 * the arc is not. */
double sa_curve_distance(const sa_map *map, int arc, double alpha, double q);

#endif
