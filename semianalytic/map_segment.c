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

cv_status sa_segment_point(sa_sample *out, sa_field *field, const sa_segment *segment, double x)
{
    const sa_sample *p = &segment->from, *q = &segment->to;
    const double slack = 0.3, close = 1e-8;
    double u = p->u + x * (q->u - p->u), t = p->t + x * (q->t - p->t);
    double *v = segment->axis == 0 ? &t : &u;
    double a = segment->axis == 0 ? p->t : p->u, b = segment->axis == 0 ? q->t : q->u;
    double extent = fabs(b - a), scale = fmax(extent, 1e-3 * hypot(q->u - p->u, q->t - p->t));
    double low = fmax(fmin(a, b) - slack * scale, 0), high = fmin(fmax(a, b) + slack * scale, 1);
    for (int i = 0; i < 40; ++i) {
        cv_status status = sa_field_at(out, field, u, t);
        if (status != CV_OK)
            return status;
        double step = -out->im / (segment->axis == 0 ? out->im_t : out->im_u);
        if (!(fabs(step) > close * scale) || fabs(out->im) <= 2 * out->im_error) {
            if (fabs(step) <= close * scale)
                shift(out, segment->axis == 0 ? 0 : step, segment->axis == 0 ? step : 0);
            return CV_OK;
        }
        *v = fmin(fmax(*v + step, low), high);
    }
    return CV_OK;
}

double sa_segment_slope(const sa_segment *segment, const sa_sample *at)
{
    if (segment->axis == 0)
        return (at->re_u - at->re_t * at->im_u / at->im_t) * (segment->to.u - segment->from.u);
    return (at->re_t - at->re_u * at->im_t / at->im_u) * (segment->to.t - segment->from.t);
}
