/* Transitions of undamped tracks: between them the number of unstable roots is that of dgreen's winding,
 * damped ones tend to them, and some are resonance velocities of the moving force. */
#include <check.h>
#include <math.h>

#include "dgreen/count.h"
#include "semianalytic/lines.h"
#include "semianalytic/resonances.h"
#include "semianalytic/transitions.h"
#include "tests/semianalytic_points.h"

enum { MASSES = 3, DIGITS = 13 };

typedef struct {
    cv_params params;
    cv_number range[2], mass_ratio[MASSES];
    sa_boundary *boundary;
    sa_transitions list[MASSES];
} search;

static void search_start(search *s, const cv_params *params)
{
    const char *const mass[MASSES] = {"3", "40", "500"}, *const range[2] = {"0.1", "1.6"};
    cv_params_init(&s->params);
    cv_params_set(&s->params, params);
    for (int i = 0; i < 2; i++) {
        cv_number_init(&s->range[i]);
        set_text(&s->range[i], range[i]);
    }
    for (int i = 0; i < MASSES; i++) {
        cv_number_init(&s->mass_ratio[i]);
        set_text(&s->mass_ratio[i], mass[i]);
    }
    ck_assert_int_eq(sa_boundary_new(&s->boundary, params, &s->range[0], &s->range[1], NULL), CV_OK);
    ck_assert_int_eq(sa_boundary_transitions(s->list, s->boundary, MASSES, s->mass_ratio, DIGITS, 0, NULL),
                     CV_OK);
}

static void search_end(search *s)
{
    for (int i = 0; i < MASSES; i++) {
        sa_transitions_clear(&s->list[i]);
        cv_number_clear(&s->mass_ratio[i]);
    }
    cv_number_clear(&s->range[0]);
    cv_number_clear(&s->range[1]);
    sa_boundary_free(s->boundary);
    cv_params_clear(&s->params);
}

static void search_case(search *s, int c, const char *damping)
{
    cv_params p;
    cv_params_init(&p);
    set_params(&p, table1[c], damping);
    search_start(s, &p);
    cv_params_clear(&p);
}

static int roots_at(const sa_transitions *list, double alpha)
{
    int roots = list->roots_at_start;
    for (size_t i = 0; i < list->count && mpfr_cmp_d(list->items[i].alpha, alpha) < 0; i++)
        roots = list->items[i].above;
    return roots;
}

/* Counts by dgreen's winding at random velocities; returns how many could not be counted there. */
static int compare_counts(const search *s, int samples, gsl_rng *rng)
{
    dg_counter *counter;
    int undecided = 0;
    ck_assert_int_eq(dg_counter_new(&counter, &s->params, 0.1, 1.6, NULL), CV_OK);
    for (int i = 0; i < samples; i++) {
        double alpha = log_uniform(rng, 0.1, 1.6);
        int roots[MASSES];
        size_t failed;
        if (dg_count_unstable(roots, &failed, counter, alpha, MASSES, s->mass_ratio, NULL) != CV_OK) {
            undecided++;
            continue;
        }
        for (int m = 0; m < MASSES; m++)
            if (s->list[m].decided == CV_OK)
                ck_assert_msg(roots_at(&s->list[m], alpha) == roots[m],
                              "alpha %.15g mass %d: %d by dgreen, %d", alpha, m, roots[m],
                              roots_at(&s->list[m], alpha));
    }
    dg_counter_free(counter);
    return undecided;
}

START_TEST(counts_are_those_of_the_winding)
{
    gsl_rng *rng = random_start("counts", 7);
    int undecided = 0;
    for (int c = 0; c < 4; c++) {
        search s;
        search_case(&s, c, "0");
        for (int m = 0; m < MASSES; m++)
            ck_assert_msg(s.list[m].decided == CV_OK, "case %d: %s", c + 1, s.list[m].reason.text);
        undecided += compare_counts(&s, 4, rng);
        search_end(&s);
    }
    printf("%d of 16 velocities undecided by the winding\n", undecided);
    ck_assert_int_le(undecided, 1);
    gsl_rng_free(rng);
}
END_TEST

static double nearest(const sa_transitions *list, double alpha)
{
    double distance = INFINITY;
    for (size_t i = 0; i < list->count; i++)
        distance = fmin(distance, fabs(mpfr_get_d(list->items[i].alpha, MPFR_RNDN) - alpha));
    return distance;
}

/* Case 2, where no transition is near a branch curve: the damped ones tend to the limit in first order. */
START_TEST(damped_transitions_tend_to_them)
{
    search limit, damped[2];
    search_case(&limit, 1, "0");
    search_case(&damped[0], 1, "1e-6");
    search_case(&damped[1], 1, "1e-7");
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

/* Case 1: waves of no group velocity come and go at the resonance velocity 0.1509, and with them two roots
 * for each mass; q = 0 there. */
START_TEST(jump_at_a_resonance_velocity)
{
    cv_params p;
    search s;
    sa_resonance_list found;
    cv_params_init(&p);
    set_params(&p, table1[0], "0");
    ck_assert_int_eq(sa_resonances(&found, &p, 20, NULL), CV_OK);
    search_case(&s, 0, "0");
    for (int m = 0; m < MASSES; m++) {
        double distance = INFINITY;
        for (size_t i = 0; i < found.count; i++)
            distance = fmin(distance, nearest(&s.list[m], mpfr_get_d(found.item[i].alpha, MPFR_RNDN)));
        ck_assert_double_lt(distance, 1e-14);
    }
    sa_resonances_clear(&found);
    search_end(&s);
    cv_params_clear(&p);
}
END_TEST

/* Towards the shear speed of the ballast, alpha^2 mu_b = eta_s, a branch curve comes to q = 0 with ever
 * shorter waves; on this track two roots end with it, for every mass. */
START_TEST(jump_at_the_shear_speed)
{
    static const char *const track[6] = {"5.39309", "44.5051", "0.189418", "0.440042", "16.2703", "0"};
    const double speed = sqrt(16.2703 / 44.5051);
    cv_params p;
    search s;
    cv_params_init(&p);
    set_params(&p, track, "0");
    search_start(&s, &p);
    for (int m = 0; m < MASSES; m++) {
        const sa_transitions *list = &s.list[m];
        size_t i = 0;
        ck_assert_msg(list->decided == CV_OK, "%s", list->reason.text);
        while (i < list->count && !(fabs(mpfr_get_d(list->items[i].alpha, MPFR_RNDN) - speed) < 1e-12))
            i++;
        ck_assert_uint_lt(i, list->count);
        ck_assert_int_eq(list->items[i].above, list->items[i].below - 2);
        ck_assert(mpfr_zero_p(list->items[i].q));
    }
    search_end(&s);
    cv_params_clear(&p);
}
END_TEST

/* A lightly damped track whose stability limit tends to a resonance velocity does so in order 2/11
 * (convergence.h). The track is that of data/track.ini, Zhai 2004, rounded. */
START_TEST(order_at_a_resonance_velocity)
{
    static const char *const zhai[6] = {"3.7975", "16.0793", "0.838748", "1.777426", "0.696109", "0"};
    static const char *const damping[4] = {"0", "1e-6", "1e-7", "1e-8"};
    double alpha[4];
    cv_params p;
    cv_params_init(&p);
    for (int i = 0; i < 4; i++) {
        search s;
        set_params(&p, zhai, damping[i]);
        search_start(&s, &p);
        ck_assert_msg(s.list[1].decided == CV_OK, "%s", s.list[1].reason.text);
        ck_assert_uint_ge(s.list[1].count, 1);
        alpha[i] = mpfr_get_d(s.list[1].items[0].alpha, MPFR_RNDN);
        if (i == 0)
            ck_assert(mpfr_zero_p(s.list[1].items[0].q));
        search_end(&s);
    }
    double order = log10((alpha[1] - alpha[2]) / (alpha[2] - alpha[3]));
    double to_limit = log10((alpha[2] - alpha[0]) / (alpha[3] - alpha[0]));
    printf("order %.4f, %.4f to the limit; 2/11 = %.4f\n", order, to_limit, 2.0 / 11);
    ck_assert_double_eq_tol(order, 2.0 / 11, 0.004);
    ck_assert_double_eq_tol(to_limit, 2.0 / 11, 0.004);
    cv_params_clear(&p);
}
END_TEST

static void find_lines(sa_lines *out, int c, const char *damping)
{
    const char *const text[4] = {"0.1", "1.6", "1", "1000"};
    cv_number number[4];
    cv_params p;
    cv_params_init(&p);
    set_params(&p, table1[c], damping);
    for (int i = 0; i < 4; i++) {
        cv_number_init(&number[i]);
        set_text(&number[i], text[i]);
    }
    const sa_lines_range range = {&number[0], &number[1], &number[2], &number[3]};
    ck_assert_int_eq(sa_lines_find(out, &p, &range, 12, NULL), CV_OK);
    for (int i = 0; i < 4; i++)
        cv_number_clear(&number[i]);
    cv_params_clear(&p);
}

static double least_mass(const sa_branch *b)
{
    double least = INFINITY;
    for (size_t i = 0; i < b->count; i++)
        least = fmin(least, mpfr_get_d(b->vertex[i].eta_M, MPFR_RNDN));
    return least;
}

/* The branch of case 4 between 0.366 and 0.413, both of its asymptotes and its least mass: the damped ones
 * tend to them in first order. */
START_TEST(damped_lines_tend_to_those_without_damping)
{
    static const char *const damping[3] = {"0", "1e-6", "1e-7"};
    double at[3][3];
    for (int i = 0; i < 3; i++) {
        sa_lines lines;
        find_lines(&lines, 3, damping[i]);
        ck_assert_int_eq(lines.decided, CV_OK);
        ck_assert_uint_ge(lines.count, 1);
        ck_assert_int_eq(lines.branch[0].kind, SA_LINE_INFINITE);
        const sa_line_end *end[2] = {&lines.branch[0].start, &lines.branch[0].end};
        for (int k = 0; k < 2; k++) {
            ck_assert_int_eq(end[k]->beyond, SA_BEYOND_ASYMPTOTE);
            at[i][k] = mpfr_get_d(lines.asymptotes.item[end[k]->number].alpha, MPFR_RNDN);
        }
        at[i][2] = least_mass(&lines.branch[0]);
        sa_lines_clear(&lines);
    }
    for (int k = 0; k < 3; k++) {
        double far = fabs(at[1][k] - at[0][k]), near = fabs(at[2][k] - at[0][k]);
        ck_assert_msg(far < 0.01 * at[0][k] && near > 0.09 * far && near < 0.11 * far, "%d: %.12g, %.3e %.3e",
                      k, at[0][k], far, near);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic transitions without damping");
    TCase *tests = tcase_create("limit");
    tcase_add_test(tests, counts_are_those_of_the_winding);
    tcase_add_test(tests, damped_transitions_tend_to_them);
    tcase_add_test(tests, jump_at_a_resonance_velocity);
    tcase_add_test(tests, jump_at_the_shear_speed);
    tcase_add_test(tests, order_at_a_resonance_velocity);
    tcase_add_test(tests, damped_lines_tend_to_those_without_damping);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
