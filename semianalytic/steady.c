#include "semianalytic/steady.h"

#include <float.h>
#include <math.h>

#include "semianalytic/damped.h"

static cv_status undamped_terms(sa_steady *s, const cv_params *params, const cv_number *alpha,
                                cv_message *why)
{
    sa_dispersion track;
    sa_undamped undamped;
    mpfr_t x;

    mpfr_init2(x, LDBL_MANT_DIG);
    cv_number_get_mpfr(x, alpha);
    long double velocity = mpfr_get_ld(x, MPFR_RNDN);
    mpfr_clear(x);
    sa_dispersion_set(&track, params);
    cv_status status = sa_undamped_solve(&undamped, &track, velocity, why);
    for (int j = 0; j < undamped.count && status == CV_OK; j++) {
        const sa_undamped_pole *pole = &undamped.pole[j];
        for (int ahead = 0; ahead < 2; ahead++) {
            if (pole->kind != (ahead ? SA_WAVE_BEHIND : SA_WAVE_AHEAD)) {
                sa_steady_term *term = &s->term[s->count++];
                term->ahead = ahead;
                term->p = pole->p;
                for (int f = 0; f < SA_FIELDS; f++) {
                    term->weight[f] = pole->weight[f];
                }
            }
        }
    }
    return status;
}

/* Jump of the n-th derivative of a field at the force less the expected one, relative to the terms. */
static long double jump_error(const sa_steady *s, int field, int n, long double expected)
{
    long double jump = -expected, size = fabsl(expected);

    for (int j = 0; j < s->count; j++) {
        const sa_steady_term *term = &s->term[j];
        complex long double factor = (term->ahead ? 1 : -1) * term->p * (complex long double)_Complex_I;
        complex long double part = term->weight[field];
        for (int i = 0; i < n; i++) {
            part *= factor;
        }
        jump += (term->ahead ? 1 : -1) * creall(part);
        size += cabsl(part);
    }
    return size > 0 ? fabsl(jump) / size : 0;
}

static double defect(const sa_steady *s, const cv_params *params, const cv_number *alpha)
{
    const int orders[SA_FIELDS] = {4, 2, 2};
    cv_number shear;
    long double worst = 0;

    /* without mass and shear stiffness there is no second derivative to carry u_s', u_b' */
    cv_number_init(&shear);
    cv_number_mul(&shear, alpha, alpha);
    cv_number_mul(&shear, &shear, &params->mu_b);
    int sheared = cv_number_compare(&shear, &params->eta_s) != 0, moving = cv_number_sign(alpha) != 0;
    cv_number_clear(&shear);
    for (int field = 0; field < SA_FIELDS; field++) {
        int bound = field == 0 || (field == 1 ? moving : sheared);
        for (int n = 0; n < orders[field] && bound; n++) {
            worst = fmaxl(worst, jump_error(s, field, n, field == 0 && n == 3 ? 8 : 0));
        }
    }
    return (double)worst;
}

cv_status sa_steady_solve(sa_steady *out, const cv_params *params, const cv_number *alpha, cv_message *why)
{
    /* damping does not act on a resting track */
    int undamped = cv_params_undamped(params) || cv_number_sign(alpha) == 0;

    *out = (sa_steady){.count = 0};
    cv_status status =
        undamped ? undamped_terms(out, params, alpha, why) : sa_damped_terms(out, params, alpha, why);
    if (status == CV_OK) {
        out->defect = defect(out, params, alpha);
    }
    return status;
}

void sa_steady_at(long double out[SA_FIELDS], const sa_steady *s, long double xi)
{
    for (int f = 0; f < SA_FIELDS; f++) {
        out[f] = 0;
    }
    for (int j = 0; j < s->count; j++) {
        const sa_steady_term *term = &s->term[j];
        if (term->ahead == (xi >= 0)) {
            complex long double e = cexpl((complex long double)_Complex_I * term->p * fabsl(xi));
            for (int f = 0; f < SA_FIELDS; f++) {
                out[f] += creall(term->weight[f] * e);
            }
        }
    }
}
