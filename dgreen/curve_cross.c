#include <math.h>

#include "dgreen/curve.h"

/* The next point of a bracketed search: secant twice, kept off the ends, then the logarithmic middle. */
static double next_point(const dg_station *at, const dg_node *a, const dg_node *b, int step)
{
    const double middle = dg_station_middle(at, a->q, b->q);
    if (step % 3 == 2)
        return middle;
    const double secant = a->q - a->im * (b->q - a->q) / (b->im - a->im);
    const double margin = 1e-4 * (b->q - a->q);
    return fmin(fmax(secant, a->q + margin), b->q - margin);
}

/* Narrows [low, high] by values without a promise, [certain_low, certain_high] by those with certain signs.
 */
typedef struct {
    dg_node low, high, certain_low, certain_high;
} search;

static cv_status narrow(search *s, const dg_probe *p, const dg_station *at)
{
    enum { STEPS = 100 };
    static const double X_TOLERANCE = 1e-6, Q_TOLERANCE = 1e-4;
    for (int i = 0; i < STEPS; i++) {
        const double scale = dg_station_scale(at, s->low.q);
        if (fabs(s->high.re - s->low.re) <= X_TOLERANCE * fabs(s->low.re) &&
            s->high.q - s->low.q <= Q_TOLERANCE * scale)
            break;
        const double q = next_point(at, &s->low, &s->high, i);
        if (!(q > s->low.q && q < s->high.q))
            break;
        dg_node middle;
        int certain;
        const cv_status status = dg_probe_value(&middle, &certain, p, at->alpha, q);
        if (status != CV_OK)
            return status;
        const int below = (middle.im > 0) == (s->certain_low.im > 0);
        *(below ? &s->low : &s->high) = middle;
        if (certain)
            *(below ? &s->certain_low : &s->certain_high) = middle;
    }
    return CV_OK;
}

cv_status dg_curve_cross(dg_crossing *x, const dg_probe *p, const dg_station *at, const dg_node *a,
                         const dg_node *b)
{
    search s = {*a, *b, *a, *b};
    cv_status status = narrow(&s, p, at);
    if (status != CV_OK)
        return status;
    const dg_node *low = &s.certain_low, *high = &s.certain_high;
    const double part = s.low.im / (s.low.im - s.high.im);
    x->q_low = low->q;
    x->q_high = high->q;
    x->q = s.low.q + part * (s.high.q - s.low.q);
    x->x = s.low.re + part * (s.high.re - s.low.re);
    x->x_low = fmin(low->re - low->re_error, high->re - high->re_error);
    x->x_high = fmax(low->re + low->re_error, high->re + high->re_error);
    x->direction = low->im > 0 ? 1 : -1;
    x->position = dg_station_position(at, x->q);
    x->scale = dg_station_scale(at, x->q);
    dg_slopes slopes;
    status = dg_probe_slopes(&slopes, p, at, x->q);
    x->dq = slopes.dq;
    x->dx = slopes.dx;
    return status;
}
