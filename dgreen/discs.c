/* dg_roots_enclose: inclusion discs in double. */
#include <float.h>
#include <math.h>

#include "dgreen/bounds.h"
#include "dgreen/lanes.h"

static const double UNIT = DBL_EPSILON / 2;

/* |Im y| below this part of |Re y| makes a root flat: the sizes of the parts together are then not much above
 * the size at |y|. */
static const double FLAT = 0.02;

/* Delta at the approximations, and the rounding errors of its parts (units) */
typedef struct {
    dg_lanes re, im, error_re, error_im;
} values;

/* Values, derivatives and sizes at all near roots */
DG_PART void sample_near(dg_discs *d, dg_separation *s, values *v, const dg_operator *op, const dg_ring *y)
{
    dg_lanes re = {{0}}, im = {{0}}, d_re = {{0}}, d_im = {{0}}, size = {{0}}, d_size = {{0}};
    for (int i = 0; i < DG_DEGREE; i++)
        s->modulus[i] = sqrt(y->re[i] * y->re[i] + y->im[i] * y->im[i]);
    for (int k = op->degree; k >= 0; k--) {
        const double c_re = op->re[k], c_im = op->im[k], c_size = op->size[k];
        for (int i = 0; i < DG_DEGREE; i++) {
            const double slope = d_re.of[i] * y->re[i] - d_im.of[i] * y->im[i] + re.of[i];
            d_im.of[i] = d_re.of[i] * y->im[i] + d_im.of[i] * y->re[i] + im.of[i];
            d_re.of[i] = slope;
            d_size.of[i] = d_size.of[i] * s->modulus[i] + size.of[i];
            const double value = re.of[i] * y->re[i] - im.of[i] * y->im[i] + c_re;
            im.of[i] = re.of[i] * y->im[i] + im.of[i] * y->re[i] + c_im;
            re.of[i] = value;
            size.of[i] = size.of[i] * s->modulus[i] + c_size;
        }
    }
    for (int i = 0; i < DG_DEGREE; i++) {
        d->d_re[i] = d_re.of[i];
        d->d_im[i] = d_im.of[i];
        s->value[i] = sqrt(re.of[i] * re.of[i] + im.of[i] * im.of[i]) / s->unit + DG_VALUE_UNITS * size.of[i];
        s->slope[i] = sqrt(d_re.of[i] * d_re.of[i] + d_im.of[i] * d_im.of[i]);
        s->slope_error[i] = DG_SLOPE_UNITS * d_size.of[i];
    }
    v->re = re;
    v->im = im;
}

/* Horner's rule for the sizes of the parts, at |x| + i |y| with every product taken positive. */
DG_PART void sample_parts(dg_discs *d, values *v, const dg_operator *op, const dg_ring *y)
{
    dg_lanes re = {{0}}, im = {{0}}, d_re = {{0}}, d_im = {{0}};
    for (int k = op->degree; k >= 0; k--) {
        const double c_re = op->size_re[k], c_im = op->size_im[k];
        for (int i = 0; i < DG_DEGREE; i++) {
            const double across = fabs(y->re[i]), up = fabs(y->im[i]);
            const double slope = d_re.of[i] * across + d_im.of[i] * up + re.of[i];
            d_im.of[i] = d_re.of[i] * up + d_im.of[i] * across + im.of[i];
            d_re.of[i] = slope;
            const double value = re.of[i] * across + im.of[i] * up + c_re;
            im.of[i] = re.of[i] * up + im.of[i] * across + c_im;
            re.of[i] = value;
        }
    }
    for (int i = 0; i < DG_DEGREE; i++) {
        v->error_re.of[i] = DG_VALUE_UNITS * re.of[i];
        v->error_im.of[i] = DG_VALUE_UNITS * im.of[i];
        d->rounding_re[i] = DG_SLOPE_UNITS * d_re.of[i];
        d->rounding_im[i] = DG_SLOPE_UNITS * d_im.of[i];
    }
}

/* The far root, in u */
static void sample_far(dg_discs *d, dg_separation *s, const dg_operator *op, const dg_roots *roots)
{
    const int last = s->count - 1, n = op->degree;
    const double complex u = CMPLX(roots->re[last], roots->im[last]);
    const double modulus = cabs(u);
    double complex value = 0, slope = 0;
    double size = 0, d_size = 0;
    for (int k = 0; k <= n; k++) {
        slope = slope * u + value;
        value = value * u + CMPLX(op->re[k], op->im[k]);
        d_size = d_size * modulus + size;
        size = size * modulus + op->size[k];
    }
    d->d_re[last] = creal(slope);
    d->d_im[last] = cimag(slope);
    s->modulus[last] = modulus;
    s->value[last] = cabs(value) / s->unit + DG_VALUE_UNITS * size;
    s->slope[last] = cabs(slope);
    s->slope_error[last] = DG_SLOPE_UNITS * d_size;
}

/* Distances, and the field: sum of 1/(y_i - y_k) */
DG_PART void meet(dg_discs *d, dg_separation *s, const dg_ring *y)
{
    dg_lanes field_re = {{0}}, field_im = {{0}};
    for (int k = 1; k < DG_DEGREE; k++)
        for (int i = 0; i < DG_DEGREE; i++) {
            const double dx = y->re[i] - y->re[i + k], dy = y->im[i] - y->im[i + k];
            const double norm = dx * dx + dy * dy;
            s->distance[k][i] = sqrt(norm);
            field_re.of[i] += dx / norm;
            field_im.of[i] -= dy / norm;
        }
    for (int i = 0; i < DG_DEGREE; i++) {
        d->field_re[i] = field_re.of[i];
        d->field_im[i] = field_im.of[i];
    }
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
DG_PART void imaginary_radii(dg_discs *d, const values *v)
{
    dg_lanes whole;
    for (int i = 0; i < DG_DEGREE; i++) {
        const double norm = d->d_re[i] * d->d_re[i] + d->d_im[i] * d->d_im[i], radius = d->radius[i] * UNIT;
        const double newton_im = fabs(v->im.of[i] * d->d_re[i] - v->re.of[i] * d->d_im[i]) / norm;
        const double across = (fabs(d->d_im[i]) + d->rounding_im[i] * UNIT) / norm;
        const double along = (fabs(d->d_re[i]) + d->rounding_re[i] * UNIT) / norm;
        const double first = newton_im + (v->error_im.of[i] * along + v->error_re.of[i] * across) * UNIT;
        const double second = radius * (d->d_error[i] * UNIT + 1.1 * radius * d->crowding[i]);
        whole.of[i] = (first * (1 + d->d_error[i] * UNIT * 3) + second) / UNIT;
    }
    for (int i = 0; i < DG_DEGREE; i++)
        d->radius_im[i] = d->flat[i] && whole.of[i] < d->radius[i] ? whole.of[i] : d->radius[i];
}

/* The field uses approximations of the others: each term is off by at most radius_k/(distance)^2, that of the
 * far root by 4 radius (|u y| < 1/2). */
DG_PART void field_errors(dg_discs *d, const dg_roots *r)
{
    double widest = 0;
    for (int k = 0; k < r->count - r->far; k++)
        widest = d->radius[k] > widest ? d->radius[k] : widest;
    const double far = r->far ? 4 * d->radius[r->count - 1] : 0;
    for (int i = 0; i < DG_DEGREE; i++)
        d->field_error[i] =
            (widest * d->crowding[i] * d->crowding[i] + far) * UNIT + 16 * UNIT * d->crowding[i];
}

DG_CLONES cv_status dg_roots_enclose(dg_discs *discs, const dg_roots *roots, const dg_operator *op)
{
    dg_separation s = {.count = roots->count, .far = roots->far, .unit = UNIT};
    values v;
    dg_ring y;
    const int near = s.count - s.far;
    dg_ring_set(&y, roots);
    sample_near(discs, &s, &v, op, &y);
    sample_parts(discs, &v, op, &y);
    meet(discs, &s, &y);
    if (s.far)
        sample_far(discs, &s, op, roots);
    for (int i = 0; i < DG_DEGREE; i++)
        discs->flat[i] = i < near && fabs(y.im[i]) < FLAT * fabs(y.re[i]);
    const cv_status status = dg_separate(discs->radius, discs->d_error, discs->crowding, &s);
    if (status != CV_OK)
        return status;
    if (roots->far)
        add_far_field(discs, roots);
    imaginary_radii(discs, &v);
    field_errors(discs, roots);
    return CV_OK;
}
