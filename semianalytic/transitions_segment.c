#include <math.h>
#include <stdlib.h>

#include "semianalytic/transitions_parts.h"

/* Re zeta along part of a segment: x of its axis, value and slope at the ends. */
typedef struct {
    double x;
    sa_sample at;
} station;

typedef struct {
    sa_levels *levels;
    sa_field *field;
    const sa_segment *segment;
} walk;

static cv_status append(sa_candidates *list, sa_candidate item)
{
    if (list->count == list->room) {
        size_t room = 2 * list->room + 64;
        sa_candidate *more = realloc(list->items, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        list->items = more;
        list->room = room;
    }
    list->items[list->count++] = item;
    return CV_OK;
}

/* Re zeta passes the level once between a and b, monotone. */
static cv_status locate(sa_sample *found, const walk *w, const station *a, const station *b, double target)
{
    double from = a->at.re - target;
    double low = a->x, high = b->x, x = low + (high - low) * from / (a->at.re - b->at.re);
    sa_sample s = a->at;
    for (int i = 0; i < 60; ++i) {
        cv_status status = sa_segment_point(&s, w->field, w->segment, x);
        if (status != CV_OK)
            return status;
        double f = s.re - target, step = -f / sa_segment_slope(w->segment, &s);
        if (f * from > 0)
            low = x;
        else
            high = x;
        if (fabs(step) < 1e-10 * (b->x - a->x) || fabs(f) <= 2 * s.re_error || high - low < 1e-13)
            break;
        x = x + step > low && x + step < high ? x + step : (low + high) / 2;
    }
    *found = s;
    return CV_OK;
}

/* Newton's iteration in (u, t) from s, which double precision has found. CV_UNDECIDED: it does not converge
 * at once. */
static cv_status polish(sa_sample *s, sa_field *field, double target)
{
    enum { STEPS = 8 };
    const double close = 1e-9, rounding = 1e-4;
    double last = INFINITY;
    for (int i = 0; i < STEPS; ++i) {
        cv_status status = sa_field_at(s, field, s->u, s->t);
        if (status != CV_OK)
            return status;
        double det = s->re_u * s->im_t - s->re_t * s->im_u, f = s->re - target;
        double du = (s->re_t * s->im - s->im_t * f) / det, dt = (s->im_u * f - s->re_u * s->im) / det;
        double size = hypot(du, dt), u = s->u + du, t = s->t + dt;
        if (size < close || (last < rounding && size < rounding && !(size < 0.1 * last)))
            return CV_OK;
        if (!(size < 0.5 * last) || !(u >= 0 && u <= 1 && t >= 0 && t <= 1))
            return CV_UNDECIDED;
        last = size;
        s->u = u;
        s->t = t;
    }
    return CV_UNDECIDED;
}

static cv_status pass(const walk *w, const station *a, const station *b, size_t level)
{
    const double resolution = 1e-8, target = w->levels->level[level];
    sa_sample s;
    cv_status status = locate(&s, w, a, b, target);
    if (status != CV_OK)
        return status;
    sa_field_resolution(w->field, resolution);
    status = polish(&s, w->field, target);
    if (status == CV_UNDECIDED)
        status = locate(&s, w, a, b, target);
    sa_field_resolution(w->field, SA_FIELD_RESOLUTION);
    if (status != CV_OK)
        return status;
    sa_candidate c = {level, s.alpha, s.q, {{s.re_alpha, s.re_q}, {s.im_alpha, s.im_q}}};
    return append(&w->levels->found, c);
}

typedef enum { NONE, ONE, UNCLEAR } passage;

/* How often the line passes a level between a and b, judged by the cubic through values and slopes. */
static passage judge(const walk *w, const station *a, const station *b, double level)
{
    const double uneven = 4;
    double h = b->x - a->x, f0 = a->at.re - level, f1 = b->at.re - level;
    double g0 = sa_segment_slope(w->segment, &a->at) * h, g1 = sa_segment_slope(w->segment, &b->at) * h;
    if ((f0 > 0) == (f1 > 0))
        return sa_cubic_one_signed(f0, f1, g0, g1) ? NONE : UNCLEAR;
    double rise = f1 - f0;
    int even = g0 * rise > 0 && g1 * rise > 0 && fabs(g0) < uneven * fabs(rise) &&
               fabs(g1) < uneven * fabs(rise) && uneven * fabs(g0) > fabs(rise) &&
               uneven * fabs(g1) > fabs(rise);
    return even ? ONE : UNCLEAR;
}

static cv_status divide(const walk *w, const station *a, const station *b, int depth)
{
    enum { DEEPEST = 48 };
    int unclear = 0;
    for (size_t i = 0; i < w->levels->count; ++i)
        unclear += judge(w, a, b, w->levels->level[i]) == UNCLEAR;
    if (unclear > 0 && depth < DEEPEST) {
        station middle = {.x = (a->x + b->x) / 2};
        cv_status status = sa_segment_point(&middle.at, w->field, w->segment, middle.x);
        if (status == CV_OK)
            status = divide(w, a, &middle, depth + 1);
        return status == CV_OK ? divide(w, &middle, b, depth + 1) : status;
    }
    for (size_t i = 0; i < w->levels->count; ++i) {
        double level = w->levels->level[i];
        if (judge(w, a, b, level) == UNCLEAR) {
            w->levels->doubtful[i] = 1;
            w->levels->doubtful_at[i] = a->at.alpha;
        } else if ((a->at.re > level) != (b->at.re > level)) {
            cv_status status = pass(w, a, b, i);
            if (status != CV_OK)
                return status;
        }
    }
    return CV_OK;
}

cv_status sa_levels_on_segment(sa_levels *levels, sa_field *field, const sa_segment *segment)
{
    walk w = {levels, field, segment};
    station from = {0, segment->from}, to = {1, segment->to};
    return divide(&w, &from, &to, 0);
}
