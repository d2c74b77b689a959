/* Instability lines of two manufactured methods: what each kind of fault does to the verdict. */
#include <check.h>
#include <stdio.h>
#include <unistd.h>

#include "compare/lines_report.h"
#include "tests/fake_lines.h"

static const char FILE_TEXT[] =
    "[run]\ndamping = 0.1\nmass_ratio = 1 3\nalpha = 0.25 1.25\ndigits = 20\n"
    "[case 1]\nmu_s = 6\nmu_b = 35\nkappa_p = 300\nkappa_b = 7\neta_s = 0\neta_N = 0\n";

enum { POINTS = 4000 };

static const cmp_listener NOBODY = {NULL, NULL};
static cv_casefile file;
static cv_number mass_min, mass_max;
static cmp_lines_run run;

static void setup(void)
{
    static const cmp_line_method *const methods[] = {&FAKE_LINES_FIRST, &FAKE_LINES_SECOND};
    char path[] = "/tmp/critvel-test-XXXXXX";
    cv_message why = {""};
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, FILE_TEXT, strlen(FILE_TEXT)), (ssize_t)strlen(FILE_TEXT));
    ck_assert_int_eq(close(fd), 0);
    cv_status status = cv_casefile_read(&file, path, &why);
    unlink(path);
    ck_assert_msg(status == CV_OK, "%s", why.text);
    cv_number_init(&mass_min);
    cv_number_init(&mass_max);
    ck_assert_int_eq(cv_number_parse(&mass_min, "1", NULL), CV_OK);
    ck_assert_int_eq(cv_number_parse(&mass_max, "1000", NULL), CV_OK);
    memset(fake_line, 0, sizeof fake_line);
    const cmp_lines_task task = {
        {&file.alpha_min, &file.alpha_max, &mass_min, &mass_max}, 20, POINTS, 20261127};
    ck_assert_int_eq(cmp_lines_run_init(&run, &file, NULL, NULL, &task, methods, &why), CV_OK);
}

static void teardown(void)
{
    cmp_lines_run_clear(&run);
    cv_casefile_clear(&file);
    cv_number_clear(&mass_min);
    cv_number_clear(&mass_max);
    mpfr_free_cache();
}

static const cmp_lines_level *outcome(void)
{
    cv_message why = {""};
    ck_assert_msg(cmp_lines_run_find(&run, 2, &NOBODY, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(cmp_lines_run_judge(&run, 2, &NOBODY, &why) == CV_OK, "%s", why.text);
    return &run.cases[0].levels[0];
}

/* Runs with the faults set so far, judges, and begins anew. */
static void expect(cmp_kind kind, const char *word)
{
    const cmp_verdict *v = &outcome()->verdict;
    ck_assert_msg(v->kind == kind, "%s: %s", cmp_kind_name(v->kind), v->reason.text);
    ck_assert_int_eq(run.worst, kind);
    ck_assert_msg(strstr(v->reason.text, word) != NULL, "\"%s\" lacks \"%s\"", v->reason.text, word);
    teardown();
    setup();
}

START_TEST(faultless_methods_agree)
{
    const cmp_lines_level *level = outcome();
    ck_assert_msg(level->verdict.kind == CMP_AGREE, "%s", level->verdict.reason.text);
    ck_assert_double_eq_tol(level->verdict.digits, 24, 0.01);
    ck_assert_uint_eq(level->pairs.count, FAKE_LINES);
    for (size_t i = 0; i < FAKE_LINES; i++) {
        const cmp_branch_pair *p = &level->pairs.pairs[i];
        ck_assert(p->by[0] == &level->lists[0].branches[i] && p->by[1] == &level->lists[1].branches[i]);
        ck_assert_uint_eq(p->vertices, 2 * (FAKE_STEPS + 1));
        ck_assert_double_eq(p->plot_distance, 0);
    }
    ck_assert_uint_eq(level->samples.points, POINTS);
    ck_assert_uint_eq(level->samples.near_lines, POINTS / 2);
    ck_assert_uint_eq(level->samples.mismatches + level->samples.undecided_points, 0);
}
END_TEST

START_TEST(a_missing_branch_disagrees)
{
    for (int line = 1; line <= FAKE_LINES; line++)
        for (int m = 0; m < CMP_METHODS; m++) {
            fake_line[m].drop = line;
            expect(CMP_DISAGREE, m == 1 ? "only semianalytic has the branch" : "only dgreen has the branch");
        }
}
END_TEST

START_TEST(a_branch_off_by_1e_15_disagrees)
{
    for (int line = 1; line <= FAKE_LINES; line++)
        for (int m = 0; m < CMP_METHODS; m++) {
            fake_line[m].move = line;
            fake_line[m].by = 1e-15;
            expect(CMP_DISAGREE, "their bounds allow");
        }
}
END_TEST

START_TEST(a_frequency_off_by_1e_15_disagrees)
{
    fake_line[1].move = 3;
    fake_line[1].only_q = 1;
    fake_line[1].by = 1e-15;
    expect(CMP_DISAGREE, "q = ");
}
END_TEST

START_TEST(points_without_bounds_never_agree)
{
    fake_line[0].unbounded = 1;
    expect(CMP_DISAGREE, "nan");
}
END_TEST

START_TEST(vertices_that_leave_their_own_line_disagree)
{
    fake_line[0].loose = 3;
    fake_line[0].by = 1e-15; /* claimed to 1e-24 */
    expect(CMP_DISAGREE, "their bounds allow");
    fake_line[1].loose = 3;
    fake_line[1].no_bounds = 1; /* nothing claimed, but this is no rounding */
    fake_line[1].by = 1e-5;
    expect(CMP_DISAGREE, "of dgreen at");
}
END_TEST

START_TEST(vertices_in_double_precision_are_refined_first)
{
    fake_line[1].no_bounds = 1;
    const cmp_lines_level *level = outcome();
    ck_assert_msg(level->verdict.kind == CMP_AGREE, "%s", level->verdict.reason.text);
    ck_assert_uint_eq(level->pairs.pairs[0].vertices, 2 * (FAKE_STEPS + 1));
}
END_TEST

START_TEST(wide_bounds_are_undecided)
{
    fake_line[0].bound = fake_line[1].bound = 1e-18;
    fake_line[0].move = 1;
    fake_line[0].by = 1e-19;
    expect(CMP_UNDECIDED, "20 digits");
    fake_line[1].blind = 1;
    expect(CMP_UNDECIDED, "dgreen does not put alpha");
    fake_line[0].no_bounds = fake_line[0].blind = 1;
    expect(CMP_UNDECIDED, "semianalytic does not put alpha");
}
END_TEST

START_TEST(another_direction_is_another_branch)
{
    for (int line = 1; line <= FAKE_LINES; line++) {
        fake_line[0].reverse = line;
        expect(CMP_DISAGREE, "only ");
    }
}
END_TEST

START_TEST(half_a_branch_is_not_the_branch)
{
    for (int line = 1; line <= FAKE_LINES; line++) {
        fake_line[0].half = line;
        expect(CMP_DISAGREE, "only ");
    }
}
END_TEST

START_TEST(other_ends_and_extremes_disagree)
{
    fake_line[0].end = 2;
    expect(CMP_DISAGREE, "the branch begins at the lowest velocity by semianalytic, at the smallest mass");
    fake_line[1].asymptote = 1e-15;
    expect(CMP_DISAGREE, "at alpha = 0.5, q = 0 and at 0.500000000000001, 0");
    fake_line[0].asymptote_q = 0.1;
    expect(CMP_DISAGREE, "at alpha = 0.5, q = 0.1 and at 0.5, 0");
    fake_line[0].least = 1e-10;
    expect(CMP_DISAGREE, "smallest eta_M 1.0000000001 by semianalytic");
    fake_line[0].bend = 1;
    expect(CMP_DISAGREE, "1 turning points by semianalytic, 0 by dgreen");
    fake_line[0].asymptote = (double)NAN;
    expect(CMP_UNDECIDED, "only dgreen knows of the asymptote at alpha = ");
    fake_line[0].asymptote = (double)NAN;
    fake_line[0].open = 1;
    expect(CMP_AGREE, ""); /* the one that does not know claims nothing */
    fake_line[0].asymptote = fake_line[1].asymptote = (double)NAN;
    expect(CMP_AGREE, ""); /* neither claims one */
}
END_TEST

START_TEST(a_wrong_count_disagrees)
{
    for (int line = 1; line <= FAKE_LINES; line++)
        for (int m = 0; m < CMP_METHODS; m++) {
            fake_line[m].drop_from_count = line;
            expect(CMP_DISAGREE, "unstable roots");
        }
    fake_line[0].drop = fake_line[1].drop = 3; /* a line that only the count of one knows */
    fake_line[1].drop_from_count = 3;
    expect(CMP_DISAGREE, "semianalytic counts ");
}
END_TEST

START_TEST(undecided_points_are_counted_and_few_are_allowed)
{
    fake_line[1].blind_in = 1000;
    const cmp_lines_level *level = outcome();
    ck_assert_int_eq(level->verdict.kind, CMP_AGREE);
    ck_assert_uint_gt(level->samples.undecided[1], 0);
    ck_assert_uint_eq(level->samples.undecided[0], 0);
    ck_assert_uint_eq(level->samples.undecided_points, level->samples.undecided[1]);
    teardown();
    setup();
    fake_line[1].blind_in = 50; /* one in a hundred is too many */
    expect(CMP_UNDECIDED, "points unstable roots cannot be counted");
}
END_TEST

START_TEST(what_is_not_a_number_never_agrees)
{
    for (int line = 1; line <= FAKE_LINES; line++) {
        fake_line[0].nan = fake_line[1].nan = line;
        expect(CMP_DISAGREE, "");
    }
    fake_line[0].move = fake_line[1].move = 1;
    fake_line[0].by = fake_line[1].by = (double)NAN;
    expect(CMP_DISAGREE, "");
    fake_line[0].least = fake_line[1].least = (double)NAN;
    expect(CMP_DISAGREE, "smallest eta_M");
}
END_TEST

START_TEST(a_doubtful_list_is_undecided)
{
    fake_line[0].undecided = 1;
    expect(CMP_UNDECIDED, "semianalytic could not decide: the fake has its doubts");
    fake_line[0].undecided = 1;
    fake_line[0].drop = 2;
    expect(CMP_UNDECIDED, "");
}
END_TEST

START_TEST(failures_are_handed_on)
{
    cv_message why = {""};
    fake_line[1].find = CV_BAD_INPUT;
    ck_assert_int_eq(cmp_lines_run_find(&run, 2, &NOBODY, &why), CV_BAD_INPUT);
    ck_assert_str_eq(why.text, "the fake was told to fail");
}
END_TEST

static char *report(int json)
{
    char *text = NULL;
    size_t n = 0;
    cv_message why = {""};
    FILE *memory = open_memstream(&text, &n);
    ck_assert_int_eq(
        json ? cmp_lines_report_json(memory, &run, &why) : cmp_lines_report_text(memory, &run, &why), CV_OK);
    ck_assert_int_eq(fclose(memory), 0);
    return text;
}

START_TEST(reports_say_what_was_found)
{
    fake_line[1].drop = 3;
    fake_line[1].drop_from_count = 3;
    fake_line[0].zero_mass = 2;
    (void)outcome();
    char *text = report(0), *json = report(1), *again = report(1);
    ck_assert_str_eq(json, again);
    ck_assert_ptr_nonnull(strstr(json, "\"schema\": \"critvel-compare-lines/1\""));
    ck_assert_ptr_nonnull(strstr(json, "\"verdict\": \"disagree\""));
    ck_assert_ptr_nonnull(strstr(json, "\"seed\": 20261127"));
    ck_assert_ptr_nonnull(strstr(json, "\"points\": 4000"));
    ck_assert_ptr_nonnull(strstr(text, "only semianalytic has the branch"));
    ck_assert_ptr_nonnull(strstr(text, "seed 20261127"));
    ck_assert_ptr_nonnull(strstr(text, "eta_M min, zero mass"));
    free(text);
    free(json);
    free(again);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: lines");
    TCase *t = tcase_create("manufactured methods");
    tcase_add_checked_fixture(t, setup, teardown);
    tcase_add_test(t, faultless_methods_agree);
    tcase_add_test(t, a_missing_branch_disagrees);
    tcase_add_test(t, a_branch_off_by_1e_15_disagrees);
    tcase_add_test(t, a_frequency_off_by_1e_15_disagrees);
    tcase_add_test(t, points_without_bounds_never_agree);
    tcase_add_test(t, vertices_that_leave_their_own_line_disagree);
    tcase_add_test(t, vertices_in_double_precision_are_refined_first);
    tcase_add_test(t, wide_bounds_are_undecided);
    tcase_add_test(t, another_direction_is_another_branch);
    tcase_add_test(t, half_a_branch_is_not_the_branch);
    tcase_add_test(t, other_ends_and_extremes_disagree);
    tcase_add_test(t, a_wrong_count_disagrees);
    tcase_add_test(t, undecided_points_are_counted_and_few_are_allowed);
    tcase_add_test(t, what_is_not_a_number_never_agrees);
    tcase_add_test(t, a_doubtful_list_is_undecided);
    tcase_add_test(t, failures_are_handed_on);
    tcase_add_test(t, reports_say_what_was_found);
    suite_add_tcase(s, t);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
