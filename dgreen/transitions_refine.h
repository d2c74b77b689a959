/* From a transition in double to any number of digits, with certified signs. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_REFINE_H
#define CRITVEL_DGREEN_TRANSITIONS_REFINE_H

#include "dgreen/transitions.h"
#include "dgreen/transitions_sweep.h"

/* Fills *out (alpha and frequency initialised) but for the counts.
 * Method: for a velocity alpha the frequency q(alpha) with Im zeta = 0 is bracketed; the velocity with
 * Re zeta(alpha, q(alpha)) = 1/eta_M is bracketed around that; across a fold, or where that fails,
 * alpha(q) takes the place of q(alpha). Both brackets shrink by evaluating on both
 * sides of the secant's zero, at a distance that its quadratic error suggests. A sign counts when the value
 * exceeds its error bound; otherwise the evaluation is repeated with more bits. What is assumed beyond the
 * certified signs: zeta is monotone inside the final brackets. effort is added to. CV_UNDECIDED (also in
 * out->decided): no sign change where the double search saw one, or the largest precision was not enough.
 * CV_FAILED: out of memory. */
cv_status dg_refine(dg_transition *out, dg_effort *effort, const dg_track *track, const dg_find *find,
                    const cv_number *mass_ratio, int digits);

#endif
