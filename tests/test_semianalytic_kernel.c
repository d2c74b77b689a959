/* K(xi, q) and zeta to many digits: closed forms, the referee's values, the limit of zero damping, the errors
 * in the print. */
#include <check.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "semianalytic/kernel.h"
#include "tests/semianalytic_points.h"

static gsl_rng *rng;

static void setup(void)
{
    rng = random_start("test_semianalytic_kernel", 42);
}

static void teardown(void)
{
    gsl_rng_free(rng);
}

typedef struct {
    mpc_t zeta, kernel;
} result;

static void result_init(result *r)
{
    mpc_init2(r->zeta, 53);
    mpc_init2(r->kernel, 53);
}

static void result_clear(result *r)
{
    mpc_clear(r->zeta);
    mpc_clear(r->kernel);
}

static cv_status evaluate(result *r, const sa_track *t, const char *alpha, const char *q, const char *xi,
                          int digits)
{
    const char *const texts[3] = {alpha, q, xi};
    cv_number numbers[3];
    cv_message why = {""};
    for (int i = 0; i < 3; i++) {
        cv_number_init(&numbers[i]);
        set_text(&numbers[i], texts[i]);
    }
    cv_status status =
        sa_kernel_digits(r->zeta, r->kernel, t, &numbers[0], &numbers[1], &numbers[2], digits, &why);
    for (int i = 0; i < 3; i++)
        cv_number_clear(&numbers[i]);
    ck_assert((status == CV_OK) == (why.text[0] == '\0'));
    return status;
}

/* |x - y| <= 10^-digits |y|, or both zero */
static int agrees(const mpfr_t x, const mpfr_t y, int digits)
{
    mpfr_t gap, bound;
    mpfr_inits2(64, gap, bound, (mpfr_ptr)0);
    mpfr_sub(gap, x, y, MPFR_RNDA);
    mpfr_set_ui(bound, 10, MPFR_RNDN);
    mpfr_pow_si(bound, bound, -digits, MPFR_RNDN);
    mpfr_mul(bound, bound, y, MPFR_RNDN);
    int yes = mpfr_cmpabs(gap, bound) <= 0;
    mpfr_clears(gap, bound, (mpfr_ptr)0);
    return yes;
}

static int both_agree(const mpc_t x, const mpc_t y, int digits)
{
    return agrees(mpc_realref(x), mpc_realref(y), digits) && agrees(mpc_imagref(x), mpc_imagref(y), digits);
}

/* integral of 1/(p^4/4 - b p^2 + c) over the real axis = pi / (sqrt(c) sqrt(sqrt(c) - b)) */
static void quartic_integral(mpc_t out, const mpc_t b, const mpc_t c)
{
    mpc_t root;
    mpfr_t pi;
    mpc_init2(root, mpc_get_prec(out));
    mpfr_init2(pi, mpc_get_prec(out));
    mpc_sqrt(root, c, MPC_RNDNN);
    mpc_sub(out, root, b, MPC_RNDNN);
    mpc_sqrt(out, out, MPC_RNDNN);
    mpc_mul(out, out, root, MPC_RNDNN);
    mpfr_const_pi(pi, MPFR_RNDN);
    mpc_fr_div(out, pi, out, MPC_RNDNN);
    mpfr_clear(pi);
    mpc_clear(root);
}

/* At rest (alpha = 0, q = 0) the foundation is three springs in series, whatever the masses and dampings.
 * With stiff upper layers this is the Winkler beam: w_st of (3) belongs to K(0, 0) = pi, the deflection being
 * K/pi after the corrected (13) and 4 K/pi as printed. */
START_TEST(static_deflection_is_that_of_springs_in_series)
{
    const char *const tracks[][6] = {{"6", "35", "300", "7", "0", "0"},
                                     {"6", "5", "0.03", "3", "0", "0"},
                                     {"6", "5", "0.03", "3", "0", "0.125"},
                                     {"2", "20", "4", "4", "0", "-1.5"},
                                     {"1", "2.5", "1e30", "1e30", "0", "0"}};
    const double stiffness[] = {2100.0 / 2407, 0.03 / 1.04, 0.03 / 1.04, 2.0 / 3, 1};
    for (int i = 0; i < 5; i++)
        for (int damped = 0; damped < 2; damped++) {
            sa_track *t = make_track(tracks[i], damped ? "0.05" : "0");
            result r;
            result_init(&r);
            ck_assert_int_eq(evaluate(&r, t, "0", "0", "0", 25), CV_OK);
            double root = sqrt(stiffness[i]);
            double expected = M_PI / (root * sqrt(root - strtod(tracks[i][5], NULL)));
            ck_assert_double_eq_tol(mpfr_get_d(mpc_realref(r.kernel), MPFR_RNDN), expected, 1e-14 * expected);
            ck_assert(mpfr_zero_p(mpc_imagref(r.kernel)));
            ck_assert(mpfr_zero_p(mpc_realref(r.zeta)) && mpfr_zero_p(mpc_imagref(r.zeta)));
            result_clear(&r);
            sa_track_free(t);
        }
}
END_TEST

/* The printed (13) has 4 eta_C/(i q (pi - 2 eta_M q^2 K)): four times the deflection w_st = 1 at rest. */
START_TEST(printed_13_is_four_times_the_static_deflection)
{
    const char *const winkler[6] = {"1", "2.5", "1e30", "1e30", "0", "0"};
    sa_track *t = make_track(winkler, "0");
    result r;
    result_init(&r);
    ck_assert_int_eq(evaluate(&r, t, "0", "0", "0", 20), CV_OK);
    double kernel = mpfr_get_d(mpc_realref(r.kernel), MPFR_RNDN);
    double corrected = 2 * kernel / (2 * M_PI), printed = 4 * kernel / M_PI;
    ck_assert_double_eq_tol(corrected, 1, 1e-15);
    ck_assert_double_eq_tol(printed, 4, 1e-14);
    result_clear(&r);
    sa_track_free(t);
}
END_TEST

/* 1/(1/a + 1/b) */
static double complex series(double complex a, double complex b)
{
    return a * b / (a + b);
}

/* alpha = 0: the support is a frequency-dependent spring c, from impedances in series and in parallel. */
static double complex support_at_rest(const cv_params *p, double q)
{
    const double complex iq = CMPLX(0, q);
    double complex ground =
        1 + 2 * cv_number_get_double(&p->eta_f) * iq - cv_number_get_double(&p->mu_b) * q * q;
    double complex ballast = cv_number_get_double(&p->kappa_b) + 2 * cv_number_get_double(&p->eta_b) * iq;
    double complex pad = cv_number_get_double(&p->kappa_p) + 2 * cv_number_get_double(&p->eta_p) * iq;
    double complex sleeper = series(ballast, ground) - cv_number_get_double(&p->mu_s) * q * q;
    return series(pad, sleeper) - q * q;
}

START_TEST(load_at_rest_has_a_closed_form)
{
    for (int i = 0; i < 200; i++) {
        cv_params p;
        sa_track *t;
        result r;
        char q[40];
        cv_params_init(&p);
        result_init(&r);
        random_track(&p, rng);
        set_text(&p.eta_s, "0");
        set_text(&p.eta_N, "-0.4");
        set_damping(&p, "0.05", "0.02", "0.11");
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        snprintf(q, sizeof q, "%.6e", log_uniform(rng, 1e-3, 10));
        ck_assert_int_eq(evaluate(&r, t, "0", q, "0", 17), CV_OK);
        double complex c = support_at_rest(&p, strtod(q, NULL));
        double complex expected = M_PI / (csqrt(c) * csqrt(csqrt(c) + 0.4));
        double complex kernel =
            CMPLX(mpfr_get_d(mpc_realref(r.kernel), MPFR_RNDN), mpfr_get_d(mpc_imagref(r.kernel), MPFR_RNDN));
        ck_assert_double_le(cabs(kernel - expected), 1e-9 * cabs(kernel));
        result_clear(&r);
        sa_track_free(t);
        cv_params_clear(&p);
    }
}
END_TEST

/* A force that moves at constant velocity over nearly massless layers: alpha^2 joins eta_N. */
START_TEST(moving_force_on_massless_layers_has_a_closed_form)
{
    const char *const values[6] = {"1e-8", "1e-8", "3", "6", "0", "0.1"};
    sa_track *t = make_track(values, "0");
    result r;
    mpc_t b, c, expected;
    result_init(&r);
    mpc_init2(b, 200);
    mpc_init2(c, 200);
    mpc_init2(expected, 200);
    ck_assert_int_eq(evaluate(&r, t, "0.5", "0", "0", 25), CV_OK);
    mpc_set_ui(b, 35, MPC_RNDNN);
    mpc_div_ui(b, b, 100, MPC_RNDNN);
    mpc_set_ui(c, 2, MPC_RNDNN);
    mpc_div_ui(c, c, 3, MPC_RNDNN);
    quartic_integral(expected, b, c);
    ck_assert(agrees(mpc_realref(r.kernel), mpc_realref(expected), 7));
    mpc_clear(b);
    mpc_clear(c);
    mpc_clear(expected);
    result_clear(&r);
    sa_track_free(t);
}
END_TEST

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    ck_assert_msg(text != NULL, "%s", key);
    return text;
}

static sa_track *track_of(const json_t *point)
{
    const json_t *values = json_object_get(point, "parameters");
    const char *const keys[6] = {"mu_s", "mu_b", "kappa_p", "kappa_b", "eta_s", "eta_N"};
    const char *texts[6];
    cv_params p;
    sa_track *t;
    for (int i = 0; i < 6; i++)
        texts[i] = text_of(values, keys[i]);
    cv_params_init(&p);
    set_params(&p, texts, "0");
    set_damping(&p, text_of(values, "eta_p"), text_of(values, "eta_b"), text_of(values, "eta_f"));
    ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
    cv_params_clear(&p);
    return t;
}

/* Every value of data/reference_zeta.json (its generator is named in the file; ball arithmetic of its own).
 */
START_TEST(values_of_the_referee_to_40_digits)
{
    json_error_t error;
    json_t *root = json_load_file("data/reference_zeta.json", 0, &error);
    ck_assert_msg(root != NULL, "%s", error.text);
    json_t *points = json_object_get(root, "points");
    ck_assert_uint_ge(json_array_size(points), 100);
    for (size_t i = 0; i < json_array_size(points); i++) {
        const json_t *point = json_array_get(points, i);
        sa_track *t = track_of(point);
        result r;
        mpc_t expected;
        result_init(&r);
        mpc_init2(expected, 200);
        mpfr_set_str(mpc_realref(expected), text_of(point, "zeta_re"), 10, MPFR_RNDN);
        mpfr_set_str(mpc_imagref(expected), text_of(point, "zeta_im"), 10, MPFR_RNDN);
        ck_assert_int_eq(evaluate(&r, t, text_of(point, "alpha"), text_of(point, "q"), "0", 42), CV_OK);
        ck_assert_msg(both_agree(r.zeta, expected, 40), "point %zu", i);
        mpc_clear(expected);
        result_clear(&r);
        sa_track_free(t);
    }
    json_decref(root);
}
END_TEST

/* random track and point as exact decimals; undamped for one in three */
static sa_track *random_place(char alpha[40], char q[40])
{
    cv_params p;
    sa_track *t;
    double a, frequency;
    cv_params_init(&p);
    random_track(&p, rng);
    if (gsl_rng_uniform_int(rng, 3) > 0)
        random_damping(&p, rng);
    random_point(&a, &frequency, &p, rng);
    snprintf(alpha, 40, "%.15e", a);
    snprintf(q, 40, "%.15e", frequency);
    ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
    cv_params_clear(&p);
    return t;
}

START_TEST(more_digits_confirm_fewer)
{
    for (int i = 0; i < 120; i++) {
        char alpha[40], q[40];
        sa_track *t = random_place(alpha, q);
        result few, many;
        result_init(&few);
        result_init(&many);
        const char *xi = i % 3 == 0 ? "0" : i % 3 == 1 ? "0.7" : "-1.9";
        ck_assert_int_eq(evaluate(&few, t, alpha, q, xi, 30), CV_OK);
        ck_assert_int_eq(evaluate(&many, t, alpha, q, xi, i % 20 == 0 ? 500 : 75), CV_OK);
        ck_assert_msg(both_agree(few.zeta, many.zeta, 30) && both_agree(few.kernel, many.kernel, 30),
                      "%s %s %s", alpha, q, xi);
        result_clear(&few);
        result_clear(&many);
        sa_track_free(t);
    }
}
END_TEST

/* K(xi, -q) = conj K(xi, q) */
START_TEST(mirror_image)
{
    for (int i = 0; i < 60; i++) {
        char alpha[40], q[41] = "-";
        const char *xi = i % 2 ? "0.8" : "-0.8";
        sa_track *t = random_place(alpha, q + 1);
        result right, left;
        result_init(&right);
        result_init(&left);
        ck_assert_int_eq(evaluate(&right, t, alpha, q + 1, xi, 25), CV_OK);
        ck_assert_int_eq(evaluate(&left, t, alpha, q, xi, 25), CV_OK);
        mpc_conj(left.zeta, left.zeta, MPC_RNDNN);
        mpc_conj(left.kernel, left.kernel, MPC_RNDNN);
        ck_assert_msg(both_agree(left.zeta, right.zeta, 24) && both_agree(left.kernel, right.kernel, 24),
                      "%s %s", alpha, q);
        result_clear(&right);
        result_clear(&left);
        sa_track_free(t);
    }
}
END_TEST

/* |change| <= 1e-24 |part|; beside a part that is exactly zero, 1e-40 */
static int negligible(const mpfr_t change, const mpfr_t part)
{
    double size = mpfr_zero_p(part) ? 1e-16 : fabs(mpfr_get_d(part, MPFR_RNDN));
    return fabs(mpfr_get_d(change, MPFR_RNDN)) <= 1e-24 * size;
}

/* K is continuous at the load, where the upper poles hand over to the lower ones. */
START_TEST(upper_and_lower_poles_meet_at_the_load)
{
    for (int i = 0; i < 60; i++) {
        char alpha[40], q[40];
        sa_track *t = random_place(alpha, q);
        result r[3];
        const char *const places[] = {"0", "1e-60", "-1e-60"};
        for (int k = 0; k < 3; k++) {
            result_init(&r[k]);
            ck_assert_int_eq(evaluate(&r[k], t, alpha, q, places[k], 25), CV_OK);
            if (k == 0)
                continue;
            mpc_sub(r[k].kernel, r[k].kernel, r[0].kernel, MPC_RNDNN);
            ck_assert_msg(negligible(mpc_realref(r[k].kernel), mpc_realref(r[0].kernel)) &&
                              negligible(mpc_imagref(r[k].kernel), mpc_imagref(r[0].kernel)),
                          "%s %s", alpha, q);
        }
        for (int k = 0; k < 3; k++)
            result_clear(&r[k]);
        sa_track_free(t);
    }
}
END_TEST

/* q - i0: the undamped value is what is left as the damping fades, and the difference fades with it. */
START_TEST(zero_damping_is_a_limit)
{
    for (int i = 0; i < 60; i++) {
        double a, frequency;
        char alpha[40], q[40];
        cv_params p;
        sa_track *t;
        result r[3];
        const char *const levels[] = {"1e-26", "1e-30", "0"};
        cv_params_init(&p);
        random_track(&p, rng);
        random_point(&a, &frequency, &p, rng);
        snprintf(alpha, sizeof alpha, "%.15e", a);
        snprintf(q, sizeof q, "%.15e", frequency);
        for (int k = 0; k < 3; k++) {
            result_init(&r[k]);
            set_damping(&p, levels[k], levels[k], levels[k]);
            ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
            ck_assert_int_eq(evaluate(&r[k], t, alpha, q, "0.4", 40), CV_OK);
            sa_track_free(t);
        }
        for (int k = 0; k < 2; k++)
            mpc_sub(r[k].kernel, r[k].kernel, r[2].kernel, MPC_RNDNN);
        mpc_div(r[1].kernel, r[1].kernel, r[0].kernel, MPC_RNDNN);
        double re = mpfr_get_d(mpc_realref(r[1].kernel), MPFR_RNDN),
               im = mpfr_get_d(mpc_imagref(r[1].kernel), MPFR_RNDN);
        ck_assert_double_le(hypot(re - 1e-4, im), 1e-7);
        for (int k = 0; k < 3; k++)
            result_clear(&r[k]);
        cv_params_clear(&p);
    }
}
END_TEST

/* Below the first cut-off frequency an undamped track at rest radiates nothing; where all eight poles are
 * real there is no near field. Such parts are 0, not small. */
START_TEST(parts_that_vanish_are_exactly_zero)
{
    sa_track *t = make_track(table1[0], "0");
    result r;
    result_init(&r);
    ck_assert_int_eq(evaluate(&r, t, "0", "0.1", "0", 30), CV_OK);
    ck_assert(mpfr_zero_p(mpc_imagref(r.zeta)) && mpfr_zero_p(mpc_imagref(r.kernel)));
    ck_assert(!mpfr_zero_p(mpc_realref(r.zeta)));
    ck_assert_int_eq(evaluate(&r, t, "0", "0.1", "2", 30), CV_OK);
    ck_assert(mpfr_zero_p(mpc_imagref(r.kernel)));
    sa_track_free(t);
    t = make_track(table1[2], "0");
    ck_assert_int_eq(evaluate(&r, t, "1.9", "0.001", "0", 30), CV_OK);
    ck_assert(mpfr_zero_p(mpc_realref(r.zeta)) && !mpfr_zero_p(mpc_imagref(r.zeta)));
    result_clear(&r);
    sa_track_free(t);
}
END_TEST

/* mu_b = 3, kappa_b = 1, mu_s = 1/2, kappa_p = 3 at q = 1: ground 1 - 3 = -2, with the ballast in series 2,
 * less the sleeper 3/2, with the pad in series 1, less the rail 0: p = 0 is a double pole of the load at
 * rest. */
START_TEST(a_branch_point_is_undecided)
{
    const char *const values[6] = {"0.5", "3", "3", "1", "0", "-0.1"};
    sa_track *undamped = make_track(values, "0"), *damped = make_track(values, "1e-30");
    result r;
    result_init(&r);
    ck_assert_int_eq(evaluate(&r, undamped, "0", "1", "0", 20), CV_UNDECIDED);
    ck_assert_int_eq(evaluate(&r, undamped, "0", "1.0000000000000000000000000000001", "0", 20), CV_OK);
    ck_assert_int_eq(evaluate(&r, damped, "0", "1", "0", 20), CV_OK);
    result_clear(&r);
    sa_track_free(undamped);
    sa_track_free(damped);
}
END_TEST

/* A velocity closer to alpha^2 mu_b = eta_s than any double, on both sides, and on it. */
START_TEST(infinite_pole_at_any_distance)
{
    const char *const values[6] = {"6", "35", "300", "7", "8.75", "0"};
    const char *const velocities[] = {"0.5", "0.4999999999999999999999999999999999999999",
                                      "0.5000000000000000000000000000000000000001"};
    const char *const dampings[] = {"0", "1e-10", "0.1"};
    for (int level = 0; level < 3; level++) {
        sa_track *t = make_track(values, dampings[level]);
        result r[3];
        for (int i = 0; i < 3; i++) {
            result_init(&r[i]);
            ck_assert_int_eq(evaluate(&r[i], t, velocities[i], "0.7", "0", 30), CV_OK);
            ck_assert(both_agree(r[i].zeta, r[0].zeta, 30));
        }
        for (int i = 0; i < 3; i++)
            result_clear(&r[i]);
        sa_track_free(t);
    }
}
END_TEST

START_TEST(wrong_arguments_are_refused)
{
    sa_track *t = make_track(table1[0], "0.05");
    result r;
    result_init(&r);
    ck_assert_int_eq(evaluate(&r, t, "-0.1", "1", "0", 20), CV_BAD_INPUT);
    ck_assert_int_eq(evaluate(&r, t, "0.1", "1", "0", 0), CV_BAD_INPUT);
    ck_assert_int_eq(evaluate(&r, t, "0.1", "1", "0", 100000), CV_BAD_INPUT);
    result_clear(&r);
    sa_track_free(t);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic kernel");
    TCase *tests = tcase_create("kernel");
    tcase_add_checked_fixture(tests, setup, teardown);
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, static_deflection_is_that_of_springs_in_series);
    tcase_add_test(tests, printed_13_is_four_times_the_static_deflection);
    tcase_add_test(tests, load_at_rest_has_a_closed_form);
    tcase_add_test(tests, moving_force_on_massless_layers_has_a_closed_form);
    tcase_add_test(tests, values_of_the_referee_to_40_digits);
    tcase_add_test(tests, more_digits_confirm_fewer);
    tcase_add_test(tests, mirror_image);
    tcase_add_test(tests, upper_and_lower_poles_meet_at_the_load);
    tcase_add_test(tests, zero_damping_is_a_limit);
    tcase_add_test(tests, parts_that_vanish_are_exactly_zero);
    tcase_add_test(tests, a_branch_point_is_undecided);
    tcase_add_test(tests, infinite_pole_at_any_distance);
    tcase_add_test(tests, wrong_arguments_are_refused);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
