/* Points of lines that have been found: between two linked nodes, at one velocity, at one mass ratio. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/branch_points_hunt.h"
#include "dgreen/lines_graph.h"

/* The nodes on both sides have x beyond the one asked for by this factor: so has the line between them, which
 * is smooth there. */
static const double CLEARLY = 2;

cv_status dg_line_between(dg_followed *m, dg_line_graph *g, const dg_followed *l, const dg_followed *r)
{
    cv_status status = dg_station_set(&g->station, g->probe.branches, l->alpha, g->why);
    const size_t hard = g->station.hard_count;
    if (status == CV_OK)
        status = dg_station_set(&g->station, g->probe.branches, r->alpha, g->why);
    const int alike = hard == g->station.hard_count;
    return status == CV_OK ? dg_crossing_between(m, &g->station, &g->probe, l, r, alike, g->why) : status;
}

typedef struct {
    const dg_probe *probe;
    double alpha;
    dg_node low, high;
} bracket;

/* Moves one end to q, if that is inside and its sign is certain. */
static int move_end(bracket *b, double q)
{
    dg_node next;
    if (!(q > b->low.q && q < b->high.q) || dg_probe_at(&next, b->probe, b->alpha, q) != CV_OK)
        return 0;
    *((next.im > 0) == (b->low.im > 0) ? &b->low : &b->high) = next;
    return 1;
}

/* Closes in on both sides of q, at growing distances until it is between the ends. */
static void close_in(bracket *b, double q)
{
    const double width = b->high.q - b->low.q;
    for (double d = fmax(4 * DBL_EPSILON * q, 1e-8 * width); d < width; d *= 30) {
        move_end(b, q - d);
        move_end(b, q + d);
        if (b->low.q >= q - d && b->high.q <= q + d)
            return;
    }
}

void dg_line_polish(dg_followed *f, const dg_line_graph *g)
{
    enum { STEPS = 24 };
    dg_crossing *c = &f->at;
    bracket b = {.probe = &g->probe, .alpha = f->alpha};
    if (dg_probe_at(&b.low, b.probe, f->alpha, c->q_low) != CV_OK ||
        dg_probe_at(&b.high, b.probe, f->alpha, c->q_high) != CV_OK || (b.low.im > 0) == (b.high.im > 0))
        return;
    close_in(&b, c->q);
    for (int i = 0; i < STEPS && b.high.q - b.low.q > 4 * DBL_EPSILON * b.high.q; i++) {
        const double zero = b.low.q + b.low.im / (b.low.im - b.high.im) * (b.high.q - b.low.q);
        const double beside = fmax(2 * DBL_EPSILON * zero, 1e-3 * fmin(zero - b.low.q, b.high.q - zero));
        const double middle = b.low.q + (b.high.q - b.low.q) / 2;
        if (!move_end(&b, i % 3 == 2 ? middle : i % 3 ? zero + beside : zero - beside) && i % 3 == 2)
            break;
    }
    const double part = b.low.im / (b.low.im - b.high.im);
    c->q_low = b.low.q;
    c->q_high = b.high.q;
    c->q = b.low.q + part * (b.high.q - b.low.q);
    c->x = b.low.re + part * (b.high.re - b.low.re);
    c->x_low = fmin(b.low.re - b.low.re_error, b.high.re - b.high.re_error);
    c->x_high = fmax(b.low.re + b.low.re_error, b.high.re + b.high.re_error);
}

static int in_doubt(const dg_lines *l, double alpha)
{
    for (size_t i = 0; i < l->doubt_count; i++)
        if (alpha >= l->doubts[i].alpha_low && alpha <= l->doubts[i].alpha_high)
            return 1;
    return 0;
}

/* Adds the line from l to r to the balance if it passes alpha beyond x. */
static cv_status weigh(int *balance, dg_line_graph *g, const dg_line_node *a, const dg_line_node *b,
                       double alpha, double x)
{
    const dg_followed *l = &a->is, *r = &b->is;
    if (a->turns || b->turns)
        return CV_UNDECIDED; /* as near to a turning point as doubles go */
    if (fmax(l->at.x, r->at.x) * CLEARLY < x)
        return CV_OK;
    if (fmin(l->at.x, r->at.x) > x * CLEARLY) {
        *balance += 2 * l->at.direction;
        return CV_OK;
    }
    dg_followed m = {alpha, alpha == l->alpha ? l->at : r->at};
    if (alpha > l->alpha && alpha < r->alpha) {
        const cv_status status = dg_line_between(&m, g, l, r);
        if (status != CV_OK)
            return status;
    }
    if (m.at.x_low <= x && m.at.x_high >= x)
        dg_line_polish(&m, g);
    if (m.at.x_low <= x && m.at.x_high >= x)
        return CV_UNDECIDED;
    *balance += m.at.x > x ? 2 * m.at.direction : 0;
    return CV_OK;
}

cv_status dg_lines_count(int *roots, const dg_lines *l, double alpha, double mass_ratio, cv_message *why)
{
    dg_line_graph *g = l->graph;
    if (!(alpha >= l->alpha_min && alpha <= l->alpha_max && mass_ratio > 0 && mass_ratio <= l->mass_max))
        return cv_fail(why, CV_BAD_INPUT, "alpha = %.17g, eta_M = %.17g is outside the range", alpha,
                       mass_ratio);
    cv_status status = in_doubt(l, alpha) ? CV_UNDECIDED : CV_OK;
    *roots = 0;
    for (size_t i = 0; i < g->node_count && status == CV_OK; i++) {
        const dg_line_node *a = &g->nodes[i];
        const int next = a->turns ? DG_LINE_NONE : a->link[DG_LINE_HIGHER];
        if (next == DG_LINE_NONE)
            continue;
        const dg_line_node *b = &g->nodes[next];
        /* the last velocity belongs to the last cell */
        if (a->is.alpha <= alpha && (alpha < b->is.alpha || (alpha == b->is.alpha && alpha == l->alpha_max)))
            status = weigh(roots, g, a, b, alpha, 1 / mass_ratio);
    }
    if (status != CV_OK)
        return cv_fail(why, status, "on a line or in doubt at alpha = %.17g, eta_M = %.17g", alpha,
                       mass_ratio);
    return CV_OK;
}

/* The hunt for passages on the line from l to r */
typedef struct {
    dg_line_graph *g;
    dg_followed l, r;
    double x;
    size_t count, room;
    dg_line_passage *found;
} hunt;

static cv_status excess(dg_sample *s, void *context)
{
    hunt *h = context;
    dg_followed m = {.alpha = s->at};
    const cv_status status = dg_line_between(&m, h->g, &h->l, &h->r);
    s->value = log(m.at.x / h->x);
    s->slope = m.at.dx / m.at.x;
    s->aside = m.at.q;
    return status;
}

static cv_status add_passage(hunt *h, double alpha, double q, int change)
{
    if (h->count == h->room) {
        const size_t room = h->room ? 2 * h->room : 16;
        dg_line_passage *grown = realloc(h->found, room * sizeof *grown);
        if (grown == NULL)
            return CV_FAILED;
        h->found = grown;
        h->room = room;
    }
    h->found[h->count++] = (dg_line_passage){alpha, q, change};
    return CV_OK;
}

static cv_status found(const dg_sample *low, const dg_sample *high, void *context)
{
    hunt *h = context;
    const dg_hunter hunter = {excess, NULL, h};
    dg_sample zero;
    cv_status status = dg_hunt_refine(&zero, &hunter, low, high);
    dg_followed m = {.alpha = zero.at};
    if (status == CV_OK)
        status = dg_line_between(&m, h->g, &h->l, &h->r);
    if (status != CV_OK)
        return status;
    dg_line_polish(&m, h->g); /* and one step of Newton's method from there */
    const double step = (h->x - m.at.x) / m.at.dx;
    const int change = (high->value >= 0 ? 2 : -2) * h->l.at.direction;
    return add_passage(h, m.alpha + step, m.at.q + m.at.dq * step, change);
}

/* In the turning point itself, where doubles do not resolve alpha: on the side where the pair exists, the
 * crossing with the greater x alone counts. */
static cv_status pass_tip(hunt *h, const dg_line_node *tip)
{
    const dg_line_node *a = &h->g->nodes[tip->link[0]], *b = &h->g->nodes[tip->link[1]];
    if ((a->is.at.x > h->x) == (b->is.at.x > h->x))
        return CV_OK;
    const dg_line_node *greater = a->is.at.x > b->is.at.x ? a : b;
    const double part = log(h->x / a->is.at.x) / log(b->is.at.x / a->is.at.x);
    const int born = a->is.alpha > tip->is.alpha;
    return add_passage(h, tip->is.alpha, a->is.at.q + part * (b->is.at.q - a->is.at.q),
                       (born ? 2 : -2) * greater->is.at.direction);
}

/* The passages between node a and b, its neighbour on one of its sides */
static cv_status hunt_between(hunt *h, const dg_line_node *a, const dg_line_node *b)
{
    const dg_hunter hunter = {excess, found, h};
    h->l = a->is;
    h->r = b->is;
    if (fmax(h->l.at.x, h->r.at.x) * CLEARLY < h->x || fmin(h->l.at.x, h->r.at.x) > h->x * CLEARLY)
        return CV_OK;
    const dg_sample low = {h->l.alpha, log(h->l.at.x / h->x), h->l.at.dx / h->l.at.x, h->l.at.q};
    const dg_sample high = {h->r.alpha, log(h->r.at.x / h->x), h->r.at.dx / h->r.at.x, h->r.at.q};
    return dg_hunt_zeros(&hunter, &low, &high);
}

static int ascending(const void *a, const void *b)
{
    const double x = ((const dg_line_passage *)a)->alpha, y = ((const dg_line_passage *)b)->alpha;
    return (x > y) - (x < y);
}

cv_status dg_lines_passages(dg_line_passage **out, size_t *count, const dg_lines *l, double mass_ratio,
                            cv_message *why)
{
    dg_line_graph *g = l->graph;
    hunt h = {.g = g, .x = 1 / mass_ratio};
    cv_status status = mass_ratio >= l->mass_min && mass_ratio <= l->mass_max ? CV_OK : CV_BAD_INPUT;
    for (size_t i = 0; i < g->node_count && status == CV_OK; i++) {
        const dg_line_node *a = &g->nodes[i];
        const int next = a->link[DG_LINE_HIGHER];
        if (a->turns)
            status = pass_tip(&h, a);
        else if (next != DG_LINE_NONE && !g->nodes[next].turns)
            status = hunt_between(&h, a, &g->nodes[next]);
    }
    *out = h.found;
    *count = h.count;
    if (status == CV_OK) {
        if (h.count > 0)
            qsort(h.found, h.count, sizeof *h.found, ascending);
        return CV_OK;
    }
    free(h.found);
    *out = NULL;
    *count = 0;
    return cv_fail(why, status, "passages of the mass ratio %.17g not resolved", mass_ratio);
}
