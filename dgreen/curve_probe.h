/* Points of the curve zeta(i q): evaluation with certified signs, and the derivatives along it. */
#ifndef CRITVEL_DGREEN_CURVE_PROBE_H
#define CRITVEL_DGREEN_CURVE_PROBE_H

#include "dgreen/z.h"

/* zeta at one frequency q > 0; the sign of im is certain. All dimensionless. */
typedef struct {
    double q, re, im;
    double re_error; /* bound of |re - exact| */
} dg_node;

typedef struct {
    const dg_track *track;
    dg_follow *follow;
} dg_probe;

/* CV_UNDECIDED: the largest precision cannot tell the sign of Im zeta at these doubles. */
cv_status dg_probe_at(dg_node *node, const dg_probe *p, double alpha, double q);

/* Slopes at a zero of Im zeta(alpha, q): along Im zeta = 0, x = Re zeta. */
typedef struct {
    double dq, dx; /* dq/d alpha, dx/d alpha */
    double im_alpha, im_q;
} dg_slopes;

/* By differences over a small part of "distance", the distance over which zeta changes (in q; in alpha it is
 * distance/p where branch points with wave numbers up to p are near). */
cv_status dg_probe_slopes(dg_slopes *s, const dg_probe *p, double alpha, double q, double distance,
                          double wave);

#endif
