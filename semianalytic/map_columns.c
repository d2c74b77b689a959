#include "semianalytic/map_build.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    double q;
    int arc; /* as in sa_column */
} found;

static int by_q(const void *left, const void *right)
{
    const found *a = left, *b = right;
    return (a->q > b->q) - (a->q < b->q);
}

/* Smallest damping of the wave of an arc over the column, and its largest p. */
static cv_status arc_damping(double *damping, double *largest_p, const sa_map *map, const sa_column *c,
                             int arc)
{
    static const double where[] = {0.01, 0.1, 0.5, 0.9, 0.99};
    *damping = INFINITY;
    for (int i = 0; i < 5; ++i) {
        double alpha = c->alpha_low + where[i] * (c->alpha_high - c->alpha_low);
        sa_wave wave;
        long double q;
        if (sa_branch_arc_at(&wave, &q, &map->curves, (size_t)arc, alpha) != CV_OK)
            return CV_FAILED;
        if (!isfinite(wave.p))
            continue;
        *damping = fmin(*damping, sa_map_damping(NULL, map, &wave));
        *largest_p = fmax(*largest_p, (double)wave.p);
    }
    return CV_OK;
}

static cv_status collect_curves(found *list, int *count, const sa_map *map, double alpha)
{
    sa_branch_point point[SA_MAP_CURVES_MAX];
    int n = sa_branch_points(point, SA_MAP_CURVES_MAX, &map->curves, alpha);
    if (n < 0 || n + (int)map->ghost_count > SA_MAP_CURVES_MAX)
        return CV_FAILED;
    int kept = 0;
    for (int i = 0; i < n; ++i) {
        sa_wave wave;
        long double q;
        if (sa_branch_arc_at(&wave, &q, &map->curves, (size_t)point[i].arc, alpha) != CV_OK)
            return CV_FAILED;
        if (!sa_map_negligible(map, &wave, point[i].q))
            list[kept++] = (found){point[i].q, point[i].arc};
    }
    n = kept;
    for (size_t i = 0; i < map->ghost_count; ++i) {
        const sa_ghost *g = &map->ghost[i];
        if (alpha > fmin(g->alpha, g->end) && alpha < fmax(g->alpha, g->end))
            list[n++] = (found){fabs(sa_map_ghost_q(g, alpha)), -1 - (int)i};
    }
    qsort(list, (size_t)n, sizeof *list, by_q);
    *count = n;
    return CV_OK;
}

cv_status sa_map_narrowest(double *width, const sa_map *map, double alpha)
{
    const double lowest_q = 1e-7;
    found list[SA_MAP_CURVES_MAX];
    int count;
    if (collect_curves(list, &count, map, alpha) != CV_OK)
        return CV_FAILED;
    *width = count > 0 && list[0].q < lowest_q ? 0 : INFINITY;
    for (int i = 1; i < count; ++i)
        *width = fmin(*width, (list[i].q - list[i - 1].q) / (1 + list[i].q));
    return CV_OK;
}

cv_status sa_map_column_fill(sa_column *column, const sa_map *map, int graded_low, int graded_high)
{
    found list[SA_MAP_CURVES_MAX];
    double smallest = INFINITY, largest_p = 1, width = column->alpha_high - column->alpha_low;
    double middle = column->alpha_low + width / 2, top = 0;
    if (collect_curves(list, &column->count, map, middle) != CV_OK)
        return CV_FAILED;
    for (int i = 0; i < column->count; ++i) {
        double damping = 0;
        if (list[i].arc >= 0) {
            if (arc_damping(&damping, &largest_p, map, column, list[i].arc) != CV_OK)
                return CV_FAILED;
            smallest = fmin(smallest, damping);
        }
        column->curve[i] = list[i].arc;
        top = list[i].q;
    }
    double length = sa_map_grading(smallest / largest_p, 0);
    column->length_low = graded_low ? length : 0.3 * width;
    column->length_high = graded_high ? length : 0.3 * width;
    column->q_top = 20 + 20 * top + 5 * column->alpha_high * column->alpha_high;
    return CV_OK;
}
