#include "semianalytic/branch_curves.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "semianalytic/branch_special.h"

/* Newton with the second derivative: solves the quadratic Taylor polynomial of omega' for the root on the
 * side where omega'' keeps its sign, which stays exact up to the cusp at the end of an arc. */
static long double quadratic_step(const sa_wave *w, long double value, int rising)
{
    long double slope = w->d[2];
    long double disc = slope * slope - 2 * w->d[3] * value;
    long double root = sqrtl(disc > 0 ? disc : 0);
    long double den = slope + (rising ? root : -root);

    return den == 0 ? 0 : -2 * value / den;
}

/* p between low and high with omega_k'(p) = target, where omega_k' is monotone. */
static cv_status solve_between(sa_wave *w, const sa_dispersion *track, int k, long double target,
                               long double low, long double high, int rising)
{
    long double p = low + (high - low) / 2, guess = 0;

    for (int i = 0; i < 200; i++) {
        cv_status status = sa_dispersion_wave(w, track, k, p, guess);
        if (status != CV_OK) {
            return status;
        }
        guess = w->omega;
        long double value = w->d[1] - target;
        if ((value < 0) == rising) {
            low = p;
        } else {
            high = p;
        }
        long double step = quadratic_step(w, value, rising);
        if (fabsl(step) <= 4 * LDBL_EPSILON * p || high - low <= 2 * LDBL_EPSILON * high) {
            return CV_OK;
        }
        p += step;
        if (!(p >= low && p <= high)) {
            p = low + (high - low) / 2;
        }
    }
    return CV_OK;
}

/* The samples next to the root narrow the bracket. */
static void narrow(long double *low, long double *high, const sa_branch_grid *grid, int k, long double target,
                   int rising)
{
    size_t first = 0, last = grid->count; /* node[first].p <= low, root before node[last] */

    while (last - first > 1) {
        size_t mid = first + (last - first) / 2;
        const sa_branch_node *node = &grid->node[mid];
        int before = node->p <= *low || (node->p < *high && (node->wave[k].d[1] < target) == rising);
        if (before) {
            first = mid;
        } else {
            last = mid;
        }
    }
    *low = fmaxl(*low, grid->node[first].p);
    if (last < grid->count) {
        *high = fminl(*high, grid->node[last].p);
    }
}

cv_status sa_branch_arc_at(sa_wave *wave, long double *q, const sa_branch_curves *curves, size_t arc,
                           long double alpha)
{
    const sa_branch_arc *a = &curves->arc[arc];
    const sa_branch_grid *grid = &curves->grid;
    long double low = fminl(a->p_low, a->p_high), high = fmaxl(a->p_low, a->p_high);
    long double target = a->direction * alpha;
    int rising = (a->p_low < a->p_high) == (a->direction > 0);

    narrow(&low, &high, grid, a->k, target, rising);
    if (isinf(high)) {
        /* omega' = c - O(p^-2): double until the target is passed; rounding may never let it */
        high = 2 * low;
        for (;; high *= 2) {
            cv_status status = sa_dispersion_wave(wave, &grid->track, a->k, high, 0);
            if (status != CV_OK) {
                return status;
            }
            if (wave->d[1] >= target) {
                break;
            }
            if (high > 1e12L) {
                *wave = (sa_wave){.p = INFINITY, .omega = INFINITY, .d = {INFINITY, target}};
                *q = 0;
                return CV_OK;
            }
            low = high;
        }
    }
    cv_status status = solve_between(wave, &grid->track, a->k, target, low, high, rising);
    /* stationary in p at fixed alpha: first-order errors of p do not matter */
    *q = wave->intercept + wave->p * (wave->d[1] - target);
    return status;
}

static int by_q(const void *left, const void *right)
{
    const sa_branch_point *a = left, *b = right;

    return (a->q > b->q) - (a->q < b->q);
}

int sa_branch_points(sa_branch_point *out, size_t room, const sa_branch_curves *curves, double alpha)
{
    size_t count = 0;

    for (size_t i = 0; i < curves->arc_count; i++) {
        const sa_branch_arc *a = &curves->arc[i];
        sa_wave w;
        long double q;

        if (!(alpha >= a->alpha_low && alpha <= a->alpha_high)) {
            continue;
        }
        if (sa_branch_arc_at(&w, &q, curves, i, alpha) != CV_OK) {
            return -1;
        }
        int sign = q < 0 ? -1 : 1;
        if (count < room) {
            out[count] = (sa_branch_point){.arc = (int)i,
                                           .k = a->k,
                                           .sign = sign,
                                           .p = (double)(-sign * a->direction * w.p),
                                           .q = (double)fabsl(q),
                                           .curvature = (double)(sign * w.d[2])};
        }
        count++;
    }
    qsort(out, count < room ? count : room, sizeof *out, by_q);
    return (int)count;
}

cv_status sa_branch_curves_build(sa_branch_curves *out, const cv_params *params, double alpha_min,
                                 double alpha_max, cv_message *why)
{
    sa_dispersion track;

    memset(out, 0, sizeof *out);
    out->alpha_min = alpha_min;
    out->alpha_max = alpha_max;
    sa_dispersion_set(&track, params);
    cv_status status = sa_branch_grid_build(&out->grid, &track, alpha_min, alpha_max, why);
    if (status == CV_OK) {
        status = sa_branch_arcs_find(out);
    }
    if (status == CV_OK) {
        status = sa_branch_special_find(out);
    }
    if (status != CV_OK) {
        sa_branch_curves_clear(out);
        return cv_fail(why, status, "the branch curves of this track cannot be computed");
    }
    return CV_OK;
}

void sa_branch_curves_clear(sa_branch_curves *curves)
{
    sa_branch_grid_clear(&curves->grid);
    free(curves->arc);
    free(curves->special);
    memset(curves, 0, sizeof *curves);
}
