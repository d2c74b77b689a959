/* Points of dgreen's instability lines against zeta at higher precision, and their asymptotes against the
 * limit q -> 0. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/z_mp.h"
#include "tests/dgreen_lines_fixture.h"

/* eta_M zeta = 1 at the point within its bounds, 400 bits, with different signs of Im zeta at the ends */
static void put_back(const dg_line_point *p, const dg_track *t)
{
    mpc_t zeta;
    mpfr_t re_error, im_error, at[2];
    int sign[2];
    mpc_init2(zeta, 400);
    mpfr_inits2(400, re_error, im_error, at[0], at[1], (mpfr_ptr)NULL);
    for (int i = 0; i < 2; i++) {
        const int step = i ? 1 : -1;
        mpfr_set_d(at[0], step * p->alpha_error, MPFR_RNDN);
        mpfr_add(at[0], at[0], p->alpha, MPFR_RNDN);
        mpfr_set_d(at[1], step * p->frequency_error, MPFR_RNDN);
        mpfr_add(at[1], at[1], p->frequency, MPFR_RNDN);
        ck_assert_int_eq(dg_zeta_mp(zeta, re_error, im_error, t, at[0], at[1], 400), CV_OK);
        sign[i] = mpfr_sgn(mpc_imagref(zeta));
        mpfr_mul(mpc_realref(zeta), mpc_realref(zeta), p->mass_ratio, MPFR_RNDN);
        mpfr_sub_ui(mpc_realref(zeta), mpc_realref(zeta), 1, MPFR_RNDN);
        mpfr_div(mpc_realref(zeta), mpc_realref(zeta), p->mass_ratio, MPFR_RNDN);
        mpfr_mul(mpc_realref(zeta), mpc_realref(zeta), p->mass_ratio, MPFR_RNDN);
        ck_assert_double_le(fabs(mpfr_get_d(mpc_realref(zeta), MPFR_RNDN)),
                            2 * p->mass_ratio_error / mpfr_get_d(p->mass_ratio, MPFR_RNDN));
    }
    ck_assert_int_eq(sign[0] * sign[1], -1);
    mpc_clear(zeta);
    mpfr_clears(re_error, im_error, at[0], at[1], (mpfr_ptr)NULL);
}

/* Vertices to 40 digits: at their velocity, then from there at the frequency found; both agree with the
 * vertex. */
START_TEST(test_points)
{
    enum { POINT_DIGITS = 40 };
    fixture f;
    dg_line_point p, back;
    dg_line_point_init(&p);
    dg_line_point_init(&back);
    fixture_init(&f, case4, "1e-10", 0.35, 0.5);
    for (size_t i = 0; i < f.lines.count; i++) {
        const dg_line *l = &f.lines.lines[i];
        const dg_line_vertex *v = &l->vertices[l->count / 2];
        mpfr_t alpha, q;
        cv_message why;
        if (v->turns)
            continue;
        mpfr_init_set_d(alpha, v->alpha, MPFR_RNDN);
        mpfr_init_set_d(q, v->q, MPFR_RNDN);
        ck_assert_msg(dg_line_at_alpha(&p, f.track, alpha, q, v->scale / 10, POINT_DIGITS, &why) == CV_OK,
                      "%s", why.text);
        ck_assert_double_le(p.frequency_error, 1e-40 * v->q);
        ck_assert_double_le(p.mass_ratio_error, 1e-40 * v->mass_ratio);
        ck_assert_double_eq(p.alpha_error, 0);
        ck_assert_double_eq_tol(mpfr_get_d(p.frequency, MPFR_RNDN), v->q, 1.01 * v->q_error + 1e-16 * v->q);
        ck_assert_double_eq_tol(mpfr_get_d(p.mass_ratio, MPFR_RNDN), v->mass_ratio, 1e-9 * v->mass_ratio);
        put_back(&p, f.track);
        ck_assert_msg(dg_line_at_frequency(&back, f.track, p.frequency, alpha, 1e-9 * v->alpha, POINT_DIGITS,
                                           &why) == CV_OK,
                      "%s", why.text);
        put_back(&back, f.track);
        mpfr_sub_d(back.alpha, back.alpha, v->alpha, MPFR_RNDN);
        ck_assert_double_le(fabs(mpfr_get_d(back.alpha, MPFR_RNDN)), 1e-24 * v->alpha);
        mpfr_clears(alpha, q, (mpfr_ptr)0);
    }
    fixture_clear(&f);
    dg_line_point_clear(&p);
    dg_line_point_clear(&back);
}
END_TEST

/* A point is refused where there is no line within reach, or only negative zeta. */
START_TEST(test_points_refused)
{
    dg_track *t = track_of("6 35 300 7 0.1 0.1 0.1 0 0");
    dg_line_point p;
    mpfr_t alpha, none, low, minus;
    cv_message why;
    dg_line_point_init(&p);
    mpfr_init2(alpha, 53);
    mpfr_init2(none, 53);
    mpfr_set_d(alpha, 0.3, MPFR_RNDN);
    mpfr_set_zero(none, 1);
    mpfr_init_set_d(low, 1e-3, MPFR_RNDN);
    mpfr_init_set_d(minus, -1, MPFR_RNDN);
    ck_assert_int_eq(dg_line_at_alpha(&p, t, alpha, low, 1e-4, 20, &why), CV_UNDECIDED);
    ck_assert_int_eq(dg_line_at_alpha(&p, t, alpha, minus, 1e-4, 20, &why), CV_BAD_INPUT);
    ck_assert_int_eq(dg_line_at_alpha(&p, t, alpha, alpha, 0, 20, &why), CV_BAD_INPUT);
    ck_assert_int_eq(dg_line_at_frequency(&p, t, none, alpha, 0.1, 20, &why), CV_BAD_INPUT);
    mpfr_clears(alpha, none, low, minus, (mpfr_ptr)0);
    dg_line_point_clear(&p);
    dg_track_free(t);
}
END_TEST

/* At q = 1e-30: zeta = -4 q^2 S0 - 4 i q^3 S1 up to relative q^2. */
static void check_low_frequency(const dg_track *t, double alpha)
{
    mpc_t zeta;
    mpfr_t s0, s1, re_error, im_error, a, q;
    mpc_init2(zeta, 700);
    mpfr_inits2(700, s0, s1, re_error, im_error, a, q, (mpfr_ptr)NULL);
    mpfr_set_d(a, alpha, MPFR_RNDN);
    mpfr_set_d(q, 1e-30, MPFR_RNDN);
    ck_assert_int_eq(dg_low_frequency(s0, s1, t, a, 511), CV_OK);
    ck_assert_int_eq(dg_zeta_mp(zeta, re_error, im_error, t, a, q, 700), CV_OK);
    for (int i = 0; i < 3; i++) {
        if (i < 2)
            mpfr_div(mpc_realref(zeta), mpc_realref(zeta), q, MPFR_RNDN);
        mpfr_div(mpc_imagref(zeta), mpc_imagref(zeta), q, MPFR_RNDN);
    }
    ck_assert_double_eq_tol(mpfr_get_d(mpc_realref(zeta), MPFR_RNDN) / (-4 * mpfr_get_d(s0, MPFR_RNDN)), 1,
                            1e-14);
    ck_assert_double_eq_tol(mpfr_get_d(mpc_imagref(zeta), MPFR_RNDN) / (-4 * mpfr_get_d(s1, MPFR_RNDN)), 1,
                            1e-14);
    mpc_clear(zeta);
    mpfr_clears(s0, s1, re_error, im_error, a, q, (mpfr_ptr)NULL);
}

START_TEST(test_low_frequency)
{
    gsl_rng *rng = random_start("test_low_frequency", 20261129);
    for (int i = 0; i < 40; i++) {
        dg_track *t = random_damped_track(rng);
        check_low_frequency(t, log_uniform(rng, 0.02, 2));
        dg_track_free(t);
    }
    dg_track *t = track_of("6 4 300 7 0.01 0.01 0.01 1 0"); /* alpha^2 mu_b = eta_s: a root at infinity */
    check_low_frequency(t, 0.5);
    dg_track_free(t);
    gsl_rng_free(rng);
}
END_TEST

static int sign_of_im(const dg_track *t, mpfr_srcptr alpha, double q)
{
    mpc_t zeta;
    mpfr_t re_error, im_error, at;
    mpc_init2(zeta, 500);
    mpfr_inits2(500, re_error, im_error, at, (mpfr_ptr)NULL);
    mpfr_set_d(at, q, MPFR_RNDN);
    ck_assert_int_eq(dg_zeta_mp(zeta, re_error, im_error, t, alpha, at, 500), CV_OK);
    ck_assert_int_lt(mpfr_cmpabs(im_error, mpc_imagref(zeta)), 0);
    const int sign = mpfr_sgn(mpc_imagref(zeta));
    mpc_clear(zeta);
    mpfr_clears(re_error, im_error, at, (mpfr_ptr)NULL);
    return sign;
}

/* Im zeta at q = 1e-25 changes sign across every asymptote, and each for positive masses is the end of at
 * most one line; 60 digits repeat the 20. */
START_TEST(test_asymptotes)
{
    static const char *const levels[] = {"0.05", "1e-10"};
    for (int level = 0; level < 2; level++) {
        fixture f;
        dg_asymptote_list many;
        cv_message why;
        fixture_init(&f, case4, levels[level], 0.3, 0.5);
        ck_assert_int_eq(dg_lines_asymptotes(&many, &f.lines, 60, &why), CV_OK);
        ck_assert_int_eq(many.status, CV_OK);
        ck_assert_uint_eq(many.count, f.lines.asymptotes.count);
        ck_assert_uint_ge(many.count, 1);
        for (size_t i = 0; i < many.count; i++) {
            mpfr_t at;
            mpfr_init2(at, 400);
            mpfr_sub(at, many.items[i].alpha, f.lines.asymptotes.items[i].alpha, MPFR_RNDN);
            ck_assert_double_le(fabs(mpfr_get_d(at, MPFR_RNDN)), f.lines.asymptotes.items[i].error * 1.01);
            ck_assert_double_le(many.items[i].error, 1e-60);
            mpfr_sub_d(at, many.items[i].alpha, 1e-40, MPFR_RNDN);
            const int below = sign_of_im(f.track, at, 1e-25);
            mpfr_add_d(at, many.items[i].alpha, 1e-40, MPFR_RNDN);
            ck_assert_int_eq(below * sign_of_im(f.track, at, 1e-25), -1);
            const double alpha = mpfr_get_d(many.items[i].alpha, MPFR_RNDN);
            int ends = 0;
            for (size_t k = 0; k < f.lines.count; k++)
                for (int e = 0; e < 2; e++)
                    ends += f.lines.lines[k].asymptote[e] == alpha;
            ck_assert_int_le(ends, many.items[i].positive);
            mpfr_clear(at);
        }
        dg_asymptote_list_clear(&many);
        fixture_clear(&f);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen: points of lines");
    TCase *tests = tcase_create("points");
    tcase_add_test(tests, test_points);
    tcase_add_test(tests, test_points_refused);
    tcase_add_test(tests, test_low_frequency);
    tcase_add_test(tests, test_asymptotes);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
