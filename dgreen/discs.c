/* dg_roots_enclose: inclusion discs in double. */
#include <float.h>
#include <math.h>

#include "dgreen/bounds.h"
#include "dgreen/roots.h"

static const double UNIT = DBL_EPSILON / 2;

/* |Im y| below this part of |Re y| makes a root flat: the sizes of the parts together are then not much above
 * the size at |y|. */
static const double FLAT = 0.02;

/* Rounding errors of the parts of Delta (units), and Delta itself */
typedef struct {
    double re, im, error_re, error_im;
} value;

static inline value sample(dg_discs *discs, dg_separation *s, const dg_operator *op, int i, int reversed,
                           double x, double y)
{
    const int n = op->degree;
    double re = 0, im = 0, d_re = 0, d_im = 0, size = 0, d_size = 0;
    const double modulus = sqrt(x * x + y * y);
    for (int k = n; k >= 0; k--) {
        const int at = reversed ? n - k : k;
        const double slope_re = d_re * x - d_im * y + re;
        d_im = d_re * y + d_im * x + im;
        d_re = slope_re;
        d_size = d_size * modulus + size;
        const double value_re = re * x - im * y + op->re[at];
        im = re * y + im * x + op->im[at];
        re = value_re;
        size = size * modulus + op->size[at];
    }
    discs->d_re[i] = d_re;
    discs->d_im[i] = d_im;
    s->modulus[i] = modulus;
    s->value[i] = sqrt(re * re + im * im) / s->unit + DG_VALUE_UNITS * size;
    s->slope[i] = sqrt(d_re * d_re + d_im * d_im);
    s->slope_error[i] = DG_SLOPE_UNITS * d_size;
    return (value){re, im, 0, 0};
}

/* Horner's rule for the sizes of the parts, at |x| + i |y| with every product taken positive. */
static inline void sample_parts(dg_discs *discs, value *v, const dg_operator *op, int i, double x, double y)
{
    double re = 0, im = 0, d_re = 0, d_im = 0;
    for (int k = op->degree; k >= 0; k--) {
        const double slope_re = d_re * x + d_im * y + re;
        d_im = d_re * y + d_im * x + im;
        d_re = slope_re;
        const double value_re = re * x + im * y + op->size_re[k];
        im = re * y + im * x + op->size_im[k];
        re = value_re;
    }
    v->error_re = DG_VALUE_UNITS * re;
    v->error_im = DG_VALUE_UNITS * im;
    discs->rounding_re[i] = DG_SLOPE_UNITS * d_re;
    discs->rounding_im[i] = DG_SLOPE_UNITS * d_im;
}

/* Distances, and the field 1/(y_i - y_k) with its reaction */
static inline void meet(dg_discs *discs, dg_separation *s, const dg_roots *r, int i, int k)
{
    const double dx = r->re[i] - r->re[k], dy = r->im[i] - r->im[k], norm = dx * dx + dy * dy;
    const double field_re = dx / norm, field_im = -dy / norm;
    s->distance[i][k] = s->distance[k][i] = sqrt(norm);
    discs->field_re[i] += field_re;
    discs->field_im[i] += field_im;
    discs->field_re[k] -= field_re;
    discs->field_im[k] -= field_im;
}

/* 1/(y - 1/u) = u/(u y - 1) */
static void add_far_field(dg_discs *discs, const dg_roots *r)
{
    const int near = r->count - 1;
    const double complex u = CMPLX(r->re[near], r->im[near]);
    for (int i = 0; i < near; i++) {
        const double complex field = u / (u * CMPLX(r->re[i], r->im[i]) - 1);
        discs->field_re[i] += creal(field);
        discs->field_im[i] += cimag(field);
    }
}

/* With N = f/f' at the approximation, y* - y = -N (1 + k), |k| <= |N| crowding/(1 - ...). N is the computed
 * quotient plus e/f' - N e'/f', e and e' the rounding errors of f and f'; the last term is of second order,
 * and so is k N. */
static double imaginary_radius(const dg_discs *d, const value *v, int i)
{
    const double norm = d->d_re[i] * d->d_re[i] + d->d_im[i] * d->d_im[i], radius = d->radius[i] * UNIT;
    const double newton_im = fabs(v->im * d->d_re[i] - v->re * d->d_im[i]) / norm;
    const double across = (fabs(d->d_im[i]) + d->rounding_im[i] * UNIT) / norm;
    const double along = (fabs(d->d_re[i]) + d->rounding_re[i] * UNIT) / norm;
    const double first = newton_im + (v->error_im * along + v->error_re * across) * UNIT;
    const double second = radius * (d->d_error[i] * UNIT + 1.1 * radius * d->crowding[i]);
    return fmin((first * (1 + d->d_error[i] * UNIT * 3) + second) / UNIT, d->radius[i]);
}

/* The field uses approximations of the others: each term is off by at most radius_k/(distance)^2, that of the
 * far root by 4 radius (|u y| < 1/2). */
static double field_error(const dg_discs *d, const dg_roots *r, int i)
{
    double widest = 0;
    for (int k = 0; k < r->count - r->far; k++)
        widest = fmax(widest, d->radius[k]);
    const double far = r->far ? 4 * d->radius[r->count - 1] : 0;
    return (widest * d->crowding[i] * d->crowding[i] + far) * UNIT + 16 * UNIT * d->crowding[i];
}

cv_status dg_roots_enclose(dg_discs *discs, const dg_roots *roots, const dg_operator *op)
{
    dg_separation s;
    value values[DG_DEGREE];
    s.count = roots->count;
    s.far = roots->far;
    s.unit = UNIT;
    const int near = s.count - s.far;
    for (int i = 0; i < s.count; i++) {
        const double x = roots->re[i], y = roots->im[i];
        values[i] = sample(discs, &s, op, i, i >= near, x, y);
        discs->flat[i] = i < near && fabs(y) < FLAT * fabs(x);
        discs->field_re[i] = discs->field_im[i] = 0;
        if (discs->flat[i])
            sample_parts(discs, &values[i], op, i, fabs(x), fabs(y));
        for (int k = 0; k < i && i < near; k++)
            meet(discs, &s, roots, i, k);
    }
    const cv_status status = dg_separate(discs->radius, discs->d_error, discs->crowding, &s);
    if (status != CV_OK)
        return status;
    if (roots->far)
        add_far_field(discs, roots);
    for (int i = 0; i < s.count; i++) {
        discs->radius_im[i] = discs->flat[i] ? imaginary_radius(discs, &values[i], i) : discs->radius[i];
        discs->field_error[i] = discs->flat[i] ? field_error(discs, roots, i) : 0;
    }
    return CV_OK;
}
