/* Number of unstable roots by the argument principle.
 *
 * 1 - eta_M zeta has no poles for Re qbar > 0 and behaves like |q|^(1/2) e^{+-i pi/4} at infinity, so that
 * the number of its roots there is N = 1/4 - Delta/pi, Delta the change of arg(1 - eta_M zeta(i q)) for q = 0
 * .. infinity. Roots come in conjugate pairs and none is real: N is even. */
#ifndef CRITVEL_DGREEN_WINDING_H
#define CRITVEL_DGREEN_WINDING_H

#include "dgreen/curve.h"

/* The two counts from one sampled curve, eta_M = 1/x, x > 0 and not below the curve's x_floor:
 * *roots by the winding; it must equal twice the balance of the crossings beyond x (+1 each that goes from
 * Im zeta > 0 to < 0 as q grows, -1 the others).
 * CV_UNDECIDED: dg_curve_touches, the sum
 * is not within 1e-6 of an even number >= 0, or the two counts differ. */
cv_status dg_winding(int *roots, const dg_curve *c, double x, cv_message *why);

/* Whether x lies inside the bracket of a crossing, so that the curve does not tell on which side it passes.
 */
int dg_curve_touches(const dg_curve *c, double x);

/* Twice the balance of the crossings beyond x. */
int dg_crossing_balance(const dg_curve *c, double x);

#endif
