/* Where a line goes on that has left the range at the greatest eta_M. */
#include <float.h>
#include <math.h>

#include "dgreen/lines_graph.h"

enum { MAX_STEPS = 40 };
/* First half-width of the search for a crossing, part of the distance it has moved */
static const double FIRST_PART = 0.03;
/* On its way to q = 0 a line comes nearer to the asymptote at least like q and at most like q^2: exponents
 * with room. */
static const double LEAST_EXPONENT = 0.5, MOST_EXPONENT = 3;
/* It is followed from one frequency to the next by this factor, this many times; each time the distance to
 * the asymptote must be what the exponent says within the wider of these factors. */
static const double SHRINK = 0.85;
enum { SHRINKS = 25, HALVINGS = 6 };
static const double NARROW = 1.05, WIDE = 1.2;
/* Distance from the asymptote (relative) below which doubles see nothing */
static const double CLOSEST = 1e-12;

/* The nearest asymptote on one side of h (1: above) where q -> 0 for positive masses; 0: none */
static double nearest(const dg_line_graph *g, double alpha, int above)
{
    const dg_asymptote_list *list = &g->lines->asymptotes;
    double best = 0;
    for (size_t i = 0; i < list->count; i++) {
        const double at = mpfr_get_d(list->items[i].alpha, MPFR_RNDN);
        if (list->items[i].positive && (at > alpha) == above && !(fabs(at - alpha) > fabs(best - alpha)))
            best = at;
    }
    return best;
}

static cv_status sign_at(int *positive, const dg_line_graph *g, double alpha, double q)
{
    dg_node node;
    const cv_status status = dg_probe_at(&node, &g->probe, alpha, q);
    *positive = status == CV_OK && node.im > 0;
    return status;
}

/* Improves "distance" at the frequency q: where Im zeta changes sign along alpha, within the factor "within",
 * with the sign *nearer on the side of the asymptote; -1: any, which is then set. */
static int locate(double *distance, int *nearer, const dg_line_graph *g, double asymptote, double q,
                  double within)
{
    double low = *distance / within, high = *distance * within;
    int at_low, at_high, at_middle;
    if (sign_at(&at_low, g, asymptote + low, q) != CV_OK ||
        sign_at(&at_high, g, asymptote + high, q) != CV_OK || at_low == at_high ||
        (*nearer >= 0 && at_low != *nearer))
        return 0;
    *nearer = at_low;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        if (sign_at(&at_middle, g, asymptote + middle, q) != CV_OK)
            return 0;
        *(at_middle == at_low ? &low : &high) = middle;
    }
    *distance = (low + high) / 2;
    return 1;
}

/* Whether the line through "before" and h comes to q = 0 at the asymptote */
static int approaches(const dg_line_graph *g, const dg_followed *before, const dg_followed *h,
                      double asymptote)
{
    double distance = h->alpha - asymptote, q = h->at.q;
    int nearer = -1;
    if (fabs(distance) <= CLOSEST * asymptote)
        return 1;
    if (!(before->at.q > q) || !locate(&distance, &nearer, g, asymptote, q, NARROW))
        return 0;
    double exponent = log((before->alpha - asymptote) / distance) / log(before->at.q / q);
    for (int i = 0; i < SHRINKS && fabs(distance) > CLOSEST * asymptote; i++) {
        const double last = distance;
        if (!(exponent > LEAST_EXPONENT && exponent < MOST_EXPONENT))
            return 0;
        q *= SHRINK;
        distance *= pow(SHRINK, exponent);
        if (!locate(&distance, &nearer, g, asymptote, q, NARROW) &&
            !locate(&distance, &nearer, g, asymptote, q, WIDE))
            return 0;
        exponent = log(distance / last) / log(SHRINK);
    }
    return 1;
}

/* The crossing at alpha near the one at h: a change of sign of the same direction around the place where the
 * slope leads, as near as it is found. */
static cv_status step(dg_followed *m, dg_line_graph *g, const dg_followed *h, double alpha)
{
    const double moved = h->at.dq * (alpha - h->alpha), q = h->at.q + moved;
    cv_status status = dg_station_set(&g->station, g->probe.branches, alpha, g->why);
    m->alpha = alpha;
    for (double half = fmax(FIRST_PART * fabs(moved), 1e-14 * q); status == CV_OK && half < h->at.scale;
         half *= 4) {
        dg_node low, high;
        status = q > half ? dg_probe_at(&low, &g->probe, alpha, q - half) : CV_UNDECIDED;
        if (status == CV_OK)
            status = dg_probe_at(&high, &g->probe, alpha, q + half);
        if (status == CV_OK && (low.im > 0) == (h->at.direction > 0) && (high.im > 0) != (low.im > 0))
            return dg_curve_cross(&m->at, &g->probe, &g->station, &low, &high);
    }
    return status == CV_OK ? CV_UNDECIDED : status;
}

/* Follows the crossing to Re zeta = 0 at a finite frequency: Newton's method in alpha. */
static int passes_zero(double *alpha, double *q, dg_line_graph *g, const dg_followed *h)
{
    dg_followed here = *h;
    double last = INFINITY;
    for (int i = 0; i < MAX_STEPS; i++) {
        const double change = -here.at.x / here.at.dx;
        const double done = 1e-13 * here.alpha;
        if (fabs(change) <= done || (fabs(here.at.x) < 1e-9 * h->at.x && fabs(change) >= fabs(last))) {
            *alpha = here.alpha + change;
            *q = here.at.q + here.at.dq * change;
            return 1;
        }
        if (!(fabs(change) < 2 * fabs(last)))
            return 0;
        last = change;
        dg_followed next;
        if (step(&next, g, &here, here.alpha + change) != CV_OK)
            return 0;
        here = next;
    }
    return 0;
}

int dg_line_runs_to_infinity(double *alpha, double *q, dg_line_graph *g, const dg_followed *before,
                             const dg_followed *h)
{
    const double near[2] = {nearest(g, h->alpha, 0), nearest(g, h->alpha, 1)};
    const int closer = fabs(near[1] - h->alpha) < fabs(near[0] - h->alpha);
    *q = 0;
    for (int i = 0; i < 2; i++) {
        *alpha = near[i == 0 ? closer : !closer];
        if (*alpha > 0 && approaches(g, before, h, *alpha))
            return 1;
    }
    if (passes_zero(alpha, q, g, h))
        return 1;
    *alpha = 0;
    return 0;
}
