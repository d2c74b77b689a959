/* Transitions of tracks on which the search once failed, each for its own reason: the counts by winding
 * between them, the transitions put back into zeta at 300 bits, and closer looks. */
#include <check.h>
#include <stdlib.h>

#include "dgreen/count.h"
#include "dgreen/transitions.h"
#include "dgreen/z_mp.h"
#include "tests/random_track.h"

enum { DIGITS = 20, MOST_MASSES = 3 };

typedef struct {
    const char *track[6];   /* mu_s, mu_b, kappa_p, kappa_b, eta_s, eta_N */
    const char *damping[3]; /* eta_p, eta_b, eta_f */
    size_t mass_count;
    const char *mass[MOST_MASSES];
} hard;

static const hard
    /* A wide bend of a wave's group velocity once left a gap in the frequencies, with two zeros of Im zeta in
       it */
    wide = {{"2.25371", "35.7773", "0.156647", "0.122019", "7.343", "-0.0254933"},
            {"1e-8", "1e-8", "1e-8"},
            2,
            {"30", "300"}},
    unequal = {{"4.13", "17.6", "1.42", "22.9", "0", "-0.0211"},
               {"1.63e-4", "2.62e-9", "5.47e-9"},
               2,
               {"300", "1000"}},
    strong = {{"1.207375", "10.70275", ".7611525", ".1158521", ".2734375", ".1584033"},
              {"0.2", "0.2", "0.2"},
              3,
              {"3", "30", "300"}},
    /* Transitions ever nearer to the fold where their crossing of the real axis dies, all within 1e-15 */
    folded = {{"4.31406", "17.0606", "2.23646", "4698.24", "19.0667", "-0.170781"},
              {"1e-10", "1e-10", "1e-10"},
              3,
              {"3", "3.005", "3.011"}};

typedef struct {
    cv_params params;
    dg_track *track;
    cv_number low, high, mass[MOST_MASSES];
    size_t count;
    dg_transition_list lists[MOST_MASSES];
} search;

static void parse(cv_number *to, const char *text)
{
    cv_number_init(to);
    ck_assert_int_eq(cv_number_parse(to, text, NULL), CV_OK);
}

static void search_run(search *s, const hard *h, const char *low, const char *high, int look)
{
    cv_message why;
    cv_params_init(&s->params);
    cv_number *const into[] = {&s->params.mu_s,    &s->params.mu_b,  &s->params.kappa_p,
                               &s->params.kappa_b, &s->params.eta_s, &s->params.eta_N,
                               &s->params.eta_p,   &s->params.eta_b, &s->params.eta_f};
    for (int i = 0; i < 9; i++)
        ck_assert_int_eq(cv_number_parse(into[i], i < 6 ? h->track[i] : h->damping[i - 6], NULL), CV_OK);
    parse(&s->low, low);
    parse(&s->high, high);
    s->count = h->mass_count;
    for (size_t k = 0; k < s->count; k++)
        parse(&s->mass[k], h->mass[k]);
    ck_assert_int_eq(dg_track_new(&s->track, &s->params, NULL), CV_OK);
    const cv_status status = dg_find_transitions(s->lists, NULL, &s->params, &s->low, &s->high, s->count,
                                                 s->mass, DIGITS, look, &why);
    ck_assert_msg(status == CV_OK, "%s", why.text);
    for (size_t k = 0; k < s->count; k++)
        ck_assert_msg(s->lists[k].status == CV_OK, "%s", s->lists[k].why.text);
}

static void search_clear(search *s)
{
    for (size_t k = 0; k < s->count; k++) {
        cv_number_clear(&s->mass[k]);
        dg_transition_list_clear(&s->lists[k]);
    }
    cv_number_clear(&s->low);
    cv_number_clear(&s->high);
    dg_track_free(s->track);
    cv_params_clear(&s->params);
}

/* |eta_M zeta - 1| at the transition, 300 bits */
static double misfit(const search *s, size_t k, const dg_transition *x)
{
    mpc_t zeta;
    mpfr_t re_error, im_error, m;
    mpc_init2(zeta, 300);
    mpfr_inits2(300, re_error, im_error, m, (mpfr_ptr)NULL);
    ck_assert_int_eq(dg_zeta_mp(zeta, re_error, im_error, s->track, x->alpha, x->frequency, 300), CV_OK);
    cv_number_get_mpfr(m, &s->mass[k]);
    mpc_mul_fr(zeta, zeta, m, MPC_RNDNN);
    mpc_sub_ui(zeta, zeta, 1, MPC_RNDNN);
    mpc_abs(m, zeta, MPFR_RNDN);
    const double result = mpfr_get_d(m, MPFR_RNDN);
    mpc_clear(zeta);
    mpfr_clears(re_error, im_error, m, (mpfr_ptr)NULL);
    return result;
}

/* |x - text| */
static double distance(mpfr_srcptr x, const char *text)
{
    mpfr_t d;
    mpfr_init2(d, 200);
    ck_assert_int_eq(mpfr_set_str(d, text, 10, MPFR_RNDN), 0);
    mpfr_sub(d, d, x, MPFR_RNDN);
    const double result = fabs(mpfr_get_d(d, MPFR_RNDU));
    mpfr_clear(d);
    return result;
}

static int counted(dg_counter *c, const search *s, size_t k, double alpha)
{
    size_t failed;
    int roots = -1;
    cv_message why;
    const cv_status status = dg_count_unstable(&roots, &failed, c, alpha, 1, &s->mass[k], &why);
    ck_assert_msg(status == CV_OK, "%s", why.text);
    return roots;
}

/* Somewhere between any two neighbours, and beside the ends, the winding gives the count of the list. */
static void check_list(const search *s, size_t k, dg_counter *c, gsl_rng *rng)
{
    const dg_transition_list *list = &s->lists[k];
    int expected = list->count_at_min;
    double from = cv_number_get_double(&s->low);
    for (size_t i = 0; i <= list->count; i++) {
        const dg_transition *x = &list->items[i];
        const double to = i < list->count ? mpfr_get_d(x->alpha, MPFR_RNDN) : cv_number_get_double(&s->high);
        const double alpha = from + (to - from) * (0.1 + 0.8 * gsl_rng_uniform(rng));
        if (to - from > 1e-12)
            ck_assert_int_eq(counted(c, s, k, alpha), expected);
        from = to;
        if (i == list->count)
            break;
        ck_assert_int_eq(x->count_below, expected);
        ck_assert(x->count_above >= 0);
        ck_assert_int_eq(abs(x->count_above - expected), 2);
        expected = x->count_above;
        ck_assert_double_le(misfit(s, k, x), 1e-6);
    }
}

static void check_track(const hard *h)
{
    gsl_rng *rng = random_start("test_dgreen_hard_tracks", 20261127);
    search s;
    dg_counter *c;
    search_run(&s, h, "0.02", "2", 0);
    ck_assert_int_eq(dg_counter_new(&c, &s.params, 0.02, 2, NULL), CV_OK);
    for (size_t k = 0; k < s.count; k++)
        check_list(&s, k, c, rng);
    dg_counter_free(c);
    search_clear(&s);
    gsl_rng_free(rng);
}

START_TEST(counts_by_two_routes)
{
    const hard *tracks[] = {&wide, &unequal, &strong};
    for (size_t i = 0; i < sizeof tracks / sizeof *tracks; i++)
        check_track(tracks[i]);
}
END_TEST

/* The list between 0.5 and 0.56 is that of tests/reference/transitions.c (ball arithmetic of Arb 2.23, proved
 * by interval Newton), where the pair of zeros was overlooked. */
START_TEST(referee_agrees)
{
    static const char *const alpha[] = {"0.505690073926545211464466603027",
                                        "0.539410315586193868612144717553"};
    static const char *const q[] = {"0.036037150161680352851045268237", "0.035514444615167668438862025291"};
    search s;
    search_run(&s, &wide, "0.5", "0.56", 0);
    const dg_transition_list *list = &s.lists[1];
    ck_assert_int_eq(list->count_at_min, 2);
    ck_assert_uint_eq(list->count, 2);
    for (int i = 0; i < 2; i++) {
        ck_assert_double_le(distance(list->items[i].alpha, alpha[i]), list->items[i].alpha_error + 1e-30);
        ck_assert_double_le(distance(list->items[i].frequency, q[i]), list->items[i].frequency_error + 1e-30);
    }
    search_clear(&s);
}
END_TEST

/* Two unstable roots between the transitions, none on both sides, one step of doubles beyond the fold. */
START_TEST(fold_between_doubles)
{
    search s;
    dg_counter *c;
    search_run(&s, &folded, "0.95", "0.955", 0);
    ck_assert_int_eq(dg_counter_new(&c, &s.params, 0.95, 0.955, NULL), CV_OK);
    for (size_t k = 0; k < s.count; k++) {
        ck_assert_uint_eq(s.lists[k].count, 2);
        const dg_transition *birth = &s.lists[k].items[0], *death = birth + 1;
        ck_assert(birth->count_below == 0 && birth->count_above == 2 && death->count_above == 0);
        const double first = mpfr_get_d(birth->alpha, MPFR_RNDN), last = mpfr_get_d(death->alpha, MPFR_RNDN);
        ck_assert_int_eq(counted(c, &s, k, first * (1 - 1e-14)), 0);
        ck_assert_int_eq(counted(c, &s, k, (first + last) / 2), 2);
        ck_assert_int_eq(counted(c, &s, k, last * (1 + 1e-14)), 0);
        ck_assert_double_le(misfit(&s, k, birth), 1e-6);
        ck_assert_double_le(misfit(&s, k, death), 1e-6);
    }
    dg_counter_free(c);
    search_clear(&s);
}
END_TEST

/* A closer look finds the same, whatever mass ratio is asked for beside it. */
START_TEST(closer_look_agrees)
{
    search normal, closer;
    search_run(&normal, &strong, "0.02", "2", 0);
    search_run(&closer, &strong, "0.02", "2", 1);
    for (size_t k = 0; k < normal.count; k++) {
        ck_assert_uint_eq(normal.lists[k].count, closer.lists[k].count);
        for (size_t i = 0; i < normal.lists[k].count; i++) {
            const dg_transition *a = &normal.lists[k].items[i], *b = &closer.lists[k].items[i];
            mpfr_t d;
            mpfr_init2(d, 300);
            mpfr_sub(d, a->alpha, b->alpha, MPFR_RNDN);
            ck_assert(fabs(mpfr_get_d(d, MPFR_RNDN)) <= a->alpha_error + b->alpha_error);
            mpfr_clear(d);
            ck_assert_int_eq(a->count_above, b->count_above);
        }
    }
    search_clear(&normal);
    search_clear(&closer);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen hard tracks");
    TCase *c = tcase_create("hard tracks");
    tcase_set_timeout(c, 240);
    tcase_add_test(c, counts_by_two_routes);
    tcase_add_test(c, referee_agrees);
    tcase_add_test(c, fold_between_doubles);
    tcase_add_test(c, closer_look_agrees);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
