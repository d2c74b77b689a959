#include "dgreen/z_mp.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/residues_mp.h"

static const mpc_rnd_t CRND = MPC_RNDNN;

struct dg_mp {
    dg_mp_operator op;
    dg_mp_roots roots;
    dg_mp_residues sums;
    mpc_t factor, zeta;
    mpfr_t error[2], part; /* re, im */
};

cv_status dg_mp_new(dg_mp **out, mpfr_prec_t precision, cv_message *why)
{
    dg_mp *w = calloc(1, sizeof *w);
    *out = w;
    if (w == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    dg_mp_operator_init(&w->op, precision);
    dg_mp_roots_init(&w->roots, precision);
    dg_mp_residues_init(&w->sums, precision);
    mpc_init2(w->factor, precision);
    mpc_init2(w->zeta, precision);
    mpfr_inits2(53, w->error[0], w->error[1], w->part, (mpfr_ptr)0);
    return CV_OK;
}

void dg_mp_free(dg_mp *w)
{
    if (w == NULL)
        return;
    dg_mp_operator_clear(&w->op);
    dg_mp_roots_clear(&w->roots);
    dg_mp_residues_clear(&w->sums);
    mpc_clear(w->factor);
    mpc_clear(w->zeta);
    mpfr_clears(w->error[0], w->error[1], w->part, (mpfr_ptr)0);
    free(w);
}

/* error += |factor| * (units of the sum's error + 32 units of the sum itself), in absolute terms */
static void add_error(dg_mp *w, int part, mpfr_srcptr factor, mpfr_srcptr sum, double units)
{
    const mpfr_prec_t precision = w->op.precision;
    mpfr_mul_2si(w->part, sum, 5, MPFR_RNDA);
    mpfr_abs(w->part, w->part, MPFR_RNDU);
    mpfr_add_d(w->part, w->part, units, MPFR_RNDU);
    mpfr_div_2si(w->part, w->part, (long)precision, MPFR_RNDU);
    mpfr_mul(w->part, w->part, factor, MPFR_RNDA);
    mpfr_abs(w->part, w->part, MPFR_RNDU);
    mpfr_add(w->error[part], w->error[part], w->part, MPFR_RNDU);
}

/* zeta = 4 i qbar^2 sum; for qbar = i q each part comes from one part of the sum. */
static void scale(dg_mp *w, mpc_srcptr qbar)
{
    const dg_mp_residues *s = &w->sums;
    mpc_sqr(w->factor, qbar, CRND);
    mpc_mul_i(w->factor, w->factor, 1, CRND);
    mpc_mul_ui(w->factor, w->factor, 4, CRND);
    mpc_mul(w->zeta, w->factor, s->right, CRND);
    mpfr_srcptr f_re = mpc_realref(w->factor), f_im = mpc_imagref(w->factor);
    mpfr_set_zero(w->error[0], 1);
    mpfr_set_zero(w->error[1], 1);
    add_error(w, 0, f_re, mpc_realref(s->right), s->re_error);
    add_error(w, 0, f_im, mpc_imagref(s->right), s->im_error);
    add_error(w, 1, f_re, mpc_imagref(s->right), s->im_error);
    add_error(w, 1, f_im, mpc_realref(s->right), s->re_error);
    if (mpfr_zero_p(mpc_imagref(qbar))) { /* Delta has real coefficients in lambda */
        mpfr_set_zero(mpc_imagref(w->zeta), 1);
        mpfr_set_zero(w->error[1], 1);
    }
}

/* Roots in double from nothing: polished where double can. */
static cv_status cold_start(dg_roots *start, const dg_operator *op)
{
    const cv_status status = dg_roots_cold(start, op);
    dg_roots polished = *start;
    if (status == CV_OK && dg_roots_polish_cold(&polished, op) == CV_OK)
        *start = polished;
    return status;
}

static cv_status find_roots(dg_mp *w, const dg_roots *start, int on_axis)
{
    const dg_operator *op = &w->op.rounded;
    if (start != NULL && start->count == op->degree && start->far == dg_roots_far_form(op))
        return dg_mp_roots_find(&w->roots, &w->op, start, on_axis);
    dg_roots cold;
    const cv_status status = cold_start(&cold, op);
    return status == CV_OK ? dg_mp_roots_find(&w->roots, &w->op, &cold, on_axis) : status;
}

cv_status dg_mp_zeta(dg_mp_value *value, dg_mp *w, const dg_track *track, const dg_constants *constants,
                     mpfr_srcptr alpha, mpc_srcptr qbar, const dg_roots *start)
{
    const int undamped = !track->damped && mpfr_zero_p(mpc_realref(qbar));
    dg_mp_operator_set(&w->op, track, constants, alpha, qbar);
    cv_status status = find_roots(w, start, undamped);
    if (status == CV_OK)
        status = undamped ? dg_mp_residues_sum_undamped(&w->sums, &w->op, &w->roots, alpha)
                          : dg_mp_residues_sum(&w->sums, &w->op, &w->roots);
    if (status == CV_OK && !dg_operator_count_fits(&w->op.rounded, w->sums.right_count, w->sums.left_count))
        status = CV_FAILED;
    if (status != CV_OK)
        return status;
    scale(w, qbar);
    *value = (dg_mp_value){mpc_realref(w->zeta), mpc_imagref(w->zeta), w->error[0], w->error[1],
                           w->sums.right_count};
    return CV_OK;
}
