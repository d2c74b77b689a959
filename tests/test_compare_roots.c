/* Roots of z = 1 by two methods: manufactured methods with one fault each; then the real ones, whose
 * continued zeta must be the same function to many digits. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/roots.h"
#include "compare/roots_report.h"

enum { DIGITS = 20, ROOTS = 4 };

/* The truth: z - 1 = (1 + qbar) times the product of qbar - r over these roots r. All are exact binary
 * numbers: two unstable, two stable. */
static const struct {
    double re, im;
} TRUTH[ROOTS] = {{0.25, 0.5}, {0.125, 0.75}, {-0.0625, 1.0}, {-0.5, 0.25}};

/* What a fake does wrong; all zero: nothing. */
typedef struct {
    int drop;          /* 1 + index of a root that is not listed */
    int move;          /* 1 + index of a root whose Im is off */
    double by;         /* relative */
    double error;      /* stated relative bound; 0: 1e-24 */
    int count;         /* added to the number of unstable roots */
    int undecided;     /* the list says so */
    int doubtful;      /* 1 + index of a root that is not vouched for */
    double offset;     /* added to zeta */
    double blunt;      /* stated bound of zeta */
    cv_status zeta;    /* returned by zeta */
    cv_status find;    /* returned by find */
    double deeper;     /* minus the real part of the last root instead of the truth */
    double depth_seen; /* by find */
} faults;

static faults fake[CMP_METHODS];

static cv_status fake_find(void *handle, cmp_root_list *out, double depth, int digits, cv_message *why)
{
    faults *f = handle;
    mpfr_t re, im, error;
    (void)digits;
    f->depth_seen = depth;
    if (f->find != CV_OK)
        return cv_fail(why, f->find, "the fake was told to fail");
    mpfr_inits2(200, re, im, error, (mpfr_ptr)0);
    out->unstable = 4 + f->count;
    for (int k = 0; k < ROOTS; k++) {
        if (f->drop == k + 1)
            continue;
        mpfr_set_d(re, f->deeper > 0.0 && k == ROOTS - 1 ? -f->deeper : TRUTH[k].re, MPFR_RNDN);
        mpfr_set_d(im, f->move == k + 1 ? f->by : 0.0, MPFR_RNDN);
        mpfr_add_ui(im, im, 1, MPFR_RNDN);
        mpfr_mul_d(im, im, TRUTH[k].im, MPFR_RNDN);
        mpfr_set_d(error, f->error > 0.0 ? f->error : 1e-24, MPFR_RNDN);
        ck_assert_int_eq(
            cmp_root_list_append(out, re, im, error, f->doubtful == k + 1 ? CV_UNDECIDED : CV_OK, why),
            CV_OK);
    }
    out->status = f->undecided ? CV_UNDECIDED : CV_OK;
    mpfr_clears(re, im, error, (mpfr_ptr)0);
    return CV_OK;
}

static cv_status fake_zeta(void *handle, mpc_ptr zeta, mpfr_ptr error, mpc_srcptr qbar, mpfr_prec_t bits,
                           cv_message *why)
{
    const faults *f = handle;
    mpc_t factor, root;
    if (f->zeta != CV_OK)
        return cv_fail(why, f->zeta, "the fake cannot evaluate");
    mpc_init2(factor, bits);
    mpc_init2(root, bits);
    mpc_set_prec(zeta, bits);
    mpc_add_ui(zeta, qbar, 1, MPC_RNDNN);
    for (int k = 0; k < ROOTS; k++) {
        mpc_set_d_d(root, TRUTH[k].re, TRUTH[k].im, MPC_RNDNN);
        mpc_sub(factor, qbar, root, MPC_RNDNN);
        mpc_mul(zeta, zeta, factor, MPC_RNDNN);
    }
    mpc_add_ui(zeta, zeta, 1, MPC_RNDNN);
    mpfr_add_d(mpc_realref(zeta), mpc_realref(zeta), f->offset, MPFR_RNDN);
    mpfr_set_d(error, f->blunt, MPFR_RNDU);
    mpc_clear(factor);
    mpc_clear(root);
    return CV_OK;
}

static cv_status open_first(void **handle, const cv_params *track, const cv_number *alpha,
                            const cv_number *mass_ratio, cv_message *why)
{
    (void)track, (void)alpha, (void)mass_ratio, (void)why;
    *handle = &fake[0];
    return CV_OK;
}

static cv_status open_second(void **handle, const cv_params *track, const cv_number *alpha,
                             const cv_number *mass_ratio, cv_message *why)
{
    (void)track, (void)alpha, (void)mass_ratio, (void)why;
    *handle = &fake[1];
    return CV_OK;
}

static void fake_close(void *handle)
{
    (void)handle;
}

static const cmp_root_method FIRST = {"semianalytic", open_first, fake_close, fake_find, fake_zeta};
static const cmp_root_method SECOND = {"dgreen", open_second, fake_close, fake_find, fake_zeta};

static cmp_roots roots;
static cv_number alpha, eta_M;
static cv_params track;

static void set(cv_number *x, const char *text)
{
    ck_assert_int_eq(cv_number_parse(x, text, NULL), CV_OK);
}

static void setup(void)
{
    memset(fake, 0, sizeof fake);
    cv_number_init(&alpha);
    cv_number_init(&eta_M);
    cv_params_init(&track);
    set(&alpha, "0.5");
    set(&eta_M, "1");
    set(&track.mu_s, "6");
    set(&track.mu_b, "35");
    set(&track.kappa_p, "300");
    set(&track.kappa_b, "7");
    set(&track.eta_p, "0.05");
    set(&track.eta_b, "0.05");
    set(&track.eta_f, "0.05");
}

static void teardown(void)
{
    cv_number_clear(&alpha);
    cv_number_clear(&eta_M);
    cv_params_clear(&track);
    mpfr_free_cache();
}

static void compare(const cmp_root_method *first, const cmp_root_method *second, int digits)
{
    cv_message why = {""};
    const cmp_root_method *const methods[] = {first, second};
    ck_assert_msg(cmp_roots_compare(&roots, methods, &track, &alpha, &eta_M, digits, &why) == CV_OK, "%s",
                  why.text);
}

static void expect(cmp_kind kind, const char *word)
{
    compare(&FIRST, &SECOND, DIGITS);
    const cmp_verdict *v = &roots.verdict;
    ck_assert_msg(v->kind == kind, "%s: %s", cmp_kind_name(v->kind), v->reason.text);
    ck_assert_msg(strstr(v->reason.text, word) != NULL, "\"%s\" lacks \"%s\"", v->reason.text, word);
    cmp_roots_clear(&roots);
    memset(fake, 0, sizeof fake);
}

START_TEST(faultless_methods_agree)
{
    compare(&FIRST, &SECOND, DIGITS);
    ck_assert_msg(roots.verdict.kind == CMP_AGREE, "%s", roots.verdict.reason.text);
    ck_assert_uint_eq(roots.count, ROOTS);
    for (size_t i = 0; i < ROOTS; i++) {
        ck_assert(roots.rows[i].by[0] != NULL && roots.rows[i].by[1] != NULL);
        ck_assert_int_eq(roots.rows[i].unstable, i < 2);
        ck_assert_double_eq(mpfr_get_d(roots.rows[i].by[0]->re, MPFR_RNDN), TRUTH[i].re);
    }
    ck_assert_double_eq_tol(roots.verdict.digits, 24.0 + log10(0.0625), 0.01);
    ck_assert_double_eq(fake[0].depth_seen, 1.0); /* deeper than 0.5 */
    cmp_roots_clear(&roots);
}
END_TEST

START_TEST(a_missing_unstable_root_disagrees)
{
    fake[1].drop = 1;
    fake[1].count = -2;
    expect(CMP_DISAGREE, "counts 4 unstable roots, dgreen 2");
    fake[0].drop = 2;
    expect(CMP_DISAGREE, "semianalytic counts 4 unstable roots but lists 2");
    fake[0].drop = fake[1].drop = 1; /* both miss the same */
    expect(CMP_DISAGREE, "but lists 2");
}
END_TEST

START_TEST(a_wrong_count_disagrees)
{
    fake[0].count = 2;
    expect(CMP_DISAGREE, "counts 6 unstable roots but lists 4");
    fake[0].count = fake[1].count = 2;
    expect(CMP_DISAGREE, "counts 6 unstable roots but lists 4");
}
END_TEST

START_TEST(a_root_off_by_1e_15_disagrees)
{
    for (int k = 1; k <= ROOTS; k++) {
        fake[0].move = k;
        fake[0].by = 1e-15;
        expect(CMP_DISAGREE, "their bounds allow");
    }
}
END_TEST

START_TEST(the_same_wrong_root_in_both_is_caught_by_putting_back)
{
    for (int k = 1; k <= ROOTS; k++) {
        fake[0].move = fake[1].move = k;
        fake[0].by = fake[1].by = 1e-22;
        expect(CMP_DISAGREE, "does not satisfy z = 1");
    }
}
END_TEST

START_TEST(a_stable_root_only_one_lists_must_satisfy_the_other)
{
    fake[1].drop = 3;
    compare(&FIRST, &SECOND, DIGITS);
    ck_assert_msg(roots.verdict.kind == CMP_AGREE, "%s", roots.verdict.reason.text);
    ck_assert_ptr_null(roots.rows[2].by[1]);
    ck_assert(roots.rows[2].used > 0.0 || mpfr_zero_p(roots.rows[2].residual));
    ck_assert(isinf(roots.rows[2].verdict.digits));
    cmp_roots_clear(&roots);
    fake[0].move = 3; /* dgreen still lacks it */
    fake[0].by = 1e-15;
    expect(CMP_DISAGREE, "of semianalytic does not satisfy z = 1 of ");
    fake[1].drop = 3;
    fake[1].zeta = CV_UNDECIDED;
    expect(CMP_UNDECIDED, "dgreen cannot evaluate z sharply enough");
    fake[0].drop = 4;
    expect(CMP_AGREE, "");
}
END_TEST

START_TEST(a_stable_root_far_from_its_partner_stands_alone)
{
    fake[1].move = 4;
    fake[1].by = 0.1;
    expect(CMP_DISAGREE, "of dgreen does not satisfy z = 1 of semianalytic");
}
END_TEST

START_TEST(the_first_method_goes_as_deep_as_the_second)
{
    fake[1].deeper = 4.0;
    compare(&FIRST, &SECOND, DIGITS);
    ck_assert_double_gt(fake[0].depth_seen, 4.0);
    ck_assert_double_lt(fake[0].depth_seen, 4.5);
    cmp_roots_clear(&roots);
}
END_TEST

START_TEST(undecided_and_blunt_stay_undecided)
{
    fake[0].undecided = 1;
    expect(CMP_UNDECIDED, "semianalytic could not decide");
    fake[1].doubtful = 2;
    expect(CMP_UNDECIDED, "bounds of dgreen");
    fake[0].error = fake[1].error = 1e-19;
    expect(CMP_UNDECIDED, "do not give 20 digits");
    fake[1].blunt = 1e-20;
    expect(CMP_UNDECIDED, "sharply enough");
    fake[0].error = fake[1].error = 0.2; /* as wide as the growth rate: stable or not? */
    expect(CMP_UNDECIDED, "");
}
END_TEST

START_TEST(what_is_not_a_number_never_agrees)
{
    fake[0].move = 1;
    fake[0].by = (double)NAN;
    expect(CMP_DISAGREE, "");
    fake[0].move = fake[1].move = 4;
    fake[0].by = fake[1].by = (double)NAN;
    expect(CMP_DISAGREE, "not a number");
    fake[0].error = fake[1].error = (double)INFINITY;
    expect(CMP_DISAGREE, "not a number");
    fake[1].offset = (double)NAN;
    expect(CMP_DISAGREE, "does not satisfy");
}
END_TEST

START_TEST(another_zeta_disagrees)
{
    fake[1].offset = 1e-18;
    expect(CMP_DISAGREE, "of semianalytic does not satisfy z = 1 of dgreen");
}
END_TEST

START_TEST(failures_are_handed_on)
{
    cv_message why = {""};
    const cmp_root_method *const methods[] = {&FIRST, &SECOND};
    fake[0].find = CV_FAILED;
    ck_assert_int_eq(cmp_roots_compare(&roots, methods, &track, &alpha, &eta_M, DIGITS, &why), CV_FAILED);
    ck_assert_str_eq(why.text, "the fake was told to fail");
    fake[0].find = CV_OK;
    fake[1].zeta = CV_FAILED;
    ck_assert_int_eq(cmp_roots_compare(&roots, methods, &track, &alpha, &eta_M, DIGITS, &why), CV_FAILED);
}
END_TEST

/* ---- the real methods */

START_TEST(continued_zeta_of_both_is_one_function)
{
    static const cmp_root_method *const methods[] = {&cmp_roots_semianalytic, &cmp_roots_dgreen};
    static const double points[][2] = {{0.25, 0.3}, {0.01, 0.21}, {-0.01, 0.21}, {-0.3, 0.4}, {-0.9, 7.0}};
    enum { BITS = 300 };
    void *handles[CMP_METHODS];
    mpc_t qbar, zeta[CMP_METHODS];
    mpfr_t error[CMP_METHODS];
    cv_message why = {""};
    mpc_init2(qbar, BITS);
    for (int m = 0; m < CMP_METHODS; m++) {
        mpc_init2(zeta[m], BITS);
        mpfr_init2(error[m], 53);
        ck_assert_msg(methods[m]->open(&handles[m], &track, &alpha, &eta_M, &why) == CV_OK, "%s", why.text);
    }
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
        mpc_set_d_d(qbar, points[i][0], points[i][1], MPC_RNDNN);
        for (int m = 0; m < CMP_METHODS; m++) {
            ck_assert_msg(methods[m]->zeta(handles[m], zeta[m], error[m], qbar, BITS, &why) == CV_OK, "%s",
                          why.text);
            ck_assert(mpfr_cmp_d(error[m], 1e-60) < 0);
        }
        mpc_sub(zeta[0], zeta[0], zeta[1], MPC_RNDNN);
        mpc_abs(mpc_realref(zeta[1]), zeta[0], MPFR_RNDU);
        mpfr_add(error[0], error[0], error[1], MPFR_RNDU);
        ck_assert_msg(mpfr_lessequal_p(mpc_realref(zeta[1]), error[0]), "point %zu: differ by %g", i,
                      mpfr_get_d(mpc_realref(zeta[1]), MPFR_RNDN));
    }
    for (int m = 0; m < CMP_METHODS; m++) {
        methods[m]->close(handles[m]);
        mpc_clear(zeta[m]);
        mpfr_clear(error[m]);
    }
    mpc_clear(qbar);
}
END_TEST

START_TEST(the_real_methods_agree_and_report_it)
{
    cv_message why = {""};
    set(&eta_M, "100");
    compare(&cmp_roots_semianalytic, &cmp_roots_dgreen, 30);
    ck_assert_msg(roots.verdict.kind == CMP_AGREE, "%s", roots.verdict.reason.text);
    ck_assert_double_ge(roots.verdict.digits, 30.0);
    ck_assert_uint_ge(roots.count, 1);
    for (size_t i = 0; i < roots.count; i++) /* all were put back, real ones too */
        ck_assert_double_gt(roots.rows[i].used, 0.0);
    cv_selection selection;
    cv_selection_init(&selection);
    cv_number_set(&selection.alpha.value, &alpha);
    cv_number_set(&selection.mass_ratio.value, &eta_M);
    cv_case named = {.name = (char[]){"1"}};
    cv_choice choice = {.chosen = &named, .params = track, .digits = 30};
    const cmp_roots_report report = {&choice, &selection, {"semianalytic", "dgreen"}, &roots};
    char *text = NULL, *again = NULL;
    size_t n = 0;
    FILE *memory = open_memstream(&text, &n);
    ck_assert_int_eq(cmp_roots_report_json(memory, &report, &why), CV_OK);
    fclose(memory);
    memory = open_memstream(&again, &n);
    ck_assert_int_eq(cmp_roots_report_json(memory, &report, &why), CV_OK);
    ck_assert_int_eq(cmp_roots_report_text(memory, &report, &why), CV_OK);
    fclose(memory);
    ck_assert_int_eq(strncmp(text, again, strlen(text)), 0);
    ck_assert_ptr_nonnull(strstr(text, "\"schema\": \"critvel-compare-roots/1\""));
    ck_assert_ptr_nonnull(strstr(text, "\"verdict\": \"agree\""));
    ck_assert_ptr_nonnull(strstr(again, "both"));
    free(text);
    free(again);
    cv_selection_clear(&selection);
    cmp_roots_clear(&roots);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: roots");
    TCase *t = tcase_create("manufactured methods");
    tcase_add_checked_fixture(t, setup, teardown);
    tcase_add_test(t, faultless_methods_agree);
    tcase_add_test(t, a_missing_unstable_root_disagrees);
    tcase_add_test(t, a_wrong_count_disagrees);
    tcase_add_test(t, a_root_off_by_1e_15_disagrees);
    tcase_add_test(t, the_same_wrong_root_in_both_is_caught_by_putting_back);
    tcase_add_test(t, a_stable_root_only_one_lists_must_satisfy_the_other);
    tcase_add_test(t, a_stable_root_far_from_its_partner_stands_alone);
    tcase_add_test(t, the_first_method_goes_as_deep_as_the_second);
    tcase_add_test(t, undecided_and_blunt_stay_undecided);
    tcase_add_test(t, what_is_not_a_number_never_agrees);
    tcase_add_test(t, another_zeta_disagrees);
    tcase_add_test(t, failures_are_handed_on);
    suite_add_tcase(s, t);
    t = tcase_create("both methods");
    tcase_add_checked_fixture(t, setup, teardown);
    tcase_add_test(t, continued_zeta_of_both_is_one_function);
    tcase_add_test(t, the_real_methods_agree_and_report_it);
    suite_add_tcase(s, t);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
