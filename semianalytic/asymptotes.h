/* Vertical asymptotes of the instability lines. At q = 0 zeta = q^2 k(alpha) + i q^3 c(alpha) + O(q^4), with
 *
 *     k = K(0, 0) / (2 pi) = - sum of Im residue,    c = d(Im K)/dq / (2 pi) = sum of Re (d residue / dq),
 *
 * both sums over the poles with Im p > 0 at q = 0. A line Im zeta = 0 that runs to q = 0 does so at a zero of
 * c; where k > 0 eta_M = 1 / Re zeta goes to infinity there. Dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_ASYMPTOTES_H
#define CRITVEL_SEMIANALYTIC_ASYMPTOTES_H

#include "semianalytic/zeta.h"

typedef struct {
    mpfr_t alpha;
    double alpha_error; /* absolute: where Im zeta at a tiny q changes its sign, proven, and what that q adds,
                         * from its square; 0 below what a double holds */
    int rises;          /* 1: c changes from - to + as alpha grows, -1: from + to - */
    int has_line;       /* k > 0; otherwise Re zeta <= 0: no mass has it */
    cv_status decided;  /* CV_UNDECIDED: the digits asked for were not reached */
} sa_asymptote;

typedef struct {
    size_t count;
    sa_asymptote *item; /* alpha ascending */
} sa_asymptote_list;

/* All asymptotes with alpha_min < alpha < alpha_max, 0 < alpha_min, relative error below 10^-digits where
 * decided. c is sampled in the logarithm of the distance to the resonance velocities and the shear speed,
 * down to a hundredth of the damping there, and wherever it is not a parabola between samples more densely:
 * the list is complete as far as c is smooth on that scale. params: as for sa_boundary_new. CV_BAD_INPUT:
 * params are refused, or not a range. Without damping c is that of the limit q - i0, and resonance velocities
 * are left out. CV_FAILED: out of memory, a library failed. */
cv_status sa_asymptotes_find(sa_asymptote_list *out, const cv_params *params, const cv_number *alpha_min,
                             const cv_number *alpha_max, int digits, cv_message *why);
void sa_asymptotes_clear(sa_asymptote_list *list);

/* k and c at one velocity in double precision, with a rough bound on the rounding error of c. CV_UNDECIDED:
 * double precision does not tell the poles apart. */
cv_status sa_asymptote_function(double *k, double *c, double *c_error, const sa_track *track, double alpha);

#endif
