/* dg_zeta_adaptive: double first, then double-double, then the ladder of precisions. */
#include <math.h>

#include "dgreen/follow.h"
#include "dgreen/z_dd.h"

static const double UNIT = 0x1p-53;

/* error <= tolerance |part|; an infinite tolerance takes anything */
static int part_is_good(double part, double error, double tolerance)
{
    return isinf(tolerance) || error <= tolerance * fabs(part);
}

static int good_enough(const dg_value *v, double tol_re, double tol_im)
{
    return part_is_good(v->re, v->re_error, tol_re) && part_is_good(v->im, v->im_error, tol_im);
}

static void round_value(dg_value *value, const dg_mp_value *v)
{
    value->re = mpfr_get_d(v->re, MPFR_RNDN);
    value->im = mpfr_get_d(v->im, MPFR_RNDN);
    value->re_error = mpfr_get_d(v->re_error, MPFR_RNDU) + 1.001 * UNIT * fabs(value->re);
    value->im_error = mpfr_get_d(v->im_error, MPFR_RNDU) + 1.001 * UNIT * fabs(value->im);
    value->right_count = v->right_count;
}

static void note_precision(dg_follow *f, int bits)
{
    if (f->counters.largest_precision < bits)
        f->counters.largest_precision = bits;
}

/* In double-double: from the roots of the last point, and where two of those have become one, from nothing.
 */
static cv_status twofold(dg_value *value, dg_follow *f, const dg_track *track, double alpha,
                         double complex qbar)
{
    dg_operator op;
    cv_status status = CV_UNDECIDED;
    note_precision(f, DG_DD_BITS);
    if (f->warm)
        status = dg_dd_zeta(value, &f->roots, track, alpha, qbar);
    if (status != CV_UNDECIDED)
        return status;
    dg_operator_set(&op, track, alpha, qbar);
    f->counters.cold_starts++;
    f->warm = dg_roots_cold(&f->roots, &op) == CV_OK;
    return f->warm ? dg_dd_zeta(value, &f->roots, track, alpha, qbar) : status;
}

/* With as many bits as that rung of the ladder has. */
static cv_status climb(dg_value *value, dg_follow *f, const dg_track *track, int rung)
{
    if (f->mp[rung] == NULL && dg_mp_new(&f->mp[rung], dg_ladder[rung], NULL) != CV_OK)
        return CV_FAILED;
    note_precision(f, (int)dg_ladder[rung]);
    dg_mp_value v;
    const cv_status status = dg_mp_zeta(&v, f->mp[rung], track, &track->ladder[rung], f->alpha, f->qbar,
                                        f->warm && rung == 0 ? &f->roots : NULL);
    if (status == CV_OK)
        round_value(value, &v);
    return status;
}

cv_status dg_zeta_above_double(dg_value *value, dg_follow *follow, const dg_track *track, double alpha,
                               double complex qbar, double tol_re, double tol_im)
{
    cv_status status = CV_UNDECIDED;
    follow->counters.above_double++;
    if (track->damped || creal(qbar) > 0)
        status = twofold(value, follow, track, alpha, qbar);
    mpfr_set_d(follow->alpha, alpha, MPFR_RNDN);
    mpc_set_d_d(follow->qbar, creal(qbar), cimag(qbar), MPC_RNDNN);
    for (int rung = 0; rung <= DG_LADDER; rung++) {
        if (status == CV_OK && good_enough(value, tol_re, tol_im))
            return CV_OK;
        if (status != CV_OK && status != CV_UNDECIDED)
            return status;
        if (rung < DG_LADDER)
            status = climb(value, follow, track, rung);
    }
    return CV_UNDECIDED;
}

cv_status dg_zeta_adaptive(dg_value *value, dg_follow *follow, const dg_track *track, double alpha,
                           double complex qbar, double tol_re, double tol_im)
{
    const cv_status status = dg_zeta_double(value, follow, track, alpha, qbar);
    if (status == CV_OK && good_enough(value, tol_re, tol_im))
        return CV_OK;
    if (status != CV_OK && status != CV_UNDECIDED)
        return status;
    return dg_zeta_above_double(value, follow, track, alpha, qbar, tol_re, tol_im);
}
