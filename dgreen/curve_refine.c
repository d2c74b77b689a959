#include "dgreen/curve_refine.h"

#include <math.h>
#include <stdlib.h>

enum { ROUNDS = 60, MAX_NODES = 100000 };
/* A dip is left alone when the parabola through it stays above this part of its value. */
static const double DIP_CLEARANCE = 0.85;
/* A node is suspicious when the product of its neighbours' values exceeds its square by this factor: among
 * nodes at geometric distances that is 1 for any power law. */
static const double KINK = 3;
/* Im zeta counts as smooth at a node when the cubic through its four neighbours, as a function of the
 * position, misses it by less than this part of its value. */
static const double SMOOTH = 0.15;
/* cos of the largest turning of the polyline that is accepted next to the real axis: 60 degrees */
static const double COS_TURN = 0.5;
/* Part of the interval below which the doubles end */
static const double NARROW = 1e-15;

static int positive(const dg_node *n)
{
    return n->im > 0;
}

/* |Im zeta| of one sign at a, b and c, and perhaps zero beside b: it falls short of the power law through its
 * neighbours, or the parabola through the three, whose lowest point is *lowest, goes down. */
static int dip_may_hide(double *lowest, const dg_node *a, const dg_node *b, const dg_node *c)
{
    const double fa = fabs(a->im), fb = fabs(b->im), fc = fabs(c->im);
    if (positive(a) != positive(b) || positive(b) != positive(c))
        return 0;
    if (!(fb <= fa && fb <= fc))
        return fa * fc > KINK * fb * fb;
    const double h = b->q - a->q, k = c->q - b->q, left = (fb - fa) / h, right = (fc - fb) / k;
    const double slope = (left * k + right * h) / (h + k), curvature = (right - left) / (h + k);
    *lowest = curvature > 0 ? b->q - slope / (2 * curvature) : b->q;
    const double least = curvature > 0 ? fb - slope * slope / (4 * curvature) : fb;
    return least < DIP_CLEARANCE * fb || fa * fc > KINK * fb * fb;
}

/* Im zeta at n[0] by the cubic through n[-2], n[-1], n[1] and n[2] */
static double interpolated(const dg_node *n)
{
    static const int OTHERS[4] = {-2, -1, 1, 2};
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const dg_node *one = &n[OTHERS[i]];
        double term = one->im;
        for (int k = 0; k < 4; k++)
            if (k != i)
                term *= (n->position - n[OTHERS[k]].position) / (one->position - n[OTHERS[k]].position);
        sum += term;
    }
    return sum;
}

/* Im zeta at n[0] is not what its neighbours lead to expect; beside a zero their values are the measure. */
static int surprises(const dg_node *n, int look)
{
    const double beside = fmin(fabs(n[-1].im), fabs(n[1].im)) / 2;
    return !(fabs(interpolated(n) - n->im) <= ldexp(SMOOTH, -look) * fmax(fabs(n->im), beside));
}

/* The polyline turns at b, so near the real axis that it may pass a point of it on the wrong side */
static int turns(const dg_node *a, const dg_node *b, const dg_node *c)
{
    const double x = b->re - a->re, y = b->im - a->im, u = c->re - b->re, v = c->im - b->im;
    const double one = hypot(x, y), other = hypot(u, v);
    const double nearest = fmin(fabs(a->im), fmin(fabs(b->im), fabs(c->im)));
    return x * u + y * v < COS_TURN * one * other && fmin(one, other) > 0.5 * nearest &&
           fmin(one, other) > 1e-3 * fabs(b->re);
}

static cv_status halve(dg_curve *c, const dg_probe *p, const dg_node *a, const dg_node *b, cv_message *why)
{
    if (b->q - a->q <= NARROW * b->q)
        return CV_OK;
    const double q = dg_station_middle(&c->at, a->q, b->q);
    return q > a->q && q < b->q ? dg_curve_add(c, p, q, why) : CV_OK;
}

/* One pass over all triples; marks of the last pass are not kept, a triple that is still bad is cut again. */
static cv_status pass(dg_curve *c, const dg_probe *p, cv_message *why)
{
    const size_t n = c->node_count;
    cv_status status = dg_curve_reserve(c, 3 * n, why); /* so that nodes do not move below */
    size_t cut = 0;                                     /* the interval before this node is cut already */
    for (size_t i = 1; i + 1 < n && status == CV_OK; i++) {
        const dg_node *a = &c->nodes[i - 1], *b = a + 1, *d = a + 2;
        if (!(fmax(a->re, fmax(b->re, d->re)) > c->x_floor / 2))
            continue;
        double lowest = b->q;
        if (dip_may_hide(&lowest, a, b, d)) {
            if (fabs(lowest - b->q) > NARROW * b->q)
                status = dg_curve_add(c, p, lowest, why);
        } else if (!turns(a, b, d) && !(i > 1 && i + 2 < n && surprises(b, p->look))) {
            continue;
        }
        if (status == CV_OK && cut != i)
            status = halve(c, p, a, b, why);
        if (status == CV_OK)
            status = halve(c, p, b, d, why);
        cut = i + 1;
    }
    return status;
}

cv_status dg_curve_refine(dg_curve *c, const dg_probe *p, cv_message *why)
{
    for (int round = 0; round < ROUNDS && c->node_count < MAX_NODES; round++) {
        const size_t before = c->node_count;
        const cv_status status = pass(c, p, why);
        if (status != CV_OK)
            return status;
        if (c->node_count == before)
            return CV_OK;
        dg_curve_sort(c);
    }
    return CV_OK;
}

static cv_status push_crossing(dg_curve *c, const dg_crossing *x, cv_message *why)
{
    if (c->crossing_count == c->crossing_room) {
        const size_t room = c->crossing_room ? 2 * c->crossing_room : 16;
        dg_crossing *grown = realloc(c->crossings, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        c->crossings = grown;
        c->crossing_room = room;
    }
    c->crossings[c->crossing_count++] = *x;
    return CV_OK;
}

static cv_status push_dip(dg_curve *c, const dg_probe *p, const dg_node *n, cv_message *why)
{
    if (c->dip_count == c->dip_room) {
        const size_t room = c->dip_room ? 2 * c->dip_room : 16;
        dg_dip *grown = realloc(c->dips, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        c->dips = grown;
        c->dip_room = room;
    }
    dg_slopes s;
    const cv_status status = dg_probe_slopes(&s, p, &c->at, n->q);
    c->dips[c->dip_count++] = (dg_dip){n->q, n->re, n->im, s.im_alpha};
    return status;
}

/* What is between the nodes beside a pole; sharpened */
static cv_status list_at_pole(dg_curve *c, const dg_probe *p, const dg_pole *pole, size_t i, cv_message *why)
{
    dg_crossing found[2];
    cv_status status = dg_probe_sharpen(&c->nodes[i], p, c->at.alpha);
    if (status == CV_OK)
        status = dg_probe_sharpen(&c->nodes[i + 1], p, c->at.alpha);
    if (status != CV_OK)
        return cv_fail(why, status, "zeta not known beside a branch point at alpha = %.17g", c->at.alpha);
    const int count = dg_pole_crossings(found, c, pole, &c->nodes[i], &c->nodes[i + 1]);
    for (int k = 0; k < count && status == CV_OK; k++)
        if (found[k].x >= c->x_floor)
            status = push_crossing(c, &found[k], why);
    return status;
}

static cv_status list_crossing(dg_curve *c, const dg_probe *p, size_t i, cv_message *why)
{
    dg_crossing x;
    const dg_node a = c->nodes[i], b = c->nodes[i + 1];
    cv_status status = dg_curve_cross(&x, p, &c->at, &a, &b);
    if (status != CV_OK)
        return cv_fail(why, status, "crossing at alpha = %.17g, q = %.17g not resolved", c->at.alpha, x.q);
    if (x.x >= c->x_floor)
        status = push_crossing(c, &x, why);
    if (status == CV_OK && x.q_low > a.q)
        status = dg_curve_add(c, p, x.q_low, why);
    if (status == CV_OK && x.q_high < b.q)
        status = dg_curve_add(c, p, x.q_high, why);
    return status;
}

/* Both ends of the interval after node i, unless they are below the floor for certain */
static cv_status sharpen(dg_curve *c, const dg_probe *p, size_t i)
{
    dg_node *a = &c->nodes[i], *b = a + 1;
    if (a->re + a->re_error < c->x_floor && b->re + b->re_error < c->x_floor)
        return CV_OK;
    const cv_status status = dg_probe_sharpen(a, p, c->at.alpha);
    return status == CV_OK ? dg_probe_sharpen(b, p, c->at.alpha) : status;
}

/* Whether zeta may exceed the floor near the interval after node i: a neighbour does, or the curve need only
 * be as far from the chord as a part of its length, for it may pass close to zero between two nodes. */
static int relevant(const dg_curve *c, size_t i, size_t n)
{
    static const double SAGITTA = 0.5;
    const dg_node *a = &c->nodes[i], *b = a + 1;
    double most = fmax(a->re, b->re) + SAGITTA * hypot(b->re - a->re, b->im - a->im);
    if (i > 0)
        most = fmax(most, c->nodes[i - 1].re);
    if (i + 2 < n)
        most = fmax(most, c->nodes[i + 2].re);
    return most > c->x_floor;
}

cv_status dg_curve_list(dg_curve *c, const dg_probe *p, cv_message *why)
{
    const size_t n = c->node_count;
    cv_status status = CV_OK;
    for (size_t i = 0; i + 1 < n && status == CV_OK; i++) {
        const dg_node *a = &c->nodes[i];
        const dg_pole *pole = dg_curve_pole(c, a, a + 1);
        if (pole != NULL) {
            status = list_at_pole(c, p, pole, i, why);
        } else if (positive(a) != positive(a + 1)) {
            status = sharpen(c, p, i);
            if (status == CV_OK && relevant(c, i, n))
                status = list_crossing(c, p, i, why);
        } else if (i > 0 && a->re > c->x_floor && positive(a - 1) == positive(a) &&
                   fabs(a->im) < fmin(fabs(a[-1].im), fabs(a[1].im)) && fabs(a->im) < 3 * a->re) {
            const dg_node node = *a;
            status = push_dip(c, p, &node, why);
        }
    }
    if (status == CV_OK)
        dg_curve_sort(c);
    return status;
}
