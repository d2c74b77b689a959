/* Crossings of the real axis so near to x that no double beside them tells the side. */
#include <float.h>
#include <math.h>

#include "dgreen/curve_refine.h"
#include "dgreen/lines.h"

/* A node there, instead of one that is. */
static cv_status put_node(dg_curve *c, const dg_node *node, cv_message *why)
{
    for (size_t i = 0; i < c->node_count; i++)
        if (c->nodes[i].q == node->q) {
            c->nodes[i] = *node;
            return CV_OK;
        }
    const cv_status status = dg_curve_reserve(c, 1, why);
    if (status == CV_OK)
        c->nodes[c->node_count++] = *node;
    return status;
}

/* The ends of the exact bracket as nodes, moved apart to the doubles on both sides: nothing happens between.
 * Of Im zeta only the sign is used there. */
static cv_status put_bracket(dg_curve *c, dg_crossing *crossing, mpfr_srcptr q, double im, cv_message *why)
{
    double below = mpfr_get_d(q, MPFR_RNDD), above = mpfr_get_d(q, MPFR_RNDU);
    if (!(below < above)) {
        below = nextafter(below, 0);
        above = nextafter(above, INFINITY);
    }
    const double re_error = (crossing->x_high - crossing->x_low) / 2;
    const dg_node low = {below, crossing->x, im * crossing->direction, re_error,
                         dg_station_position(&c->at, below)};
    const dg_node high = {above, crossing->x, -im * crossing->direction, re_error,
                          dg_station_position(&c->at, above)};
    crossing->q_low = below;
    crossing->q_high = above;
    crossing->q = mpfr_get_d(q, MPFR_RNDN);
    const cv_status status = put_node(c, &low, why);
    return status == CV_OK ? put_node(c, &high, why) : status;
}

/* Narrows the bracket to a few doubles, as far as signs are certain. */
static void halve(const dg_curve *c, const dg_probe *p, dg_crossing *crossing)
{
    dg_node node;
    while (crossing->q_high - crossing->q_low > 8 * DBL_EPSILON * crossing->q_high &&
           dg_probe_at(&node, p, c->at.alpha, (crossing->q_low + crossing->q_high) / 2) == CV_OK)
        *((node.im > 0) == (crossing->direction > 0) ? &crossing->q_low : &crossing->q_high) = node.q;
}

/* The crossing's own x, to more digits than x has. Its bracket holds no other crossing, but it may be right
 * beside. */
static cv_status separate(dg_curve *c, const dg_probe *p, dg_crossing *crossing, double x, cv_message *why)
{
    enum { DIGITS = 20 };
    static const double ROOM = 1.6; /* the search ends short of its reach */
    halve(c, p, crossing);
    const double reach = (crossing->q_high - crossing->q_low) / 2;
    dg_line_point point;
    mpfr_t alpha, q;
    dg_line_point_init(&point);
    mpfr_init_set_d(alpha, c->at.alpha, MPFR_RNDN);
    mpfr_init2(q, 64);
    mpfr_set_d(q, crossing->q_low, MPFR_RNDN);
    mpfr_add_d(q, q, reach, MPFR_RNDN);
    cv_status status = dg_line_at_alpha(&point, p->track, alpha, q, ROOM * reach, DIGITS, why);
    if (status == CV_OK && !(mpfr_cmp_d(point.frequency, crossing->q_low) >= 0 &&
                             mpfr_cmp_d(point.frequency, crossing->q_high) <= 0))
        status = CV_UNDECIDED;
    if (status == CV_OK) {
        const double mass = mpfr_get_d(point.mass_ratio, MPFR_RNDN), at = 1 / mass;
        const double error = at * (point.mass_ratio_error / mass + 4 * DBL_EPSILON);
        crossing->x = at;
        crossing->x_low = at - error;
        crossing->x_high = at + error;
        status = put_bracket(c, crossing, point.frequency, fabs(at - x) / 2, why);
    }
    if (status == CV_OK && crossing->x_low <= x && crossing->x_high >= x)
        status = CV_UNDECIDED;
    mpfr_clears(alpha, q, (mpfr_ptr)NULL);
    dg_line_point_clear(&point);
    return status;
}

cv_status dg_curve_separate_exactly(dg_curve *c, const dg_probe *p, double x, cv_message *why)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < c->crossing_count && status == CV_OK; i++)
        if (c->crossings[i].x_low <= x && c->crossings[i].x_high >= x)
            status = separate(c, p, &c->crossings[i], x, why);
    dg_curve_sort(c);
    if (status == CV_UNDECIDED)
        cv_fail(why, CV_UNDECIDED, "a root on the stability boundary at alpha = %.17g", c->at.alpha);
    return status;
}
