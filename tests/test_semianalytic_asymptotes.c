/* Asymptotes of the instability lines against the expansion of Im zeta at q = 0. */
#include <check.h>

#include "semianalytic/kernel.h"
#include "tests/semianalytic_ranges.h"

static double im_over_q3(const sa_track *track, mpfr_srcptr alpha, double q)
{
    cv_number a, f;
    mpc_t zeta;
    cv_number_init(&a);
    cv_number_init(&f);
    mpc_init2(zeta, 64);
    mpfr_get_q(a.factor, alpha);
    mpq_set_d(f.factor, q);
    ck_assert_int_eq(sa_zeta_digits(zeta, track, &a, &f, 8, NULL), CV_OK);
    double value = as_double(mpc_imagref(zeta)) / q / q / q;
    mpc_clear(zeta);
    cv_number_clear(&a);
    cv_number_clear(&f);
    return value;
}

/* Im zeta = c q^3 + d q^5: at a zero of c what is left of Im zeta / q^3 falls by 100 when q does by 10; and c
 * has no other change of sign at 400 velocities over the range. On the last track a column of the map ends at
 * the shear speed of the ballast, where a pole is at infinity. */
START_TEST(asymptotes_are_the_zeros_of_c)
{
    static const char *const damping[] = {"0.1", "1e-4", "1e-10", "1e-10"};
    static const char *const sheared[6] = {"5.39309", "44.5051", "0.189418", "0.440042", "16.2703", "0"};
    const char *const *const values = _i < 3 ? table1[3 - _i % 2] : sheared;
    cv_params p;
    sa_asymptote_list list;
    typed_range r;
    sa_track *track = make_track(values, damping[_i]);
    cv_params_init(&p);
    set_params(&p, values, damping[_i]);
    range_set(&r, "0.02", "2", "1", "10");
    ck_assert_int_eq(sa_asymptotes_find(&list, &p, &r.end[0], &r.end[1], 30, NULL), CV_OK);
    ck_assert_uint_ge(list.count, 1);
    for (size_t i = 0; i < list.count; i++) {
        const sa_asymptote *a = &list.item[i];
        ck_assert_int_eq(a->decided, CV_OK);
        ck_assert_double_le(a->alpha_error, 1e-30 * as_double(a->alpha));
        double coarse = im_over_q3(track, a->alpha, 1e-13), fine = im_over_q3(track, a->alpha, 1e-14);
        ck_assert_double_eq_tol(coarse / fine, 100, 1);
    }
    double last = 0;
    size_t next = 0, changes = 0;
    for (int i = 0; i <= 400; i++) {
        mpfr_t alpha;
        mpfr_init_set_d(alpha, 0.021 + i * (1.978 / 400), MPFR_RNDN);
        double c = im_over_q3(track, alpha, 1e-13);
        size_t passed = 0;
        for (; next < list.count && mpfr_less_p(list.item[next].alpha, alpha); next++)
            passed++;
        if (i > 0)
            ck_assert_int_eq(c * last < 0, passed % 2 == 1);
        changes += passed;
        last = c;
        mpfr_clear(alpha);
    }
    ck_assert_uint_eq(changes, list.count);
    sa_asymptotes_clear(&list);
    range_clear(&r);
    sa_track_free(track);
    cv_params_clear(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic: asymptotes");
    TCase *tests = tcase_create("asymptotes");
    tcase_set_timeout(tests, 60);
    tcase_add_loop_test(tests, asymptotes_are_the_zeros_of_c, 0, 4);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
