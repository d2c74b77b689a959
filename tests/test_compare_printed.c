/* The errors in the print: what DESIGN section 3 says of each must come out, computed. */
#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare/printed.h"
#include "compare/printed_formulas.h"

static cv_casefile file;
static cmp_run run;

static void read_cases(const char *text)
{
    static const cmp_method *const methods[] = {&cmp_method_semianalytic, &cmp_method_dgreen};
    char path[] = "/tmp/critvel-test-XXXXXX";
    cv_message why = {""};
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, text, strlen(text)), (ssize_t)strlen(text));
    ck_assert_int_eq(close(fd), 0);
    cv_status status = cv_casefile_read(&file, path, &why);
    unlink(path);
    ck_assert_msg(status == CV_OK, "%s", why.text);
    ck_assert_int_eq(cmp_run_init(&run, &file, NULL, NULL, methods, &why), CV_OK);
}

static void forget_cases(void)
{
    cmp_run_clear(&run);
    cv_casefile_clear(&file);
    mpfr_free_cache();
}

#define RUN "[run]\ndamping = 0.1\nmass_ratio = 1\n"
/* Case 3 under another name and with its parameters written differently, case 1, and a track of no table. */
#define CASE_3 "[case x]\nmu_s = 6.0\nmu_b = 50e-1\nkappa_p = 3e-2\nkappa_b = 3\neta_s = 0\neta_N = 0\n"
#define CASE_1 "[case 1]\nmu_s = 6\nmu_b = 35\nkappa_p = 300\nkappa_b = 7\neta_s = 0\neta_N = 0\n"
#define CASE_4 "[case 4]\nmu_s = 3\nmu_b = 10\nkappa_p = 0.03\nkappa_b = 0.1\neta_s = 0\neta_N = 0\n"
#define NO_CASE "[case 3]\nmu_s = 6\nmu_b = 5.0001\nkappa_p = 0.03\nkappa_b = 3\neta_s = 0\neta_N = 0\n"

static cmp_printed make(void)
{
    cmp_printed p;
    cv_message why = {""};
    ck_assert_msg(cmp_printed_make(&p, &run, &why) == CV_OK, "%s", why.text);
    return p;
}

/* The row with this in its "printed" column. */
static const cmp_printed_row *row(const cmp_printed *p, const char *printed)
{
    for (size_t i = 0; i < p->count; i++)
        if (strcmp(p->rows[i].printed, printed) == 0)
            return &p->rows[i];
    ck_abort_msg("no row says %s", printed);
}

START_TEST(factor_four_in_13_and_14)
{
    cmp_printed_file data;
    cmp_formula_values v;
    cv_message why = {""};
    read_cases(RUN CASE_1);
    ck_assert_int_eq(cmp_printed_file_read(&data, &why), CV_OK);
    for (int m = 0; m < CMP_METHODS; m++) {
        /* a beam on Winkler's foundation deflects by w_st under its load: 1 */
        ck_assert_int_eq(
            cmp_formula(&v, "static", run.methods[m], &file.alpha_min, &file.alpha_max, &data, &why), CV_OK);
        ck_assert_double_eq_tol(v.derived, 1.0, 1e-5);
        ck_assert_double_eq_tol(v.as_printed, 4.0, 1e-5);
    }
    /* the eigenvalue of a discretised moving beam, known to six decimals, is a root of z = 1 */
    ck_assert_int_eq(
        cmp_formula(&v, "eigenvalue", run.methods[0], &file.alpha_min, &file.alpha_max, &data, &why), CV_OK);
    ck_assert_double_eq_tol(v.derived, 1.0, 2e-5);
    ck_assert_double_eq_tol(v.as_printed, 4.0, 1e-4);
    forget_cases();
}
END_TEST

START_TEST(first_entry_of_17)
{
    cmp_printed_file data;
    cmp_formula_values v;
    cv_message why = {""};
    read_cases(RUN CASE_1);
    ck_assert_int_eq(cmp_printed_file_read(&data, &why), CV_OK);
    ck_assert_int_eq(cmp_formula(&v, "L11", run.methods[0], &file.alpha_min, &file.alpha_max, &data, &why),
                     CV_OK);
    /* 4 (p^4/4 - (q - alpha p)^2 + kappa_p) at alpha = 0.5, q = 0.2, p = 1, kappa_p = 0.03 */
    ck_assert_double_eq_tol(v.derived, 0.76, 1e-12);
    /* with s = i (q - alpha p) for qbar = i q the term -8 alpha qbar D loses 8 alpha^2 p^2 */
    ck_assert_double_eq_tol(v.as_printed, 0.76 - 2.0, 1e-12);
    ck_assert_int_eq(cmp_formula(&v, "L12", run.methods[0], &file.alpha_min, &file.alpha_max, &data, &why),
                     CV_FAILED);
    forget_cases();
}
END_TEST

START_TEST(resonances_of_case_3)
{
    read_cases(RUN CASE_3);
    cmp_printed p = make();
    const cmp_printed_row *first = row(&p, "0.449 (true)");
    ck_assert_str_eq(first->computed, "0.444855 (true)");
    ck_assert(!first->agrees);
    ck_assert_str_eq(row(&p, "0.745 (false)")->computed, "0.745475 (false)");
    ck_assert(row(&p, "0.745 (false)")->agrees);
    ck_assert_str_eq(row(&p, "0.750 (true)")->computed, "0.750040 (true)");
    ck_assert(row(&p, "0.750 (true)")->agrees);
    for (size_t i = 0; i < p.count; i++)
        ck_assert_msg(strstr(p.rows[i].item, "case 4") == NULL, "%s", p.rows[i].item);
    cmp_printed_clear(&p);
    forget_cases();
}
END_TEST

START_TEST(pseudocritical_velocities)
{
    read_cases(RUN CASE_3 CASE_4);
    cmp_printed p = make();
    ck_assert(row(&p, "0.404")->agrees);
    ck_assert(row(&p, "0.304 (max)")->agrees);
    ck_assert(row(&p, "0.329 (max)")->agrees);
    ck_assert(row(&p, "0.329 (min)")->agrees);
    ck_assert(row(&p, "0.293 (active_point)")->agrees);
    ck_assert_ptr_nonnull(strstr(row(&p, "0.329 (max)")->computed, "(max)"));
    ck_assert_ptr_nonnull(strstr(row(&p, "0.329 (min)")->computed, "(min)"));
    cmp_printed_clear(&p);
    forget_cases();
}
END_TEST

START_TEST(formulas_and_notation_differ)
{
    read_cases(RUN CASE_1);
    cmp_printed p = make();
    ck_assert(!row(&p, "G_H")->agrees);
    ck_assert_str_eq(row(&p, "G_H")->computed, "G_Delta");
    ck_assert_str_eq(row(&p, "8 alpha s D_xi")->computed, "8 alpha qbar D_xi");
    ck_assert_str_eq(row(&p, "4.0000")->computed, "1.0000");
    ck_assert(!row(&p, "4.0000")->agrees);
    for (size_t i = 0; i < p.count; i++)
        ck_assert(p.rows[i].item[0] != '\0' && p.rows[i].where[0] != '\0' && p.rows[i].computed[0] != '\0');
    cmp_printed_clear(&p);
    forget_cases();
}
END_TEST

START_TEST(other_tracks_have_nothing_to_do_with_the_print)
{
    read_cases(RUN NO_CASE);
    cmp_printed p = make();
    ck_assert_uint_eq(p.count, 0);
    cmp_printed_clear(&p);
    forget_cases();
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: the print");
    TCase *t = tcase_create("rows");
    tcase_add_test(t, factor_four_in_13_and_14);
    tcase_add_test(t, first_entry_of_17);
    tcase_add_test(t, resonances_of_case_3);
    tcase_add_test(t, pseudocritical_velocities);
    tcase_add_test(t, formulas_and_notation_differ);
    tcase_add_test(t, other_tracks_have_nothing_to_do_with_the_print);
    suite_add_tcase(s, t);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
