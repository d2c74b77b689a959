/* K by quadrature along the real axis against the sum over poles: routes without a common step. */
#include <check.h>
#include <gsl/gsl_errno.h>
#include <math.h>

#include "semianalytic/kernel.h"
#include "semianalytic/quadrature.h"
#include "tests/semianalytic_points.h"

static gsl_rng *rng;

static void setup(void)
{
    rng = random_start("test_semianalytic_quadrature", 5);
    gsl_set_error_handler_off();
}

static void teardown(void)
{
    gsl_rng_free(rng);
}

static double complex by_poles(const sa_track *t, double alpha, double q, double xi)
{
    cv_number numbers[3];
    const double values[3] = {alpha, q, xi};
    mpc_t zeta, kernel;
    mpc_init2(zeta, 53);
    mpc_init2(kernel, 53);
    for (int i = 0; i < 3; i++) {
        cv_number_init(&numbers[i]);
        mpq_set_d(numbers[i].factor, values[i]);
    }
    ck_assert_int_eq(sa_kernel_digits(zeta, kernel, t, &numbers[0], &numbers[1], &numbers[2], 17, NULL),
                     CV_OK);
    double complex result =
        CMPLX(mpfr_get_d(mpc_realref(kernel), MPFR_RNDN), mpfr_get_d(mpc_imagref(kernel), MPFR_RNDN));
    for (int i = 0; i < 3; i++)
        cv_number_clear(&numbers[i]);
    mpc_clear(zeta);
    mpc_clear(kernel);
    return result;
}

static int compare(const sa_track *t, double alpha, double q, double xi)
{
    double complex kernel, expected = by_poles(t, alpha, q, xi);
    double error;
    cv_status status = sa_quadrature_kernel(&kernel, &error, t, alpha, q, xi, 1e-9, NULL);
    ck_assert(status == CV_OK || status == CV_UNDECIDED);
    if (status == CV_OK)
        ck_assert_msg(cabs(kernel - expected) <= 10 * error + 1e-12 * cabs(expected),
                      "alpha %g q %g xi %g: %g %g not %g %g +- %.1e", alpha, q, xi, creal(kernel),
                      cimag(kernel), creal(expected), cimag(expected), error);
    return status == CV_OK;
}

START_TEST(cases_of_the_paper)
{
    const double velocities[] = {0.05, 0.3, 0.5, 1.2}, frequencies[] = {0, 0.01, 0.22, -2},
                 places[] = {0, 1.5, -2};
    int done = 0;
    for (int c = 0; c < 4; c++) {
        sa_track *t = make_track(table1[c], "0.1");
        for (int i = 0; i < 48; i++)
            done += compare(t, velocities[i % 4], frequencies[i / 4 % 4], places[i / 16]);
        sa_track_free(t);
    }
    ck_assert_int_eq(done, 4 * 48);
}
END_TEST

START_TEST(random_tracks)
{
    enum { TRACKS = 60 };
    int done = 0;
    for (int i = 0; i < TRACKS; i++) {
        cv_params p;
        sa_track *t;
        double alpha = log_uniform(rng, 0.05, 2), q = log_uniform(rng, 1e-3, 5);
        cv_params_init(&p);
        random_track(&p, rng);
        set_decimal(&p.eta_p, log_uniform(rng, 1e-2, 0.2));
        set_decimal(&p.eta_b, log_uniform(rng, 1e-2, 0.2));
        set_decimal(&p.eta_f, log_uniform(rng, 1e-2, 0.2));
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        done += compare(t, alpha, q, i % 2 ? 0 : gsl_rng_uniform(rng) - 0.5);
        sa_track_free(t);
        cv_params_clear(&p);
    }
    printf("quadrature: %d of %d random tracks within the tolerance\n", done, TRACKS);
    ck_assert_int_ge(done, TRACKS * 3 / 4);
}
END_TEST

START_TEST(what_it_cannot_do_is_refused)
{
    sa_track *undamped = make_track(table1[0], "0"), *damped = make_track(table1[0], "0.1");
    double complex kernel;
    double error;
    ck_assert_int_eq(sa_quadrature_kernel(&kernel, &error, undamped, 0.3, 0.2, 0, 1e-9, NULL), CV_BAD_INPUT);
    ck_assert_int_eq(sa_quadrature_kernel(&kernel, &error, damped, -0.3, 0.2, 0, 1e-9, NULL), CV_BAD_INPUT);
    ck_assert_int_eq(sa_quadrature_kernel(&kernel, &error, damped, 0.3, NAN, 0, 1e-9, NULL), CV_BAD_INPUT);
    ck_assert_int_eq(sa_quadrature_kernel(&kernel, &error, damped, 0.3, 0.2, 0, 1e-20, NULL), CV_BAD_INPUT);
    sa_track_free(undamped);
    sa_track_free(damped);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic quadrature");
    TCase *tests = tcase_create("quadrature");
    tcase_add_checked_fixture(tests, setup, teardown);
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, cases_of_the_paper);
    tcase_add_test(tests, random_tracks);
    tcase_add_test(tests, what_it_cannot_do_is_refused);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
