#include "dgreen/residues.h"

#include <float.h>
#include <math.h>

#include "dgreen/bounds.h"

static const double UNIT = DBL_EPSILON / 2;

/* R and R' at an approximation. size: size polynomial at "reach", a bound of |y*|. */
typedef struct {
    double re, im, slope_re, slope_im, size;
} sample;

static inline sample sample_r(const dg_operator *op, int reversed, double x, double y, double reach)
{
    sample s = {0, 0, 0, 0, 0};
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const int at = reversed ? DG_R_DEGREE - k : k;
        const double slope_re = s.slope_re * x - s.slope_im * y + s.re;
        s.slope_im = s.slope_re * y + s.slope_im * x + s.im;
        s.slope_re = slope_re;
        const double value_re = s.re * x - s.im * y + op->r_re[at];
        s.im = s.re * y + s.im * x + op->r_im[at];
        s.re = value_re;
        s.size = s.size * reach + op->r_size[at];
    }
    return s;
}

static inline double modulus(double re, double im)
{
    return sqrt(re * re + im * im);
}

/* top/(derivative of root i); top is off by at most top_error (units) */
static inline dg_residue quotient(double re, double im, double top_error, const dg_discs *d, int i)
{
    const double d_re = d->d_re[i], d_im = d->d_im[i], norm = d_re * d_re + d_im * d_im;
    const double error = dg_quotient_error(modulus(re, im), top_error, sqrt(norm), d->d_error[i], UNIT);
    return (dg_residue){(re * d_re + im * d_im) / norm, (im * d_re - re * d_im) / norm, error, error};
}

static dg_residue plain_residue(const dg_operator *op, const dg_roots *roots, const dg_discs *d, int i)
{
    const double x = roots->re[i], y = roots->im[i], reach = modulus(x, y) + d->radius[i] * UNIT;
    const sample s = sample_r(op, 0, x, y, reach);
    const double slope = modulus(s.slope_re, s.slope_im);
    return quotient(s.re, s.im, dg_numerator_error(s.size, slope, reach, d->radius[i], UNIT), d, i);
}

/* With u = 1/y the residue is -u^2 [u^4 R(i/u)]/[d/du u^8 Delta(i/u)]: of third order in u. */
static dg_residue far_residue(const dg_operator *op, const dg_roots *roots, const dg_discs *d, int i)
{
    const double x = roots->re[i], y = roots->im[i], radius = d->radius[i];
    const double reach = modulus(x, y) + radius * UNIT;
    const sample s = sample_r(op, 1, x, y, reach);
    const double slope = modulus(s.slope_re, s.slope_im);
    const double top_error = dg_numerator_error(s.size, slope, reach, radius, UNIT);
    const double top = modulus(s.re, s.im) + top_error * UNIT;
    const double u2_re = x * x - y * y, u2_im = 2 * x * y;
    const double error = reach * reach * (top_error + 8 * top) + 2 * reach * radius * top;
    return quotient(-(u2_re * s.re - u2_im * s.im), -(u2_re * s.im + u2_im * s.re), error, d, i);
}

/* A complex number, or the bounds of the errors of its parts */
typedef struct {
    double re, im;
} pair;

static inline pair times(pair a, pair b)
{
    return (pair){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/* error += what errors of the parts of one factor do to the parts of a product */
static inline void spread(pair *error, pair parts, pair factor)
{
    error->re += parts.re * fabs(factor.re) + parts.im * fabs(factor.im);
    error->im += parts.re * fabs(factor.im) + parts.im * fabs(factor.re);
}

/* Rounding of the parts of R at a flat root */
static inline pair rounding_of_r(const dg_operator *op, double x, double y)
{
    pair sum = {0, 0};
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const double next = sum.re * x + sum.im * y + op->r_size_re[k];
        sum.im = sum.re * y + sum.im * x + op->r_size_im[k];
        sum.re = next;
    }
    return (pair){DG_R_UNITS * sum.re, DG_R_UNITS * sum.im};
}

/* Everything that can be wrong with f', R, E and d of flat_residue, relative to itself, times itself (units)
 */
static inline double second_order(const dg_discs *d, int i, const sample *s, pair r, pair top, double reach)
{
    const double slope = modulus(d->d_re[i], d->d_im[i]), whole = modulus(r.re, r.im);
    const double radius = d->radius[i], absolute = radius * UNIT, crowding = d->crowding[i];
    const double relative =
        (d->d_error[i] + 16) * UNIT + d->field_error[i] / crowding + 3 * absolute * crowding;
    const double movement = radius * (2 * crowding * whole + modulus(s->slope_re, s->slope_im) / slope);
    const double rounding = (top.re + top.im + (d->rounding_re[i] + d->rounding_im[i]) * whole) / slope;
    const double curvature = s->size * absolute / (reach * slope) * (6 * radius / reach + 8 * DG_R_UNITS);
    const double product = absolute * crowding * radius * crowding * whole;
    return 3 * (movement + rounding) * relative + 2 * curvature + 2.5 * product;
}

/* A flat root, parts apart. With d = y - y*, E = sum of 1/(y - y_k*), x = |d| crowding <= 0.05:
 *     R(y*)      = R - R' d + e,                        |e| <= 6 size/reach^2 |d|^2
 *     1/f'(y*)   = (1/f') (1 + 2 d E + e'),             |e'| <= 2.5 x^2          (products of differences)
 * hence the residue is r + d (2 E r - R'/f') + rounding + terms of second order in d and the rounding. */
static inline dg_residue flat_residue(const dg_operator *op, const dg_roots *roots, const dg_discs *d, int i)
{
    const double x = roots->re[i], y = roots->im[i], reach = modulus(x, y) + d->radius[i] * UNIT;
    const double norm = d->d_re[i] * d->d_re[i] + d->d_im[i] * d->d_im[i];
    const sample s = sample_r(op, 0, x, y, reach);
    const pair top = rounding_of_r(op, fabs(x), fabs(y));
    const pair inverse = {d->d_re[i] / norm, -d->d_im[i] / norm}; /* 1/f' */
    const pair r = times((pair){s.re, s.im}, inverse);
    const pair field = times((pair){2 * d->field_re[i], 2 * d->field_im[i]}, r);
    const pair slope = times((pair){s.slope_re, s.slope_im}, inverse);

    pair error = {0, 0};
    spread(&error, (pair){d->radius[i], d->radius_im[i]}, (pair){field.re - slope.re, field.im - slope.im});
    spread(&error, top, inverse);
    spread(&error, (pair){d->rounding_re[i], d->rounding_im[i]}, times(r, inverse));
    spread(&error, (pair){8 * fabs(s.re), 8 * fabs(s.im)}, inverse);
    const double second = second_order(d, i, &s, r, top, reach);
    return (dg_residue){r.re, r.im, error.re + second, error.im + second};
}

static inline void add(dg_residue *sum, dg_residue r)
{
    sum->re += r.re;
    sum->im += r.im;
    sum->error_re += r.error_re + 8 * fabs(r.re);
    sum->error_im += r.error_im + 8 * fabs(r.im);
}

static void add_doubtful(dg_residues *out, dg_residue r)
{
    const double size = modulus(r.re, r.im) / UNIT + r.error_re;
    out->right.error_re += size;
    out->right.error_im += size;
    out->left.error_re += size;
    out->left.error_im += size;
}

/* Re lambda = -Im y; Im(1/y) has the other sign. */
static inline int side(const dg_roots *roots, const dg_discs *discs, int i, int far)
{
    const double real_part = far ? roots->im[i] : -roots->im[i];
    if (!(fabs(real_part) > discs->radius_im[i] * UNIT))
        return 0;
    return real_part > 0 ? 1 : -1;
}

static int balanced(const dg_residues *s)
{
    return fabs(s->right.re + s->left.re) <= (s->right.error_re + s->left.error_re) * UNIT &&
           fabs(s->right.im + s->left.im) <= (s->right.error_im + s->left.error_im) * UNIT;
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
        const dg_residue r = far              ? far_residue(op, roots, discs, i)
                             : discs->flat[i] ? flat_residue(op, roots, discs, i)
                                              : plain_residue(op, roots, discs, i);
        if (to == 0) {
            add_doubtful(out, r);
            continue;
        }
        add(to > 0 ? &out->right : &out->left, r);
        out->right_count += to > 0;
        out->left_count += to < 0;
    }
    return balanced(out) ? CV_OK : CV_FAILED;
}
