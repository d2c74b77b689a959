/* Instability lines against transitions proved by a third route (data/reference_*.json),
 * the values named in the paper's hard cases, and counts of roots by the crossings. */
#include <check.h>

#include "semianalytic/kernel.h"
#include "semianalytic/transitions.h"
#include "tests/reference_data.h"
#include "tests/semianalytic_ranges.h"

static void find(sa_lines *lines, const cv_params *p, const typed_range *r, int digits)
{
    cv_message why = {""};
    ck_assert_msg(sa_lines_find(lines, p, &r->range, digits, &why) == CV_OK, "%s", why.text);
    ck_assert_msg(lines->decided == CV_OK, "%s", lines->reason.text);
}

static void find_case(sa_lines *lines, int number, const char *damping, const char *mass_min,
                      const char *mass_max, int digits)
{
    cv_params p;
    typed_range r;
    cv_params_init(&p);
    set_params(&p, table1[number - 1], damping);
    range_set(&r, "0.02", "2", mass_min, mass_max);
    find(lines, &p, &r, digits);
    range_clear(&r);
    cv_params_clear(&p);
}

/* ---- transitions are the passages of the lines through eta_M ---- */

/* Passages of all branches through eta_M within "near" of alpha (any alpha: infinite), as the change of N
 * with growing alpha: on an upward way the left, with 2 more, is at smaller alpha. */
static int passages(int *change, const sa_lines *lines, double eta_M, double alpha, double near)
{
    int count = 0;
    *change = 0;
    for (size_t i = 0; i < lines->count; i++)
        for (size_t k = 0; k + 1 < lines->branch[i].count; k++) {
            const sa_line_vertex *a = &lines->branch[i].vertex[k], *b = a + 1;
            double from = as_double(a->eta_M), to = as_double(b->eta_M);
            double x = log(eta_M / from) / log(to / from);
            double at = as_double(a->alpha) + x * (as_double(b->alpha) - as_double(a->alpha));
            if ((from < eta_M) == (to < eta_M) || !(fabs(at - alpha) < near))
                continue;
            *change += to > from ? -2 : 2;
            count++;
        }
    return count;
}

/* The line through the alpha of a transition, next to its q, has its eta_M. */
static void check_on_line(const sa_track *track, sa_sweep *sweep, const json_t *transition, double eta_M)
{
    const int digits = 25;
    sa_line_vertex v;
    mpfr_t alpha, difference;
    int rises;
    mpfr_init2(alpha, 200);
    mpfr_init2(difference, 200);
    mpfr_set_str(alpha, reference_text(transition, "alpha"), 10, MPFR_RNDN);
    double q = strtod(reference_text(transition, "q"), NULL);
    ck_assert_int_eq(sa_line_point(&v, &rises, sweep, track, SA_GIVEN_ALPHA, alpha, q, digits), CV_OK);
    ck_assert_int_eq(v.decided, CV_OK);
    mpfr_set_str(difference, reference_text(transition, "q"), 10, MPFR_RNDN);
    mpfr_sub(difference, difference, v.q, MPFR_RNDN);
    ck_assert_double_le(fabs(as_double(difference)), v.q_error + 1e-43);
    mpfr_sub_d(difference, v.eta_M, eta_M, MPFR_RNDN);
    ck_assert_double_le(fabs(as_double(difference)), 1e-20 * eta_M);
    sa_line_vertex_clear(&v);
    mpfr_clears(alpha, difference, (mpfr_ptr)0);
}

static void check_combination(const sa_lines *lines, const sa_track *track, sa_sweep *sweep,
                              const json_t *record)
{
    const json_t *list = json_object_get(record, "transitions");
    const double eta_M = strtod(reference_text(record, "eta_M"), NULL);
    const size_t expected = json_array_size(list);
    int change;
    ck_assert_msg(passages(&change, lines, eta_M, 1, INFINITY) == (int)expected,
                  "track %s, eta_p = %s, eta_M = %g: %d passages, %zu transitions",
                  reference_text(record, "track"),
                  reference_text(json_object_get(record, "parameters"), "eta_p"), eta_M,
                  passages(&change, lines, eta_M, 1, INFINITY), expected);
    int sum = 0;
    for (size_t i = 0; i < expected; i++) {
        const json_t *t = json_array_get(list, i);
        const double alpha = strtod(reference_text(t, "alpha"), NULL), near = 2e-3 * 1.98;
        sum += (int)json_integer_value(json_object_get(t, "unstable_roots_above")) -
               (int)json_integer_value(json_object_get(t, "unstable_roots_below"));
        ck_assert_int_ge(passages(&change, lines, eta_M, alpha, near), 1);
        if (i % 4 == 0)
            check_on_line(track, sweep, t, eta_M);
    }
    passages(&change, lines, eta_M, 1, INFINITY);
    ck_assert_int_eq(change, sum);
}

/* Which of the tracks of the file: all of the paper's at each damping, others where the search is short. */
static int is_wanted(const json_t *record)
{
    const json_t *p = json_object_get(record, "parameters");
    const char *track = reference_text(record, "track"), *damping = reference_text(p, "eta_p");
    return strchr("1234", track[0]) != NULL || (strcmp(track, "A") == 0 && strcmp(damping, "0.05") == 0) ||
           (strcmp(track, "A") == 0 && strcmp(reference_text(p, "eta_b"), "0.05") == 0) ||
           (strcmp(track, "C") == 0 && strcmp(damping, "0.01") == 0) ||
           (strcmp(track, "B") == 0 && strcmp(damping, "0.2") == 0);
}

/* Records of one track follow one another in the file, eta_M by eta_M. */
START_TEST(reference_transitions_lie_on_the_lines)
{
    json_t *file =
        reference_load("data/reference_transitions.json", "critvel-reference-transitions/1", "combinations");
    ck_assert(file != NULL);
    const json_t *list = json_object_get(file, "combinations"), *last = NULL;
    sa_lines lines = {0};
    sa_track *track = NULL;
    sa_sweep *sweep = sa_sweep_new();
    typed_range r;
    range_set(&r, "0.02", "2", "0.5", "2000");
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *record = json_array_get(list, i);
        const json_t *parameters = json_object_get(record, "parameters");
        if (!is_wanted(record))
            continue;
        if (last == NULL || !json_equal(last, parameters)) {
            cv_params p;
            cv_params_init(&p);
            reference_params(&p, record);
            sa_lines_clear(&lines);
            sa_track_free(track);
            find(&lines, &p, &r, 8);
            ck_assert_int_eq(sa_track_new(&track, &p, NULL), CV_OK);
            cv_params_clear(&p);
            last = parameters;
        }
        check_combination(&lines, track, sweep, record);
    }
    range_clear(&r);
    sa_lines_clear(&lines);
    sa_track_free(track);
    sa_sweep_free(sweep);
    json_decref(file);
}
END_TEST

/* ---- the hard cases by name ---- */

/* A line of case 3 at 1e-10 turns at alpha = 0.42571279325485147, eta_M = 176.4750976 (critvel-dgreen lines);
 * between its arms the winding of dgreen counts 4, before it 2: as near as doubles go. */
static void count_beside_a_fold(sa_lines *lines)
{
    const double fold = 0.42571279325485147, eta_M = 176.4750976;
    for (double beyond = 2e-16; beyond < 1e-4; beyond *= 1.5)
        for (int side = -1; side <= 1; side += 2) {
            int roots;
            ck_assert_int_eq(sa_lines_count(&roots, lines, fold + side * beyond, eta_M, NULL), CV_OK);
            ck_assert_int_eq(roots, side > 0 ? 4 : 2);
        }
}

/* Three lines pass alpha = 0.45 in case 3 at 1e-10, at eta_M near 32.2, 60.49 and 1023.86; in case 4 at alpha
 * = 0.4 one, at 231.0, on a branch between infinite masses near 0.366 and 0.413. */
START_TEST(named_places)
{
    static const struct {
        int number;
        double alpha, eta_M;
        int below, above;
    } at[] = {
        {3, 0.45, 32.15, 0, 2}, {3, 0.45, 60.49, 2, 4}, {3, 0.45, 1023.86, 4, 2}, {4, 0.4, 231.0, 0, 2}};
    sa_lines lines[2];
    find_case(&lines[0], 3, "1e-10", "1", "1e4", 12);
    count_beside_a_fold(&lines[0]);
    find_case(&lines[1], 4, "1e-10", "1", "1e4", 12);
    for (int i = 0; i < 4; i++) {
        sa_lines *l = &lines[at[i].number - 3];
        int below, above;
        ck_assert_int_eq(sa_lines_count(&below, l, at[i].alpha, 0.99 * at[i].eta_M, NULL), CV_OK);
        ck_assert_int_eq(sa_lines_count(&above, l, at[i].alpha, 1.01 * at[i].eta_M, NULL), CV_OK);
        ck_assert_int_eq(below, at[i].below);
        ck_assert_int_eq(above, at[i].above);
    }
    int found = 0;
    for (size_t i = 0; i < lines[1].count; i++) {
        const sa_branch *b = &lines[1].branch[i];
        if (b->kind != SA_LINE_INFINITE || b->start.beyond != SA_BEYOND_ASYMPTOTE ||
            b->end.beyond != SA_BEYOND_ASYMPTOTE)
            continue;
        double from = as_double(lines[1].asymptotes.item[b->start.number].alpha);
        double to = as_double(lines[1].asymptotes.item[b->end.number].alpha);
        found += fabs(from - 0.366) < 5e-4 && fabs(to - 0.413) < 5e-4;
    }
    ck_assert_int_eq(found, 1);
    sa_lines_clear(&lines[0]);
    sa_lines_clear(&lines[1]);
}
END_TEST

/* Tracks of (31) on which lines follow branch curves closely and sink far below the range before they come to
 * their asymptotes. On the first, at this velocity, a line turns less than 1e-16 before: by mpmath, 60
 * digits, its two arms are at eta_M = 2.539581114227665 and 2.539585800321528. */
START_TEST(lines_along_branch_curves)
{
    static const char *const track[][6] = {{"1.28997", "41.4038", "0.77235", "12.1394", "0", "-0.965911"},
                                           {"5.39239", "20.9475", "0.0376506", "1.34823", "2.4099", "0"}};
    static const double eta_M[] = {2.53958, 2.53958111, 2.53958112, 2.5395834572815619, 2.5395857, 2.5395859};
    static const int between[] = {0, 0, 2, 2, 2, 0};
    int base = 0;
    for (int i = 0; i < 2; i++) {
        cv_params p;
        typed_range r;
        sa_lines lines;
        cv_params_init(&p);
        set_params(&p, track[i], "1e-6");
        if (i == 0)
            set_damping(&p, "1.35e-7", "5.45e-9", "1.08e-9");
        range_set(&r, "0.02", "2", "1", "1e4");
        find(&lines, &p, &r, 20);
        for (int k = 0; i == 0 && k < 6; k++) {
            int roots;
            ck_assert_int_eq(sa_lines_count(&roots, &lines, 1.4148774978492069, eta_M[k], NULL), CV_OK);
            base = k == 0 ? roots : base;
            ck_assert_int_eq(roots, base + between[k]);
        }
        sa_lines_clear(&lines);
        range_clear(&r);
        cv_params_clear(&p);
    }
}
END_TEST

/* The paper: at very low damping one of the additional branches of figure 5 is closed. */
START_TEST(a_closed_line)
{
    sa_lines lines;
    int closed = 0;
    find_case(&lines, 4, "1e-10", "0.5", "1e10", 8);
    for (size_t i = 0; i < lines.count; i++) {
        const sa_branch *b = &lines.branch[i];
        if (b->kind != SA_LINE_CLOSED)
            continue;
        ck_assert_int_eq(b->start.kind, SA_END_CLOSED);
        ck_assert(mpfr_equal_p(b->vertex[0].alpha, b->vertex[b->count - 1].alpha));
        ck_assert(mpfr_equal_p(b->vertex[0].q, b->vertex[b->count - 1].q));
        closed++;
    }
    ck_assert_int_eq(closed, 1);
    sa_lines_clear(&lines);
}
END_TEST

/* ---- points ---- */

/* Im zeta changes its sign within the bounds, by K at any precision (kernel.h). */
static int im_sign(const sa_track *track, mpfr_srcptr alpha, mpfr_srcptr q)
{
    cv_number a, f;
    mpc_t zeta;
    cv_number_init(&a);
    cv_number_init(&f);
    mpc_init2(zeta, 64);
    mpfr_get_q(a.factor, alpha);
    mpfr_get_q(f.factor, q);
    ck_assert_int_eq(sa_zeta_digits(zeta, track, &a, &f, 3, NULL), CV_OK);
    int sign = mpfr_sgn(mpc_imagref(zeta));
    mpc_clear(zeta);
    cv_number_clear(&a);
    cv_number_clear(&f);
    return sign;
}

static void check_enclosed(const sa_track *track, const sa_line_vertex *v)
{
    int along_q = v->q_error > 0, sign[2];
    mpfr_t x;
    mpfr_init2(x, 1000);
    for (int side = 0; side < 2; side++) {
        mpfr_set_d(x, along_q ? v->q_error : v->alpha_error, MPFR_RNDN);
        mpfr_mul_si(x, x, side == 0 ? -1 : 1, MPFR_RNDN);
        mpfr_add(x, x, along_q ? v->q : v->alpha, MPFR_RNDN);
        sign[side] = along_q ? im_sign(track, v->alpha, x) : im_sign(track, x, v->q);
    }
    ck_assert_int_eq(sign[0] * sign[1], -1);
    mpfr_clear(x);
}

/* Vertices are on the line within their bounds, and have the digits. */
START_TEST(vertices_are_on_the_line)
{
    static const char *const damping[] = {"0.05", "1e-4", "1e-10"};
    const int digits = 30;
    sa_lines lines;
    sa_track *track = make_track(table1[2], damping[_i]);
    find_case(&lines, 3, damping[_i], "1", "1e4", digits);
    for (size_t i = 0; i < lines.count; i++)
        for (size_t k = 0; k < lines.branch[i].count; k += 5) {
            const sa_line_vertex *v = &lines.branch[i].vertex[k];
            ck_assert_int_eq(v->decided, CV_OK);
            ck_assert_double_le(v->alpha_error, 1e-30 * as_double(v->alpha));
            ck_assert_double_le(v->q_error, 1e-30 * as_double(v->q));
            ck_assert_double_le(v->eta_M_error, 1e-29 * as_double(v->eta_M));
            if (!(v->marks & SA_MARK_CUT))
                check_enclosed(track, v);
        }
    sa_lines_clear(&lines);
    sa_track_free(track);
}
END_TEST

/* Between two vertices the line is within 1e-3 of their chord; points given by alpha half-way, where alpha
 * does not turn. */
START_TEST(chords_are_near_the_line)
{
    sa_lines lines;
    sa_track *track = make_track(table1[0], "0.05");
    sa_sweep *sweep = sa_sweep_new();
    size_t vertices = 0;
    find_case(&lines, 1, "0.05", "1", "1e4", 12);
    for (size_t i = 0; i < lines.count; i++) {
        vertices += lines.branch[i].count;
        for (size_t k = 0; k + 1 < lines.branch[i].count; k++) {
            const sa_line_vertex *a = &lines.branch[i].vertex[k], *b = a + 1;
            for (int part = 1; part < 4; part++) {
                double x = part / 4.0, q = as_double(a->q) + x * (as_double(b->q) - as_double(a->q));
                sa_line_vertex v;
                mpfr_t given;
                int rises;
                mpfr_init_set_d(given, as_double(a->alpha) + x * (as_double(b->alpha) - as_double(a->alpha)),
                                MPFR_RNDN);
                ck_assert_int_eq(sa_line_point(&v, &rises, sweep, track, SA_GIVEN_ALPHA, given, q, 10),
                                 CV_OK);
                double chord = log(as_double(a->eta_M)) + x * log(as_double(b->eta_M) / as_double(a->eta_M));
                double up = (log(as_double(v.eta_M)) - chord) / log(1e4);
                double slope = log(as_double(b->eta_M) / as_double(a->eta_M)) / log(1e4) /
                               ((as_double(b->alpha) - as_double(a->alpha)) / 1.98);
                ck_assert_double_le(fabs(up) / hypot(1, slope), 1e-3);
                sa_line_vertex_clear(&v);
                mpfr_clear(given);
            }
        }
    }
    ck_assert_uint_le(vertices, 100);
    sa_lines_clear(&lines);
    sa_sweep_free(sweep);
    sa_track_free(track);
}
END_TEST

/* ---- the number of unstable roots ---- */

/* By the lines and by the crossings at each velocity (transitions.h), which know nothing of the lines. */
START_TEST(counts_agree_with_the_crossings)
{
    static const char *const damping[] = {"0.05", "1e-4", "1e-10"};
    gsl_rng *rng = random_start("counts", 7 + (unsigned long)_i);
    sa_lines lines;
    sa_boundary *boundary;
    cv_params p;
    typed_range r;
    int decided = 0;
    cv_params_init(&p);
    set_params(&p, table1[3 - _i % 2], damping[_i]);
    range_set(&r, "0.02", "2", "1", "1e4");
    find(&lines, &p, &r, 8);
    ck_assert_int_eq(sa_boundary_new(&boundary, &p, &r.end[0], &r.end[1], NULL), CV_OK);
    for (int i = 0; i < 60; i++) {
        cv_number mass;
        double alpha = log_uniform(rng, 0.05, 1.9), eta_M = log_uniform(rng, 0.1, 3e4);
        int by_lines, by_crossings;
        if (i % 2) { /* next to a line */
            const sa_branch *b = &lines.branch[gsl_rng_uniform_int(rng, lines.count)];
            const sa_line_vertex *v = &b->vertex[gsl_rng_uniform_int(rng, b->count)];
            alpha = as_double(v->alpha) * (1 + log_uniform(rng, 1e-9, 1e-2));
            eta_M = as_double(v->eta_M) * (1 + log_uniform(rng, 1e-3, 0.3));
        }
        if (i % 12 == 0) /* the ends of the range belong to it */
            alpha = i % 24 ? 2 : 0.02;
        if (!(alpha <= 2))
            continue;
        cv_number_init(&mass);
        mpq_set_d(mass.factor, eta_M);
        if (sa_lines_count(&by_lines, &lines, alpha, eta_M, NULL) == CV_OK &&
            sa_boundary_unstable_roots(&by_crossings, boundary, alpha, 1, &mass, NULL) == CV_OK) {
            ck_assert_msg(by_lines == by_crossings,
                          "alpha = %.17g, eta_M = %.17g: %d by lines, %d by crossings", alpha, eta_M,
                          by_lines, by_crossings);
            decided++;
        }
        cv_number_clear(&mass);
    }
    ck_assert_int_ge(decided, 50);
    sa_boundary_free(boundary);
    sa_lines_clear(&lines);
    range_clear(&r);
    cv_params_clear(&p);
    gsl_rng_free(rng);
}
END_TEST

/* ---- wrong input ---- */

START_TEST(wrong_input_is_refused)
{
    static const char *const ranges[][4] = {{"0", "2", "1", "10"},       {"2", "0.02", "1", "10"},
                                            {"0.02", "2", "0", "10"},    {"0.02", "2", "10", "10"},
                                            {"0.02", "2", "1e-11", "1"}, {"0.02", "2", "1", "1e11"}};
    cv_params p;
    sa_lines lines;
    cv_message why;
    cv_params_init(&p);
    set_params(&p, table1[0], "0.1");
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        typed_range r;
        range_set(&r, ranges[i][0], ranges[i][1], ranges[i][2], ranges[i][3]);
        ck_assert_int_eq(sa_lines_find(&lines, &p, &r.range, 10, &why), CV_BAD_INPUT);
        range_clear(&r);
    }
    cv_params_clear(&p);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("semianalytic lines");
    TCase *t = tcase_create("lines");
    tcase_set_timeout(t, 60);
    tcase_add_test(t, wrong_input_is_refused);
    tcase_add_test(t, named_places);
    tcase_add_test(t, lines_along_branch_curves);
    tcase_add_test(t, a_closed_line);
    tcase_add_loop_test(t, vertices_are_on_the_line, 0, 3);
    tcase_add_test(t, chords_are_near_the_line);
    tcase_add_loop_test(t, counts_agree_with_the_crossings, 0, 3);
    tcase_add_test(t, reference_transitions_lie_on_the_lines);
    suite_add_tcase(s, t);
    SRunner *runner = srunner_create(s);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
