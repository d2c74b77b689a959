/* Branch points against the operator Delta itself and against counts of its real roots. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/branch_points.h"
#include "dgreen/branch_points_curves.h"
#include "dgreen/branch_points_hunt.h"
#include "dgreen/branch_points_wave.h"
#include "dgreen/roots.h"
#include "dgreen/z.h"
#include "tests/dgreen_points.h"

enum { TRACKS = 30, MAX_POINTS = 256 };

/* The same track without damping */
static dg_track *undamped(const dg_track *t)
{
    cv_params p;
    dg_track *out = NULL;
    cv_params_init(&p);
    cv_params_set(&p, &t->exact);
    set_decimal(&p.eta_p, 0);
    set_decimal(&p.eta_b, 0);
    set_decimal(&p.eta_f, 0);
    if (dg_track_new(&out, &p, NULL) != CV_OK)
        abort();
    cv_params_clear(&p);
    return out;
}

/* Delta(i p) and its derivative in p at real p, q, both relative to the sums of their terms' moduli */
static void relative_delta(double *value, double *slope, const dg_track *t, double alpha, double q, double p)
{
    dg_operator op;
    dg_operator_set(&op, t, alpha, CMPLX(0, q));
    double f = 0, g = 0, size = 0, slope_size = 0;
    for (int k = op.degree; k >= 0; k--) {
        g = g * p + f;
        slope_size = slope_size * fabs(p) + size;
        f = f * p + op.re[k];
        size = size * fabs(p) + op.size[k];
    }
    *value = fabs(f) / size;
    *slope = fabs(g) / slope_size;
}

/* The three frequencies are the roots of a cubic: Vieta gives their sum and, at p = 0, nothing moves. */
START_TEST(waves_solve_the_cubic)
{
    gsl_rng *rng = random_start("test_dgreen_branch_points", 20240501);
    for (int i = 0; i < TRACKS; i++) {
        dg_track *t = random_damped_track(rng);
        for (int j = 0; j < 10; j++) {
            const double p = log_uniform(rng, 1e-3, 50), Y = p * p;
            double sum = 0, before = 0, value, slope;
            dg_track *calm = undamped(t);
            for (int k = 0; k < DG_WAVE_BRANCHES; k++) {
                dg_wave w;
                dg_wave_at(&w, t, p, k);
                ck_assert(w.omega > before);
                before = w.omega;
                sum += w.omega * w.omega;
                relative_delta(&value, &slope, calm, 0.3, 0.3 * p - w.omega, p);
                ck_assert(value < 1e-13);
            }
            const double rail = Y * Y / 4 - t->eta_N * Y + t->kappa_p;
            const double trace =
                rail + (t->kappa_p + t->kappa_b) / t->mu_s + (t->kappa_b + 1 + t->eta_s * Y) / t->mu_b;
            ck_assert(fabs(sum - trace) <= 1e-13 * trace);
            dg_track_free(calm);
        }
        dg_track_free(t);
    }
    gsl_rng_free(rng);
}
END_TEST

START_TEST(derivatives_are_differences)
{
    gsl_rng *rng = random_start("test_dgreen_branch_points", 20240502);
    for (int i = 0; i < TRACKS; i++) {
        dg_track *t = random_damped_track(rng);
        for (int k = 0; k < DG_WAVE_BRANCHES; k++) {
            const double p = log_uniform(rng, 0.05, 10), h = 1e-4 * p;
            dg_wave w, below, above;
            dg_wave_at(&w, t, p, k);
            dg_wave_at(&below, t, p - h, k);
            dg_wave_at(&above, t, p + h, k);
            const double room = 1e-9 * w.omega / h + 1e-2 * fabs(above.group - below.group);
            ck_assert(fabs(w.group - (above.omega - below.omega) / (2 * h)) <= room);
            const double group_size = fmax(fabs(w.group), p);
            ck_assert(fabs(w.curvature - (above.group - below.group) / (2 * h)) <=
                      1e-7 * group_size / h + 0.05 * fabs(above.curvature - below.curvature));
        }
        dg_track_free(t);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Every branch point is a double real root of the undamped Delta. */
START_TEST(branch_points_are_double_roots)
{
    gsl_rng *rng = random_start("test_dgreen_branch_points", 20240503);
    int seen = 0;
    for (int i = 0; i < TRACKS; i++) {
        dg_track *t = random_damped_track(rng), *calm = undamped(t);
        dg_branch_curves *b;
        dg_branch_point points[MAX_POINTS];
        ck_assert_int_eq(dg_branch_curves_new(&b, t, 0.02, 2, NULL), CV_OK);
        ck_assert(dg_branch_points_max(b) <= MAX_POINTS);
        for (int j = 0; j < 20; j++) {
            const double alpha = log_uniform(rng, 0.02, 2);
            const size_t n = dg_branch_points_at(points, b, alpha);
            for (size_t k = 0; k < n; k++) {
                double value, slope;
                ck_assert(points[k].q >= 0 && points[k].width > 0 &&
                          (k == 0 || points[k].q >= points[k - 1].q));
                if (points[k].soft)
                    continue;
                relative_delta(&value, &slope, calm, alpha, points[k].signed_q, points[k].p);
                ck_assert(value < 1e-13 && slope < 1e-9);
                seen++;
            }
        }
        dg_branch_curves_free(b);
        dg_track_free(calm);
        dg_track_free(t);
    }
    ck_assert(seen > TRACKS * 20);
    gsl_rng_free(rng);
}
END_TEST

/* Number of real roots p of the undamped Delta; -1 when one cannot be told from a complex pair. */
static int real_roots(const dg_track *calm, double alpha, double q)
{
    dg_operator op;
    dg_roots r;
    int n = 0;
    dg_operator_set(&op, calm, alpha, CMPLX(0, q));
    if (dg_roots_cold(&r, &op) != CV_OK || dg_roots_polish_cold(&r, &op) != CV_OK)
        return -1;
    for (int i = 0; i < r.count; i++) {
        const double part = fabs(r.im[i]) / hypot(r.re[i], r.im[i]);
        if (part > 1e-10 && part < 1e-4)
            return -1;
        n += part <= 1e-10;
    }
    return n;
}

/* Completeness: as q grows the number of real roots changes at branch points, and there by two. Not close to
 * the shear wave speed, where waves too short to matter have branch points, too. */
START_TEST(real_roots_change_at_branch_points_only)
{
    gsl_rng *rng = random_start("test_dgreen_branch_points", 20240504);
    int compared = 0;
    for (int i = 0; i < TRACKS; i++) {
        dg_track *t = random_damped_track(rng), *calm = undamped(t);
        dg_branch_curves *b;
        dg_branch_point points[MAX_POINTS];
        ck_assert_int_eq(dg_branch_curves_new(&b, t, 0.02, 2, NULL), CV_OK);
        for (int j = 0; j < 20; j++) {
            const double alpha = log_uniform(rng, 0.02, 2);
            if (fabs(alpha * sqrt(t->mu_b / fmax(t->eta_s, 1e-9)) - 1) < 0.5)
                continue;
            const size_t n = dg_branch_points_at(points, b, alpha);
            double from = log_uniform(rng, 1e-3, 10);
            for (int step = 0; step < 12; step++, from *= 1.5) {
                const double to = 1.5 * from;
                const int before = real_roots(calm, alpha, from), after = real_roots(calm, alpha, to);
                int between = 0;
                for (size_t k = 0; k < n; k++)
                    between += !points[k].soft && points[k].q > from && points[k].q < to;
                if (before < 0 || after < 0)
                    continue;
                compared++;
                ck_assert_msg(abs(after - before) <= 2 * between && (after - before) % 2 == 0 &&
                                  (between - abs(after - before) / 2) % 2 == 0,
                              "alpha %.17g, q %g to %g: %d real roots, then %d, %d branch points between",
                              alpha, from, to, before, after, between);
            }
        }
        dg_branch_curves_free(b);
        dg_track_free(calm);
        dg_track_free(t);
    }
    ck_assert(compared > 1000);
    gsl_rng_free(rng);
}
END_TEST

/* Velocities where two branch points meet, one is at q = 0, or their number changes */
START_TEST(special_velocities_are_special)
{
    gsl_rng *rng = random_start("test_dgreen_branch_points", 20240505);
    for (int i = 0; i < TRACKS; i++) {
        dg_track *t = random_damped_track(rng);
        dg_branch_curves *b;
        dg_branch_point points[MAX_POINTS];
        size_t count;
        ck_assert_int_eq(dg_branch_curves_new(&b, t, 0.02, 2, NULL), CV_OK);
        const dg_special_velocity *special = dg_special_velocities(&count, b);
        const double drop = sqrt(t->eta_s / t->mu_b);
        for (size_t k = 0; k < count; k++) {
            const double alpha = special[k].alpha;
            int hard[2] = {0, 0}, found = fabs(alpha - drop) <= 1e-12 * alpha;
            for (int side = 0; side < 2; side++) {
                const size_t n = dg_branch_points_at(points, b, alpha * (1 + (2 * side - 1) * 1e-9));
                for (size_t m = 0; m < n; m++)
                    hard[side] += !points[m].soft;
            }
            const size_t n = dg_branch_points_at(points, b, alpha);
            for (size_t m = 0; m < n; m++) {
                found |= !points[m].soft && points[m].q < 1e-11;
                for (size_t l = 0; l < m; l++)
                    found |= !points[m].soft && !points[l].soft &&
                             points[m].q - points[l].q < 1e-13 * (10 + fabs(points[m].p) + fabs(points[l].p));
            }
            ck_assert_msg(found || hard[0] != hard[1], "nothing special at alpha = %.17g", alpha);
        }
        dg_branch_curves_free(b);
        dg_track_free(t);
    }
    gsl_rng_free(rng);
}
END_TEST

/* The hard branch points at alpha: curve and side of each, in the order of q. */
typedef struct {
    size_t count;
    int name[MAX_POINTS];
    double p[MAX_POINTS];
} pattern;

static void read_pattern(pattern *out, const dg_branch_curves *b, double alpha)
{
    dg_branch_point points[MAX_POINTS];
    const size_t n = dg_branch_points_at(points, b, alpha);
    out->count = 0;
    for (size_t k = 0; k < n; k++)
        if (!points[k].soft) {
            out->p[out->count] = fabs(points[k].p);
            out->name[out->count++] = 2 * points[k].curve + (points[k].signed_q > 0);
        }
}

/* The names of a that b has as well, and those it has not; waves so short that they carry nothing (the tables
 * end somewhere on the way to the shear wave speed) may come and go. */
static size_t names(int *out, const pattern *a, const pattern *b)
{
    static const double SHORT = 100;
    size_t n = 0;
    for (size_t k = 0; k < a->count; k++) {
        int shared = 0;
        for (size_t l = 0; l < b->count; l++)
            shared |= a->name[k] == b->name[l];
        if (shared || a->p[k] < SHORT)
            out[n++] = a->name[k];
    }
    return n;
}

static int same_pattern(const pattern *a, const pattern *b)
{
    int one[MAX_POINTS], other[MAX_POINTS];
    const size_t n = names(one, a, b), m = names(other, b, a);
    return n == m && memcmp(one, other, n * sizeof *one) == 0;
}

/* ... and none is missing: order and number of the branch points stay the same between them. */
START_TEST(nothing_happens_between_special_velocities)
{
    gsl_rng *rng = random_start("test_dgreen_branch_points", 20240506);
    for (int i = 0; i < TRACKS; i++) {
        dg_track *t = random_damped_track(rng);
        dg_branch_curves *b;
        size_t count, next = 0;
        ck_assert_int_eq(dg_branch_curves_new(&b, t, 0.02, 2, NULL), CV_OK);
        const dg_special_velocity *special = dg_special_velocities(&count, b);
        pattern patterns[2];
        read_pattern(&patterns[0], b, 0.02);
        int latest = 0;
        for (double alpha = 0.0201; alpha < 2; alpha *= 1.003, latest = 1 - latest) {
            const size_t before = next;
            read_pattern(&patterns[1 - latest], b, alpha);
            while (next < count && special[next].alpha < alpha)
                next++;
            ck_assert_msg(next > before || same_pattern(&patterns[0], &patterns[1]),
                          "branch points change before alpha = %.17g", alpha);
        }
        dg_branch_curves_free(b);
        dg_track_free(t);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Resonance velocities of cases 3 and 4 as the paper prints them (section 5), 0.449 corrected to 0.444855. */
START_TEST(printed_resonances)
{
    const char *text[2] = {"6 5 0.03 3 1e-10 1e-10 1e-10 0 0", "3 10 0.03 0.1 1e-10 1e-10 1e-10 0 0"};
    const double printed[2][3] = {{0.444855, 0.745475, 0.750040}, {0.437, 0.442, 0.456}};
    const double room[2] = {1e-6, 6e-4};
    for (int i = 0; i < 2; i++) {
        dg_track *t = track_of(text[i]);
        dg_branch_curves *b;
        dg_branch_point points[MAX_POINTS];
        size_t count;
        int found = 0;
        ck_assert_int_eq(dg_branch_curves_new(&b, t, 0.02, 2, NULL), CV_OK);
        const dg_special_velocity *special = dg_special_velocities(&count, b);
        for (size_t k = 0; k < count; k++) {
            const size_t n = dg_branch_points_at(points, b, special[k].alpha);
            for (size_t m = 0; m < n; m++)
                if (!points[m].soft && points[m].q < 1e-12)
                    for (int j = 0; j < 3; j++)
                        found |= (fabs(special[k].alpha - printed[i][j]) < room[i]) << j;
        }
        ck_assert_int_eq(found, 7);
        dg_branch_curves_free(b);
        dg_track_free(t);
    }
}
END_TEST

static cv_status narrow_parabola(dg_sample *s, void *context)
{
    const double *p = context; /* (x - p0)^2 - p1 */
    s->value = (s->at - p[0]) * (s->at - p[0]) - p[1];
    s->slope = 2 * (s->at - p[0]);
    return CV_OK;
}

static int zeros_found;

static cv_status count_zero(const dg_sample *low, const dg_sample *high, void *context)
{
    (void)context;
    ck_assert((low->value >= 0) != (high->value >= 0));
    zeros_found++;
    return CV_OK;
}

/* Two zeros 2e-7 apart in an interval of length 1, and none where the parabola stays above zero by 1e-14 */
START_TEST(hunt_finds_close_pairs)
{
    double parabola[2] = {0.3, 1e-14};
    const dg_hunter h = {narrow_parabola, count_zero, parabola};
    for (int sign = 1; sign >= -1; sign -= 2) {
        parabola[1] = sign * 1e-14;
        dg_sample low = {.at = 0}, high = {.at = 1};
        narrow_parabola(&low, parabola);
        narrow_parabola(&high, parabola);
        zeros_found = 0;
        ck_assert_int_eq(dg_hunt_zeros(&h, &low, &high), CV_OK);
        ck_assert_int_eq(zeros_found, sign > 0 ? 2 : 0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen branch points");
    TCase *c = tcase_create("branch points");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, waves_solve_the_cubic);
    tcase_add_test(c, derivatives_are_differences);
    tcase_add_test(c, branch_points_are_double_roots);
    tcase_add_test(c, real_roots_change_at_branch_points_only);
    tcase_add_test(c, special_velocities_are_special);
    tcase_add_test(c, nothing_happens_between_special_velocities);
    tcase_add_test(c, printed_resonances);
    tcase_add_test(c, hunt_finds_close_pairs);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
