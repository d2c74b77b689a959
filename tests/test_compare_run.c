/* A whole comparison of two manufactured methods: what each kind of fault does to the verdict. */
#include <check.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "compare/countsweep.h"
#include "tests/fake_methods.h"

static const char FILE_TEXT[] =
    "[run]\ndamping = 0.1 1e-10\nmass_ratio = 1 3\nalpha = 0.02 2.0\ndigits = 20\n"
    "[case 1]\nmu_s = 6\nmu_b = 35\nkappa_p = 300\nkappa_b = 7\neta_s = 0\neta_N = 0\n"
    "[case 2]\nmu_s = 6\nmu_b = 35\nkappa_p = 30\nkappa_b = 7\neta_s = 0\neta_N = 0\n";

static const cmp_listener NOBODY = {NULL, NULL};
static cv_casefile file;
static cmp_run run;

static void setup(void)
{
    char path[] = "/tmp/critvel-test-XXXXXX";
    cv_message why = {""};
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, FILE_TEXT, strlen(FILE_TEXT)), (ssize_t)strlen(FILE_TEXT));
    ck_assert_int_eq(close(fd), 0);
    cv_status status = cv_casefile_read(&file, path, &why);
    unlink(path);
    ck_assert_msg(status == CV_OK, "%s", why.text);
    fake_reset();
    ck_assert_int_eq(cmp_run_init(&run, &file, NULL, NULL, FAKES, &why), CV_OK);
}

static void teardown(void)
{
    cmp_run_clear(&run);
    cv_casefile_clear(&file);
    mpfr_free_cache();
}

/* Runs everything and returns the result of the first case, first level, eta_M = 1. */
static const cmp_result *outcome(void)
{
    cv_message why = {""};
    ck_assert_msg(cmp_run_find(&run, 2, &NOBODY, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(cmp_run_judge(&run, 2, &NOBODY, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(cmp_run_search_again(&run, 2, &NOBODY, &why) == CV_OK, "%s", why.text);
    return &run.cases[0].levels[0].results[0];
}

static void expect(cmp_kind kind, const char *word)
{
    const cmp_verdict *v = &outcome()->verdict;
    ck_assert_msg(v->kind == kind, "%s: %s", cmp_kind_name(v->kind), v->reason.text);
    ck_assert_msg(strstr(v->reason.text, word) != NULL, "\"%s\" lacks \"%s\"", v->reason.text, word);
}

START_TEST(faultless_methods_agree)
{
    const cmp_result *r = outcome();
    ck_assert_msg(r->verdict.kind == CMP_AGREE, "%s", r->verdict.reason.text);
    ck_assert_double_eq_tol(r->verdict.digits, 23.1, 0.1); /* 1e-24 at q = 0.125 */
    ck_assert_int_eq(r->counts.start, 0);
    ck_assert_uint_eq(r->counts.samples,
                      FAKE_TRANSITIONS + 3 + CMP_SWEEP); /* ends, between, outside, sweep */
    ck_assert_int_eq(r->searches, 1);
    for (int m = 0; m < CMP_METHODS; m++)
        ck_assert_uint_eq(fake[m].searched[0] + 100 * fake[m].searched[1], 8);
    ck_assert(mpfr_zero_p(r->worst.residual));
    cmp_summary s;
    cmp_run_summary(&s, &run);
    ck_assert_uint_eq(s.total, 8); /* 2 cases, 2 dampings, 2 mass ratios */
    ck_assert_uint_eq(s.of_kind[CMP_AGREE], 8);
    ck_assert_int_eq(s.worst, CMP_AGREE);
    ck_assert_double_eq_tol(s.fewest_digits, 23.1, 0.1); /* not the 20 of the masses without transitions */
}
END_TEST

START_TEST(nothing_found_is_said)
{
    (void)outcome();
    const cmp_result *other_mass = &run.cases[0].levels[0].results[1];
    ck_assert_int_eq(other_mass->verdict.kind, CMP_AGREE);
    ck_assert_double_eq(other_mass->verdict.digits, 20.0);
    ck_assert_str_eq(other_mass->verdict.reason.text, "no transition in the range");
}
END_TEST

START_TEST(one_missing_in_one_list_disagrees)
{
    fake[1].drop = 4;
    expect(CMP_DISAGREE, "only semianalytic has alpha = 1.25");
}
END_TEST

START_TEST(one_missing_in_both_lists_is_caught_by_the_count)
{
    fake[0].drop = fake[1].drop = 4;
    expect(CMP_DISAGREE, "leave 2 unstable roots, its count is 0");
}
END_TEST

START_TEST(a_count_that_differs_disagrees)
{
    fake[1].drop_from_count = 3;
    expect(CMP_DISAGREE, "counts 2 unstable roots, dgreen 4");
}
END_TEST

START_TEST(one_unknown_to_all_lists_and_one_count_disagrees)
{
    fake[0].drop = fake[1].drop = fake[1].drop_from_count = 4;
    expect(CMP_DISAGREE, "");
}
END_TEST

START_TEST(the_same_wrong_value_in_both_is_caught_by_putting_back)
{
    for (int k = 1; k <= FAKE_TRANSITIONS; k++) {
        fake[0].move = fake[1].move = k;
        fake[0].by = fake[1].by = 1e-21; /* 1e-22 .. 1e-21 off, 1e-24 claimed */
        expect(CMP_DISAGREE, "does not satisfy z = 1");
        teardown();
        setup();
    }
}
END_TEST

START_TEST(a_value_off_by_less_than_its_bound_is_kept)
{
    fake[0].move = 2;
    fake[0].by = 2e-24; /* 0.75e-24 off */
    const cmp_result *r = outcome();
    ck_assert_msg(r->verdict.kind == CMP_AGREE, "%s", r->verdict.reason.text);
    ck_assert_double_eq_tol(mpfr_get_d(r->worst.residual, MPFR_RNDN), 0.75e-24, 1e-27);
    ck_assert_double_eq_tol(r->worst.used, 0.75 / 2.25, 1e-3); /* 9/8 (1e-24 + 1e-24) allowed */
}
END_TEST

START_TEST(a_zeta_that_disowns_its_own_transition_disagrees)
{
    fake[1].zeta_offset = 1e-12;
    expect(CMP_DISAGREE, "of semianalytic does not satisfy z = 1 of dgreen");
}
END_TEST

START_TEST(a_zeta_that_is_not_a_number_disagrees)
{
    fake[0].zeta_offset = (double)NAN;
    expect(CMP_DISAGREE, "does not satisfy");
}
END_TEST

START_TEST(a_zeta_too_blunt_to_tell_is_undecided)
{
    fake[1].zeta_bound = 1e-20;
    expect(CMP_UNDECIDED, "sharply enough");
}
END_TEST

START_TEST(a_count_that_cannot_be_had_is_undecided)
{
    fake[0].cannot_count = 1;
    expect(CMP_UNDECIDED, "the fake cannot count");
    const cmp_result *r = &run.cases[0].levels[0].results[0];
    ck_assert_int_eq(r->counts.start, -1);
    ck_assert_uint_eq(r->counts.samples, 0);
}
END_TEST

START_TEST(an_undecided_list_is_undecided)
{
    fake[0].undecided_list = 1;
    expect(CMP_UNDECIDED, "semianalytic could not decide");
}
END_TEST

START_TEST(what_a_denser_search_mends_agrees)
{
    for (int fault = 0; fault < 3; fault++)
        for (int level = 1; level < CMP_SEARCHES; level++) {
            fake[1].drop = fault == 0 ? 2 : 0;
            fake[1].undecided_list = fault == 1;
            fake[0].drop = fault == 2 ? 3 : 0; /* missing in both: seen by the count alone */
            fake[1].drop = fault == 2 ? 3 : fake[1].drop;
            fake[0].mends = fake[1].mends = level;
            const cmp_result *r = outcome();
            ck_assert_msg(r->verdict.kind == CMP_AGREE, "%d: %s", fault, r->verdict.reason.text);
            ck_assert_int_eq(r->searches, level + 1);
            ck_assert_int_eq(r->verdict.incomplete, 0);
            for (int m = 0; m < CMP_METHODS; m++) {
                /* both, and only eta_M = 1 of each case and level */
                ck_assert_uint_eq(fake[m].searched[1], 4);
                ck_assert_uint_eq(fake[m].searched[2], level == 2 ? 4 : 0);
            }
            ck_assert_int_eq(run.cases[0].levels[0].results[1].searches, 1);
            ck_assert_uint_eq(run.cases[0].levels[0].effort[0].evaluations, 1 + (unsigned)level);
            teardown();
            setup();
        }
}
END_TEST

START_TEST(what_no_search_mends_stays)
{
    fake[0].drop = 4;
    expect(CMP_DISAGREE, "only dgreen has alpha = 1.25");
    ck_assert_int_eq(run.cases[0].levels[0].results[0].searches, CMP_SEARCHES);
}
END_TEST

START_TEST(a_wrong_value_is_no_reason_to_search_again)
{
    fake[0].move = 2;
    fake[0].by = 1e-15;
    expect(CMP_DISAGREE, "their bounds allow");
    ck_assert_int_eq(run.cases[0].levels[0].results[0].searches, 1);
    ck_assert_uint_eq(fake[0].searched[1], 0);
}
END_TEST

START_TEST(a_pair_both_searches_missed_in_a_wide_gap_is_caught_by_the_sweep)
{
    fake[0].missed_pair = fake[1].missed_pair = 1; /* not in the middle of 0.5 .. 1.25 */
    expect(CMP_DISAGREE, "of semianalytic leave 2 unstable roots, its count is 4");
    teardown();
    setup();
    fake[1].missed_pair = 1;
    expect(CMP_DISAGREE, "counts 2 unstable roots, dgreen 4");
}
END_TEST

START_TEST(unstable_from_the_start_is_remarked)
{
    fake[0].start = fake[1].start = 2;
    expect(CMP_AGREE, "already 2 unstable roots at the lowest velocity");
    ck_assert_uint_eq(cmp_list_limit(&run.cases[0].levels[0].lists[0][0]), FAKE_TRANSITIONS);
}
END_TEST

START_TEST(other_numbers_at_the_start_disagree)
{
    fake[1].start = 2;
    expect(CMP_DISAGREE, "");
    ck_assert_int_eq(run.cases[0].levels[0].results[1].verdict.kind, CMP_DISAGREE); /* empty lists */
}
END_TEST

START_TEST(transitions_both_searches_missed_altogether_are_caught_by_the_counts)
{
    fake[0].count_all = fake[1].count_all = 1;
    (void)outcome();
    const cmp_verdict *v = &run.cases[0].levels[0].results[1].verdict;
    ck_assert_int_eq(v->kind, CMP_DISAGREE);
    ck_assert_ptr_nonnull(
        strstr(v->reason.text, "has no transition, but 0 unstable roots at the lowest velocity and 2"));
}
END_TEST

START_TEST(failures_are_handed_on)
{
    cv_message why = {""};
    fake[1].find = CV_FAILED;
    ck_assert_int_eq(cmp_run_find(&run, 2, &NOBODY, &why), CV_FAILED);
    ck_assert_str_eq(why.text, "the fake was told to fail");
    fake_reset();
    ck_assert_int_eq(cmp_run_find(&run, 2, &NOBODY, &why), CV_OK);
    fake[1].open = CV_BAD_INPUT;
    ck_assert_int_eq(cmp_run_judge(&run, 2, &NOBODY, &why), CV_BAD_INPUT);
    ck_assert_str_eq(why.text, "the fake does not open");
}
END_TEST

START_TEST(one_case_and_another_damping_can_be_chosen)
{
    cv_number damping;
    cv_message why;
    cmp_run chosen;
    cv_number_init(&damping);
    ck_assert_int_eq(cv_number_parse(&damping, "0.02", &why), CV_OK);
    ck_assert_int_eq(cmp_run_init(&chosen, &file, "2", &damping, FAKES, &why), CV_OK);
    ck_assert_uint_eq(chosen.case_count, 1);
    ck_assert_str_eq(chosen.cases[0].from->name, "2");
    ck_assert_uint_eq(chosen.cases[0].level_count, 1);
    ck_assert_int_eq(cv_number_compare(&chosen.cases[0].levels[0].params.eta_f, &damping), 0);
    cmp_run_clear(&chosen);
    ck_assert_int_eq(cmp_run_init(&chosen, &file, "3", NULL, FAKES, &why), CV_BAD_INPUT);
    cv_number_clear(&damping);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: run");
    TCase *t = tcase_create("manufactured methods");
    tcase_add_checked_fixture(t, setup, teardown);
    tcase_add_test(t, faultless_methods_agree);
    tcase_add_test(t, nothing_found_is_said);
    tcase_add_test(t, one_missing_in_one_list_disagrees);
    tcase_add_test(t, one_missing_in_both_lists_is_caught_by_the_count);
    tcase_add_test(t, a_count_that_differs_disagrees);
    tcase_add_test(t, one_unknown_to_all_lists_and_one_count_disagrees);
    tcase_add_test(t, the_same_wrong_value_in_both_is_caught_by_putting_back);
    tcase_add_test(t, a_value_off_by_less_than_its_bound_is_kept);
    tcase_add_test(t, a_zeta_that_disowns_its_own_transition_disagrees);
    tcase_add_test(t, a_zeta_that_is_not_a_number_disagrees);
    tcase_add_test(t, a_zeta_too_blunt_to_tell_is_undecided);
    tcase_add_test(t, a_count_that_cannot_be_had_is_undecided);
    tcase_add_test(t, an_undecided_list_is_undecided);
    tcase_add_test(t, what_a_denser_search_mends_agrees);
    tcase_add_test(t, what_no_search_mends_stays);
    tcase_add_test(t, a_wrong_value_is_no_reason_to_search_again);
    tcase_add_test(t, a_pair_both_searches_missed_in_a_wide_gap_is_caught_by_the_sweep);
    tcase_add_test(t, unstable_from_the_start_is_remarked);
    tcase_add_test(t, other_numbers_at_the_start_disagree);
    tcase_add_test(t, transitions_both_searches_missed_altogether_are_caught_by_the_counts);
    tcase_add_test(t, failures_are_handed_on);
    tcase_add_test(t, one_case_and_another_damping_can_be_chosen);
    suite_add_tcase(s, t);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
