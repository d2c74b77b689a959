/* Tracks and points for the tests of one point (alpha, qbar) in dgreen/. */
#ifndef CRITVEL_TESTS_DGREEN_POINTS_H
#define CRITVEL_TESTS_DGREEN_POINTS_H

#include <complex.h>
#include <string.h>

#include "dgreen/branch_points_wave.h"
#include "dgreen/operator.h"
#include "tests/random_track.h"

/* mu_s mu_b kappa_p kappa_b eta_p eta_b eta_f eta_s eta_N, blank-separated decimals */
static inline dg_track *track_of(const char *text)
{
    cv_params p;
    dg_track *track = NULL;
    char copy[200], *rest = copy;
    cv_params_init(&p);
    cv_number *to[] = {&p.mu_s,  &p.mu_b,  &p.kappa_p, &p.kappa_b, &p.eta_p,
                       &p.eta_b, &p.eta_f, &p.eta_s,   &p.eta_N};
    snprintf(copy, sizeof copy, "%s", text);
    for (int i = 0; i < 9; i++) {
        const char *word = strtok_r(i == 0 ? copy : NULL, " ", &rest);
        if (word == NULL || cv_number_parse(to[i], word, NULL) != CV_OK)
            abort();
    }
    if (dg_track_new(&track, &p, NULL) != CV_OK)
        abort();
    cv_params_clear(&p);
    return track;
}

/* A track of (31) with damping: one level for all three mostly, 1e-10 for a third of those; else unequal
 * levels, some of them 0 but not all. */
static inline dg_track *random_damped_track(gsl_rng *rng)
{
    cv_params p;
    dg_track *track = NULL;
    cv_params_init(&p);
    random_track(&p, rng);
    cv_number *eta[] = {&p.eta_p, &p.eta_b, &p.eta_f};
    const double level = gsl_rng_uniform_int(rng, 3) == 0 ? 1e-10 : log_uniform(rng, 1e-10, 0.2);
    const int unequal = gsl_rng_uniform_int(rng, 4) == 0;
    for (int i = 0; i < 3; i++)
        set_decimal(eta[i], unequal ? log_uniform(rng, 1e-10, 0.2) : level);
    if (unequal)
        set_decimal(eta[gsl_rng_uniform_int(rng, 3)], 0);
    if (dg_track_new(&track, &p, NULL) != CV_OK)
        abort();
    cv_params_clear(&p);
    return track;
}

/* Anywhere; next to the degree drop alpha^2 mu_b = eta_s; or next to a branch point (alpha = d omega/dp, q =
 * |omega - p alpha| of a wave of the undamped track). "Next to" goes down to relative distances of 1e-14. */
static inline void random_point(double *alpha, double *q, const dg_track *t, gsl_rng *rng)
{
    const double nudge = log_uniform(rng, 1e-14, 0.1) * (gsl_rng_uniform_int(rng, 2) ? 1 : -1);
    const unsigned long kind = gsl_rng_uniform_int(rng, 6);
    *alpha = log_uniform(rng, 0.02, 2);
    *q = log_uniform(rng, 1e-4, 20);
    if (kind == 0 && t->eta_s > 0)
        *alpha = sqrt(t->eta_s / t->mu_b) * (1 + nudge);
    if (kind == 1 || kind == 2) {
        dg_wave wave;
        const double p = log_uniform(rng, 0.05, 20);
        dg_wave_at(&wave, t, p, (int)gsl_rng_uniform_int(rng, DG_WAVE_BRANCHES));
        if (fabs(wave.group) > 1e-3 && fabs(wave.omega - p * wave.group) > 1e-6) {
            *alpha = fabs(wave.group);
            *q = fabs(wave.omega - p * wave.group) * (1 + nudge);
        }
    }
}

/* The matrix (7) at (p, qbar), in long double: its determinant d3, the minor d2, and the same sums with every
 * term replaced by its modulus. */
typedef struct {
    long double complex d3, d2;
} matrix_7;

static inline matrix_7 matrix_at(const dg_track *t, double alpha, double complex qbar, double complex p)
{
    const long double complex s =
        (long double complex)qbar - CMPLXL(0, 1) * (long double)alpha * (long double complex)p;
    const long double complex P = p, s2 = s * s;
    const long double complex D1 = P * P * P * P / 4 + s2 - (long double)t->eta_N * P * P;
    const long double complex D2 = 2 * (long double)t->eta_p * s + (long double)t->kappa_p;
    const long double complex D4 = 2 * (long double)t->eta_b * s + (long double)t->kappa_b;
    const long double complex middle = D2 + (long double)t->mu_s * s2 + D4;
    const long double complex lower =
        D4 + (long double)t->mu_b * s2 + 2 * (long double)t->eta_f * s + 1 + (long double)t->eta_s * P * P;
    matrix_7 m;
    m.d2 = middle * lower - D4 * D4;
    m.d3 = (D1 + D2) * m.d2 - D2 * D2 * lower;
    return m;
}

#endif
