/* Dimensionless parameters: signs, buckling of the resting track, admissible ranges (31). */
#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/params.h"
#include "tests/seed.h"

static void parse(cv_number *x, const char *text)
{
    cv_message why = {""};
    ck_assert_msg(cv_number_parse(x, text, &why) == CV_OK, "%s: %s", text, why.text);
}

static void set_track(cv_params *p, const char *mu_s, const char *mu_b, const char *kappa_p,
                      const char *kappa_b)
{
    cv_params_init(p);
    parse(&p->mu_s, mu_s);
    parse(&p->mu_b, mu_b);
    parse(&p->kappa_p, kappa_p);
    parse(&p->kappa_b, kappa_b);
}

/* Table 1 of the paper */
static const char *const table_1[4][4] = {
    {"6", "35", "300", "7"}, {"6", "35", "30", "7"}, {"6", "5", "0.03", "3"}, {"3", "10", "0.03", "0.1"}};

START_TEST(cases_of_the_paper_are_admissible)
{
    cv_params p;
    cv_message why = {""};
    set_track(&p, table_1[_i][0], table_1[_i][1], table_1[_i][2], table_1[_i][3]);
    ck_assert_int_eq(cv_params_check(&p, &why), CV_OK);
    ck_assert_int_eq(cv_params_warn(&p, &why), 0);
    ck_assert(cv_params_undamped(&p));
    parse(&p.eta_f, "1e-10");
    ck_assert(!cv_params_undamped(&p));
    cv_params_clear(&p);
}
END_TEST

START_TEST(wrong_signs_are_named)
{
    cv_params p;
    cv_message why;
    set_track(&p, "6", "35", "300", "7");
    const struct {
        cv_number *member;
        const char *name;
        int zero_allowed;
    } members[] = {{&p.mu_s, "mu_s", 0},       {&p.mu_b, "mu_b", 0},   {&p.kappa_p, "kappa_p", 0},
                   {&p.kappa_b, "kappa_b", 0}, {&p.eta_p, "eta_p", 1}, {&p.eta_b, "eta_b", 1},
                   {&p.eta_f, "eta_f", 1},     {&p.eta_s, "eta_s", 1}};
    for (size_t i = 0; i < sizeof members / sizeof members[0]; ++i) {
        cv_number saved;
        cv_number_init(&saved);
        cv_number_set(&saved, members[i].member);
        parse(members[i].member, "-1e-300");
        ck_assert_int_eq(cv_params_check(&p, &why), CV_BAD_INPUT);
        ck_assert_ptr_nonnull(strstr(why.text, members[i].name));
        parse(members[i].member, "0");
        ck_assert_int_eq(cv_params_check(&p, &why), members[i].zero_allowed ? CV_OK : CV_BAD_INPUT);
        cv_number_set(members[i].member, &saved);
        cv_number_clear(&saved);
    }
    cv_params_clear(&p);
}
END_TEST

static cv_status check_force(cv_params *p, const char *eta_N, cv_message *why)
{
    parse(&p->eta_N, eta_N);
    return cv_params_check(p, why);
}

/* 1/0.5 + 1/1 + 1 = 4: the layers in series have stiffness 1/4, and p^4/4 - eta_N p^2 + 1/4 has a double real
 * root exactly at eta_N = 1/2. */
START_TEST(buckling_without_shear_is_exact)
{
    cv_params p;
    cv_message why = {""};
    set_track(&p, "1", "2.5", "0.5", "1");
    ck_assert_int_eq(check_force(&p, "0.49999999999999999999999999999999999999999", &why), CV_OK);
    ck_assert_int_eq(check_force(&p, "0.5", &why), CV_BAD_INPUT);
    ck_assert_ptr_nonnull(strstr(why.text, "buckling"));
    ck_assert_ptr_nonnull(strstr(why.text, "critical eta_N = 0.5)"));
    ck_assert_int_eq(check_force(&p, "0.50000000000000000000000000000000000000001", &why), CV_BAD_INPUT);
    ck_assert_int_eq(check_force(&p, "1e300", &why), CV_BAD_INPUT);
    ck_assert_int_eq(check_force(&p, "-1e300", &why), CV_OK); /* tension */
    cv_params_clear(&p);
}
END_TEST

/* The critical force from the derivative of Y/4 + k(Y)/Y: its zero by bisection in long double. */
static long double critical_force(long double kappa_p, long double kappa_b, long double eta_s)
{
    const long double a = 1 / kappa_p + 1 / kappa_b;
    long double low = 1e-12L, high = 1e12L, k = 0;
    for (int i = 0; i < 400; ++i) {
        const long double Y = sqrtl(low * high), series = a + 1 / (1 + eta_s * Y);
        k = 1 / series;
        const long double slope = k * k * eta_s / ((1 + eta_s * Y) * (1 + eta_s * Y)); /* dk/dY */
        if (0.25L - k / (Y * Y) + slope / Y > 0)
            high = Y;
        else
            low = Y;
    }
    return low / 4 + k / low;
}

static double between(seed_random *r, double least, double most)
{
    return exp(log(least) + (log(most) - log(least)) * (double)(seed_next(r) >> 11) * 0x1p-53);
}

static cv_status check_relative_force(cv_params *p, long double critical, long double factor)
{
    char text[60];
    cv_message why;
    snprintf(text, sizeof text, "%.21Le", critical * factor);
    return check_force(p, text, &why);
}

START_TEST(buckling_with_shear)
{
    seed_random r = seed_start("buckling_with_shear");
    for (int i = 0; i < 2000; ++i) {
        char kappa_p[40], kappa_b[40], eta_s[40];
        snprintf(kappa_p, sizeof kappa_p, "%.12e", between(&r, 1e-3, 1e6));
        snprintf(kappa_b, sizeof kappa_b, "%.12e", between(&r, 1e-2, 1e5));
        snprintf(eta_s, sizeof eta_s, "%.12e", between(&r, 1e-4, 1e3));
        cv_params p;
        set_track(&p, "3", "10", kappa_p, kappa_b);
        parse(&p.eta_s, eta_s);
        const long double critical =
            critical_force(strtold(kappa_p, NULL), strtold(kappa_b, NULL), strtold(eta_s, NULL));
        ck_assert_int_eq(check_relative_force(&p, critical, 1 - 1e-11L), CV_OK);
        ck_assert_int_eq(check_relative_force(&p, critical, 1), CV_BAD_INPUT);
        ck_assert_int_eq(check_relative_force(&p, critical, 1 + 1e-11L), CV_BAD_INPUT);
        cv_params_clear(&p);
    }
}
END_TEST

/* The extremes that a case file can hold: no overflow decides wrongly. */
START_TEST(buckling_at_extreme_values)
{
    static const char *const sizes[] = {"1e-300", "1", "1e300"};
    for (int i = 0; i < 27; ++i) {
        cv_params p;
        cv_message why;
        set_track(&p, "1", "1", sizes[i % 3], sizes[i / 3 % 3]);
        parse(&p.eta_s, sizes[i / 9]);
        ck_assert_int_eq(check_force(&p, "1e-299", &why), CV_OK);
        ck_assert_int_eq(check_force(&p, "1e300", &why), CV_BAD_INPUT);
        cv_params_clear(&p);
    }
}
END_TEST

START_TEST(values_outside_the_ranges_are_named)
{
    cv_params p;
    cv_message warning;
    set_track(&p, "6.0000000000000000001", "2.4999999999999999999", "0.03", "10000");
    parse(&p.eta_s, "100.5");
    ck_assert_int_eq(cv_params_warn(&p, &warning), 1);
    ck_assert_ptr_nonnull(strstr(warning.text, "mu_s"));
    ck_assert_ptr_nonnull(strstr(warning.text, "mu_b"));
    ck_assert_ptr_nonnull(strstr(warning.text, "eta_s = 100.5 (0 .. 100)"));
    ck_assert_ptr_null(strstr(warning.text, "kappa"));
    ck_assert_int_eq(cv_params_check(&p, &warning), CV_OK); /* a warning, not an error */
    cv_params_clear(&p);
}
END_TEST

START_TEST(copies_are_separate)
{
    cv_params p, q;
    set_track(&p, "6", "35", "300", "7");
    cv_params_init(&q);
    cv_params_set(&q, &p);
    parse(&p.kappa_b, "8");
    ck_assert(cv_number_get_double(&q.kappa_b) == 7.0);
    ck_assert(cv_number_get_double(&q.mu_b) == 35.0);
    cv_params_clear(&p);
    cv_params_clear(&q);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("common/params");
    TCase *c = tcase_create("params");
    tcase_add_loop_test(c, cases_of_the_paper_are_admissible, 0, 4);
    tcase_add_test(c, wrong_signs_are_named);
    tcase_add_test(c, buckling_without_shear_is_exact);
    tcase_add_test(c, buckling_with_shear);
    tcase_add_test(c, buckling_at_extreme_values);
    tcase_add_test(c, values_outside_the_ranges_are_named);
    tcase_add_test(c, copies_are_separate);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
