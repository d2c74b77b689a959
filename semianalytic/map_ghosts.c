#include "semianalytic/map_build.h"

#include <math.h>
#include <stdlib.h>

enum { GHOST_STEPS = 64 };

double sa_map_ghost_q(const sa_ghost *ghost, double alpha)
{
    return ghost->q + ghost->slope * (alpha - ghost->alpha);
}

/* q(p) = q_c - x d + omega''' x^3 / 6 with x = p - p_c, d = alpha - alpha_c: the points with dq/dp = 0 are
 * real on one side of the cusp, and imaginary with (2/3) sqrt(2 / |omega'''|) |d|^(3/2) on the other. */
static cv_status make_ghost(sa_ghost *ghost, const sa_map *map, size_t arc, int at_high)
{
    const sa_branch_curves *curves = &map->curves;
    const sa_branch_arc *a = &curves->arc[arc];
    sa_wave wave;
    double alpha = (double)(at_high ? a->alpha_high : a->alpha_low);
    if (sa_dispersion_wave(&wave, &curves->grid.track, a->k, at_high ? a->p_high : a->p_low, 0) != CV_OK)
        return CV_FAILED;
    double reach = 0.05 * alpha;
    ghost->alpha = alpha;
    ghost->q = (double)(wave.omega - (long double)a->direction * alpha * wave.p);
    ghost->slope = (double)(-a->direction * wave.p);
    ghost->damping = sa_map_damping(NULL, map, &wave);
    ghost->width = 2.0 / 3 * sqrt(2 / fabs((double)wave.d[3]));
    ghost->end = at_high ? fmin(alpha + reach, curves->alpha_max) : fmax(alpha - reach, curves->alpha_min);
    return CV_OK;
}

/* Each cusp is the upper or lower end in alpha of two arcs; the first of them makes the ghost. */
static int ends_in_cusp(const sa_branch_curves *curves, size_t arc, int at_high)
{
    const sa_branch_arc *a = &curves->arc[arc];
    long double p = at_high ? a->p_high : a->p_low, alpha = at_high ? a->alpha_high : a->alpha_low;
    if (!(alpha > curves->alpha_min && alpha < curves->alpha_max) || !isfinite(p) || p == 0)
        return 0;
    for (size_t i = 0; i < arc; ++i) {
        const sa_branch_arc *b = &curves->arc[i];
        long double other = at_high ? b->p_high : b->p_low;
        if (b->k == a->k && b->direction == a->direction && fabsl(other - p) < 1e-6L * p)
            return 0;
    }
    return 1;
}

/* A ghost and an arc; q = 0 for arc = -1 */
typedef struct {
    const sa_branch_curves *curves;
    const sa_ghost *ghost;
    int arc;
} meeting;

/* q of the ghost minus that of the arc and of its reflection, all signed, so that both are smooth. */
static void gaps(double gap[2], const meeting *m, double alpha)
{
    double q = sa_map_ghost_q(m->ghost, alpha);
    sa_wave wave;
    long double other = 0;
    if (m->arc >= 0 && sa_branch_arc_at(&wave, &other, m->curves, (size_t)m->arc, alpha) != CV_OK)
        other = q;
    gap[0] = q - (double)other;
    gap[1] = q + (double)other;
}

/* alpha, or the end of the arc that is nearest to it */
static double on_arc(const meeting *m, double alpha)
{
    if (m->arc < 0)
        return alpha;
    const sa_branch_arc *a = &m->curves->arc[m->arc];
    return fmin(fmax(alpha, (double)a->alpha_low), (double)a->alpha_high);
}

/* gap[kind] has the sign of before at low and another one at high. */
static cv_status add_meeting(sa_map_cuts *cuts, const meeting *m, int kind, double low, double high,
                             double before)
{
    while (fabs(high - low) > 4e-16 * high && (low + high) / 2 != low && (low + high) / 2 != high) {
        double middle = (low + high) / 2, here[2];
        gaps(here, m, middle);
        if (here[kind] * before > 0)
            low = middle;
        else
            high = middle;
    }
    return sa_map_cuts_add(cuts, high, 1);
}

/* Velocities where they meet, one at most of each kind in each step. */
static cv_status meetings(sa_map_cuts *cuts, const meeting *m)
{
    const sa_ghost *ghost = m->ghost;
    double previous = on_arc(m, ghost->alpha), before[2] = {0, 0}, here[2];
    if (previous != ghost->alpha)
        gaps(before, m, previous);
    for (int i = 1; i <= GHOST_STEPS; ++i) {
        double step = (ghost->end - ghost->alpha) * exp2((i - GHOST_STEPS) * 0.5);
        double alpha = on_arc(m, ghost->alpha + step);
        if (alpha == previous)
            continue;
        gaps(here, m, alpha);
        for (int kind = 0; kind < 2; ++kind) {
            if (here[kind] * before[kind] < 0 &&
                add_meeting(cuts, m, kind, previous, alpha, before[kind]) != CV_OK)
                return CV_FAILED;
            before[kind] = here[kind];
        }
        previous = alpha;
    }
    return CV_OK;
}

/* Two ghosts, straight as they are, meet once at most, and each the reflection of the other once. */
static cv_status ghosts_meet(sa_map_cuts *cuts, const sa_ghost *a, const sa_ghost *b)
{
    double low = fmax(fmin(a->alpha, a->end), fmin(b->alpha, b->end));
    double high = fmin(fmax(a->alpha, a->end), fmax(b->alpha, b->end));
    for (int sign = -1; sign <= 1; sign += 2) {
        double apart = sa_map_ghost_q(a, low) + sign * sa_map_ghost_q(b, low);
        double alpha = low - apart / (a->slope + sign * b->slope);
        if (alpha > low && alpha < high && sa_map_cuts_add(cuts, alpha, 0) != CV_OK)
            return CV_FAILED;
    }
    return CV_OK;
}

cv_status sa_map_ghosts(sa_map *map, sa_map_cuts *cuts)
{
    const sa_branch_curves *curves = &map->curves;
    map->ghost = calloc(2 * curves->arc_count + 1, sizeof *map->ghost);
    if (map->ghost == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < 2 * curves->arc_count; ++i) {
        if (!ends_in_cusp(curves, i / 2, i % 2 == 1))
            continue;
        sa_ghost *ghost = &map->ghost[map->ghost_count++];
        if (make_ghost(ghost, map, i / 2, i % 2 == 1) != CV_OK ||
            sa_map_cuts_add(cuts, ghost->end, 0) != CV_OK)
            return CV_FAILED;
        for (sa_ghost *other = map->ghost; other < ghost; ++other)
            if (ghosts_meet(cuts, other, ghost) != CV_OK)
                return CV_FAILED;
        for (int arc = -1; arc < (int)curves->arc_count; ++arc) {
            const meeting m = {curves, ghost, arc};
            if (meetings(cuts, &m) != CV_OK)
                return CV_FAILED;
        }
    }
    return CV_OK;
}
