#include "semianalytic/map_build.h"

#include <math.h>
#include <stdlib.h>

/* Null vector of the tridiagonal K(p) - omega^2 M from its largest adjugate column. */
static void mode_shape(double v[3], const sa_dispersion *d, const sa_wave *wave)
{
    long double p2 = wave->p * wave->p, w2 = wave->omega * wave->omega;
    long double a = p2 * p2 / 4 - d->eta_N * p2 + d->kappa_p - w2;
    long double b = d->kappa_p + d->kappa_b - d->mu_s * w2;
    long double c = d->kappa_b + 1 + d->eta_s * p2 - d->mu_b * w2;
    long double kp = d->kappa_p, kb = d->kappa_b, best = -1;
    long double column[3][3] = {
        {b * c - kb * kb, kp * c, kp * kb}, {kp * c, a * c, a * kb}, {kp * kb, a * kb, a * b - kp * kp}};
    for (int j = 0; j < 3; ++j) {
        long double *w = column[j];
        long double size = w[0] * w[0] + d->mu_s * w[1] * w[1] + d->mu_b * w[2] * w[2];
        if (!(size > best))
            continue;
        best = size;
        for (int i = 0; i < 3; ++i)
            v[i] = (double)(w[i] / sqrtl(size));
    }
}

double sa_map_damping(const sa_map *map, const sa_wave *wave)
{
    double v[3];
    mode_shape(v, &map->curves.grid.track, wave);
    double pad = v[0] - v[1], ballast = v[1] - v[2];
    return map->eta_p * pad * pad + map->eta_b * ballast * ballast + map->eta_f * v[2] * v[2];
}

int sa_map_negligible(const sa_map *map, const sa_wave *wave, double q)
{
    const double share = 1e-7, finest = 1e-14;
    double v[3], eta = fmax(map->eta_p, fmax(map->eta_b, map->eta_f));
    if (!isfinite(wave->p))
        return 1;
    mode_shape(v, &map->curves.grid.track, wave);
    double damping = fmax(sa_map_damping(map, wave), finest);
    double peak = v[0] * v[0] / (2 * (double)wave->omega * sqrt(2 * fabs((double)wave->d[2]) * damping));
    return peak < share * eta * q;
}

typedef struct {
    double q;
    sa_map_curve curve;
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
        *damping = fmin(*damping, sa_map_damping(map, &wave));
        *largest_p = fmax(*largest_p, (double)wave.p);
    }
    return CV_OK;
}

/* Grading lengths: a tenth of the damping, but not below what doubles resolve. */
static double grading(double damping, double size)
{
    double finest = 2e-14 * (1 + size), coarsest = 1 + size;
    return fmin(fmax(0.1 * damping, finest), coarsest);
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
            list[kept++] = (found){point[i].q, {point[i].arc, 0}};
    }
    n = kept;
    for (size_t i = 0; i < map->ghost_count; ++i) {
        const sa_ghost *g = &map->ghost[i];
        if (alpha > fmin(g->alpha, g->end) && alpha < fmax(g->alpha, g->end))
            list[n++] = (found){fabs(sa_map_ghost_q(g, alpha)), {-1 - (int)i, 0}};
    }
    qsort(list, (size_t)n, sizeof *list, by_q);
    *count = n;
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
        if (list[i].curve.arc >= 0) {
            if (arc_damping(&damping, &largest_p, map, column, list[i].curve.arc) != CV_OK)
                return CV_FAILED;
            smallest = fmin(smallest, damping);
        }
        column->curve[i] = list[i].curve;
        column->curve[i].length = grading(damping, list[i].q);
        top = list[i].q;
    }
    double length = grading(smallest / largest_p, 0);
    column->length_low = graded_low ? length : 0.3 * width;
    column->length_high = graded_high ? length : 0.3 * width;
    column->q_top = 20 + 20 * top + 5 * column->alpha_high * column->alpha_high;
    return CV_OK;
}
