#include "dgreen/lines_graph.h"

#include <math.h>
#include <stdlib.h>

int dg_line_add(dg_line_graph *g, const dg_followed *is)
{
    if (g->node_count == g->node_room) {
        const size_t room = g->node_room ? 2 * g->node_room : 1024;
        dg_line_node *grown = realloc(g->nodes, room * sizeof *grown);
        if (grown == NULL)
            return DG_LINE_NONE;
        g->nodes = grown;
        g->node_room = room;
    }
    g->nodes[g->node_count] = (dg_line_node){.is = *is,
                                             .stable_roots = -1,
                                             .link = {DG_LINE_NONE, DG_LINE_NONE},
                                             .exit = {DG_LINE_UNDECIDED, DG_LINE_UNDECIDED}};
    return (int)g->node_count++;
}

void dg_line_join(dg_line_graph *g, int a, int a_side, int b, int b_side)
{
    g->nodes[a].link[a_side] = b;
    g->nodes[a].back[a_side] = b_side;
    g->nodes[b].link[b_side] = a;
    g->nodes[b].back[b_side] = a_side;
}

cv_status dg_line_doubt_add(dg_line_graph *g, double low, double high, const char *reason)
{
    dg_lines *l = g->lines;
    dg_line_doubt *grown = realloc(l->doubts, (l->doubt_count + 1) * sizeof *grown);
    if (grown == NULL)
        return cv_fail(g->why, CV_FAILED, "out of memory");
    l->doubts = grown;
    dg_line_doubt *doubt = &grown[l->doubt_count++];
    doubt->alpha_low = low;
    doubt->alpha_high = high;
    cv_fail(&doubt->why, CV_UNDECIDED, "%s between alpha = %.17g and %.17g", reason, low, high);
    return CV_OK;
}

/* With the logarithm of x as ordinate: a cubic leaves its chord in the middle by (difference of slopes)
 * width/8. */
double dg_line_sagitta(const dg_line_graph *g, const dg_followed *l, const dg_followed *r)
{
    const double width = r->alpha - l->alpha;
    const double u = width / g->scale_alpha, v = log(r->at.x / l->at.x) / g->scale_log;
    const double bend = (l->at.dx / l->at.x - r->at.dx / r->at.x) * width / 8 / g->scale_log;
    return fabs(bend) * u / hypot(u, v);
}

/* Twice the balance of the crossings beyond crossing i, less two where it takes two roots away */
static int stable_roots(const dg_curve *c, size_t i)
{
    const dg_crossing *here = &c->crossings[i];
    int balance = here->direction > 0 ? 0 : -2;
    for (size_t k = 0; k < c->crossing_count; k++)
        if (c->crossings[k].x > here->x)
            balance += 2 * c->crossings[k].direction;
    return balance;
}

cv_status dg_line_column_at(dg_line_column *c, dg_line_graph *g, double alpha)
{
    const cv_status status = dg_curve_at(&c->curve, &g->probe, alpha, g->x_floor, g->why);
    if (status != CV_OK)
        return status;
    c->first = (int)g->node_count;
    for (size_t i = 0; i < c->curve.crossing_count; i++) {
        const dg_followed is = {alpha, c->curve.crossings[i]};
        const int node = dg_line_add(g, &is);
        if (node == DG_LINE_NONE)
            return cv_fail(g->why, CV_FAILED, "out of memory");
        g->nodes[node].stable_roots = stable_roots(&c->curve, i);
    }
    return CV_OK;
}
