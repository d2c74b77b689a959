/* zeta(alpha, qbar) = z/eta_M, with z of (30):
 *     zeta = 4 qbar^2 * sum over Re lambda_i > 0 of R(lambda_i)/Delta'(lambda_i),   characteristic equation
 *     eta_M zeta = 1.
 * All dimensionless; Laplace kernel exp(-qbar tau), qbar = i q on the stability boundary. The mass is
 * unstable when a root of eta_M zeta = 1 has Re qbar > 0. All for Re qbar >= 0. zeta(conj qbar) = conj
 * zeta(qbar).
 *
 * Bounds are rigorous up to the correctness of the arithmetic: rounding of the parameters, of the
 * coefficients and of every evaluation is included, and inclusion discs prove how many lambda_i have Re
 * lambda > 0. */
#ifndef CRITVEL_DGREEN_Z_H
#define CRITVEL_DGREEN_Z_H

#include <complex.h>

#include "dgreen/operator.h"

typedef struct {
    double re, im;             /* zeta */
    double re_error, im_error; /* bounds of |re - exact| and |im - exact|, for the exact parameters and the
                                  doubles alpha, qbar as given */
    int right_count; /* roots lambda with Re lambda > 0, proved: 6 for alpha^2 mu_b > eta_s, else 5; at
                        alpha = 0 half of all. A root through infinity is not counted. */
} dg_value;

typedef struct {
    unsigned long evaluations; /* calls */
    unsigned long cold_starts; /* calls that could not continue from the previous roots */
    unsigned long above_double;
    int largest_precision; /* bits; 53 when double was always enough */
} dg_counters;

/* The state of a sweep: the roots at the last point, from which the next point starts, and workspace. Any
 * next point is allowed, a near one is fast. One per thread. */
typedef struct dg_follow dg_follow;
cv_status dg_follow_new(dg_follow **out, cv_message *why);
void dg_follow_free(dg_follow *f); /* NULL allowed */
dg_counters dg_follow_counters(const dg_follow *f);

/* In double only. CV_OK: the value is bounded (not necessarily well: look at the bounds). CV_UNDECIDED:
 * double cannot decide the half-plane of a root, or separate two roots; *value has infinite bounds.
 * CV_BAD_INPUT: alpha < 0 or Re qbar < 0. CV_FAILED: a theorem is violated (count of roots, sum of residues),
 * that is, a bug. */
cv_status dg_zeta_double(dg_value *value, dg_follow *follow, const dg_track *track, double alpha,
                         double complex qbar);

/* The same, repeated in double-double and then in MPFR at 127, 191 and 255 bits while a bound exceeds its
 * tolerance (relative to the part it belongs to: re_error <= tol_re |re|, im_error <= tol_im |im|). A
 * tolerance of 1 settles a sign. INFINITY: the part is not wanted. CV_UNDECIDED: the largest precision was
 * not enough; *value then holds the best value and bounds there are, or infinite bounds. */
cv_status dg_zeta_adaptive(dg_value *value, dg_follow *follow, const dg_track *track, double alpha,
                           double complex qbar, double tol_re, double tol_im);

/* The same without the first step, for a caller that has just had dg_zeta_double at this point, with an
 * answer in *value that is not good enough. */
cv_status dg_zeta_above_double(dg_value *value, dg_follow *follow, const dg_track *track, double alpha,
                               double complex qbar, double tol_re, double tol_im);

#endif
