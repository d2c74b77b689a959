/* The roots of Delta in double-double, by the simultaneous (Ehrlich-Aberth) iteration, with inclusion discs.
 */
#ifndef CRITVEL_DGREEN_ROOTS_DD_H
#define CRITVEL_DGREEN_ROOTS_DD_H

#include "dgreen/operator_dd.h"
#include "dgreen/roots.h"

typedef struct {
    int count, far;
    dg_dd_complex y[DG_DEGREE];     /* approximations; slot count-1 holds u = 1/y where far is set */
    dg_dd_complex slope[DG_DEGREE]; /* d Delta(i y)/dy there; of the reversed polynomial for the far root */
    double radius[DG_DEGREE], slope_relative[DG_DEGREE], crowding[DG_DEGREE]; /* see dg_separate */
} dg_dd_roots;

/* Starts from the double values, which may be poor. CV_OK: disjoint discs, one exact root in each.
 * CV_UNDECIDED: discs meet, another number of roots than op has, or sizes outside the range in which
 * double-double keeps its promise. */
cv_status dg_dd_roots_find(dg_dd_roots *roots, const dg_dd_operator *op, const dg_roots *start);

#endif
