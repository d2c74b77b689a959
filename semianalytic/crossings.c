#include "semianalytic/crossings.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "semianalytic/map_cell.h"

typedef struct {
    const sa_map_node *node;
    sa_field *field;
    double re_low;
    sa_crossings *out;
    double largest_interval; /* of the first ones, natural logarithms of the distance to the curve */
    double tolerance;        /* of one_signed */
    int strip, side;
} scan;

static cv_status sample(sa_sample *s, const scan *sc, double t)
{
    return sa_field_at_node(s, sc->field, sc->node, sc->strip, sc->side, t, 1);
}

/* The function keeps its sign between a and b: the tests of map_cell.h in one dimension. */
static int one_signed(const double f[3], const double slope[3], double tolerance)
{
    const double steepest = 6;
    double log_f[3], g[3];
    for (int i = 0; i < 3; ++i) {
        if (!(f[i] * f[0] > 0))
            return 0;
        log_f[i] = log(fabs(f[i]));
        g[i] = slope[i] / f[i];
        if (!(fabs(g[i]) < steepest))
            return 0;
    }
    double middle = (log_f[0] + log_f[2]) / 2 + (g[0] - g[2]) / 8;
    double slope_middle = 1.5 * (log_f[2] - log_f[0]) - (g[0] + g[2]) / 4;
    return fabs(log_f[1] - middle) < tolerance && fabs(g[1] - slope_middle) < 2 * tolerance;
}

/* The function is monotone from a to b: its slope varies little and fits its values. */
static int steady(const double f[3], const double slope[3])
{
    double low = fmin(fabs(slope[0]), fmin(fabs(slope[1]), fabs(slope[2])));
    double high = fmax(fabs(slope[0]), fmax(fabs(slope[1]), fabs(slope[2])));
    return slope[0] * slope[1] > 0 && slope[1] * slope[2] > 0 && high < 8 * low &&
           fabs(log(slope[1] * slope[1] / (slope[0] * slope[2]))) < 1 &&
           sa_slopes_fit(2 * (f[1] - f[0]), slope[0], slope[1]) &&
           sa_slopes_fit(2 * (f[2] - f[1]), slope[1], slope[2]);
}

static cv_status append(sa_crossings *list, sa_crossing item)
{
    if (list->count == list->room) {
        size_t room = 2 * list->room + 8;
        sa_crossing *more = realloc(list->items, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        list->items = more;
        list->room = room;
    }
    list->items[list->count++] = item;
    return CV_OK;
}

/* Im zeta is monotone from a to b and changes its sign. */
static cv_status crossing(const scan *sc, const sa_sample *a, const sa_sample *b)
{
    double low = a->t, high = b->t, t = low + (high - low) * a->im / (a->im - b->im), step = 0;
    sa_sample s = *a;
    for (int i = 0; i < 60; ++i) {
        cv_status status = sa_field_at_node(&s, sc->field, sc->node, sc->strip, sc->side, t, 0);
        if (status != CV_OK)
            return status;
        if (s.im * a->im > 0)
            low = t;
        else
            high = t;
        step = -s.im / s.im_t;
        if (fabs(step) < 1e-9 * (b->t - a->t) || fabs(s.im) <= 2 * s.im_error)
            break;
        t = t + step > low && t + step < high ? t + step : (low + high) / 2;
    }
    double moved = fmin(fabs(step), high - low) + fabs(s.im_error / s.im_t);
    const double rounding = fabs(s.re_q) * DBL_EPSILON * s.q; /* signs belong to rounded q */
    int falls_with_t = a->im > 0, t_grows_with_q = sc->side == 0;
    return append(sc->out, (sa_crossing){.q = s.q,
                                         .re = s.re,
                                         .re_error = s.re_error + fabs(s.re_t) * moved + rounding,
                                         .direction = falls_with_t == t_grows_with_q ? 1 : -1});
}

static cv_status scan_interval(const scan *sc, const sa_sample *a, const sa_sample *b)
{
    const double smallest = 1e-12;
    double h = b->t - a->t;
    sa_sample m;
    cv_status status = sample(&m, sc, a->t + h / 2);
    if (status != CV_OK)
        return status;
    const double im[3] = {a->im, m.im, b->im}, im_t[3] = {a->im_t * h, m.im_t * h, b->im_t * h};
    const double re[3] = {a->re - sc->re_low, m.re - sc->re_low, b->re - sc->re_low};
    const double re_t[3] = {a->re_t * h, m.re_t * h, b->re_t * h};
    if (one_signed(im, im_t, sc->tolerance) || (re[0] < 0 && one_signed(re, re_t, sc->tolerance)))
        return CV_OK;
    if (steady(im, im_t))
        return (a->im > 0) == (b->im > 0) ? CV_OK : crossing(sc, a, b);
    if (h < smallest)
        return CV_UNDECIDED;
    status = scan_interval(sc, a, &m);
    return status == CV_OK ? scan_interval(sc, &m, b) : status;
}

static cv_status scan_side(const scan *sc)
{
    int n = 1 + (int)(sa_map_strip_extent(sc->node, sc->strip, sc->side) / sc->largest_interval);
    sa_sample a, b;
    sa_field_block(sc->field, 0, 0, sc->strip, sc->side);
    cv_status status = sample(&a, sc, 0);
    for (int i = 1; status == CV_OK && i <= n; ++i) {
        status = sample(&b, sc, i == n ? 1 : (double)i / n);
        if (status == CV_OK)
            status = scan_interval(sc, &a, &b);
        a = b;
    }
    return status;
}

/* Im zeta changes its sign within the gap of a curve (map.h): there |zeta| ~ 1/sqrt(distance) is larger
 * than at either side of the gap, and Re zeta has the sign it has on the side where it is large. */
static cv_status gap_crossing(const scan *below, const scan *above)
{
    const double large = 100;
    sa_sample a, b;
    cv_status status = sample(&a, below, 0);
    if (status == CV_OK)
        status = sample(&b, above, 0);
    if (status != CV_OK || (a.im > 0) == (b.im > 0))
        return status;
    double size = fmin(hypot(a.re, a.im), hypot(b.re, b.im));
    double sign = fabs(a.re) > fabs(b.re) ? a.re : b.re;
    return append(below->out, (sa_crossing){.q = b.q,
                                            .re = copysign(size, sign),
                                            .re_error = size > large ? size / 4 : (double)INFINITY,
                                            .direction = a.im > 0 ? 1 : -1});
}

/* The branch point of a curve of the node. */
static cv_status branch_point_of(sa_branch_point *out, const sa_map *map, double alpha, double q)
{
    sa_branch_point points[SA_MAP_CURVES_MAX];
    int n = sa_branch_points(points, SA_MAP_CURVES_MAX, &map->curves, alpha);
    if (n < 1 || n > SA_MAP_CURVES_MAX)
        return CV_FAILED;
    *out = points[0];
    for (int i = 1; i < n; ++i)
        if (fabs(points[i].q - q) < fabs(out->q - q))
            *out = points[i];
    return CV_OK;
}

/* Without damping, within the gap of a curve: Im zeta goes to infinity on the side of the waves with the sign
 * of -(q - alpha p), Re zeta on the other side. Where Im zeta at the rim of the gap has the other sign there,
 * it vanishes on the way, at a distance that double does not resolve, with Re zeta as at the rim (the
 * singular part is imaginary on this side); where the signs on the two sides of the curve differ, zeta
 * crosses at infinity. rim: the side of the waves, the other. */
static cv_status rim_crossings(sa_crossings *out, const sa_sample rim[2], const sa_branch_point *point)
{
    const double smooth = 1e-5;
    int up = point->curvature > 0, sign = -point->sign, reaches = up ? -sign : sign;
    cv_status status = CV_OK;
    if ((rim[0].im > 0) != (sign > 0))
        status = append(out, (sa_crossing){.q = point->q,
                                           .re = rim[0].re,
                                           .re_error = rim[0].re_error + smooth * fabs(rim[0].re),
                                           .direction = (rim[0].im > 0) == up ? -1 : 1});
    if (status == CV_OK && (rim[1].im > 0) != (sign > 0) && reaches > 0)
        status = append(
            out, (sa_crossing){.q = point->q, .re = INFINITY, .direction = (rim[1].im > 0) == up ? 1 : -1});
    return status;
}

static cv_status limit_crossings(const scan *below, const scan *above, const sa_map *map, double q)
{
    sa_sample rim[2];
    sa_branch_point point;
    cv_status status = branch_point_of(&point, map, below->node->alpha, q);
    int up = point.curvature > 0;
    if (status == CV_OK)
        status = sample(&rim[0], up ? above : below, 0);
    if (status == CV_OK)
        status = sample(&rim[1], up ? below : above, 0);
    return status == CV_OK ? rim_crossings(below->out, rim, &point) : status;
}

static int is_curve(const sa_map_node *node, double q)
{
    for (int i = 1; i < node->count - 1; ++i)
        if (fabs(node->q[i] - q) <= 1e-15 * (1 + q))
            return 1;
    return 0;
}

/* Curves whose waves move the rail so little that the map leaves them out (sa_map_negligible): zeta is the
 * same on either side. */
static cv_status hidden_crossings(const sa_map_node *node, const sa_map *map, sa_field *field,
                                  sa_crossings *out)
{
    const double beside = 1e-9;
    sa_branch_point point[SA_MAP_CURVES_MAX];
    int n = sa_branch_points(point, SA_MAP_CURVES_MAX, &map->curves, node->alpha);
    cv_status status = n < 0 || n > SA_MAP_CURVES_MAX ? CV_FAILED : CV_OK;
    for (int i = 0; i < n && status == CV_OK; ++i) {
        sa_sample rim[2];
        scan sc = {.node = node, .field = field, .out = out};
        double t, q = point[i].q * (1 + beside);
        if (!isfinite(point[i].p) || is_curve(node, point[i].q))
            continue;
        sa_map_locate(&sc.strip, &sc.side, &t, node, q);
        status = sample(&rim[0], &sc, t);
        rim[1] = rim[0];
        if (status == CV_OK)
            status = rim_crossings(out, rim, &point[i]);
    }
    return status;
}

static cv_status scan_gaps(const sa_map_node *node, const sa_map *map, sa_field *field, sa_crossings *out)
{
    cv_status status = CV_OK;
    for (int curve = 1; curve < node->count - 1 && status == CV_OK; ++curve) {
        const scan below = {.node = node, .field = field, .out = out, .strip = curve - 1, .side = 1},
                   above = {.node = node, .field = field, .out = out, .strip = curve, .side = 0};
        if (node->gap[curve] > 0 && map->undamped)
            status = limit_crossings(&below, &above, map, node->q[curve]);
        else if (node->gap[curve] > 0)
            status = gap_crossing(&below, &above);
    }
    return status == CV_OK && map->undamped ? hidden_crossings(node, map, field, out) : status;
}

cv_status sa_crossings_find(sa_crossings *out, const sa_map *map, sa_field *field, double alpha,
                            double re_low, cv_message *why)
{
    return sa_crossings_find_finer(out, map, field, alpha, re_low, 0, why);
}

cv_status sa_crossings_find_finer(sa_crossings *out, const sa_map *map, sa_field *field, double alpha,
                                  double re_low, int refinement, cv_message *why)
{
    const double interval = 0.5 / pow(1.7, refinement), tolerance = ldexp(0.2, -refinement);
    sa_map_node node;
    *out = (sa_crossings){0};
    cv_status status = sa_map_node_of(&node, map, alpha);
    for (int strip = 0; status == CV_OK && strip < node.count - 1; ++strip)
        for (int side = 0; side < sa_map_strip_sides(&node, strip) && status == CV_OK; ++side) {
            scan sc = {&node, field, re_low, out, interval, tolerance, strip, side};
            status = scan_side(&sc);
        }
    if (status == CV_OK)
        status = scan_gaps(&node, map, field, out);
    if (status == CV_OK)
        return CV_OK;
    sa_crossings_clear(out);
    return cv_fail(why, status, "crossings of the real axis at alpha = %.15g cannot be told apart", alpha);
}

void sa_crossings_clear(sa_crossings *list)
{
    free(list->items);
    *list = (sa_crossings){0};
}

cv_status sa_crossings_count(int *roots, const sa_crossings *list, double level)
{
    int sum = 0;
    for (size_t i = 0; i < list->count; ++i) {
        const sa_crossing *c = &list->items[i];
        if (!(fabs(c->re - level) > 2 * c->re_error))
            return CV_UNDECIDED;
        if (c->re > level)
            sum += 2 * c->direction;
    }
    *roots = sum;
    return CV_OK;
}
