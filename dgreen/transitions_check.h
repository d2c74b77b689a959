/* Whether lists of transitions agree with the number of unstable roots between them. For the files
 * transitions*.c only. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_CHECK_H
#define CRITVEL_DGREEN_TRANSITIONS_CHECK_H

#include "dgreen/curve.h"
#include "dgreen/transitions.h"

/* For every list that is CV_OK, below its first transition, between neighbours and above its last: the
 * running count must be the winding number of a curve sampled there by probe; it should look closer than the
 * search did. The first place where it is not makes the list CV_UNDECIDED, with why. One curve serves all
 * lists. Not asked: between two transitions so close that the curve in double passes through 1/eta_M. x[k] =
 * 1/eta_M of list k, x_floor below all of them. CV_FAILED: out of memory. */
cv_status dg_check_lists(dg_transition_list *lists, size_t count, const double *x, double x_floor,
                         const dg_probe *probe, double alpha_min, double alpha_max, cv_message *why);

#endif
