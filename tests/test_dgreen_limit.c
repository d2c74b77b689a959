/* dgreen's transitions without damping: those of semianalytic/, which traces Im zeta = 0 and knows what
 * happens at special velocities by formula, are the same; damped ones tend to them; resonance velocities of
 * the moving force are among them. */
#include <check.h>
#include <math.h>

#include "dgreen/count.h"
#include "dgreen/transitions.h"
#include "semianalytic/resonances.h"
#include "semianalytic/transitions.h"
#include "tests/semianalytic_points.h"

enum { MASSES = 2, DIGITS = 12 };
static const char *const mass_text[MASSES] = {"3", "200"};

typedef struct {
    cv_params params;
    cv_number range[2], mass_ratio[MASSES];
    dg_transition_list list[MASSES];
} search;

static void search_start(search *s, const char *const track[6], const char *damping, const char *low,
                         const char *high)
{
    cv_message why;
    cv_params_init(&s->params);
    set_params(&s->params, track, damping);
    for (int i = 0; i < 2; i++) {
        cv_number_init(&s->range[i]);
        set_text(&s->range[i], i ? high : low);
    }
    for (int i = 0; i < MASSES; i++) {
        cv_number_init(&s->mass_ratio[i]);
        set_text(&s->mass_ratio[i], mass_text[i]);
    }
    ck_assert_int_eq(dg_find_transitions(s->list, NULL, &s->params, &s->range[0], &s->range[1], MASSES,
                                         s->mass_ratio, DIGITS, 0, &why),
                     CV_OK);
    for (int m = 0; m < MASSES; m++)
        ck_assert_msg(s->list[m].status == CV_OK, "%s", s->list[m].why.text);
}

static void search_end(search *s)
{
    for (int m = 0; m < MASSES; m++) {
        dg_transition_list_clear(&s->list[m]);
        cv_number_clear(&s->mass_ratio[m]);
    }
    cv_number_clear(&s->range[0]);
    cv_number_clear(&s->range[1]);
    cv_params_clear(&s->params);
}

static int differ(mpfr_srcptr a, mpfr_srcptr b, double bound)
{
    mpfr_t gap;
    mpfr_init2(gap, 64);
    mpfr_sub(gap, a, b, MPFR_RNDA);
    int result = !(fabs(mpfr_get_d(gap, MPFR_RNDA)) <= bound);
    mpfr_clear(gap);
    return result;
}

static void compare(const dg_transition_list *found, const sa_transitions *expected)
{
    ck_assert_msg(expected->decided == CV_OK, "%s", expected->reason.text);
    ck_assert_uint_eq(found->count, expected->count);
    ck_assert_int_eq(found->count_at_min, expected->roots_at_start);
    for (size_t i = 0; i < found->count; i++) {
        const dg_transition *t = &found->items[i];
        const sa_transition *e = &expected->items[i];
        ck_assert(!differ(t->alpha, e->alpha, t->alpha_error + e->alpha_error));
        ck_assert(!differ(t->frequency, e->q, t->frequency_error + e->q_error));
        ck_assert(t->count_below == e->below && t->count_above == e->above);
    }
}

/* Zhai's track of data/track.ini, rounded, after cases 3 and 4 of the paper */
static const char *const zhai[6] = {"3.7975", "16.0793", "0.838748", "1.777426", "0.696109", "0"};

START_TEST(those_of_semianalytic)
{
    search s;
    sa_boundary *boundary;
    sa_transitions expected[MASSES];
    static const char *const range[3][2] = {{"0.6", "0.66"}, {"0.43", "0.48"}, {"0.9", "1.1"}};
    search_start(&s, _i < 2 ? table1[2 + _i] : zhai, "0", range[_i][0], range[_i][1]);
    ck_assert_int_eq(sa_boundary_new(&boundary, &s.params, &s.range[0], &s.range[1], NULL), CV_OK);
    ck_assert_int_eq(sa_boundary_transitions(expected, boundary, MASSES, s.mass_ratio, DIGITS, 0, NULL),
                     CV_OK);
    for (int m = 0; m < MASSES; m++) {
        compare(&s.list[m], &expected[m]);
        sa_transitions_clear(&expected[m]);
    }
    sa_boundary_free(boundary);
    search_end(&s);
}
END_TEST

static double nearest(const dg_transition_list *list, double alpha)
{
    double distance = INFINITY;
    for (size_t i = 0; i < list->count; i++)
        distance = fmin(distance, fabs(mpfr_get_d(list->items[i].alpha, MPFR_RNDN) - alpha));
    return distance;
}

/* Case 2, where all transitions are between special velocities: in first order of the damping. */
START_TEST(damped_ones_tend_to_them)
{
    search limit, damped[2];
    search_start(&limit, table1[1], "0", "0.6", "1.1");
    search_start(&damped[0], table1[1], "1e-5", "0.6", "1.1");
    search_start(&damped[1], table1[1], "1e-6", "0.6", "1.1");
    for (int m = 0; m < MASSES; m++) {
        ck_assert_uint_eq(limit.list[m].count, damped[1].list[m].count);
        for (size_t i = 0; i < limit.list[m].count; i++) {
            double alpha = mpfr_get_d(limit.list[m].items[i].alpha, MPFR_RNDN);
            double far = nearest(&damped[0].list[m], alpha), near = nearest(&damped[1].list[m], alpha);
            ck_assert_msg(far < 1e-3 && near > 0.09 * far && near < 0.11 * far, "alpha %.15g: %.3e %.3e",
                          alpha, far, near);
        }
    }
    search_end(&limit);
    search_end(&damped[0]);
    search_end(&damped[1]);
}
END_TEST

/* Case 4: for a small mass the stability limit is the first resonance velocity, with q = 0. */
START_TEST(a_resonance_velocity_is_the_stability_limit)
{
    search s;
    sa_resonance_list found;
    search_start(&s, table1[3], "0", "0.43", "0.44");
    ck_assert_int_eq(sa_resonances(&found, &s.params, 20, NULL), CV_OK);
    const dg_transition *first = &s.list[0].items[0];
    ck_assert(!differ(first->alpha, found.item[0].alpha, first->alpha_error));
    ck_assert(mpfr_zero_p(first->frequency));
    ck_assert(first->count_below == 0 && first->count_above == 2);
    sa_resonances_clear(&found);
    search_end(&s);
}
END_TEST

/* Towards the shear speed of the ballast the waves of no group velocity become ever shorter and move the rail
 * ever less: zeta is infinite at their frequency, but at the next double it is not even large, nor has Im
 * zeta the sign that it has there (on the second track). semianalytic/ knows by formula what passes between.
 */
typedef struct {
    const char *track[6], *range[2], *mass[2];
    double alpha[6];
} weak_waves;

static const weak_waves weak[] = {{{"5.39309", "44.5051", "0.189418", "0.440042", "16.2703", "0"},
                                   {"0.5", "0.7"},
                                   {"3", "200"},
                                   {0.59, 0.602, 0.6025, 0.603, 0.604, 0.6046}},
                                  {{"4.36967", "10.6459", "6.9343", "18.9819", "7.65112", "0"},
                                   {"0.8", "0.9"},
                                   {"5", "700"},
                                   {0.83, 0.841, 0.84160739395378392, 0.843, 0.8441, 0.847}}};

START_TEST(weak_waves_count)
{
    const weak_waves *w = &weak[_i];
    cv_params params;
    cv_number range[2], mass;
    sa_boundary *boundary;
    dg_counter *counter;
    size_t failed;
    cv_params_init(&params);
    set_params(&params, w->track, "0");
    cv_number_init(&mass);
    for (int i = 0; i < 2; i++) {
        cv_number_init(&range[i]);
        set_text(&range[i], w->range[i]);
    }
    ck_assert_int_eq(sa_boundary_new(&boundary, &params, &range[0], &range[1], NULL), CV_OK);
    ck_assert_int_eq(dg_counter_new(&counter, &params, 0.5, 0.9, NULL), CV_OK);
    for (int i = 0; i < 12; i++) {
        const double alpha = w->alpha[i / 2];
        int expected = -1, found = -1;
        set_text(&mass, w->mass[i % 2]);
        ck_assert_int_eq(sa_boundary_unstable_roots(&expected, boundary, alpha, 1, &mass, NULL), CV_OK);
        ck_assert_int_eq(dg_count_unstable(&found, &failed, counter, alpha, 1, &mass, NULL), CV_OK);
        ck_assert_msg(found == expected, "alpha %g, eta_M %s: %d, %d by semianalytic", alpha, w->mass[i % 2],
                      found, expected);
    }
    dg_counter_free(counter);
    sa_boundary_free(boundary);
    cv_number_clear(&range[0]);
    cv_number_clear(&range[1]);
    cv_number_clear(&mass);
    cv_params_clear(&params);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen transitions without damping");
    TCase *tests = tcase_create("limit");
    tcase_add_loop_test(tests, those_of_semianalytic, 0, 3);
    tcase_add_test(tests, damped_ones_tend_to_them);
    tcase_add_test(tests, a_resonance_velocity_is_the_stability_limit);
    tcase_add_loop_test(tests, weak_waves_count, 0, 2);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
