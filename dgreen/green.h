/* Green's function G_Delta(xi, eps) of the operator Delta, (28), and the deflection (24) made of it; in
 * double, not bounded. Weights are products of differences of roots as in the paper; dgreen/z.h takes Delta'
 * instead.
 *
 * Delta G = delta(xi - eps), G -> 0 on both sides. Derivatives 0 ... 6 in xi are continuous at xi = eps, the
 * 7th jumps by 1/a0. */
#ifndef CRITVEL_DGREEN_GREEN_H
#define CRITVEL_DGREEN_GREEN_H

#include <complex.h>

#include "dgreen/operator.h"

typedef struct {
    int count;                         /* finite roots lambda */
    double complex lambda[DG_DEGREE];  /* first those with Re lambda > 0 */
    double complex weight[DG_DEGREE];  /* 1/(a0 product over k != i of (lambda_k - lambda_i)) */
    int right_count;                   /* n of (28) */
    double complex a0;                 /* leading coefficient; of the next power where a0 = 0 */
    double complex r[DG_R_DEGREE + 1]; /* r[j] belongs to lambda^j: r_{4-j} of (23) */
} dg_green;

/* Which limit at xi = eps */
typedef enum { DG_BEFORE, DG_AFTER } dg_side;

/* Damping or Re qbar > 0; alpha >= 0, Re qbar >= 0. CV_UNDECIDED: the roots cannot be found or told apart in
 * double, or lie too close to the imaginary axis. */
cv_status dg_green_set(dg_green *g, const dg_track *track, double alpha, double complex qbar);

/* d^order G/d xi^order at xi - eps = distance; side counts at distance 0 only. */
double complex dg_green_derivative(const dg_green *g, int order, double distance, dg_side side);

/* W(xi, qbar) for a right-hand side of 1 in (7), that is 4 R G_Delta(xi, 0). With the force of (7), 2
 * eta_C/qbar - eta_M qbar^2 W(0), this is (24); at xi = 0 it is -zeta/qbar^2. */
double complex dg_green_deflection(const dg_green *g, double xi);

#endif
