#include "semianalytic/map_build.h"

#include <math.h>
#include <stdlib.h>

/* Slopes of curves that run into the shear velocity are infinite there; nothing depends on their value. */
static const double slope_limit = 1e9;

double sa_map_column_extent(const sa_column *column, int side)
{
    double half = (column->alpha_high - column->alpha_low) / 2;
    return log1p(half / (side ? column->length_high : column->length_low));
}

static void place_velocity(sa_map_node *node, const sa_column *c, int side, double u)
{
    double length = side ? c->length_high : c->length_low, extent = sa_map_column_extent(c, side);
    double distance = u == 1 ? (c->alpha_high - c->alpha_low) / 2 : length * expm1(u * extent);
    node->alpha = side ? c->alpha_high - distance : c->alpha_low + distance;
    node->alpha_u = (side ? -1 : 1) * length * exp(u * extent) * extent;
}

static double limited(double slope, double limit)
{
    return fmin(fmax(slope, -limit), limit);
}

double sa_map_gap(double q)
{
    return 1e-12 * (1 + q);
}

/* Where the damping is below what doubles resolve, the curve keeps a distance: zeta is then so large that
 * nothing of interest is nearer. Falls to zero, with its slope, as the damping grows. */
static void place_gap(sa_map_node *node, int i, const sa_map *map, double damping, double damping_slope)
{
    const double damped = 2e-15, relative = map->undamped ? 2 * sa_map_gap(0) : damped;
    double resolved = relative * (1 + node->q[i]), slope = relative * limited(node->slope[i], 1e5);
    double x = damping / resolved, y = 1 - x * x;
    node->gap[i] = x < 1 ? resolved / 2 * y * y : 0;
    node->gap_slope[i] = x < 1 ? slope / 2 * y * y - 2 * x * y * (damping_slope - x * slope) : 0;
}

/* sa_map_grading is linear. */
static double grading_slope(double damping_slope, double slope)
{
    return sa_map_grading(damping_slope, limited(slope, 1e5)) - sa_map_grading(0, 0);
}

static cv_status place_arc(sa_map_node *node, int i, const sa_map *map, int number)
{
    const sa_branch_arc *arc = &map->curves.arc[number];
    sa_wave wave;
    long double q, alpha = node->alpha;
    alpha = fminl(fmaxl(alpha, arc->alpha_low), arc->alpha_high);
    if (sa_branch_arc_at(&wave, &q, &map->curves, (size_t)number, alpha) != CV_OK || !isfinite(wave.p))
        return CV_FAILED;
    double slope = (double)(q < 0 ? wave.p : -wave.p) * arc->direction, along_p;
    double damping = sa_map_damping(&along_p, map, &wave);
    double damping_slope =
        along_p / (double)(arc->direction * wave.d[2]); /* d alpha / dp = direction omega'' */
    node->q[i] = (double)fabsl(q);
    node->slope[i] = limited(slope, slope_limit);
    node->length[i] = sa_map_grading(damping, node->q[i]);
    /* at a cusp the damping has a slope like 1 / sqrt(distance) that changes nothing */
    damping_slope = limited(damping_slope, 1e5 * node->length[i]);
    node->length_slope[i] = grading_slope(damping_slope, node->slope[i]);
    place_gap(node, i, map, damping, damping_slope);
    return CV_OK;
}

static void place_ghost(sa_map_node *node, int i, const sa_ghost *ghost)
{
    double beyond = node->alpha - ghost->alpha, q = ghost->q + ghost->slope * beyond;
    double off = 0.3 * ghost->width * pow(fabs(beyond), 1.5);
    node->q[i] = fabs(q);
    node->slope[i] = q < 0 ? -ghost->slope : ghost->slope;
    node->length[i] = sa_map_grading(ghost->damping, node->q[i]) + off;
    node->length_slope[i] = grading_slope(0, node->slope[i]) + (beyond == 0 ? 0 : 1.5 * off / beyond);
}

/* A curve is graded as finely as any other that it meets: its length becomes the harmonic sum of (length +
 * distance) over all curves. */
static void blend_lengths(sa_map_node *node)
{
    double length[SA_MAP_CURVES_MAX + 2], slope[SA_MAP_CURVES_MAX + 2];
    int last = node->count - 2;
    for (int i = 1; i <= last; ++i) {
        double sum = 0, sum_slope = 0;
        for (int j = 1; j <= last; ++j) {
            int sign = j > i ? 1 : -1;
            double reach = node->length[j] + sign * (node->q[j] - node->q[i]);
            sum += 1 / reach;
            sum_slope += (node->length_slope[j] + sign * (node->slope[j] - node->slope[i])) / (reach * reach);
        }
        length[i] = 1 / sum;
        slope[i] = sum_slope / (sum * sum);
    }
    for (int i = 1; i <= last; ++i) {
        node->length[i] = length[i];
        node->length_slope[i] = slope[i];
    }
}

static cv_status place_curves(sa_map_node *node, const sa_map *map, const sa_column *c)
{
    const double bottom = 1e-5; /* zeta ~ q^2: nothing but a power law below */
    node->count = c->count + 2;
    for (int i = 0; i < node->count; ++i)
        node->gap[i] = node->gap_slope[i] = 0;
    node->q[0] = node->slope[0] = node->length_slope[0] = 0;
    node->length[0] = bottom;
    for (int i = 0; i < c->count; ++i) {
        if (c->curve[i] < 0)
            place_ghost(node, i + 1, &map->ghost[-1 - c->curve[i]]);
        else if (place_arc(node, i + 1, map, c->curve[i]) != CV_OK)
            return CV_FAILED;
        node->q[i + 1] = fmax(node->q[i + 1], node->q[i]); /* rounding where curves meet */
    }
    node->q[c->count + 1] = fmax(c->q_top, node->q[c->count]);
    node->slope[c->count + 1] = node->length_slope[c->count + 1] = 0;
    node->length[c->count + 1] = 1;
    blend_lengths(node);
    return CV_OK;
}

cv_status sa_map_node_at(sa_map_node *out, const sa_map *map, size_t column, int side, double u)
{
    const sa_column *c = &map->column[column];
    place_velocity(out, c, side, u);
    return place_curves(out, map, c);
}

cv_status sa_map_node_of(sa_map_node *out, const sa_map *map, double alpha)
{
    size_t low = 0, high = map->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (alpha < map->column[middle].alpha_low)
            high = middle;
        else
            low = middle;
    }
    const sa_column *c = &map->column[low];
    out->alpha = fmin(fmax(alpha, c->alpha_low), c->alpha_high);
    out->alpha_u = 1;
    return place_curves(out, map, c);
}

int sa_map_strip_sides(const sa_map_node *node, int strip)
{
    return strip == node->count - 2 ? 1 : 2;
}

/* Width of one side of a strip without its gap, and d width / d alpha. */
static double side_width(double *slope, const sa_map_node *node, int strip, int side)
{
    int sides = sa_map_strip_sides(node, strip), curve = strip + side;
    double width = (node->q[strip + 1] - node->q[strip]) / sides - node->gap[curve];
    *slope = width > 0 ? (node->slope[strip + 1] - node->slope[strip]) / sides - node->gap_slope[curve] : 0;
    return fmax(width, 0);
}

double sa_map_strip_extent(const sa_map_node *node, int strip, int side)
{
    double slope, width = side_width(&slope, node, strip, side);
    return log1p(width / node->length[strip + side]);
}

void sa_map_point_at(sa_map_point *out, const sa_map_node *node, int strip, int side, double t)
{
    int curve = strip + side;
    double sign = side ? -1 : 1, length = node->length[curve], grown = node->length_slope[curve];
    double slope, width = side_width(&slope, node, strip, side);
    double ratio = width / length, extent = log1p(ratio);
    double extent_slope = (slope - ratio * grown) / (length + width);
    double power = exp(t * extent), distance = t == 1 ? width : length * expm1(t * extent);
    double along = grown * expm1(t * extent) + length * power * t * extent_slope;
    out->alpha = node->alpha;
    out->alpha_u = node->alpha_u;
    out->q = node->q[curve] + sign * (node->gap[curve] + distance);
    out->q_t = sign * length * power * extent;
    out->q_u = (node->slope[curve] + sign * (node->gap_slope[curve] + along)) * node->alpha_u;
}

void sa_map_locate(int *strip, int *side, double *t, const sa_map_node *node, double q)
{
    for (*strip = 0; *strip < node->count - 2 && q > node->q[*strip + 1];)
        ++*strip;
    *side = sa_map_strip_sides(node, *strip) == 2 && q > (node->q[*strip] + node->q[*strip + 1]) / 2;
    int curve = *strip + *side;
    double distance = fmax(fabs(q - node->q[curve]) - node->gap[curve], 0);
    double extent = sa_map_strip_extent(node, *strip, *side);
    *t = extent > 0 ? fmin(log1p(distance / node->length[curve]) / extent, 1) : 0;
}

void sa_map_clear(sa_map *map)
{
    sa_branch_curves_clear(&map->curves);
    free(map->ghost);
    free(map->column);
    *map = (sa_map){0};
}
