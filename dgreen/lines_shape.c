#include "dgreen/lines_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Distance from the chord up to which a point is left out, units of the plot */
static const double THIN = 6e-4;
enum { MAX_STEPS = 60 };
/* A vertex stays where it is when its x at exactly this double alpha differs more (relative) */
static const double SAME_X = 1e-6;

cv_status dg_line_piece_push(dg_line_piece *p, const dg_line_node *point, cv_message *why)
{
    if (p->count == p->room) {
        const size_t room = p->room ? 2 * p->room : 256;
        dg_line_node *grown = realloc(p->points, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        p->points = grown;
        p->room = room;
    }
    p->points[p->count++] = *point;
    return CV_OK;
}

/* Halving in alpha with the value(x, dx) of the crossing, which is negative on one side */
typedef double property(const dg_crossing *c, double bound);

static double logarithm(const dg_crossing *c, double bound)
{
    return log(c->x / bound);
}

static double slope(const dg_crossing *c, double bound)
{
    (void)bound;
    return c->dx;
}

/* Between l and r, where the property changes sign: secant steps, every third a halving. Ends where the
 * velocities are as close as matters in the plot, or no more crossing is found. */
static void locate(dg_followed *l, dg_followed *r, dg_line_graph *g, property *value, double bound)
{
    for (int i = 0; i < MAX_STEPS; i++) {
        const double low = value(&l->at, bound), high = value(&r->at, bound), width = r->alpha - l->alpha;
        if (!(width > 1e-12 * g->scale_alpha) || low == 0 || high == 0 || fabs(log(l->at.x / r->at.x)) < 1e-9)
            return;
        const double part = i % 3 == 2 ? 0.5 : fmin(fmax(low / (low - high), 0.01), 0.99);
        dg_followed middle = {.alpha = l->alpha + part * width};
        if (!(middle.alpha > l->alpha && middle.alpha < r->alpha) ||
            dg_line_between(&middle, g, l, r) != CV_OK)
            return;
        *((value(&middle.at, bound) > 0) == (low > 0) ? l : r) = middle;
    }
}

cv_status dg_line_boundary(dg_line_node *out, dg_line_graph *g, const dg_line_node *a, const dg_line_node *b,
                           double bound)
{
    const int up = a->is.alpha < b->is.alpha;
    dg_followed l = up ? a->is : b->is, r = up ? b->is : a->is;
    if (!a->turns && !b->turns)
        locate(&l, &r, g, logarithm, bound);
    const double part = log(bound / l.at.x) / log(r.at.x / l.at.x);
    *out = *a;
    out->turns = 0;
    out->is = part < 0.5 ? l : r;
    out->is.alpha = l.alpha + part * (r.alpha - l.alpha);
    out->is.at.q = l.at.q + part * (r.at.q - l.at.q);
    out->is.at.x = bound;
    return CV_OK;
}

/* The greatest x: the node that has it, or a point beside it where the slope vanishes, which is put in. */
static cv_status put_greatest(dg_line_graph *g, dg_line_piece *p, size_t *greatest)
{
    size_t k = 0;
    for (size_t i = 1; i < p->count; i++)
        if (p->points[i].is.at.x > p->points[k].is.at.x)
            k = i;
    *greatest = k;
    if (k == 0 || k + 1 == p->count || p->points[k].turns)
        return CV_OK;
    const int rises = p->points[k].is.at.dx > 0; /* as alpha grows: the extreme is above */
    const size_t other = (p->points[k + 1].is.alpha > p->points[k].is.alpha) == rises ? k + 1 : k - 1;
    dg_line_node point = p->points[k];
    if (p->points[other].turns || (p->points[other].is.at.dx > 0) == rises)
        return CV_OK;
    dg_followed l = p->points[rises ? k : other].is, r = p->points[rises ? other : k].is;
    locate(&l, &r, g, slope, 0);
    point.is = l.at.x > r.at.x ? l : r;
    if (!(point.is.at.x > p->points[k].is.at.x))
        return CV_OK;
    const size_t at = other > k ? k + 1 : k;
    const cv_status status = dg_line_piece_push(p, &point, g->why);
    if (status != CV_OK)
        return status;
    memmove(&p->points[at + 1], &p->points[at], (p->count - 1 - at) * sizeof *p->points);
    p->points[at] = point;
    *greatest = at;
    return CV_OK;
}

/* Distance of point c from the chord a-b in the plot */
static double distance(const dg_line_graph *g, const dg_line_node *a, const dg_line_node *b,
                       const dg_line_node *c)
{
    const double u = (b->is.alpha - a->is.alpha) / g->scale_alpha,
                 v = log(b->is.at.x / a->is.at.x) / g->scale_log;
    const double x = (c->is.alpha - a->is.alpha) / g->scale_alpha,
                 y = log(c->is.at.x / a->is.at.x) / g->scale_log;
    const double length = u * u + v * v;
    const double along = length > 0 ? fmin(fmax((x * u + y * v) / length, 0), 1) : 0;
    return hypot(x - along * u, y - along * v);
}

/* Marks the points between first and last that must stay (Ramer, Douglas and Peucker). */
static void thin(const dg_line_graph *g, const dg_line_piece *p, char *stays, size_t first, size_t last)
{
    size_t farthest = first;
    double most = THIN;
    for (size_t i = first + 1; i < last; i++) {
        const double d = distance(g, &p->points[first], &p->points[last], &p->points[i]);
        if (!(d <= most)) {
            most = d;
            farthest = i;
        }
    }
    if (farthest == first)
        return;
    stays[farthest] = 1;
    thin(g, p, stays, first, farthest);
    thin(g, p, stays, farthest, last);
}

static void mark(const dg_line_graph *g, const dg_line_piece *p, size_t greatest, char *stays)
{
    size_t last = 0;
    stays[0] = 1;
    for (size_t i = 1; i < p->count; i++) {
        if (i + 1 != p->count && i != greatest && !p->points[i].turns &&
            !(p->exits[0] == DG_LINE_CLOSED && i == p->count / 2))
            continue;
        stays[i] = 1;
        thin(g, p, stays, last, i);
        last = i;
    }
}

static dg_line_vertex vertex(const dg_line_graph *g, const dg_line_node *n)
{
    dg_followed is = n->is;
    const dg_crossing *c = &is.at;
    if (!n->turns)
        dg_line_polish(&is, g);
    double error = fmax(c->q_high - c->q, c->q - c->q_low);
    if (n->turns || !(fabs(log(c->x / n->is.at.x)) < SAME_X)) {
        is = n->is; /* so steep that a spacing of alpha changes x */
        error = HUGE_VAL;
    }
    return (dg_line_vertex){is.alpha, c->q, 1 / c->x, error, c->scale, n->turns, n->stable_roots};
}

static cv_status append(dg_line_graph *g, const dg_line *line)
{
    dg_lines *all = g->lines;
    dg_line *grown = realloc(all->lines, (all->count + 1) * sizeof *grown);
    if (grown == NULL)
        return cv_fail(g->why, CV_FAILED, "out of memory");
    all->lines = grown;
    all->lines[all->count++] = *line;
    return CV_OK;
}

cv_status dg_line_finish(dg_line_graph *g, dg_line_piece *p)
{
    size_t greatest;
    cv_status status = put_greatest(g, p, &greatest);
    if (status != CV_OK)
        return status;
    char *stays = calloc(p->count, 1);
    dg_line line = {.vertices = calloc(p->count, sizeof *line.vertices),
                    .exits = {p->exits[0], p->exits[1]},
                    .asymptote = {p->asymptote[0], p->asymptote[1]},
                    .zero_mass = {p->zero_mass[0], p->zero_mass[1]},
                    .asymptote_q = {p->asymptote_q[0], p->asymptote_q[1]}};
    if (stays == NULL || line.vertices == NULL) {
        free(stays);
        free(line.vertices);
        return cv_fail(g->why, CV_FAILED, "out of memory");
    }
    mark(g, p, greatest, stays);
    for (size_t i = 0; i < p->count; i++) {
        if (!stays[i])
            continue;
        if (i == greatest)
            line.least = line.count;
        line.vertices[line.count++] = vertex(g, &p->points[i]);
    }
    free(stays);
    status = append(g, &line);
    if (status != CV_OK)
        free(line.vertices);
    return status;
}
