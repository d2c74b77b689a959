#include "semianalytic/interval.h"

void sa_interval_init(sa_interval *x, mpfr_prec_t precision)
{
    mpfr_init2(x->low, precision);
    mpfr_init2(x->high, precision);
    sa_interval_set_si(x, 0);
}

void sa_interval_clear(sa_interval *x)
{
    mpfr_clear(x->low);
    mpfr_clear(x->high);
}

void sa_interval_set(sa_interval *to, const sa_interval *x)
{
    mpfr_set(to->low, x->low, MPFR_RNDD);
    mpfr_set(to->high, x->high, MPFR_RNDU);
}

void sa_interval_set_si(sa_interval *to, long x)
{
    mpfr_set_si(to->low, x, MPFR_RNDD);
    mpfr_set_si(to->high, x, MPFR_RNDU);
}

void sa_interval_set_mpfr(sa_interval *to, const mpfr_t x)
{
    mpfr_set(to->low, x, MPFR_RNDD);
    mpfr_set(to->high, x, MPFR_RNDU);
}

void sa_interval_set_number(sa_interval *to, const cv_number *x)
{
    if (cv_number_is_rational(x)) {
        mpfr_set_q(to->low, x->factor, MPFR_RNDD);
        mpfr_set_q(to->high, x->factor, MPFR_RNDU);
    } else {
        /* faithful: the neighbours enclose */
        cv_number_get_mpfr(to->low, x);
        mpfr_set(to->high, to->low, MPFR_RNDU);
        mpfr_nextbelow(to->low);
        mpfr_nextabove(to->high);
    }
}

void sa_interval_add(sa_interval *to, const sa_interval *a, const sa_interval *b)
{
    mpfr_add(to->low, a->low, b->low, MPFR_RNDD);
    mpfr_add(to->high, a->high, b->high, MPFR_RNDU);
}

void sa_interval_sub(sa_interval *to, const sa_interval *a, const sa_interval *b)
{
    mpfr_t low;

    mpfr_init2(low, mpfr_get_prec(to->low));
    mpfr_sub(low, a->low, b->high, MPFR_RNDD);
    mpfr_sub(to->high, a->high, b->low, MPFR_RNDU);
    mpfr_swap(to->low, low);
    mpfr_clear(low);
}

void sa_interval_mul(sa_interval *to, const sa_interval *a, const sa_interval *b)
{
    mpfr_t low, high, t;

    mpfr_inits2(mpfr_get_prec(to->low), low, high, t, (mpfr_ptr)0);
    mpfr_mul(low, a->low, b->low, MPFR_RNDD);
    mpfr_mul(high, a->low, b->low, MPFR_RNDU);
    for (int corner = 1; corner < 4; corner++) {
        const __mpfr_struct *u = corner & 1 ? a->high : a->low;
        const __mpfr_struct *v = corner & 2 ? b->high : b->low;
        mpfr_mul(t, u, v, MPFR_RNDD);
        mpfr_min(low, low, t, MPFR_RNDD);
        mpfr_mul(t, u, v, MPFR_RNDU);
        mpfr_max(high, high, t, MPFR_RNDU);
    }
    mpfr_swap(to->low, low);
    mpfr_swap(to->high, high);
    mpfr_clears(low, high, t, (mpfr_ptr)0);
}

void sa_interval_mul_si(sa_interval *to, const sa_interval *a, long b)
{
    sa_interval_set(to, a);
    if (b < 0) {
        mpfr_swap(to->low, to->high);
    }
    mpfr_mul_si(to->low, to->low, b, MPFR_RNDD);
    mpfr_mul_si(to->high, to->high, b, MPFR_RNDU);
}

void sa_interval_shift(sa_interval *to, const sa_interval *a, long power)
{
    mpfr_mul_2si(to->low, a->low, power, MPFR_RNDD);
    mpfr_mul_2si(to->high, a->high, power, MPFR_RNDU);
}

int sa_interval_sign(const sa_interval *x)
{
    int low = mpfr_sgn(x->low), high = mpfr_sgn(x->high);

    if (mpfr_nan_p(x->low) || mpfr_nan_p(x->high)) {
        return 2;
    }
    if (low > 0) {
        return 1;
    }
    if (high < 0) {
        return -1;
    }
    return low == 0 && high == 0 ? 0 : 2;
}
