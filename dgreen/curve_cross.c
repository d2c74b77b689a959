#include <math.h>

#include "dgreen/curve.h"

size_t dg_curve_hard_points(const dg_curve *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->point_count; i++)
        n += !c->points[i].soft;
    return n;
}

double dg_curve_position(const dg_branch_point *points, size_t count, double q)
{
    double position = log(q);
    for (size_t i = 0; i < count; i++)
        if (!points[i].soft)
            position += asinh((q - points[i].q) / points[i].width);
    return position;
}

double dg_curve_scale(double *wave, const dg_branch_point *points, size_t count, double q)
{
    double scale = q;
    *wave = 1;
    for (size_t i = 0; i < count; i++)
        scale = fmin(scale, hypot(q - points[i].q, points[i].width));
    for (size_t i = 0; i < count; i++)
        if (hypot(q - points[i].q, points[i].width) < 100 * scale)
            *wave = fmax(*wave, fabs(points[i].p));
    return scale;
}

double dg_curve_middle(const dg_branch_point *points, size_t count, double a, double b)
{
    double left = 0, left_width = 0, right = INFINITY, right_width = 0;
    for (size_t i = 0; i < count; i++) {
        if (points[i].q <= a) {
            left = points[i].q;
            left_width = points[i].width;
        } else if (points[i].q >= b) {
            right = points[i].q;
            right_width = points[i].width;
            break;
        }
    }
    double middle;
    if (a - left <= right - b)
        middle = left - left_width + sqrt((a - left + left_width) * (b - left + left_width));
    else
        middle = right + right_width - sqrt((right - a + right_width) * (right - b + right_width));
    return middle > a && middle < b ? middle : a + (b - a) / 2;
}

/* The next point of a bracketed search: secant twice, kept off the ends, then the logarithmic middle. */
static double next_point(const dg_branch_point *points, size_t count, const dg_node *a, const dg_node *b,
                         int step)
{
    const double middle = dg_curve_middle(points, count, a->q, b->q);
    if (step % 3 == 2)
        return middle;
    const double secant = a->q - a->im * (b->q - a->q) / (b->im - a->im);
    const double margin = 1e-4 * (b->q - a->q);
    return fmin(fmax(secant, a->q + margin), b->q - margin);
}

cv_status dg_curve_cross(dg_crossing *x, const dg_probe *p, const dg_branch_point *points, size_t count,
                         double alpha, const dg_node *a, const dg_node *b)
{
    enum { STEPS = 100 };
    static const double X_TOLERANCE = 1e-6, Q_TOLERANCE = 1e-4;
    dg_node low = *a, high = *b;
    double wave;
    for (int i = 0; i < STEPS; i++) {
        x->scale = dg_curve_scale(&wave, points, count, low.q);
        if (fabs(high.re - low.re) <= X_TOLERANCE * fabs(low.re) && high.q - low.q <= Q_TOLERANCE * x->scale)
            break;
        const double q = next_point(points, count, &low, &high, i);
        if (!(q > low.q && q < high.q))
            break;
        dg_node middle;
        const cv_status status = dg_probe_at(&middle, p, alpha, q);
        if (status == CV_UNDECIDED)
            break; /* q is a zero to double precision: the bracket is as narrow as it gets */
        if (status != CV_OK)
            return status;
        *((middle.im > 0) == (low.im > 0) ? &low : &high) = middle;
    }
    const double part = low.im / (low.im - high.im);
    x->q_low = low.q;
    x->q_high = high.q;
    x->q = low.q + part * (high.q - low.q);
    x->x = low.re + part * (high.re - low.re);
    x->x_low = fmin(low.re - low.re_error, high.re - high.re_error);
    x->x_high = fmax(low.re + low.re_error, high.re + high.re_error);
    x->direction = low.im > 0 ? 1 : -1;
    x->position = dg_curve_position(points, count, x->q);
    dg_slopes s;
    const cv_status status = dg_probe_slopes(&s, p, alpha, x->q, x->scale, wave);
    x->dq = s.dq;
    x->dx = s.dx;
    return status;
}
