/* critvel-dgreen z as a program: what it prints, and its exit status. */
#include <check.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static char output[20000], folder[64], path[80];

static void setup(void)
{
    strcpy(folder, "/tmp/critvel-cli-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/case.ini", folder);
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fputs("[run]\ndamping = 0.1 1e-10\nmass_ratio = 10\nalpha = 0.1 0.2\ndigits = 15\n"
          "[case 1]\nmu_s = 6\nmu_b = 35\nkappa_p = 300\nkappa_b = 7\neta_s = 0\neta_N = 0\n"
          "[case second]\nmu_s = 3\nmu_b = 10\nkappa_p = 0.03\nkappa_b = 0.1\neta_s = 0\neta_N = 0\n",
          file);
    ck_assert_int_eq(fclose(file), 0);
}

static void teardown(void)
{
    remove(path);
    remove(folder);
}

/* Runs the program with the arguments; FILE stands for the case file. Output, without stderr, goes to output.
 */
static int run(const char *arguments)
{
    const char *build = getenv("CRITVEL_BUILD");
    char command[600], *file = strstr(arguments, "FILE");
    const int before = file == NULL ? (int)strlen(arguments) : (int)(file - arguments);
    snprintf(command, sizeof command, "%s/critvel-dgreen %.*s%s%s 2>%s/err", build ? build : "build", before,
             arguments, file ? path : "", file ? file + 4 : "", folder);
    FILE *stream = popen(command, "r");
    ck_assert_ptr_nonnull(stream);
    output[fread(output, 1, sizeof output - 1, stream)] = '\0';
    const int status = pclose(stream);
    snprintf(command, sizeof command, "%s/err", folder);
    remove(command);
    ck_assert(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* mpmath 1.2.1 at 60 digits from the matrix (7). */
START_TEST(digits_claimed)
{
    ck_assert_int_eq(run("z FILE --case 1 --damping 1e-10 --alpha 0.3 --frequency 0.22 --digits 30"), 0);
    ck_assert_ptr_nonnull(strstr(output, "1.00794574467124175139555503833e-02"));
    ck_assert_ptr_nonnull(strstr(output, "1.60143340510827491017971842432e-04"));
    ck_assert_int_eq(run("z FILE --damping 1e-10 --case second --alpha 0.4 --frequency 0.22"), 0);
    ck_assert_ptr_nonnull(strstr(output, "4.15665635650431e-02"));
    ck_assert_ptr_nonnull(strstr(output, "-2.08250924066405e-01"));
}
END_TEST

START_TEST(json)
{
    ck_assert_int_eq(
        run("z FILE --format json --alpha 0.3 --frequency 0.22 --mass-ratio 100 --damping 0 --digits 8"), 0);
    json_t *root = json_loads(output, 0, NULL);
    const char *re, *im, *z_re, *z_im, *name, *eta;
    int digits;
    ck_assert_ptr_nonnull(root);
    ck_assert_int_eq(json_unpack(root, "{s:s, s:i, s:{s:s, s:s}, s:{s:s, s:s}, s:{s:s}}", "case", &name,
                                 "digits", &digits, "zeta", "re", &re, "im", &im, "z", "re", &z_re, "im",
                                 &z_im, "damping", "eta_b", &eta),
                     0);
    ck_assert_str_eq(name, "1");
    ck_assert_str_eq(eta, "0");
    ck_assert_int_eq(digits, 8);
    ck_assert_str_eq(re, "1.0079457e-02");
    ck_assert_str_eq(im, "1.6014334e-04");
    ck_assert_str_eq(z_re, "1.0079457e+00");
    ck_assert_str_eq(z_im, "1.6014334e-02");
    json_decref(root);
}
END_TEST

/* The first damping level of the file is the default; exact zeros are "0". */
START_TEST(defaults_and_zeros)
{
    ck_assert_int_eq(run("z FILE --alpha 0.3 --frequency 0.22"), 0);
    char first[200];
    snprintf(first, sizeof first, "%.199s", output);
    ck_assert_int_eq(run("z --damping 0.1 FILE --case 1 --frequency 0.22 --alpha 0.3"), 0);
    ck_assert_str_eq(first, output);
    ck_assert_int_eq(run("z FILE --damping 0 --alpha 0 --frequency 0.1"), 0);
    ck_assert_ptr_nonnull(strstr(output, "zeta  im  0\n"));
}
END_TEST

START_TEST(wrong_usage)
{
    const char *wrong[] = {"",
                           "z",
                           "z FILE",
                           "z FILE --alpha 0.3",
                           "z FILE --frequency 0.3",
                           "z FILE --alpha -0.3 --frequency 0.2",
                           "z FILE --alpha 0,3 --frequency 0.2",
                           "z FILE --alpha 0.3 --frequency nan",
                           "z FILE --alpha 0.3 --frequency 0.2 --digits 0",
                           "z FILE --alpha 0.3 --frequency 0.2 --damping -1",
                           "z FILE --alpha 0.3 --frequency 0.2 --mass-ratio 0",
                           "z FILE --alpha 0.3 --frequency 0.2 --case third",
                           "z FILE --alpha 0.3 --frequency 0.2 --format xml",
                           "y FILE --alpha 0.3 --frequency 0.2"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        ck_assert_msg(run(wrong[i]) == 2, "%s", wrong[i]);
        ck_assert_str_eq(output, "");
    }
    ck_assert_int_eq(run("--help"), 0);
    ck_assert_ptr_nonnull(strstr(output, "--frequency"));
}
END_TEST

START_TEST(full_disk)
{
    ck_assert_int_eq(run("z FILE --alpha 0.3 --frequency 0.2 >/dev/full"), 3);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen program");
    TCase *c = tcase_create("z");
    tcase_add_checked_fixture(c, setup, teardown);
    tcase_add_test(c, digits_claimed);
    tcase_add_test(c, json);
    tcase_add_test(c, defaults_and_zeros);
    tcase_add_test(c, wrong_usage);
    tcase_add_test(c, full_disk);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
