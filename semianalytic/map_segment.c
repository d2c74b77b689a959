#include <math.h>

#include "semianalytic/map_search.h"

/* Moves s by a small step in u and t to first order, so that a point found to 1e-7 is right to 1e-14. */
static void shift(sa_sample *s, double du, double dt)
{
    s->u += du;
    s->t += dt;
    s->re += s->re_u * du + s->re_t * dt;
    s->im += s->im_u * du + s->im_t * dt;
}

/* The range of the coordinate across the axis in which the cell holds the segment. */
static void range_across(double *low, double *high, const sa_segment *s)
{
    const sa_sample *end[2] = {&s->from, &s->to};
    *low = INFINITY;
    *high = -INFINITY;
    for (int i = 0; i < 2; ++i) {
        int whole = s->edge[i].along != s->axis; /* the edge lies across the axis */
        double at = s->axis == 0 ? end[i]->t : end[i]->u;
        *low = fmin(*low, whole ? s->edge[i].low : at);
        *high = fmax(*high, whole ? s->edge[i].high : at);
    }
}

/* Im zeta is monotone across the axis: Newton, or bisection where that leaves what is left of the cell. */
cv_status sa_segment_point(sa_sample *out, sa_field *field, const sa_segment *segment, double x)
{
    const sa_sample *p = &segment->from, *q = &segment->to;
    const double close = 1e-8, rounding = 1e-3;
    const int axis = segment->axis;
    double u = p->u + x * (q->u - p->u), t = p->t + x * (q->t - p->t), *v = axis == 0 ? &t : &u;
    double along = hypot(q->u - p->u, q->t - p->t), low, high;
    int rises = (axis == 0 ? p->im_t : p->im_u) > 0;
    range_across(&low, &high, segment);
    double scale = fmax(high - low, 1e-3 * along), last = INFINITY;
    for (int i = 0; i < 60; ++i) {
        cv_status status = sa_field_at(out, field, u, t);
        if (status != CV_OK)
            return status;
        double step = -out->im / (axis == 0 ? out->im_t : out->im_u);
        int stopped = last < rounding * scale && !(fabs(step) < 0.5 * last); /* by doubles for alpha and q */
        if (!(fabs(step) > close * scale) || fabs(out->im) <= 2 * out->im_error || !(high > low) || stopped) {
            if (fabs(step) <= close * scale)
                shift(out, axis == 0 ? 0 : step, axis == 0 ? step : 0);
            return CV_OK;
        }
        last = fabs(step);
        if ((out->im > 0) == rises)
            high = *v;
        else
            low = *v;
        *v = *v + step >= low && *v + step <= high ? *v + step : low + (high - low) / 2;
    }
    return CV_OK;
}

double sa_segment_slope(const sa_segment *segment, const sa_sample *at)
{
    if (segment->axis == 0)
        return (at->re_u - at->re_t * at->im_u / at->im_t) * (segment->to.u - segment->from.u);
    return (at->re_t - at->re_u * at->im_t / at->im_u) * (segment->to.t - segment->from.t);
}
