/* The roots of Delta at any precision, by the simultaneous (Ehrlich-Aberth) iteration, with inclusion discs.
 */
#ifndef CRITVEL_DGREEN_ROOTS_MP_H
#define CRITVEL_DGREEN_ROOTS_MP_H

#include "dgreen/operator_mp.h"
#include "dgreen/roots.h"

typedef struct {
    mpfr_prec_t precision;
    double unit; /* 2^-precision, 0 where that underflows */
    int count, far;
    mpc_t y[DG_DEGREE];     /* approximations; slot count-1 holds u = 1/y where far is set */
    mpc_t slope[DG_DEGREE]; /* d Delta(i y)/dy there; of the reversed polynomial for the far root */
    double radius[DG_DEGREE], slope_relative[DG_DEGREE], crowding[DG_DEGREE]; /* see dg_separate */
    /* scratch */
    mpc_t value, derivative, step;
    mpfr_t t[4], difference;
} dg_mp_roots;

void dg_mp_roots_init(dg_mp_roots *roots, mpfr_prec_t precision);
void dg_mp_roots_clear(dg_mp_roots *roots);

/* Starts from the double values, which may be poor, and iterates until the precision is used up or
 * must be in vain. on_axis: coefficients are real (no damping, imaginary qbar); then approximations whose
 * imaginary part is mere rounding are put on the real axis.
 * CV_OK: disjoint discs, one exact root in each, on the axis for an approximation that is. CV_UNDECIDED:
 * discs meet. CV_FAILED: start has another number of roots than op. */
cv_status dg_mp_roots_find(dg_mp_roots *roots, const dg_mp_operator *op, const dg_roots *start, int on_axis);

/* v + s y etc. by raw mpfr: value = value * y + c, all of the roots' precision. */
void dg_mp_horner(mpc_ptr value, mpc_srcptr y, mpc_srcptr c, mpfr_t t[4]);

/* |x| in units 2^-precision; an overflow gives infinity. */
double dg_mp_units(mpc_srcptr x, mpfr_prec_t precision);
/* |x| as a double */
double dg_mp_modulus(mpc_srcptr x);

#endif
