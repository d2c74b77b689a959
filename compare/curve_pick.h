/* Where to draw figures 2 and 3: a velocity and a mass ratio at which the D-decomposition curve passes
 * through z = 1 with the stable part on the side asked for. */
#ifndef CRITVEL_COMPARE_CURVE_PICK_H
#define CRITVEL_COMPARE_CURVE_PICK_H

#include "common/casefile.h"

typedef enum { CMP_STABLE_RIGHT, CMP_STABLE_LEFT } cmp_stable_side;

typedef struct {
    cv_params params; /* of the case at the damping level; initialised by the caller */
    double alpha;
    double eta_M;            /* at the crossing */
    double lighter, heavier; /* a mass ratio on either side of it, nearer than any other crossing */
} cmp_curve_pick;

/* Looks through the damping levels of the case, or at "damping" alone when it is not NULL, and for each
 * through the velocities of the file's range that are multiples of 0.05 (where that finds nothing, of 0.01),
 * or at "alpha" alone when it is positive; the first crossing of the positive real axis with no unstable
 * roots on its stable side, at a mass ratio from the smallest of the case to ten times the largest, and not
 * within a factor 1.5 of the next crossing; failing that, the first one that is. CV_UNDECIDED: there is none.
 */
cv_status cmp_curve_pick_find(cmp_curve_pick *out, const cv_casefile *file, const cv_case *c,
                              const cv_number *damping, double alpha, cmp_stable_side side, cv_message *why);

#endif
