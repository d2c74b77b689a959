#include "dgreen/roots_dd.h"

#include <math.h>

#include "dgreen/bounds.h"

enum { MAX_SWEEPS = 30 };
/* After a step this small, relative to the distance to the nearest root, the error left is below DG_DD_UNIT:
 * of third order, and 2^-52 of the step, which is computed in double. For the far root of second order. */
static const double SETTLED = 0x1p-48, FAR_SETTLED = 0x1p-52;
/* Sizes of Delta at a root between which no operation on the way there loses digits by under- or overflow */
static const double LEAST = 1e-200, MOST = 1e200;

typedef struct {
    dg_dd_complex value, slope;
} sample;

/* value and slope of Delta(i y) at y, or of the reversed polynomial */
static sample evaluate(const dg_dd_operator *op, int n, dg_dd_complex y, int reversed)
{
    sample s = {op->delta[reversed ? 0 : n], op->delta[reversed ? 0 : n]};
    for (int k = n - 1; k >= 0; k--) {
        if (k < n - 1)
            s.slope = dg_dd_complex_add(dg_dd_complex_mul(s.slope, y), s.value);
        s.value = dg_dd_complex_add(dg_dd_complex_mul(s.value, y), op->delta[reversed ? n - k : k]);
    }
    return s;
}

static double complex rounded(dg_dd_complex a)
{
    return CMPLX(a.re.hi, a.im.hi);
}

static double complex difference(dg_dd_complex a, dg_dd_complex b)
{
    return CMPLX(dg_dd_add(a.re, dg_dd_negative(b.re)).hi, dg_dd_add(a.im, dg_dd_negative(b.im)).hi);
}

/* sum over k != i of 1/(y_i - y_k), the far root included: it multiplies f/f', so that double is enough. */
static double complex repulsion(const dg_dd_roots *r, int i, double *nearest)
{
    const int near = r->count - r->far;
    double complex sum = 0;
    *nearest = 0;
    for (int k = 0; k < near; k++) {
        if (k == i)
            continue;
        const double complex d = difference(r->y[i], r->y[k]);
        const double inverse = 1 / sqrt(creal(d) * creal(d) + cimag(d) * cimag(d));
        if (!isfinite(inverse))
            continue; /* coinciding starts: the discs will meet */
        sum += conj(d) * (inverse * inverse);
        *nearest = fmax(*nearest, inverse);
    }
    if (r->far) {
        const double complex u = rounded(r->y[near]);
        sum += u / (u * rounded(r->y[i]) - 1);
    }
    return sum;
}

static void move(dg_dd_complex *y, double complex step)
{
    y->re = dg_dd_add(y->re, (dg_dd){-creal(step), 0});
    y->im = dg_dd_add(y->im, (dg_dd){-cimag(step), 0});
}

/* One update f/(f' - f A); returns 1 when the root is settled. */
static int update(dg_dd_roots *r, const dg_dd_operator *op, int i)
{
    double nearest;
    const double complex a = repulsion(r, i, &nearest);
    const sample s = evaluate(op, r->count, r->y[i], 0);
    const double complex f = rounded(s.value), step = f / (rounded(s.slope) - f * a);
    move(&r->y[i], step);
    return cabs(step) * nearest < SETTLED;
}

static int update_far(dg_dd_roots *r, const dg_dd_operator *op)
{
    const int last = r->count - 1;
    const sample s = evaluate(op, r->count, r->y[last], 1);
    const double complex step = rounded(s.value) / rounded(s.slope);
    move(&r->y[last], step);
    return cabs(step) * dg_dd_modulus(op->delta[6]) < FAR_SETTLED * dg_dd_modulus(op->delta[7]);
}

static void iterate(dg_dd_roots *r, const dg_dd_operator *op)
{
    const int near = r->count - r->far;
    int moving = r->count, settled[DG_DEGREE] = {0};
    for (int sweep = 0; sweep < MAX_SWEEPS && moving > 0; sweep++)
        for (int i = 0; i < r->count; i++) {
            if (settled[i])
                continue;
            settled[i] = i < near ? update(r, op, i) : update_far(r, op);
            moving -= settled[i];
        }
}

/* Fills what dg_separate wants to know about root i; 0: out of range. */
static int measure(dg_separation *s, dg_dd_roots *r, const dg_dd_operator *op, int i, int far)
{
    const sample at = evaluate(op, r->count, r->y[i], far);
    const double modulus = dg_dd_modulus(r->y[i]), *sizes = op->rounded.size;
    double size = 0, slope_size = 0;
    for (int k = r->count; k >= 0; k--) {
        slope_size = slope_size * modulus + size;
        size = size * modulus + sizes[far ? r->count - k : k];
    }
    r->slope[i] = at.slope;
    s->modulus[i] = modulus;
    s->value[i] = dg_dd_modulus(at.value) / s->unit + DG_VALUE_UNITS * size;
    s->slope[i] = dg_dd_modulus(at.slope);
    s->slope_error[i] = DG_SLOPE_UNITS * slope_size;
    return size > LEAST && size < MOST && slope_size > LEAST && slope_size < MOST;
}

static cv_status enclose(dg_dd_roots *r, const dg_dd_operator *op)
{
    dg_separation s;
    dg_separation_open(&s, r->count, r->far, DG_DD_UNIT);
    const int near = s.count - s.far;
    for (int i = 0; i < s.count; i++) {
        if (!measure(&s, r, op, i, i >= near))
            return CV_UNDECIDED;
        for (int k = 0; k < i && i < near; k++)
            dg_separation_set_distance(&s, i, k, cabs(difference(r->y[i], r->y[k])));
    }
    return dg_separate(r->radius, r->slope_relative, r->crowding, &s);
}

cv_status dg_dd_roots_find(dg_dd_roots *roots, const dg_dd_operator *op, const dg_roots *start)
{
    if (start->count != op->rounded.degree)
        return CV_UNDECIDED;
    roots->count = start->count;
    roots->far = start->far;
    for (int i = 0; i < start->count; i++)
        roots->y[i] = (dg_dd_complex){{start->re[i], 0}, {start->im[i], 0}};
    iterate(roots, op);
    return enclose(roots, op);
}
