/* Instability lines: the curves in the plane of velocity alpha and mass ratio eta_M on which eta_M
 * zeta(alpha, i q) = 1 for a real frequency q > 0, so that the number N of roots with Re qbar > 0 changes by
 * two. Found by D-decomposition: the crossings of the curve zeta(i q), q = 0 .. infinity, with the positive
 * real axis, x = Re zeta = 1/eta_M, are followed as alpha changes. All dimensionless.
 *
 * Method: curves (dgreen/curve.h) at velocities graded towards the special ones; between two neighbouring
 * velocities the crossings are paired in order and each pair is followed; two neighbouring crossings of
 * opposite direction without partners must meet at a turning point, which is bracketed; a minimum of |Im
 * zeta| that may touch zero in between is followed, too. Where any of this fails there is one more velocity
 * in between, down to the spacing of doubles. What is still open then is listed as a doubt. Not found: a
 * closed line so narrow in alpha that no velocity meets it, without a minimum of |Im zeta| at both
 * neighbouring velocities that leads to it. */
#ifndef CRITVEL_DGREEN_LINES_H
#define CRITVEL_DGREEN_LINES_H

#include <mpfr.h>
#include <stddef.h>

#include "dgreen/asymptotes.h"

typedef struct {
    double alpha, q, mass_ratio;
    double q_error;   /* the zero of Im zeta at exactly this alpha is within, certified signs; tips: 0, not
                         bounded */
    double scale;     /* distance in q over which zeta changes here; a tenth of it will do as "reach" below */
    int turns;        /* 1: the velocity is an extreme value along the line (tip) */
    int stable_roots; /* N on the side with fewer unstable roots, beside this vertex; -1: not counted */
} dg_line_vertex;

/* How a line ends. */
typedef enum {
    DG_LINE_CLOSED,        /* it does not: the last vertex is the first */
    DG_LINE_INFINITE_MASS, /* eta_M grows beyond the range and on to infinity at a certain velocity: there q
                              -> 0 (dgreen/asymptotes.h), or zeta = 0 at a finite q */
    DG_LINE_TOP,           /* leaves the range at the greatest eta_M */
    DG_LINE_BOTTOM,        /* leaves it at the smallest eta_M */
    DG_LINE_ALPHA_MIN,     /* at the lowest velocity */
    DG_LINE_ALPHA_MAX,     /* at the highest */
    DG_LINE_UNDECIDED      /* lost: see the doubts */
} dg_line_exit;

/* One line, directed so that, with alpha to the right and eta_M upwards, two more roots are unstable on its
 * left: where alpha grows along the line that is the side of greater eta_M. Between consecutive vertices it
 * keeps within 1e-3 of their chord, in units of the ranges of alpha and log eta_M. */
typedef struct {
    size_t count;
    dg_line_vertex *vertices; /* closed lines: the last repeats the first */
    dg_line_exit exits[2];    /* at the first and the last vertex */
    double asymptote[2];      /* DG_LINE_INFINITE_MASS: that velocity; else 0 */
    double asymptote_q[2];    /* and the frequency there */
    int zero_mass[2]; /* 1: beyond this end the line runs to zero mass as alpha grows, followed until eta_M
                         was a hundredth of the smallest of the range */
    size_t least;     /* the vertex with the smallest eta_M */
} dg_line;

/* Velocities between which something was not resolved, and what */
typedef struct {
    double alpha_low, alpha_high;
    cv_message why;
} dg_line_doubt;

typedef struct {
    double alpha_min, alpha_max, mass_min, mass_max;
    size_t count, doubt_count;
    dg_asymptote_list asymptotes; /* to 20 digits, in the range of alpha */
    dg_line *lines;               /* ordered by their lowest velocity */
    dg_line_doubt *doubts;
    struct dg_line_graph *graph; /* private: all points */
} dg_lines;

/* Beyond, curves would be needed at frequencies too low for doubles. */
#define DG_LINES_MASS_MAX 1e10

/* All lines in 0 < alpha_min <= alpha <= alpha_max, 0 < mass_min <= eta_M <= mass_max <= DG_LINES_MASS_MAX; a
 * line that leaves the range and comes back is two. params must have passed cv_params_check. CV_OK also with
 * doubts. CV_BAD_INPUT: no damping, or an empty range. CV_UNDECIDED: a curve could not be evaluated at all.
 * CV_FAILED: out of memory. *out is empty unless CV_OK. */
cv_status dg_lines_find(dg_lines *out, const cv_params *params, double alpha_min, double alpha_max,
                        double mass_min, double mass_max, cv_message *why);
void dg_lines_clear(dg_lines *l);

/* The asymptotes to that many digits. */
cv_status dg_lines_asymptotes(dg_asymptote_list *list, const dg_lines *l, int digits, cv_message *why);

/* N at one point of the plane by counting lines: twice the balance of their directions at smaller eta_M.
 * alpha in the range, mass_ratio <= mass_max. CV_UNDECIDED: on a line to double precision, or in doubt. */
cv_status dg_lines_count(int *roots, const dg_lines *l, double alpha, double mass_ratio, cv_message *why);

/* Where a line passes one mass ratio. */
typedef struct {
    double alpha, q;
    int change; /* of N as alpha grows: 2 or -2 */
} dg_line_passage;

/* All passages, ascending in alpha, mass_min <= mass_ratio <= mass_max; the caller frees *out. CV_UNDECIDED:
 * a line touches the mass ratio without passing to double precision, or could not be followed again. */
cv_status dg_lines_passages(dg_line_passage **out, size_t *count, const dg_lines *l, double mass_ratio,
                            cv_message *why);

/* One point of a line to any number of digits. */
typedef struct {
    mpfr_t alpha, frequency, mass_ratio;
    double alpha_error, frequency_error,
        mass_ratio_error; /* absolute bounds; 0 for the coordinate that was given */
} dg_line_point;

void dg_line_point_init(dg_line_point *p);
void dg_line_point_clear(dg_line_point *p);

/* The point at exactly this alpha whose frequency is within "reach" of q, or at exactly this q whose velocity
 * is within "reach" of alpha: Im zeta has certified and different signs at both ends of the bracket that is
 * reported; relative errors of the frequency (velocity) and of eta_M below 10^-digits. What is assumed beyond
 * the signs: Re zeta is monotone in the final bracket. reach > 0 must be less than the distance to the next
 * line. CV_UNDECIDED: no change of sign within reach, Re zeta not positive there, or the largest precision
 * was not enough; *out then has no meaning. CV_BAD_INPUT: alpha, q or reach not positive. */
cv_status dg_line_at_alpha(dg_line_point *out, const dg_track *track, mpfr_srcptr alpha, mpfr_srcptr q,
                           double reach, int digits, cv_message *why);
cv_status dg_line_at_frequency(dg_line_point *out, const dg_track *track, mpfr_srcptr q, mpfr_srcptr alpha,
                               double reach, int digits, cv_message *why);

#endif
