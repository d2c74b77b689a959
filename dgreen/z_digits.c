/* dg_zeta_mp and dg_zeta_digits: one point, from nothing, to any number of digits. */
#include <math.h>

#include "dgreen/z_mp.h"

static const mpfr_rnd_t RND = MPFR_RNDN;
static const mpc_rnd_t CRND = MPC_RNDNN;

enum { EXTRA_BITS = 4096, FIRST_BITS = 127 };

/* A point and the result there, at one precision */
typedef struct {
    mpfr_prec_t precision;
    mpfr_t alpha;
    mpc_t qbar, zeta;
    mpfr_t error[2];
} point;

static void point_init(point *p, mpfr_prec_t precision)
{
    p->precision = precision;
    mpfr_init2(p->alpha, precision);
    mpc_init2(p->qbar, precision);
    mpc_init2(p->zeta, precision);
    mpfr_inits2(53, p->error[0], p->error[1], (mpfr_ptr)0);
}

static void point_clear(point *p)
{
    mpfr_clear(p->alpha);
    mpc_clear(p->qbar);
    mpc_clear(p->zeta);
    mpfr_clears(p->error[0], p->error[1], (mpfr_ptr)0);
}

static cv_status evaluate(point *p, const dg_track *track)
{
    dg_mp *w;
    cv_status status = dg_mp_new(&w, p->precision, NULL);
    if (status != CV_OK)
        return status;
    dg_constants constants;
    dg_constants_init(&constants, track, p->precision);
    dg_mp_value v;
    status = dg_mp_zeta(&v, w, track, &constants, p->alpha, p->qbar, NULL);
    if (status == CV_OK) {
        mpc_set_fr_fr(p->zeta, v.re, v.im, CRND);
        mpfr_set(p->error[0], v.re_error, MPFR_RNDU);
        mpfr_set(p->error[1], v.im_error, MPFR_RNDU);
    }
    dg_constants_clear(&constants);
    dg_mp_free(w);
    return status;
}

cv_status dg_zeta_mp(mpc_ptr zeta, mpfr_ptr re_error, mpfr_ptr im_error, const dg_track *track,
                     mpfr_srcptr alpha, mpfr_srcptr q, mpfr_prec_t bits)
{
    if (!(mpfr_sgn(alpha) >= 0))
        return CV_BAD_INPUT;
    point p;
    point_init(&p, bits);
    mpfr_set(p.alpha, alpha, RND);
    mpfr_set_zero(mpc_realref(p.qbar), 1);
    mpfr_set(mpc_imagref(p.qbar), q, RND);
    const cv_status status = evaluate(&p, track);
    if (status == CV_OK) {
        mpc_set_prec(zeta, bits);
        mpc_set(zeta, p.zeta, CRND);
        mpfr_set(re_error, p.error[0], MPFR_RNDU);
        mpfr_set(im_error, p.error[1], MPFR_RNDU);
    }
    point_clear(&p);
    return status;
}

/* error <= 2^-bits |part| */
static int is_right(mpfr_srcptr part, mpfr_ptr error, long bits)
{
    mpfr_mul_2si(error, error, bits, MPFR_RNDU);
    return mpfr_cmpabs(error, part) <= 0;
}

/* One precision: 1 when both parts are right to "bits" bits. */
static cv_status attempt(mpc_ptr zeta, int *done, const dg_track *track, const cv_number *alpha,
                         const cv_number *sigma, const cv_number *q, mpfr_prec_t precision, long bits)
{
    point p;
    point_init(&p, precision);
    cv_number_get_mpfr(p.alpha, alpha);
    cv_number_get_mpfr(mpc_imagref(p.qbar), q);
    if (sigma != NULL)
        cv_number_get_mpfr(mpc_realref(p.qbar), sigma);
    else
        mpfr_set_zero(mpc_realref(p.qbar), 1);
    const cv_status status = evaluate(&p, track);
    *done = status == CV_OK && is_right(mpc_realref(p.zeta), p.error[0], bits) &&
            is_right(mpc_imagref(p.zeta), p.error[1], bits);
    if (*done) {
        mpc_set_prec(zeta, precision);
        mpc_set(zeta, p.zeta, CRND);
    }
    point_clear(&p);
    return status;
}

/* The next precision: half as much again, one below a multiple of 64. */
static mpfr_prec_t next_precision(mpfr_prec_t precision)
{
    return (precision + precision / 2) / 64 * 64 + 63;
}

cv_status dg_zeta_digits(mpc_ptr zeta, const dg_track *track, const cv_number *alpha, const cv_number *sigma,
                         const cv_number *q, int digits, cv_message *why)
{
    if (cv_number_sign(alpha) < 0 || (sigma != NULL && cv_number_sign(sigma) < 0))
        return cv_fail(why, CV_BAD_INPUT, "alpha and the real part of qbar must not be negative");
    const long bits = (long)ceil((digits + 2) * 3.3219280949);
    for (mpfr_prec_t p = next_precision(FIRST_BITS / 2 + bits * 2 / 3); p <= bits + EXTRA_BITS;
         p = next_precision(p)) {
        int done;
        const cv_status status = attempt(zeta, &done, track, alpha, sigma, q, p, bits);
        if (done)
            return CV_OK;
        if (status != CV_OK && status != CV_UNDECIDED)
            return cv_fail(why, status,
                           "zeta: the count of roots or the sum of residues contradicts the theory");
    }
    return cv_fail(
        why, CV_UNDECIDED,
        "%d bits do not separate two roots of Delta or their half-planes: the point is a branch point "
        "(zeta is infinite there) or indistinguishable from one",
        (int)(bits + EXTRA_BITS));
}
