#include "compare/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *cmp_format_mpfr(cmp_number_text *out, mpfr_srcptr x, int digits)
{
    mpfr_snprintf(out->text, sizeof out->text, "%#.*Rg", digits, x);
    size_t length = strlen(out->text);
    if (length > 0 && out->text[length - 1] == '.')
        out->text[length - 1] = '\0';
    return out->text;
}

const char *cmp_format_claimed(cmp_number_text *out, mpfr_srcptr x, mpfr_srcptr error, int digits)
{
    const double claimed = floor(cmp_log10(x) - cmp_log10(error));
    int shown = digits;
    if (claimed >= digits + 2)
        shown = digits + 2;
    else if (claimed > digits)
        shown = digits + 1;
    return cmp_format_mpfr(out, x, shown);
}

const char *cmp_format_exact(cmp_number_text *out, const cv_number *x, int digits)
{
    char *text = cv_number_text(x, digits);
    snprintf(out->text, sizeof out->text, "%s", text != NULL ? text : "?");
    free(text);
    return out->text;
}

const char *cmp_format_damping(cmp_damping_text *out, const cv_params *p, int digits)
{
    cmp_number_text a, b, c;
    const char *first = cmp_format_exact(&a, &p->eta_p, digits);
    if (cv_number_compare(&p->eta_p, &p->eta_b) == 0 && cv_number_compare(&p->eta_p, &p->eta_f) == 0)
        snprintf(out->text, sizeof out->text, "%s", first);
    else
        snprintf(out->text, sizeof out->text, "%s/%s/%s", first, cmp_format_exact(&b, &p->eta_b, digits),
                 cmp_format_exact(&c, &p->eta_f, digits));
    return out->text;
}

double cmp_floor_tenth(double digits)
{
    return floor(digits * 10.0) / 10.0;
}

const char *cmp_format_digits(cmp_number_text *out, double digits)
{
    snprintf(out->text, sizeof out->text, "%.1f", cmp_floor_tenth(digits));
    return out->text;
}

void cmp_velocity(mpfr_ptr out, mpfr_srcptr alpha, const cv_track *track, int km_h)
{
    cv_track_reference_velocity(out, track);
    mpfr_mul(out, out, alpha, MPFR_RNDN);
    if (km_h) {
        mpfr_mul_ui(out, out, 18, MPFR_RNDN);
        mpfr_div_ui(out, out, 5, MPFR_RNDN);
    }
}

void cmp_mass(mpfr_ptr out, const cv_number *eta_M, const cv_track *track)
{
    mpfr_t x;
    mpfr_init2(x, mpfr_get_prec(out));
    cv_number_get_mpfr(out, eta_M);
    cv_number_get_mpfr(x, &track->m);
    mpfr_mul(out, out, x, MPFR_RNDN);
    cv_track_chi(x, track);
    mpfr_div(out, out, x, MPFR_RNDN);
    mpfr_clear(x);
}
