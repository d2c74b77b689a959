#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/curve_refine.h"
#include "dgreen/operator_dd.h"

/* Delta(i p) at a real frequency of the undamped track, where it is real */
static cv_status delta_at(dg_dd *value, const dg_track *t, double alpha, double q, double p)
{
    dg_dd_operator op;
    const cv_status status = dg_dd_operator_set(&op, t, alpha, CMPLX(0, q));
    *value = (dg_dd){0, 0};
    for (int k = DG_DEGREE; k >= 0 && status == CV_OK; k--)
        *value = dg_dd_add(dg_dd_scale(*value, p), op.delta[k].re);
    return status;
}

/* q_b, signed, from its double, in which alpha p - omega cancels: secant steps to Delta(i p) = 0, the last
 * one less than the spacing of doubles. d Delta/dp = 0 there, so that the rounding of p is of second order.
 */
static cv_status exact_frequency(dg_dd *q_b, const dg_track *t, double alpha, const dg_branch_point *point)
{
    enum { STEPS = 3 };
    const double step = 1e-7 * (fabs(point->signed_q) + alpha * fabs(point->p));
    double q = point->signed_q, before = q;
    for (int i = 0; i < STEPS; i++) {
        dg_dd here, beside;
        cv_status status = delta_at(&here, t, alpha, q, point->p);
        if (status == CV_OK)
            status = delta_at(&beside, t, alpha, q + step, point->p);
        if (status != CV_OK)
            return status;
        const double rise = dg_dd_add(beside, dg_dd_negative(here)).hi;
        *q_b = dg_dd_two(q, -here.hi * ((q + step) - q) / rise);
        before = q;
        q = q_b->hi;
    }
    return q != 0 && fabs(q - before) <= DBL_EPSILON * fabs(q) ? CV_OK : CV_UNDECIDED;
}

int dg_pole_below(const dg_pole *pole, double q)
{
    return q - pole->q.hi > pole->q.lo;
}

const dg_pole *dg_curve_pole(const dg_curve *c, const dg_node *a, const dg_node *b)
{
    for (size_t i = 0; i < c->pole_count; i++)
        if (!dg_pole_below(&c->poles[i], a->q) && dg_pole_below(&c->poles[i], b->q))
            return &c->poles[i];
    return NULL;
}

/* The node nearest to the pole on one side whose sign is certain */
static cv_status add_beside(dg_curve *c, const dg_probe *p, const dg_pole *pole, int above, cv_message *why)
{
    enum { TRIES = 12 };
    double q = pole->q.hi;
    while (dg_pole_below(pole, q) != above)
        q = nextafter(q, above ? INFINITY : 0);
    cv_status status = dg_curve_reserve(c, 1, why);
    if (status != CV_OK)
        return status;
    status = CV_UNDECIDED;
    for (int i = 0; i < TRIES && status == CV_UNDECIDED; i++) {
        status = dg_probe_at(&c->nodes[c->node_count], p, c->at.alpha, q);
        if (status == CV_UNDECIDED)
            q += (above ? 1 : -1) * ldexp(q * 0x1p-52, i);
    }
    if (status != CV_OK)
        return cv_fail(why, status,
                       "sign of Im zeta not certified beside the branch point q = %.17g at alpha = %.17g",
                       pole->q.hi, c->at.alpha);
    c->nodes[c->node_count++].position = dg_station_position(&c->at, q);
    return CV_OK;
}

/* q = alpha p - omega runs to larger values on both sides of p where the curvature of omega is negative. Im
 * zeta -> +infinity on the side of the waves where q_b > 0 (sigma = -omega), -infinity at the reflection of
 * q_b < 0; and sqrt(q - q_b - i0) tells the sign of Re zeta on the other side. */
static dg_pole pole_of(const dg_branch_point *point, dg_dd q_b)
{
    const int sign = q_b.hi > 0 ? 1 : -1, above = (point->bend < 0) == (sign > 0);
    return (dg_pole){sign > 0 ? q_b : dg_dd_negative(q_b), above, above ? -sign : sign, sign};
}

cv_status dg_curve_poles(dg_curve *c, const dg_probe *p, cv_message *why)
{
    c->pole_count = 0;
    if (p->track->damped)
        return CV_OK;
    if (c->poles == NULL)
        c->poles = calloc(dg_branch_points_max(p->branches) + 1, sizeof *c->poles);
    if (c->poles == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = CV_OK;
    double passed = 0; /* the node above the last pole */
    for (size_t i = 0; i < c->at.count && status == CV_OK; i++) {
        const dg_branch_point *point = &c->at.points[i];
        dg_dd q;
        if (point->soft || point->q == 0)
            continue;
        status = exact_frequency(&q, p->track, c->at.alpha, point);
        if (status == CV_OK)
            c->poles[c->pole_count] = pole_of(point, q);
        /* two poles between the same nodes could not be told apart */
        if (status != CV_OK || dg_pole_below(&c->poles[c->pole_count], passed))
            return cv_fail(why, CV_UNDECIDED, "branch point near q = %.17g at alpha = %.17g", point->q,
                           c->at.alpha);
        const dg_pole *pole = &c->poles[c->pole_count++];
        status = add_beside(c, p, pole, 0, why);
        if (status == CV_OK)
            status = add_beside(c, p, pole, 1, why);
        if (status == CV_OK)
            passed = c->nodes[c->node_count - 1].q;
    }
    return status;
}

/* Number the crossing from sign "from" of Im zeta to the other one would have; 0: no crossing. */
static int direction(int from, int to)
{
    return from == to ? 0 : from > 0 ? 1 : -1;
}

static dg_crossing crossing_at(const dg_curve *c, const dg_node *a, const dg_node *b, double x, double error,
                               int way)
{
    return (dg_crossing){.q_low = a->q,
                         .q_high = b->q,
                         .q = a->q + (b->q - a->q) / 2,
                         .x = x,
                         .x_low = x - error,
                         .x_high = x + error,
                         .direction = way,
                         .position = dg_station_position(&c->at, b->q),
                         .scale = dg_station_scale(&c->at, b->q)};
}

int dg_pole_crossings(dg_crossing out[2], const dg_curve *c, const dg_pole *pole, const dg_node *a,
                      const dg_node *b)
{
    const double smooth = 1e-6; /* the singular part is imaginary on the side of the waves: Re zeta stays */
    const dg_node *wave = pole->waves_above ? b : a, *rest = pole->waves_above ? a : b;
    const int sign_wave = wave->im > 0 ? 1 : -1, sign_rest = rest->im > 0 ? 1 : -1, s = pole->imaginary;
    const int far = pole->waves_above ? direction(sign_rest, s) : direction(s, sign_rest);
    const int near = pole->waves_above ? direction(s, sign_wave) : direction(sign_wave, s);
    int count = 0;
    if (far != 0 && pole->real > 0)
        out[count++] = crossing_at(c, a, b, INFINITY, 0, far);
    if (near != 0)
        out[count++] = crossing_at(c, a, b, wave->re, wave->re_error + smooth * fabs(wave->re), near);
    return count;
}
