#include "dgreen/mass_roots_refine.h"

#include <math.h>

static const mpc_rnd_t CRND = MPC_RNDNN;
enum { SECANTS = 60, POINTS = 8, LEVELS = 6 };

typedef struct {
    dg_continued_mp *w;
    const dg_continued *near;
    mpfr_t x, error, size;      /* 1/eta_M; of the last value; scratch */
    mpc_t q, value, last, step; /* value: zeta - x at q */
    int physical;
} search;

static cv_status search_init(search *s, const dg_continued *near, const cv_number *alpha,
                             const cv_number *mass_ratio, mpfr_prec_t precision, cv_message *why)
{
    s->near = near;
    mpfr_init2(s->x, precision);
    mpfr_inits2(53, s->error, s->size, (mpfr_ptr)0);
    mpc_init2(s->q, precision);
    mpc_init2(s->value, precision);
    mpc_init2(s->last, precision);
    mpc_init2(s->step, precision);
    cv_number_get_mpfr(s->x, mass_ratio);
    mpfr_ui_div(s->x, 1, s->x, MPFR_RNDN);
    mpc_set_d_d(s->q, creal(near->qbar), cimag(near->qbar), CRND);
    return dg_continued_mp_new(&s->w, near->track, alpha, precision, why);
}

static void search_clear(search *s)
{
    mpfr_clears(s->x, s->error, s->size, (mpfr_ptr)0);
    mpc_clear(s->q);
    mpc_clear(s->value);
    mpc_clear(s->last);
    mpc_clear(s->step);
    dg_continued_mp_free(s->w);
}

/* zeta - x at q; x is off by two units, which the 64 of the bound of zeta contain */
static cv_status evaluate(search *s, mpc_srcptr q)
{
    const cv_status status = dg_continued_mp_zeta(s->value, s->error, &s->physical, s->w, s->near, q);
    if (status == CV_OK)
        mpc_sub_fr(s->value, s->value, s->x, CRND);
    return status;
}

/* Secant method; the first step is Newton's with the slope in double. */
static cv_status solve(search *s, double complex slope)
{
    const mpfr_prec_t precision = mpfr_get_prec(s->x);
    cv_status status = evaluate(s, s->q);
    mpc_set_d_d(s->step, creal(slope), cimag(slope), CRND);
    mpc_div(s->step, s->value, s->step, CRND);
    for (int i = 0; i < SECANTS && status == CV_OK; i++) {
        mpc_neg(s->step, s->step, CRND);
        mpc_add(s->q, s->q, s->step, CRND);
        mpc_abs(s->size, s->step, MPFR_RNDU);
        if (mpfr_zero_p(s->size) || mpfr_get_exp(s->size) < 16 - (long)precision)
            return CV_OK;
        mpc_set(s->last, s->value, CRND);
        status = evaluate(s, s->q);
        mpc_sub(s->last, s->value, s->last, CRND);
        if (mpc_cmp_si(s->last, 0) == 0)
            return status;
        mpc_div(s->step, s->step, s->last, CRND);
        mpc_mul(s->step, s->step, s->value, CRND);
    }
    return status;
}

/* From 0 to "last" of a circle's points the value must turn by about 45 degrees at each. */
static int turns_once(search *s, mpc_ptr before)
{
    mpc_div(s->last, s->value, before, CRND);
    mpc_set(before, s->value, CRND);
    mpfr_atan2(s->size, mpc_imagref(s->last), mpc_realref(s->last), MPFR_RNDN);
    const double angle = mpfr_get_d(s->size, MPFR_RNDN);
    mpc_abs(s->size, s->value, MPFR_RNDD);
    mpfr_div(s->size, s->error, s->size, MPFR_RNDU);
    return fabs(angle - atan(1)) < 0.35 && mpfr_get_d(s->size, MPFR_RNDU) < 0.05;
}

/* Whether zeta - x turns once around zero as q goes around the circle of that radius, in even steps */
static cv_status enclose(search *s, mpfr_srcptr radius)
{
    const mpfr_prec_t precision = mpfr_get_prec(s->x);
    mpc_t at, before;
    mpc_init2(at, precision);
    mpc_init2(before, precision);
    cv_status status = CV_OK;
    for (int i = 0; i <= POINTS && status == CV_OK; i++) {
        const double complex direction = cexp(CMPLX(0, i * atan(1)));
        mpc_set_d_d(at, creal(direction), cimag(direction), CRND);
        mpc_mul_fr(at, at, radius, CRND);
        mpc_add(at, at, s->q, CRND);
        status = evaluate(s, at);
        if (i == 0)
            mpc_set(before, s->value, CRND);
        else if (status == CV_OK && !turns_once(s, before))
            status = CV_UNDECIDED;
    }
    mpc_clear(at);
    mpc_clear(before);
    return status;
}

/* 10^-(digits + 1) of the smaller part of q */
static void set_radius(mpfr_ptr radius, mpc_srcptr q, int digits)
{
    mpfr_srcptr re = mpc_realref(q), im = mpc_imagref(q);
    mpfr_set_si(radius, -digits - 1, MPFR_RNDN);
    mpfr_exp10(radius, radius, MPFR_RNDN);
    mpfr_mul(radius, radius, mpfr_cmpabs(re, im) < 0 ? re : im, MPFR_RNDN);
    mpfr_abs(radius, radius, MPFR_RNDN);
}

static cv_status attempt(dg_mass_root *root, search *s, double complex slope, int digits)
{
    mpfr_t radius;
    mpfr_init2(radius, 53);
    cv_status status = solve(s, slope);
    set_radius(radius, s->q, digits);
    if (status == CV_OK)
        status = mpfr_zero_p(radius) ? CV_UNDECIDED : enclose(s, radius);
    if (status == CV_OK && mpfr_sgn(mpc_realref(s->q)) > 0 && !s->physical)
        status = CV_UNDECIDED;
    if (status == CV_OK) {
        mpfr_set_prec(root->re, mpfr_get_prec(s->x));
        mpfr_set_prec(root->im, mpfr_get_prec(s->x));
        mpfr_set(root->re, mpc_realref(s->q), MPFR_RNDN);
        mpfr_set(root->im, mpc_imagref(s->q), MPFR_RNDN);
        mpfr_log10(radius, radius, MPFR_RNDU);
        root->log_error = mpfr_get_d(radius, MPFR_RNDU);
    }
    mpfr_clear(radius);
    return status;
}

cv_status dg_mass_root_refine(dg_mass_root *root, const dg_continued *near, double complex slope,
                              const cv_number *alpha, const cv_number *mass_ratio, int digits,
                              cv_message *why)
{
    mpfr_prec_t precision = 64 * (2 + (long)(digits / 19)) - 1;
    mpfr_inits2(53, root->re, root->im, (mpfr_ptr)0);
    cv_status status = CV_UNDECIDED;
    for (int i = 0; i < LEVELS && status == CV_UNDECIDED; i++, precision = 2 * precision + 1) {
        search s;
        status = search_init(&s, near, alpha, mass_ratio, precision, why);
        if (status == CV_OK)
            status = attempt(root, &s, slope, digits);
        search_clear(&s);
    }
    if (status == CV_UNDECIDED)
        cv_fail(why, status, "root near %.10g + %.10gi not enclosed", creal(near->qbar), cimag(near->qbar));
    return status;
}
