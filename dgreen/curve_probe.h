/* Points of the curve zeta(i q): evaluation with certified signs, and the derivatives along it. */
#ifndef CRITVEL_DGREEN_CURVE_PROBE_H
#define CRITVEL_DGREEN_CURVE_PROBE_H

#include "dgreen/curve_station.h"
#include "dgreen/z.h"

/* zeta at one frequency q > 0; the sign of im is certain. All dimensionless. */
typedef struct {
    double q, re, im;
    double re_error; /* bound of |re - exact| */
    double position; /* dg_station_position, for nodes of a curve */
} dg_node;

typedef struct {
    const dg_track *track;
    dg_follow *follow;
    const dg_branch_curves *branches;
    int look; /* how closely curves are looked at: 0 is normal, each further one halves the spacing of the
                 first nodes and what passes for smooth */
} dg_probe;

/* CV_UNDECIDED: the largest precision cannot tell the sign of Im zeta at these doubles. */
cv_status dg_probe_at(dg_node *node, const dg_probe *p, double alpha, double q);

/* Makes re_error small beside |zeta| when it is not: next to a branch point double tells the sign of Im zeta
 * long before Re zeta. */
cv_status dg_probe_sharpen(dg_node *node, const dg_probe *p, double alpha);

/* The same as dg_probe_at without a promise about the sign, and cheaper close to a zero of Im zeta; *certain
 * tells. */
cv_status dg_probe_value(dg_node *node, int *certain, const dg_probe *p, double alpha, double q);

/* Derivatives of zeta at fixed distance from the nearest branch point, whose frequency moves with alpha at
 * the rate "drift"; and, for a point with Im zeta = 0, the slopes along Im zeta = 0. */
typedef struct {
    double im_alpha, im_q, re_alpha, re_q;
    double drift;  /* d q/d alpha in which *_alpha are taken */
    double dq, dx; /* dq/d alpha and d(Re zeta)/d alpha along Im zeta = 0 */
} dg_slopes;

/* By central differences: in q over a small part of the distance to the nearest branch point, in alpha over a
 * small part of the distance to the next special velocity. At a fixed q the latter would have to be as small
 * as the former, and the drift of the branch point would cancel all digits. */
cv_status dg_probe_slopes(dg_slopes *s, const dg_probe *p, const dg_station *at, double q);

#endif
