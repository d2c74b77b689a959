/* Isolation and refinement of positive roots, declared in interval.h. */
#include <stdlib.h>

#include "semianalytic/interval.h"

typedef struct {
    const sa_polynomial *p;
    mpfr_prec_t precision;
    sa_root_place *place;
    size_t count;
} search;

static int is_decided(int least, int most)
{
    return least == 1 && most == 1;
}

static cv_status keep(search *s, const mpfr_t low, const mpfr_t high, int least, int most)
{
    sa_root_place *last = s->count > 0 ? &s->place[s->count - 1] : NULL;

    if (last && !is_decided(last->least, last->most) && !is_decided(least, most) &&
        mpfr_equal_p(last->high, low)) {
        mpfr_set(last->high, high, MPFR_RNDU);
        last->least += least;
        last->most += most;
        return CV_OK;
    }
    sa_root_place *larger = realloc(s->place, (s->count + 1) * sizeof *larger);
    if (!larger) {
        return CV_FAILED;
    }
    s->place = larger;
    last = &larger[s->count++];
    mpfr_init2(last->low, s->precision);
    mpfr_init2(last->high, s->precision);
    mpfr_set(last->low, low, MPFR_RNDD);
    mpfr_set(last->high, high, MPFR_RNDU);
    last->least = least;
    last->most = most;
    return CV_OK;
}

static int is_narrow(const mpfr_t low, const mpfr_t high, long bits)
{
    mpfr_t width;

    mpfr_init2(width, 64);
    mpfr_sub(width, high, low, MPFR_RNDU);
    mpfr_mul_2si(width, width, bits, MPFR_RNDU);
    int narrow = mpfr_lessequal_p(width, high);
    mpfr_clear(width);
    return narrow;
}

static cv_status isolate(search *s, const mpfr_t low, const mpfr_t high)
{
    sa_polynomial inside;
    mpfr_t mid;
    int least, most;
    cv_status status = CV_OK;

    sa_polynomial_init(&inside, s->precision);
    sa_polynomial_restrict(&inside, s->p, low, high);
    sa_polynomial_variations(&least, &most, &inside);
    sa_polynomial_clear(&inside);
    if (most == 0) {
        return CV_OK;
    }
    if (is_decided(least, most) || is_narrow(low, high, (long)s->precision / 4)) {
        return keep(s, low, high, least, most);
    }
    /* off the middle: round numbers are more likely to be roots than others */
    mpfr_init2(mid, s->precision);
    mpfr_sub(mid, high, low, MPFR_RNDN);
    mpfr_mul_d(mid, mid, 0.486328125, MPFR_RNDN);
    mpfr_add(mid, mid, low, MPFR_RNDN);
    status = isolate(s, low, mid);
    if (status == CV_OK) {
        status = isolate(s, mid, high);
    }
    mpfr_clear(mid);
    return status;
}

/* A power of two above all positive roots: beyond it p keeps the sign of its leading coefficient. */
static int root_bound(mpfr_t bound, const sa_polynomial *p, mpfr_prec_t precision)
{
    sa_polynomial tail;
    mpfr_t zero;
    int least, most = 1;

    sa_polynomial_init(&tail, precision);
    mpfr_init2(zero, precision);
    mpfr_set_zero(zero, 1);
    for (long power = 0; power <= 4096 && most != 0; power += 8) {
        /* roots beyond 2^power = roots below 2^-power of the reversed polynomial */
        mpfr_set_si_2exp(bound, 1, -power, MPFR_RNDN);
        tail.degree = p->degree;
        for (int i = 0; i <= p->degree; i++) {
            sa_interval_set(&tail.coefficient[i], &p->coefficient[p->degree - i]);
        }
        sa_polynomial_restrict(&tail, &tail, zero, bound);
        sa_polynomial_variations(&least, &most, &tail);
        mpfr_set_si_2exp(bound, 1, power, MPFR_RNDN);
    }
    mpfr_clear(zero);
    sa_polynomial_clear(&tail);
    return most == 0;
}

cv_status sa_polynomial_positive_roots(sa_root_place **out, size_t *count, const sa_polynomial *p)
{
    search s = {.p = p, .precision = mpfr_get_prec(p->coefficient[0].low)};
    mpfr_t low, high;
    cv_status status = CV_FAILED;

    mpfr_init2(low, s.precision);
    mpfr_init2(high, s.precision);
    mpfr_set_zero(low, 1);
    if (root_bound(high, p, s.precision)) {
        status = isolate(&s, low, high);
    }
    mpfr_clear(low);
    mpfr_clear(high);
    if (status != CV_OK) {
        sa_root_places_free(s.place, s.count);
        s = (search){.place = NULL};
    }
    *out = s.place;
    *count = s.count;
    return status;
}

void sa_root_places_free(sa_root_place *place, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        mpfr_clear(place[i].low);
        mpfr_clear(place[i].high);
    }
    free(place);
}

static int sign_at(const sa_polynomial *p, const mpfr_t x)
{
    sa_interval at;

    sa_interval_init(&at, mpfr_get_prec(x));
    sa_interval_set_mpfr(&at, x);
    sa_polynomial_at(&at, p, &at);
    int sign = sa_interval_sign(&at);
    sa_interval_clear(&at);
    return sign;
}

/* x - p(x) / p'(x) with the lower ends of the coefficients: a guess, to be verified */
static void newton(mpfr_t x, const sa_polynomial *p)
{
    mpfr_t value, slope;

    mpfr_inits2(mpfr_get_prec(x), value, slope, (mpfr_ptr)0);
    mpfr_set_zero(value, 1);
    mpfr_set_zero(slope, 1);
    for (int i = p->degree; i >= 0; i--) {
        mpfr_fma(slope, slope, x, value, MPFR_RNDN);
        mpfr_fma(value, value, x, p->coefficient[i].low, MPFR_RNDN);
    }
    mpfr_div(value, value, slope, MPFR_RNDN);
    mpfr_sub(x, x, value, MPFR_RNDN);
    mpfr_clears(value, slope, (mpfr_ptr)0);
}

/* Bisects until Newton's iteration from the middle stays inside and converges. */
static int converge(mpfr_t x, const sa_polynomial *p, mpfr_t low, mpfr_t high, int sign_high)
{
    mpfr_prec_t precision = mpfr_get_prec(x);

    for (int i = 0; i < (int)precision; i++) {
        mpfr_add(x, low, high, MPFR_RNDN);
        mpfr_div_2ui(x, x, 1, MPFR_RNDN);
        int sign = sign_at(p, x);
        if (i >= 30 || is_narrow(low, high, 30)) {
            int inside = 1;
            for (int step = 0; step < 24 && inside; step++) {
                newton(x, p);
                inside = mpfr_greater_p(x, low) && mpfr_less_p(x, high);
            }
            if (inside) {
                return 1;
            }
            mpfr_add(x, low, high, MPFR_RNDN);
            mpfr_div_2ui(x, x, 1, MPFR_RNDN);
        }
        if (sign == 2 || sign == 0) {
            return 1; /* within the resolution of p */
        }
        mpfr_set(sign == sign_high ? high : low, x, MPFR_RNDN);
    }
    return 1;
}

int sa_polynomial_refine(sa_interval *x, const sa_polynomial *p, const sa_root_place *place, long bits)
{
    mpfr_prec_t precision = mpfr_get_prec(p->coefficient[0].low);
    mpfr_t low, high, root, slack;

    mpfr_inits2(precision, low, high, root, slack, (mpfr_ptr)0);
    mpfr_set(low, place->low, MPFR_RNDN);
    mpfr_set(high, place->high, MPFR_RNDN);
    int sign_high = sign_at(p, high), done = 0;
    if (sign_high == 1 || sign_high == -1) {
        converge(root, p, low, high, sign_high);
        mpfr_mul_2si(slack, root, -bits, MPFR_RNDD);
        mpfr_sub(low, root, slack, MPFR_RNDN);
        mpfr_add(high, root, slack, MPFR_RNDN);
        done = mpfr_greaterequal_p(low, place->low) && mpfr_lessequal_p(high, place->high) &&
               sign_at(p, high) == sign_high && sign_at(p, low) == -sign_high;
        mpfr_set(x->low, low, MPFR_RNDD);
        mpfr_set(x->high, high, MPFR_RNDU);
    }
    mpfr_clears(low, high, root, slack, (mpfr_ptr)0);
    return done;
}
