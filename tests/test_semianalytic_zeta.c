/* zeta(alpha, q) in double precision and beyond: the bounds it states, its slopes, symmetry and known values.
 */
#include <check.h>
#include <float.h>
#include <math.h>

#include "tests/semianalytic_exact.h"

static gsl_rng *rng;
static sa_sweep *sweep;

static void setup(void)
{
    rng = random_start("test_semianalytic_zeta", 20240917);
    sweep = sa_sweep_new();
    ck_assert_ptr_nonnull(sweep);
}

static void teardown(void)
{
    gsl_rng_free(rng);
    sa_sweep_free(sweep);
}

static void random_case(cv_params *p, double *alpha, double *q)
{
    random_track(p, rng);
    random_damping(p, rng);
    random_point(alpha, q, p, rng);
}

/* The promise of the header, at points of every kind: thousands with 1e-12 from a branch point or from
 * alpha^2 mu_b = eta_s among them. */
START_TEST(bounds_of_double_contain_many_digits)
{
    enum { TRACKS = 250, POINTS = 10 };
    cv_params p;
    exact x;
    int compared = 0, undecided = 0;
    cv_params_init(&p);
    exact_init(&x, 255);
    for (int i = 0; i < TRACKS * POINTS; i++) {
        double alpha, q;
        sa_track *t;
        sa_value v;
        random_case(&p, &alpha, &q);
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        cv_status status = sa_zeta_double(&v, sweep, t, alpha, q);
        if (status == CV_OK && exact_at(&x, sweep, t, alpha, q) == CV_OK) {
            ck_assert_msg(contains(v.re, v.re_error, mpc_realref(x.zeta), x.re_error) &&
                              contains(v.im, v.im_error, mpc_imagref(x.zeta), x.im_error),
                          "case %d: alpha %.17g q %.17g: %.17g +- %.1e %.17g +- %.1e", i, alpha, q, v.re,
                          v.re_error, v.im, v.im_error);
            compared++;
        }
        undecided += status == CV_UNDECIDED;
        sa_track_free(t);
    }
    printf("bounds: %d compared, %d undecided in double\n", compared, undecided);
    ck_assert_int_ge(compared, TRACKS * POINTS * 9 / 10);
    exact_clear(&x);
    cv_params_clear(&p);
}
END_TEST

/* Bounds that are useless would pass the test above. */
START_TEST(bounds_are_narrow_on_the_cases_of_the_paper)
{
    const char *const dampings[] = {"0.1", "1e-4", "1e-10"};
    int points = 0, wide = 0;
    for (int c = 0; c < 4; c++)
        for (int level = 0; level < 3; level++) {
            sa_track *t = make_track(table1[c], dampings[level]);
            for (int i = 0; i < 40; i++)
                for (int j = 0; j < 40; j++) {
                    sa_value v;
                    ck_assert_int_eq(sa_zeta_double(&v, sweep, t, 0.1 + 0.035 * i, 1e-3 * pow(1e4, j / 39.0)),
                                     CV_OK);
                    ck_assert(v.re_error <= 1e-8 * (fabs(v.re) + fabs(v.im)));
                    ck_assert(v.im_error <= 1e-8 * (fabs(v.re) + fabs(v.im)));
                    wide += !(v.im_error <= 1e-6 * fabs(v.im)) || !(v.re_error <= 1e-6 * fabs(v.re));
                    points++;
                }
            sa_track_free(t);
        }
    sa_counts counts = sa_sweep_counts(sweep);
    printf("narrow: %d of %d points wider than 1e-6 of the part; %lu cold starts\n", wide, points,
           counts.cold_starts);
    ck_assert_int_lt(wide, points / 50);
    ck_assert_uint_lt(counts.cold_starts, counts.evaluations / 4);
}
END_TEST

/* The state of the sweep must not matter. */
START_TEST(a_sweep_from_elsewhere_gives_the_same_value)
{
    cv_params p;
    cv_params_init(&p);
    for (int i = 0; i < 500; i++) {
        double alpha, q;
        sa_track *t;
        sa_value warm, cold;
        random_case(&p, &alpha, &q);
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        sa_sweep *fresh = sa_sweep_new();
        if (sa_zeta_double(&warm, sweep, t, alpha, q) == CV_OK &&
            sa_zeta_double(&cold, fresh, t, alpha, q) == CV_OK) {
            ck_assert(fabs(warm.re - cold.re) <= warm.re_error + cold.re_error);
            ck_assert(fabs(warm.im - cold.im) <= warm.im_error + cold.im_error);
        }
        sa_sweep_free(fresh);
        sa_track_free(t);
    }
    cv_params_clear(&p);
}
END_TEST

START_TEST(mirror_of_the_frequency_is_the_conjugate)
{
    cv_params p;
    cv_params_init(&p);
    for (int i = 0; i < 300; i++) {
        double alpha, q;
        sa_track *t;
        sa_value right, left;
        random_case(&p, &alpha, &q);
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        if (sa_zeta_double(&right, sweep, t, alpha, q) == CV_OK &&
            sa_zeta_double(&left, sweep, t, alpha, -q) == CV_OK) {
            ck_assert(fabs(right.re - left.re) <= right.re_error + left.re_error);
            ck_assert(fabs(right.im + left.im) <= right.im_error + left.im_error);
        }
        sa_track_free(t);
    }
    cv_params_clear(&p);
}
END_TEST

/* central difference of zeta in alpha (step da) or q (step dq), from 250 bits */
static double complex difference(exact *x, const sa_track *t, double alpha, double q, double da, double dq)
{
    mpc_t ahead;
    mpc_init2(ahead, 255);
    ck_assert_int_eq(exact_at(x, sweep, t, alpha + da, q + dq), CV_OK);
    mpc_set(ahead, x->zeta, MPC_RNDNN);
    ck_assert_int_eq(exact_at(x, sweep, t, alpha - da, q - dq), CV_OK);
    mpc_sub(ahead, ahead, x->zeta, MPC_RNDNN);
    double step = da != 0 ? (alpha + da) - (alpha - da) : (q + dq) - (q - dq);
    double complex result =
        CMPLX(mpfr_get_d(mpc_realref(ahead), MPFR_RNDN), mpfr_get_d(mpc_imagref(ahead), MPFR_RNDN));
    mpc_clear(ahead);
    return result / step;
}

START_TEST(slopes_are_those_of_differences)
{
    exact x;
    exact_init(&x, 255);
    for (int c = 0; c < 4; c++) {
        sa_track *t = make_track(table1[c], "0.05");
        for (int i = 0; i < 25; i++) {
            double alpha = 0.05 + gsl_rng_uniform(rng), q = log_uniform(rng, 0.01, 3);
            sa_value v;
            ck_assert_int_eq(sa_zeta_double(&v, sweep, t, alpha, q), CV_OK);
            double complex d_q = difference(&x, t, alpha, q, 0, 1e-6 * q);
            double complex d_alpha = difference(&x, t, alpha, q, 1e-6 * alpha, 0);
            ck_assert_double_le(cabs(v.d_q - d_q), 1e-6 * cabs(d_q));
            ck_assert_double_le(cabs(v.d_alpha - d_alpha), 1e-6 * cabs(d_alpha) + 1e-12);
        }
        sa_track_free(t);
    }
    exact_clear(&x);
}
END_TEST

/* Re qbar > 0: analytic in qbar, so the mean over a circle in that half-plane is the value at its centre. */
START_TEST(complex_frequencies_obey_the_mean_value)
{
    enum { ON_CIRCLE = 64 };
    sa_track *t = make_track(table1[0], "1e-4");
    for (int i = 0; i < 20; i++) {
        double alpha = 0.05 + gsl_rng_uniform(rng);
        double complex centre = CMPLX(gsl_rng_uniform(rng), -0.2), mean = 0;
        sa_value v;
        for (int k = 0; k < ON_CIRCLE; k++) {
            double complex on = centre + 0.1 * cexp(CMPLX(0, 2 * M_PI * k / ON_CIRCLE));
            ck_assert_int_eq(sa_zeta_complex(&v, sweep, t, alpha, on), CV_OK);
            mean += CMPLX(v.re, v.im) / ON_CIRCLE;
        }
        ck_assert_int_eq(sa_zeta_complex(&v, sweep, t, alpha, centre), CV_OK);
        ck_assert_double_le(cabs(mean - CMPLX(v.re, v.im)), 1e-11 * cabs(mean));
    }
    sa_track_free(t);
}
END_TEST

/* A pole goes through infinity where alpha^2 mu_b = eta_s; zeta does not notice. */
START_TEST(zeta_is_smooth_where_a_pole_is_infinite)
{
    const char *const values[6] = {"6", "35", "300", "7", "8.75", "0"};
    const char *const dampings[] = {"0.05", "1e-10"};
    for (int level = 0; level < 2; level++) {
        sa_track *t = make_track(values, dampings[level]);
        for (double q = 0.01; q < 5; q *= 1.7) {
            sa_value at, v;
            ck_assert_int_eq(sa_zeta_adaptive(&at, sweep, t, 0.5, q, 1e-10), CV_OK);
            ck_assert_int_eq(at.upper_count, 2);
            for (double gap = 1e-15; gap < 1e-6; gap *= 10)
                for (int side = -1; side <= 1; side += 2) {
                    double alpha = 0.5 * (1 + side * gap), change = (alpha - 0.5);
                    ck_assert_int_eq(sa_zeta_adaptive(&v, sweep, t, alpha, q, 1e-10), CV_OK);
                    ck_assert_int_eq(v.upper_count, side < 0 ? 3 : 2);
                    double complex gone = CMPLX(v.re - at.re, v.im - at.im) - change * at.d_alpha;
                    ck_assert_double_le(cabs(gone), 1e-9 * cabs(CMPLX(at.re, at.im)) + 10 * change * change);
                }
        }
        sa_track_free(t);
    }
}
END_TEST

/* Nor do its slopes, at the double that is closest to the shear velocity, sqrt(eta_s/mu_b), where the pole is
 * so far out that powers of it overflow. */
START_TEST(slopes_do_not_notice_a_pole_near_infinity)
{
    const char *const values[6] = {"4.95316", "41.4494", "27722.1", "0.642198", "1.64727", "0"};
    const double closest = 0.19935322713286363, q = 2905;
    sa_track *t = make_track(values, "0.05");
    sa_value at, v;
    ck_assert_int_eq(sa_zeta_adaptive(&at, sweep, t, closest * (1 + 1e-10), q, 1e-10), CV_OK);
    ck_assert_int_eq(sa_zeta_adaptive(&v, sweep, t, closest, q, 1e-15), CV_OK);
    ck_assert_double_le(cabs(v.d_q - at.d_q), 1e-8 * cabs(at.d_q));
    ck_assert_double_le(cabs(v.d_alpha - at.d_alpha), 1e-8 * cabs(at.d_alpha));
    sa_track_free(t);
}
END_TEST

START_TEST(adaptive_reaches_its_tolerance)
{
    cv_params p;
    exact x;
    cv_params_init(&p);
    exact_init(&x, 383);
    for (int i = 0; i < 150; i++) {
        double alpha, q;
        sa_track *t;
        sa_value v;
        random_case(&p, &alpha, &q);
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        ck_assert_int_eq(sa_zeta_adaptive(&v, sweep, t, alpha, q, 1e-14), CV_OK);
        ck_assert(v.re_error <= 1e-14 * fabs(v.re) && v.im_error <= 1e-14 * fabs(v.im));
        ck_assert_int_eq(exact_at(&x, sweep, t, alpha, q), CV_OK);
        ck_assert(contains(v.re, v.re_error, mpc_realref(x.zeta), x.re_error));
        ck_assert(contains(v.im, v.im_error, mpc_imagref(x.zeta), x.im_error));
        sa_track_free(t);
    }
    exact_clear(&x);
    cv_params_clear(&p);
}
END_TEST

START_TEST(impossible_points_are_refused)
{
    sa_track *damped = make_track(table1[0], "0.05"), *undamped = make_track(table1[0], "0");
    sa_value v;
    ck_assert_int_eq(sa_zeta_double(&v, sweep, damped, -0.5, 0.2), CV_BAD_INPUT);
    ck_assert_int_eq(sa_zeta_double(&v, sweep, damped, NAN, 0.2), CV_BAD_INPUT);
    ck_assert_int_eq(sa_zeta_double(&v, sweep, damped, 0.5, INFINITY), CV_BAD_INPUT);
    ck_assert_int_eq(sa_zeta_complex(&v, sweep, damped, 0.5, CMPLX(0.2, 1e-9)), CV_BAD_INPUT);
    ck_assert_int_eq(sa_zeta_double(&v, sweep, undamped, 0, 0.2), CV_UNDECIDED);
    ck_assert_int_eq(sa_zeta_adaptive(&v, sweep, undamped, 0.5, 0.2, 1e-12), CV_OK);
    ck_assert_int_eq(sa_zeta_double(&v, sweep, damped, 0.5, 0), CV_OK);
    ck_assert(v.re == 0 && v.im == 0 && v.re_error == 0 && v.im_error == 0);
    sa_track_free(damped);
    sa_track_free(undamped);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic zeta");
    TCase *tests = tcase_create("zeta");
    tcase_add_checked_fixture(tests, setup, teardown);
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, bounds_of_double_contain_many_digits);
    tcase_add_test(tests, bounds_are_narrow_on_the_cases_of_the_paper);
    tcase_add_test(tests, a_sweep_from_elsewhere_gives_the_same_value);
    tcase_add_test(tests, mirror_of_the_frequency_is_the_conjugate);
    tcase_add_test(tests, slopes_are_those_of_differences);
    tcase_add_test(tests, complex_frequencies_obey_the_mean_value);
    tcase_add_test(tests, zeta_is_smooth_where_a_pole_is_infinite);
    tcase_add_test(tests, slopes_do_not_notice_a_pole_near_infinity);
    tcase_add_test(tests, adaptive_reaches_its_tolerance);
    tcase_add_test(tests, impossible_points_are_refused);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
