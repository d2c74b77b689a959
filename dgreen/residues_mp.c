#include "dgreen/residues_mp.h"

#include <math.h>

#include "dgreen/bounds.h"

static const mpfr_rnd_t RND = MPFR_RNDN;
static const mpc_rnd_t CRND = MPC_RNDNN;

void dg_mp_residues_init(dg_mp_residues *r, mpfr_prec_t precision)
{
    mpc_init2(r->right, precision);
    mpc_init2(r->left, precision);
    mpc_init2(r->residue, precision);
    mpc_init2(r->top, precision);
    for (int i = 0; i < 4; i++)
        mpfr_init2(r->t[i], precision);
}

void dg_mp_residues_clear(dg_mp_residues *r)
{
    mpc_clear(r->right);
    mpc_clear(r->left);
    mpc_clear(r->residue);
    mpc_clear(r->top);
    for (int i = 0; i < 4; i++)
        mpfr_clear(r->t[i]);
}

/* r->top = R(i y_i), or u^4 R(i/u) for the far root; returns the bound of its error (units) */
static double numerator(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots, int i, int far)
{
    mpc_set(r->top, op->r.c[far ? 0 : DG_R_DEGREE], CRND);
    for (int k = DG_R_DEGREE - 1; k >= 0; k--)
        dg_mp_horner(r->top, roots->y[i], op->r.c[far ? DG_R_DEGREE - k : k], r->t);
    const double x = mpfr_get_d(mpc_realref(roots->y[i]), RND), y = mpfr_get_d(mpc_imagref(roots->y[i]), RND);
    const double reach = hypot(x, y) + roots->radius[i] * roots->unit;
    const dg_r_size s = dg_r_size_at(&op->rounded, far, x, y, reach);
    return dg_numerator_error(s.size, s.slope, reach, roots->radius[i], roots->unit);
}

/* r->residue = residue of root i; returns the bound of its error (units). With u = 1/y the residue of the far
 * root is -u^2 [u^4 R(i/u)]/[d/du u^8 Delta(i/u)]. */
static double residue(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots, int i)
{
    const int far = roots->far && i == roots->count - 1;
    double error = numerator(r, op, roots, i, far);
    if (far) {
        const double reach = dg_mp_modulus(roots->y[i]) + roots->radius[i] * roots->unit;
        const double modulus = dg_mp_modulus(r->top) + error * roots->unit;
        error = reach * reach * error + 2 * reach * roots->radius[i] * modulus + 8 * reach * reach * modulus;
        mpc_mul(r->top, r->top, roots->y[i], CRND);
        mpc_mul(r->top, r->top, roots->y[i], CRND);
        mpc_neg(r->top, r->top, CRND);
    }
    mpc_div(r->residue, r->top, roots->slope[i], CRND);
    return dg_quotient_error(dg_mp_modulus(r->top), error, dg_mp_modulus(roots->slope[i]),
                             roots->slope_relative[i], roots->unit);
}

/* 1: Re lambda > 0; -1: < 0; 0: the disc meets the axis. Re lambda = -Im y, and Im(1/y) has the other sign.
 */
static int side(const dg_mp_roots *roots, int i)
{
    const int far = roots->far && i == roots->count - 1;
    mpfr_srcptr im = mpc_imagref(roots->y[i]);
    long exponent;
    const double mantissa = mpfr_get_d_2exp(&exponent, im, RND);
    const double units = ldexp(fabs(mantissa), (int)(exponent + roots->precision));
    if (!(units > roots->radius[i]))
        return 0;
    return (mpfr_sgn(im) < 0) != far ? 1 : -1;
}

static void reset(dg_mp_residues *r)
{
    r->right_count = r->left_count = 0;
    r->re_error = r->im_error = 0;
    mpc_set_ui(r->right, 0, CRND);
    mpc_set_ui(r->left, 0, CRND);
}

/* Adds the residue of root i to one of the sums; error: of left and right */
static void add_to(dg_mp_residues *r, double error[2], const dg_mp_operator *op, const dg_mp_roots *roots,
                   int i, int right)
{
    const double own = residue(r, op, roots, i);
    mpc_ptr sum = right ? r->right : r->left;
    mpc_add(sum, sum, r->residue, CRND);
    error[right] += own + 16 * dg_mp_modulus(r->residue);
    r->right_count += right;
    r->left_count += !right;
}

/* The sum of all residues is 0. */
static cv_status check_sums(dg_mp_residues *r, const double error[2], const dg_mp_roots *roots)
{
    mpc_add(r->left, r->left, r->right, CRND);
    r->re_error = r->im_error = error[1];
    return dg_mp_units(r->left, roots->precision) <= error[0] + error[1] ? CV_OK : CV_FAILED;
}

cv_status dg_mp_residues_sum(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots)
{
    double error[2] = {0, 0}; /* left, right */
    reset(r);
    for (int i = 0; i < roots->count; i++) {
        const int to = side(roots, i), far = roots->far && i == roots->count - 1;
        if (to == 0 && !far)
            return CV_UNDECIDED;
        if (to == 0) {
            const double own = residue(r, op, roots, i);
            const double whole = dg_mp_units(r->residue, roots->precision) + own;
            error[0] += whole;
            error[1] += whole;
            continue;
        }
        add_to(r, error, op, roots, i, to > 0);
    }
    return check_sums(r, error, roots);
}

cv_status dg_mp_residues_sum_chosen(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots,
                                    unsigned chosen)
{
    double error[2] = {0, 0};
    reset(r);
    for (int i = 0; i < roots->count; i++)
        add_to(r, error, op, roots, i, (int)(chosen >> i & 1u));
    return check_sums(r, error, roots);
}

/* Sign of t = q - alpha y at the real root i, 0 where its interval leaves it open. For the far root
 * t u = q u - alpha. */
static int doppler_sign(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots, int i,
                        mpfr_srcptr alpha)
{
    const int far = roots->far && i == roots->count - 1;
    mpfr_srcptr q = mpc_realref(op->w), y = mpc_realref(roots->y[i]);
    mpfr_mul(r->t[0], far ? q : alpha, y, RND);
    mpfr_sub(r->t[1], far ? r->t[0] : q, far ? alpha : r->t[0], RND);
    const double scale = fabs(mpfr_get_d(q, RND)) + mpfr_get_d(alpha, RND);
    const double error = (scale + 1) * (roots->radius[i] + 8 * fabs(mpfr_get_d(y, RND)) + 8) * roots->unit;
    if (!(fabs(mpfr_get_d(r->t[1], RND)) > error))
        return 0;
    if (!far)
        return mpfr_sgn(r->t[1]);
    if (!(fabs(mpfr_get_d(y, RND)) > roots->radius[i] * roots->unit))
        return 0;
    return mpfr_sgn(r->t[1]) * mpfr_sgn(y);
}

/* The real root i: adds sign(t) |residue| to the real part of right. */
static cv_status add_real(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots, int i,
                          mpfr_srcptr alpha)
{
    const double own = residue(r, op, roots, i);
    const int far = roots->far && i == roots->count - 1, sign = doppler_sign(r, op, roots, i, alpha);
    mpfr_ptr re = mpc_realref(r->residue);
    const double units = dg_mp_units(r->residue, roots->precision);
    if (sign == 0 || !(units > own)) {
        r->re_error += units + own;
        return far ? CV_OK : CV_UNDECIDED;
    }
    const int right = sign * mpfr_sgn(re) > 0;
    r->right_count += right;
    r->left_count += !right;
    r->re_error += own + 16 * dg_mp_modulus(r->residue);
    mpfr_abs(re, re, RND);
    if (sign > 0)
        mpfr_add(mpc_realref(r->right), mpc_realref(r->right), re, RND);
    else
        mpfr_sub(mpc_realref(r->right), mpc_realref(r->right), re, RND);
    return CV_OK;
}

cv_status dg_mp_residues_sum_undamped(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots,
                                      mpfr_srcptr alpha)
{
    r->right_count = r->left_count = 0;
    r->re_error = r->im_error = 0;
    mpc_set_ui(r->right, 0, CRND);
    for (int i = 0; i < roots->count; i++) {
        if (mpfr_zero_p(mpc_imagref(roots->y[i]))) {
            const cv_status status = add_real(r, op, roots, i, alpha);
            if (status != CV_OK)
                return status;
            continue;
        }
        const int to = side(roots, i);
        if (to == 0)
            return CV_UNDECIDED;
        r->right_count += to > 0;
        r->left_count += to < 0;
        if (to < 0)
            continue;
        r->im_error += residue(r, op, roots, i) + 16 * dg_mp_modulus(r->residue);
        mpfr_add(mpc_imagref(r->right), mpc_imagref(r->right), mpc_imagref(r->residue), RND);
    }
    mpfr_div_2ui(mpc_realref(r->right), mpc_realref(r->right), 1, RND);
    r->re_error /= 2;
    return CV_OK;
}
