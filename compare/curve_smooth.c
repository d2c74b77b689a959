#include "compare/curve_smooth.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/polyline.h"

static const double CHORD = 0.012, ACCURACY = 1e-8;
enum { DEPTH = 8 };

typedef struct {
    const cmp_window *window;
    dg_probe probe;
    dg_polyline line; /* the new one */
} work;

static cv_status value(dg_vertex *v, const work *k)
{
    dg_value zeta;
    const cv_status status = dg_zeta_adaptive(&zeta, k->probe.follow, k->probe.track, k->window->alpha,
                                              CMPLX(k->window->delta, v->q), ACCURACY, ACCURACY);
    v->re = k->window->eta_M * zeta.re;
    v->im = k->window->eta_M * zeta.im;
    return status;
}

static int in_window(const dg_vertex *v, const cmp_window *w)
{
    return v->re >= w->left && v->re <= w->right && fabs(v->im) <= w->top;
}

/* Whether the chord may be seen, and is long. */
static int is_coarse(const dg_vertex *a, const dg_vertex *b, const cmp_window *w)
{
    const double x = (b->re - a->re) / (w->right - w->left), y = (b->im - a->im) / (2 * w->top);
    const int crosses = fmin(a->re, b->re) < w->right && fmax(a->re, b->re) > w->left &&
                        fmin(a->im, b->im) < w->top && fmax(a->im, b->im) > -w->top;
    return (in_window(a, w) || in_window(b, w) || crosses) && hypot(x, y) > CHORD;
}

/* Adds what is missing between a and b, and b. A point that cannot be had leaves the chord as it is. */
static cv_status fill(work *k, const dg_vertex *a, const dg_vertex *b, int depth, cv_message *why)
{
    dg_vertex middle = {.q = sqrt(a->q * b->q)};
    if (depth < DEPTH && is_coarse(a, b, k->window) && middle.q > a->q && middle.q < b->q &&
        value(&middle, k) == CV_OK) {
        const cv_status status = fill(k, a, &middle, depth + 1, why);
        return status == CV_OK ? fill(k, &middle, b, depth + 1, why) : status;
    }
    return dg_polyline_push(&k->line, b, why);
}

cv_status cmp_curve_smooth(dg_polyline *line, const dg_sampler *sampler, const cmp_window *w, cv_message *why)
{
    work k = {.window = w, .probe = dg_sampler_probe(sampler)};
    cv_status status = CV_OK;
    for (size_t i = 0; i < line->count && status == CV_OK; i++)
        status = i == 0 ? dg_polyline_push(&k.line, &line->at[0], why)
                        : fill(&k, &line->at[i - 1], &line->at[i], 0, why);
    if (status != CV_OK) {
        dg_polyline_clear(&k.line);
        return status;
    }
    dg_polyline_clear(line);
    *line = k.line;
    return CV_OK;
}
