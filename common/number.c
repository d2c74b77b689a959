#include "common/number.h"

#include <math.h>

/* get_mpfr takes this many bits more than the caller: the root and the product then cost less than 2^-60 ulp
 * beside the final rounding. */
enum { GUARD_BITS = 64 };

void cv_number_init(cv_number *x)
{
    mpq_init(x->factor);
    mpq_init(x->radicand);
    mpq_set_ui(x->radicand, 1, 1);
}

void cv_number_clear(cv_number *x)
{
    mpq_clear(x->factor);
    mpq_clear(x->radicand);
}

void cv_number_set(cv_number *to, const cv_number *from)
{
    mpq_set(to->factor, from->factor);
    mpq_set(to->radicand, from->radicand);
}

int cv_number_is_rational(const cv_number *x)
{
    return mpq_cmp_ui(x->radicand, 1, 1) == 0;
}

/* A radicand that is the fourth power of a rational moves into the factor, so that what is rational is stored
 * as rational; zero is stored with radicand 1. */
static void normalise(cv_number *x)
{
    if (mpq_sgn(x->factor) == 0) {
        mpq_set_ui(x->radicand, 1, 1);
        return;
    }
    mpq_t root;
    mpq_init(root);
    if (mpz_root(mpq_numref(root), mpq_numref(x->radicand), 4) != 0 &&
        mpz_root(mpq_denref(root), mpq_denref(x->radicand), 4) != 0) {
        mpq_mul(x->factor, x->factor, root); /* lowest terms: roots of coprimes are coprime */
        mpq_set_ui(x->radicand, 1, 1);
    }
    mpq_clear(root);
}

void cv_number_set_root(cv_number *to, const mpq_t n, const mpq_t d)
{
    mpq_div(to->radicand, n, d);
    mpq_set_ui(to->factor, 1, 1);
    normalise(to);
}

void cv_number_mul(cv_number *to, const cv_number *x, const cv_number *y)
{
    mpq_mul(to->factor, x->factor, y->factor);
    mpq_mul(to->radicand, x->radicand, y->radicand);
    normalise(to);
}

void cv_number_div(cv_number *to, const cv_number *x, const cv_number *y)
{
    mpq_div(to->factor, x->factor, y->factor);
    mpq_div(to->radicand, x->radicand, y->radicand);
    normalise(to);
}

int cv_number_sign(const cv_number *x)
{
    return mpq_sgn(x->factor);
}

/* out = x^4 */
static void fourth_power(mpq_t out, const cv_number *x)
{
    mpq_mul(out, x->factor, x->factor);
    mpq_mul(out, out, out);
    mpq_mul(out, out, x->radicand);
}

int cv_number_compare(const cv_number *x, const cv_number *y)
{
    const int sign_x = cv_number_sign(x), sign_y = cv_number_sign(y);
    if (sign_x != sign_y)
        return sign_x < sign_y ? -1 : 1;
    if (sign_x == 0)
        return 0;
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    fourth_power(a, x);
    fourth_power(b, y);
    const int c = mpq_cmp(a, b) * sign_x;
    mpq_clears(a, b, NULL);
    return (c > 0) - (c < 0);
}

void cv_number_get_mpfr(mpfr_t out, const cv_number *x)
{
    if (cv_number_is_rational(x)) {
        mpfr_set_q(out, x->factor, MPFR_RNDN);
        return;
    }
    mpfr_t t;
    mpfr_init2(t, mpfr_get_prec(out) + GUARD_BITS);
    mpfr_set_q(t, x->radicand, MPFR_RNDN);
    mpfr_rootn_ui(t, t, 4, MPFR_RNDN);
    mpfr_mul_q(t, t, x->factor, MPFR_RNDN);
    mpfr_set(out, t, MPFR_RNDN);
    mpfr_clear(t);
}

double cv_number_get_double(const cv_number *x)
{
    mpfr_t t;
    mpfr_init2(t, 53);
    cv_number_get_mpfr(t, x);
    const double d = mpfr_get_d(t, MPFR_RNDN);
    mpfr_clear(t);
    return d;
}

int cv_number_fits_double(const cv_number *x)
{
    const double size = fabs(cv_number_get_double(x));
    return cv_number_sign(x) == 0 || (size >= 1e-300 && size <= 1e300);
}
