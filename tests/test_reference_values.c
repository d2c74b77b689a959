/* Both trees against values from a third, rigorous route that shares no code with them:
 * data/reference_*.json, made by tests/reference/ with ball arithmetic. */
#include <check.h>
#include <mpc.h>

#include "dgreen/transitions.h"
#include "dgreen/z_mp.h"
#include "semianalytic/kernel.h"
#include "semianalytic/transitions.h"
#include "tests/reference_data.h"

enum { DIGITS = 38, BITS = 200 };

/* |value - reference| <= 10^-digits |reference|; an exact zero is exactly 0 */
static int same(mpfr_srcptr value, const char *reference, int digits)
{
    mpfr_t wanted, error;
    mpfr_init2(wanted, BITS);
    mpfr_init2(error, BITS);
    mpfr_set_str(wanted, reference, 10, MPFR_RNDN);
    mpfr_sub(error, value, wanted, MPFR_RNDN);
    mpfr_abs(error, error, MPFR_RNDN);
    mpfr_abs(wanted, wanted, MPFR_RNDN);
    for (int i = 0; i < digits; i++)
        mpfr_mul_ui(error, error, 10, MPFR_RNDN);
    const int result = mpfr_lessequal_p(error, wanted) != 0;
    mpfr_clears(wanted, error, (mpfr_ptr)0);
    return result;
}

static void check_zeta(const char *tree, size_t index, const json_t *point, mpc_srcptr zeta, cv_status status,
                       const cv_message *why)
{
    ck_assert_msg(status == CV_OK, "%s, point %zu: status %d, %s", tree, index, (int)status, why->text);
    ck_assert_msg(same(mpc_realref(zeta), reference_text(point, "zeta_re"), DIGITS), "%s, point %zu: Re zeta",
                  tree, index);
    ck_assert_msg(same(mpc_imagref(zeta), reference_text(point, "zeta_im"), DIGITS), "%s, point %zu: Im zeta",
                  tree, index);
}

static void both_trees(size_t index, const json_t *point)
{
    cv_params params;
    cv_number alpha, q;
    cv_message why = {""};
    sa_track *semianalytic;
    dg_track *dgreen;
    mpc_t zeta;
    cv_params_init(&params);
    cv_number_init(&alpha);
    cv_number_init(&q);
    mpc_init2(zeta, 53);
    reference_params(&params, point);
    reference_number(&alpha, point, "alpha");
    reference_number(&q, point, "q");
    ck_assert_int_eq(sa_track_new(&semianalytic, &params, &why), CV_OK);
    ck_assert_int_eq(dg_track_new(&dgreen, &params, &why), CV_OK);
    cv_status status = sa_zeta_digits(zeta, semianalytic, &alpha, &q, DIGITS + 2, &why);
    check_zeta("semianalytic", index, point, zeta, status, &why);
    status = dg_zeta_digits(zeta, dgreen, &alpha, NULL, &q, DIGITS + 2, &why);
    check_zeta("dgreen", index, point, zeta, status, &why);
    sa_track_free(semianalytic);
    dg_track_free(dgreen);
    mpc_clear(zeta);
    cv_number_clear(&q);
    cv_number_clear(&alpha);
    cv_params_clear(&params);
}

START_TEST(zeta_of_both_trees)
{
    json_t *file = reference_load("data/reference_zeta.json", "critvel-reference-zeta/1", "points");
    ck_assert_msg(file != NULL, "data/reference_zeta.json cannot be read or does not match its checksum");
    const json_t *points = json_object_get(file, "points");
    ck_assert_uint_gt(json_array_size(points), 100);
    for (size_t i = 0; i < json_array_size(points); i++)
        both_trees(i, json_array_get(points, i));
    json_decref(file);
}
END_TEST

enum { MASSES_MAX = 16, CLAIMS_MAX = 64, TRANSITION_DIGITS = 20 };

/* What a tree claims for one mass ratio; the numbers stay the tree's. */
typedef struct {
    cv_status status;
    const char *why;
    size_t count;
    mpfr_srcptr alpha[CLAIMS_MAX], q[CLAIMS_MAX];
    int below[CLAIMS_MAX], above[CLAIMS_MAX];
} claims;

/* The records of one track at one damping: same parameters and range, one record for each mass ratio. */
typedef struct {
    cv_params params;
    cv_number alpha_min, alpha_max, mass[MASSES_MAX];
    size_t count;
    const json_t *record[MASSES_MAX];
} combination;

static void check_transition(const char *where, const json_t *record, const claims *c, size_t i)
{
    const json_t *wanted = json_array_get(json_object_get(record, "transitions"), i);
    ck_assert_msg(same(c->alpha[i], reference_text(wanted, "alpha"), TRANSITION_DIGITS), "%s: alpha of %zu",
                  where, i);
    ck_assert_msg(same(c->q[i], reference_text(wanted, "q"), TRANSITION_DIGITS), "%s: q of %zu", where, i);
    ck_assert_msg(c->below[i] == json_integer_value(json_object_get(wanted, "unstable_roots_below")) &&
                      c->above[i] == json_integer_value(json_object_get(wanted, "unstable_roots_above")),
                  "%s: unstable roots at %zu: %d to %d", where, i, c->below[i], c->above[i]);
}

static void check_claims(const char *tree, const json_t *record, const claims *c)
{
    char where[256];
    const json_t *params = json_object_get(record, "parameters");
    snprintf(where, sizeof where, "%s, track %s, damping %s %s %s, eta_M %s", tree,
             reference_text(record, "track"), reference_text(params, "eta_p"),
             reference_text(params, "eta_b"), reference_text(params, "eta_f"),
             reference_text(record, "eta_M"));
    ck_assert_msg(c->status == CV_OK, "%s: status %d, %s", where, (int)c->status, c->why);
    ck_assert_msg(c->count == json_array_size(json_object_get(record, "transitions")),
                  "%s: %zu transitions for %zu", where, c->count,
                  json_array_size(json_object_get(record, "transitions")));
    for (size_t i = 0; i < c->count; i++)
        check_transition(where, record, c, i);
}

static void check_semianalytic(const combination *k)
{
    sa_transitions lists[MASSES_MAX];
    sa_boundary *boundary;
    cv_message why = {""};
    cv_status status = sa_boundary_new(&boundary, &k->params, &k->alpha_min, &k->alpha_max, &why);
    ck_assert_msg(status == CV_OK, "semianalytic: %s", why.text);
    status = sa_boundary_transitions(lists, boundary, k->count, k->mass, TRANSITION_DIGITS + 1, 0, &why);
    ck_assert_msg(status == CV_OK, "semianalytic: %s", why.text);
    for (size_t m = 0; m < k->count; m++) {
        claims c = {lists[m].decided, lists[m].reason.text, lists[m].count, {0}, {0}, {0}, {0}};
        for (size_t i = 0; i < c.count && i < CLAIMS_MAX; i++) {
            c.alpha[i] = lists[m].items[i].alpha;
            c.q[i] = lists[m].items[i].q;
            c.below[i] = lists[m].items[i].below;
            c.above[i] = lists[m].items[i].above;
        }
        check_claims("semianalytic", k->record[m], &c);
    }
    for (size_t m = 0; m < k->count; m++)
        sa_transitions_clear(&lists[m]);
    sa_boundary_free(boundary);
}

static void check_dgreen(const combination *k)
{
    dg_transition_list lists[MASSES_MAX];
    cv_message why = {""};
    const cv_status status = dg_find_transitions(lists, NULL, &k->params, &k->alpha_min, &k->alpha_max,
                                                 k->count, k->mass, TRANSITION_DIGITS + 1, 0, &why);
    ck_assert_msg(status == CV_OK, "dgreen: %s", why.text);
    for (size_t m = 0; m < k->count; m++) {
        claims c = {lists[m].status, lists[m].why.text, lists[m].count, {0}, {0}, {0}, {0}};
        for (size_t i = 0; i < c.count && i < CLAIMS_MAX; i++) {
            c.alpha[i] = lists[m].items[i].alpha;
            c.q[i] = lists[m].items[i].frequency;
            c.below[i] = lists[m].items[i].count_below;
            c.above[i] = lists[m].items[i].count_above;
        }
        check_claims("dgreen", k->record[m], &c);
    }
    for (size_t m = 0; m < k->count; m++)
        dg_transition_list_clear(&lists[m]);
}

static void combination_init(combination *k)
{
    cv_params_init(&k->params);
    cv_number_init(&k->alpha_min);
    cv_number_init(&k->alpha_max);
    for (size_t m = 0; m < MASSES_MAX; m++)
        cv_number_init(&k->mass[m]);
}

static void combination_clear(combination *k)
{
    cv_params_clear(&k->params);
    cv_number_clear(&k->alpha_min);
    cv_number_clear(&k->alpha_max);
    for (size_t m = 0; m < MASSES_MAX; m++)
        cv_number_clear(&k->mass[m]);
}

/* The records from "first" on that belong together; returns how many. */
static size_t combination_set(combination *k, const json_t *records, size_t first)
{
    const json_t *record = json_array_get(records, first);
    const json_t *range = json_object_get(record, "alpha_range");
    reference_params(&k->params, record);
    if (cv_number_parse(&k->alpha_min, json_string_value(json_array_get(range, 0)), NULL) != CV_OK ||
        cv_number_parse(&k->alpha_max, json_string_value(json_array_get(range, 1)), NULL) != CV_OK)
        abort();
    for (k->count = 0; k->count < MASSES_MAX; k->count++) {
        const json_t *next = json_array_get(records, first + k->count);
        if (next == NULL ||
            !json_equal(json_object_get(next, "parameters"), json_object_get(record, "parameters")))
            break;
        k->record[k->count] = next;
        reference_number(&k->mass[k->count], next, "eta_M");
    }
    return k->count;
}

/* Everything takes minutes. A test run leaves out the tracks beside the paper's whose damping is below 1e-6,
 * unless CRITVEL_REFERENCE=all. */
static int chosen(const combination *k)
{
    const char *wish = getenv("CRITVEL_REFERENCE"), *track = reference_text(k->record[0], "track");
    if ((wish != NULL && strcmp(wish, "all") == 0) || strspn(track, "1234") == strlen(track))
        return 1;
    return cv_number_get_double(&k->params.eta_p) >= 1e-6;
}

static void each_combination(void (*check)(const combination *))
{
    json_t *file =
        reference_load("data/reference_transitions.json", "critvel-reference-transitions/1", "combinations");
    ck_assert_msg(file != NULL,
                  "data/reference_transitions.json cannot be read or does not match its checksum");
    const json_t *records = json_object_get(file, "combinations");
    ck_assert_uint_gt(json_array_size(records), 100);
    combination k;
    combination_init(&k);
    for (size_t i = 0; i < json_array_size(records);) {
        i += combination_set(&k, records, i);
        if (chosen(&k))
            check(&k);
    }
    combination_clear(&k);
    json_decref(file);
}

START_TEST(transitions_of_semianalytic)
{
    each_combination(check_semianalytic);
}
END_TEST

START_TEST(transitions_of_dgreen)
{
    each_combination(check_dgreen);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("reference values");
    TCase *values = tcase_create("zeta");
    tcase_add_test(values, zeta_of_both_trees);
    suite_add_tcase(suite, values);
    TCase *transitions = tcase_create("transitions");
    tcase_set_timeout(transitions, 60);
    tcase_add_test(transitions, transitions_of_semianalytic);
    tcase_add_test(transitions, transitions_of_dgreen);
    suite_add_tcase(suite, transitions);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
