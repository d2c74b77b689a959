/* Roots of zeta(alpha, qbar) = x followed as x = 1/eta_M changes, in double.
 *
 * Every root with Re qbar > 0 enters that half-plane through a crossing of the D-decomposition curve with the
 * real axis at some larger x (none is there for x -> infinity, a vanishing mass); d qbar/dx = 1/zeta'. */
#ifndef CRITVEL_DGREEN_PATH_H
#define CRITVEL_DGREEN_PATH_H

#include "dgreen/continued.h"
#include "dgreen/curve.h"

typedef struct {
    dg_continued at;
    double complex value; /* zeta there */
    const dg_station *station;
} dg_path;

/* Begins at qbar = i q on the curve. CV_UNDECIDED as dg_continued_start. */
cv_status dg_path_start(dg_path *p, const dg_probe *probe, const dg_station *station, double q);

/* Begins where a root enters or leaves the right half-plane. Without damping a crossing may be at infinity,
 * at a branch point; then it begins beside that. */
cv_status dg_path_enter(dg_path *p, const dg_probe *probe, const dg_curve *curve,
                        const dg_crossing *crossing);

/* Distance from qbar to the nearest singularity of zeta, to first order in the damping. */
double dg_path_room(const dg_station *station, double complex qbar);

/* Follows zeta(qbar) along the straight line from its present value to the target, which may be complex; then
 * improves qbar as far as double goes. CV_UNDECIDED: two roots meet, or a branch point is hit. */
cv_status dg_path_go(dg_path *p, double complex target);

#endif
