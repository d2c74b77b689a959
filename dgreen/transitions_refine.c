#include "dgreen/transitions_refine.h"

#include <math.h>

#include "dgreen/transitions_bracket.h"
#include "dgreen/z_mp.h"

#define RND MPFR_RNDN

enum { MORE_BITS = 64, MAX_EXTRA_BITS = 4096, GUARD_DIGITS = 8, INNER_ROUNDS = 8 };
/* First and largest half-width of the brackets, in units of the distance over which zeta changes. The inner
 * search knows its root ever better: from double; from one root nearby and the slope in double; from two. */
static const double FIRST_WIDTH = 1e-8, LAST_WIDTH = 0.2;
static const double INNER_WIDTH[3] = {1e-7, 1e-11, 1e-16}, SLOPE_ERROR = 1e-4;

typedef struct {
    const dg_track *track;
    const dg_find *find;
    const cv_number *mass_ratio;
    dg_effort *effort;
    mpfr_prec_t bits, most_bits; /* of evaluations; grows where signs stay open */
    mpc_t zeta;
    mpfr_t re_error, im_error, target; /* target = 1/eta_M */
    /* The outer variable is alpha and the inner one q; across a fold the other way round. */
    double slope, inner_scale, outer_scale; /* d inner/d outer; distances over which zeta changes */
    mpfr_srcptr at_outer;                   /* of the inner search */
    int known;                              /* inner roots found so far, at most two are kept */
    mpfr_t outer_known[2], inner_known[2];  /* before the first: what the double search says */
    mpfr_t centre, step;
    dg_bracket inner; /* value = Im zeta, aside = Re zeta - 1/eta_M, and its bounds */
    dg_bracket outer; /* value = Re zeta - 1/eta_M at the inner root, aside = inner variable and its bounds */
} refiner;

static void set_target(refiner *r)
{
    mpfr_set_prec(r->target, r->bits);
    cv_number_get_mpfr(r->target, r->mass_ratio);
    mpfr_ui_div(r->target, 1, r->target, RND);
}

/* zeta with a certified sign of its imaginary part */
static cv_status evaluate(refiner *r, mpfr_srcptr inner)
{
    mpfr_srcptr alpha = r->find->across ? inner : r->at_outer, q = r->find->across ? r->at_outer : inner;
    for (; r->bits <= r->most_bits; r->bits += MORE_BITS, set_target(r)) {
        const cv_status status = dg_zeta_mp(r->zeta, r->re_error, r->im_error, r->track, alpha, q, r->bits);
        r->effort->evaluations++;
        r->effort->above_double++;
        if (r->bits > r->effort->largest_precision)
            r->effort->largest_precision = r->bits;
        if (status == CV_OK && mpfr_cmpabs(r->im_error, mpc_imagref(r->zeta)) < 0)
            return CV_OK;
        if (status != CV_OK && status != CV_UNDECIDED)
            return status;
    }
    return CV_UNDECIDED;
}

/* Inner function: Im zeta at e->at. */
static cv_status imaginary_part(dg_end *e, void *context)
{
    refiner *r = context;
    const cv_status status = evaluate(r, e->at);
    if (status != CV_OK)
        return status;
    mpfr_set(e->value, mpc_imagref(r->zeta), RND);
    e->sign = mpfr_sgn(e->value) > 0 ? 1 : -1;
    mpfr_sub(e->aside, mpc_realref(r->zeta), r->target, RND);
    mpfr_mul_2si(e->aside_high, r->target, 2 - (long)r->bits,
                 MPFR_RNDU); /* rounding of target and difference */
    mpfr_add(r->re_error, r->re_error, e->aside_high, MPFR_RNDU);
    mpfr_sub(e->aside_low, e->aside, r->re_error, MPFR_RNDD);
    mpfr_add(e->aside_high, e->aside, r->re_error, MPFR_RNDU);
    return CV_OK;
}

/* Sign of Re zeta - 1/eta_M over the inner bracket: 0 when its ends do not certify one. */
static int excess_sign(const refiner *r)
{
    const dg_end *a = &r->inner.low, *b = &r->inner.high;
    if (mpfr_sgn(a->aside_low) > 0 && mpfr_sgn(b->aside_low) > 0)
        return 1;
    return mpfr_sgn(a->aside_high) < 0 && mpfr_sgn(b->aside_high) < 0 ? -1 : 0;
}

/* r->centre = where the inner root is expected: the line through what is known */
static void expect(refiner *r)
{
    mpfr_sub(r->centre, r->at_outer, r->outer_known[0], RND);
    mpfr_sub(r->step, r->outer_known[1], r->outer_known[0], RND);
    if (r->known < 2 || mpfr_zero_p(r->step)) {
        mpfr_mul_d(r->centre, r->centre, r->slope, RND);
    } else {
        mpfr_div(r->centre, r->centre, r->step, RND);
        mpfr_sub(r->step, r->inner_known[1], r->inner_known[0], RND);
        mpfr_mul(r->centre, r->centre, r->step, RND);
    }
    mpfr_add(r->centre, r->centre, r->inner_known[0], RND);
}

/* How wrong that may be */
static double inner_width(const refiner *r)
{
    mpfr_t step;
    double distance[2];
    mpfr_init2(step, 53);
    for (int i = 0; i < 2; i++) {
        mpfr_sub(step, r->at_outer, r->outer_known[i], RND);
        distance[i] = fabs(mpfr_get_d(step, RND));
    }
    mpfr_clear(step);
    double error = SLOPE_ERROR * fabs(r->slope) * distance[0];
    if (r->known == 2)
        error = fabs(r->slope) * distance[0] * distance[1] / r->outer_scale;
    return fmin(fmax(INNER_WIDTH[r->known] * r->inner_scale, error), LAST_WIDTH * r->inner_scale);
}

static void remember(refiner *r)
{
    mpfr_swap(r->outer_known[0], r->outer_known[1]);
    mpfr_swap(r->inner_known[0], r->inner_known[1]);
    mpfr_set(r->outer_known[0], r->at_outer, RND);
    mpfr_add(r->inner_known[0], r->inner.low.at, r->inner.high.at, RND);
    mpfr_div_2ui(r->inner_known[0], r->inner_known[0], 1, RND);
    r->known += r->known < 2;
}

/* Outer function: Re zeta - 1/eta_M at e->at and the inner variable with Im zeta = 0. */
static cv_status excess(dg_end *e, void *context)
{
    refiner *r = context;
    r->at_outer = e->at;
    expect(r);
    cv_status status = dg_bracket_open(&r->inner, r->centre, inner_width(r), LAST_WIDTH * r->inner_scale);
    e->sign = 0;
    for (int i = 0; i < INNER_ROUNDS && status == CV_OK && e->sign == 0; i++) {
        status = dg_bracket_close(&r->inner);
        e->sign = excess_sign(r);
        if (e->sign == 0)
            mpfr_div_ui(r->inner.tolerance, r->inner.tolerance, 10000, RND);
    }
    if (status == CV_OK && e->sign == 0)
        return CV_UNDECIDED;
    if (status != CV_OK)
        return status;
    remember(r);
    mpfr_add(e->value, r->inner.low.aside, r->inner.high.aside, RND);
    mpfr_div_2ui(e->value, e->value, 1, RND);
    mpfr_set(e->aside_low, r->inner.low.at, RND);
    mpfr_set(e->aside_high, r->inner.high.at, RND);
    return CV_OK;
}

/* Which variable is which, where the search begins, and how narrow the brackets must become */
static void set_variables(refiner *r, int digits)
{
    const dg_find *f = r->find;
    const double outer = f->across ? f->q : f->alpha, inner = f->across ? f->alpha : f->q;
    r->slope = f->across ? 1 / f->dq : f->dq;
    r->inner_scale = r->inner.scale = f->across ? f->reach : f->scale;
    r->outer_scale = r->outer.scale = f->across ? f->scale : f->reach;
    mpfr_set_d(r->outer_known[0], outer, RND);
    mpfr_set_d(r->inner_known[0], inner, RND);
    mpfr_set_ui(r->outer.tolerance, 10, RND);
    mpfr_pow_si(r->outer.tolerance, r->outer.tolerance, -digits, RND);
    mpfr_div_ui(r->outer.tolerance, r->outer.tolerance, 4, RND);
    mpfr_mul_d(r->inner.tolerance, r->outer.tolerance, 1e-8 * inner, RND);
    mpfr_mul_d(r->outer.tolerance, r->outer.tolerance, fmin(outer, inner / fmax(fabs(r->slope), 1)), RND);
}

static void refiner_init(refiner *r, const dg_track *track, dg_effort *effort, const dg_find *find,
                         const cv_number *mass_ratio, int digits)
{
    const double needed = (digits + 2 * GUARD_DIGITS) * 3.33;
    r->track = track;
    r->find = find;
    r->mass_ratio = mass_ratio;
    r->effort = effort;
    r->bits = 64 * ((mpfr_prec_t)needed / 64 + 1) - 1;
    r->most_bits = r->bits + MAX_EXTRA_BITS;
    mpc_init2(r->zeta, r->bits);
    mpfr_inits2(r->bits, r->re_error, r->im_error, r->target, r->centre, r->step, r->outer_known[0],
                r->outer_known[1], r->inner_known[0], r->inner_known[1], (mpfr_ptr)NULL);
    set_target(r);
    r->known = 0;
    dg_bracket_init(&r->inner, r->bits, imaginary_part, r);
    dg_bracket_init(&r->outer, r->bits, excess, r);
    set_variables(r, digits);
}

static void refiner_clear(refiner *r)
{
    dg_bracket_clear(&r->inner);
    dg_bracket_clear(&r->outer);
    mpc_clear(r->zeta);
    mpfr_clears(r->re_error, r->im_error, r->target, r->centre, r->step, r->outer_known[0], r->outer_known[1],
                r->inner_known[0], r->inner_known[1], (mpfr_ptr)NULL);
}

/* Middle of [low, high] and its half-width, rounded up to cover the rounding of the middle. */
static double middle(mpfr_t out, mpfr_srcptr low, mpfr_srcptr high)
{
    mpfr_t half;
    mpfr_init2(half, mpfr_get_prec(low));
    mpfr_set_prec(out, mpfr_get_prec(low));
    mpfr_add(out, low, high, RND);
    mpfr_div_2ui(out, out, 1, RND);
    mpfr_sub(half, high, low, MPFR_RNDU);
    const double error = 0.51 * mpfr_get_d(half, MPFR_RNDU);
    mpfr_clear(half);
    return error;
}

/* The bracket of the outer variable, and the hull of the inner ones at its two ends. */
static void report(dg_transition *out, refiner *r)
{
    dg_bracket *o = &r->outer;
    const int across = r->find->across;
    mpfr_min(o->trial.aside_low, o->low.aside_low, o->high.aside_low, RND);
    mpfr_max(o->trial.aside_high, o->low.aside_high, o->high.aside_high, RND);
    *(across ? &out->frequency_error : &out->alpha_error) =
        middle(across ? out->frequency : out->alpha, o->low.at, o->high.at);
    *(across ? &out->alpha_error : &out->frequency_error) =
        middle(across ? out->alpha : out->frequency, o->trial.aside_low, o->trial.aside_high);
}

static cv_status refine(dg_transition *out, dg_effort *effort, const dg_track *track, const dg_find *find,
                        const cv_number *mass_ratio, int digits)
{
    refiner r;
    refiner_init(&r, track, effort, find, mass_ratio, digits);
    const double unit = r.outer_scale;
    mpfr_set(r.outer.step, r.outer_known[0], RND);
    cv_status status = dg_bracket_open(&r.outer, r.outer.step, FIRST_WIDTH * unit, LAST_WIDTH * unit);
    if (status == CV_OK)
        status = dg_bracket_close(&r.outer);
    if (status == CV_OK) {
        report(out, &r);
    } else {
        mpfr_set_d(out->alpha, find->alpha, RND);
        mpfr_set_d(out->frequency, find->q, RND);
        out->alpha_error = LAST_WIDTH * find->reach;
        out->frequency_error = LAST_WIDTH * find->scale;
    }
    out->decided = status;
    refiner_clear(&r);
    return status;
}

cv_status dg_refine(dg_transition *out, dg_effort *effort, const dg_track *track, const dg_find *find,
                    const cv_number *mass_ratio, int digits)
{
    const cv_status status = refine(out, effort, track, find, mass_ratio, digits);
    if (status != CV_UNDECIDED)
        return status;
    dg_find other = *find; /* a fold nearer than the brackets are wide, or none */
    other.across = !find->across;
    return refine(out, effort, track, &other, mass_ratio, digits);
}
