/* The undamped steady state put back into the equations of motion and the conditions at the force, and its
 * extremes over the rail and over alpha against brute force and the values of section 5 of the paper. */
#include <check.h>
#include <gsl/gsl_errno.h>
#include <math.h>

#include "semianalytic/pseudocritical.h"
#include "semianalytic/resonances.h"
#include "tests/random_track.h"

static const double paper_case[4][6] = {
    {6, 35, 300, 7, 0, 0}, {6, 35, 30, 7, 0, 0}, {6, 5, 0.03, 3, 0, 0}, {3, 10, 0.03, 0.1, 0, 0}};

static void choose(cv_params *params, gsl_rng *rng, int track)
{
    if (track < 4) {
        set_track(params, paper_case[track]);
    } else {
        random_track(params, rng);
    }
}

/* The equations of motion (1) in the moving frame, steady and undamped, for one exponential: x = p^2, a =
 * alpha^2. */
static void equations_hold(const sa_dispersion *d, const sa_undamped *s)
{
    long double a = s->alpha * s->alpha;

    for (int j = 0; j < s->count; j++) {
        const complex long double *w = s->pole[j].weight;
        complex long double x = s->pole[j].p * s->pole[j].p;
        complex long double rail = x * x / 4 - (d->eta_N + a) * x;
        complex long double row[3] = {
            rail * w[0] + d->kappa_p * (w[0] - w[1]),
            -d->mu_s * a * x * w[1] - d->kappa_p * (w[0] - w[1]) + d->kappa_b * (w[1] - w[2]),
            (1 + d->eta_s * x - d->mu_b * a * x) * w[2] - d->kappa_b * (w[1] - w[2])};
        long double size =
            (cabsl(x * x) + fabsl(d->eta_N) * cabsl(x) + (1 + d->mu_s + d->mu_b) * a * cabsl(x) +
             d->eta_s * cabsl(x) + d->kappa_p + d->kappa_b + 1) *
            (cabsl(w[0]) + cabsl(w[1]) + cabsl(w[2]));
        for (int i = 0; i < 3; i++) {
            ck_assert_msg(cabsl(row[i]) <= 1e-12L * size, "alpha %Lg, row %d: %Lg of %Lg", s->alpha, i,
                          cabsl(row[i]), size);
        }
    }
}

/* d^n field / dxi^n at xi = 0 on one side, and the sum of the magnitudes */
static long double at_force(const sa_undamped *s, int field, int ahead, int n, long double *size)
{
    complex long double sum = 0;

    for (int j = 0; j < s->count; j++) {
        const sa_undamped_pole *pole = &s->pole[j];
        if (pole->kind != (ahead ? SA_WAVE_BEHIND : SA_WAVE_AHEAD)) {
            complex long double ip = (ahead ? 1 : -1) * pole->p * (complex long double)_Complex_I;
            complex long double term = pole->weight[field] * cpowl(ip, n);
            sum += term;
            *size += cabsl(term);
        }
    }
    return creall(sum);
}

/* (1/4) w'''' is the highest derivative and the force is 2 delta(xi): w''' jumps by 8; w, w', w'' are
 * continuous, and so are u and u' of the sleepers and of the ballast, whose equations are of second order. */
static void force_is_carried(const sa_undamped *s)
{
    for (int field = 0; field < SA_FIELDS; field++) {
        for (int n = 0; n < (field == 0 ? 4 : 2); n++) {
            long double size = 0;
            long double jump = at_force(s, field, 1, n, &size) - at_force(s, field, 0, n, &size);
            long double expected = field == 0 && n == 3 ? 8 : 0;
            ck_assert_msg(fabsl(jump - expected) <= 1e-12L * size, "alpha %Lg field %d derivative %d: %Lg",
                          s->alpha, field, n, jump);
        }
    }
}

/* Energy runs with the group velocity: a wave is ahead of the force when it is faster. */
static void waves_are_where_their_energy_goes(const sa_dispersion *d, const sa_undamped *s)
{
    for (int j = 0; j < s->count; j++) {
        const sa_undamped_pole *pole = &s->pole[j];
        sa_wave w = {0}, best = {0};
        for (int k = 0; k < SA_BRANCHES && pole->kind != SA_DECAYING; k++) {
            long double p = creall(pole->p);
            ck_assert_int_eq(sa_dispersion_wave(&w, d, k, p, 0), CV_OK);
            if (k == 0 || fabsl(w.omega - s->alpha * p) < fabsl(best.omega - s->alpha * p)) {
                best = w;
            }
        }
        if (pole->kind != SA_DECAYING) {
            ck_assert(fabsl(best.omega - s->alpha * best.p) <= 1e-12L * best.omega);
            ck_assert_int_eq(pole->kind, best.d[1] > s->alpha ? SA_WAVE_AHEAD : SA_WAVE_BEHIND);
        }
    }
}

START_TEST(the_steady_state_solves_the_equations)
{
    gsl_rng *rng = random_start("steady state", 12);
    cv_params params;
    sa_dispersion d;

    cv_params_init(&params);
    for (int i = 0; i < 400; i++) {
        sa_undamped s;
        choose(&params, rng, i / 4);
        sa_dispersion_set(&d, &params);
        if (sa_undamped_solve(&s, &d, log_uniform(rng, 0.02, 5), NULL) != CV_OK || s.reach < 1e-4L) {
            continue;
        }
        equations_hold(&d, &s);
        force_is_carried(&s);
        waves_are_where_their_energy_goes(&d, &s);
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

START_TEST(slopes_over_alpha_are_differences)
{
    gsl_rng *rng = random_start("slopes", 13);
    cv_params params;
    sa_dispersion d;

    cv_params_init(&params);
    for (int i = 0; i < 200; i++) {
        sa_undamped s[3];
        choose(&params, rng, i / 4);
        sa_dispersion_set(&d, &params);
        long double alpha = log_uniform(rng, 0.05, 3), at = 10 * gsl_rng_uniform(rng), v[3][4];
        ck_assert_int_eq(sa_undamped_solve(&s[1], &d, alpha, NULL), CV_OK);
        long double h = 1e-5L * fminl(s[1].reach, alpha);
        if (s[1].reach < 1e-3L) {
            continue;
        }
        for (int j = 0; j < 3; j++) {
            ck_assert_int_eq(sa_undamped_solve(&s[j], &d, alpha + (j - 1) * h, NULL), CV_OK);
            sa_undamped_at(v[j], &s[j], 0, 0, at);
        }
        long double slope = (v[2][0] - v[0][0]) / (2 * h);
        ck_assert_msg(fabsl(slope - v[1][3]) <= 1e-6L * (fabsl(slope) + fabsl(v[1][0]) / s[1].reach),
                      "track %d alpha %Lg: %Lg, %Lg", i / 4, alpha, slope, v[1][3]);
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

/* A resting force on rigid layers: the Winkler beam e^-xi (cos xi + sin xi), deflection 1 under the force. */
START_TEST(resting_force_on_winkler_foundation)
{
    const double rigid[6] = {1, 2.5, 1e14, 1e14, 0, 0};
    cv_params params;
    sa_dispersion d;
    sa_undamped s;
    long double v[4];

    cv_params_init(&params);
    set_track(&params, rigid);
    sa_dispersion_set(&d, &params);
    ck_assert_int_eq(sa_undamped_solve(&s, &d, 0, NULL), CV_OK);
    for (int i = 0; i < 10; i++) {
        long double xi = 0.7L * i;
        for (int side = 0; side < 2; side++) {
            sa_undamped_at(v, &s, 0, side, xi);
            ck_assert(fabsl(v[0] - expl(-xi) * (cosl(xi) + sinl(xi))) < 1e-12L);
        }
    }
    cv_params_clear(&params);
}
END_TEST

/* max of sign * w over a long window, on a fine grid */
static long double brute(const sa_undamped *s, int sign)
{
    long double best = -INFINITY, shortest = 0, v[4];

    for (int j = 0; j < s->count; j++) {
        if (cabsl(s->pole[j].weight[0]) > 1e-6L) {
            shortest = fmaxl(shortest, cabsl(s->pole[j].p));
        }
    }
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < 8000; i++) {
            sa_undamped_at(v, s, 0, side, i * 0.05L / shortest);
            best = fmaxl(best, sign * v[0]);
        }
    }
    return best;
}

START_TEST(no_place_of_the_rail_exceeds_the_supremum)
{
    gsl_rng *rng = random_start("supremum", 14);
    cv_params params;
    sa_dispersion d;

    cv_params_init(&params);
    for (int i = 0; i < 120; i++) {
        sa_undamped s;
        sa_summit top;
        choose(&params, rng, i / 6);
        sa_dispersion_set(&d, &params);
        if (sa_undamped_solve(&s, &d, log_uniform(rng, 0.02, 3), NULL) != CV_OK) {
            continue;
        }
        int sign = i % 2 ? 1 : -1;
        sa_summit_find(&top, &s, sign);
        long double seen = brute(&s, sign);
        ck_assert_msg(seen <= top.value * (1 + 1e-9L) + 1e-12L, "alpha %Lg: %.15Lg > %.15Lg", s.alpha, seen,
                      top.value);
        if (!isinf(top.distance)) {
            ck_assert_msg(top.value <= seen * (1 + 2e-3L) + 1e-5L, "alpha %Lg: %.15Lg never reached: %.15Lg",
                          s.alpha, top.value, seen);
        }
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

static size_t of_curve(const sa_pseudocritical_list *list, sa_curve of, double alpha[16])
{
    size_t count = 0;

    for (size_t i = 0; i < list->count; i++) {
        ck_assert_double_le(list->item[i].error, 1e-12);
        if (list->item[i].of == of && count < 16) {
            alpha[count++] = (double)list->item[i].alpha;
        }
    }
    return count;
}

/* Section 5: "the pseudocritical velocity at 0.404" (case 3); "two local extremes for the global maximum:
 * 0.304 and 0.329; the local minimum is at 0.329 and the extreme at the active point is at 0.293" (case 4).
 */
START_TEST(the_paper)
{
    cv_params params;
    sa_pseudocritical_list list;
    double a[16];

    cv_params_init(&params);
    set_track(&params, paper_case[2]);
    ck_assert_int_eq(sa_pseudocritical_find(&list, &params, 0.02, 2, NULL), CV_OK);
    ck_assert_uint_eq(of_curve(&list, SA_CURVE_MAX, a), 1);
    ck_assert_double_eq_tol(a[0], 0.404, 5e-4);
    ck_assert_uint_eq(of_curve(&list, SA_CURVE_MIN, a), 1);
    ck_assert_double_eq_tol(a[0], 0.404, 5e-4);
    sa_pseudocritical_clear(&list);
    set_track(&params, paper_case[3]);
    ck_assert_int_eq(sa_pseudocritical_find(&list, &params, 0.02, 2, NULL), CV_OK);
    ck_assert_uint_eq(of_curve(&list, SA_CURVE_MAX, a), 2);
    ck_assert_double_eq_tol(a[0], 0.304, 5e-4);
    ck_assert_double_eq_tol(a[1], 0.329, 5e-4);
    ck_assert_uint_eq(of_curve(&list, SA_CURVE_MIN, a), 1);
    ck_assert_double_eq_tol(a[0], 0.329, 5e-4);
    ck_assert_uint_eq(of_curve(&list, SA_CURVE_ACTIVE_POINT, a), 1);
    ck_assert_double_eq_tol(a[0], 0.293, 5e-4);
    sa_pseudocritical_clear(&list);
    cv_params_clear(&params);
}
END_TEST

/* 1 when a resonance lies in the interval */
static int holds_resonance(const sa_resonance_list *list, double low, double high)
{
    for (size_t i = 0; i < list->count; i++) {
        double at = mpfr_get_d(list->item[i].alpha, MPFR_RNDN);
        if (at >= low && at <= high) {
            return 1;
        }
    }
    return 0;
}

/* On a grid of velocities, a value above both neighbours is a listed velocity or a resonance, for each of the
 * curves. */
static void compare_with_grid(const cv_params *params, int track, int points)
{
    sa_dispersion d;
    sa_pseudocritical_list list;
    sa_resonance_list resonances;
    double alpha[3] = {0}, value[3][SA_CURVES] = {{0}};

    sa_dispersion_set(&d, params);
    ck_assert_int_eq(sa_pseudocritical_find(&list, params, 0.05, 1.5, NULL), CV_OK);
    ck_assert_int_eq(sa_resonances(&resonances, params, 15, NULL), CV_OK);
    for (int i = 0; i < points; i++) {
        sa_undamped s;
        alpha[i % 3] = 0.05 * pow(30, i / (points - 1.0));
        ck_assert_int_eq(sa_undamped_solve(&s, &d, alpha[i % 3], NULL), CV_OK);
        for (int of = 0; of < SA_CURVES; of++) {
            sa_summit top;
            sa_curve_at(&top, &s, (sa_curve)of);
            value[i % 3][of] = (double)top.value;
        }
        double low = alpha[(i + 1) % 3], high = alpha[i % 3];
        for (int of = 0; of < SA_CURVES && i >= 2 && !holds_resonance(&resonances, low, high); of++) {
            double before = value[(i + 1) % 3][of], here = value[(i + 2) % 3][of], after = value[i % 3][of];
            int is_top = here > before * (1 + 1e-9) && here > after * (1 + 1e-9), found = 0;
            for (size_t j = 0; j < list.count; j++) {
                found += (int)list.item[j].of == of && list.item[j].alpha > low && list.item[j].alpha < high;
            }
            ck_assert_msg(!is_top || found, "track %d, %s: a maximum between %g and %g is not listed", track,
                          sa_curve_text((sa_curve)of), low, high);
        }
    }
    sa_resonances_clear(&resonances);
    sa_pseudocritical_clear(&list);
}

START_TEST(every_maximum_on_a_grid_is_listed)
{
    gsl_rng *rng = random_start("grid", 2);
    cv_params params;

    cv_params_init(&params);
    for (int track = 0; track < 16; track++) {
        choose(&params, rng, track);
        compare_with_grid(&params, track, 400);
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic pseudocritical");
    TCase *tests = tcase_create("pseudocritical");

    gsl_set_error_handler_off();
    tcase_set_timeout(tests, 200);
    tcase_add_test(tests, the_steady_state_solves_the_equations);
    tcase_add_test(tests, slopes_over_alpha_are_differences);
    tcase_add_test(tests, resting_force_on_winkler_foundation);
    tcase_add_test(tests, no_place_of_the_rail_exceeds_the_supremum);
    tcase_add_test(tests, the_paper);
    tcase_add_test(tests, every_maximum_on_a_grid_is_listed);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
