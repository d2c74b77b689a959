/* Turning points: where two neighbouring crossings of opposite direction meet as the velocity changes. */
#include <float.h>
#include <math.h>

#include "dgreen/lines_graph.h"

enum { MAX_PAIRS = 48, MAX_TRIES = 80, MIN_STEPS = 24, WIDEN = 6 };
/* Half-width of the search for the minimum, in units of half the distance of the pair, and a least one */
static const double WINDOW = 1.6, LEAST_WINDOW = 0.02;
/* The search ends when the velocity is known this well (relative) and the pair is this close in log x, plot
 * units */
static const double VELOCITY_TOLERANCE = 1e-13, PAIR_TOLERANCE = 1e-4;
/* Where the extrapolation puts its two trials around the estimate, part of the step to it */
static const double BESIDE = 0.05;

typedef struct {
    double alpha;
    dg_crossing low, high;
} pair;

typedef struct {
    dg_line_graph *g;
    size_t count;
    pair pairs[MAX_PAIRS]; /* towards the turning point */
    double gone;           /* a velocity beyond it */
    double q_gone;         /* the minimum there */
    int outside;           /* sign of Im zeta outside the pair */
    int alike;             /* positions compare with those of the first pair */
    size_t hard_count;
} turn;

/* The abscissa of the search: position where it compares, else log q */
static double abscissa(const turn *t, const dg_crossing *c)
{
    return t->alike ? c->position : log(c->q);
}

static double frequency(const turn *t, double at)
{
    return t->alike ? dg_station_frequency(&t->g->station, at) : exp(at);
}

static int is_outside(const turn *t, const dg_node *n)
{
    return (n->im > 0) == (t->outside > 0);
}

/* A node outside the pair, from "at" by growing steps in the direction of "step" */
static cv_status find_outside(dg_node *n, double *at, const turn *t, double step)
{
    for (int i = 0; i < WIDEN; i++, *at += step, step *= 2) {
        const cv_status status = dg_probe_at(n, &t->g->probe, t->g->station.alpha, frequency(t, *at));
        if (status != CV_OK || is_outside(t, n))
            return status;
    }
    return CV_UNDECIDED;
}

/* The node at abscissa "at", with a certain sign where double does not tell it. */
static cv_status probe(dg_node *n, const turn *t, double at)
{
    int certain;
    const double q = frequency(t, at);
    const cv_status status = dg_probe_value(n, &certain, &t->g->probe, t->g->station.alpha, q);
    return status == CV_OK && !certain ? dg_probe_at(n, &t->g->probe, t->g->station.alpha, q) : status;
}

/* The least Im zeta, with the sign outside the pair as positive, in (low, high): golden section. It ends
 * where the sign is that inside. */
static cv_status minimum(dg_node *n, const turn *t, double low, double high)
{
    static const double GOLDEN = 0.381966011250105;
    double at[2] = {low + GOLDEN * (high - low), high - GOLDEN * (high - low)};
    dg_node value[2];
    cv_status status = probe(&value[0], t, at[0]);
    if (status == CV_OK)
        status = probe(&value[1], t, at[1]);
    for (int i = 0; i < MIN_STEPS && status == CV_OK; i++) {
        const int k = t->outside * (value[1].im - value[0].im) < 0; /* the lower one */
        *n = value[k];
        if (!is_outside(t, n))
            return CV_OK;
        if (k) {
            low = at[0];
            at[0] = at[1];
            value[0] = value[1];
            at[1] = high - GOLDEN * (high - low);
        } else {
            high = at[1];
            at[1] = at[0];
            value[1] = value[0];
            at[0] = low + GOLDEN * (high - low);
        }
        status = probe(&value[k], t, at[k]);
    }
    return status;
}

/* Where the middle of the pair is expected at alpha: the line through the last two */
static double expected_middle(const turn *t, double alpha)
{
    const pair *last = &t->pairs[t->count - 1];
    const double middle = (abscissa(t, &last->low) + abscissa(t, &last->high)) / 2;
    if (t->count < 2)
        return middle;
    const pair *before = last - 1;
    const double rate = (middle - (abscissa(t, &before->low) + abscissa(t, &before->high)) / 2) /
                        (last->alpha - before->alpha);
    return middle + rate * (alpha - last->alpha);
}

/* Looks for the pair at alpha: adds it, or moves "gone" there. */
static cv_status look(turn *t, double alpha)
{
    dg_line_graph *g = t->g;
    const pair *last = &t->pairs[t->count - 1];
    cv_status status = dg_station_set(&g->station, g->probe.branches, alpha, g->why);
    if (status != CV_OK)
        return status;
    if (t->alike && g->station.hard_count != t->hard_count)
        return CV_UNDECIDED;
    const double half = (abscissa(t, &last->high) - abscissa(t, &last->low)) / 2;
    const double window = fmax(WINDOW * half, fmin(LEAST_WINDOW, 100 * half));
    double low = expected_middle(t, alpha) - window, high = low + 2 * window;
    dg_node below, above, least;
    status = find_outside(&below, &low, t, -window);
    if (status == CV_OK)
        status = find_outside(&above, &high, t, window);
    if (status == CV_OK)
        status = minimum(&least, t, low, high);
    if (status != CV_OK)
        return status;
    if (is_outside(t, &least)) {
        t->gone = alpha;
        t->q_gone = least.q;
        return CV_OK;
    }
    pair *found = &t->pairs[t->count];
    found->alpha = alpha;
    status = dg_curve_cross(&found->low, &g->probe, &g->station, &below, &least);
    if (status == CV_OK)
        status = dg_curve_cross(&found->high, &g->probe, &g->station, &least, &above);
    t->count += status == CV_OK;
    return status;
}

/* The square of the distance of the pair falls linearly to 0 at the turning point. */
static double next_velocity(const turn *t, int try)
{
    const pair *last = &t->pairs[t->count - 1];
    const double half = last->alpha + (t->gone - last->alpha) / 2;
    if (t->count < 2 || try % 3 == 2)
        return half;
    const pair *before = last - 1;
    const double one = pow(abscissa(t, &before->high) - abscissa(t, &before->low), 2);
    const double two = pow(abscissa(t, &last->high) - abscissa(t, &last->low), 2);
    const double step = two * (last->alpha - before->alpha) / (one - two);
    const double alpha = last->alpha + step * (try % 3 == 0 ? 1 + BESIDE : 1 - BESIDE);
    return (alpha - last->alpha) * (alpha - t->gone) < 0 ? alpha : half;
}

static int close_enough(const turn *t)
{
    const pair *last = &t->pairs[t->count - 1];
    const double gap = fabs(t->gone - last->alpha);
    const double apart = fabs(log(last->low.x / last->high.x)) / t->g->scale_log;
    return gap <= 4 * DBL_EPSILON * last->alpha ||
           (gap <= VELOCITY_TOLERANCE * last->alpha && apart <= PAIR_TOLERANCE);
}

static cv_status approach(turn *t)
{
    for (int try = 0; try < MAX_TRIES && t->count < MAX_PAIRS; try++) {
        if (close_enough(t))
            return CV_OK;
        const cv_status status = look(t, next_velocity(t, try));
        if (status != CV_OK)
            return status;
    }
    return CV_UNDECIDED;
}

/* Links the crossings of all pairs, and the last ones to the turning point. */
static cv_status link_arms(turn *t, int low, int high, int side)
{
    dg_line_graph *g = t->g;
    const pair *last = &t->pairs[t->count - 1];
    cv_status status = CV_OK;
    for (size_t i = 1; i < t->count && status == CV_OK; i++) {
        const dg_followed a = {t->pairs[i].alpha, t->pairs[i].low}, b = {t->pairs[i].alpha, t->pairs[i].high};
        const int next_low = dg_line_add(g, &a), next_high = dg_line_add(g, &b);
        if (next_low == DG_LINE_NONE || next_high == DG_LINE_NONE)
            return cv_fail(g->why, CV_FAILED, "out of memory");
        const int up = side == DG_LINE_HIGHER;
        status = dg_line_follow(g, up ? low : next_low, up ? next_low : low, t->alike);
        if (status == CV_OK)
            status = dg_line_follow(g, up ? high : next_high, up ? next_high : high, t->alike);
        low = next_low;
        high = next_high;
    }
    if (status != CV_OK)
        return status;
    dg_followed tip = {last->alpha + (t->gone - last->alpha) / 2, last->low};
    tip.at.q = last->low.q + (last->high.q - last->low.q) / 2;
    tip.at.x = (last->low.x + last->high.x) / 2;
    const int node = dg_line_add(g, &tip);
    if (node == DG_LINE_NONE)
        return cv_fail(g->why, CV_FAILED, "out of memory");
    g->nodes[node].turns = 1;
    dg_line_join(g, low, side, node, DG_LINE_LOWER);
    dg_line_join(g, high, side, node, DG_LINE_HIGHER);
    return CV_OK;
}

cv_status dg_line_turn(double *q, dg_line_graph *g, int a, int side, double gone)
{
    const dg_line_node *low = &g->nodes[a], *high = low + 1;
    turn t = {.g = g, .count = 1, .outside = low->is.at.direction, .alike = 1};
    t.pairs[0] = (pair){low->is.alpha, low->is.at, high->is.at};
    cv_status status = dg_station_set(&g->station, g->probe.branches, low->is.alpha, g->why);
    t.hard_count = g->station.hard_count;
    if (status == CV_OK)
        status = dg_station_set(&g->station, g->probe.branches, gone, g->why);
    t.alike = g->station.hard_count == t.hard_count;
    if (status == CV_OK)
        status = look(&t, gone);
    if (status == CV_OK && t.count > 1)
        return CV_UNDECIDED; /* it is not gone there */
    *q = t.q_gone;
    if (status == CV_OK)
        status = approach(&t);
    return status == CV_OK ? link_arms(&t, a, a + 1, side) : status;
}
