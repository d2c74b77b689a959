/* The velocities between two sampled curves: either everything that happens there is found, or the cell is
 * cut in two by a further curve. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_CELL_H
#define CRITVEL_DGREEN_TRANSITIONS_CELL_H

#include "dgreen/transitions_sweep.h"

/* left->alpha < right->alpha. Adds all transitions between them to the sweep, so that for every mass ratio
 * that is not in doubt the crossing balances at both ends differ by the sum of the changes. Method: the
 * crossings of both curves are aligned in order (a shortest edit script: pairs of equal direction, costs by
 * ratio of x and difference of position); each pair is followed (dg_branch_scan); crossings without a partner
 * must not matter for any mass ratio, nor may a dip of |Im zeta| be about to reach zero unseen: at the other
 * end there must be the pair of crossings that came of it. */
cv_status dg_cell_search(dg_sweep *s, const dg_curve *left, const dg_curve *right);

#endif
