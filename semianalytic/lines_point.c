#include <math.h>

#include "semianalytic/lines_parts.h"

/* One precision: x is sought, f = Im zeta. */
typedef struct {
    const sa_track *track;
    sa_sweep *sweep;
    sa_line_given which;
    mpfr_srcptr given;
    mpfr_t x, f, step, slope, reach, last_x, last_f, scratch, re_error, im_error;
    mpc_t zeta;
    int astray; /* no zero was found where Im zeta is known well: more precision does not help */
} solver;

static void solver_init(solver *s, mpfr_prec_t bits)
{
    mpfr_inits2(bits, s->x, s->f, s->step, s->slope, s->reach, s->last_x, s->last_f, s->scratch, s->re_error,
                s->im_error, (mpfr_ptr)0);
    mpc_init2(s->zeta, bits);
}

static void solver_clear(solver *s)
{
    mpfr_clears(s->x, s->f, s->step, s->slope, s->reach, s->last_x, s->last_f, s->scratch, s->re_error,
                s->im_error, (mpfr_ptr)0);
    mpc_clear(s->zeta);
}

static cv_status evaluate(solver *s, const mpfr_t x)
{
    mpfr_srcptr alpha = s->which == SA_GIVEN_ALPHA ? s->given : x,
                q = s->which == SA_GIVEN_ALPHA ? x : s->given;
    cv_status status = sa_zeta_mp(s->zeta, s->re_error, s->im_error, s->sweep, s->track, alpha, q);
    return status == CV_BAD_INPUT ? CV_UNDECIDED : status;
}

/* Slopes of zeta in the coordinate sought, in double. *im_x = 0: double does not know it beside Re zeta. */
static cv_status slopes(double *re_x, double *im_x, double *re, const solver *s, double start)
{
    const double resolved = 1e-11;
    sa_value v;
    double given = mpfr_get_d(s->given, MPFR_RNDN);
    double alpha = s->which == SA_GIVEN_ALPHA ? given : start, q = s->which == SA_GIVEN_ALPHA ? start : given;
    cv_status status = sa_zeta_adaptive(&v, s->sweep, s->track, alpha, q, 0.5);
    if (status != CV_OK)
        return status;
    double complex d = s->which == SA_GIVEN_ALPHA ? v.d_q : v.d_alpha;
    *re_x = creal(d);
    *im_x = fabs(cimag(d)) * start > resolved * fabs(v.re) ? cimag(d) : 0;
    *re = v.re;
    return isfinite(*im_x) ? CV_OK : CV_UNDECIDED;
}

/* s->slope by a difference at s->x that leaves half of the bits to it. */
static cv_status difference(solver *s)
{
    cv_status status = evaluate(s, s->x);
    if (status != CV_OK)
        return status;
    mpfr_set(s->last_f, mpc_imagref(s->zeta), MPFR_RNDN);
    mpfr_div_2ui(s->step, s->x, (unsigned long)mpfr_get_prec(s->x) / 2, MPFR_RNDN);
    mpfr_add(s->scratch, s->x, s->step, MPFR_RNDN);
    mpfr_sub(s->step, s->scratch, s->x, MPFR_RNDN);
    status = evaluate(s, s->scratch);
    if (status != CV_OK)
        return status;
    mpfr_sub(s->f, mpc_imagref(s->zeta), s->last_f, MPFR_RNDN);
    mpfr_mul_2ui(s->scratch, s->im_error, 10, MPFR_RNDU);
    if (!(mpfr_cmpabs(s->f, s->scratch) > 0))
        return CV_UNDECIDED;
    mpfr_div(s->slope, s->f, s->step, MPFR_RNDN);
    return CV_OK;
}

/* slope = (f - last_f) / (x - last_x), unless both points are too close to say. */
static void secant(solver *s)
{
    mpfr_sub(s->scratch, s->f, s->last_f, MPFR_RNDN);
    mpfr_sub(s->step, s->x, s->last_x, MPFR_RNDN);
    if (mpfr_zero_p(s->step) || mpfr_zero_p(s->scratch) ||
        mpfr_get_exp(s->scratch) < mpfr_get_exp(s->im_error) + 10)
        return;
    mpfr_div(s->slope, s->scratch, s->step, MPFR_RNDN);
}

/* Secants until a step is far below s->reach. */
static cv_status iterate(solver *s)
{
    enum { STEPS = 40 };
    for (int i = 0; i < STEPS; ++i) {
        cv_status status = evaluate(s, s->x);
        if (status != CV_OK)
            return status;
        mpfr_set(s->f, mpc_imagref(s->zeta), MPFR_RNDN);
        if (i > 0)
            secant(s);
        mpfr_set(s->last_x, s->x, MPFR_RNDN);
        mpfr_set(s->last_f, s->f, MPFR_RNDN);
        mpfr_div(s->step, s->f, s->slope, MPFR_RNDN);
        mpfr_div_2ui(s->scratch, s->x, 1, MPFR_RNDN);
        if (!mpfr_number_p(s->step) || mpfr_cmpabs(s->step, s->scratch) > 0)
            return CV_UNDECIDED;
        mpfr_sub(s->x, s->x, s->step, MPFR_RNDN);
        mpfr_mul_2ui(s->scratch, s->step, i > 0 ? 3 : 14,
                     MPFR_RNDN); /* the first slope is that of a double */
        if (mpfr_cmpabs(s->scratch, s->reach) < 0)
            return CV_OK;
    }
    return CV_UNDECIDED;
}

/* From start, with the slope set; where that leads astray, once more with that of a difference. */
static cv_status search(solver *s, const mpfr_t start)
{
    const unsigned long clear = 20;
    cv_status status = CV_UNDECIDED;
    for (int i = 0; i < 2 && status == CV_UNDECIDED; ++i) {
        mpfr_set(s->x, start, MPFR_RNDN);
        if (mpfr_zero_p(s->slope) || i > 0)
            status = difference(s);
        else
            status = CV_OK;
        if (status == CV_OK)
            status = iterate(s);
        mpfr_mul_2ui(s->scratch, s->im_error, clear, MPFR_RNDU);
        s->astray = status == CV_UNDECIDED && mpfr_cmpabs(s->f, s->scratch) > 0;
        if (!s->astray)
            break;
    }
    return status;
}

/* Sign of Im zeta at x + side * reach, 0 when not certain; Re zeta there in re. */
static cv_status side_sign(int *sign, mpfr_t re, solver *s, int side)
{
    mpfr_mul_si(s->scratch, s->reach, side, MPFR_RNDN);
    mpfr_add(s->scratch, s->scratch, s->x, MPFR_RNDN);
    cv_status status = evaluate(s, s->scratch);
    if (status != CV_OK)
        return status;
    *sign = mpfr_cmpabs(mpc_imagref(s->zeta), s->im_error) > 0 ? mpfr_sgn(mpc_imagref(s->zeta)) : 0;
    mpfr_set(re, mpc_realref(s->zeta), MPFR_RNDN);
    return CV_OK;
}

/* eta_M = 1 / mean Re zeta of both sides; bound: from one side to the other. */
static int mass_ratio(sa_line_vertex *out, solver *s, const mpfr_t low, const mpfr_t high)
{
    mpfr_add(out->eta_M, low, high, MPFR_RNDN);
    mpfr_div_2ui(out->eta_M, out->eta_M, 1, MPFR_RNDN);
    if (mpfr_zero_p(out->eta_M) && mpfr_zero_p(s->re_error)) { /* all waves, without damping: no mass */
        out->eta_M_error = 0;
        return 1;
    }
    if (mpfr_cmpabs(out->eta_M, s->re_error) <= 0)
        return 0;
    mpfr_sub(s->scratch, high, low, MPFR_RNDA);
    mpfr_abs(s->scratch, s->scratch, MPFR_RNDU);
    mpfr_add(s->scratch, s->scratch, s->re_error, MPFR_RNDU);
    mpfr_div(s->scratch, s->scratch, out->eta_M, MPFR_RNDA);
    mpfr_ui_div(out->eta_M, 1, out->eta_M, MPFR_RNDN);
    mpfr_mul(s->scratch, s->scratch, out->eta_M, MPFR_RNDA);
    mpfr_abs(s->scratch, s->scratch, MPFR_RNDU);
    out->eta_M_error = mpfr_get_d(s->scratch, MPFR_RNDU);
    return 1;
}

/* A proven change of sign within reach of x. */
static cv_status enclose(sa_line_vertex *out, int *rises, solver *s)
{
    mpfr_t low, high;
    int sign[2] = {0, 0};
    mpfr_inits2(mpfr_get_prec(s->x), low, high, (mpfr_ptr)0);
    cv_status status = side_sign(&sign[0], low, s, -1);
    if (status == CV_OK)
        status = side_sign(&sign[1], high, s, 1);
    if (status == CV_OK && (sign[0] * sign[1] >= 0 || !mass_ratio(out, s, low, high)))
        status = CV_UNDECIDED;
    if (status == CV_OK)
        *rises = sign[1];
    mpfr_clears(low, high, (mpfr_ptr)0);
    return status;
}

/* A start beyond double is next to a point that double does not resolve: nor does it the slope there. */
static int is_double(const mpfr_t x)
{
    return mpfr_min_prec(x) <= 53;
}

static cv_status attempt(sa_line_vertex *out, int *rises, solver *s, const mpfr_t exact_start, int digits)
{
    double re_x, im_x, re, start = mpfr_get_d(exact_start, MPFR_RNDN);
    cv_status status = slopes(&re_x, &im_x, &re, s, start);
    if (status != CV_OK)
        return status;
    /* eta_M must have the digits too */
    double scale = fmin(start, fabs(re / re_x)) / 8;
    mpfr_set_d(s->slope, is_double(exact_start) ? im_x : 0, MPFR_RNDN);
    mpfr_ui_pow_ui(s->reach, 10, (unsigned long)digits, MPFR_RNDU);
    mpfr_d_div(s->reach, scale > 0 ? scale : start / 8, s->reach, MPFR_RNDD);
    status = search(s, exact_start);
    if (status == CV_OK)
        status = enclose(out, rises, s);
    mpfr_set(s->which == SA_GIVEN_ALPHA ? out->q : out->alpha, s->x, MPFR_RNDN);
    *(s->which == SA_GIVEN_ALPHA ? &out->q_error : &out->alpha_error) = mpfr_get_d(s->reach, MPFR_RNDU);
    return status;
}

/* The start, of which no digit is claimed. */
static void give_up(sa_line_vertex *out, const solver *s, const mpfr_t start)
{
    mpfr_set(s->which == SA_GIVEN_ALPHA ? out->q : out->alpha, start, MPFR_RNDN);
    *(s->which == SA_GIVEN_ALPHA ? &out->q_error : &out->alpha_error) = mpfr_get_d(start, MPFR_RNDU);
    mpfr_set_ui(out->eta_M, 0, MPFR_RNDN);
    out->eta_M_error = INFINITY;
    out->decided = CV_UNDECIDED;
}

cv_status sa_line_point_from(sa_line_vertex *out, int *rises, sa_sweep *sweep, const sa_track *track,
                             sa_line_given which, const mpfr_t given, const mpfr_t start, int digits)
{
    const mpfr_prec_t guard = 56, most = SA_PRECISION_MAX + 4 * (mpfr_prec_t)digits;
    cv_status status = CV_UNDECIDED;
    *rises = 0;
    *out = (sa_line_vertex){.decided = CV_OK};
    mpfr_inits2(mpfr_get_prec(given), out->alpha, out->q, out->eta_M, (mpfr_ptr)0);
    if (!(mpfr_sgn(given) > 0) || !mpfr_number_p(given) || !(mpfr_sgn(start) > 0) || !mpfr_number_p(start))
        return CV_BAD_INPUT;
    mpfr_set(which == SA_GIVEN_ALPHA ? out->alpha : out->q, given, MPFR_RNDN);
    int astray = 0;
    for (mpfr_prec_t bits = digits * 10L / 3 + guard; status == CV_UNDECIDED && !astray && bits < most;
         bits += bits / 2) {
        solver s = {.track = track, .sweep = sweep, .which = which, .given = given};
        solver_init(&s, bits);
        mpfr_set_prec(which == SA_GIVEN_ALPHA ? out->q : out->alpha, bits);
        mpfr_set_prec(out->eta_M, bits);
        status = attempt(out, rises, &s, start, digits);
        if (status != CV_OK)
            give_up(out, &s, start);
        astray = s.astray;
        solver_clear(&s);
    }
    if (status == CV_OK)
        out->decided = CV_OK;
    return status == CV_UNDECIDED ? CV_OK : status;
}

cv_status sa_line_point(sa_line_vertex *out, int *rises, sa_sweep *sweep, const sa_track *track,
                        sa_line_given which, const mpfr_t given, double start, int digits)
{
    mpfr_t exact;
    mpfr_init2(exact, 53);
    mpfr_set_d(exact, start, MPFR_RNDN);
    cv_status status = sa_line_point_from(out, rises, sweep, track, which, given, exact, digits);
    mpfr_clear(exact);
    return status;
}

void sa_line_vertex_clear(sa_line_vertex *vertex)
{
    mpfr_clears(vertex->alpha, vertex->q, vertex->eta_M, (mpfr_ptr)0);
}
