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

/* Case 1 at 0.1 has one line in 0.1 <= alpha <= 0.2: from the asymptote near 0.1516 to the upper end. CSV and
 * JSON hold the same vertices, --output the same bytes as standard output. */
START_TEST(lines)
{
    static char first[sizeof output];
    json_t *root, *line, *vertex;
    const char *name;
    int n;
    double alpha, q, mass;
    ck_assert_int_eq(run("lines FILE --format json"), 0);
    strcpy(first, output);
    root = json_loads(output, 0, NULL);
    ck_assert_int_eq(json_unpack(root, "{s:s, s:b, s:[o]}", "schema", &name, "decided", &n, "lines", &line),
                     0);
    ck_assert_str_eq(name, "critvel-dgreen-lines/1");
    ck_assert_int_eq(n, 1);
    ck_assert_int_eq(json_unpack(line, "{s:{s:s, s:f}, s:{s:s}}", "start", "exit", &name, "asymptote_alpha",
                                 &alpha, "end", "exit", &name),
                     0);
    ck_assert_str_eq(name, "highest alpha");
    ck_assert_double_eq_tol(alpha, 0.1516429225, 1e-9);
    vertex = json_array_get(json_object_get(line, "alpha_q_eta_M"), 0);
    ck_assert_int_eq(json_unpack(vertex, "[f, f, f]", &alpha, &q, &mass), 0);
    ck_assert_double_eq_tol(mass, 1e4, 1e-2);
    json_decref(root);
    ck_assert_int_eq(run("lines FILE --format csv"), 0);
    double csv[3];
    ck_assert_int_eq(sscanf(output, "line,alpha,q,eta_M,mark\n1,%lf,%lf,%lf,", &csv[0], &csv[1], &csv[2]), 3);
    ck_assert_double_eq_tol(csv[0], alpha, 1e-15);
    ck_assert_double_eq_tol(csv[1], q, 1e-14);
    ck_assert_double_eq_tol(csv[2], mass, 1e-9);
    ck_assert_int_eq(run("lines FILE"), 0);
    ck_assert_ptr_nonnull(strstr(output, "1 line for 0.1 <= alpha <= 0.2"));
    char command[200];
    snprintf(command, sizeof command, "lines FILE --format json --output %s/out", folder);
    ck_assert_int_eq(run(command), 0);
    ck_assert_str_eq(output, "");
    snprintf(command, sizeof command, "%s/out", folder);
    FILE *file = fopen(command, "r");
    ck_assert_ptr_nonnull(file);
    output[fread(output, 1, sizeof output - 1, file)] = '\0';
    fclose(file);
    remove(command);
    ck_assert_str_eq(output, first);
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
    tcase_add_test(c, lines);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
