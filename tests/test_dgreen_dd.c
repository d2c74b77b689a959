/* Double-double against MPFR with several times the bits: arithmetic, coefficients, zeta with its bounds. */
#include <check.h>
#include <math.h>

#include "dgreen/operator_dd.h"
#include "dgreen/operator_mp.h"
#include "dgreen/z_dd.h"
#include "dgreen/z_mp.h"
#include "tests/dgreen_points.h"

enum { BITS = 600 };

static gsl_rng *rng;
static mpfr_t x, y, truth, error, alpha_mp, q_mp;
static mpc_t exact, qbar_mp;
static mpfr_t re_error, im_error;

static void setup(void)
{
    rng = random_start("test_dgreen_dd", 20240305);
    mpfr_inits2(BITS, x, y, truth, error, alpha_mp, q_mp, re_error, im_error, (mpfr_ptr)0);
    mpc_init2(exact, BITS);
    mpc_init2(qbar_mp, BITS);
}

static void teardown(void)
{
    gsl_rng_free(rng);
    mpfr_clears(x, y, truth, error, alpha_mp, q_mp, re_error, im_error, (mpfr_ptr)0);
    mpc_clear(exact);
    mpc_clear(qbar_mp);
}

static void put(mpfr_ptr to, dg_dd a)
{
    mpfr_set_d(to, a.hi, MPFR_RNDN);
    mpfr_add_d(to, to, a.lo, MPFR_RNDN);
}

/* |a - truth| relative to truth, in units */
static double units_off(dg_dd a)
{
    put(error, a);
    mpfr_sub(error, error, truth, MPFR_RNDN);
    if (mpfr_zero_p(error))
        return 0;
    mpfr_div(error, error, truth, MPFR_RNDN);
    return fabs(mpfr_get_d(error, MPFR_RNDA)) / DG_DD_UNIT;
}

static dg_dd random_dd(void)
{
    const double hi = (gsl_rng_uniform(rng) - 0.5) * ldexp(1, (int)gsl_rng_uniform_int(rng, 60) - 30);
    return dg_dd_two(hi, hi * (gsl_rng_uniform(rng) - 0.5) * 0x1p-53);
}

static int is_normal(dg_dd a)
{
    return a.hi + a.lo == a.hi;
}

/* Each operation is within one unit, sums of nearly opposite numbers too. */
START_TEST(arithmetic)
{
    for (int i = 0; i < 200000; i++) {
        const dg_dd a = random_dd();
        dg_dd b = random_dd();
        if (i % 3 == 0) { /* close to -a, down to its last bits */
            b = dg_dd_negative(a);
            b.lo += a.hi * ldexp(gsl_rng_uniform(rng) - 0.5, -(int)gsl_rng_uniform_int(rng, 60) - 53);
            b = dg_dd_two(b.hi, b.lo);
        }
        put(x, a);
        put(y, b);
        const dg_dd sum = dg_dd_add(a, b), product = dg_dd_mul(a, b), quotient = dg_dd_div(a, b);
        ck_assert(is_normal(sum) && is_normal(product) && is_normal(quotient));
        mpfr_add(truth, x, y, MPFR_RNDN);
        ck_assert(units_off(sum) <= 1);
        mpfr_mul(truth, x, y, MPFR_RNDN);
        ck_assert(units_off(product) <= 1);
        mpfr_div(truth, x, y, MPFR_RNDN);
        ck_assert(units_off(quotient) <= 1);
    }
}
END_TEST

/* |part - truth| <= 72 units of its size */
static void check_coefficient(dg_dd part, mpfr_srcptr exact_part, double size)
{
    put(error, part);
    mpfr_sub(error, error, exact_part, MPFR_RNDN);
    ck_assert(fabs(mpfr_get_d(error, MPFR_RNDA)) <= 72 * DG_DD_UNIT * size);
}

/* The coefficients against MPFR, at any qbar */
START_TEST(coefficients)
{
    dg_mp_operator wide;
    dg_mp_operator_init(&wide, BITS);
    for (int i = 0; i < 200; i++) {
        dg_track *t = random_damped_track(rng);
        dg_constants constants;
        dg_dd_operator op;
        double alpha, q;
        random_point(&alpha, &q, t, rng);
        const double sigma = i % 2 ? log_uniform(rng, 1e-3, 5) : 0;
        mpfr_set_d(alpha_mp, alpha, MPFR_RNDN);
        mpc_set_d_d(qbar_mp, sigma, q, MPC_RNDNN);
        dg_constants_init(&constants, t, BITS);
        dg_mp_operator_set(&wide, t, &constants, alpha_mp, qbar_mp);
        ck_assert_int_eq(dg_dd_operator_set(&op, t, alpha, CMPLX(sigma, q)), CV_OK);
        for (int k = 0; k <= DG_DEGREE; k++) {
            check_coefficient(op.delta[k].re, mpc_realref(wide.delta.c[k]), op.rounded.size_re[k]);
            check_coefficient(op.delta[k].im, mpc_imagref(wide.delta.c[k]), op.rounded.size_im[k]);
        }
        for (int k = 0; k <= DG_R_DEGREE; k++) {
            check_coefficient(op.r[k].re, mpc_realref(wide.r.c[k]), op.rounded.r_size_re[k]);
            check_coefficient(op.r[k].im, mpc_imagref(wide.r.c[k]), op.rounded.r_size_im[k]);
        }
        dg_constants_clear(&constants);
        dg_track_free(t);
    }
    dg_mp_operator_clear(&wide);
}
END_TEST

static void assert_within(double part, double bound, mpfr_srcptr exact_part, mpfr_srcptr exact_error)
{
    mpfr_sub_d(error, exact_part, part, MPFR_RNDN);
    const double off = fabs(mpfr_get_d(error, MPFR_RNDA));
    ck_assert_msg(off <= bound + mpfr_get_d(exact_error, MPFR_RNDU), "off %g, bound %g", off, bound);
}

/* zeta at alpha, i q from a cold start: 1 decided (and then within its bounds), 0 not */
static int check_zeta(int *tight, const dg_track *t, double alpha, double q)
{
    dg_operator op;
    dg_roots roots;
    dg_value v;
    dg_operator_set(&op, t, alpha, CMPLX(0, q));
    ck_assert_int_eq(dg_roots_cold(&roots, &op), CV_OK);
    const cv_status status = dg_dd_zeta(&v, &roots, t, alpha, CMPLX(0, q));
    ck_assert(status == CV_OK || status == CV_UNDECIDED);
    if (status != CV_OK)
        return 0;
    mpfr_set_d(alpha_mp, alpha, MPFR_RNDN);
    mpfr_set_d(q_mp, q, MPFR_RNDN);
    ck_assert_int_eq(dg_zeta_mp(exact, re_error, im_error, t, alpha_mp, q_mp, BITS), CV_OK);
    assert_within(v.re, v.re_error, mpc_realref(exact), re_error);
    assert_within(v.im, v.im_error, mpc_imagref(exact), im_error);
    *tight += v.re_error <= 1e-15 * fabs(v.re) && v.im_error <= 1e-15 * fabs(v.im);
    return 1;
}

/* On random tracks of (31), next to branch points and to the degree drop: nearly everything is decided, and
 * to all digits of a double. */
START_TEST(bounds_hold)
{
    int decided = 0, tight = 0, points = 0;
    for (int i = 0; i < 300; i++) {
        dg_track *t = random_damped_track(rng);
        for (int k = 0; k < 5; k++, points++) {
            double alpha, q;
            random_point(&alpha, &q, t, rng);
            decided += check_zeta(&tight, t, alpha, q);
        }
        dg_track_free(t);
    }
    printf("of %d points double-double decides %d, %d to all digits\n", points, decided, tight);
    ck_assert_int_ge(decided, points * 98 / 100);
    ck_assert_int_ge(tight, points * 9 / 10);
}
END_TEST

/* Where double cannot: four roots in a cluster at q/alpha, two waves that nearly cross (damping below 1e-6),
 * both found in searches. */
START_TEST(clusters)
{
    const struct {
        const char *track;
        double alpha, q;
    } at[] = {
        {"6 35 300 7 1e-10 1e-10 1e-10 0 0", 0.133787, 321.925},
        {"3 10 0.03 0.1 1e-10 1e-10 1e-10 0 0", 0.4, 90},
        {"2.2312 5.77925 0.044697 10.2524 6.14e-10 4.71e-7 2.36e-8 70.6988 -0.902503", 1.83437, 36.0044},
        {"2.2312 5.77925 0.044697 10.2524 6.14e-10 4.71e-7 2.36e-8 70.6988 -0.902503", 0.0916643, 23.0137}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        dg_track *t = track_of(at[i].track);
        int tight = 0;
        ck_assert_int_eq(check_zeta(&tight, t, at[i].alpha, at[i].q), 1);
        ck_assert_int_eq(tight, 1);
        dg_track_free(t);
    }
}
END_TEST

/* Parameters whose products leave the range in which the arithmetic keeps its promise are refused. */
START_TEST(out_of_range)
{
    const char *tracks[] = {"1e40 1e40 1e40 1e40 0.1 0.1 0.1 0 0", "1e-60 1e-60 1e-60 1 0.1 0.1 0.1 0 0",
                            "6 35 300 7 1e-290 1e-290 1e-290 0 0"};
    for (int i = 0; i < 3; i++) {
        dg_track *t = track_of(tracks[i]);
        dg_roots roots = {.count = DG_DEGREE};
        dg_value v;
        const cv_status status = dg_dd_zeta(&v, &roots, t, 0.3, CMPLX(0, 0.2));
        ck_assert(status == CV_UNDECIDED);
        dg_track_free(t);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen double-double");
    TCase *c = tcase_create("dd");
    tcase_set_timeout(c, 30);
    tcase_add_checked_fixture(c, setup, teardown);
    tcase_add_test(c, arithmetic);
    tcase_add_test(c, coefficients);
    tcase_add_test(c, bounds_hold);
    tcase_add_test(c, clusters);
    tcase_add_test(c, out_of_range);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
