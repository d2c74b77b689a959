/* Nondimensionalisation (3)-(6), (11): by hand, against formulas from elsewhere, and there and back. */
#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/track.h"
#include "tests/seed.h"

static void parse(cv_number *x, const char *text)
{
    cv_message why = {""};
    ck_assert_msg(cv_number_parse(x, text, &why) == CV_OK, "%s: %s", text, why.text);
}

static void assert_equals(const cv_number *x, const char *text)
{
    cv_number expected;
    cv_number_init(&expected);
    parse(&expected, text);
    ck_assert_msg(cv_number_compare(x, &expected) == 0, "%.17g is not %s", cv_number_get_double(x), text);
    cv_number_clear(&expected);
}

/* By hand: with EI = 1e6 and k_f = 64e6, chi = (64e6 / 4e6)^(1/4) = 2; with m = 100, v_ref = sqrt(64e4) / 2 =
 * 400; sqrt(m k_f) = 8e4 and sqrt(k_f EI) = 8e6. */
static void set_example(cv_track *t)
{
    cv_track_init(t);
    parse(&t->EI, "1e6");
    parse(&t->m, "100");
    parse(&t->k_f, "64e6");
    parse(&t->k_p, "192e6");
    parse(&t->k_b, "32e6");
    parse(&t->m_s, "300");
    parse(&t->m_b, "1050");
    parse(&t->c_p, "16e3");
    parse(&t->c_b, "8e3");
    parse(&t->c_f, "1.6e-5");
    parse(&t->k_s, "3.2e6");
    parse(&t->N, "-1.6e6");
    parse(&t->M, "5000");
    parse(&t->P, "128e3");
}

START_TEST(example_by_hand)
{
    cv_track t;
    cv_params p;
    cv_number eta_M;
    cv_message why;
    set_example(&t);
    cv_params_init(&p);
    cv_number_init(&eta_M);
    ck_assert_int_eq(cv_track_to_params(&p, &t, &why), CV_OK);
    assert_equals(&p.mu_s, "3");
    assert_equals(&p.mu_b, "10.5");
    assert_equals(&p.kappa_p, "3");
    assert_equals(&p.kappa_b, "0.5");
    assert_equals(&p.eta_p, "0.1");
    assert_equals(&p.eta_b, "0.05");
    assert_equals(&p.eta_f, "1e-10");
    assert_equals(&p.eta_s, "0.2");
    assert_equals(&p.eta_N, "-0.1");
    ck_assert_int_eq(cv_track_mass_ratio(&eta_M, &t, &why), CV_OK);
    assert_equals(&eta_M, "100"); /* 5000 kg * 2 1/m / 100 kg/m */
    cv_number_clear(&eta_M);
    cv_params_clear(&p);
    cv_track_clear(&t);
}
END_TEST

START_TEST(references_by_hand)
{
    cv_track t;
    mpfr_t x;
    set_example(&t);
    mpfr_init2(x, 300);
    cv_track_chi(x, &t);
    ck_assert(mpfr_cmp_ui(x, 2) == 0);
    cv_track_reference_velocity(x, &t);
    ck_assert(mpfr_cmp_ui(x, 400) == 0);
    cv_track_static_deflection(x, &t); /* 128e3 * 2 / (2 * 64e6) = 0.002 */
    mpfr_mul_ui(x, x, 500, MPFR_RNDN);
    ck_assert(mpfr_cmp_ui(x, 1) == 0);
    mpfr_clear(x);
    cv_track_clear(&t);
}
END_TEST

static void set_rail(cv_track *t)
{
    cv_track_init(t);
    parse(&t->EI, "6380430");
    parse(&t->m, "60.21");
    parse(&t->k_f, "1.422e8");
    parse(&t->P, "95647");
}

/* Hetenyi, Beams on Elastic Foundation (1946): deflection P / (8 EI beta^3) under the force, beta^4 = k/(4
 * EI). */
START_TEST(static_deflection_of_a_winkler_beam)
{
    cv_track t;
    mpfr_t w_st;
    set_rail(&t);
    mpfr_init2(w_st, 53);
    cv_track_static_deflection(w_st, &t);
    const double EI = 6380430, beta = pow(1.422e8 / (4 * EI), 0.25);
    const double expected = 95647 / (8 * EI * beta * beta * beta);
    ck_assert(fabs(mpfr_get_d(w_st, MPFR_RNDN) - expected) <= 1e-14 * expected);
    mpfr_clear(w_st);
    cv_track_clear(&t);
}
END_TEST

/* v_ref is the least phase velocity of the Winkler beam, sqrt((EI k^4 + k_f) / m) / k. */
START_TEST(reference_velocity_is_the_least_phase_velocity)
{
    cv_track t;
    mpfr_t v_ref;
    set_rail(&t);
    mpfr_init2(v_ref, 53);
    cv_track_reference_velocity(v_ref, &t);
    double least = INFINITY;
    for (double k = 0.1; k < 30; k *= 1.00001)
        least = fmin(least, sqrt((6380430 * k * k * k * k + 1.422e8) / 60.21) / k);
    ck_assert(fabs(mpfr_get_d(v_ref, MPFR_RNDN) - least) <= 1e-9 * least);
    mpfr_clear(v_ref);
    cv_track_clear(&t);
}
END_TEST

static void random_number(cv_number *x, seed_random *r, int allow_negative)
{
    char text[60];
    snprintf(text, sizeof text, "%s%u.%u%ue%d", allow_negative && seed_below(r, 2) ? "-" : "",
             1 + seed_below(r, 1000000000), seed_below(r, 1000000000), seed_below(r, 1000000000),
             (int)seed_below(r, 20) - 15);
    parse(x, text);
}

static void random_params(cv_params *p, seed_random *r)
{
    cv_number *const positive[] = {&p->mu_s,  &p->mu_b,  &p->kappa_p, &p->kappa_b,
                                   &p->eta_p, &p->eta_b, &p->eta_f,   &p->eta_s};
    cv_params_init(p);
    for (size_t i = 0; i < sizeof positive / sizeof positive[0]; ++i)
        random_number(positive[i], r, 0);
    random_number(&p->eta_N, r, 1);
}

static void assert_same(const cv_params *p, const cv_params *q)
{
    ck_assert_int_eq(cv_number_compare(&p->mu_s, &q->mu_s), 0);
    ck_assert_int_eq(cv_number_compare(&p->mu_b, &q->mu_b), 0);
    ck_assert_int_eq(cv_number_compare(&p->kappa_p, &q->kappa_p), 0);
    ck_assert_int_eq(cv_number_compare(&p->kappa_b, &q->kappa_b), 0);
    ck_assert_int_eq(cv_number_compare(&p->eta_p, &q->eta_p), 0);
    ck_assert_int_eq(cv_number_compare(&p->eta_b, &q->eta_b), 0);
    ck_assert_int_eq(cv_number_compare(&p->eta_f, &q->eta_f), 0);
    ck_assert_int_eq(cv_number_compare(&p->eta_s, &q->eta_s), 0);
    ck_assert_int_eq(cv_number_compare(&p->eta_N, &q->eta_N), 0);
}

START_TEST(there_and_back_is_exact)
{
    seed_random r = seed_start("there_and_back_is_exact");
    cv_number rail[3], eta_M, back;
    for (int i = 0; i < 3; ++i)
        cv_number_init(&rail[i]);
    cv_number_init(&eta_M);
    cv_number_init(&back);
    for (int i = 0; i < 300; ++i) {
        cv_params p, q;
        cv_track t;
        cv_message why = {""};
        random_params(&p, &r);
        cv_params_init(&q);
        cv_track_init(&t);
        for (int j = 0; j < 3; ++j)
            random_number(&rail[j], &r, 0);
        random_number(&eta_M, &r, 0);
        ck_assert_int_eq(cv_track_from_params(&t, &p, &eta_M, &rail[0], &rail[1], &rail[2], &why), CV_OK);
        ck_assert_int_eq(cv_track_to_params(&q, &t, &why), CV_OK);
        assert_same(&p, &q);
        ck_assert(cv_number_is_rational(&q.eta_p) && cv_number_is_rational(&q.eta_N));
        ck_assert_int_eq(cv_track_mass_ratio(&back, &t, &why), CV_OK);
        ck_assert_int_eq(cv_number_compare(&eta_M, &back), 0);
        cv_track_clear(&t);
        cv_params_clear(&p);
        cv_params_clear(&q);
    }
    for (int i = 0; i < 3; ++i)
        cv_number_clear(&rail[i]);
    cv_number_clear(&eta_M);
    cv_number_clear(&back);
}
END_TEST

START_TEST(back_and_there_is_exact)
{
    cv_track t, u;
    cv_params p;
    cv_number eta_M;
    cv_message why;
    set_example(&t);
    parse(&t.m, "60.21"); /* now chi, sqrt(m k_f) and sqrt(k_f EI) are irrational */
    parse(&t.EI, "6380430");
    cv_track_init(&u);
    cv_params_init(&p);
    cv_number_init(&eta_M);
    ck_assert_int_eq(cv_track_to_params(&p, &t, &why), CV_OK);
    ck_assert(!cv_number_is_rational(&p.eta_p));
    ck_assert_int_eq(cv_track_mass_ratio(&eta_M, &t, &why), CV_OK);
    ck_assert_int_eq(cv_track_from_params(&u, &p, &eta_M, &t.EI, &t.m, &t.k_f, &why), CV_OK);
    const cv_number *const both[][2] = {
        {&t.k_p, &u.k_p}, {&t.c_p, &u.c_p}, {&t.m_s, &u.m_s}, {&t.k_b, &u.k_b}, {&t.c_b, &u.c_b},
        {&t.m_b, &u.m_b}, {&t.k_s, &u.k_s}, {&t.c_f, &u.c_f}, {&t.N, &u.N},     {&t.M, &u.M}};
    for (size_t i = 0; i < sizeof both / sizeof both[0]; ++i)
        ck_assert_int_eq(cv_number_compare(both[i][0], both[i][1]), 0);
    ck_assert_int_eq(cv_number_sign(&u.P), 0);
    cv_number_clear(&eta_M);
    cv_params_clear(&p);
    cv_track_clear(&t);
    cv_track_clear(&u);
}
END_TEST

START_TEST(wrong_signs_are_named)
{
    cv_track t;
    cv_params p;
    cv_number eta_M;
    cv_message why;
    set_example(&t);
    cv_params_init(&p);
    cv_number_init(&eta_M);
    parse(&t.m_b, "0");
    ck_assert_int_eq(cv_track_to_params(&p, &t, &why), CV_BAD_INPUT);
    ck_assert_str_eq(why.text, "m_b must be > 0");
    parse(&t.m_b, "1");
    parse(&t.c_f, "-1e-200");
    ck_assert_int_eq(cv_track_mass_ratio(&eta_M, &t, &why), CV_BAD_INPUT);
    ck_assert_str_eq(why.text, "c_f must be >= 0");
    parse(&t.c_f, "0");
    parse(&t.M, "-1");
    ck_assert_int_eq(cv_track_mass_ratio(&eta_M, &t, &why), CV_BAD_INPUT);
    ck_assert_int_eq(cv_track_from_params(&t, &p, NULL, &t.M, &t.m, &t.k_f, &why), CV_BAD_INPUT);
    cv_number_clear(&eta_M);
    cv_params_clear(&p);
    cv_track_clear(&t);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("common/track");
    TCase *c = tcase_create("track");
    tcase_add_test(c, example_by_hand);
    tcase_add_test(c, references_by_hand);
    tcase_add_test(c, static_deflection_of_a_winkler_beam);
    tcase_add_test(c, reference_velocity_is_the_least_phase_velocity);
    tcase_add_test(c, there_and_back_is_exact);
    tcase_add_test(c, back_and_there_is_exact);
    tcase_add_test(c, wrong_signs_are_named);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
