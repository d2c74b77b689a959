/* Ranges of alpha and eta_M for the tests of lines and asymptotes in semianalytic/. */
#ifndef CRITVEL_TESTS_SEMIANALYTIC_RANGES_H
#define CRITVEL_TESTS_SEMIANALYTIC_RANGES_H

#include "semianalytic/lines.h"
#include "tests/semianalytic_points.h"

/* A range of alpha and eta_M as typed. */
typedef struct {
    cv_number end[4];
    sa_lines_range range;
} typed_range;

static inline void range_set(typed_range *r, const char *alpha_min, const char *alpha_max,
                             const char *mass_min, const char *mass_max)
{
    const char *text[] = {alpha_min, alpha_max, mass_min, mass_max};
    for (int i = 0; i < 4; i++) {
        cv_number_init(&r->end[i]);
        set_text(&r->end[i], text[i]);
    }
    r->range = (sa_lines_range){&r->end[0], &r->end[1], &r->end[2], &r->end[3]};
}

static inline void range_clear(typed_range *r)
{
    for (int i = 0; i < 4; i++)
        cv_number_clear(&r->end[i]);
}

static inline double as_double(mpfr_srcptr x)
{
    return mpfr_get_d(x, MPFR_RNDN);
}

#endif
