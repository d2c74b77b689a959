/* Instability lines without damping, complete with their vertical parts: lines at small damping come to them
 * everywhere and they to these, the roots beside them are those that are counted without lines, and all ends
 * are at infinite mass or at an end of the range. */
#include <check.h>
#include <math.h>

#include "dgreen/count.h"
#include "semianalytic/limit_meeting.h"
#include "semianalytic/lines_parts.h"
#include "semianalytic/transitions.h"
#include "tests/semianalytic_points.h"

enum { RANGE = 4 };
static const char *const range_text[RANGE] = {"0.1", "1.8", "1", "10000"};
static const double alpha_min = 0.1, alpha_max = 1.8;

static void find(sa_lines *out, const cv_params *params)
{
    cv_number number[RANGE];
    for (int i = 0; i < RANGE; i++) {
        cv_number_init(&number[i]);
        set_text(&number[i], range_text[i]);
    }
    const sa_lines_range range = {&number[0], &number[1], &number[2], &number[3]};
    ck_assert_int_eq(sa_lines_find(out, params, &range, 12, NULL), CV_OK);
    for (int i = 0; i < RANGE; i++)
        cv_number_clear(&number[i]);
}

static void find_case(sa_lines *out, int c, const char *damping)
{
    cv_params p;
    cv_params_init(&p);
    set_params(&p, table1[c], damping);
    find(out, &p);
    ck_assert_msg(out->decided == CV_OK, "case %d at %s: %s", c + 1, damping, out->reason.text);
    cv_params_clear(&p);
}

/* A place in a plot that has zero and infinite mass at its edges. */
typedef struct {
    double x, y;
} place;

static place place_of(const sa_line_sample *s)
{
    const double middle_mass = 10;
    double re = fmax(s->re, 0);
    return (place){s->alpha / (alpha_max - alpha_min), isinf(re) ? 0 : 1 / (1 + middle_mass * re)};
}

static double to_chord(place p, place a, place b)
{
    double x = b.x - a.x, y = b.y - a.y, length2 = x * x + y * y;
    double along = length2 > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / length2 : 0;
    along = fmin(fmax(along, 0), 1);
    return hypot(p.x - a.x - along * x, p.y - a.y - along * y);
}

static double to_lines(place p, const sa_lines *lines)
{
    const sa_line_store *s = lines->store;
    double distance = INFINITY;
    for (size_t i = 0; i < s->line_count; i++)
        for (size_t k = 0; k + 1 < s->line[i].count + (size_t)s->line[i].closed; k++) {
            const sa_line_sample *first = &s->samples.item[s->line[i].first];
            place a = place_of(&first[k]), b = place_of(&first[(k + 1) % s->line[i].count]);
            distance = fmin(distance, to_chord(p, a, b));
        }
    return distance;
}

/* The largest distance of a point of the lines from the others. Not above the range of eta_M: where all eight
 * poles of an undamped track are waves Re zeta = 0, and a line of damped ones is at 1 / damping. */
static double farthest(const sa_lines *lines, const sa_lines *others)
{
    enum { STEPS = 8 };
    const sa_line_store *s = lines->store;
    double distance = 0;
    for (size_t i = 0; i < s->line_count; i++)
        for (size_t k = 0; k + 1 < s->line[i].count; k++) {
            const sa_line_sample *first = &s->samples.item[s->line[i].first];
            place a = place_of(&first[k]), b = place_of(&first[k + 1]);
            int steps = fabs(b.y - a.y) > 0.05 ? STEPS : 1;
            for (int m = 0; m <= steps; m++) {
                double x = (double)m / steps;
                if (fmin(first[k].re, first[k + 1].re) < 1e-4)
                    continue;
                place p = {a.x + x * (b.x - a.x), a.y + x * (b.y - a.y)};
                distance = fmax(distance, to_lines(p, others));
            }
        }
    return distance;
}

/* Both ways, at the lower damping more nearly, and as many lines. They come to a resonance velocity in orders
 * of the damping of 2/11 and 1/7 only (limit_meeting.h), and to zero mass where waves hardly move the rail,
 * as in case 1 at 0.1547, in lower ones. */
static void check_approach(int c, const sa_lines *limit, const sa_lines damped[2])
{
    const double chord = 5e-4; /* of the polylines */
    double there[2], back[2];
    for (int i = 0; i < 2; i++) {
        there[i] = farthest(&damped[i], limit);
        back[i] = farthest(limit, &damped[i]);
    }
    printf("case %d: damped from limit %.2g %.2g, limit from damped %.2g %.2g\n", c + 1, there[0], there[1],
           back[0], back[1]);
    ck_assert(there[1] < fmax(0.8 * there[0], chord) && there[1] < 0.05);
    ck_assert(back[1] < fmax(0.9 * back[0], chord) && back[1] < 0.25);
    ck_assert_uint_eq(limit->line_count, damped[1].line_count);
}

static void check_ends(const sa_lines *lines)
{
    for (size_t i = 0; i < lines->count; i++) {
        const sa_branch *b = &lines->branch[i];
        const sa_line_end *end[2] = {&b->start, &b->end};
        ck_assert_int_ne(b->kind, SA_LINE_UNDECIDED);
        for (int k = 0; k < 2; k++) {
            const sa_branch *next = &lines->branch[end[k]->number];
            ck_assert(end[k]->kind != SA_END_UNDECIDED && end[k]->kind < SA_END_CURVE);
            if (end[k]->kind == SA_END_CLOSED || end[k]->kind <= SA_END_ALPHA_HIGH)
                continue;
            ck_assert_int_ne(end[k]->beyond, SA_BEYOND_NOTHING);
            if (end[k]->beyond == SA_BEYOND_BRANCH)
                ck_assert(next->line == b->line && (k == 0 ? next->end.number : next->start.number) == i);
        }
        ck_assert(b->counted != CV_OK || b->roots_left == b->roots_right + 2);
        ck_assert_int_ge(b->roots_right, 0);
    }
}

/* On vertical parts alpha is a special velocity; at q = 0 a resonance velocity. */
static void check_vertical(const sa_lines *lines)
{
    const sa_branch_curves *curves = &lines->store->map.curves;
    for (size_t i = 0; i < lines->count; i++)
        for (size_t k = 0; k < lines->branch[i].count; k++) {
            const sa_line_vertex *v = &lines->branch[i].vertex[k];
            double alpha = mpfr_get_d(v->alpha, MPFR_RNDN), q = mpfr_get_d(v->q, MPFR_RNDN);
            int found = !(v->marks & SA_MARK_VERTICAL);
            for (size_t n = 0; n < curves->special_count; n++)
                found |=
                    fabs(curves->special[n].alpha - alpha) < 1e-14 && fabs(curves->special[n].q - q) < 1e-14;
            ck_assert(found);
        }
}

/* N by the lines passed is N by the crossings of the real axis at alpha, which know nothing of lines; returns
 * how many points were undecided. */
static int compare_counts(const cv_params *params, sa_lines *lines, int points, gsl_rng *rng)
{
    sa_boundary *boundary;
    cv_number low, high;
    int undecided = 0;
    cv_number_init(&low);
    cv_number_init(&high);
    set_text(&low, range_text[0]);
    set_text(&high, range_text[1]);
    ck_assert_int_eq(sa_boundary_new(&boundary, params, &low, &high, NULL), CV_OK);
    for (int i = 0; i < points; i++) {
        double alpha = alpha_min + (alpha_max - alpha_min) * gsl_rng_uniform(rng);
        int by_lines, counted;
        cv_number mass;
        cv_number_init(&mass);
        set_decimal(&mass, log_uniform(rng, 1, 1e4));
        cv_status status = sa_lines_count(&by_lines, lines, alpha, cv_number_get_double(&mass), NULL);
        if (status == CV_OK)
            status = sa_boundary_unstable_roots(&counted, boundary, alpha, 1, &mass, NULL);
        if (status == CV_OK)
            ck_assert_msg(by_lines == counted, "alpha %.15g eta_M %.15g: %d by lines, %d", alpha,
                          cv_number_get_double(&mass), by_lines, counted);
        undecided += status != CV_OK;
        cv_number_clear(&mass);
    }
    sa_boundary_free(boundary);
    cv_number_clear(&low);
    cv_number_clear(&high);
    return undecided;
}

/* Away from both sets of lines, N at small damping, by dgreen's winding, is N without damping by the lines.
 * Returns how many points were compared. */
static int compare_small(const cv_params *params, sa_lines *limit, const sa_lines *damped, int points,
                         gsl_rng *rng)
{
    const double away = 0.04;
    dg_counter *counter;
    int compared = 0;
    ck_assert_int_eq(dg_counter_new(&counter, params, alpha_min, alpha_max, NULL), CV_OK);
    for (int i = 0; i < points; i++) {
        sa_line_sample s = {.alpha = alpha_min + (alpha_max - alpha_min) * gsl_rng_uniform(rng)};
        double eta_M = log_uniform(rng, 1, 1e4);
        int roots, by_lines;
        size_t failed;
        s.re = 1 / eta_M;
        if (to_lines(place_of(&s), limit) < away || to_lines(place_of(&s), damped) < away)
            continue;
        cv_number mass;
        cv_number_init(&mass);
        set_decimal(&mass, eta_M);
        if (sa_lines_count(&by_lines, limit, s.alpha, eta_M, NULL) == CV_OK &&
            dg_count_unstable(&roots, &failed, counter, s.alpha, 1, &mass, NULL) == CV_OK) {
            ck_assert_msg(roots == by_lines, "alpha %.15g, eta_M %.15g: %d, %d", s.alpha, eta_M, roots,
                          by_lines);
            compared++;
        }
        cv_number_clear(&mass);
    }
    dg_counter_free(counter);
    return compared;
}

/* N between two vertical parts at one velocity is that of a strip at small damping, somewhere near. */
static void check_strips(const sa_lines *limit, sa_lines *damped)
{
    const double mass = 100, steps = 1.5;
    for (size_t i = 0; i < limit->count; i++) {
        const sa_branch *b = &limit->branch[i];
        double alpha = mpfr_get_d(b->vertex[0].alpha, MPFR_RNDN);
        int below = (b->vertex[0].marks & SA_MARK_BELOW) != 0, found = 0;
        int up = mpfr_less_p(b->vertex[0].eta_M, b->vertex[b->count - 1].eta_M);
        int twice = 0, between = up == below ? b->roots_right : b->roots_left;
        for (size_t k = 0; k < limit->count; k++)
            twice += mpfr_equal_p(limit->branch[k].vertex[0].alpha, b->vertex[0].alpha) != 0;
        if (!(b->vertex[0].marks & SA_MARK_VERTICAL) || twice != 2)
            continue;
        for (double d = 1e-13; d < 0.1 && !found; d *= steps)
            for (int side = -1; side <= 1; side += 2) {
                int roots;
                if (sa_lines_count(&roots, damped, alpha * (1 + side * d), mass, NULL) == CV_OK)
                    found |= roots == between;
            }
        ck_assert_msg(found, "alpha %.15g: %d between", alpha, between);
    }
}

START_TEST(cases_of_the_paper)
{
    enum { POINTS = 40 };
    gsl_rng *rng = random_start("paper", 20231126);
    cv_params p[2];
    sa_lines limit, damped[2];
    for (int i = 0; i < 2; i++)
        cv_params_init(&p[i]);
    set_params(&p[0], table1[_i], "0");
    set_params(&p[1], table1[_i], "1e-10");
    find_case(&limit, _i, "0");
    find_case(&damped[0], _i, "1e-7");
    find_case(&damped[1], _i, "1e-10");
    check_approach(_i, &limit, damped);
    check_ends(&limit);
    check_vertical(&limit);
    check_strips(&limit, &damped[1]);
    for (size_t i = 0; i < limit.count; i++)
        ck_assert_int_eq(limit.branch[i].counted, CV_OK);
    ck_assert_int_le(compare_counts(&p[0], &limit, POINTS, rng), POINTS / 20);
    ck_assert_int_ge(compare_small(&p[1], &limit, &damped[1], POINTS, rng), POINTS / 2);
    sa_lines_clear(&limit);
    for (int i = 0; i < 2; i++) {
        sa_lines_clear(&damped[i]);
        cv_params_clear(&p[i]);
    }
    gsl_rng_free(rng);
}
END_TEST

enum { TRACKS = 4 };

/* Zhai's track of data/track.ini, whose only line is the vertical one and what goes on from there at zero
 * mass; one whose lines run to the shear speed along a branch curve, at zero and at finite mass; two random
 * ones of (31), with axial force of either sign. */
START_TEST(other_tracks)
{
    static const char *const track[TRACKS][6] = {
        {"3.7975", "16.0793", "0.838748", "1.777426", "0.696109", "0"},
        {"5.39309", "44.5051", "0.189418", "0.440042", "16.2703", "0"},
        {"3.12555", "23.7948", "10.0625", "6.73669", "0", "0.280985"},
        {"2.52306", "26.84", "0.0429986", "1.08296", "0.605177", "-0.138479"}};
    static const size_t vertical_parts[TRACKS] = {1, 3, 0, 0}; /* 0: not told beforehand */
    gsl_rng *rng = random_start("shear", 5);
    cv_params p;
    sa_lines lines;
    size_t n = 0;
    cv_params_init(&p);
    set_params(&p, track[_i], "0");
    find(&lines, &p);
    ck_assert_msg(lines.decided == CV_OK, "%s", lines.reason.text);
    check_ends(&lines);
    check_vertical(&lines);
    for (size_t k = 0; k < lines.count; k++)
        n += (lines.branch[k].vertex[0].marks & SA_MARK_VERTICAL) != 0;
    ck_assert(vertical_parts[_i] == 0 || n == vertical_parts[_i]);
    ck_assert_int_le(compare_counts(&p, &lines, 10, rng), 1);
    sa_lines_clear(&lines);
    cv_params_clear(&p);
    gsl_rng_free(rng);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic lines without damping");
    TCase *tests = tcase_create("limit");
    tcase_add_loop_test(tests, cases_of_the_paper, 0, 4);
    tcase_add_loop_test(tests, other_tracks, 0, TRACKS);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
