/* The number of zeros of f(q) = 1 - eta_M zeta(alpha, q) below the line Im q = -height, by the argument
 * principle: along the line from -i height to Q - i height, then on a circle to the imaginary axis. f(-conj
 * q) = conj f(q) gives the other half, and f is real and positive at both ends, so the change of argument is
 * a multiple of pi: N = -change/pi. Dimensionless; qbar = i q. */
#ifndef CRITVEL_SEMIANALYTIC_ROOTS_CONTOUR_H
#define CRITVEL_SEMIANALYTIC_ROOTS_CONTOUR_H

#include <stddef.h>

#include "semianalytic/zeta.h"

typedef struct {
    double complex q, f, f_q;
} sa_contour_point;

typedef struct {
    int roots; /* N */
    double
        radius; /* Q: beyond, zeta is that of the bare beam within a tenth, and 1 - eta_M zeta has Re > 0 */
    size_t count, room;
    sa_contour_point *points; /* in order along the contour; none on the arc */
} sa_contour;

/* height >= 0, > 0 for undamped tracks; mass_ratio >= 0. On the real axis zeta comes with a proven bound
 * (zeta.h), elsewhere in double. The step is halved until f changes by less than half its magnitude and a
 * cubic through values and slopes predicts the middle; the steps start at the branch points.
 * CV_UNDECIDED: f too near 0, zeta not to be had, or the change of argument is no multiple of pi. On any
 * status but CV_OK out is empty. */
cv_status sa_contour_build(sa_contour *out, const sa_track *t, double alpha, double mass_ratio, double height,
                           cv_message *why);
void sa_contour_clear(sa_contour *c);

#endif
