/* One point of an instability line to any number of digits. */
#include <math.h>

#include "dgreen/lines.h"
#include "dgreen/transitions_bracket.h"
#include "dgreen/z_mp.h"

#define RND MPFR_RNDN

enum { MORE_BITS = 64, MAX_EXTRA_BITS = 4096, GUARD_DIGITS = 8, ROUNDS = 8 };
/* First half-width of the bracket, part of the reach; digits that a round adds when eta_M is not yet good
 * enough */
static const double FIRST_WIDTH = 1e-5;
enum { MORE_DIGITS = 4 };

typedef struct {
    const dg_track *track;
    mpfr_srcptr fixed;
    int seek_alpha;    /* 1: the velocity is sought at a fixed frequency; 0: the other way round */
    mpfr_prec_t bits;  /* of evaluations; grows where signs stay open */
    mpfr_prec_t limit; /* of bits */
    mpc_t zeta;
    mpfr_t re_error, im_error;
    dg_bracket bracket; /* value = Im zeta, aside = Re zeta */
} seeker;

void dg_line_point_init(dg_line_point *p)
{
    mpfr_inits2(53, p->alpha, p->frequency, p->mass_ratio, (mpfr_ptr)NULL);
    p->alpha_error = p->frequency_error = p->mass_ratio_error = 0;
}

void dg_line_point_clear(dg_line_point *p)
{
    mpfr_clears(p->alpha, p->frequency, p->mass_ratio, (mpfr_ptr)NULL);
}

/* zeta at the free coordinate e->at, with as many bits as the sign of Im zeta needs */
static cv_status evaluate(dg_end *e, void *context)
{
    seeker *s = context;
    if (mpfr_sgn(e->at) <= 0)
        return CV_UNDECIDED;
    for (; s->bits <= s->limit; s->bits += MORE_BITS) {
        const cv_status status =
            dg_zeta_mp(s->zeta, s->re_error, s->im_error, s->track, s->seek_alpha ? e->at : s->fixed,
                       s->seek_alpha ? s->fixed : e->at, s->bits);
        if (status != CV_OK && status != CV_UNDECIDED)
            return status;
        if (status == CV_OK && mpfr_cmpabs(s->im_error, mpc_imagref(s->zeta)) < 0)
            break;
    }
    if (s->bits > s->limit)
        return CV_UNDECIDED;
    mpfr_set(e->value, mpc_imagref(s->zeta), RND);
    e->sign = mpfr_sgn(e->value) > 0 ? 1 : -1;
    mpfr_sub(e->aside_low, mpc_realref(s->zeta), s->re_error, MPFR_RNDD);
    mpfr_add(e->aside_high, mpc_realref(s->zeta), s->re_error, MPFR_RNDU);
    return CV_OK;
}

/* Middle of [low, high] at the precision of low, and its half-width rounded up */
static double middle(mpfr_ptr out, mpfr_srcptr low, mpfr_srcptr high)
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

/* eta_M = 1/Re zeta over the bracket. CV_UNDECIDED: Re zeta is not certainly positive */
static cv_status mass_ratio(dg_line_point *out, seeker *s)
{
    const dg_end *a = &s->bracket.low, *b = &s->bracket.high;
    mpfr_t least, most;
    mpfr_inits2(mpfr_get_prec(a->at), least, most, (mpfr_ptr)NULL);
    mpfr_min(least, a->aside_low, b->aside_low, MPFR_RNDD);
    mpfr_max(most, a->aside_high, b->aside_high, MPFR_RNDU);
    const int positive = mpfr_sgn(least) > 0;
    if (positive) {
        mpfr_ui_div(most, 1, most, MPFR_RNDD);
        mpfr_ui_div(least, 1, least, MPFR_RNDU);
        out->mass_ratio_error = middle(out->mass_ratio, most, least);
    }
    mpfr_clears(least, most, (mpfr_ptr)NULL);
    return positive ? CV_OK : CV_UNDECIDED;
}

static int good_enough(const dg_line_point *out, mpfr_srcptr tolerance)
{
    mpfr_t bound;
    mpfr_init2(bound, 53);
    mpfr_mul(bound, out->mass_ratio, tolerance, MPFR_RNDD);
    const int good = mpfr_cmp_d(bound, out->mass_ratio_error) >= 0;
    mpfr_clear(bound);
    return good;
}

/* Brackets the free coordinate around centre until both it and eta_M are good enough. */
static cv_status seek(dg_line_point *out, seeker *s, mpfr_srcptr start, double reach, int digits)
{
    const double centre = mpfr_get_d(start, RND);
    mpfr_t tolerance;
    mpfr_init2(tolerance, 53);
    mpfr_set_si(tolerance, 10, RND);
    mpfr_pow_si(tolerance, tolerance, -digits, MPFR_RNDD);
    mpfr_mul_d(s->bracket.tolerance, tolerance, centre - fmin(reach, centre / 2), MPFR_RNDD);
    cv_status status = dg_bracket_open(&s->bracket, start, FIRST_WIDTH * reach, reach);
    int done = 0;
    for (int i = 0; i < ROUNDS && status == CV_OK && !done; i++) {
        status = dg_bracket_close(&s->bracket);
        done = status == CV_OK && mass_ratio(out, s) == CV_OK && good_enough(out, tolerance);
        for (int k = 0; k < MORE_DIGITS; k++)
            mpfr_div_ui(s->bracket.tolerance, s->bracket.tolerance, 10, RND);
    }
    mpfr_clear(tolerance);
    return status == CV_OK && !done ? CV_UNDECIDED : status;
}

static cv_status find_point(dg_line_point *out, const dg_track *track, mpfr_srcptr fixed, int seek_alpha,
                            mpfr_srcptr centre, double reach, int digits, cv_message *why)
{
    if (!(mpfr_sgn(fixed) > 0 && mpfr_sgn(centre) > 0 && reach > 0))
        return cv_fail(why, CV_BAD_INPUT, "a point of a line needs alpha, q and reach above zero");
    seeker s = {.track = track, .fixed = fixed, .seek_alpha = seek_alpha};
    s.bits = 64 * ((mpfr_prec_t)((digits + 2 * GUARD_DIGITS) * 3.33) / 64 + 1) - 1;
    if (s.bits < mpfr_get_prec(fixed))
        s.bits = mpfr_get_prec(fixed); /* so that it is used exactly */
    if (s.bits < mpfr_get_prec(centre))
        s.bits = mpfr_get_prec(centre);
    s.limit = s.bits + MAX_EXTRA_BITS;
    mpc_init2(s.zeta, s.bits);
    mpfr_inits2(s.bits, s.re_error, s.im_error, (mpfr_ptr)NULL);
    dg_bracket_init(&s.bracket, s.bits, evaluate, &s);
    s.bracket.scale = reach;
    const cv_status status = seek(out, &s, centre, reach, digits);
    if (status == CV_OK) {
        mpfr_ptr given = seek_alpha ? out->frequency : out->alpha;
        mpfr_set_prec(given, mpfr_get_prec(fixed));
        mpfr_set(given, fixed, RND);
        *(seek_alpha ? &out->frequency_error : &out->alpha_error) = 0;
        const double error =
            middle(seek_alpha ? out->alpha : out->frequency, s.bracket.low.at, s.bracket.high.at);
        *(seek_alpha ? &out->alpha_error : &out->frequency_error) = error;
    }
    dg_bracket_clear(&s.bracket);
    mpc_clear(s.zeta);
    mpfr_clears(s.re_error, s.im_error, (mpfr_ptr)NULL);
    if (status == CV_OK)
        return CV_OK;
    return cv_fail(why, status, "no point of a line found at %s = %.17g, %s within %.3g of %.17g",
                   seek_alpha ? "q" : "alpha", mpfr_get_d(fixed, RND), seek_alpha ? "alpha" : "q", reach,
                   mpfr_get_d(centre, RND));
}

cv_status dg_line_at_alpha(dg_line_point *out, const dg_track *track, mpfr_srcptr alpha, mpfr_srcptr q,
                           double reach, int digits, cv_message *why)
{
    return find_point(out, track, alpha, 0, q, reach, digits, why);
}

cv_status dg_line_at_frequency(dg_line_point *out, const dg_track *track, mpfr_srcptr q, mpfr_srcptr alpha,
                               double reach, int digits, cv_message *why)
{
    return find_point(out, track, q, 1, alpha, reach, digits, why);
}
