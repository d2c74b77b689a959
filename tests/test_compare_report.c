/* The reports of a comparison of manufactured methods: schema of the JSON, layout of the table, sameness. */
#include <check.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "compare/format.h"
#include "compare/report.h"
#include "tests/fake_methods.h"

static const char FILE_TEXT[] =
    "[run]\ndamping = 0.1 1e-10\nmass_ratio = 1 3\nalpha = 0.02 2.0\ndigits = 20\n"
    "[case 1]\nmu_s = 6\nmu_b = 35\nkappa_p = 300\nkappa_b = 7\neta_s = 0\neta_N = 0\n"
    "[track T]\nEI = 6.4e6\nm = 60\nk_p = 1e8\nc_p = 1e4\nm_s = 250\nk_b = 1e8\nc_b = 1e4\nm_b = 1000\nk_s = "
    "0\n"
    "k_f = 6e7\nc_f = 1e4\nN = 0\nM = 900\nP = 1e5\n";

static const cmp_listener NOBODY = {NULL, NULL};
static const cmp_printed NOTHING = {0, NULL};
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

static void compute(size_t threads)
{
    cv_message why = {""};
    ck_assert_msg(cmp_run_find(&run, threads, &NOBODY, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(cmp_run_judge(&run, threads, &NOBODY, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(cmp_run_search_again(&run, threads, &NOBODY, &why) == CV_OK, "%s", why.text);
}

/* The report as a string the caller frees. */
static char *report(int json, int with_transitions, const cmp_printed *printed)
{
    char *text = NULL;
    size_t n = 0;
    cv_message why = {""};
    FILE *memory = open_memstream(&text, &n);
    cv_status status = json ? cmp_report_json(memory, &run, printed, &why)
                            : cmp_report_text(memory, &run, printed, with_transitions, &why);
    ck_assert_msg(status == CV_OK, "%s", why.text);
    ck_assert_int_eq(fclose(memory), 0);
    return text;
}

static json_t *parsed(void)
{
    json_error_t error;
    char *text = report(1, 0, &NOTHING);
    json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    ck_assert_msg(root != NULL, "line %d: %s", error.line, error.text);
    free(text);
    return root;
}

START_TEST(json_has_the_fields_of_the_schema)
{
    compute(2);
    json_t *root = parsed();
    const char *schema, *version, *gmp, *verdict, *name, *mu_s, *eta_p, *eta_b, *eta_f, *eta_M, *alpha, *q,
        *limit, *agreement;
    int below, above;
    double digits;
    json_error_t error;
    const int unpacked =
        json_unpack_ex(root, &error, 0,
                       "{s:s, s:{s:s, s:{s:s}}, s:s, s:[{s:s, s:{s:s}, s:[{s:{s:s, s:s, s:s}, s:[{s:s}]}]}]}",
                       "schema", &schema, "program", "version", &version, "libraries", "gmp", &gmp, "verdict",
                       &verdict, "cases", "name", &name, "parameters", "mu_s", &mu_s, "levels", "damping",
                       "eta_p", &eta_p, "eta_b", &eta_b, "eta_f", &eta_f, "mass_ratios", "eta_M", &eta_M);
    ck_assert_msg(unpacked == 0, "%s", error.text);
    ck_assert_str_eq(schema, "critvel-compare/1");
    ck_assert_str_eq(verdict, "agree");
    ck_assert_str_eq(name, "1");
    ck_assert_str_eq(mu_s, "6");
    ck_assert_str_eq(eta_f, "0.1");
    ck_assert_str_eq(eta_M, "1");
    json_t *mass = json_array_get(
        json_object_get(
            json_array_get(json_object_get(json_array_get(json_object_get(root, "cases"), 0), "levels"), 0),
            "mass_ratios"),
        0);
    static const char *const methods[] = {"semianalytic", "dgreen"};
    for (int m = 0; m < CMP_METHODS; m++) {
        json_t *list = json_object_get(mass, methods[m]);
        ck_assert_uint_eq(json_array_size(json_object_get(list, "transitions")), FAKE_TRANSITIONS);
        ck_assert_int_eq(json_unpack_ex(list, &error, 0, "{s:[{s:s, s:s, s:i, s:i}], s:s}", "transitions",
                                        "alpha", &alpha, "q", &q, "unstable_roots_below", &below,
                                        "unstable_roots_above", &above, "stability_limit", &limit),
                         0);
        ck_assert_str_eq(alpha, "0.2500000000000000000000"); /* 20 digits asked, two more certain */
        ck_assert_str_eq(limit, alpha);
        ck_assert_str_eq(q, "0.1250000000000000000000");
        ck_assert_int_eq(below, 0);
        ck_assert_int_eq(above, 2);
    }
    ck_assert_int_eq(json_unpack_ex(mass, &error, 0, "{s:{s:s, s:F, s:n}}", "agreement", "verdict",
                                    &agreement, "digits", &digits, "reason"),
                     0);
    ck_assert_str_eq(agreement, "agree");
    ck_assert_double_eq(digits, 23.0); /* log10(0.125 / 1e-24) = 23.097, rounded down */
    json_decref(root);
}
END_TEST

START_TEST(further_searches_are_reported)
{
    fake[1].drop = 1;
    fake[1].mends = 2;
    compute(2);
    char *text = report(0, 0, &NOTHING), *json = report(1, 0, &NOTHING);
    ck_assert_ptr_nonnull(
        strstr(text, "\n  agree, damping 0.1, eta_M 1: searched 3 times, more densely each time\n"));
    ck_assert_ptr_null(strstr(text, "eta_M 3: "));
    ck_assert_ptr_nonnull(strstr(json, "\"searches\": 3,"));
    ck_assert_ptr_nonnull(strstr(json, "\"searches\": 1,"));
    free(text);
    free(json);
}
END_TEST

START_TEST(json_of_a_disagreement_has_null_digits_and_a_reason)
{
    fake[1].drop = 1;
    compute(1);
    json_t *root = parsed(), *agreement;
    const char *verdict;
    ck_assert_str_eq(json_string_value(json_object_get(root, "verdict")), "disagree");
    ck_assert_int_eq(json_unpack(root, "{s:[{s:[{s:[{s:o}]}]}]}", "cases", "levels", "mass_ratios",
                                 "agreement", &agreement),
                     0);
    ck_assert_int_eq(json_unpack(agreement, "{s:s, s:n}", "verdict", &verdict, "digits"), 0);
    ck_assert_str_eq(verdict, "disagree");
    ck_assert(json_is_string(json_object_get(agreement, "reason")));
    json_decref(root);
}
END_TEST

START_TEST(a_mass_without_transitions_has_a_null_limit)
{
    compute(1);
    json_t *root = parsed(), *masses;
    ck_assert_int_eq(json_unpack(root, "{s:[{s:[{s:o}]}]}", "cases", "levels", "mass_ratios", &masses), 0);
    json_t *list = json_object_get(json_array_get(masses, 1), "dgreen");
    ck_assert_uint_eq(json_array_size(json_object_get(list, "transitions")), 0);
    ck_assert(json_is_null(json_object_get(list, "stability_limit")));
    json_decref(root);
}
END_TEST

START_TEST(reports_are_the_same_for_any_number_of_threads)
{
    compute(1);
    char *json = report(1, 0, &NOTHING), *text = report(0, 1, &NOTHING);
    for (size_t threads = 2; threads <= 9; threads += 7) {
        teardown();
        setup();
        compute(threads);
        char *json_again = report(1, 0, &NOTHING), *text_again = report(0, 1, &NOTHING);
        ck_assert_str_eq(json, json_again);
        ck_assert_str_eq(text, text_again);
        free(json_again);
        free(text_again);
    }
    free(json);
    free(text);
}
END_TEST

/* The line after the n-th line that starts with "  damping". */
static const char *table_heading(const char *text, int n)
{
    const char *at = text;
    while (n-- > 0 && (at = strstr(at, "\n  damping")) != NULL)
        at++;
    ck_assert(at != NULL);
    return at;
}

/* Number of characters from the start of a line to the end of its c-th field, fields separated by two blanks
 * or more; -1: no such field. */
static int field_end(const char *line, int c)
{
    int column = 2, end = -1;
    for (int i = 0; i <= c; i++) {
        if (line[column] == '\n' || line[column] == '\0')
            return -1;
        while (line[column] == ' ')
            column++;
        while (line[column] != '\n' && line[column] != '\0' &&
               !(line[column] == ' ' && line[column + 1] == ' '))
            column++;
        end = column;
    }
    return end;
}

START_TEST(columns_of_the_table_line_up)
{
    compute(2);
    char *text = report(0, 0, &NOTHING);
    const char *heading = table_heading(text, 1), *line = strchr(heading, '\n') + 1;
    int rows = 0;
    for (line = strchr(line, '\n') + 1; strncmp(line, "  0.1", 5) == 0 || strncmp(line, "  1e", 4) == 0;
         line = strchr(line, '\n') + 1, rows++) {
        /* eta_M, transitions and digits are flush right */
        ck_assert_int_eq(field_end(line, 1), field_end(heading, 1));
        ck_assert_int_eq(field_end(line, 3), field_end(heading, 3));
        ck_assert_int_eq(field_end(line, 4), field_end(heading, 4));
        ck_assert(line[strcspn(line, "\n") - 1] != ' ');
    }
    ck_assert_int_eq(rows, 4);
    free(text);
}
END_TEST

START_TEST(the_table_says_what_the_run_found)
{
    compute(2);
    char *text = report(0, 1, &NOTHING);
    ck_assert_ptr_nonnull(strstr(text, "case 1"));
    ck_assert_ptr_nonnull(strstr(text, "kappa_p = 300"));
    ck_assert_ptr_nonnull(strstr(text, "0.250000000000 "));
    ck_assert_ptr_nonnull(strstr(text, "0.2500000000000000000000"));
    ck_assert_ptr_nonnull(strstr(text, "0 -> 2"));
    ck_assert_ptr_nonnull(strstr(text, "verdict: agree ("));
    free(text);
    fake[0].drop = 2;
    teardown();
    setup();
    fake[0].drop = 2;
    compute(1);
    text = report(0, 0, &NOTHING);
    ck_assert_ptr_nonnull(strstr(text, "3/4"));
    ck_assert_ptr_nonnull(strstr(text, "only dgreen has alpha = 0.375"));
    ck_assert_ptr_nonnull(strstr(text, "verdict: disagree ("));
    free(text);
}
END_TEST

START_TEST(tracks_have_velocities_and_masses)
{
    compute(2);
    char *text = report(0, 0, &NOTHING);
    ck_assert_ptr_nonnull(strstr(text, "track T"));
    ck_assert_ptr_nonnull(strstr(text, "km/h"));
    free(text);
    /* v_ref = (4 k_f EI / m^2)^(1/4) = 808.27 m/s */
    json_t *root = parsed();
    json_t *track = json_array_get(json_object_get(root, "cases"), 1);
    const double v_ref = strtod(json_string_value(json_object_get(track, "reference_velocity_m_s")), NULL);
    ck_assert_double_eq_tol(v_ref, pow(4 * 6e7 * 6.4e6 / 3600, 0.25), 1e-9);
    json_t *mass = json_array_get(
        json_object_get(json_array_get(json_object_get(track, "levels"), 0), "mass_ratios"), 0);
    const double kg = strtod(json_string_value(json_object_get(mass, "mass_kg")), NULL);
    const double limit_m_s = strtod(
        json_string_value(json_object_get(json_object_get(mass, "dgreen"), "stability_limit_m_s")), NULL);
    const double limit_km_h = strtod(
        json_string_value(json_object_get(json_object_get(mass, "dgreen"), "stability_limit_km_h")), NULL);
    ck_assert_double_eq_tol(kg, 60 / pow(6e7 / (4 * 6.4e6), 0.25), 1e-9); /* eta_M = 1: M = m / chi */
    ck_assert_double_eq_tol(limit_m_s, 0.25 * v_ref, 1e-9);
    ck_assert_double_eq_tol(limit_km_h, 3.6 * limit_m_s, 1e-9);
    json_decref(root);
}
END_TEST

START_TEST(numbers_keep_the_digits_they_claim)
{
    cmp_number_text text;
    mpfr_t x, error;
    mpfr_inits2(200, x, error, (mpfr_ptr)0);
    mpfr_set_str(x, "0.123456789012345678901234567890", 10, MPFR_RNDN);
    mpfr_set_str(error, "1e-26", 10, MPFR_RNDN);
    ck_assert_str_eq(cmp_format_claimed(&text, x, error, 20), "0.1234567890123456789012");
    mpfr_set_str(error, "1.1e-22", 10, MPFR_RNDN);
    ck_assert_str_eq(cmp_format_claimed(&text, x, error, 20), "0.123456789012345678901");
    mpfr_set_str(error, "1e-10", 10, MPFR_RNDN);
    ck_assert_str_eq(cmp_format_claimed(&text, x, error, 20), "0.12345678901234567890");
    mpfr_set_ui(x, 2, MPFR_RNDN);
    ck_assert_str_eq(cmp_format_mpfr(&text, x, 1), "2");
    ck_assert_str_eq(cmp_format_mpfr(&text, x, 3), "2.00");
    mpfr_set_nan(x);
    ck_assert_str_eq(cmp_format_mpfr(&text, x, 3), "nan");
    ck_assert_str_eq(cmp_format_digits(&text, 20.99), "20.9");
    mpfr_clears(x, error, (mpfr_ptr)0);
}
END_TEST

START_TEST(printed_values_stand_beside_computed_ones)
{
    cmp_printed_row rows[] = {{"first resonance", "section 5", "0.449", "0.4449", 0},
                              {"third resonance", "section 5", "0.750", "0.7500", 1}};
    const cmp_printed printed = {2, rows};
    compute(2);
    char *text = report(0, 0, &printed), *json = report(1, 0, &printed);
    ck_assert_ptr_nonnull(strstr(text, "first resonance  section 5  0.449    0.4449    differs"));
    ck_assert_ptr_nonnull(strstr(text, "third resonance  section 5  0.750    0.7500    agrees"));
    ck_assert_ptr_nonnull(strstr(json, "\"computed\": \"0.4449\""));
    free(text);
    free(json);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: reports");
    TCase *t = tcase_create("manufactured methods");
    tcase_add_checked_fixture(t, setup, teardown);
    tcase_add_test(t, json_has_the_fields_of_the_schema);
    tcase_add_test(t, further_searches_are_reported);
    tcase_add_test(t, json_of_a_disagreement_has_null_digits_and_a_reason);
    tcase_add_test(t, a_mass_without_transitions_has_a_null_limit);
    tcase_add_test(t, reports_are_the_same_for_any_number_of_threads);
    tcase_add_test(t, columns_of_the_table_line_up);
    tcase_add_test(t, the_table_says_what_the_run_found);
    tcase_add_test(t, tracks_have_velocities_and_masses);
    tcase_add_test(t, numbers_keep_the_digits_they_claim);
    tcase_add_test(t, printed_values_stand_beside_computed_ones);
    suite_add_tcase(s, t);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
