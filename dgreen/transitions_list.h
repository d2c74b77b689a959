/* The list of one mass ratio from what the search in double found. For the files transitions*.c only. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_LIST_H
#define CRITVEL_DGREEN_TRANSITIONS_LIST_H

#include "dgreen/transitions.h"
#include "dgreen/transitions_sweep.h"

/* Refines each transition to "digits" digits, orders them and counts along. *list must be zero; its status is
 * CV_UNDECIDED, with why, where the mass ratio is in doubt already, a transition is not confirmed, two cannot
 * be told apart, or a count is negative. CV_FAILED: out of memory. */
cv_status dg_list_fill(dg_transition_list *list, dg_effort *effort, const dg_track *track,
                       const dg_mass *mass, const cv_number *mass_ratio, int digits, cv_message *why);

#endif
