#include <float.h>
#include <math.h>

#include "dgreen/lines_graph.h"
#include "dgreen/velocities.h"

enum { MAX_DEPTH = 40 };
/* log x counts as smooth between two samples when the trapezoidal rule on its slopes misses the change by
 * less than this part of the change and this much more, at most by LARGEST_TOLERANCE. */
static const double CHANGE_TOLERANCE = 0.25, LOG_TOLERANCE = 0.05, LARGEST_TOLERANCE = 0.3;
/* Chord error of the polyline before vertices are left out, units of the plot */
static const double CHORD = 3e-4;
/* Beyond this many times the greatest x of the range nothing is drawn. */
static const double FAR = 3;

static int smooth(const dg_followed *l, const dg_followed *r)
{
    const double change = log(r->at.x / l->at.x);
    const double trapezoid = (r->alpha - l->alpha) * (l->at.dx / l->at.x + r->at.dx / r->at.x) / 2;
    return fabs(change - trapezoid) <=
           fmin(CHANGE_TOLERANCE * fabs(change) + LOG_TOLERANCE, LARGEST_TOLERANCE);
}

static int out_of_range(const dg_line_graph *g, const dg_followed *l, const dg_followed *r)
{
    return fmax(l->at.x, r->at.x) < g->x_hidden || fmin(l->at.x, r->at.x) > FAR * g->x_max;
}

static cv_status follow(dg_line_graph *g, int a, int b, int alike, int depth)
{
    const dg_followed l = g->nodes[a].is, r = g->nodes[b].is;
    if (out_of_range(g, &l, &r) || (smooth(&l, &r) && dg_line_sagitta(g, &l, &r) < CHORD)) {
        dg_line_join(g, a, DG_LINE_HIGHER, b, DG_LINE_LOWER);
        return CV_OK;
    }
    if (depth == 0 || !(r.alpha - l.alpha > 8 * DBL_EPSILON * r.alpha))
        return CV_UNDECIDED;
    dg_followed middle = {.alpha = dg_velocities_middle(g->probe.branches, l.alpha, r.alpha)};
    cv_status status = dg_crossing_between(&middle, &g->station, &g->probe, &l, &r, alike, g->why);
    if (status != CV_OK)
        return status;
    const int m = dg_line_add(g, &middle);
    if (m == DG_LINE_NONE)
        return cv_fail(g->why, CV_FAILED, "out of memory");
    status = follow(g, a, m, alike, depth - 1);
    return status == CV_OK ? follow(g, m, b, alike, depth - 1) : status;
}

cv_status dg_line_follow(dg_line_graph *g, int a, int b, int alike)
{
    return follow(g, a, b, alike, MAX_DEPTH);
}
