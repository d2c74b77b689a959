/* Vertical asymptotes of the instability lines: the velocities at which eta_M runs to infinity and q to 0.
 *
 * With qbar = i q -> 0, S = sum over Re lambda_i > 0 of R(lambda_i)/Delta'(lambda_i) is S0(alpha) + S1(alpha)
 * qbar + ... with real coefficients, so zeta = 4 qbar^2 S = -4 q^2 S0 - 4 i q^3 S1 + ...: on a line Im zeta =
 * 0, hence S1 -> 0, and eta_M = -1/(4 q^2 S0). Delta and R (dgreen/operator.h) are expanded to first order in
 * qbar about their values at qbar = 0, which are real polynomials in lambda; differentiating R/Delta' along a
 * root, whose slope is d lambda_i/d qbar = -Delta_1/Delta', S1 = sum of (R_1 + R' lambda_i')/Delta' - R
 * (Delta_1' + Delta'' lambda_i')/Delta'^2. All dimensionless. */
#ifndef CRITVEL_DGREEN_ASYMPTOTES_H
#define CRITVEL_DGREEN_ASYMPTOTES_H

#include <mpfr.h>
#include <stddef.h>

#include "dgreen/branch_points.h"

/* S0 and S1 at one velocity, computed with "bits" bits, which becomes their precision. Not bounded: see
 * dg_asymptotes_find. Damping needed. CV_UNDECIDED: the bits do not separate two roots or decide their
 * half-planes. CV_FAILED: out of memory. */
cv_status dg_low_frequency(mpfr_ptr s0, mpfr_ptr s1, const dg_track *track, mpfr_srcptr alpha,
                           mpfr_prec_t bits);

typedef struct {
    mpfr_t alpha;
    double error; /* absolute bound, from the signs of S1 on both sides */
    int positive; /* 1: S0 < 0, so that zeta > 0 beside q = 0 and a line of positive masses runs there */
} dg_asymptote;

typedef struct {
    size_t count;
    dg_asymptote *items; /* ascending in alpha */
    cv_status status;    /* CV_UNDECIDED: why says what may be missing, or has not the digits */
    cv_message why;
} dg_asymptote_list;

/* The zeros of S1 between the two velocities, 0 < alpha_min < alpha_max, relative errors below 10^-digits.
 * Method: signs at velocities graded towards the special ones of "branches" and at minima of |S1| between
 * them that may hide two, from Im zeta at a frequency far below the lowest branch point; then bracketing by
 * S1 itself. There a sign counts when S1 exceeds four times its change from 64 bits more. Not found: two
 * zeros between neighbouring velocities between which |S1| shows no minimum. CV_FAILED: out of memory; the
 * list is then empty. */
cv_status dg_asymptotes_find(dg_asymptote_list *list, const dg_track *track, const dg_branch_curves *branches,
                             double alpha_min, double alpha_max, int digits, cv_message *why);
/* The same velocities to another number of digits, from their error bounds. */
cv_status dg_asymptotes_sharpen(dg_asymptote_list *list, const dg_asymptote_list *from, const dg_track *track,
                                int digits, cv_message *why);
void dg_asymptote_list_clear(dg_asymptote_list *list);

#endif
