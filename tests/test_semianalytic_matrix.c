/* Matrix (7): determinant and minor against (7)-(10) written out, slopes against differences, and the
 * interval arithmetic (double and MPC) against exact points of its operands. */
#include <check.h>
#include <math.h>

#include "semianalytic/matrix_box.h"
#include "tests/enclosure.h"
#include "tests/semianalytic_points.h"

static gsl_rng *rng;

static void setup(void)
{
    rng = random_start("test_semianalytic_matrix", 7);
}

static void teardown(void)
{
    gsl_rng_free(rng);
}

/* x = k + 2 i eta w - mu w^2 + e p^2 with w = q - alpha p, as (8)-(10) are printed */
static void entry(mpc_t out, const cv_number *k, const cv_number *eta, const cv_number *mu,
                  const cv_number *e, const mpc_t w, const mpc_t p)
{
    mpfr_t x;
    mpc_t term;
    mpfr_init2(x, EXACT);
    mpc_init2(term, EXACT);
    mpc_set_ui(out, 0, MPC_RNDNN);
    if (k != NULL) {
        cv_number_get_mpfr(x, k);
        mpc_set_fr(out, x, MPC_RNDNN);
    }
    if (eta != NULL) {
        cv_number_get_mpfr(x, eta);
        mpc_mul_fr(term, w, x, MPC_RNDNN);
        mpc_mul_i(term, term, 1, MPC_RNDNN);
        mpc_mul_ui(term, term, 2, MPC_RNDNN);
        mpc_add(out, out, term, MPC_RNDNN);
    }
    if (mu != NULL) {
        cv_number_get_mpfr(x, mu);
        mpc_sqr(term, w, MPC_RNDNN);
        mpc_mul_fr(term, term, x, MPC_RNDNN);
        mpc_sub(out, out, term, MPC_RNDNN);
    }
    if (e != NULL) {
        cv_number_get_mpfr(x, e);
        mpc_sqr(term, p, MPC_RNDNN);
        mpc_mul_fr(term, term, x, MPC_RNDNN);
        mpc_add(out, out, term, MPC_RNDNN);
    }
    mpfr_clear(x);
    mpc_clear(term);
}

/* d2 and d3 of (7) by cofactors. */
static void written_out(mpc_t d2, mpc_t d3, const cv_params *x, double alpha, double complex q,
                        double complex at)
{
    mpc_t w, p, d1, pad, sleeper, ballast, ground, m22, t;
    mpc_t *all[] = {&w, &p, &d1, &pad, &sleeper, &ballast, &ground, &m22, &t};
    cv_number one;
    cv_number_init(&one);
    set_text(&one, "1");
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        mpc_init2(*all[i], EXACT);
    mpc_set_d_d(p, creal(at), cimag(at), MPC_RNDNN);
    mpc_set_d(t, alpha, MPC_RNDNN);
    mpc_mul(t, t, p, MPC_RNDNN);
    mpc_set_d_d(w, creal(q), cimag(q), MPC_RNDNN);
    mpc_sub(w, w, t, MPC_RNDNN);
    entry(d1, NULL, NULL, &one, &x->eta_N, w, p); /* -w^2 + eta_N p^2 */
    mpc_sqr(t, w, MPC_RNDNN);
    mpc_add(d1, d1, t, MPC_RNDNN);
    mpc_add(d1, d1, t, MPC_RNDNN);
    mpc_neg(d1, d1, MPC_RNDNN); /* -w^2 - eta_N p^2 */
    mpc_pow_ui(t, p, 4, MPC_RNDNN);
    mpc_div_ui(t, t, 4, MPC_RNDNN);
    mpc_add(d1, d1, t, MPC_RNDNN);
    entry(pad, &x->kappa_p, &x->eta_p, NULL, NULL, w, p);
    entry(sleeper, NULL, NULL, &x->mu_s, NULL, w, p);
    entry(ballast, &x->kappa_b, &x->eta_b, NULL, NULL, w, p);
    entry(ground, &one, &x->eta_f, &x->mu_b, &x->eta_s, w, p);
    mpc_add(m22, pad, sleeper, MPC_RNDNN);
    mpc_add(m22, m22, ballast, MPC_RNDNN);
    mpc_add(ground, ground, ballast, MPC_RNDNN);
    mpc_mul(d2, m22, ground, MPC_RNDNN);
    mpc_sqr(t, ballast, MPC_RNDNN);
    mpc_sub(d2, d2, t, MPC_RNDNN);
    mpc_add(d1, d1, pad, MPC_RNDNN);
    mpc_mul(d3, d1, d2, MPC_RNDNN);
    mpc_sqr(t, pad, MPC_RNDNN);
    mpc_mul(t, t, ground, MPC_RNDNN);
    mpc_sub(d3, d3, t, MPC_RNDNN);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        mpc_clear(*all[i]);
    cv_number_clear(&one);
}

static double complex any_wave_number(void)
{
    double re = log_uniform(rng, 1e-2, 30), im = log_uniform(rng, 1e-12, 10);
    return CMPLX(gsl_rng_uniform_int(rng, 2) ? re : -re, gsl_rng_uniform_int(rng, 2) ? im : -im);
}

/* d2 and d3 in all three arithmetics; the enclosures hold the exact values. */
START_TEST(determinant_is_that_of_7)
{
    mpc_t d2, d3;
    cv_params p;
    cv_params_init(&p);
    mpc_init2(d2, EXACT);
    mpc_init2(d3, EXACT);
    for (int i = 0; i < 1000; i++) {
        double alpha, q;
        sa_track *t;
        sa_enclosure e;
        sa_point m;
        random_track(&p, rng);
        random_damping(&p, rng);
        random_point(&alpha, &q, &p, rng);
        double complex at = any_wave_number(), frequency = CMPLX(q, i % 4 == 0 ? -0.3 : 0);
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        written_out(d2, d3, &p, alpha, frequency, at);
        sa_matrix_enclose(&e, t, alpha, frequency, sa_rect_exact(at));
        ck_assert(rect_holds(e.w[SA_RAIL], d2) && rect_holds(e.det, d3));
        sa_matrix_point(&m, t, alpha, frequency, at);
        double slack = e.det.re_rad + e.det.im_rad;
        ck_assert_double_le(cabs(m.det - sa_rect_mid(e.det)), 2 * slack);
        sa_track_free(t);
    }
    mpc_clear(d2);
    mpc_clear(d3);
    cv_params_clear(&p);
}
END_TEST

START_TEST(determinant_in_boxes_is_that_of_7)
{
    mpc_t d2, d3;
    cv_params p;
    cv_params_init(&p);
    mpc_init2(d2, EXACT);
    mpc_init2(d3, EXACT);
    for (int i = 0; i < 200; i++) {
        double alpha, q;
        sa_track *t;
        sa_place place;
        sa_box_matrix m;
        cv_number numbers[2];
        random_track(&p, rng);
        random_damping(&p, rng);
        random_point(&alpha, &q, &p, rng);
        double complex at = any_wave_number();
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        for (int k = 0; k < 2; k++) {
            cv_number_init(&numbers[k]);
            mpq_set_d(numbers[k].factor, k == 0 ? alpha : q);
        }
        sa_place_init(&place, t, 191);
        sa_place_set(&place, t, &numbers[0], &numbers[1]);
        sa_box_matrix_init(&m, 191);
        mpc_set_d_d(m.p.m, creal(at), cimag(at), MPC_RNDNN);
        sa_box_matrix_set(&m, &place);
        written_out(d2, d3, &p, alpha, q, at);
        ck_assert(box_holds(&m.w[SA_RAIL], d2) && box_holds(&m.det, d3));
        ck_assert(m.det.re_rad + m.det.im_rad > 0);
        sa_box_matrix_clear(&m);
        sa_place_clear(&place);
        for (int k = 0; k < 2; k++)
            cv_number_clear(&numbers[k]);
        sa_track_free(t);
    }
    mpc_clear(d2);
    mpc_clear(d3);
    cv_params_clear(&p);
}
END_TEST

/* d3' by central differences of the determinant written out; d3' in the enclosure too */
START_TEST(slope_is_that_of_differences)
{
    mpc_t d2, ahead, behind;
    cv_params p;
    cv_params_init(&p);
    mpc_init2(d2, EXACT);
    mpc_init2(ahead, EXACT);
    mpc_init2(behind, EXACT);
    for (int i = 0; i < 300; i++) {
        double alpha, q, h = 0x1p-26;
        sa_track *t;
        sa_enclosure e;
        random_track(&p, rng);
        random_damping(&p, rng);
        random_point(&alpha, &q, &p, rng);
        double complex at = any_wave_number();
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        written_out(d2, ahead, &p, alpha, q, at + h);
        written_out(d2, behind, &p, alpha, q, at - h);
        mpc_sub(ahead, ahead, behind, MPC_RNDNN);
        double width = creal((at + h) - (at - h));
        double complex slope =
            CMPLX(mpfr_get_d(mpc_realref(ahead), MPFR_RNDN), mpfr_get_d(mpc_imagref(ahead), MPFR_RNDN)) /
            width;
        sa_matrix_enclose(&e, t, alpha, q, sa_rect_exact(at));
        sa_matrix_enclose_slope(&e, t, alpha);
        sa_point m;
        sa_matrix_point(&m, t, alpha, q, at);
        double scale = 0; /* the derivative is a sum of terms that may cancel */
        for (int k = 0; k < SA_ELEMENTS; k++)
            scale += cabs(m.d_p[k] * m.w[k]);
        ck_assert_double_le(cabs(slope - sa_rect_mid(e.det_p)), 1e-7 * scale);
        ck_assert_double_le(cabs(m.det_p - sa_rect_mid(e.det_p)), e.det_p.re_rad + e.det_p.im_rad);
        sa_track_free(t);
    }
    mpc_clear(d2);
    mpc_clear(ahead);
    mpc_clear(behind);
    cv_params_clear(&p);
}
END_TEST

/* 0.1 is no double and no binary number at all: the radius must say so; 0.5 needs none; nor may a radical, a
 * ratio of (6), pass for its rounding. */
START_TEST(parameters_enclose_their_exact_values)
{
    cv_number x;
    mpfr_t value, radicand;
    sa_span span;
    cv_number_init(&x);
    mpfr_inits2(EXACT, value, radicand, (mpfr_ptr)0);
    sa_span_init(&span, 127);
    for (int i = 0; i < 500; i++) {
        set_decimal(&x, log_uniform(rng, 1e-3, 1e3));
        if (i % 2)
            mpq_set_ui(x.radicand, 7, 3);
        cv_params p;
        cv_params_init(&p);
        set_params(&p, table1[0], "0.1");
        cv_number_set(&p.mu_s, &x);
        cv_number_set(&p.eta_p, &x);
        sa_track *t;
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        sa_span_set_number(&span, &x);
        mpfr_set_q(value, x.factor, MPFR_RNDN);
        mpfr_set_q(radicand, x.radicand, MPFR_RNDN);
        mpfr_sqrt(radicand, radicand, MPFR_RNDN);
        mpfr_sqrt(radicand, radicand, MPFR_RNDN);
        mpfr_mul(value, value, radicand, MPFR_RNDN);
        ck_assert(part_holds(t->mu_s.m, t->mu_s.r, value));
        mpfr_sub(radicand, value, span.m, MPFR_RNDN);
        mpfr_abs(radicand, radicand, MPFR_RNDN);
        ck_assert(mpfr_cmp_ld(radicand, span.r) <= 0);
        mpfr_mul_ui(value, value, 2, MPFR_RNDN);
        ck_assert(part_holds(t->loss_p.m, t->loss_p.r, value));
        sa_track_free(t);
        cv_params_clear(&p);
    }
    sa_span_clear(&span);
    mpfr_clears(value, radicand, (mpfr_ptr)0);
    cv_number_clear(&x);
}
END_TEST

/* 8.75 = 0.5^2 * 35 exactly; 0.1 and 0.35 are no doubles: 0.1^2 * 35 = 0.35 */
START_TEST(number_of_upper_poles_is_decided_exactly)
{
    const char *const shear[] = {"8.75", "0.35", "0"};
    const char *const velocities[] = {"0.5", "0.1", "0"};
    for (int i = 0; i < 3; i++) {
        const char *const values[6] = {"6", "35", "300", "7", shear[i], "0"};
        sa_track *t = make_track(values, "0.05");
        cv_number alpha;
        int degree;
        cv_number_init(&alpha);
        set_text(&alpha, velocities[i]);
        ck_assert_int_eq(sa_matrix_upper_count(&degree, t, &alpha), 2);
        ck_assert_int_eq(degree, i == 2 ? 4 : 7);
        mpq_t nudge;
        mpq_init(nudge);
        mpq_set_ui(nudge, 1, 1);
        mpq_div_2exp(nudge, nudge, 300);
        mpq_add(alpha.factor, alpha.factor, nudge);
        ck_assert_int_eq(sa_matrix_upper_count(&degree, t, &alpha), 2);
        ck_assert_int_eq(degree, 8);
        mpq_sub(alpha.factor, alpha.factor, nudge);
        mpq_sub(alpha.factor, alpha.factor, nudge);
        if (i < 2)
            ck_assert_int_eq(sa_matrix_upper_count(&degree, t, &alpha), 3);
        ck_assert_int_eq(sa_matrix_upper_count_double(t, strtod(velocities[i], NULL)), 2);
        ck_assert_int_eq(sa_matrix_upper_count_double(t, 2), 2);
        mpq_clear(nudge);
        cv_number_clear(&alpha);
        sa_track_free(t);
    }
}
END_TEST

START_TEST(bad_tracks_are_refused)
{
    const char *const buckled[6] = {"6", "35", "300", "7", "0", "1.5"};
    cv_params p;
    sa_track *t = NULL;
    cv_message why = {""};
    cv_params_init(&p);
    set_params(&p, buckled, "0.05");
    ck_assert_int_eq(sa_track_new(&t, &p, &why), CV_BAD_INPUT);
    ck_assert_ptr_null(t);
    ck_assert_int_ne(why.text[0], '\0');
    cv_params_clear(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic matrix");
    TCase *tests = tcase_create("matrix");
    tcase_add_checked_fixture(tests, setup, teardown);
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, parameters_enclose_their_exact_values);
    tcase_add_test(tests, determinant_is_that_of_7);
    tcase_add_test(tests, determinant_in_boxes_is_that_of_7);
    tcase_add_test(tests, slope_is_that_of_differences);
    tcase_add_test(tests, number_of_upper_poles_is_decided_exactly);
    tcase_add_test(tests, bad_tracks_are_refused);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
