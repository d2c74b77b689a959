#include <math.h>

#include "dgreen/curve_refine.h"

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

static void set_bracket(dg_crossing *x, const dg_node *low, const dg_node *high)
{
    x->q_low = low->q;
    x->q_high = high->q;
    x->x_low = fmin(low->re - low->re_error, high->re - high->re_error);
    x->x_high = fmax(low->re + low->re_error, high->re + high->re_error);
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
    x->q = s.low.q + part * (s.high.q - s.low.q);
    x->x = s.low.re + part * (s.high.re - s.low.re);
    set_bracket(x, low, high);
    x->direction = low->im > 0 ? 1 : -1;
    x->position = dg_station_position(at, x->q);
    x->scale = dg_station_scale(at, x->q);
    dg_slopes slopes;
    status = dg_probe_slopes(&slopes, p, at, x->q);
    x->dq = slopes.dq;
    x->dx = slopes.dx;
    return status;
}

/* One crossing: a bracket around its estimate, so narrow that Re zeta stays on one side of x, and narrower
 * again where its ends are not certified to be on both sides of the crossing. */
static cv_status separate(dg_curve *c, const dg_probe *p, dg_crossing *crossing, double x, cv_message *why)
{
    enum { ROUNDS = 8 };
    const double rate = (crossing->x_high - crossing->x_low) / (crossing->q_high - crossing->q_low);
    double half = fabs(crossing->x - x) / (4 * rate);
    for (int i = 0; i < ROUNDS; i++, half /= 8) {
        const size_t first = c->node_count;
        cv_status status = dg_curve_reserve(c, 2, why);
        if (status == CV_OK)
            status = dg_probe_at(&c->nodes[first], p, c->at.alpha, crossing->q - half);
        if (status == CV_OK)
            status = dg_probe_at(&c->nodes[first + 1], p, c->at.alpha, crossing->q + half);
        if (status == CV_UNDECIDED)
            break;
        if (status != CV_OK)
            return status;
        const dg_node *low = &c->nodes[first], *high = low + 1;
        if ((low->im > 0) == (high->im > 0))
            break;
        set_bracket(crossing, low, high);
        c->node_count += 2;
        if (!(crossing->x_low <= x && crossing->x_high >= x))
            return CV_OK;
    }
    return cv_fail(why, CV_UNDECIDED, "a root on the stability boundary at alpha = %.17g", c->at.alpha);
}

cv_status dg_curve_separate(dg_curve *c, const dg_probe *p, double x, cv_message *why)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < c->crossing_count && status == CV_OK; i++) {
        dg_crossing *crossing = &c->crossings[i];
        if (crossing->x_low <= x && crossing->x_high >= x)
            status = separate(c, p, crossing, x, why);
    }
    dg_curve_sort(c);
    return status;
}
