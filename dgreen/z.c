#include "dgreen/z.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/follow.h"
#include "dgreen/residues.h"

static const double UNIT = DBL_EPSILON / 2;

cv_status dg_follow_new(dg_follow **out, cv_message *why)
{
    *out = calloc(1, sizeof **out);
    if (*out == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    (*out)->counters.largest_precision = DBL_MANT_DIG;
    mpfr_init2((*out)->alpha, DBL_MANT_DIG);
    mpc_init2((*out)->qbar, DBL_MANT_DIG);
    return CV_OK;
}

void dg_follow_free(dg_follow *f)
{
    if (f == NULL)
        return;
    for (int i = 0; i < DG_LADDER; i++)
        dg_mp_free(f->mp[i]);
    mpfr_clear(f->alpha);
    mpc_clear(f->qbar);
    dg_follow_row_clear(&f->here);
    dg_follow_row_clear(&f->before);
    free(f);
}

dg_counters dg_follow_counters(const dg_follow *f)
{
    return f->counters;
}

/* zeta = 4 qbar^2 sum R/Delta'(lambda) = -4 i w^2 sum R/(d Delta(i y)/dy), w = -i qbar. For real w (qbar = i
 * q) each part of zeta comes from one part of the sum. */
static void scale(dg_value *value, const dg_residue *sum, double complex qbar)
{
    const double w_re = cimag(qbar), w_im = -creal(qbar);
    const double f_re = 8 * w_re * w_im, f_im = -4 * (w_re - w_im) * (w_re + w_im);
    value->re = f_re * sum->re - f_im * sum->im;
    value->im = f_re * sum->im + f_im * sum->re;
    const double re = sum->error_re + 8 * fabs(sum->re), im = sum->error_im + 8 * fabs(sum->im);
    value->re_error = (fabs(f_re) * re + fabs(f_im) * im) * UNIT * (1 + 16 * UNIT);
    value->im_error = (fabs(f_re) * im + fabs(f_im) * re) * UNIT * (1 + 16 * UNIT);
}

static cv_status evaluate(dg_value *value, const dg_roots *roots, const dg_discs *discs,
                          const dg_operator *op, double complex qbar)
{
    dg_residues sums;
    const cv_status status = dg_residues_sum(&sums, op, roots, discs);
    if (status != CV_OK)
        return status;
    if (!dg_operator_count_fits(op, sums.right_count, sums.left_count))
        return CV_FAILED;
    scale(value, &sums.right, qbar);
    value->right_count = sums.right_count;
    return isfinite(value->re) && isfinite(value->im) ? CV_OK : CV_UNDECIDED;
}

/* Roots with discs: continued from the last point, or from nothing where that fails. Discs that meet after a
 * continuation are left to double-double: nearly always it is two roots too close for double. */
static cv_status find_roots(dg_follow *follow, dg_discs *discs, const dg_operator *op)
{
    dg_roots *roots = &follow->roots;
    if (follow->warm && dg_roots_polish(roots, op) == CV_OK)
        return dg_roots_enclose(discs, roots, op);
    follow->counters.cold_starts++;
    cv_status status = dg_roots_cold(roots, op);
    if (status == CV_OK)
        status = dg_roots_polish_cold(roots, op);
    follow->warm = status == CV_OK;
    return status == CV_OK ? dg_roots_enclose(discs, roots, op) : status;
}

cv_status dg_zeta_double(dg_value *value, dg_follow *follow, const dg_track *track, double alpha,
                         double complex qbar)
{
    if (!(alpha >= 0 && creal(qbar) >= 0))
        return CV_BAD_INPUT;
    dg_operator op;
    dg_discs discs;
    *value = (dg_value){0, 0, HUGE_VAL, HUGE_VAL, 0};
    dg_operator_set(&op, track, alpha, qbar);
    follow->counters.evaluations++;
    const int on_axis = creal(qbar) == 0 && cimag(qbar) > 0 && alpha > 0;
    if (on_axis)
        dg_follow_jump(follow, alpha, cimag(qbar));
    const cv_status status = find_roots(follow, &discs, &op);
    if (on_axis && follow->warm)
        dg_follow_note(follow, alpha, cimag(qbar));
    return status == CV_OK ? evaluate(value, &follow->roots, &discs, &op, qbar) : status;
}
