#include "dgreen/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/curve_refine.h"

/* Nodes per decade of the distance from a branch point, down to this part of its width */
enum { PER_DECADE = 2 };
static const double CORE = 0.6;
/* Relative spacing of doubles with some room */
static const double SPACING = 1e-15;

cv_status dg_curve_reserve(dg_curve *c, size_t more, cv_message *why)
{
    if (c->node_count + more <= c->node_room)
        return CV_OK;
    const size_t room = 2 * (c->node_count + more);
    dg_node *grown = realloc(c->nodes, room * sizeof *grown);
    if (grown == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    c->nodes = grown;
    c->node_room = room;
    return CV_OK;
}

cv_status dg_curve_add(dg_curve *c, const dg_probe *p, double q, cv_message *why)
{
    cv_status status = dg_curve_reserve(c, 1, why);
    if (status != CV_OK)
        return status;
    /* At a zero of Im zeta no precision certifies the sign: move off by a few spacings. */
    for (int i = 0; i < 3; i++) {
        status = dg_probe_at(&c->nodes[c->node_count], p, c->at.alpha, q);
        if (status != CV_UNDECIDED)
            break;
        q *= 1 + 8 * SPACING;
    }
    if (status == CV_OK)
        c->nodes[c->node_count++].position = dg_station_position(&c->at, q);
    else
        cv_fail(why, status, "sign of Im zeta not certified at alpha = %.17g, q = %.17g", c->at.alpha, q);
    return status;
}

static int ascending(const void *a, const void *b)
{
    const double x = ((const dg_node *)a)->q, y = ((const dg_node *)b)->q;
    return (x > y) - (x < y);
}

void dg_curve_sort(dg_curve *c)
{
    size_t n = 0;
    qsort(c->nodes, c->node_count, sizeof *c->nodes, ascending);
    for (size_t i = 0; i < c->node_count; i++)
        if (n == 0 || c->nodes[i].q > c->nodes[n - 1].q)
            c->nodes[n++] = c->nodes[i];
    c->node_count = n;
}

/* A branch point is quiet when zeta on both sides has a negative real part that is this many times the peak;
 * only narrow and low ones are looked at, in the others there is nothing to gain. */
static const double QUIET = 10, NARROW = 1e-4, LOW = 1;
/* How far from the branch point "on both sides" is: part of q, at most half way to another one */
static const double BESIDE = 0.1;

static double room_around(const dg_station *at, size_t i)
{
    double room = BESIDE * at->points[i].q;
    for (size_t k = 0; k < at->count; k++)
        if (k != i && !at->points[k].soft)
            room = fmin(room, fabs(at->points[k].q - at->points[i].q) / 2);
    return room;
}

/* Marks branch points at which zeta stays far from the positive real axis: the singular part, of which the
 * peak is known, is too small. What was sampled for that becomes nodes; where that fails the point is not
 * quiet. */
static cv_status mark_quiet(dg_curve *c, const dg_probe *p, cv_message *why)
{
    cv_message unread;
    cv_status status = CV_OK;
    for (size_t i = 0; i < c->at.count && status != CV_FAILED; i++) {
        dg_branch_point *point = &c->at.points[i];
        const double room = room_around(&c->at, i);
        if (point->soft || !(point->width < NARROW * room && point->peak < LOW))
            continue;
        const size_t first = c->node_count;
        status = dg_curve_add(c, p, point->q - room, &unread);
        if (status == CV_OK)
            status = dg_curve_add(c, p, point->q + room, &unread);
        point->quiet =
            status == CV_OK && fmax(c->nodes[first].re, c->nodes[first + 1].re) < -QUIET * point->peak;
    }
    return status == CV_FAILED ? cv_fail(why, CV_FAILED, "%s", unread.text) : CV_OK;
}

/* The step from q to the next node: a part of the distance to every branch point and to 0, the same on the
 * way towards a point as away from it; on the point itself when it is that near. */
static double step_at(const dg_station *at, double q, double part)
{
    double step = part * q;
    for (size_t i = 0; i < at->count; i++) {
        const dg_branch_point *point = &at->points[i];
        if (point->quiet)
            continue;
        const double distance = fabs(q - point->q), core = CORE * point->width;
        const double room = sqrt(distance * distance + core * core);
        const double own = point->q <= q ? part * room : fmin(part / (1 + part) * room, distance);
        step = own < step ? own : step;
    }
    return fmax(step, 4 * SPACING * q);
}

/* The first nodes, from q_first to q_last. */
static cv_status lay_nodes(dg_curve *c, const dg_probe *p, double q_first, double q_last, cv_message *why)
{
    const double part = pow(10, 1.0 / ldexp(PER_DECADE, p->look)) - 1;
    cv_status status = dg_curve_add(c, p, q_first, why);
    for (double q = q_first; q < q_last && status == CV_OK;) {
        q += step_at(&c->at, q, part);
        status = dg_curve_add(c, p, q, why);
    }
    return status;
}

/* Far above all branch points and the pads the rail alone is left: zeta ~ -(1 + i) sqrt(q)/(4 sqrt 2)... of
 * which the signs are used. */
static cv_status check_ends(const dg_curve *c, cv_message *why)
{
    const dg_node *first = &c->nodes[0], *last = &c->nodes[c->node_count - 1];
    if (!(fabs(first->re) < c->x_floor / 2))
        return cv_fail(why, CV_UNDECIDED, "zeta not small at q = %g, alpha = %.17g", first->q, c->at.alpha);
    if (!(last->re < 0 && last->im < 0))
        return cv_fail(why, CV_UNDECIDED, "zeta not that of the bare rail at q = %g", last->q);
    return CV_OK;
}

/* Where the curve begins: zeta ~ q^2 is small there. Without damping no branch point is below, because zeta
 * is infinite at each. */
static double first_frequency(const dg_curve *c, const dg_probe *p)
{
    const double small = 1e-6, none = 1e-300;
    double q = small;
    for (size_t i = 0; i < c->at.count && !p->track->damped; i++)
        if (!c->at.points[i].soft && c->at.points[i].q > none)
            q = fmin(q, c->at.points[i].q / 2);
    return q;
}

cv_status dg_curve_at(dg_curve *c, const dg_probe *p, double alpha, double x_floor, cv_message *why)
{
    cv_status status = dg_station_set(&c->at, p->branches, alpha, why);
    if (status != CV_OK)
        return status;
    c->x_floor = x_floor;
    c->node_count = c->crossing_count = c->dip_count = 0;
    const double top = c->at.count ? c->at.points[c->at.count - 1].q : 0;
    const double q_last = 20 * (1 + alpha * alpha) + 5 * top;
    if (p->look == 0 && p->track->damped)
        status = mark_quiet(c, p, why);
    if (status == CV_OK)
        status = lay_nodes(c, p, first_frequency(c, p), q_last, why);
    if (status == CV_OK)
        status = dg_curve_poles(c, p, why);
    if (status != CV_OK)
        return status;
    dg_curve_sort(c);
    status = check_ends(c, why);
    if (status == CV_OK)
        status = dg_curve_refine(c, p, why);
    return status == CV_OK ? dg_curve_list(c, p, why) : status;
}

void dg_curve_clear(dg_curve *c)
{
    free(c->nodes);
    free(c->crossings);
    free(c->dips);
    free(c->poles);
    dg_station_clear(&c->at);
    memset(c, 0, sizeof *c);
}
