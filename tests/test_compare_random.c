/* Both methods on random tracks of (31), with unequal dampings, ballast shear and axial force: no
 * disagreement, ever; and what one of them calls undecided is counted and must stay the exception. */
#include <check.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "compare/run.h"
#include "tests/random_track.h"

enum { TRACKS = 6 };

static void write_number(FILE *out, const char *key, const cv_number *x)
{
    char *text = cv_number_text(x, 20);
    ck_assert_ptr_nonnull(text);
    fprintf(out, "%s = %s\n", key, text);
    free(text);
}

/* A case file of random tracks with two levels of unequal dampings, 1e-8 .. 0.2. */
static void write_cases(FILE *out, gsl_rng *rng)
{
    static const char *const lists[] = {"damping_p", "damping_b", "damping_f"};
    fputs("[run]\nmass_ratio = 3 30 300\nalpha = 0.02 2.0\ndigits = 20\n", out);
    for (int i = 0; i < 3; i++)
        fprintf(out, "%s = %.3g %.3g\n", lists[i], log_uniform(rng, 1e-2, 0.2), log_uniform(rng, 1e-8, 1e-2));
    for (int i = 0; i < TRACKS; i++) {
        cv_params p;
        cv_params_init(&p);
        random_track(&p, rng);
        fprintf(out, "[case %d]\n", i + 1);
        write_number(out, "mu_s", &p.mu_s);
        write_number(out, "mu_b", &p.mu_b);
        write_number(out, "kappa_p", &p.kappa_p);
        write_number(out, "kappa_b", &p.kappa_b);
        write_number(out, "eta_s", &p.eta_s);
        write_number(out, "eta_N", &p.eta_N);
        cv_params_clear(&p);
    }
}

static void read_random(cv_casefile *file)
{
    char path[] = "/tmp/critvel-test-XXXXXX";
    cv_message why = {""};
    gsl_rng *rng = random_start("compare: random tracks", 20240607);
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    FILE *out = fdopen(fd, "w");
    ck_assert_ptr_nonnull(out);
    write_cases(out, rng);
    ck_assert_int_eq(fclose(out), 0);
    gsl_rng_free(rng);
    cv_status status = cv_casefile_read(file, path, &why);
    unlink(path);
    ck_assert_msg(status == CV_OK, "%s", why.text);
}

static void print_doubts(const cmp_run *run)
{
    for (size_t i = 0; i < run->case_count; i++)
        for (size_t l = 0; l < run->cases[i].level_count; l++)
            for (size_t m = 0; m < run->cases[i].from->mass_count; m++) {
                const cmp_verdict *v = &run->cases[i].levels[l].results[m].verdict;
                if (v->kind != CMP_AGREE)
                    printf("case %s, level %zu, mass %zu: %s: %s\n", run->cases[i].from->name, l, m,
                           cmp_kind_name(v->kind), v->reason.text);
            }
}

START_TEST(random_tracks_do_not_disagree)
{
    static const cmp_method *const methods[] = {&cmp_method_semianalytic, &cmp_method_dgreen};
    const cmp_listener nobody = {NULL, NULL};
    cv_casefile file;
    cmp_run run;
    cmp_summary s;
    cv_message why = {""};
    read_random(&file);
    ck_assert_int_eq(cmp_run_init(&run, &file, NULL, NULL, methods, &why), CV_OK);
    ck_assert_msg(cmp_run_find(&run, 2, &nobody, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(cmp_run_judge(&run, 2, &nobody, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(cmp_run_search_again(&run, 2, &nobody, &why) == CV_OK, "%s", why.text);
    cmp_run_summary(&s, &run);
    print_doubts(&run);
    printf("%zu combinations: %zu agree, %zu undecided, %zu disagree\n", s.total, s.of_kind[CMP_AGREE],
           s.of_kind[CMP_UNDECIDED], s.of_kind[CMP_DISAGREE]);
    fflush(stdout);
    ck_assert_uint_eq(s.of_kind[CMP_DISAGREE], 0);
    ck_assert_uint_le(10 * s.of_kind[CMP_UNDECIDED], s.total);
    cmp_run_clear(&run);
    cv_casefile_clear(&file);
    mpfr_free_cache();
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: random tracks");
    TCase *t = tcase_create("both methods");
    tcase_set_timeout(t, 60);
    tcase_add_test(t, random_tracks_do_not_disagree);
    suite_add_tcase(s, t);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
