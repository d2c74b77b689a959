/* Steady deflection of rail, sleepers and ballast under a constant force that moves at velocity alpha, with
 * or without damping: (12) with q = 0 and the force of (3),
 *
 *     w(xi) = (1/pi) integral d2/d3 e^{ip xi} dp,
 *
 * likewise u_s, u_b with the other minors, by residues; without damping as the limit q -> q - i0
 * (undamped.h). w = 1 under a resting force on a Winkler foundation. All quantities are dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_STEADY_H
#define CRITVEL_SEMIANALYTIC_STEADY_H

#include "semianalytic/undamped.h"

/* On its side of the force, adds Re(weight[f] e^{ip|xi|}) to field f = 0, 1, 2: w, u_s, u_b; Im p >= 0. */
typedef struct {
    int ahead; /* 1: xi > 0, 0: xi < 0 */
    complex long double p;
    complex long double weight[SA_FIELDS];
} sa_steady_term;

enum { SA_STEADY_TERMS = 8 };

typedef struct {
    int count;
    sa_steady_term term[SA_STEADY_TERMS];
    double defect; /* how far the two sides fail to meet at the force, relative to the size of what meets: w,
                    * w', w'' and w''' (jump 8), u_s, u_s' and, but for alpha^2 mu_b = eta_s, u_b, u_b'.
                    * Rounding errors show here. */
} sa_steady;

/* alpha >= 0. params must have passed cv_params_check. CV_UNDECIDED: two wave numbers are too close for long
 * double (at a resonance velocity of an undamped track the deflection is infinite), or the damping is too
 * small to tell on which side a wave runs. */
cv_status sa_steady_solve(sa_steady *out, const cv_params *params, const cv_number *alpha, cv_message *why);

/* The three fields at xi, of either sign. */
void sa_steady_at(long double out[SA_FIELDS], const sa_steady *s, long double xi);

#endif
