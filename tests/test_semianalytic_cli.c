/* critvel-semianalytic as a user runs it: kernel, its output and its exit status. */
#include <check.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

enum { OUTPUT_MAX = 20000 };

/* Runs the program with the arguments, a shell line; returns the exit status and what it wrote. */
static int run(char output[OUTPUT_MAX], const char *arguments)
{
    char line[1000];
    const char *build = getenv("CRITVEL_BUILD");
    snprintf(line, sizeof line, "%s/critvel-semianalytic %s", build != NULL ? build : "build", arguments);
    FILE *pipe = popen(line, "r");
    ck_assert_ptr_nonnull(pipe);
    size_t n = fread(output, 1, OUTPUT_MAX - 1, pipe);
    output[n] = '\0';
    int status = pclose(pipe);
    ck_assert(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static json_t *run_json(const char *arguments)
{
    char output[OUTPUT_MAX], line[900];
    snprintf(line, sizeof line, "%s --format json", arguments);
    ck_assert_int_eq(run(output, line), 0);
    json_error_t error;
    json_t *root = json_loads(output, 0, &error);
    ck_assert_msg(root != NULL, "%s: %s", error.text, output);
    return root;
}

static const char *part(const json_t *root, const char *value, const char *name)
{
    const char *text = json_string_value(json_object_get(json_object_get(root, value), name));
    ck_assert_msg(text != NULL, "%s.%s", value, name);
    return text;
}

/* number of digits from the first that is not 0 */
static int significant(const char *text)
{
    int digits = 0;
    for (; *text != '\0' && *text != 'e'; text++)
        digits += *text >= '0' && *text <= '9' && (digits > 0 || *text != '0');
    return digits;
}

/* The numbers are those of an mpmath script: poles from the expanded determinant, 70 digits. */
START_TEST(kernel_prints_right_digits)
{
    json_t *root =
        run_json("kernel data/paper.ini --case 1 --damping 1e-10 --alpha 0.3 --frequency 0.22 --digits 30");
    ck_assert_str_eq(part(root, "zeta", "re"), "0.0100794574467124175139555503833");
    ck_assert_str_eq(part(root, "zeta", "im"), "0.000160143340510827491017971842432");
    ck_assert_str_eq(part(root, "K", "re"), "1.30849377961829197170058700529");
    json_decref(root);
    root = run_json("kernel data/paper.ini --case 1 --damping 0 --alpha 0.3 --frequency 0.22 --digits 30");
    ck_assert_str_eq(part(root, "zeta", "re"), "0.0100794574467270427462139211543");
    ck_assert_str_eq(part(root, "zeta", "im"), "0.000160143340623032733807902312987");
    json_decref(root);
}
END_TEST

START_TEST(number_of_digits_is_the_one_asked_for)
{
    for (int digits = 1; digits <= 1000; digits = digits * 3 + 1) {
        char line[200];
        snprintf(line, sizeof line,
                 "kernel data/paper.ini --case 4 --damping 1e-10 --alpha 0.45 --frequency 0.07 --digits %d",
                 digits);
        json_t *root = run_json(line);
        ck_assert_int_eq(significant(part(root, "zeta", "re")), digits);
        ck_assert_int_eq(significant(part(root, "K", "im")), digits);
        json_decref(root);
    }
}
END_TEST

START_TEST(text_and_defaults)
{
    char output[OUTPUT_MAX];
    ck_assert_int_eq(run(output, "kernel data/paper.ini --alpha 0.3 --frequency 0.22"), 0);
    ck_assert_ptr_nonnull(strstr(output, "Re zeta"));
    char *im = strstr(output, "Im zeta ");
    ck_assert_ptr_nonnull(im);
    im[strcspn(im, "\n")] = '\0';
    ck_assert_int_eq(significant(im + strlen("Im zeta ")), 20); /* digits of the file */
    ck_assert_int_eq(run(output, "--help"), 0);
    ck_assert_ptr_nonnull(strstr(output, "kernel data/paper.ini"));
    ck_assert_int_eq(run(output, "--version"), 0);
}
END_TEST

START_TEST(quadrature_on_demand)
{
    json_t *root = run_json(
        "kernel data/paper.ini --case 2 --damping 0.05 --alpha 0.4 --frequency 0.3 --xi 0.6 --quadrature");
    const json_t *quadrature = json_object_get(root, "quadrature");
    double re = json_number_value(json_object_get(quadrature, "re"));
    double im = json_number_value(json_object_get(quadrature, "im"));
    ck_assert_double_eq_tol(re, strtod(part(root, "K", "re"), NULL), 1e-9);
    ck_assert_double_eq_tol(im, strtod(part(root, "K", "im"), NULL), 1e-9);
    json_decref(root);
}
END_TEST

START_TEST(wrong_use_says_so)
{
    const struct {
        const char *arguments;
        int status;
    } wrong[] = {
        {"kernel data/paper.ini --alpha 0.3 2>/dev/null", 2},
        {"kernel data/paper.ini --frequency 0.3 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha -0.3 --frequency 1 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency 1,5 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency nan 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency 1 --digits 0 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency 1 --digits 100000 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency 1 --damping -1 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency 1 --case 9 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency 1 --damping 0 --quadrature 2>/dev/null", 2},
        {"kernel no-such-file.ini --alpha 0.3 --frequency 1 2>/dev/null", 2},
        {"nonsense data/paper.ini 2>/dev/null", 2},
        {"kernel data/paper.ini --alpha 0.3 --frequency 1 2>/dev/null >/dev/full", 3},
    };
    char output[OUTPUT_MAX];
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        ck_assert_msg(run(output, wrong[i].arguments) == wrong[i].status, "%s", wrong[i].arguments);
        ck_assert_msg(output[0] == '\0', "%s: %s", wrong[i].arguments, output);
    }
    ck_assert_int_eq(run(output, "kernel data/paper.ini --alpha 0.3 2>&1 >/dev/null"), 2);
    ck_assert_ptr_eq(strchr(output, '\n'), output + strlen(output) - 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("critvel-semianalytic");
    TCase *tests = tcase_create("kernel");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, kernel_prints_right_digits);
    tcase_add_test(tests, number_of_digits_is_the_one_asked_for);
    tcase_add_test(tests, text_and_defaults);
    tcase_add_test(tests, quadrature_on_demand);
    tcase_add_test(tests, wrong_use_says_so);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
