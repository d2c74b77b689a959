/* Delta and R (dgreen/operator.h) in double-double. */
#ifndef CRITVEL_DGREEN_OPERATOR_DD_H
#define CRITVEL_DGREEN_OPERATOR_DD_H

#include "dgreen/dd.h"
#include "dgreen/operator.h"

/* Same storage and the same units of error as dg_operator, with u = DG_DD_UNIT. */
typedef struct {
    dg_dd_complex delta[DG_DEGREE + 1], r[DG_R_DEGREE + 1];
    dg_operator rounded; /* in double, with sizes and degree */
} dg_dd_operator;

/* Any alpha >= 0 and any qbar. CV_UNDECIDED: numbers so large or small that products might leave the range of
 * doubles. */
cv_status dg_dd_operator_set(dg_dd_operator *op, const dg_track *t, double alpha, double complex qbar);

#endif
