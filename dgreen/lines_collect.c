/* Linked crossings become lines: in order, directed, cut at the ends of the range of eta_M. */
#include <stdlib.h>
#include <string.h>

#include "dgreen/lines_shape.h"

typedef struct {
    dg_line_graph *g;
    char *seen;   /* per node */
    size_t count; /* of the line that is being collected */
    int *order;   /* its nodes */
    int closed;
    int first_side, last_side; /* the sides where an open line ends */
} collector;

/* Follows the links from node "start", which is left through "side". */
static void trace(collector *c, int start, int side)
{
    int n = start;
    c->count = 0;
    c->closed = 0;
    c->first_side = 1 - side;
    for (;;) {
        const dg_line_node *node = &c->g->nodes[n];
        c->order[c->count++] = n;
        c->seen[n] = 1;
        c->last_side = side;
        const int next = node->link[side];
        if (next == DG_LINE_NONE)
            return;
        side = 1 - node->back[side];
        n = next;
        if (n == start) {
            c->closed = 1;
            c->order[c->count++] = n;
            return;
        }
    }
}

/* Two more roots are unstable on the left: where Im zeta falls through the axis as q grows, alpha must grow
 * along the line, elsewhere fall. 0: neither direction does that everywhere. */
static int directed(collector *c, int *reverse)
{
    int agree = 0, differ = 0;
    for (size_t i = 0; i + 1 < c->count; i++) {
        const int from = c->order[i], to = c->order[i + 1];
        const dg_line_node *a = &c->g->nodes[from], *b = &c->g->nodes[to];
        /* by the links: next to a turning point two velocities may be the same double */
        const int grows = a->turns ? b->link[DG_LINE_LOWER] == from : a->link[DG_LINE_HIGHER] == to;
        *(grows == ((a->turns ? b : a)->is.at.direction > 0) ? &agree : &differ) += 1;
    }
    *reverse = differ > agree;
    return agree == 0 || differ == 0;
}

static void reverse_order(collector *c)
{
    for (size_t i = 0, k = c->count - 1; i < k; i++, k--) {
        const int kept = c->order[i];
        c->order[i] = c->order[k];
        c->order[k] = kept;
    }
    const int kept = c->first_side;
    c->first_side = c->last_side;
    c->last_side = kept;
}

static int beyond(const dg_line_graph *g, const dg_line_node *n)
{
    return n->is.at.x < g->x_min ? -1 : n->is.at.x > g->x_max;
}

/* A closed line that leaves the range begins outside, so that it is cut like an open one. */
static cv_status begin_outside(collector *c)
{
    const size_t n = c->count - 1; /* the last node repeats the first */
    size_t first = 0;
    while (first < n && !beyond(c->g, &c->g->nodes[c->order[first]]))
        first++;
    if (first == n)
        return CV_OK;
    int *rotated = malloc(c->count * sizeof *rotated);
    if (rotated == NULL)
        return cv_fail(c->g->why, CV_FAILED, "out of memory");
    for (size_t i = 0; i <= n; i++)
        rotated[i] = c->order[(first + i) % n];
    memcpy(c->order, rotated, c->count * sizeof *rotated);
    free(rotated);
    c->closed = 0;
    return CV_OK;
}

/* The end of a piece between nodes a (inside) and b */
static cv_status push_boundary(dg_line_graph *g, dg_line_piece *p, dg_line_exit *exit, const dg_line_node *a,
                               const dg_line_node *b)
{
    const int low = beyond(g, b) < 0;
    dg_line_node point;
    *exit = low ? DG_LINE_TOP : DG_LINE_BOTTOM;
    const cv_status status = dg_line_boundary(&point, g, a, b, low ? g->x_min : g->x_max);
    return status == CV_OK ? dg_line_piece_push(p, &point, g->why) : status;
}

/* The last crossing of the line beyond the end "end" of a piece that leaves the range with node i of the
 * order; NULL: it comes back into the range, or crosses it. */
static const dg_line_node *last_beyond(const collector *c, size_t i, int end)
{
    const size_t last = end ? c->count - 1 : 0;
    const int side = beyond(c->g, &c->g->nodes[c->order[i]]);
    for (; beyond(c->g, &c->g->nodes[c->order[i]]) == side; i += end ? 1 : (size_t)-1)
        if (i == last)
            return c->closed ? NULL : &c->g->nodes[c->order[i]];
    return NULL;
}

/* What the line does beyond the end "end" of a piece, node i of the order being the outermost that is known.
 */
static void look_beyond(collector *c, dg_line_piece *p, size_t i, int end)
{
    const dg_line_node *h = last_beyond(c, i, end);
    if (h == NULL)
        return;
    const dg_line_exit exit = h->exit[end ? c->last_side : c->first_side];
    if (exit == DG_LINE_ALPHA_MAX)
        p->zero_mass[end] = dg_line_runs_to_zero_mass(c->g, &h->is);
    if (exit != DG_LINE_TOP || c->count < 2)
        return;
    const dg_line_node *before = &c->g->nodes[c->order[end ? c->count - 2 : 1]];
    if (dg_line_runs_to_infinity(&p->asymptote[end], &p->asymptote_q[end], c->g, &before->is, &h->is))
        p->exits[end] = DG_LINE_INFINITE_MASS;
}

/* One end of a piece whose outermost node inside the range is node i of the order */
static cv_status end_piece(collector *c, dg_line_piece *p, size_t i, int end)
{
    dg_line_graph *g = c->g;
    const dg_line_node here = g->nodes[c->order[i]];
    p->asymptote[end] = p->asymptote_q[end] = p->zero_mass[end] = 0;
    if (i == (end ? c->count - 1 : 0)) {
        p->exits[end] = c->closed ? DG_LINE_CLOSED : here.exit[end ? c->last_side : c->first_side];
        if (!c->closed)
            look_beyond(c, p, i, end);
        return CV_OK;
    }
    const size_t outside = end ? i + 1 : i - 1;
    const cv_status status = push_boundary(g, p, &p->exits[end], &here, &g->nodes[c->order[outside]]);
    if (status == CV_OK)
        look_beyond(c, p, outside, end);
    return status;
}

/* Cuts the line in c->order into pieces inside the range. */
static cv_status cut(collector *c)
{
    dg_line_graph *g = c->g;
    dg_line_piece p = {0};
    cv_status status = CV_OK;
    for (size_t i = 0; i < c->count && status == CV_OK; i++) {
        const dg_line_node here = g->nodes[c->order[i]];
        if (beyond(g, &here))
            continue;
        if (p.count == 0)
            status = end_piece(c, &p, i, 0);
        if (status == CV_OK)
            status = dg_line_piece_push(&p, &here, g->why);
        if (i + 1 < c->count && !beyond(g, &g->nodes[c->order[i + 1]]))
            continue;
        if (status == CV_OK)
            status = end_piece(c, &p, i, 1);
        if (status == CV_OK)
            status = dg_line_finish(g, &p);
        p.count = 0;
    }
    free(p.points);
    return status;
}

static cv_status collect_one(collector *c)
{
    int reverse;
    const int consistent = directed(c, &reverse);
    const double first = c->g->nodes[c->order[0]].is.alpha,
                 last = c->g->nodes[c->order[c->count - 1]].is.alpha;
    if (reverse)
        reverse_order(c);
    cv_status status = c->closed ? begin_outside(c) : CV_OK;
    if (status == CV_OK)
        status = cut(c);
    if (status == CV_OK && !consistent)
        return dg_line_doubt_add(c->g, first < last ? first : last, first < last ? last : first,
                                 "a line without a direction");
    return status;
}

static int ascending(const void *a, const void *b)
{
    const dg_line *x = a, *y = b;
    double low[2] = {x->vertices[0].alpha, y->vertices[0].alpha};
    for (size_t i = 0; i < x->count; i++)
        low[0] = x->vertices[i].alpha < low[0] ? x->vertices[i].alpha : low[0];
    for (size_t i = 0; i < y->count; i++)
        low[1] = y->vertices[i].alpha < low[1] ? y->vertices[i].alpha : low[1];
    return (low[0] > low[1]) - (low[0] < low[1]);
}

cv_status dg_line_collect(dg_line_graph *g)
{
    const size_t n = g->node_count;
    collector c = {.g = g, .seen = calloc(n + 1, 1), .order = malloc((n + 2) * sizeof(int))};
    cv_status status = c.seen && c.order ? CV_OK : cv_fail(g->why, CV_FAILED, "out of memory");
    for (int round = 0; round < 2; round++) /* open lines first: from their ends */
        for (size_t i = 0; i < n && status == CV_OK; i++) {
            const dg_line_node *node = &g->nodes[i];
            const int open_low = node->link[DG_LINE_LOWER] == DG_LINE_NONE;
            const int open_high = node->link[DG_LINE_HIGHER] == DG_LINE_NONE;
            if (c.seen[i] || (round == 0 && !open_low && !open_high))
                continue;
            trace(&c, (int)i, open_high && !open_low ? DG_LINE_LOWER : DG_LINE_HIGHER);
            status = collect_one(&c);
        }
    free(c.seen);
    free(c.order);
    if (status == CV_OK && g->lines->count > 0)
        qsort(g->lines->lines, g->lines->count, sizeof *g->lines->lines, ascending);
    return status;
}
