/* Transitions without damping: the limit, as all damping ratios tend to zero, of what dg_find_transitions
 * finds. All dimensionless.
 *
 * Between two special velocities (dgreen/branch_points.h) N changes where the curve zeta(i q + 0) passes
 * 1/eta_M, as with damping. At a special velocity itself the crossings at infinity may change their number,
 * and N with them for a whole range of mass ratios: the transitions of damped tracks come together there,
 * each at another frequency, and q is not defined but for its limit, the frequency at which the branch points
 * meet (0 at a resonance velocity of the moving force).
 *
 * Method: N by the winding of the curve, at velocities graded towards the special ones; intervals are halved
 * while N differs or the crossings of the real axis at both ends are not of one kind, then the one crossing
 * that passes 1/eta_M is followed by false position and refined (dgreen/transitions_refine.h). N on both
 * sides of a special velocity, a billionth of it away, tells whether it is a transition. Not found: two
 * transitions of one mass ratio so close together that the crossings at both ends of an interval do not show
 * it; and a strip between two lines that vanishes with the damping, as it should.
 * Wrong: next to the shear speed of the ballast, where the waves of no group velocity are shorter than any
 * that dgreen/branch_points.h lists (within some 1e-6 of it), their roots are not counted.
 */
#ifndef CRITVEL_DGREEN_LIMIT_TRANSITIONS_H
#define CRITVEL_DGREEN_LIMIT_TRANSITIONS_H

#include "dgreen/transitions.h"

/* As dg_find_transitions, for params without damping. Special velocities are known to double precision: where
 * more digits are asked for, those transitions are not decided, and so are their lists. */
cv_status dg_find_limit_transitions(dg_transition_list *lists, dg_effort *effort, const cv_params *params,
                                    const cv_number *alpha_min, const cv_number *alpha_max, size_t mass_count,
                                    const cv_number *mass_ratios, int digits, int first_look,
                                    cv_message *why);

#endif
