/* Waves of the undamped track at rest: the three branches omega_k(p) of the dispersion relation and their
 * derivatives. With eta_p = eta_b = eta_f = 0, (7)-(10) is the symmetric eigenproblem
 *
 *     K(p) v = omega^2 M v,   M = diag(1, mu_s, mu_b),
 *     K(p) = [p^4/4 - eta_N p^2 + kappa_p, -kappa_p,            0                    ]
 *            [-kappa_p,                    kappa_p + kappa_b,  -kappa_b              ]
 *            [0,                          -kappa_b,             kappa_b + 1 + eta_s p^2].
 *
 * It is tridiagonal with nonzero off-diagonals, so that for real p the three omega_k are always distinct:
 * branches come close but never cross, and each is analytic in p. All quantities are dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_DISPERSION_H
#define CRITVEL_SEMIANALYTIC_DISPERSION_H

#include "common/params.h"

enum { SA_BRANCHES = 3 };

/* The undamped track, rounded; long double only so that what is delivered as double has all its digits. */
typedef struct {
    long double mu_s, mu_b, kappa_p, kappa_b, eta_s, eta_N;
} sa_dispersion;

/* One wave e^{i(omega t + p x)} of branch k. */
typedef struct {
    long double p;         /* as given */
    long double omega;     /* omega_k(p) > 0 */
    long double d[4];      /* d[j] = d^j omega_k / dp^j, j = 1..3; d[0] = omega */
    long double intercept; /* omega - p omega'(p), computed without cancellation between the two: the
                            * frequency in the frame that moves at the group velocity */
} sa_wave;

/* Rounds the parameters; the dampings are ignored. params must have passed cv_params_check. */
void sa_dispersion_set(sa_dispersion *out, const cv_params *params);

/* The wave of branch k = 0, 1, 2 (omega ascending) at any real p. omega_guess is a start value or 0 for none;
 * the answer does not depend on it: that it belongs to branch k is certified by Sturm counts. omega is right
 * to a few units in the last place of long double; the derivatives lose what an avoided crossing of
 * relative gap g costs, about a factor 1/g per order. CV_FAILED only for parameters that are not a track
 * (NaN, buckled). */
cv_status sa_dispersion_wave(sa_wave *out, const sa_dispersion *d, int k, long double p,
                             long double omega_guess);

/* Number (0 .. 3) of branches with omega_k(p)^2 < square. */
int sa_dispersion_count(const sa_dispersion *d, long double p, long double square);

/* Cut-off wave numbers are not bounded, but branch speeds at large p are: the limit of omega/p and of omega'
 * of branch 1 as p grows, sqrt(eta_s / mu_b); 0 for eta_s = 0. Branch 0 becomes flat, branch 2 is the rail.
 */
long double sa_dispersion_shear_speed(const sa_dispersion *d);

#endif
