#include "semianalytic/box.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* 2^exponent, or LDBL_MIN where that is below: radii never vanish by underflow. Without the cost of ldexpl
 * where a double holds it. */
static long double power_of_two(long exponent)
{
    enum { DOUBLE_BIAS = 1023, FRACTION_BITS = 52 };
    if (exponent <= -DOUBLE_BIAS || exponent > DOUBLE_BIAS)
        return fmaxl(ldexpl(1, (int)exponent), LDBL_MIN);
    uint64_t bits = (uint64_t)(exponent + DOUBLE_BIAS) << FRACTION_BITS;
    double result;
    memcpy(&result, &bits, sizeof result);
    return (long double)result;
}

long double sa_magnitude(const mpfr_t x)
{
    if (mpfr_zero_p(x))
        return 0;
    if (!mpfr_number_p(x))
        return INFINITY;
    return power_of_two(mpfr_get_exp(x));
}

/* half a unit in the last place of x */
static long double half_ulp(const mpfr_t x)
{
    if (mpfr_regular_p(x))
        return power_of_two(mpfr_get_exp(x) - mpfr_get_prec(x) - 1);
    return mpfr_zero_p(x) ? 0 : INFINITY;
}

void sa_span_init(sa_span *x, mpfr_prec_t precision)
{
    mpfr_init2(x->m, precision);
    mpfr_set_zero(x->m, 1);
    x->r = 0;
}

void sa_span_clear(sa_span *x)
{
    mpfr_clear(x->m);
}

void sa_span_set_number(sa_span *to, const cv_number *x)
{
    cv_number_get_mpfr(to->m, x);
    int exact = cv_number_is_rational(x) && mpfr_cmp_q(to->m, x->factor) == 0;
    to->r = exact ? 0 : 2 * half_ulp(to->m);
}

void sa_span_set(sa_span *to, const mpfr_t x)
{
    int inexact = mpfr_set(to->m, x, MPFR_RNDN);
    to->r = inexact ? half_ulp(to->m) : 0;
}

void sa_box_init(sa_box *x, mpfr_prec_t precision)
{
    mpc_init2(x->m, precision);
    sa_box_zero(x);
}

void sa_box_clear(sa_box *x)
{
    mpc_clear(x->m);
}

void sa_box_zero(sa_box *to)
{
    mpc_set_ui(to->m, 0, MPC_RNDNN);
    to->re_rad = to->im_rad = 0;
}

/* Stores the radii with the rounding errors of a midpoint that was just computed. */
static void finish(sa_box *to, long double re_rad, long double im_rad)
{
    to->re_rad = re_rad + half_ulp(mpc_realref(to->m));
    to->im_rad = im_rad + half_ulp(mpc_imagref(to->m));
}

void sa_box_set(sa_box *to, const sa_box *x)
{
    mpc_set(to->m, x->m, MPC_RNDNN);
    to->re_rad = x->re_rad;
    to->im_rad = x->im_rad;
}

void sa_box_set_real(sa_box *to, const sa_span *x)
{
    mpc_set_fr(to->m, x->m, MPC_RNDNN);
    to->re_rad = x->r;
    to->im_rad = 0;
}

void sa_box_add(sa_box *to, const sa_box *a, const sa_box *b)
{
    mpc_add(to->m, a->m, b->m, MPC_RNDNN);
    finish(to, a->re_rad + b->re_rad, a->im_rad + b->im_rad);
}

void sa_box_sub(sa_box *to, const sa_box *a, const sa_box *b)
{
    mpc_sub(to->m, a->m, b->m, MPC_RNDNN);
    finish(to, a->re_rad + b->re_rad, a->im_rad + b->im_rad);
}

void sa_box_add_real(sa_box *to, const sa_box *a, const sa_span *b)
{
    mpc_add_fr(to->m, a->m, b->m, MPC_RNDNN);
    to->re_rad = a->re_rad + b->r + half_ulp(mpc_realref(to->m));
    to->im_rad = a->im_rad;
}

void sa_box_mul(sa_box *to, const sa_box *a, const sa_box *b)
{
    long double a_re = sa_magnitude(mpc_realref(a->m)), a_im = sa_magnitude(mpc_imagref(a->m));
    long double b_re = sa_magnitude(mpc_realref(b->m)) + b->re_rad;
    long double b_im = sa_magnitude(mpc_imagref(b->m)) + b->im_rad;
    long double re_rad = a_re * b->re_rad + a->re_rad * b_re + a_im * b->im_rad + a->im_rad * b_im;
    long double im_rad = a_re * b->im_rad + a->re_rad * b_im + a_im * b->re_rad + a->im_rad * b_re;
    mpc_mul(to->m, a->m, b->m, MPC_RNDNN);
    finish(to, re_rad, im_rad);
}

void sa_box_sqr(sa_box *to, const sa_box *a)
{
    long double re = sa_magnitude(mpc_realref(a->m)), im = sa_magnitude(mpc_imagref(a->m));
    long double re_rad = a->re_rad * (2 * re + a->re_rad) + a->im_rad * (2 * im + a->im_rad);
    long double im_rad = 2 * (re * a->im_rad + a->re_rad * (im + a->im_rad));
    mpc_sqr(to->m, a->m, MPC_RNDNN);
    finish(to, re_rad, im_rad);
}

void sa_box_scale(sa_box *to, const sa_box *a, const sa_span *b)
{
    long double size = sa_magnitude(b->m) + b->r;
    long double re_rad = a->re_rad * size + sa_magnitude(mpc_realref(a->m)) * b->r;
    long double im_rad = a->im_rad * size + sa_magnitude(mpc_imagref(a->m)) * b->r;
    mpc_mul_fr(to->m, a->m, b->m, MPC_RNDNN);
    finish(to, re_rad, im_rad);
}

void sa_box_shift(sa_box *to, const sa_box *a, int power)
{
    mpc_mul_2si(to->m, a->m, power, MPC_RNDNN);
    to->re_rad = ldexpl(a->re_rad, power);
    to->im_rad = ldexpl(a->im_rad, power);
}

void sa_box_neg(sa_box *to, const sa_box *a)
{
    mpc_neg(to->m, a->m, MPC_RNDNN);
    to->re_rad = a->re_rad;
    to->im_rad = a->im_rad;
}

void sa_box_times_i(sa_box *to, const sa_box *a)
{
    long double re_rad = a->im_rad, im_rad = a->re_rad;
    mpc_mul_i(to->m, a->m, 1, MPC_RNDNN);
    to->re_rad = re_rad;
    to->im_rad = im_rad;
}

/* e^m (e^d - 1) with |d| <= re_rad + im_rad bounds both parts */
void sa_box_exp(sa_box *to, const sa_box *a)
{
    long double growth = expm1l(a->re_rad + a->im_rad) * (1 + 0x1p-60L);
    mpc_exp(to->m, a->m, MPC_RNDNN);
    long double size = sa_magnitude(mpc_realref(to->m)) + sa_magnitude(mpc_imagref(to->m));
    finish(to, size * growth, size * growth);
}

/* The quotient of the midpoints q is correctly rounded; (a + da)/(b + db) - a/b = (da - q db)/(b + db), and
 * the right side is bounded part by part through (da - q db) conj(b + db) / |b + db|^2. */
int sa_box_div(sa_box *to, const sa_box *a, const sa_box *b)
{
    long double b_re = sa_magnitude(mpc_realref(b->m)), b_im = sa_magnitude(mpc_imagref(b->m));
    long double low_re = b_re / 2 - b->re_rad * SA_BOX_INFLATE,
                low_im = b_im / 2 - b->im_rad * SA_BOX_INFLATE;
    long double least = (low_re > 0 ? low_re * low_re : 0) + (low_im > 0 ? low_im * low_im : 0);
    least *= 1 - 0x1p-60L;
    if (!(least > 0))
        return 0;
    long double top_re_rad = a->re_rad, top_im_rad = a->im_rad;
    long double b_re_rad = b->re_rad, b_im_rad = b->im_rad;
    mpc_div(to->m, a->m, b->m, MPC_RNDNN);
    long double q_re = sa_magnitude(mpc_realref(to->m)), q_im = sa_magnitude(mpc_imagref(to->m));
    top_re_rad += q_re * b_re_rad + q_im * b_im_rad;
    top_im_rad += q_re * b_im_rad + q_im * b_re_rad;
    b_re += b_re_rad;
    b_im += b_im_rad;
    finish(to, (top_re_rad * b_re + top_im_rad * b_im) / least,
           (top_im_rad * b_re + top_re_rad * b_im) / least);
    return mpfr_number_p(mpc_realref(to->m)) && mpfr_number_p(mpc_imagref(to->m));
}

long double sa_box_spread(const sa_box *a)
{
    long double radius = a->re_rad + a->im_rad;
    long double size = (sa_magnitude(mpc_realref(a->m)) + sa_magnitude(mpc_imagref(a->m))) / 2;
    return radius > 0 ? radius / size : 0;
}

/* |x - y| > bound, proven by directed rounding */
static int apart(const mpfr_t x, const mpfr_t y, long double bound)
{
    mpfr_t gap;
    mpfr_init2(gap, 64);
    mpfr_sub(gap, x, y, MPFR_RNDZ);
    mpfr_abs(gap, gap, MPFR_RNDZ);
    int result = mpfr_cmp_ld(gap, bound * SA_BOX_INFLATE) > 0;
    mpfr_clear(gap);
    return result;
}

int sa_box_disjoint(const sa_box *a, const sa_box *b)
{
    return apart(mpc_realref(a->m), mpc_realref(b->m), a->re_rad + b->re_rad) ||
           apart(mpc_imagref(a->m), mpc_imagref(b->m), a->im_rad + b->im_rad);
}
