/* Transitions: each put back into zeta, all against counts of their own, and the list against itself under
 * other ranges, other companions and other digits. */
#include <check.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "dgreen/count.h"
#include "dgreen/transitions.h"
#include "dgreen/transitions_bracket.h"
#include "dgreen/z_mp.h"
#include "tests/dgreen_points.h"

enum { MASSES = 4, DIGITS = 20 };
static const double mass_values[MASSES] = {3, 30, 300, 1000};

typedef struct {
    cv_number masses[MASSES], low, high;
    dg_transition_list lists[MASSES];
    dg_effort effort;
} search;

static void search_run(search *s, const cv_params *p, double low, double high, int digits)
{
    cv_message why;
    for (int i = 0; i < MASSES; i++) {
        cv_number_init(&s->masses[i]);
        set_decimal(&s->masses[i], mass_values[i]);
    }
    cv_number_init(&s->low);
    cv_number_init(&s->high);
    set_decimal(&s->low, low);
    set_decimal(&s->high, high);
    const cv_status status =
        dg_find_transitions(s->lists, &s->effort, p, &s->low, &s->high, MASSES, s->masses, digits, 0, &why);
    ck_assert_msg(status == CV_OK, "%s", why.text);
    for (int i = 0; i < MASSES; i++)
        ck_assert_msg(s->lists[i].status == CV_OK, "%s", s->lists[i].why.text);
}

static void search_clear(search *s)
{
    for (int i = 0; i < MASSES; i++) {
        cv_number_clear(&s->masses[i]);
        dg_transition_list_clear(&s->lists[i]);
    }
    cv_number_clear(&s->low);
    cv_number_clear(&s->high);
}

/* |eta_M zeta - 1| at (alpha, q), 300 bits */
static double misfit(const dg_track *t, mpfr_srcptr alpha, mpfr_srcptr q, const cv_number *mass)
{
    mpc_t zeta;
    mpfr_t re_error, im_error, m;
    mpc_init2(zeta, 300);
    mpfr_inits2(300, re_error, im_error, m, (mpfr_ptr)NULL);
    ck_assert_int_eq(dg_zeta_mp(zeta, re_error, im_error, t, alpha, q, 300), CV_OK);
    cv_number_get_mpfr(m, mass);
    mpc_mul_fr(zeta, zeta, m, MPC_RNDNN);
    mpc_sub_ui(zeta, zeta, 1, MPC_RNDNN);
    mpc_abs(m, zeta, MPFR_RNDN);
    const double result = mpfr_get_d(m, MPFR_RNDN);
    mpc_clear(zeta);
    mpfr_clears(re_error, im_error, m, (mpfr_ptr)NULL);
    return result;
}

/* Below, above: counts at velocities beside the transition, as close as its neighbours allow */
static void check_counts(dg_counter *c, const search *s, int i, gsl_rng *rng)
{
    const dg_transition_list *list = &s->lists[i];
    int expected = list->count_at_min;
    double from = 0.02;
    for (size_t k = 0; k <= list->count; k++) {
        const double to = k < list->count ? mpfr_get_d(list->items[k].alpha, MPFR_RNDN) : 2;
        const double alpha = from + (to - from) * gsl_rng_uniform(rng);
        size_t failed;
        int roots;
        if (alpha - from > 1e-13 && to - alpha > 1e-13) {
            cv_message why;
            const cv_status status = dg_count_unstable(&roots, &failed, c, alpha, 1, &s->masses[i], &why);
            ck_assert_msg(status == CV_OK, "%s", why.text);
            ck_assert_msg(roots == expected, "alpha %.17g: %d roots, %d by the list", alpha, roots, expected);
        }
        if (k < list->count) {
            ck_assert_int_eq(list->items[k].count_below, expected);
            expected = list->items[k].count_above;
            ck_assert_int_eq(abs(expected - list->items[k].count_below), 2);
        }
        from = to;
    }
}

START_TEST(random_tracks)
{
    gsl_rng *rng = random_start("test_dgreen_transitions", 20240801);
    for (int n = 0; n < 6; n++) {
        dg_track *t = random_damped_track(rng);
        dg_counter *c;
        search s;
        search_run(&s, &t->exact, 0.02, 2, DIGITS);
        ck_assert_int_eq(dg_counter_new(&c, &t->exact, 0.02, 2, NULL), CV_OK);
        for (int i = 0; i < MASSES; i++) {
            check_counts(c, &s, i, rng);
            for (size_t k = 0; k < s.lists[i].count; k++) {
                const dg_transition *x = &s.lists[i].items[k];
                const double alpha = mpfr_get_d(x->alpha, MPFR_RNDN), q = mpfr_get_d(x->frequency, MPFR_RNDN);
                ck_assert(x->decided == CV_OK && x->alpha_error > 0 && x->frequency_error > 0);
                ck_assert(x->alpha_error <= 1e-20 * alpha && x->frequency_error <= 1e-20 * q);
                ck_assert(misfit(t, x->alpha, x->frequency, &s.masses[i]) < 1e-9);
            }
        }
        dg_counter_free(c);
        dg_track_free(t);
        search_clear(&s);
    }
    gsl_rng_free(rng);
}
END_TEST

/* |a - b| <= room, both errors included */
static int close(mpfr_srcptr a, mpfr_srcptr b, double room)
{
    mpfr_t d;
    mpfr_init2(d, 300);
    mpfr_sub(d, a, b, MPFR_RNDN);
    const int result = mpfr_cmp_d(d, room) <= 0 && mpfr_cmp_d(d, -room) >= 0;
    mpfr_clear(d);
    return result;
}

static void check_same(const dg_transition *a, const dg_transition *b)
{
    ck_assert(close(a->alpha, b->alpha, a->alpha_error + b->alpha_error));
    ck_assert(close(a->frequency, b->frequency, a->frequency_error + b->frequency_error));
    ck_assert_int_eq(a->count_below, b->count_below);
    ck_assert_int_eq(a->count_above, b->count_above);
}

/* The error bounds of 20 digits hold against 50 digits; case 4 at 1e-10, with pairs 1e-9 apart. */
START_TEST(more_digits_confirm_the_bounds)
{
    dg_track *t = track_of("3 10 0.03 0.1 1e-10 1e-10 1e-10 0 0");
    search few, many;
    search_run(&few, &t->exact, 0.42, 0.48, 20);
    search_run(&many, &t->exact, 0.42, 0.48, 50);
    for (int i = 0; i < MASSES; i++) {
        ck_assert_uint_eq(few.lists[i].count, many.lists[i].count);
        for (size_t k = 0; k < few.lists[i].count; k++) {
            check_same(&few.lists[i].items[k], &many.lists[i].items[k]);
            ck_assert(many.lists[i].items[k].alpha_error < 1e-50);
        }
    }
    search_clear(&few);
    search_clear(&many);
    dg_track_free(t);
}
END_TEST

/* A range cut in two gives the same list. */
START_TEST(ranges_add_up)
{
    gsl_rng *rng = random_start("test_dgreen_transitions", 20240802);
    for (int n = 0; n < 2; n++) {
        dg_track *t = random_damped_track(rng);
        const double middle = floor(1e3 * log_uniform(rng, 0.1, 1.5)) / 1e3;
        search whole, low, high;
        search_run(&whole, &t->exact, 0.02, 2, DIGITS);
        search_run(&low, &t->exact, 0.02, middle, DIGITS);
        search_run(&high, &t->exact, middle, 2, DIGITS);
        for (int i = 0; i < MASSES; i++) {
            const size_t first = low.lists[i].count;
            ck_assert_uint_eq(whole.lists[i].count, first + high.lists[i].count);
            for (size_t k = 0; k < whole.lists[i].count; k++)
                check_same(&whole.lists[i].items[k],
                           k < first ? &low.lists[i].items[k] : &high.lists[i].items[k - first]);
        }
        search_clear(&whole);
        search_clear(&low);
        search_clear(&high);
        dg_track_free(t);
    }
    gsl_rng_free(rng);
}
END_TEST

static void *search_in_thread(void *context)
{
    search *s = context;
    dg_track *t = track_of("6 5 0.03 3 1e-4 1e-4 1e-4 0 0");
    search_run(s, &t->exact, 0.02, 2, DIGITS);
    dg_track_free(t);
    return NULL;
}

/* Two searches at once give what one gives. */
START_TEST(threads_do_not_meet)
{
    search s[3];
    pthread_t other;
    ck_assert_int_eq(pthread_create(&other, NULL, search_in_thread, &s[0]), 0);
    search_in_thread(&s[1]);
    ck_assert_int_eq(pthread_join(other, NULL), 0);
    search_in_thread(&s[2]);
    for (int i = 0; i < MASSES; i++)
        for (int n = 0; n < 2; n++) {
            ck_assert_uint_eq(s[n].lists[i].count, s[2].lists[i].count);
            for (size_t k = 0; k < s[2].lists[i].count; k++)
                ck_assert(mpfr_equal_p(s[n].lists[i].items[k].alpha, s[2].lists[i].items[k].alpha));
        }
    for (int n = 0; n < 3; n++)
        search_clear(&s[n]);
}
END_TEST

/* x^3 - 2, certified by exact signs */
static cv_status cube_less_two(dg_end *e, void *context)
{
    (void)context;
    mpfr_pow_ui(e->value, e->at, 3, MPFR_RNDN);
    mpfr_sub_ui(e->value, e->value, 2, MPFR_RNDN);
    e->sign = mpfr_sgn(e->value) > 0 ? 1 : -1;
    return CV_OK;
}

START_TEST(bracket_closes_on_the_cube_root)
{
    dg_bracket b;
    mpfr_t centre;
    dg_bracket_init(&b, 400, cube_less_two, NULL);
    mpfr_init2(centre, 400);
    mpfr_set_d(centre, 1.26, MPFR_RNDN);
    ck_assert_int_eq(dg_bracket_open(&b, centre, 1e-6, 0.1), CV_OK);
    mpfr_set_str(b.tolerance, "1e-100", 10, MPFR_RNDN);
    ck_assert_int_eq(dg_bracket_close(&b), CV_OK);
    mpfr_cbrt(centre, (mpfr_set_ui(centre, 2, MPFR_RNDN), centre), MPFR_RNDN);
    ck_assert(mpfr_lessequal_p(b.low.at, centre) && mpfr_lessequal_p(centre, b.high.at));
    mpfr_sub(centre, b.high.at, b.low.at, MPFR_RNDN);
    ck_assert(mpfr_lessequal_p(centre, b.tolerance));
    mpfr_clear(centre);
    dg_bracket_clear(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen transitions");
    TCase *c = tcase_create("transitions");
    tcase_set_timeout(c, 240);
    tcase_add_test(c, random_tracks);
    tcase_add_test(c, more_digits_confirm_the_bounds);
    tcase_add_test(c, ranges_add_up);
    tcase_add_test(c, threads_do_not_meet);
    tcase_add_test(c, bracket_closes_on_the_cube_root);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
