/* Intervals of few bits against exact rational arithmetic: the exact result is always inside. */
#include <check.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

#include "semianalytic/interval.h"
#include "tests/random_track.h"

enum { BITS = 12 };

/* A random interval of few bits and a rational inside it (one of the ends now and then). */
static void random_pair(sa_interval *x, mpq_t inside, gsl_rng *rng)
{
    mpq_t low, high, t;

    mpq_inits(low, high, t, NULL);
    double a = 40 * gsl_rng_uniform(rng) - 20,
           width = gsl_rng_uniform_int(rng, 4) ? 3 * gsl_rng_uniform(rng) : 0;
    mpfr_set_d(x->low, a, MPFR_RNDD);
    mpfr_set_d(x->high, a + width, MPFR_RNDU);
    mpfr_get_q(low, x->low);
    mpfr_get_q(high, x->high);
    mpq_set_ui(t, gsl_rng_uniform_int(rng, 5), 4);
    mpq_canonicalize(t);
    if (mpq_cmp_ui(t, 1, 1) > 0) {
        mpq_set_ui(t, 1, 3);
    }
    mpq_sub(inside, high, low);
    mpq_mul(inside, inside, t);
    mpq_add(inside, inside, low);
    mpq_clears(low, high, t, NULL);
}

static int holds(const sa_interval *x, const mpq_t exact)
{
    return mpfr_cmp_q(x->low, exact) <= 0 && mpfr_cmp_q(x->high, exact) >= 0;
}

START_TEST(exact_results_are_enclosed)
{
    gsl_rng *rng = random_start("intervals", 3);
    sa_interval a, b, c;
    mpq_t x, y, z, n;

    sa_interval_init(&a, BITS);
    sa_interval_init(&b, BITS);
    sa_interval_init(&c, BITS);
    mpq_inits(x, y, z, n, NULL);
    for (int i = 0; i < 20000; i++) {
        random_pair(&a, x, rng);
        random_pair(&b, y, rng);
        mpq_add(z, x, y);
        sa_interval_add(&c, &a, &b);
        ck_assert(holds(&c, z));
        mpq_sub(z, x, y);
        sa_interval_sub(&c, &a, &b);
        ck_assert(holds(&c, z));
        mpq_mul(z, x, y);
        sa_interval_mul(&c, &a, &b);
        ck_assert(holds(&c, z));
        long factor = (long)gsl_rng_uniform_int(rng, 2001) - 1000;
        mpq_set_si(n, factor, 1);
        mpq_mul(z, x, n);
        sa_interval_mul_si(&c, &a, factor);
        ck_assert(holds(&c, z));
        sa_interval_sub(&b, &a, &b); /* output may be an input */
        mpq_sub(z, x, y);
        ck_assert(holds(&b, z));
        int sign = sa_interval_sign(&a);
        ck_assert(sign == 2 || sign == mpq_sgn(x));
    }
    mpq_clears(x, y, z, n, NULL);
    sa_interval_clear(&a);
    sa_interval_clear(&b);
    sa_interval_clear(&c);
    gsl_rng_free(rng);
}
END_TEST

/* 2^(1/4), which no decimal and no rational is */
START_TEST(irrational_numbers_are_enclosed)
{
    cv_number root;
    sa_interval x;
    mpq_t fourth, one;

    cv_number_init(&root);
    mpq_inits(fourth, one, NULL);
    mpq_set_ui(fourth, 2, 1);
    mpq_set_ui(one, 1, 1);
    cv_number_set_root(&root, fourth, one);
    sa_interval_init(&x, BITS);
    sa_interval_set_number(&x, &root);
    for (int i = 0; i < 2; i++) {
        sa_interval_mul(&x, &x, &x);
    }
    ck_assert(holds(&x, fourth));
    ck_assert(!mpfr_equal_p(x.low, x.high));
    mpq_clears(fourth, one, NULL);
    sa_interval_clear(&x);
    cv_number_clear(&root);
}
END_TEST

/* Coefficients 1, ?, -1 have one sign change whatever the unknown is; 1, ?, 1 none or two. */
START_TEST(unknown_signs_widen_the_count)
{
    sa_polynomial p;
    int least, most;

    sa_polynomial_init(&p, BITS);
    p.degree = 2;
    sa_interval_set_si(&p.coefficient[0], 1);
    mpfr_set_si(p.coefficient[1].low, -1, MPFR_RNDD);
    mpfr_set_si(p.coefficient[1].high, 1, MPFR_RNDU);
    sa_interval_set_si(&p.coefficient[2], -1);
    sa_polynomial_variations(&least, &most, &p);
    ck_assert(least == 1 && most == 1);
    sa_interval_set_si(&p.coefficient[2], 1);
    sa_polynomial_variations(&least, &most, &p);
    ck_assert(least == 0 && most == 2);
    sa_polynomial_clear(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic intervals");
    TCase *tests = tcase_create("intervals");

    tcase_add_test(tests, exact_results_are_enclosed);
    tcase_add_test(tests, irrational_numbers_are_enclosed);
    tcase_add_test(tests, unknown_signs_widen_the_count);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
