/* Deflection of the rail under a force, with or without a mass, that is switched on at tau = 0 on a track at
 * rest: inversion of (14) with the factor 4 corrected (DESIGN.md section 3),
 *
 *     w(xi, tau) = 1/(2 pi) integral of W(xi, q) e^{i q tau} dq   along a line below all singularities of
 *     W(xi, q) = 2 K(xi, q) / (i q (2 pi - eta_M q^2 K(0, q)))    (eta_C = 1)
 *
 * Dimensionless; w in units of w_st (3), so the static deflection of the track alone is K(xi, 0)/pi at alpha
 * = 0. The line is moved up to Im q = -height; what it passes are roots of z = 1 (roots_search.h), counted by
 * the argument principle, and each leaves its residue i K e^{i q tau} / (i pi q f'), f = 1 - eta_M zeta. On
 * the line W(-conj q) = conj W(q), and w is (1/pi) Re of the integral over Re q > 0: adaptive panels, on each
 * of which W is a sum of Legendre polynomials and e^{i q tau} is integrated exactly (Filon's method with
 * spherical Bessel functions), so that one set of panels serves all tau and oscillation costs nothing. All
 * other singularities - q = 0, the stable roots, the branch points - lie above the line.
 *
 * Early: qbar = i q large, K = pi qbar^(-3/2) (1 + (eta_N/2 - 3 alpha^2/4 - 3 eta_p/2)/qbar + ...), the beam
 * alone; hence w(0, tau) = tau^(3/2)/Gamma(5/2) + ... for the force, tau^2/eta_M for a mass. */
#ifndef CRITVEL_SEMIANALYTIC_RESPONSE_H
#define CRITVEL_SEMIANALYTIC_RESPONSE_H

#include "semianalytic/zeta.h"

typedef struct {
    double alpha, mass_ratio; /* mass_ratio 0: a force alone */
    double xi;                /* place beside the load, > 0 ahead of it */
    double tau_max;           /* > 0 */
    double height;            /* of the line; 0: 3 / tau_max within 1e-6 .. 0.3, and away from roots */
} sa_motion;

typedef struct sa_response sa_response;

/* Everything but tau. CV_BAD_INPUT: an argument that is negative where it must not be, or not finite.
 * CV_UNDECIDED: the kernel is not to be had, or not all roots below the line are found. */
cv_status sa_response_new(sa_response **out, const sa_track *t, const sa_motion *motion, cv_message *why);
void sa_response_free(sa_response *r); /* NULL allowed */

/* w(xi, tau), tau >= 0. *error: an estimate, from the last Legendre coefficients, the tail that is left out,
 * and rounding; not a proof. */
cv_status sa_response_at(double *w, double *error, const sa_response *r, double tau);

double sa_response_height(const sa_response *r);
int sa_response_roots(const sa_response *r); /* passed by the line, conjugates counted */

#endif
