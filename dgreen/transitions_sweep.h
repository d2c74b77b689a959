/* What the steps of dg_find_transitions share, in double: the search in alpha before anything is refined.
 * For the files transitions*.c only. All dimensionless. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_SWEEP_H
#define CRITVEL_DGREEN_TRANSITIONS_SWEEP_H

#include "dgreen/winding.h"

/* One transition in double, and the slopes that lead to it. */
typedef struct {
    double alpha, q;
    double dq, dx; /* along Im zeta = 0 */
    double scale;  /* distance in q over which zeta changes */
    double reach;  /* distance in alpha over which x changes */
    int change;    /* of the number of unstable roots as alpha grows: +2 or -2 */
    int across; /* 1: where two crossings are born or die at a fold nearer than doubles are in alpha: alpha as
                   a function of q is then the simple one of the two */
} dg_find;

/* What is known of one mass ratio. */
typedef struct {
    double x; /* 1/eta_M */
    size_t count, room;
    dg_find *finds;
    int count_at_min; /* unstable roots at alpha_min */
    cv_status status; /* CV_UNDECIDED: the list may be incomplete, why says where */
    cv_message why;
} dg_mass;

typedef struct {
    dg_probe probe;
    double x_floor; /* below every 1/eta_M */
    double x_roof;  /* above every 1/eta_M */
    size_t mass_count;
    dg_mass *masses;
    cv_message *why;
} dg_sweep;

/* Remembers a transition of that mass ratio. */
cv_status dg_sweep_add(dg_sweep *s, size_t mass, const dg_find *find);
/* Forgets all but the first "keep" transitions. */
void dg_sweep_forget(dg_sweep *s, const size_t *keep);
/* Notes that the list of that mass ratio may be incomplete; the first reason is kept. */
void dg_sweep_doubt(dg_mass *mass, const char *reason, double alpha, double other);

/* Searches all velocities alpha_min .. alpha_max; fills the lists of all mass ratios, unsorted. */
cv_status dg_sweep_run(dg_sweep *s, double alpha_min, double alpha_max);

#endif
