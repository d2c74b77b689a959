#include "dgreen/z_dd.h"

#include <math.h>

#include "dgreen/bounds.h"
#include "dgreen/roots_dd.h"

/* Sums of residues over Re lambda > 0 (right) and < 0 (left), errors in units */
typedef struct {
    dg_dd_complex right, left;
    double right_error, left_error;
    int right_count, left_count;
} sums;

/* R(i y_i), or u^4 R(i/u) for the far root, and the bound of its error (units) */
static dg_dd_complex numerator(double *error, const dg_dd_operator *op, const dg_dd_roots *roots, int i,
                               int far)
{
    const dg_dd_complex y = roots->y[i];
    dg_dd_complex top = op->r[far ? 0 : DG_R_DEGREE];
    for (int k = DG_R_DEGREE - 1; k >= 0; k--)
        top = dg_dd_complex_add(dg_dd_complex_mul(top, y), op->r[far ? DG_R_DEGREE - k : k]);
    const double reach = dg_dd_modulus(y) + roots->radius[i] * DG_DD_UNIT;
    const dg_r_size s = dg_r_size_at(&op->rounded, far, y.re.hi, y.im.hi, reach);
    *error = dg_numerator_error(s.size, s.slope, reach, roots->radius[i], DG_DD_UNIT);
    return top;
}

/* The residue of root i and the bound of its error (units); that of the far root is -u^2 [u^4 R(i/u)]/[d/du
 * u^8 Delta(i/u)]. */
static dg_dd_complex residue(double *error, const dg_dd_operator *op, const dg_dd_roots *roots, int i,
                             int far)
{
    dg_dd_complex top = numerator(error, op, roots, i, far);
    if (far) {
        const dg_dd_complex u = roots->y[i];
        const double reach = dg_dd_modulus(u) + roots->radius[i] * DG_DD_UNIT;
        const double modulus = dg_dd_modulus(top) + *error * DG_DD_UNIT;
        *error = reach * reach * (*error + 8 * modulus) + 2 * reach * roots->radius[i] * modulus;
        top = dg_dd_complex_scale(dg_dd_complex_mul(top, dg_dd_complex_mul(u, u)), (dg_dd){-1, 0});
    }
    *error = dg_quotient_error(dg_dd_modulus(top), *error, dg_dd_modulus(roots->slope[i]),
                               roots->slope_relative[i], DG_DD_UNIT);
    return dg_dd_complex_div(top, roots->slope[i]);
}

/* 1: Re lambda > 0; -1: < 0; 0: the disc meets the axis. Re lambda = -Im y, and Im(1/y) has the other sign.
 */
static int side(const dg_dd_roots *roots, int i, int far)
{
    const double im = roots->y[i].im.hi;
    if (!(fabs(im) > roots->radius[i] * DG_DD_UNIT * (1 + 0x1p-40)))
        return 0;
    return (im < 0) != far ? 1 : -1;
}

static void add_to(sums *s, int right, dg_dd_complex r, double error)
{
    dg_dd_complex *sum = right ? &s->right : &s->left;
    *sum = dg_dd_complex_add(*sum, r);
    *(right ? &s->right_error : &s->left_error) += error + 16 * dg_dd_modulus(r);
    *(right ? &s->right_count : &s->left_count) += 1;
}

static cv_status sum_residues(sums *s, const dg_dd_operator *op, const dg_dd_roots *roots)
{
    *s = (sums){0};
    for (int i = 0; i < roots->count; i++) {
        const int far = roots->far && i == roots->count - 1, to = side(roots, i, far);
        if (to == 0 && !far)
            return CV_UNDECIDED;
        double error;
        const dg_dd_complex r = residue(&error, op, roots, i, far);
        if (to != 0) {
            add_to(s, to > 0, r, error);
            continue;
        }
        const double whole = dg_dd_modulus(r) / DG_DD_UNIT + error;
        s->right_error += whole;
        s->left_error += whole;
    }
    /* the sum of all residues is 0 */
    const double rest = dg_dd_modulus(dg_dd_complex_add(s->left, s->right)) / DG_DD_UNIT;
    return rest <= s->left_error + s->right_error ? CV_OK : CV_FAILED;
}

/* part = a x + b y in double; the bound for factors and sums within a few units, x and y off by "units" */
static double part(double *error, dg_dd a, dg_dd x, dg_dd b, dg_dd y, double units)
{
    const double value = dg_dd_add(dg_dd_mul(a, x), dg_dd_mul(b, y)).hi;
    const double spread = fabs(a.hi) * (units + 32 * fabs(x.hi)) + fabs(b.hi) * (units + 32 * fabs(y.hi));
    *error = spread * DG_DD_UNIT * (1 + 0x1p-40) + 0x1p-52 * fabs(value);
    return value;
}

/* zeta = 4 i qbar^2 sum; for qbar = i q each part comes from one part of the sum. */
static cv_status scale(dg_value *value, const sums *s, double complex qbar)
{
    dg_value v = {.right_count = s->right_count};
    const dg_dd_complex q = {{creal(qbar), 0}, {cimag(qbar), 0}}, square = dg_dd_complex_mul(q, q);
    const dg_dd re = dg_dd_scale(square.im, -4), im = dg_dd_scale(square.re, 4);
    v.re = part(&v.re_error, re, s->right.re, dg_dd_negative(im), s->right.im, s->right_error);
    v.im = part(&v.im_error, re, s->right.im, im, s->right.re, s->right_error);
    if (cimag(qbar) == 0) /* Delta has real coefficients in lambda */
        v.im = v.im_error = 0;
    if (!(isfinite(v.re) && isfinite(v.im) && isfinite(v.re_error) && isfinite(v.im_error)))
        return CV_UNDECIDED;
    *value = v;
    return CV_OK;
}

static void round_roots(dg_roots *to, const dg_dd_roots *roots)
{
    for (int i = 0; i < roots->count; i++) {
        to->re[i] = roots->y[i].re.hi;
        to->im[i] = roots->y[i].im.hi;
    }
}

cv_status dg_dd_zeta(dg_value *value, dg_roots *roots, const dg_track *track, double alpha,
                     double complex qbar)
{
    dg_dd_operator op;
    dg_dd_roots found;
    sums s;
    cv_status status = dg_dd_operator_set(&op, track, alpha, qbar);
    if (status == CV_OK && roots->far != dg_roots_far_form(&op.rounded))
        return CV_UNDECIDED;
    if (status == CV_OK)
        status = dg_dd_roots_find(&found, &op, roots);
    if (status == CV_OK)
        status = sum_residues(&s, &op, &found);
    if (status == CV_OK && !dg_operator_count_fits(&op.rounded, s.right_count, s.left_count))
        status = CV_FAILED;
    if (status != CV_OK)
        return status;
    round_roots(roots, &found);
    return scale(value, &s, qbar);
}
