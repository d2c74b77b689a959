#include "semianalytic/map_build.h"

#include <math.h>
#include <stdlib.h>

/* Null vector of the tridiagonal K(p) - omega^2 M from its largest adjugate column. */
static void mode_shape(double v[3], const sa_dispersion *d, long double p, long double omega)
{
    long double p2 = p * p, w2 = omega * omega;
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

double sa_map_strength(double *damping, const sa_map *map, const sa_wave *wave)
{
    double v[3], omega = (double)wave->omega;
    mode_shape(v, &map->curves.grid.track, wave->p, wave->omega);
    double pad = v[0] - v[1], ballast = v[1] - v[2];
    *damping = pad * pad + ballast * ballast + v[2] * v[2];
    return pow(v[0], 4) / (omega * omega * fabs((double)wave->d[2]));
}

static double damping_at(const sa_map *map, long double p, long double omega)
{
    double v[3];
    mode_shape(v, &map->curves.grid.track, p, omega);
    double pad = v[0] - v[1], ballast = v[1] - v[2];
    return map->eta_p * pad * pad + map->eta_b * ballast * ballast + map->eta_f * v[2] * v[2];
}

double sa_map_damping(double *slope, const sa_map *map, const sa_wave *wave)
{
    const long double h = 1e-5L;
    long double dp = h * wave->p, bend = wave->d[2] * dp * dp / 2;
    if (slope != NULL)
        *slope = (damping_at(map, wave->p + dp, wave->omega + wave->d[1] * dp + bend) -
                  damping_at(map, wave->p - dp, wave->omega - wave->d[1] * dp + bend)) /
                 (double)(2 * dp);
    return damping_at(map, wave->p, wave->omega);
}

double sa_map_grading(double damping, double size)
{
    const double finest = 2e-14;
    return 0.1 * damping + finest * (1 + size);
}

int sa_map_negligible(const sa_map *map, const sa_wave *wave, double q)
{
    const double share = 1e-7, finest = 1e-14, undamped_share = 1e-13;
    double v[3], eta = fmax(map->eta_p, fmax(map->eta_b, map->eta_f));
    if (!isfinite(wave->p))
        return 1;
    mode_shape(v, &map->curves.grid.track, wave->p, wave->omega);
    double sharpest = map->undamped ? sa_map_gap(q) : fmax(sa_map_damping(NULL, map, wave), finest);
    double peak = v[0] * v[0] / (2 * (double)wave->omega * sqrt(2 * fabs((double)wave->d[2]) * sharpest));
    return peak < (map->undamped ? undamped_share : share * eta) * q;
}

/* Sampled damping along the part of a branch that is an arc. */
typedef struct {
    const sa_map *map;
    int k;
    long double p;
    double damping;
} station;

static cv_status set_station(station *s, long double p)
{
    sa_wave wave;
    if (sa_dispersion_wave(&wave, &s->map->curves.grid.track, s->k, p, 0) != CV_OK)
        return CV_FAILED;
    s->p = p;
    s->damping = sa_map_damping(NULL, s->map, &wave);
    return CV_OK;
}

/* Minimum between low and high by golden section. */
static cv_status minimum(station *best, station low, station high)
{
    const long double golden = 0.381966011250105L;
    station left = low, right = low;
    cv_status status = set_station(&left, low.p + golden * (high.p - low.p));
    if (status == CV_OK)
        status = set_station(&right, high.p - golden * (high.p - low.p));
    for (int i = 0; i < 90 && status == CV_OK; ++i) {
        if (left.damping < right.damping) {
            high = right;
            right = left;
            status = set_station(&left, low.p + golden * (high.p - low.p));
        } else {
            low = left;
            left = right;
            status = set_station(&right, high.p - golden * (high.p - low.p));
        }
    }
    *best = left;
    return status;
}

/* Cuts where the damping between three neighbouring nodes of the grid has a deep minimum. */
static cv_status cut_dip(sa_map_cuts *cuts, const sa_branch_arc *arc, station left, station right,
                         double around)
{
    const double deep = 0.1;
    station best;
    sa_wave wave;
    cv_status status = minimum(&best, left, right);
    if (status != CV_OK || !(best.damping < deep * around))
        return status;
    status = sa_dispersion_wave(&wave, &best.map->curves.grid.track, best.k, best.p, 0);
    if (status != CV_OK)
        return status;
    long double alpha = arc->direction * wave.d[1];
    if (alpha > fmaxl(arc->alpha_low, best.map->curves.alpha_min) &&
        alpha < fminl(arc->alpha_high, best.map->curves.alpha_max))
        return sa_map_cuts_add(cuts, (double)alpha, 1);
    return CV_OK;
}

cv_status sa_map_dips(const sa_map *map, sa_map_cuts *cuts)
{
    const sa_branch_grid *grid = &map->curves.grid;
    if (map->undamped)
        return CV_OK;
    for (size_t i = 0; i < map->curves.arc_count; ++i) {
        const sa_branch_arc *arc = &map->curves.arc[i];
        long double low = fminl(arc->p_low, arc->p_high), high = fmaxl(arc->p_low, arc->p_high);
        station s[3] = {{map, arc->k, 0, 0}, {map, arc->k, 0, 0}, {map, arc->k, 0, 0}};
        double largest = 0;
        for (size_t n = 0, seen = 0; n < grid->count; ++n) {
            if (!(grid->node[n].p > low && grid->node[n].p < high))
                continue;
            s[0] = s[1];
            s[1] = s[2];
            s[2].p = grid->node[n].p;
            s[2].damping = sa_map_damping(NULL, map, &grid->node[n].wave[arc->k]);
            largest = fmax(largest, s[2].damping);
            if (++seen >= 3 && s[1].damping <= s[0].damping && s[1].damping <= s[2].damping &&
                cut_dip(cuts, arc, s[0], s[2], largest) != CV_OK)
                return CV_FAILED;
        }
    }
    return CV_OK;
}
