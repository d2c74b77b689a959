/* Interval arithmetic, double (rect.h) and MPC (box.h): the result of an operation on exact points of the
 * operands lies in the result of the operation on the operands. */
#include <check.h>
#include <math.h>

#include "tests/enclosure.h"
#include "tests/random_track.h"

static gsl_rng *rng;

static void setup(void)
{
    rng = random_start("test_semianalytic_rect", 11);
}

static void teardown(void)
{
    gsl_rng_free(rng);
}

/* magnitudes from 1e-25 to 1e5 in each part, radii from nothing to the size of the part */
static double any_number(void)
{
    return log_uniform(rng, 1e-25, 1e5) * (gsl_rng_uniform_int(rng, 2) ? 1 : -1);
}

static double any_radius(double part)
{
    return gsl_rng_uniform_int(rng, 4) == 0 ? 0 : fabs(part) * log_uniform(rng, 1e-20, 0.5);
}

static sa_rect any_rect(void)
{
    double re = any_number(), im = any_number();
    return (sa_rect){re, im, any_radius(re), any_radius(im)};
}

/* A point of the rectangle: a corner or, one time in three, inside; exact. */
static void point_of(mpc_t out, sa_rect r)
{
    double x = gsl_rng_uniform_int(rng, 3) == 0 ? 2 * gsl_rng_uniform(rng) - 1
               : gsl_rng_uniform_int(rng, 2)    ? 1
                                                : -1;
    double y = gsl_rng_uniform_int(rng, 2) ? 1 : -1;
    mpfr_t shift;
    mpfr_init2(shift, EXACT);
    mpc_set_d_d(out, r.re, r.im, MPC_RNDNN);
    mpfr_set_d(shift, r.re_rad, MPFR_RNDN);
    mpfr_mul_d(shift, shift, x, MPFR_RNDN);
    mpfr_add(mpc_realref(out), mpc_realref(out), shift, MPFR_RNDN);
    mpfr_set_d(shift, r.im_rad, MPFR_RNDN);
    mpfr_mul_d(shift, shift, y, MPFR_RNDN);
    mpfr_add(mpc_imagref(out), mpc_imagref(out), shift, MPFR_RNDN);
    mpfr_clear(shift);
}

START_TEST(every_operation_on_rectangles_encloses)
{
    mpc_t x, y, z;
    mpc_init2(x, EXACT);
    mpc_init2(y, EXACT);
    mpc_init2(z, EXACT);
    for (int i = 0; i < 20000; i++) {
        sa_rect a = any_rect(), b = any_rect();
        double scale = any_number();
        point_of(x, a);
        point_of(y, b);
        mpc_add(z, x, y, MPC_RNDNN);
        ck_assert(rect_holds(sa_rect_add(a, b), z));
        mpc_mul(z, x, y, MPC_RNDNN);
        ck_assert(rect_holds(sa_rect_mul(a, b), z));
        mpc_sqr(z, x, MPC_RNDNN);
        ck_assert(rect_holds(sa_rect_sqr(a), z));
        mpc_div(z, x, y, MPC_RNDNN);
        ck_assert(rect_holds(sa_rect_div(a, b), z));
        mpc_mul_i(z, x, 1, MPC_RNDNN);
        ck_assert(rect_holds(sa_rect_times_i(a), z));
        mpc_set_d(z, scale, MPC_RNDNN);
        mpc_mul(z, z, x, MPC_RNDNN);
        ck_assert(rect_holds(sa_rect_scale(a, (sa_real){scale, 0}), z));
        mpc_set_d(z, b.re, MPC_RNDNN);
        mpc_add(z, z, x, MPC_RNDNN);
        ck_assert(rect_holds(sa_rect_add_real(a, (sa_real){b.re, b.re_rad}), z));
    }
    mpc_clear(x);
    mpc_clear(y);
    mpc_clear(z);
}
END_TEST

static void box_of(sa_box *out, sa_rect r)
{
    mpc_set_d_d(out->m, r.re, r.im, MPC_RNDNN);
    out->re_rad = r.re_rad;
    out->im_rad = r.im_rad;
}

START_TEST(every_operation_on_boxes_encloses)
{
    mpc_t x, y, z;
    sa_box a, b, c;
    mpc_init2(x, EXACT);
    mpc_init2(y, EXACT);
    mpc_init2(z, EXACT);
    sa_box_init(&a, 127);
    sa_box_init(&b, 127);
    sa_box_init(&c, 127);
    for (int i = 0; i < 5000; i++) {
        sa_rect ra = any_rect(), rb = any_rect();
        box_of(&a, ra);
        box_of(&b, rb);
        point_of(x, ra);
        point_of(y, rb);
        mpc_add(z, x, y, MPC_RNDNN);
        sa_box_add(&c, &a, &b);
        ck_assert(box_holds(&c, z));
        mpc_sub(z, x, y, MPC_RNDNN);
        sa_box_sub(&c, &a, &b);
        ck_assert(box_holds(&c, z));
        mpc_mul(z, x, y, MPC_RNDNN);
        sa_box_mul(&c, &a, &b);
        ck_assert(box_holds(&c, z));
        mpc_sqr(z, x, MPC_RNDNN);
        sa_box_sqr(&c, &a);
        ck_assert(box_holds(&c, z));
        mpc_div(z, x, y, MPC_RNDNN);
        if (sa_box_div(&c, &a, &b))
            ck_assert(box_holds(&c, z));
        sa_box_div(&a, &a, &a); /* outputs may be inputs */
        box_of(&a, (sa_rect){fmod(ra.re, 20), fmod(ra.im, 20), fabs(fmod(ra.re, 20)) * 1e-3, 0});
        mpc_set_d_d(x, fmod(ra.re, 20) * (1 - 0x1p-11), fmod(ra.im, 20), MPC_RNDNN);
        mpc_exp(z, x, MPC_RNDNN);
        sa_box_exp(&c, &a);
        ck_assert(box_holds(&c, z));
    }
    mpc_clear(x);
    mpc_clear(y);
    mpc_clear(z);
    sa_box_clear(&a);
    sa_box_clear(&b);
    sa_box_clear(&c);
}
END_TEST

START_TEST(division_by_a_rectangle_with_zero_is_infinite)
{
    sa_rect b = {1e-3, -1e-9, 2e-3, 1e-9}, q = sa_rect_div(sa_rect_exact(1), b);
    ck_assert(isinf(q.re_rad) && isinf(q.im_rad));
    sa_box x, y;
    sa_box_init(&x, 127);
    sa_box_init(&y, 127);
    box_of(&y, b);
    ck_assert_int_eq(sa_box_div(&x, &y, &y), 0);
    sa_box_clear(&x);
    sa_box_clear(&y);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic interval arithmetic");
    TCase *tests = tcase_create("rect");
    tcase_add_checked_fixture(tests, setup, teardown);
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, every_operation_on_rectangles_encloses);
    tcase_add_test(tests, every_operation_on_boxes_encloses);
    tcase_add_test(tests, division_by_a_rectangle_with_zero_is_infinite);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
