/* zeta at doubles in many digits, against which what double precision says is tested. */
#ifndef CRITVEL_TESTS_SEMIANALYTIC_EXACT_H
#define CRITVEL_TESTS_SEMIANALYTIC_EXACT_H

#include "tests/semianalytic_points.h"

/* zeta with many digits at the doubles alpha and q. */
typedef struct {
    mpc_t zeta;
    mpfr_t re_error, im_error, alpha, q;
} exact;

static inline void exact_init(exact *x, mpfr_prec_t bits)
{
    mpc_init2(x->zeta, bits);
    mpfr_inits2(64, x->re_error, x->im_error, (mpfr_ptr)0);
    mpfr_inits2(53, x->alpha, x->q, (mpfr_ptr)0);
}

static inline void exact_clear(exact *x)
{
    mpc_clear(x->zeta);
    mpfr_clears(x->re_error, x->im_error, x->alpha, x->q, (mpfr_ptr)0);
}

static inline cv_status exact_at(exact *x, sa_sweep *sweep, const sa_track *t, double alpha, double q)
{
    mpfr_set_d(x->alpha, alpha, MPFR_RNDN);
    mpfr_set_d(x->q, q, MPFR_RNDN);
    return sa_zeta_mp(x->zeta, x->re_error, x->im_error, sweep, t, x->alpha, x->q);
}

/* |value - part| <= error, up to what the bound of part allows */
static inline int contains(double value, double error, const mpfr_t part, const mpfr_t part_error)
{
    mpfr_t gap;
    mpfr_init2(gap, 300);
    mpfr_sub_d(gap, part, value, MPFR_RNDN);
    mpfr_abs(gap, gap, MPFR_RNDN);
    mpfr_sub(gap, gap, part_error, MPFR_RNDD);
    int result = mpfr_cmp_d(gap, error) <= 0;
    mpfr_clear(gap);
    return result;
}

#endif
