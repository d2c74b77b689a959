#include "dgreen/operator_mp.h"

#include <complex.h>

static const mpfr_rnd_t RND = MPFR_RNDN;
static const mpc_rnd_t CRND = MPC_RNDNN;

enum { POLYNOMIALS = 9 };

static void list(dg_mp_polynomial *all[POLYNOMIALS], dg_mp_operator *op)
{
    dg_mp_polynomial *each[POLYNOMIALS] = {&op->delta,   &op->r,          &op->beam, &op->pad,  &op->sleeper,
                                           &op->ballast, &op->foundation, &op->c,    &op->inner};
    for (int i = 0; i < POLYNOMIALS; i++)
        all[i] = each[i];
}

void dg_mp_operator_init(dg_mp_operator *op, mpfr_prec_t precision)
{
    dg_mp_polynomial *all[POLYNOMIALS];
    list(all, op);
    for (int i = 0; i < POLYNOMIALS; i++)
        for (int k = 0; k <= DG_DEGREE; k++)
            mpc_init2(all[i]->c[k], precision);
    mpc_init2(op->w, precision);
    mpc_init2(op->w2, precision);
    mpc_init2(op->product, precision);
    mpfr_init2(op->coefficient, precision);
    op->precision = precision;
}

void dg_mp_operator_clear(dg_mp_operator *op)
{
    dg_mp_polynomial *all[POLYNOMIALS];
    list(all, op);
    for (int i = 0; i < POLYNOMIALS; i++)
        for (int k = 0; k <= DG_DEGREE; k++)
            mpc_clear(all[i]->c[k]);
    mpc_clear(op->w);
    mpc_clear(op->w2);
    mpc_clear(op->product);
    mpfr_clear(op->coefficient);
}

static void set_zero(dg_mp_polynomial *p, int degree)
{
    for (int k = 0; k <= degree; k++)
        mpc_set_ui(p->c[k], 0, CRND);
}

static void add(dg_mp_polynomial *sum, const dg_mp_polynomial *a, int degree)
{
    for (int k = 0; k <= degree; k++)
        mpc_add(sum->c[k], sum->c[k], a->c[k], CRND);
}

/* sum += a * b */
static void add_product(dg_mp_operator *op, dg_mp_polynomial *sum, const dg_mp_polynomial *a, int degree_a,
                        const dg_mp_polynomial *b, int degree_b)
{
    for (int i = 0; i <= degree_a; i++)
        for (int j = 0; j <= degree_b; j++) {
            mpc_mul(op->product, a->c[i], b->c[j], CRND);
            mpc_add(sum->c[i + j], sum->c[i + j], op->product, CRND);
        }
}

/* p = mass s^2 with s = i (w - alpha y), plus nothing else: degree 2 */
static void set_inertia(dg_mp_operator *op, dg_mp_polynomial *p, mpfr_srcptr mass, mpfr_srcptr alpha)
{
    mpc_mul_fr(p->c[0], op->w2, mass, CRND);
    mpc_neg(p->c[0], p->c[0], CRND);
    mpfr_mul(op->coefficient, mass, alpha, RND);
    mpc_mul_fr(p->c[1], op->w, op->coefficient, CRND);
    mpc_mul_ui(p->c[1], p->c[1], 2, CRND);
    mpfr_mul(op->coefficient, op->coefficient, alpha, RND);
    mpfr_neg(op->coefficient, op->coefficient, RND);
    mpc_set_fr(p->c[2], op->coefficient, CRND);
}

/* p += 2 eta s: degree 1 */
static void add_damping(dg_mp_operator *op, dg_mp_polynomial *p, mpfr_srcptr eta, mpfr_srcptr alpha)
{
    if (mpfr_zero_p(eta))
        return;
    mpc_mul_fr(op->product, op->w, eta, CRND);
    mpc_mul_i(op->product, op->product, 1, CRND);
    mpc_mul_ui(op->product, op->product, 2, CRND);
    mpc_add(p->c[0], p->c[0], op->product, CRND);
    mpfr_mul(op->coefficient, eta, alpha, RND);
    mpfr_mul_ui(op->coefficient, op->coefficient, 2, RND);
    mpfr_sub(mpc_imagref(p->c[1]), mpc_imagref(p->c[1]), op->coefficient, RND);
}

static void set_spring(dg_mp_operator *op, dg_mp_polynomial *p, mpfr_srcptr kappa, mpfr_srcptr eta,
                       mpfr_srcptr alpha)
{
    set_zero(p, 1);
    mpfr_set(mpc_realref(p->c[0]), kappa, RND);
    add_damping(op, p, eta, alpha);
}

static void set_beam(dg_mp_operator *op, const dg_constants *k, mpfr_srcptr alpha)
{
    mpc_mul_ui(op->beam.c[0], op->w2, 4, CRND);
    mpc_neg(op->beam.c[0], op->beam.c[0], CRND);
    mpc_mul_fr(op->beam.c[1], op->w, alpha, CRND);
    mpc_mul_ui(op->beam.c[1], op->beam.c[1], 8, CRND);
    mpfr_sqr(op->coefficient, alpha, RND);
    mpfr_add(op->coefficient, op->coefficient, k->value[DG_ETA_N], RND);
    mpfr_mul_si(op->coefficient, op->coefficient, -4, RND);
    mpc_set_fr(op->beam.c[2], op->coefficient, CRND);
    mpc_set_ui(op->beam.c[3], 0, CRND);
    mpc_set_ui(op->beam.c[4], 1, CRND);
}

/* The entries of (17) as polynomials, struck out as dgreen/operator.h says */
static void set_entries(dg_mp_operator *op, const dg_constants *k, mpfr_srcptr alpha)
{
    set_beam(op, k, alpha);
    set_spring(op, &op->pad, k->value[DG_KAPPA_P], k->value[DG_ETA_P], alpha);
    set_spring(op, &op->ballast, k->value[DG_KAPPA_B], k->value[DG_ETA_B], alpha);
    set_inertia(op, &op->sleeper, k->value[DG_MU_S], alpha);
    set_inertia(op, &op->foundation, k->value[DG_MU_B], alpha);
    mpc_add_ui(op->foundation.c[0], op->foundation.c[0], 1, CRND);
    add_damping(op, &op->foundation, k->value[DG_ETA_F], alpha);
    mpc_add_fr(op->foundation.c[2], op->foundation.c[2], k->value[DG_ETA_S], CRND);
}

static void round_coefficients(double *re, double *im, const dg_mp_polynomial *p, int degree)
{
    for (int k = 0; k <= degree; k++) {
        re[k] = mpfr_get_d(mpc_realref(p->c[k]), RND);
        im[k] = mpfr_get_d(mpc_imagref(p->c[k]), RND);
    }
}

/* The sizes come from double, all else from the exact coefficients: a0 may be 0 in double arithmetic only. */
static void round_operator(dg_mp_operator *op, const dg_constants *k, mpfr_srcptr alpha)
{
    round_coefficients(op->rounded.re, op->rounded.im, &op->delta, DG_DEGREE);
    round_coefficients(op->rounded.r_re, op->rounded.r_im, &op->r, DG_R_DEGREE);
    if (mpfr_zero_p(alpha))
        return;
    mpfr_sqr(op->coefficient, alpha, RND);
    mpfr_mul(op->coefficient, op->coefficient, k->value[DG_MU_B], RND);
    const double sum = mpfr_get_d(op->coefficient, RND) + mpfr_get_d(k->value[DG_ETA_S], RND);
    mpfr_sub(op->coefficient, op->coefficient, k->value[DG_ETA_S], RND);
    op->rounded.relative_a0 = mpfr_get_d(op->coefficient, RND) / sum;
}

void dg_mp_operator_set(dg_mp_operator *op, const dg_track *track, const dg_constants *constants,
                        mpfr_srcptr alpha, mpc_srcptr qbar)
{
    const double complex point =
        CMPLX(mpfr_get_d(mpc_realref(qbar), RND), mpfr_get_d(mpc_imagref(qbar), RND));
    dg_operator_set(&op->rounded, track, mpfr_get_d(alpha, RND), point);
    mpc_mul_i(op->w, qbar, -1, CRND);
    mpc_sqr(op->w2, op->w, CRND);
    set_entries(op, constants, alpha);

    set_zero(&op->c, 2);
    add(&op->c, &op->foundation, 2);
    add(&op->c, &op->ballast, 1);
    set_zero(&op->inner, 4);
    add_product(op, &op->inner, &op->sleeper, 2, &op->c, 2);
    add_product(op, &op->inner, &op->ballast, 1, &op->foundation, 2);
    set_zero(&op->r, 4);
    add(&op->r, &op->inner, 4);
    add_product(op, &op->r, &op->pad, 1, &op->c, 2);
    set_zero(&op->delta, DG_DEGREE);
    add_product(op, &op->delta, &op->pad, 1, &op->inner, 4);
    for (int i = 0; i <= DG_DEGREE; i++)
        mpc_mul_ui(op->delta.c[i], op->delta.c[i], 4, CRND);
    add_product(op, &op->delta, &op->beam, 4, &op->r, 4);
    round_operator(op, constants, alpha);
}
