#include "dgreen/bounds.h"

#include <math.h>

/* Distances are computed in double with a few rounding errors. */
static const double SLACK = 1 - 1e-14;

/* Root i against the others, whose discs have radius wide[k]: sum over k of 1/(distance to the nearest point
 * of disc k); negative when discs meet. */
static inline double near_crowding(const dg_separation *s, const double *wide, int i)
{
    const int near = s->count - s->far;
    double sum = 0;
    for (int k = 0; k < near; k++) {
        if (k == i)
            continue;
        const double gap = s->distance[i][k] * SLACK - wide[k];
        if (!(gap > wide[i]))
            return -1;
        sum += 1 / gap;
    }
    if (s->far) {
        const double edge = 1 / (s->modulus[near] + wide[near]);
        const double gap = (edge - s->modulus[i]) * SLACK;
        if (!(gap > wide[i] && gap > s->modulus[i]))
            return -1;
        sum += 1 / gap;
    }
    return sum;
}

/* The far root against the others in the u plane, where they are at 1/y_k. */
static double far_crowding(const dg_separation *s, const double *wide)
{
    const int near = s->count - 1;
    double sum = 0;
    for (int k = 0; k < near; k++) {
        const double gap = (1 / (s->modulus[k] + wide[k]) - s->modulus[near]) * SLACK;
        if (!(gap > wide[near] && gap > s->modulus[near]))
            return -1;
        sum += 1 / gap;
    }
    return sum;
}

cv_status dg_separate(double *radius, double *slope_relative, double *crowding, const dg_separation *s)
{
    double newton[DG_DEGREE], slope[DG_DEGREE], wide[DG_DEGREE];
    for (int i = 0; i < s->count; i++) {
        const double rounding = s->slope_error[i] * s->unit;
        if (!(10 * rounding < s->slope[i]))
            return CV_UNDECIDED;
        slope[i] = s->slope[i] - rounding;
        newton[i] = s->value[i] / (slope[i] * SLACK);
        wide[i] = s->count * newton[i] * s->unit;
    }
    for (int i = 0; i < s->count; i++) {
        const double sum = i < s->count - s->far ? near_crowding(s, wide, i) : far_crowding(s, wide);
        const double relative = newton[i] * s->unit * sum;
        if (!(sum >= 0 && relative < 0.04))
            return CV_UNDECIDED;
        crowding[i] = sum;
        radius[i] = newton[i] / ((1 - relative) * SLACK);
        slope_relative[i] = s->slope_error[i] / slope[i] + 2.5 * radius[i] * sum;
    }
    return CV_OK;
}

dg_r_size dg_r_size_at(const dg_operator *op, int far, double x, double y, double reach)
{
    double re = 0, im = 0, d_re = 0, d_im = 0, size = 0;
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const int at = far ? DG_R_DEGREE - k : k;
        const double next = d_re * x - d_im * y + re;
        d_im = d_re * y + d_im * x + im;
        d_re = next;
        const double value = re * x - im * y + op->r_re[at];
        im = re * y + im * x + op->r_im[at];
        re = value;
        size = size * reach + op->r_size[at];
    }
    const double rounding = reach > 0 ? 8 * DG_R_UNITS * 0x1p-53 * size / reach : 0;
    return (dg_r_size){size, hypot(d_re, d_im) + rounding};
}
