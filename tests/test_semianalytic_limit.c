/* zeta of undamped tracks, the limit q - i0: in double precision against MPFR, against damping that tends to
 * zero, and that every track radiates at every velocity. */
#include <check.h>
#include <math.h>

#include "tests/semianalytic_exact.h"

static gsl_rng *rng;
static sa_sweep *sweep;

static void setup(void)
{
    rng = random_start("test_semianalytic_limit", 20240923);
    sweep = sa_sweep_new();
    ck_assert_ptr_nonnull(sweep);
}

static void teardown(void)
{
    gsl_rng_free(rng);
    sa_sweep_free(sweep);
}

static sa_track *random_undamped(double *alpha, double *q)
{
    cv_params p;
    sa_track *t = NULL;
    cv_params_init(&p);
    random_track(&p, rng);
    random_point(alpha, q, &p, rng);
    ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
    cv_params_clear(&p);
    return t;
}

START_TEST(bounds_of_double_contain_many_digits)
{
    enum { POINTS = 1500 };
    exact x;
    int compared = 0;
    exact_init(&x, 255);
    for (int i = 0; i < POINTS; i++) {
        double alpha, q;
        sa_track *t = random_undamped(&alpha, &q);
        sa_value v;
        if (sa_zeta_double(&v, sweep, t, alpha, q) == CV_OK && exact_at(&x, sweep, t, alpha, q) == CV_OK) {
            ck_assert_msg(contains(v.re, v.re_error, mpc_realref(x.zeta), x.re_error) &&
                              contains(v.im, v.im_error, mpc_imagref(x.zeta), x.im_error),
                          "case %d: alpha %.17g q %.17g: %.17g +- %.1e %.17g +- %.1e", i, alpha, q, v.re,
                          v.re_error, v.im, v.im_error);
            compared++;
        }
        sa_track_free(t);
    }
    printf("bounds: %d of %d compared\n", compared, POINTS);
    ck_assert_int_ge(compared, POINTS * 9 / 10);
    exact_clear(&x);
}
END_TEST

/* Bounds that are useless would pass the test above. Im zeta is a sum of terms of known sign: it is known
 * wherever it is not itself a difference. */
START_TEST(bounds_are_narrow_on_the_cases_of_the_paper)
{
    int points = 0, wide = 0;
    for (int c = 0; c < 4; c++) {
        sa_track *t = make_track(table1[c], "0");
        for (int i = 0; i < 40; i++)
            for (int j = 0; j < 40; j++) {
                sa_value v;
                ck_assert_int_eq(sa_zeta_double(&v, sweep, t, 0.1 + 0.035 * i, 1e-3 * pow(1e4, j / 39.0)),
                                 CV_OK);
                wide += !(v.im_error <= 1e-6 * fabs(v.im)) || !(v.re_error <= 1e-6 * fabs(v.re));
                points++;
            }
        sa_track_free(t);
    }
    printf("narrow: %d of %d points with a part known worse than to 1e-6\n", wide, points);
    ck_assert_int_le(wide, points / 200);
}
END_TEST

/* Central differences at a distance in which the poles of the sweep are still near. */
START_TEST(slopes_are_those_of_differences)
{
    int compared = 0;
    for (int i = 0; i < 300; i++) {
        double alpha = log_uniform(rng, 0.1, 2), q = log_uniform(rng, 1e-2, 5), h = 1e-6;
        sa_track *t = make_track(table1[i % 4], "0");
        sa_value v, a[2], b[2];
        if (sa_zeta_double(&v, sweep, t, alpha, q) == CV_OK &&
            sa_zeta_double(&a[0], sweep, t, alpha * (1 - h), q) == CV_OK &&
            sa_zeta_double(&a[1], sweep, t, alpha * (1 + h), q) == CV_OK &&
            sa_zeta_double(&b[0], sweep, t, alpha, q * (1 - h)) == CV_OK &&
            sa_zeta_double(&b[1], sweep, t, alpha, q * (1 + h)) == CV_OK) {
            double complex along_alpha = CMPLX(a[1].re - a[0].re, a[1].im - a[0].im) / (2 * h * alpha);
            double complex along_q = CMPLX(b[1].re - b[0].re, b[1].im - b[0].im) / (2 * h * q);
            double scale = cabs(along_alpha) + cabs(along_q) + 1e-6;
            compared += cabs(along_alpha - v.d_alpha) < 1e-4 * scale && cabs(along_q - v.d_q) < 1e-4 * scale;
        }
        sa_track_free(t);
    }
    printf("slopes: %d of 300\n", compared); /* not where a branch point is within reach of the differences */
    ck_assert_int_ge(compared, 270);
}
END_TEST

/* A damped track has other poles (none is real), other sums (over two or three poles) and other code: at
 * damping 1e-40 it differs from the limit by 1e-40 over the distance to the nearest branch point. */
START_TEST(damping_that_tends_to_zero_leads_there)
{
    enum { POINTS = 200 };
    int compared = 0;
    exact limit, damped;
    exact_init(&limit, 511);
    exact_init(&damped, 511);
    for (int i = 0; i < POINTS; i++) {
        cv_params p;
        sa_track *t[2];
        double alpha, q;
        cv_params_init(&p);
        random_track(&p, rng);
        random_point(&alpha, &q, &p, rng);
        ck_assert_int_eq(sa_track_new(&t[0], &p, NULL), CV_OK);
        set_damping(&p, "1e-40", "3e-40", "2e-40");
        ck_assert_int_eq(sa_track_new(&t[1], &p, NULL), CV_OK);
        if (exact_at(&limit, sweep, t[0], alpha, q) == CV_OK &&
            exact_at(&damped, sweep, t[1], alpha, q) == CV_OK) {
            double re = mpfr_get_d(mpc_realref(limit.zeta), MPFR_RNDN);
            double im = mpfr_get_d(mpc_imagref(limit.zeta), MPFR_RNDN);
            double scale = 1e-28 * (fabs(re) + fabs(im));
            ck_assert_msg(
                contains(re, 1e-12 * fabs(re) + scale, mpc_realref(damped.zeta), damped.re_error) &&
                    contains(im, 1e-12 * fabs(im) + scale, mpc_imagref(damped.zeta), damped.im_error),
                "case %d: alpha %.17g q %.17g", i, alpha, q);
            compared++;
        }
        sa_track_free(t[0]);
        sa_track_free(t[1]);
        cv_params_clear(&p);
    }
    printf("limit: %d of %d compared\n", compared, POINTS);
    ck_assert_int_ge(compared, POINTS * 9 / 10);
    exact_clear(&limit);
    exact_clear(&damped);
}
END_TEST

/* The sleepers alone, between rail and ballast at rest, swing at sqrt((kappa_p + kappa_b)/mu_s): a wave
 * number (q -+ that)/alpha far along the flat branch is always met, once with either sign of q - alpha p. So
 * there is no silent region, with shear stiffness of the ballast neither, though the radiation may be tiny.
 */
START_TEST(no_track_is_silent)
{
    int tiny = 0;
    exact x;
    exact_init(&x, 1023);
    for (int i = 0; i < 300; i++) {
        double alpha, q;
        sa_track *t = random_undamped(&alpha, &q);
        if (exact_at(&x, sweep, t, alpha, q) == CV_OK) {
            ck_assert(mpfr_cmpabs(mpc_imagref(x.zeta), x.im_error) > 0);
            tiny += fabs(mpfr_get_d(mpc_imagref(x.zeta), MPFR_RNDN)) < 1e-10;
        }
        sa_track_free(t);
    }
    printf("radiation below 1e-10 at %d of 300 points\n", tiny);
    exact_clear(&x);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic limit of no damping");
    TCase *tests = tcase_create("limit");
    tcase_add_checked_fixture(tests, setup, teardown);
    tcase_add_test(tests, bounds_of_double_contain_many_digits);
    tcase_add_test(tests, bounds_are_narrow_on_the_cases_of_the_paper);
    tcase_add_test(tests, slopes_are_those_of_differences);
    tcase_add_test(tests, damping_that_tends_to_zero_leads_there);
    tcase_add_test(tests, no_track_is_silent);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
