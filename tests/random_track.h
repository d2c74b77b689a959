/* Random tracks of (31) for tests: exact decimals, seed printed and taken from CRITVEL_SEED when set. */
#ifndef CRITVEL_TESTS_RANDOM_TRACK_H
#define CRITVEL_TESTS_RANDOM_TRACK_H

#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/params.h"

static inline gsl_rng *random_start(const char *name, unsigned long fallback)
{
    const char *text = getenv("CRITVEL_SEED");
    unsigned long seed = text ? strtoul(text, NULL, 10) : fallback;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);

    printf("%s: seed %lu\n", name, seed);
    gsl_rng_set(rng, seed);
    return rng;
}

static inline void set_decimal(cv_number *to, double value)
{
    char text[40];

    snprintf(text, sizeof text, "%.6e", value);
    if (cv_number_parse(to, text, NULL) != CV_OK) {
        abort();
    }
}

static inline double log_uniform(gsl_rng *rng, double low, double high)
{
    return low * pow(high / low, gsl_rng_uniform(rng));
}

static inline void set_track(cv_params *p, const double v[6])
{
    set_decimal(&p->mu_s, v[0]);
    set_decimal(&p->mu_b, v[1]);
    set_decimal(&p->kappa_p, v[2]);
    set_decimal(&p->kappa_b, v[3]);
    set_decimal(&p->eta_s, v[4]);
    set_decimal(&p->eta_N, v[5]);
}

/* mu, kappa log-uniform over (31); eta_s = 0 for a third of the tracks; eta_N = 0 for a third, else of either
 * sign below buckling. Dampings 0. */
static inline void random_track(cv_params *p, gsl_rng *rng)
{
    double v[6] = {log_uniform(rng, 1, 6),
                   log_uniform(rng, 2.5, 50),
                   log_uniform(rng, 0.03, 50000),
                   log_uniform(rng, 0.1, 10000),
                   0,
                   0};

    v[4] = gsl_rng_uniform_int(rng, 3) ? log_uniform(rng, 1e-3, 100) : 0;
    v[5] = gsl_rng_uniform_int(rng, 3) ? 4 * gsl_rng_uniform(rng) - 2.5 : 0;
    set_track(p, v);
    while (cv_params_check(p, NULL) != CV_OK) {
        v[5] /= 2;
        set_track(p, v);
    }
}

#endif
