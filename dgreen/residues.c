#include "dgreen/residues.h"

#include <float.h>
#include <math.h>

#include "dgreen/bounds.h"

static const double UNIT = DBL_EPSILON / 2;

/* R(i y), or u^4 R(i/u) when reversed, with a bound of its difference from the value at the exact root, which
 * is at most radius (units) away. */
static inline dg_residue_sum numerator(const dg_operator *op, int reversed, double x, double y, double radius)
{
    double re = 0, im = 0, d_re = 0, d_im = 0, size = 0;
    const double reach = sqrt(x * x + y * y) + radius * UNIT;
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const int at = reversed ? DG_R_DEGREE - k : k;
        const double slope_re = d_re * x - d_im * y + re;
        d_im = d_re * y + d_im * x + im;
        d_re = slope_re;
        const double value_re = re * x - im * y + op->r_re[at];
        im = re * y + im * x + op->r_im[at];
        re = value_re;
        size = size * reach + op->r_size[at];
    }
    const double slope = sqrt(d_re * d_re + d_im * d_im);
    return (dg_residue_sum){re, im, dg_numerator_error(size, slope, reach, radius, UNIT)};
}

static inline dg_residue_sum quotient(dg_residue_sum top, double re, double im, double relative)
{
    const double norm = re * re + im * im;
    const double modulus = sqrt(top.re * top.re + top.im * top.im);
    return (dg_residue_sum){(top.re * re + top.im * im) / norm, (top.im * re - top.re * im) / norm,
                            dg_quotient_error(modulus, top.error, sqrt(norm), relative, UNIT)};
}

/* With u = 1/y the residue is -u^2 [u^4 R(i/u)]/[d/du u^8 Delta(i/u)]: of third order in u. */
static dg_residue_sum far_residue(const dg_operator *op, const dg_roots *roots, const dg_discs *discs, int i)
{
    const double x = roots->re[i], y = roots->im[i], radius = discs->radius[i];
    const dg_residue_sum top = numerator(op, 1, x, y, radius);
    const double reach = hypot(x, y) + radius * UNIT, modulus = hypot(top.re, top.im) + top.error * UNIT;
    const double u2_re = x * x - y * y, u2_im = 2 * x * y;
    const dg_residue_sum scaled = {-(u2_re * top.re - u2_im * top.im), -(u2_re * top.im + u2_im * top.re),
                                   reach * reach * top.error + 2 * reach * radius * modulus +
                                       8 * reach * reach * modulus};
    return quotient(scaled, discs->d_re[i], discs->d_im[i], discs->d_error[i]);
}

static inline void add(dg_residue_sum *sum, dg_residue_sum r)
{
    sum->re += r.re;
    sum->im += r.im;
    sum->error += r.error + 8 * (fabs(r.re) + fabs(r.im));
}

static void add_doubtful(dg_residues *out, dg_residue_sum r)
{
    const double size = hypot(r.re, r.im) / UNIT + r.error;
    out->right.error += size;
    out->left.error += size;
}

/* Re lambda = -Im y; Im(1/y) has the other sign. */
static int side(const dg_roots *roots, const dg_discs *discs, int i, int far)
{
    const double real_part = far ? roots->im[i] : -roots->im[i];
    if (!(fabs(real_part) > discs->radius[i] * UNIT))
        return 0;
    return real_part > 0 ? 1 : -1;
}

cv_status dg_residues_sum(dg_residues *out, const dg_operator *op, const dg_roots *roots,
                          const dg_discs *discs)
{
    *out = (dg_residues){0};
    for (int i = 0; i < roots->count; i++) {
        const int far = roots->far && i == roots->count - 1;
        const int to = side(roots, discs, i, far);
        if (to == 0 && !far)
            return CV_UNDECIDED;
        dg_residue_sum r;
        if (far) {
            r = far_residue(op, roots, discs, i);
        } else {
            const dg_residue_sum top = numerator(op, 0, roots->re[i], roots->im[i], discs->radius[i]);
            r = quotient(top, discs->d_re[i], discs->d_im[i], discs->d_error[i]);
        }
        if (to == 0) {
            add_doubtful(out, r);
            continue;
        }
        add(to > 0 ? &out->right : &out->left, r);
        out->right_count += to > 0;
        out->left_count += to < 0;
    }
    const double total = hypot(out->right.re + out->left.re, out->right.im + out->left.im);
    return total <= (out->right.error + out->left.error) * UNIT ? CV_OK : CV_FAILED;
}
