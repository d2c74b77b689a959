/* The steps of dg_curve_at after the first nodes. For curve.c and curve_refine.c only. */
#ifndef CRITVEL_DGREEN_CURVE_REFINE_H
#define CRITVEL_DGREEN_CURVE_REFINE_H

#include "dgreen/curve.h"

cv_status dg_curve_reserve(dg_curve *c, size_t more, cv_message *why); /* room for that many nodes more */
cv_status dg_curve_add(dg_curve *c, const dg_probe *p, double q, cv_message *why); /* one node, unsorted */
void dg_curve_sort(dg_curve *c); /* ascending, without repetitions */

/* Without damping: finds the poles and adds the nodes beside them. */
cv_status dg_curve_poles(dg_curve *c, const dg_probe *p, cv_message *why);
/* The crossings between nodes on the two sides of a pole; returns their number. */
int dg_pole_crossings(dg_crossing out[2], const dg_curve *c, const dg_pole *pole, const dg_node *a,
                      const dg_node *b);

/* Adds nodes where two zeros of Im zeta may hide or the curve turns. */
cv_status dg_curve_refine(dg_curve *c, const dg_probe *p, cv_message *why);

/* Fills the lists of crossings and dips; adds the ends of the crossings' brackets to the nodes. */
cv_status dg_curve_list(dg_curve *c, const dg_probe *p, cv_message *why);

#endif
