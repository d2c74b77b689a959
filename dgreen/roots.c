#include "dgreen/roots.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>

#include "dgreen/lanes.h"

/* Value and slope of the reversed polynomial at u. */
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

/* Horner for value and derivative of Delta(i y) at all near roots */
DG_PART void evaluate_all(dg_lanes *f_re, dg_lanes *f_im, dg_lanes *d_re, dg_lanes *d_im,
                          const dg_operator *op, const dg_ring *y)
{
    for (int i = 0; i < DG_DEGREE; i++) {
        f_re->of[i] = op->re[op->degree];
        f_im->of[i] = op->im[op->degree];
        d_re->of[i] = d_im->of[i] = 0;
    }
    for (int k = op->degree - 1; k >= 0; k--) {
        const double c_re = op->re[k], c_im = op->im[k];
        for (int i = 0; i < DG_DEGREE; i++) {
            const double re = d_re->of[i] * y->re[i] - d_im->of[i] * y->im[i] + f_re->of[i];
            d_im->of[i] = d_re->of[i] * y->im[i] + d_im->of[i] * y->re[i] + f_im->of[i];
            d_re->of[i] = re;
            const double value = f_re->of[i] * y->re[i] - f_im->of[i] * y->im[i] + c_re;
            f_im->of[i] = f_re->of[i] * y->im[i] + f_im->of[i] * y->re[i] + c_im;
            f_re->of[i] = value;
        }
    }
}

/* sum over k != i of 1/(y_i - y_k); nearest: 1/distance^2 of the closest */
DG_PART void repulsion(dg_lanes *a_re, dg_lanes *a_im, dg_lanes *nearest, const dg_ring *y)
{
    for (int i = 0; i < DG_DEGREE; i++)
        a_re->of[i] = a_im->of[i] = nearest->of[i] = 0;
    for (int k = 1; k < DG_DEGREE; k++)
        for (int i = 0; i < DG_DEGREE; i++) {
            const double dx = y->re[i] - y->re[i + k], dy = y->im[i] - y->im[i + k];
            const double inverse = 1 / (dx * dx + dy * dy);
            a_re->of[i] += dx * inverse;
            a_im->of[i] -= dy * inverse;
            nearest->of[i] = inverse > nearest->of[i] ? inverse : nearest->of[i];
        }
}

/* 1/(y - 1/u) = u/(u y - 1) */
DG_PART void add_far_repulsion(dg_lanes *a_re, dg_lanes *a_im, const dg_roots *r)
{
    const int near = r->count - 1;
    const double complex u = CMPLX(r->re[near], r->im[near]);
    for (int i = 0; i < near; i++) {
        const double complex term = u / (u * CMPLX(r->re[i], r->im[i]) - 1);
        a_re->of[i] += creal(term);
        a_im->of[i] += cimag(term);
    }
}

/* One Ehrlich-Aberth update N/(1 - N A) of all near roots, N = f/f'. moved: (|step| / distance to the
 * nearest)^2 */
DG_PART void update_near(dg_lanes *moved, dg_roots *r, const dg_operator *op)
{
    dg_lanes f_re, f_im, d_re, d_im, a_re, a_im;
    dg_ring y;
    dg_ring_set(&y, r);
    evaluate_all(&f_re, &f_im, &d_re, &d_im, op, &y);
    repulsion(&a_re, &a_im, moved, &y);
    if (r->far)
        add_far_repulsion(&a_re, &a_im, r);
    double re[DG_DEGREE], im[DG_DEGREE];
    for (int i = 0; i < DG_DEGREE; i++) { /* f / (f' - f A) */
        const double u = d_re.of[i] - (f_re.of[i] * a_re.of[i] - f_im.of[i] * a_im.of[i]);
        const double v = d_im.of[i] - (f_re.of[i] * a_im.of[i] + f_im.of[i] * a_re.of[i]);
        const double inverse = 1 / (u * u + v * v);
        const double step_re = (f_re.of[i] * u + f_im.of[i] * v) * inverse;
        const double step_im = (f_im.of[i] * u - f_re.of[i] * v) * inverse;
        re[i] = y.re[i] - step_re;
        im[i] = y.im[i] - step_im;
        moved->of[i] *= step_re * step_re + step_im * step_im;
    }
    for (int i = 0; i < r->count - r->far; i++) {
        r->re[i] = re[i];
        r->im[i] = im[i];
    }
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
 * below rounding. Where short steps no longer become shorter, rounding is all there is: near a cluster. */
static int settled(double moved, double last)
{
    static const double SETTLED = 1e-10, SHORT = 1e-4, SHORTER = 0.01;
    return moved < SETTLED || (moved < SHORT && moved > SHORTER * last);
}

DG_CLONES static cv_status polish(dg_roots *roots, const dg_operator *op, int sweeps)
{
    dg_lanes moved, last;
    choose_form(roots, op);
    for (int i = 0; i < DG_DEGREE; i++)
        last.of[i] = HUGE_VAL;
    for (int sweep = 0; sweep < sweeps; sweep++) {
        int all = 1;
        update_near(&moved, roots, op);
        for (int i = 0; i < roots->count - roots->far; i++)
            all &= settled(moved.of[i], last.of[i]);
        if (roots->far && !(update_far(roots, op) < 1e-16))
            all = 0;
        if (all)
            return CV_OK;
        last = moved;
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
