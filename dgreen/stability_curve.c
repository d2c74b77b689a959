#include "dgreen/stability_curve.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/polyline.h"

/* Crossings are listed down to this z. */
static const double FLOOR = 0.01;
/* Regions narrower than this, relative, are not checked by the winding. */
static const double THIN = 1e-6;
/* Relative accuracy of the parts of a vertex, so that rounding does not look like a bend. */
static const double SMOOTH = 1e-8;

typedef struct {
    dg_probe probe;
    double alpha, factor, delta;
} source;

static cv_status value(dg_vertex *v, void *context)
{
    const source *from = context;
    dg_value zeta;
    cv_status status = dg_zeta_adaptive(&zeta, from->probe.follow, from->probe.track, from->alpha,
                                        CMPLX(from->delta, v->q), SMOOTH, SMOOTH);
    if (status == CV_UNDECIDED && fmax(zeta.re_error, zeta.im_error) <= SMOOTH * hypot(zeta.re, zeta.im))
        status = CV_OK; /* a part that is zero, or as good as */
    v->re = from->factor * zeta.re;
    v->im = from->factor * zeta.im;
    return status;
}

/* The frequencies of the sampled curve resolve the shifted curve too, which is smoother. */
static cv_status draw(dg_polyline *line, const dg_curve *curve, source *from, cv_message *why)
{
    cv_status status = CV_OK;
    line->count = 0;
    for (size_t i = 0; i < curve->node_count && status == CV_OK; i++) {
        const dg_node *n = &curve->nodes[i];
        dg_vertex v = {n->q, 0, 0};
        status = value(&v, from);
        if (status == CV_OK)
            status = dg_polyline_push(line, &v, why);
        else
            cv_fail(why, status, "z not found at alpha = %.17g, delta = %g, q = %.17g", from->alpha,
                    from->delta, v.q);
    }
    return status == CV_OK ? dg_polyline_shape(line, &curve->at, value, from, why) : status;
}

static int ascending(const void *a, const void *b)
{
    const double x = ((const dg_cut *)a)->x, y = ((const dg_cut *)b)->x;
    return (x > y) - (x < y);
}

/* No root of z = c as c -> infinity; each crossing changes their number by two. */
static cv_status list_cuts(dg_stability_curve *c, const dg_curve *curve, double factor, cv_message *why)
{
    free(c->cuts);
    c->cut_count = curve->crossing_count;
    c->cuts = calloc(c->cut_count + 1, sizeof *c->cuts);
    if (c->cuts == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < c->cut_count; i++) {
        const dg_crossing *x = &curve->crossings[i];
        c->cuts[i] = (dg_cut){x->q, factor * x->x, 2 * x->direction, 0};
    }
    if (c->cut_count > 0)
        qsort(c->cuts, c->cut_count, sizeof *c->cuts, ascending);
    int right = 0;
    for (size_t i = c->cut_count; i-- > 0;) {
        c->cuts[i].right = right;
        right = c->cuts[i].left += right;
    }
    return CV_OK;
}

/* The winding around one point of each region, the middle in the logarithm */
static cv_status check_regions(const dg_stability_curve *c, dg_sampler *s, double factor, cv_message *why)
{
    for (size_t i = 0; i <= c->cut_count; i++) {
        const double low = i > 0 ? c->cuts[i - 1].x : c->x_floor;
        const double high = i < c->cut_count ? c->cuts[i].x : HUGE_VAL;
        const int expected = i < c->cut_count ? c->cuts[i].left : 0;
        if (isinf(low) || !(high - low > THIN * low))
            continue;
        int roots;
        const double middle = isinf(high) ? 2 * low : sqrt(low * high);
        const cv_status status = dg_sampler_count(&roots, s, middle / factor, why);
        if (status != CV_OK)
            return status;
        if (roots != expected)
            return cv_fail(why, CV_UNDECIDED, "%d roots of z = %g by the winding, %d by the crossings", roots,
                           middle, expected);
    }
    return CV_OK;
}

cv_status dg_stability_curve_at(dg_stability_curve *c, dg_sampler *s, double alpha, double factor,
                                double delta, cv_message *why)
{
    source on_axis = {dg_sampler_probe(s), alpha, factor, 0}, beside = on_axis;
    beside.delta = delta;
    c->x_floor = FLOOR;
    cv_status status = dg_sampler_curve(s, alpha, FLOOR / factor, why);
    if (status == CV_OK)
        status = list_cuts(c, &s->curve, factor, why);
    if (status == CV_OK)
        status = check_regions(c, s, factor, why);
    if (status == CV_OK)
        status = dg_sampler_count(&c->unstable, s, 1 / factor, why);
    if (status == CV_OK)
        status = draw(&c->boundary, &s->curve, &on_axis, why);
    return status == CV_OK ? draw(&c->shifted, &s->curve, &beside, why) : status;
}

void dg_stability_curve_clear(dg_stability_curve *c)
{
    dg_polyline_clear(&c->boundary);
    dg_polyline_clear(&c->shifted);
    free(c->cuts);
    *c = (dg_stability_curve){0};
}
