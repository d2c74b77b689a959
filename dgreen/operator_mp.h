/* Delta and R (dgreen/operator.h) at any precision. */
#ifndef CRITVEL_DGREEN_OPERATOR_MP_H
#define CRITVEL_DGREEN_OPERATOR_MP_H

#include <mpc.h>

#include "dgreen/operator.h"

/* A polynomial in y, ascending */
typedef struct {
    mpc_t c[DG_DEGREE + 1];
} dg_mp_polynomial;

/* Same storage and the same units of error as dg_operator, with u = 2^-precision. */
typedef struct {
    mpfr_prec_t precision;
    dg_mp_polynomial delta, r;
    dg_operator rounded; /* the coefficients rounded to double, with sizes and degree */
    /* scratch */
    dg_mp_polynomial beam, pad, sleeper, ballast, foundation, c, inner;
    mpc_t w, w2, product;
    mpfr_t coefficient;
} dg_mp_operator;

void dg_mp_operator_init(dg_mp_operator *op, mpfr_prec_t precision);
void dg_mp_operator_clear(dg_mp_operator *op);

/* alpha >= 0, any qbar. constants must have the operator's precision; track serves the doubles. */
void dg_mp_operator_set(dg_mp_operator *op, const dg_track *track, const dg_constants *constants,
                        mpfr_srcptr alpha, mpc_srcptr qbar);

#endif
