/* dg_roots_enclose: inclusion discs in double. */
#include <float.h>
#include <math.h>

#include "dgreen/roots.h"

static const double UNIT = DBL_EPSILON / 2;

/* Rounding of coefficients (48 units, dgreen/operator.h) and of Horner's rule: a complex product costs
 * sqrt(5) units, a sum one, eight steps: 26. The derivative carries the value's rounding along: twice that.
 * The rest covers the rounding of the sizes themselves. */
static const double VALUE_UNITS = 80, SLOPE_UNITS = 110;

/* |f|, |f'| from above and below with every rounding error */
typedef struct {
    double value_high, slope_low, slope_error, re, im;
} bound;

static inline bound bound_at(const dg_operator *op, int reversed, double x, double y)
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
    const double slope = sqrt(d_re * d_re + d_im * d_im), slope_error = SLOPE_UNITS * UNIT * d_size;
    return (bound){sqrt(re * re + im * im) + VALUE_UNITS * UNIT * size, slope - slope_error, slope_error,
                   d_re, d_im};
}

/* Separation in the y plane of root i from the others, whose discs have radius wide[k]:
 * sum over k of 1/(distance to the nearest point of disc k); negative when discs meet. */
static double crowding(const dg_roots *r, const double *wide, int i)
{
    const int near = r->count - r->far;
    double sum = 0;
    for (int k = 0; k < near; k++) {
        if (k == i)
            continue;
        const double dx = r->re[i] - r->re[k], dy = r->im[i] - r->im[k];
        const double gap = sqrt(dx * dx + dy * dy) * (1 - 4 * UNIT) - wide[k];
        if (!(gap > wide[i]))
            return -1;
        sum += 1 / gap;
    }
    if (r->far) {
        const double edge = 1 / (hypot(r->re[near], r->im[near]) + wide[near]);
        const double gap = (edge - hypot(r->re[i], r->im[i])) * (1 - 16 * UNIT);
        if (!(gap > wide[i] && gap > 0.5 * edge))
            return -1;
        sum += 1 / gap;
    }
    return sum;
}

/* The same for the far root in the u plane, where the others are at 1/y_k. */
static double far_crowding(const dg_roots *r, const double *wide)
{
    const int near = r->count - 1;
    const double reach = hypot(r->re[near], r->im[near]);
    double sum = 0;
    for (int k = 0; k < near; k++) {
        const double gap = (1 / (hypot(r->re[k], r->im[k]) + wide[k]) - reach) * (1 - 16 * UNIT);
        if (!(gap > wide[near] && gap > reach))
            return -1;
        sum += 1 / gap;
    }
    return sum;
}

/* With exactly one root y* in the disc, f'/f = 1/(y - y*) + E, |E| <= sum, gives |y - y*| <= N/(1 - N sum),
 * and f'(y*)/f'(y) differs from 1 by at most 2.5 radius sum while radius sum <= 0.05 (products of
 * differences). */
static cv_status tighten(dg_discs *discs, int i, double newton, double sum, const bound *b)
{
    if (!(sum >= 0 && newton * sum < 0.04))
        return CV_UNDECIDED;
    discs->radius[i] = newton / (1 - newton * sum) * (1 + 16 * UNIT);
    discs->d_error[i] = b->slope_error / b->slope_low + 2.5 * discs->radius[i] * sum;
    discs->d_re[i] = b->re;
    discs->d_im[i] = b->im;
    return CV_OK;
}

cv_status dg_roots_enclose(dg_discs *discs, const dg_roots *roots, const dg_operator *op)
{
    const int n = roots->count, near = n - roots->far;
    bound at[DG_DEGREE];
    double newton[DG_DEGREE], wide[DG_DEGREE];
    for (int i = 0; i < n; i++) {
        at[i] = bound_at(op, i >= near, roots->re[i], roots->im[i]);
        if (!(at[i].slope_low > 0))
            return CV_UNDECIDED;
        newton[i] = at[i].value_high / at[i].slope_low * (1 + 4 * UNIT);
        wide[i] = n * newton[i];
    }
    for (int i = 0; i < n; i++) {
        const double sum = i < near ? crowding(roots, wide, i) : far_crowding(roots, wide);
        if (tighten(discs, i, newton[i], sum, &at[i]) != CV_OK)
            return CV_UNDECIDED;
    }
    return CV_OK;
}
