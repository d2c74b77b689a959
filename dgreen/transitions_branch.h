/* One crossing of the curve with the real axis, followed from one velocity to the next. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_BRANCH_H
#define CRITVEL_DGREEN_TRANSITIONS_BRANCH_H

#include "dgreen/transitions_sweep.h"

/* Finds the transitions x(alpha) = 1/eta_M of all mass ratios on the branch that runs from crossing a of
 * "left" to crossing b of "right", and adds them to the sweep. Method: intermediate crossings by a bracketed
 * search in q until x(alpha) agrees with its slopes, then dg_hunt_zeros between consecutive ones.
 * CV_UNDECIDED: there is no such branch, or it is not smooth: the cell must be cut. */
cv_status dg_branch_scan(dg_sweep *s, const dg_curve *left, const dg_crossing *a, const dg_curve *right,
                         const dg_crossing *b);

#endif
