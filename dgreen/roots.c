#include "dgreen/roots.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>

/* Value and slope of Delta(i y) at y, or of the reversed polynomial at u. */
typedef struct {
    double re, im, slope_re, slope_im;
} sample;

/* Horner for value and derivative; step is 1 for c[0], c[1], ... and -1 for the reversed order from
 * c[degree]. */
static inline sample evaluate(const double *re, const double *im, int degree, int step, double x, double y)
{
    const double *top_re = step > 0 ? re + degree : re, *top_im = step > 0 ? im + degree : im;
    sample s = {*top_re, *top_im, 0, 0};
    for (int k = 0; k < degree; k++) {
        top_re -= step;
        top_im -= step;
        const double slope_re = s.slope_re * x - s.slope_im * y + s.re;
        s.slope_im = s.slope_re * y + s.slope_im * x + s.im;
        s.slope_re = slope_re;
        const double value_re = s.re * x - s.im * y + *top_re;
        s.im = s.re * y + s.im * x + *top_im;
        s.re = value_re;
    }
    return s;
}

/* The reciprocal belongs in the last slot when the leading coefficient is small enough for one root, and only
 * one, to be far out: |c8/c7| times the bound 2 max |c_(7-k)/c7|^(1/k) of the other seven is small. */
int dg_roots_far_form(const dg_operator *op)
{
    if (op->degree != DG_DEGREE || !(fabs(op->relative_a0) < 0.01))
        return 0;
    const double first = hypot(op->re[7], op->im[7]);
    double reach = 0;
    for (int k = 1; k <= 7; k++)
        reach = fmax(reach, pow(hypot(op->re[7 - k], op->im[7 - k]) / first, 1.0 / k));
    return hypot(op->re[8], op->im[8]) * 2 * reach < 0.1 * first;
}

static void invert(double *re, double *im)
{
    const double norm = *re * *re + *im * *im;
    *re /= norm;
    *im /= -norm;
}

/* Puts the root of largest modulus in the last slot. */
static void largest_last(dg_roots *r)
{
    int largest = 0;
    const int last = r->count - 1;
    for (int i = 1; i < r->count; i++)
        if (hypot(r->re[i], r->im[i]) > hypot(r->re[largest], r->im[largest]))
            largest = i;
    const double re = r->re[largest], im = r->im[largest];
    r->re[largest] = r->re[last];
    r->im[largest] = r->im[last];
    r->re[last] = re;
    r->im[last] = im;
}

/* The far root to first order, u = -c8/c7. */
static void start_far(dg_roots *r, const dg_operator *op)
{
    const double complex u = -CMPLX(op->re[8], op->im[8]) / CMPLX(op->re[7], op->im[7]);
    r->re[DG_DEGREE - 1] = creal(u);
    r->im[DG_DEGREE - 1] = cimag(u);
}

static void choose_form(dg_roots *r, const dg_operator *op)
{
    const int far = dg_roots_far_form(op);
    if (far == r->far)
        return;
    if (far) {
        largest_last(r);
        start_far(r, op);
    } else {
        invert(&r->re[r->count - 1], &r->im[r->count - 1]);
    }
    r->far = far;
}

cv_status dg_roots_cold(dg_roots *roots, const dg_operator *op)
{
    roots->far = dg_roots_far_form(op);
    roots->count = op->degree;
    const int n = op->degree - roots->far;
    lapack_complex_double companion[DG_DEGREE * DG_DEGREE] = {0}, eigenvalues[DG_DEGREE], none;
    const double complex lead = CMPLX(op->re[n], op->im[n]);
    for (int j = 0; j < n; j++) {
        companion[j * n] = -CMPLX(op->re[n - 1 - j], op->im[n - 1 - j]) / lead;
        if (!isfinite(creal(companion[j * n])) || !isfinite(cimag(companion[j * n])))
            return CV_UNDECIDED;
        if (j + 1 < n)
            companion[j * n + j + 1] = 1;
    }
    lapack_int low = 1, high = n;
    double scale[DG_DEGREE];
    if (LAPACKE_zgebal(LAPACK_COL_MAJOR, 'S', n, companion, n, &low, &high, scale) != 0)
        return CV_UNDECIDED;
    if (LAPACKE_zhseqr(LAPACK_COL_MAJOR, 'E', 'N', n, low, high, companion, n, eigenvalues, &none, 1) != 0)
        return CV_UNDECIDED;
    for (int i = 0; i < n; i++) {
        roots->re[i] = creal(eigenvalues[i]);
        roots->im[i] = cimag(eigenvalues[i]);
    }
    if (roots->far)
        start_far(roots, op);
    return CV_OK;
}

/* sum over k != i of 1/(y_i - y_k), the far root included; nearest becomes 1/distance^2 of the closest. */
static inline void repulsion(double *re, double *im, double *nearest, const dg_roots *r, int i)
{
    const int near = r->count - r->far;
    double sum_re = 0, sum_im = 0, largest = 0;
    for (int k = 0; k < near; k++) {
        if (k == i)
            continue;
        const double dx = r->re[i] - r->re[k], dy = r->im[i] - r->im[k];
        const double inverse = 1 / (dx * dx + dy * dy);
        sum_re += dx * inverse;
        sum_im -= dy * inverse;
        largest = inverse > largest ? inverse : largest;
    }
    if (r->far) { /* 1/(y - 1/u) = u/(u y - 1) */
        const double complex u = CMPLX(r->re[near], r->im[near]);
        const double complex term = u / (u * CMPLX(r->re[i], r->im[i]) - 1);
        sum_re += creal(term);
        sum_im += cimag(term);
    }
    *re = sum_re;
    *im = sum_im;
    *nearest = largest;
}

/* One Ehrlich-Aberth update N/(1 - N A) of root i, N = f/f'. Returns (|step| / distance to the nearest)^2. */
static inline double update(dg_roots *r, const dg_operator *op, int i)
{
    const sample s = evaluate(op->re, op->im, op->degree, 1, r->re[i], r->im[i]);
    double a_re, a_im, nearest;
    repulsion(&a_re, &a_im, &nearest, r, i);
    /* f / (f' - f A) */
    const double d_re = s.slope_re - (s.re * a_re - s.im * a_im);
    const double d_im = s.slope_im - (s.re * a_im + s.im * a_re);
    const double inverse = 1 / (d_re * d_re + d_im * d_im);
    const double step_re = (s.re * d_re + s.im * d_im) * inverse;
    const double step_im = (s.im * d_re - s.re * d_im) * inverse;
    r->re[i] -= step_re;
    r->im[i] -= step_im;
    return (step_re * step_re + step_im * step_im) * nearest;
}

/* One Newton update of the far root, in u; the other roots are far from it there. */
static double update_far(dg_roots *r, const dg_operator *op)
{
    const int last = r->count - 1;
    const sample s = evaluate(op->re, op->im, op->degree, -1, r->re[last], r->im[last]);
    const double complex step = CMPLX(s.re, s.im) / CMPLX(s.slope_re, s.slope_im);
    r->re[last] -= creal(step);
    r->im[last] -= cimag(step);
    const double scale = cabs(CMPLX(op->re[6], op->im[6]) / CMPLX(op->re[7], op->im[7]));
    const double relative = cabs(step) * scale;
    return relative * relative;
}

/* After a step shorter than 1e-5 of the distance to the nearest root, the error left is of third order in it:
 * below rounding. */
static cv_status polish(dg_roots *roots, const dg_operator *op, int sweeps)
{
    choose_form(roots, op);
    const int near = roots->count - roots->far;
    for (int sweep = 0; sweep < sweeps; sweep++) {
        int settled = 1;
        for (int i = 0; i < near; i++)
            if (!(update(roots, op, i) < 1e-10))
                settled = 0;
        if (roots->far && !(update_far(roots, op) < 1e-16))
            settled = 0;
        if (settled)
            return CV_OK;
    }
    return CV_UNDECIDED;
}

cv_status dg_roots_polish(dg_roots *roots, const dg_operator *op)
{
    if (roots->count != op->degree)
        return CV_UNDECIDED;
    return polish(roots, op, DG_MAX_SWEEPS);
}

cv_status dg_roots_polish_cold(dg_roots *roots, const dg_operator *op)
{
    return polish(roots, op, 4 * DG_MAX_SWEEPS);
}
