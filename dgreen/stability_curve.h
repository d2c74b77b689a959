/* Figures 2 and 3 of the paper: the curves z(+-i q) and z(delta +- i q) as polylines, and what the first cuts
 * out of the real axis. z = factor * zeta, factor = eta_M or 1. All dimensionless. */
#ifndef CRITVEL_DGREEN_STABILITY_CURVE_H
#define CRITVEL_DGREEN_STABILITY_CURVE_H

#include "dgreen/sampler.h"

typedef struct {
    double q, re, im; /* z at qbar = i q, or delta + i q; q > 0 */
} dg_vertex;

typedef struct {
    size_t count, room;
    dg_vertex *at; /* ascending in q; the half with -q is its mirror image in the real axis */
} dg_polyline;

/* A crossing of z(i q) with the positive real axis. */
typedef struct {
    double q, x;     /* frequency and z; x = INFINITY at a branch point without damping */
    int left, right; /* roots of z = c with Re qbar > 0 for c a little smaller and a little greater than x */
} dg_cut;

typedef struct {
    dg_polyline boundary, shifted;
    double x_floor; /* crossings with smaller z are not listed */
    size_t cut_count;
    dg_cut *cuts; /* ascending in x; they cut (x_floor, infinity) into cut_count + 1 regions */
    int unstable; /* roots of z = 1 with Re qbar > 0 */
} dg_stability_curve;

/* At alpha in the sampler's range, factor > 0, delta > 0. *c must be zero or a former curve. A polyline turns
 * by at most 15 degrees at each vertex, except where one of the two steps is below 1e-6 of |z| or
 * as narrow in q as doubles are, at a branch
 * point without damping, and where it has too many vertices (MAX_VERTICES of stability_curve.c); each
 * crossing listed lies between two consecutive vertices. The number of roots in each region follows from the
 * crossings and is compared with the winding of the curve around a point of the region. CV_UNDECIDED as
 * dg_sampler_curve and dg_sampler_count: z = 1 lies on the curve, or the two differ. */
cv_status dg_stability_curve_at(dg_stability_curve *c, dg_sampler *s, double alpha, double factor,
                                double delta, cv_message *why);
void dg_stability_curve_clear(dg_stability_curve *c);

#endif
