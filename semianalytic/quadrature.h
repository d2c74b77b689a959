/* K(xi, q) of (13) by adaptive quadrature along the real p axis: no pole, no residue, no half-plane enters,
 * so that it checks all three. Dimensionless; signs as in zeta.h. */
#ifndef CRITVEL_SEMIANALYTIC_QUADRATURE_H
#define CRITVEL_SEMIANALYTIC_QUADRATURE_H

#include "semianalytic/zeta.h"

/* *error: GSL's estimate of the absolute error, not a proof. tolerance: relative to |K| plus its static size,
 * 1e-13 .. 1e-2. Works for damped tracks; the cost grows with 1/damping. CV_BAD_INPUT: undamped track, alpha
 * < 0, an argument that is not finite, tolerance out of range. CV_UNDECIDED: the tolerance is not reached.
 * GSL's error handler must be off (gsl_set_error_handler_off). */
cv_status sa_quadrature_kernel(double complex *kernel, double *error, const sa_track *t, double alpha,
                               double q, double xi, double tolerance, cv_message *why);

#endif
