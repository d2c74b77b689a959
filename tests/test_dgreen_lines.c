/* Instability lines of dgreen: against proved transitions and counts by winding; their shape, direction and
 * ends. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "tests/dgreen_lines_fixture.h"
#include "tests/reference_data.h"

/* The facts of the issue: case 3 at 1e-10, alpha = 0.45 has crossings at eta_M near 32.2, 60.49 and 1023.86.
 */
START_TEST(test_crossings_case_3)
{
    fixture f;
    static const double known[3] = {32.2, 60.49, 1023.86}, within[3] = {0.05, 0.005, 0.005};
    fixture_init(&f, case3, "1e-10", 0.44, 0.46);
    for (int i = 0; i < 3; i++) {
        const int below = by_lines(&f, 0.45, known[i] - within[i]),
                  above = by_lines(&f, 0.45, known[i] + within[i]);
        ck_assert_int_eq(abs(above - below), 2);
    }
    ck_assert_int_eq(by_lines(&f, 0.45, 33), by_lines(&f, 0.45, 60));
    ck_assert_int_eq(by_lines(&f, 0.45, 61), by_lines(&f, 0.45, 1000));
    ck_assert_int_eq(by_lines(&f, 0.45, 1.01), 0);
    fixture_clear(&f);
}
END_TEST

/* Case 4 at 1e-10, alpha = 0.4: one crossing, at eta_M near 231.0, on a branch from infinite mass near 0.366
 * to infinite mass near 0.413. */
START_TEST(test_branch_of_case_4)
{
    fixture f;
    fixture_init(&f, case4, "1e-10", 0.3, 0.43);
    ck_assert_int_eq(by_lines(&f, 0.4, 230.9), 0);
    ck_assert_int_eq(by_lines(&f, 0.4, 231.1), 2);
    ck_assert_int_eq(by_lines(&f, 0.4, 9999), 2);
    const dg_line *l = &f.lines.lines[0];
    ck_assert_int_eq(l->exits[0], DG_LINE_INFINITE_MASS);
    ck_assert_int_eq(l->exits[1], DG_LINE_INFINITE_MASS);
    ck_assert_double_eq_tol(l->asymptote[0], 0.366, 5e-4);
    ck_assert_double_eq_tol(l->asymptote[1], 0.413, 5e-4);
    ck_assert_double_eq(l->asymptote_q[0] + l->asymptote_q[1], 0);
    ck_assert(l->vertices[l->least].mass_ratio < 231);
    fixture_clear(&f);
}
END_TEST

/* The levels of the reference data that are taken, by track and eta_p: one of the hard ones, and what takes
 * little time
 */
static int is_taken(const json_t *combination)
{
    static const char *const taken[][2] = {{"3", "1e-4"}, {"4", "1e-10"}, {"D", "0.2"},
                                           {"E", "1e-4"}, {"F", "0.1"},   {"H", "1e-3"}};
    const char *track = reference_text(combination, "track");
    const char *damping = reference_text(json_object_get(combination, "parameters"), "eta_p");
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++)
        if (strcmp(track, taken[i][0]) == 0 && strcmp(damping, taken[i][1]) == 0)
            return 1;
    return 0;
}

static void check_passages(const dg_lines *lines, const json_t *combination)
{
    dg_line_passage *found;
    size_t count;
    cv_message why;
    const json_t *known = json_object_get(combination, "transitions");
    const double mass = strtod(reference_text(combination, "eta_M"), NULL);
    ck_assert_msg(dg_lines_passages(&found, &count, lines, mass, &why) == CV_OK, "%s", why.text);
    ck_assert_uint_eq(count, json_array_size(known));
    for (size_t i = 0; i < count; i++) {
        const json_t *t = json_array_get(known, i);
        const double alpha = strtod(reference_text(t, "alpha"), NULL),
                     q = strtod(reference_text(t, "q"), NULL);
        ck_assert_double_eq_tol(found[i].alpha, alpha, 1e-10 * alpha);
        ck_assert_double_eq_tol(found[i].q, q, 1e-7 * q);
        ck_assert_int_eq(found[i].change, json_integer_value(json_object_get(t, "unstable_roots_above")) -
                                              json_integer_value(json_object_get(t, "unstable_roots_below")));
    }
    free(found);
}

/* Every proved transition is a passage of a line, and there is no other. */
START_TEST(test_reference_transitions)
{
    json_t *file =
        reference_load("data/reference_transitions.json", "critvel-reference-transitions/1", "combinations");
    ck_assert_ptr_nonnull(file);
    const json_t *list = json_object_get(file, "combinations");
    const json_t *last = NULL; /* the parameters the lines belong to */
    dg_lines lines = {0};
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *c = json_array_get(list, i), *parameters = json_object_get(c, "parameters");
        if (!is_taken(c))
            continue;
        if (last == NULL || !json_equal(last, parameters)) {
            cv_params p;
            cv_message why;
            const json_t *range = json_object_get(c, "alpha_range");
            cv_params_init(&p);
            reference_params(&p, c);
            dg_lines_clear(&lines);
            ck_assert_int_eq(
                dg_lines_find(&lines, &p, strtod(json_string_value(json_array_get(range, 0)), NULL),
                              strtod(json_string_value(json_array_get(range, 1)), NULL), 0.5, 2e4, &why),
                CV_OK);
            ck_assert_uint_eq(lines.doubt_count, 0);
            cv_params_clear(&p);
            last = parameters;
        }
        check_passages(&lines, c);
    }
    dg_lines_clear(&lines);
    json_decref(file);
}
END_TEST

/* A point of the plane: anywhere, or near a vertex of a line at distances down to 1e-9 */
static void random_place(double *alpha, double *mass, const dg_lines *l, gsl_rng *rng)
{
    *alpha = log_uniform(rng, 0.02, 2);
    *mass = log_uniform(rng, 0.1, 9999);
    if (l->count == 0 || gsl_rng_uniform_int(rng, 2))
        return;
    const dg_line *line = &l->lines[gsl_rng_uniform_int(rng, l->count)];
    const dg_line_vertex *v = &line->vertices[gsl_rng_uniform_int(rng, line->count)];
    const double aside = log_uniform(rng, 1e-9, 1e-2), over = log_uniform(rng, 1e-9, 0.1);
    *alpha = fmin(fmax(v->alpha * (gsl_rng_uniform_int(rng, 2) ? 1 + aside : 1 - aside), 0.02), 2);
    *mass = fmin(v->mass_ratio * (gsl_rng_uniform_int(rng, 2) ? 1 + over : 1 - over), 9999);
}

/* N by counting lines is N by winding; undecided only very close to a line. */
static void check_counts(const fixture *f, int points, gsl_rng *rng)
{
    int decided = 0;
    for (int i = 0; i < points; i++) {
        double alpha, mass;
        int lines, winding;
        cv_message why;
        random_place(&alpha, &mass, &f->lines, rng);
        if (dg_lines_count(&lines, &f->lines, alpha, mass, &why) != CV_OK ||
            !by_winding(&winding, f, alpha, mass))
            continue;
        ck_assert_msg(lines == winding, "alpha = %.17g, eta_M = %.17g: %d by lines, %d by winding", alpha,
                      mass, lines, winding);
        decided++;
    }
    ck_assert_int_ge(decided, points - points / 10);
}

START_TEST(test_counts)
{
    gsl_rng *rng = random_start("test_counts", 20261127);
    enum { TRACKS = 4 };
    static const char *const tracks[TRACKS] = {
        "6 35 300 7 1e-10 1e-10 1e-10 0 0", "6 5 0.03 3 1e-4 1e-4 1e-4 0 0",
        "2 5 100 3 1e-3 1e-3 1e-3 0.5 0.3", "4 8 0.03 0.5 1e-4 0.02 0 0.02 0.1"};
    for (int i = 0; i < TRACKS; i++) {
        fixture f = {.track = track_of(tracks[i]), .alpha_min = 0.02, .alpha_max = 2};
        fixture_find(&f, 1, 1e4);
        check_counts(&f, 40, rng);
        fixture_clear(&f);
    }
    gsl_rng_free(rng);
}
END_TEST

/* The same on tracks drawn at random, without those for which curves take long */
START_TEST(test_counts_random_tracks)
{
    gsl_rng *rng = random_start("test_counts_random_tracks", 20261128);
    for (int i = 0; i < 3; i++) {
        fixture f = {.alpha_min = 0.02, .alpha_max = 2};
        do
            f.track = random_damped_track(rng);
        while ((f.track->eta_p < 1e-3 || f.track->eta_b < 1e-3 || f.track->eta_f < 1e-3) &&
               (dg_track_free(f.track), 1));
        fixture_find(&f, 1, 1e4);
        check_counts(&f, 30, rng);
        fixture_clear(&f);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Two more roots are unstable on the left of a line: above it where alpha grows, below it where alpha falls;
 * and stable_roots is the smaller number. */
START_TEST(test_direction)
{
    fixture f;
    int checked = 0;
    fixture_init(&f, case3, "1e-4", 0.4, 0.85);
    for (size_t i = 0; i < f.lines.count; i++)
        for (size_t k = 1; k + 1 < f.lines.lines[i].count; k++) {
            const dg_line_vertex *v = &f.lines.lines[i].vertices[k];
            int above, below;
            if (v[-1].turns || v->turns || v[1].turns ||
                (v[1].alpha > v->alpha) != (v->alpha > v[-1].alpha) || v->mass_ratio > 9000)
                continue;
            if (!by_winding(&above, &f, v->alpha, v->mass_ratio * (1 + 1e-6)) ||
                !by_winding(&below, &f, v->alpha, v->mass_ratio * (1 - 1e-6)))
                continue;
            ck_assert_int_eq(above - below, v[1].alpha > v->alpha ? 2 : -2);
            if (v->stable_roots >= 0)
                ck_assert_int_eq(v->stable_roots, above < below ? above : below);
            checked++;
        }
    ck_assert_int_ge(checked, 10);
    fixture_clear(&f);
}
END_TEST

/* Distance of a point from a polyline in the plot */
static double plot_distance(const dg_lines *l, const dg_line *line, double alpha, double mass)
{
    const double width = l->alpha_max - l->alpha_min, height = log(l->mass_max / l->mass_min);
    double least = INFINITY;
    for (size_t i = 0; i + 1 < line->count; i++) {
        const dg_line_vertex *a = &line->vertices[i], *b = a + 1;
        const double u = (b->alpha - a->alpha) / width, v = log(b->mass_ratio / a->mass_ratio) / height;
        const double x = (alpha - a->alpha) / width, y = log(mass / a->mass_ratio) / height;
        const double part = fmin(fmax((x * u + y * v) / fmax(u * u + v * v, 1e-300), 0), 1);
        least = fmin(least, hypot(x - part * u, y - part * v));
    }
    return least;
}

/* Points of lines at mass ratios that no vertex has lie within the chord error of a polyline, and that has
 * few vertices.
 */
START_TEST(test_chord_error)
{
    static const char *const levels[] = {"0.1", "1e-4"};
    for (int level = 0; level < 2; level++) {
        fixture f;
        size_t vertices = 0;
        fixture_init(&f, case1, levels[level], 0.1, 2);
        for (size_t i = 0; i < f.lines.count; i++)
            vertices += f.lines.lines[i].count;
        ck_assert_uint_lt(vertices, 200);
        for (double mass = 1.01; mass < 1e4; mass *= 1.2) {
            dg_line_passage *found;
            size_t count;
            cv_message why;
            ck_assert_int_eq(dg_lines_passages(&found, &count, &f.lines, mass, &why), CV_OK);
            for (size_t i = 0; i < count; i++) {
                double least = INFINITY;
                for (size_t k = 0; k < f.lines.count; k++)
                    least = fmin(least, plot_distance(&f.lines, &f.lines.lines[k], found[i].alpha, mass));
                ck_assert_double_le(least, 1e-3);
            }
            free(found);
        }
        fixture_clear(&f);
    }
}
END_TEST

/* At a turning point two crossings of the curve meet: N at eta_M just above and below it differs on one side
 * only. */
START_TEST(test_turning_points)
{
    fixture f;
    int found = 0;
    fixture_init(&f, case3, "1e-4", 0.4, 0.7);
    for (size_t i = 0; i < f.lines.count; i++)
        for (size_t k = 1; k + 1 < f.lines.lines[i].count; k++) {
            const dg_line_vertex *v = &f.lines.lines[i].vertices[k];
            if (!v->turns)
                continue;
            /* beside a parabola with its tip at v */
            const double inside = v[1].alpha > v->alpha ? 1 : -1, step = 1e-12 * v->alpha;
            int in, out;
            ck_assert_int_eq((v[-1].alpha > v->alpha) == (v[1].alpha > v->alpha), 1);
            if (by_winding(&in, &f, v->alpha + inside * step, v->mass_ratio) &&
                by_winding(&out, &f, v->alpha - inside * step, v->mass_ratio))
                ck_assert_int_eq(abs(in - out), 2);
            found++;
        }
    ck_assert_int_ge(found, 6);
    fixture_clear(&f);
}
END_TEST

/* The closed line of case 3 at 1e-4, which the range of figure 5 cuts open at eta_M = 1e4 */
START_TEST(test_closed_line)
{
    fixture f = {.track = track_of("6 5 0.03 3 1e-4 1e-4 1e-4 0 0"), .alpha_min = 0.65, .alpha_max = 0.8};
    int closed = 0;
    fixture_find(&f, 10, 1e7);
    for (size_t i = 0; i < f.lines.count; i++) {
        const dg_line *l = &f.lines.lines[i];
        if (l->exits[0] != DG_LINE_CLOSED)
            continue;
        closed++;
        ck_assert_int_eq(l->exits[1], DG_LINE_CLOSED);
        ck_assert_double_eq(l->vertices[0].alpha, l->vertices[l->count - 1].alpha);
        ck_assert_double_eq(l->vertices[0].mass_ratio, l->vertices[l->count - 1].mass_ratio);
    }
    ck_assert_int_eq(closed, 1);
    fixture_clear(&f);
}
END_TEST

/* Case 3 runs to zero mass at infinite velocity; what leaves at the highest velocity in case 1 does not: a
 * greater range shows that it turns to infinite mass. */
START_TEST(test_zero_mass)
{
    fixture f;
    cv_message why;
    dg_lines wide;
    int lines = 0;
    fixture_init(&f, case3, "0.1", 0.4, 2);
    ck_assert_uint_eq(f.lines.count, 1);
    ck_assert_int_eq(f.lines.lines[0].zero_mass[0] + f.lines.lines[0].zero_mass[1], 1);
    fixture_clear(&f);
    fixture_init(&f, case1, "0.1", 0.4, 2);
    for (size_t i = 0; i < f.lines.count; i++)
        lines += f.lines.lines[i].zero_mass[0] + f.lines.lines[i].zero_mass[1];
    ck_assert_int_eq(lines, 0);
    ck_assert_int_eq(dg_lines_find(&wide, &f.track->exact, 1.9, 4, 1, 1e4, &why), CV_OK);
    ck_assert_int_eq(wide.lines[0].exits[1], DG_LINE_INFINITE_MASS);
    dg_lines_clear(&wide);
    fixture_clear(&f);
}
END_TEST

/* In a part of the range the lines are parts of the same lines: the same passages there. */
START_TEST(test_part_of_range)
{
    fixture f;
    dg_lines part;
    cv_message why;
    fixture_init(&f, case3, "1e-4", 0.4, 0.85);
    ck_assert_int_eq(dg_lines_find(&part, &f.track->exact, 0.41, 0.76, 2, 3000, &why), CV_OK);
    for (double mass = 2.3; mass < 3000; mass *= 2.1) {
        dg_line_passage *all, *some;
        size_t all_count, some_count, k = 0;
        ck_assert_int_eq(dg_lines_passages(&all, &all_count, &f.lines, mass, &why), CV_OK);
        ck_assert_int_eq(dg_lines_passages(&some, &some_count, &part, mass, &why), CV_OK);
        for (size_t i = 0; i < all_count; i++) {
            if (all[i].alpha < 0.41 || all[i].alpha > 0.76)
                continue;
            ck_assert_uint_lt(k, some_count);
            ck_assert_double_eq_tol(some[k].alpha, all[i].alpha, 1e-10);
            ck_assert_int_eq(some[k].change, all[i].change);
            k++;
        }
        ck_assert_uint_eq(k, some_count);
        free(all);
        free(some);
    }
    dg_lines_clear(&part);
    fixture_clear(&f);
}
END_TEST

START_TEST(test_refused)
{
    dg_track *damped = track_of("6 35 300 7 0.1 0.1 0.1 0 0"), *undamped = track_of("6 35 300 7 0 0 0 0 0");
    dg_lines l;
    cv_message why;
    int roots;
    ck_assert_int_eq(dg_lines_find(&l, &undamped->exact, 0.1, 1, 1, 100, &why), CV_BAD_INPUT);
    ck_assert_int_eq(dg_lines_find(&l, &damped->exact, 0, 1, 1, 100, &why), CV_BAD_INPUT);
    ck_assert_int_eq(dg_lines_find(&l, &damped->exact, 1, 1, 1, 100, &why), CV_BAD_INPUT);
    ck_assert_int_eq(dg_lines_find(&l, &damped->exact, 0.1, 1, 0, 100, &why), CV_BAD_INPUT);
    ck_assert_int_eq(dg_lines_find(&l, &damped->exact, 0.1, 1, 100, 10, &why), CV_BAD_INPUT);
    ck_assert_uint_eq(l.count, 0);
    ck_assert_int_eq(dg_lines_find(&l, &damped->exact, 0.1, 0.3, 1, 1000, &why), CV_OK);
    ck_assert_int_eq(dg_lines_count(&roots, &l, 0.5, 10, &why), CV_BAD_INPUT);
    ck_assert_int_eq(dg_lines_count(&roots, &l, 0.2, 2000, &why), CV_BAD_INPUT);
    dg_lines_clear(&l);
    dg_track_free(damped);
    dg_track_free(undamped);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen: lines");
    TCase *tests = tcase_create("lines");
    tcase_add_test(tests, test_crossings_case_3);
    tcase_add_test(tests, test_branch_of_case_4);
    tcase_add_test(tests, test_reference_transitions);
    tcase_add_test(tests, test_counts);
    tcase_add_test(tests, test_counts_random_tracks);
    tcase_add_test(tests, test_direction);
    tcase_add_test(tests, test_chord_error);
    tcase_add_test(tests, test_turning_points);
    tcase_add_test(tests, test_closed_line);
    tcase_add_test(tests, test_zero_mass);
    tcase_add_test(tests, test_part_of_range);
    tcase_add_test(tests, test_refused);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
