/* Tracks and points for the tests of semianalytic/: exact decimals, random ones by tests/random_track.h. */
#ifndef CRITVEL_TESTS_SEMIANALYTIC_POINTS_H
#define CRITVEL_TESTS_SEMIANALYTIC_POINTS_H

#include <stdlib.h>

#include "semianalytic/dispersion.h"
#include "semianalytic/zeta.h"
#include "tests/random_track.h"

static inline void set_text(cv_number *to, const char *text)
{
    if (cv_number_parse(to, text, NULL) != CV_OK)
        abort();
}

static inline void set_damping(cv_params *p, const char *eta_p, const char *eta_b, const char *eta_f)
{
    set_text(&p->eta_p, eta_p);
    set_text(&p->eta_b, eta_b);
    set_text(&p->eta_f, eta_f);
}

/* mu_s, mu_b, kappa_p, kappa_b, eta_s, eta_N and one damping for all */
static inline void set_params(cv_params *p, const char *const values[6], const char *damping)
{
    cv_number *to[] = {&p->mu_s, &p->mu_b, &p->kappa_p, &p->kappa_b, &p->eta_s, &p->eta_N};
    for (int i = 0; i < 6; i++)
        set_text(to[i], values[i]);
    set_damping(p, damping, damping, damping);
}

static inline sa_track *make_track(const char *const values[6], const char *damping)
{
    cv_params p;
    sa_track *track = NULL;
    cv_params_init(&p);
    set_params(&p, values, damping);
    if (sa_track_new(&track, &p, NULL) != CV_OK)
        abort();
    cv_params_clear(&p);
    return track;
}

/* table 1 of the paper */
static const char *const table1[4][6] = {{"6", "35", "300", "7", "0", "0"},
                                         {"6", "35", "30", "7", "0", "0"},
                                         {"6", "5", "0.03", "3", "0", "0"},
                                         {"3", "10", "0.03", "0.1", "0", "0"}};

/* Damping: equal levels from 1e-10 to 0.2 mostly, else unequal, at most two of them zero. */
static inline void random_damping(cv_params *p, gsl_rng *rng)
{
    cv_number *eta[] = {&p->eta_p, &p->eta_b, &p->eta_f};
    double level = log_uniform(rng, 1e-10, 0.2);
    int unequal = gsl_rng_uniform_int(rng, 4) == 0;
    for (int i = 0; i < 3; i++)
        set_decimal(eta[i], unequal ? log_uniform(rng, 1e-10, 0.2) : level);
    if (unequal && gsl_rng_uniform_int(rng, 2) == 0)
        set_text(eta[gsl_rng_uniform_int(rng, 3)], "0");
}

/* A velocity and frequency where things happen: anywhere, next to a branch point of the undamped track, or
 * next to alpha^2 mu_b = eta_s; "next to" at log-uniform distances down to 1e-12. */
static inline void random_point(double *alpha, double *q, const cv_params *p, gsl_rng *rng)
{
    unsigned long kind = gsl_rng_uniform_int(rng, 5);
    double shear = sqrt(cv_number_get_double(&p->eta_s) / cv_number_get_double(&p->mu_b));
    double nudge = log_uniform(rng, 1e-12, 0.1) * (gsl_rng_uniform_int(rng, 2) ? 1 : -1);
    *alpha = log_uniform(rng, 0.02, 2);
    *q = log_uniform(rng, 1e-3, 10);
    if (kind == 0 && shear > 0)
        *alpha = shear * (1 + nudge);
    if (kind == 1 || kind == 2) {
        sa_dispersion track;
        sa_wave wave;
        sa_dispersion_set(&track, p);
        if (sa_dispersion_wave(&wave, &track, (int)gsl_rng_uniform_int(rng, 3), log_uniform(rng, 0.05, 20),
                               0) != CV_OK ||
            !(fabsl(wave.d[1]) > 1e-3L && fabsl(wave.intercept) > 1e-6L))
            return;
        *alpha = (double)fabsl(wave.d[1]);
        *q = (double)fabsl(wave.intercept) * (1 + nudge);
    }
}

#endif
