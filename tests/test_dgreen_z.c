/* zeta at a point: bounds, precision by request, zero damping, the degree drop. Values against rigorous
 * arithmetic are in test_reference_values.c. */
#include <check.h>
#include <math.h>

#include "dgreen/z.h"
#include "dgreen/z_mp.h"
#include "tests/dgreen_points.h"

static gsl_rng *rng;
static dg_follow *follow;

/* zeta with many digits, and numbers to ask for it */
static mpc_t exact;
static mpfr_t re_error, im_error, alpha_mp, q_mp, difference;
static cv_number alpha_number, sigma_number, q_number;

static void setup(void)
{
    rng = random_start("test_dgreen_z", 20240304);
    ck_assert_int_eq(dg_follow_new(&follow, NULL), CV_OK);
    mpc_init2(exact, 53);
    mpfr_inits2(53, re_error, im_error, alpha_mp, q_mp, difference, (mpfr_ptr)0);
    cv_number_init(&alpha_number);
    cv_number_init(&sigma_number);
    cv_number_init(&q_number);
}

static void teardown(void)
{
    gsl_rng_free(rng);
    dg_follow_free(follow);
    mpc_clear(exact);
    mpfr_clears(re_error, im_error, alpha_mp, q_mp, difference, (mpfr_ptr)0);
    cv_number_clear(&alpha_number);
    cv_number_clear(&sigma_number);
    cv_number_clear(&q_number);
}

static cv_status exact_at(const dg_track *t, double alpha, double q, mpfr_prec_t bits)
{
    mpfr_set_d(alpha_mp, alpha, MPFR_RNDN);
    mpfr_set_d(q_mp, q, MPFR_RNDN);
    return dg_zeta_mp(exact, re_error, im_error, t, alpha_mp, q_mp, bits);
}

/* |part - exact| <= bound, with the error of "exact" itself added */
static int within(double part, mpfr_srcptr truth, mpfr_srcptr error, double bound)
{
    mpfr_sub_d(difference, truth, part, MPFR_RNDN);
    return fabs(mpfr_get_d(difference, MPFR_RNDN)) <= bound * (1 + 1e-15) + mpfr_get_d(error, MPFR_RNDU);
}

static double distance(double part, mpfr_srcptr truth)
{
    mpfr_sub_d(difference, truth, part, MPFR_RNDN);
    return fabs(mpfr_get_d(difference, MPFR_RNDN));
}

static cv_status digits_at(const dg_track *t, const char *alpha, const char *sigma, const char *q, int digits,
                           cv_message *why)
{
    ck_assert_int_eq(cv_number_parse(&alpha_number, alpha, NULL), CV_OK);
    ck_assert_int_eq(cv_number_parse(&sigma_number, sigma, NULL), CV_OK);
    ck_assert_int_eq(cv_number_parse(&q_number, q, NULL), CV_OK);
    return dg_zeta_digits(exact, t, &alpha_number, &sigma_number, &q_number, digits, why);
}

static void assert_decimal(mpfr_srcptr part, int digits, const char *expected)
{
    char text[200];
    mpfr_snprintf(text, sizeof text, "%.*Re", digits - 1, part);
    ck_assert_str_eq(text, expected);
}

/* The bounds in double contain the value at 383 bits, for both parts, on random tracks of (31) with dampings
 * from 1e-10, next to branch points and to the degree drop; they are seldom wider than a millionth. */
START_TEST(bounds_in_double_hold)
{
    int decided = 0, tight = 0, points = 0;
    for (int i = 0; i < 400; i++) {
        dg_track *t = random_damped_track(rng);
        for (int k = 0; k < 15; k++, points++) {
            double alpha, q;
            dg_value v;
            random_point(&alpha, &q, t, rng);
            const cv_status status = dg_zeta_double(&v, follow, t, alpha, CMPLX(0, q));
            ck_assert_msg(status == CV_OK || status == CV_UNDECIDED, "status %d", (int)status);
            if (status != CV_OK)
                continue;
            decided++;
            ck_assert_int_eq(exact_at(t, alpha, q, 383), CV_OK);
            ck_assert_msg(within(v.re, mpc_realref(exact), re_error, v.re_error),
                          "Re at %d %d: off %g, bound %g", i, k, distance(v.re, mpc_realref(exact)),
                          v.re_error);
            ck_assert_msg(within(v.im, mpc_imagref(exact), im_error, v.im_error),
                          "Im at %d %d: off %g, bound %g", i, k, distance(v.im, mpc_imagref(exact)),
                          v.im_error);
            tight += v.re_error < 1e-6 * fabs(v.re) && v.im_error < 1e-6 * fabs(v.im);
        }
        dg_track_free(t);
    }
    printf("of %d points double decides %d, %d to six digits\n", points, decided, tight);
    ck_assert_int_gt(decided, points * 8 / 10);
    ck_assert_int_gt(tight, points / 2);
}
END_TEST

/* The same off the imaginary axis of qbar: sigma + i q against digits on demand. */
START_TEST(bounds_hold_inside_the_half_plane)
{
    for (int i = 0; i < 300; i++) {
        dg_track *t = random_damped_track(rng);
        char alpha[40], sigma[40], q[40];
        dg_value v;
        double a, f;
        random_point(&a, &f, t, rng);
        snprintf(alpha, sizeof alpha, "%.20e", a); /* exact enough: conditioning is far below 1e3 here */
        snprintf(q, sizeof q, "%.20e", f);
        const double s = log_uniform(rng, 1e-3, 5);
        snprintf(sigma, sizeof sigma, "%.20e", s);
        if (dg_zeta_double(&v, follow, t, a, CMPLX(s, f)) == CV_OK) {
            ck_assert_int_eq(digits_at(t, alpha, sigma, q, 20, NULL), CV_OK);
            const double slack = 1e-15 * hypot(v.re, v.im);
            ck_assert(distance(v.re, mpc_realref(exact)) <= v.re_error + slack);
            ck_assert(distance(v.im, mpc_imagref(exact)) <= v.im_error + slack);
        }
        dg_track_free(t);
    }
}
END_TEST

/* What dg_zeta_adaptive promises, at tolerances that double cannot meet. */
START_TEST(tolerances_are_met)
{
    for (int i = 0; i < 300; i++) {
        dg_track *t = random_damped_track(rng);
        double alpha, q;
        dg_value v;
        random_point(&alpha, &q, t, rng);
        ck_assert_int_eq(dg_zeta_adaptive(&v, follow, t, alpha, CMPLX(0, q), 1e-14, 1e-14), CV_OK);
        ck_assert(v.re_error <= 1e-14 * fabs(v.re) && v.im_error <= 1e-14 * fabs(v.im));
        ck_assert_int_eq(exact_at(t, alpha, q, 383), CV_OK);
        ck_assert(within(v.re, mpc_realref(exact), re_error, v.re_error));
        ck_assert(within(v.im, mpc_imagref(exact), im_error, v.im_error));
        const double a0 = alpha * alpha * t->mu_b - t->eta_s;
        if (fabs(a0) > 1e-10)
            ck_assert_int_eq(v.right_count, a0 > 0 ? 6 : 5);
        dg_track_free(t);
    }
    const dg_counters c = dg_follow_counters(follow);
    ck_assert(c.above_double > 0 && c.above_double <= c.evaluations && c.largest_precision > 53);
}
END_TEST

/* Bounds of two precisions overlap, and digits asked for are those of more digits. */
START_TEST(more_digits_agree)
{
    for (int i = 0; i < 100; i++) {
        dg_track *t = random_damped_track(rng);
        double alpha, q;
        mpc_t coarse;
        mpc_init2(coarse, 53);
        random_point(&alpha, &q, t, rng);
        if (exact_at(t, alpha, q, 191) == CV_OK) {
            mpfr_t re, im;
            mpfr_inits2(53, re, im, (mpfr_ptr)0);
            mpfr_set(re, re_error, MPFR_RNDU);
            mpfr_set(im, im_error, MPFR_RNDU);
            mpc_set_prec(coarse, 191);
            mpc_set(coarse, exact, MPC_RNDNN);
            ck_assert_int_eq(exact_at(t, alpha, q, 511), CV_OK);
            mpc_sub(coarse, coarse, exact, MPC_RNDNN);
            mpfr_add(re, re, re_error, MPFR_RNDU);
            mpfr_add(im, im, im_error, MPFR_RNDU);
            ck_assert(mpfr_cmpabs(mpc_realref(coarse), re) <= 0 && mpfr_cmpabs(mpc_imagref(coarse), im) <= 0);
            mpfr_clears(re, im, (mpfr_ptr)0);
        }
        mpc_clear(coarse);
        dg_track_free(t);
    }
}
END_TEST

/* zeta(conj qbar) = conj zeta(qbar); real at q = 0; 0 at qbar = 0. */
START_TEST(symmetry)
{
    dg_track *t = track_of("3.3 10 200 40 0.01 0.02 1e-5 5 -0.4");
    dg_value up, down;
    ck_assert_int_eq(dg_zeta_double(&up, follow, t, 0.5, CMPLX(0.3, 0.4)), CV_OK);
    ck_assert_int_eq(dg_zeta_double(&down, follow, t, 0.5, CMPLX(0.3, -0.4)), CV_OK);
    ck_assert(fabs(up.re - down.re) <= up.re_error + down.re_error);
    ck_assert(fabs(up.im + down.im) <= up.im_error + down.im_error);
    ck_assert_int_eq(digits_at(t, "0.5", "0.3", "0", 25, NULL), CV_OK);
    ck_assert(mpfr_zero_p(mpc_imagref(exact)) && !mpfr_zero_p(mpc_realref(exact)));
    ck_assert_int_eq(digits_at(t, "0.5", "0", "0", 25, NULL), CV_OK);
    ck_assert(mpfr_zero_p(mpc_imagref(exact)) && mpfr_zero_p(mpc_realref(exact)));
    ck_assert_int_eq(dg_zeta_double(&up, follow, t, 0.5, CMPLX(-0.01, 0.4)), CV_BAD_INPUT);
    ck_assert_int_eq(dg_zeta_double(&up, follow, t, -0.5, CMPLX(0.01, 0.4)), CV_BAD_INPUT);
    ck_assert_int_eq(digits_at(t, "0.5", "-0.3", "0", 25, NULL), CV_BAD_INPUT);
    dg_track_free(t);
}
END_TEST

/* -2 zeta/qbar^2 at rest and qbar -> 0 is the static deflection k^(-3/4), k = 1/(1 + 1/kappa_p + 1/kappa_b):
 * 1 for a Winkler beam. (The printed (13), 4 eta_C and pi for 2 eta_C and 2 pi, would make it 4.) */
START_TEST(static_winkler_limit)
{
    dg_track *t = track_of("6 35 1e20 1e20 0.05 0.05 0.05 0 0");
    ck_assert_int_eq(digits_at(t, "0", "1e-40", "0", 15, NULL), CV_OK);
    ck_assert_double_eq_tol(mpfr_get_d(mpc_realref(exact), MPFR_RNDN) * 1e80 * -2, 1, 1e-14);
    dg_track_free(t);
}
END_TEST

/* Zero damping is the limit of small damping, for tracks with waves of normal and of anomalous Doppler
 * effect. */
START_TEST(zero_damping_is_the_limit)
{
    const char *undamped[] = {"3 10 0.03 0.1 0 0 0 0 0", "6 35 300 7 0 0 0 0 0",
                              "3.3 10 200 40 0 0 0 5 -0.4"};
    const char *damped[] = {"3 10 0.03 0.1 1e-50 1e-50 1e-50 0 0", "6 35 300 7 1e-50 1e-50 1e-50 0 0",
                            "3.3 10 200 40 1e-50 1e-50 1e-50 5 -0.4"};
    const char *alphas[] = {"0.1", "0.3", "0.45", "0.8", "1.7"},
               *frequencies[] = {"0.01", "0.22", "0.7", "3"};
    for (int i = 0; i < 60; i++) {
        dg_track *zero = track_of(undamped[i / 20]), *small = track_of(damped[i / 20]);
        const char *alpha = alphas[i / 4 % 5], *q = frequencies[i % 4];
        mpc_t limit;
        mpc_init2(limit, 300);
        ck_assert_int_eq(digits_at(zero, alpha, "0", q, 30, NULL), CV_OK);
        mpc_set(limit, exact, MPC_RNDNN);
        ck_assert_int_eq(digits_at(small, alpha, "0", q, 30, NULL), CV_OK);
        mpc_sub(limit, limit, exact, MPC_RNDNN);
        ck_assert_msg(mpfr_get_d(mpc_realref(limit), MPFR_RNDA) < 1e-35 &&
                          mpfr_get_d(mpc_realref(limit), MPFR_RNDA) > -1e-35 &&
                          fabs(mpfr_get_d(mpc_imagref(limit), MPFR_RNDA)) < 1e-35,
                      "alpha %s, q %s", alpha, q);
        mpc_clear(limit);
        dg_track_free(zero);
        dg_track_free(small);
    }
}
END_TEST

/* Exactly zero parts: Im below the first cut-off of the resting track (no wave), Re where all eight roots are
 * waves. */
START_TEST(zero_damping_gives_exact_zeros)
{
    dg_track *rest = track_of("6 35 300 7 0 0 0 0 0"), *waves = track_of("3 10 0.03 0.1 0 0 0 0 0");
    ck_assert_int_eq(digits_at(rest, "0", "0", "0.1", 30, NULL), CV_OK);
    ck_assert(mpfr_zero_p(mpc_imagref(exact)) && mpfr_sgn(mpc_realref(exact)) > 0);
    ck_assert_int_eq(digits_at(waves, "1.5", "0", "0.01", 30, NULL), CV_OK);
    ck_assert(mpfr_zero_p(mpc_realref(exact)) && !mpfr_zero_p(mpc_imagref(exact)));
    dg_track_free(rest);
    dg_track_free(waves);
}
END_TEST

/* q = 1 is a cut-off of these resting tracks (determinant of (7) at p = 0; a root p = 0 of order 2 and 4),
 * where zeta is infinite; that is said to be undecided, and 1e-40 beside it there is a value. */
START_TEST(branch_point)
{
    const char *tracks[] = {"4 13 2 4 0 0 0 0 0", "2 4 1 3 0 0 0 0 0"};
    for (int i = 0; i < 2; i++) {
        dg_track *t = track_of(tracks[i]);
        cv_message why = {""};
        ck_assert_int_eq(digits_at(t, "0", "0", "1", 20, &why), CV_UNDECIDED);
        ck_assert_ptr_nonnull(strstr(why.text, "branch point"));
        ck_assert_int_eq(digits_at(t, "0", "0", "1.0000000000000000000000000000000000000001", 20, NULL),
                         CV_OK);
        ck_assert(mpfr_cmpabs_ui(mpc_imagref(exact), 1000000) > 0);
        dg_track_free(t);
    }
}
END_TEST

/* Through alpha^2 mu_b = eta_s: exactly on it (degree 7), and beside it, in double and with digits; zeta is
 * smooth. */
START_TEST(degree_drop)
{
    dg_track *t = track_of("3.3 20 200 40 0.01 0.02 1e-5 5 -0.4");
    double on[2];
    ck_assert_int_eq(digits_at(t, "0.5", "0", "0.4", 40, NULL), CV_OK);
    on[0] = mpfr_get_d(mpc_realref(exact), MPFR_RNDN);
    on[1] = mpfr_get_d(mpc_imagref(exact), MPFR_RNDN);
    for (int i = 0; i <= 16; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            const double step = i == 16 ? 0 : sign * pow(10, -i - 1) / 2;
            dg_value v;
            ck_assert_int_eq(dg_zeta_adaptive(&v, follow, t, 0.5 + step, CMPLX(0, 0.4), 1e-10, 1e-10), CV_OK);
            ck_assert(fabs(v.re - on[0]) <= 0.2 * fabs(step) + 1e-11);
            ck_assert(fabs(v.im - on[1]) <= 0.2 * fabs(step) + 1e-11);
            if (fabs(step) > 1e-5)
                ck_assert_int_eq(v.right_count, step > 0 ? 6 : 5);
        }
    }
    ck_assert_int_eq(digits_at(t, "0.5", "0", "0.4", 400, NULL), CV_OK);
    ck_assert_int_eq(
        digits_at(t, "0.50000000000000000000000000000000000000000000000001", "0", "0.4", 40, NULL), CV_OK);
    ck_assert(fabs(mpfr_get_d(mpc_realref(exact), MPFR_RNDN) - on[0]) <= 1e-17);
    dg_track_free(t);
}
END_TEST

/* Both parts have their digits. mpmath 1.2.1, 90 digits, from
 * the matrix (7). */
START_TEST(known_digits)
{
    dg_track *t = track_of("3 10 0.03 0.1 1e-10 1e-10 1e-10 0 0"),
             *s = track_of("3.3 10 200 40 0.01 0.02 1e-5 5 -0.4");
    ck_assert_int_eq(digits_at(t, "0.4", "0", "0.22", 30, NULL), CV_OK);
    assert_decimal(mpc_realref(exact), 30, "4.15665635650431309309926229697e-02");
    assert_decimal(mpc_imagref(exact), 30, "-2.08250924066405433589229705853e-01");
    ck_assert_int_eq(digits_at(s, "0.5", "0.3", "0.4", 30, NULL), CV_OK);
    assert_decimal(mpc_realref(exact), 30, "-1.29129027284122606923202979812e-02");
    assert_decimal(mpc_imagref(exact), 30, "-2.03141273477297442344959443847e-02");
    ck_assert_int_eq(digits_at(t, "1.5", "0", "0.01", 30, NULL), CV_OK);
    ck_assert(mpfr_get_d(mpc_realref(exact), MPFR_RNDN) * 1e6 <
              fabs(mpfr_get_d(mpc_imagref(exact), MPFR_RNDN)));
    dg_track_free(t);
    dg_track_free(s);
}
END_TEST

/* Below the first cut-off of the resting track nothing is radiated and Im zeta is proportional to a small
 * damping: 60 digits below Re zeta it still has its own 25, which takes more than the first precision. */
START_TEST(tiny_part_is_proportional_to_damping)
{
    dg_track *small = track_of("6 35 300 7 1e-30 1e-30 1e-30 0 0"),
             *tiny = track_of("6 35 300 7 1e-70 1e-70 1e-70 0 0");
    char first[200], second[200];
    ck_assert_int_eq(digits_at(small, "0", "0", "0.1", 25, NULL), CV_OK);
    mpfr_snprintf(first, sizeof first, "%.24Re", mpc_imagref(exact));
    ck_assert_int_eq(digits_at(tiny, "0", "0", "0.1", 25, NULL), CV_OK);
    mpfr_snprintf(second, sizeof second, "%.24Re", mpc_imagref(exact));
    ck_assert(strncmp(first, second, 27) == 0 && strcmp(first, second) != 0);
    ck_assert(strstr(second, "e-7") != NULL && mpfr_get_prec(mpc_realref(exact)) > 300);
    dg_track_free(small);
    dg_track_free(tiny);
}
END_TEST

/* Each part has its tolerance, and an infinite one asks for nothing. */
START_TEST(tolerances_are_separate)
{
    dg_track *t = track_of("6 35 300 7 1e-25 1e-25 1e-25 0 0");
    dg_value v;
    ck_assert_int_eq(dg_zeta_adaptive(&v, follow, t, 0, CMPLX(0, 0.1), 1e-3, (double)INFINITY), CV_OK);
    ck_assert(v.re_error <= 1e-3 * fabs(v.re) && dg_follow_counters(follow).above_double == 0);
    ck_assert_int_eq(dg_zeta_adaptive(&v, follow, t, 0, CMPLX(0, 0.1), 1e-3, 1e-3), CV_OK);
    ck_assert(v.im_error <= 1e-3 * fabs(v.im) && fabs(v.im) < 1e-24 * fabs(v.re));
    ck_assert(dg_follow_counters(follow).above_double == 1);
    dg_track_free(t);
}
END_TEST

/* A sweep is continued: cold starts are rare. */
START_TEST(sweeps_stay_warm)
{
    dg_track *t = track_of("6 5 0.03 3 1e-10 1e-10 1e-10 0 0");
    for (int i = 0; i < 4000; i++) {
        dg_value v;
        const cv_status status = dg_zeta_double(&v, follow, t, 0.45, CMPLX(0, pow(10, -3 + 1e-3 * i)));
        ck_assert(status == CV_OK || status == CV_UNDECIDED);
    }
    ck_assert_uint_lt(dg_follow_counters(follow).cold_starts, 40);
    ck_assert_uint_eq(dg_follow_counters(follow).evaluations, 4000);
    dg_track_free(t);
}
END_TEST

/* Numbers beyond the range of a double in the coefficients: said, not crashed. */
START_TEST(absurd_numbers)
{
    dg_track *t = track_of("6 35 300 7 0.1 0.1 0.1 0 0"),
             *stiff = track_of("1e200 1e200 1e200 1e200 0.1 0.1 0.1 0 0");
    const char *huge[] = {"1e300", "1e-300", "1e100", "1e-100"};
    for (int i = 0; i < 16; i++) {
        const cv_status status = digits_at(t, huge[i / 4], "0", huge[i % 4], 20, NULL);
        ck_assert(status == CV_OK || status == CV_UNDECIDED);
    }
    const cv_status status = digits_at(stiff, "0.3", "0", "0.2", 20, NULL);
    ck_assert(status == CV_OK || status == CV_UNDECIDED);
    dg_value v;
    const cv_status in_double = dg_zeta_adaptive(&v, follow, stiff, 0.3, CMPLX(0, 0.2), 1e-3, 1e-3);
    ck_assert(in_double == CV_OK || in_double == CV_UNDECIDED);
    dg_track_free(t);
    dg_track_free(stiff);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen z");
    TCase *c = tcase_create("z");
    tcase_set_timeout(c, 30);
    tcase_add_checked_fixture(c, setup, teardown);
    tcase_add_test(c, bounds_in_double_hold);
    tcase_add_test(c, bounds_hold_inside_the_half_plane);
    tcase_add_test(c, tolerances_are_met);
    tcase_add_test(c, more_digits_agree);
    tcase_add_test(c, symmetry);
    tcase_add_test(c, static_winkler_limit);
    tcase_add_test(c, zero_damping_is_the_limit);
    tcase_add_test(c, zero_damping_gives_exact_zeros);
    tcase_add_test(c, branch_point);
    tcase_add_test(c, degree_drop);
    tcase_add_test(c, known_digits);
    tcase_add_test(c, tiny_part_is_proportional_to_damping);
    tcase_add_test(c, tolerances_are_separate);
    tcase_add_test(c, sweeps_stay_warm);
    tcase_add_test(c, absurd_numbers);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
