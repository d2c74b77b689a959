/* critvel-compare convergence: branches and orders of manufactured lists, and a case of the paper. */
#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/convergence.h"

enum { LEVELS = 6 };

/* Lists at damping 1e-1, 1e-2 ...; the last one is without. */
typedef struct {
    cmp_list lists[LEVELS + 1];
    const cmp_list *pointers[LEVELS];
    double damping[LEVELS];
    cmp_convergence_row rows[LEVELS];
    cmp_convergence study;
} made;

static void made_start(made *x)
{
    for (int i = 0; i <= LEVELS; i++)
        cmp_list_init(&x->lists[i]);
    for (int i = 0; i < LEVELS; i++) {
        x->pointers[i] = &x->lists[i];
        x->damping[i] = pow(10, -i - 1);
    }
}

static void add(cmp_list *list, double alpha, int below, int above)
{
    mpfr_t a, q;
    mpfr_inits2(100, a, q, (mpfr_ptr)0);
    mpfr_set_d(a, alpha, MPFR_RNDN);
    mpfr_set_d(q, 0.25, MPFR_RNDN);
    ck_assert_int_eq(cmp_list_append(list, a, q, 1e-20, 1e-20, below, above, CV_OK, NULL), CV_OK);
    mpfr_clears(a, q, (mpfr_ptr)0);
}

static void made_study(made *x)
{
    cmp_convergence_study(&x->study, x->rows, LEVELS, x->pointers, x->damping, &x->lists[LEVELS]);
}

static void made_end(made *x)
{
    for (int i = 0; i <= LEVELS; i++)
        cmp_list_clear(&x->lists[i]);
}

/* alpha = 0.5 + c eta^order exactly: each order comes out, and so does the distance to the limit. */
START_TEST(orders_are_those_put_in)
{
    static const double orders[] = {1, 0.5, 2.0 / 3, 1.0 / 7, 2};
    for (int k = 0; k < 5; k++) {
        made x;
        made_start(&x);
        for (int i = 0; i < LEVELS; i++)
            add(&x.lists[i], 0.5 + 0.01 * pow(x.damping[i], orders[k]), 0, 2);
        add(&x.lists[LEVELS], 0.5, 0, 2);
        made_study(&x);
        ck_assert_int_eq(x.study.kind, CMP_TENDS);
        ck_assert_int_eq(x.study.jumps, 0);
        ck_assert(isnan(x.rows[0].step) && isnan(x.rows[1].order));
        ck_assert_double_eq_tol(x.rows[3].order, orders[k], 1e-3);
        ck_assert_double_eq_tol(x.rows[3].to_limit, 0.01 * pow(1e-4, orders[k]), 1e-14);
        made_end(&x);
    }
}
END_TEST

/* A pair of transitions comes into being below the former limit: the limit jumps there, and the former one is
 * still in the list. */
START_TEST(a_jump_is_seen)
{
    made x;
    made_start(&x);
    for (int i = 0; i < LEVELS; i++) {
        if (i >= 3) {
            add(&x.lists[i], 0.300 - 1e-3 * x.damping[i], 0, 2);
            add(&x.lists[i], 0.301 + 1e-3 * x.damping[i], 2, 0);
        }
        add(&x.lists[i], 0.5 + x.damping[i] / 100, 0, 2);
    }
    add(&x.lists[LEVELS], 0.3, 0, 2);
    add(&x.lists[LEVELS], 0.301, 2, 0);
    add(&x.lists[LEVELS], 0.5, 0, 2);
    made_study(&x);
    ck_assert_int_eq(x.study.jumps, 1);
    ck_assert_int_eq(x.rows[2].branch, 1);
    ck_assert_int_eq(x.rows[3].branch, 2);
    ck_assert(isnan(x.rows[3].step) && isnan(x.rows[4].order) && isfinite(x.rows[5].order));
    ck_assert_int_eq(x.study.kind, CMP_TENDS);
    made_end(&x);
}
END_TEST

/* The pair is there only without damping: no level is on the branch of the limit. */
START_TEST(a_limit_elsewhere_is_no_limit)
{
    made x;
    made_start(&x);
    for (int i = 0; i < LEVELS; i++)
        add(&x.lists[i], 0.5 + x.damping[i] / 100, 0, 2);
    add(&x.lists[LEVELS], 0.3, 0, 2);
    add(&x.lists[LEVELS], 0.301, 2, 0);
    add(&x.lists[LEVELS], 0.5, 0, 2);
    made_study(&x);
    ck_assert_int_eq(x.study.kind, CMP_ELSEWHERE);
    ck_assert_double_gt(x.rows[LEVELS - 1].to_limit, 0.19);
    made_end(&x);
}
END_TEST

START_TEST(no_limit_is_none)
{
    made x;
    made_start(&x);
    for (int i = 1; i < LEVELS; i++)
        add(&x.lists[i], 0.5, 0, 2);
    add(&x.lists[LEVELS], 0.5, 2, 0); /* regains stability: no stability limit */
    made_study(&x);
    ck_assert_int_eq(x.study.kind, CMP_NONE);
    ck_assert_ptr_null(x.study.limit);
    ck_assert_int_eq(x.rows[0].branch, 0);
    ck_assert_int_eq(x.rows[1].branch, 1);
    ck_assert(isnan(x.rows[LEVELS - 1].to_limit));
    made_end(&x);
}
END_TEST

static void write_file(const char *path, const char *track)
{
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    fprintf(f, "[run]\ndamping = 0.1\nmass_ratio = 100\nalpha = 0.1 0.6\ndigits = 15\n[case 2]\n%s", track);
    ck_assert_int_eq(fclose(f), 0);
}

/* Case 2 at eta_M = 100: away from branch curves zeta is smooth in the damping, so the order is 1. */
START_TEST(case_2_tends_in_first_order)
{
    char path[] = "/tmp/critvel-convergence-XXXXXX";
    cv_casefile file;
    cmp_convergence_run run;
    cv_message why;
    const cmp_listener silent = {NULL, NULL};
    const int descriptor = mkstemp(path);
    ck_assert_int_ge(descriptor, 0);
    write_file(path, "mu_s = 6\nmu_b = 35\nkappa_p = 30\nkappa_b = 7\n");
    ck_assert_int_eq(cv_casefile_read(&file, path, &why), CV_OK);
    ck_assert_int_eq(cmp_convergence_levels(&file, 4, 6, &why), CV_OK);
    ck_assert_uint_eq(file.cases[0].level_count, 3);
    ck_assert_int_eq(cmp_convergence_init(&run, &file, NULL, &why), CV_OK);
    ck_assert_int_eq(cmp_convergence_find(&run, 0, &silent, &why), CV_OK);
    ck_assert_int_eq(run.counts[0][0], CMP_COUNTS_AGREE);
    ck_assert_int_eq(cmp_convergence_verdict(&run), CMP_AGREE);

    const cmp_list *lists[3];
    const double damping[3] = {1e-4, 1e-5, 1e-6};
    cmp_convergence_row rows[3];
    cmp_convergence study;
    for (int i = 0; i < 3; i++)
        lists[i] =
            &run.run.cases[0].levels[i].lists[CMP_DGREEN][0]; /* the other method than that of the limit */
    cmp_convergence_study(&study, rows, 3, lists, damping, &run.undamped[0][0]);
    ck_assert_int_eq(study.kind, CMP_TENDS);
    ck_assert_double_eq_tol(study.order, 1, 0.02);
    ck_assert_double_eq_tol(rows[2].to_limit / rows[1].to_limit, 0.1, 1e-3);

    cmp_convergence_clear(&run);
    cv_casefile_clear(&file);
    remove(path);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("compare convergence");
    TCase *tests = tcase_create("convergence");
    tcase_add_test(tests, orders_are_those_put_in);
    tcase_add_test(tests, a_jump_is_seen);
    tcase_add_test(tests, a_limit_elsewhere_is_no_limit);
    tcase_add_test(tests, no_limit_is_none);
    tcase_add_test(tests, case_2_tends_in_first_order);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
