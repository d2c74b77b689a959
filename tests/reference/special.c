/* Special velocities: see dispersion.h. The branch curves are cut into cells that are monotone in alpha. */
#include "dispersion.h"

#include <math.h>
#include <stdlib.h>

enum { GRID_SIZE = 4000, NODES = GRID_SIZE + 60, CELLS = 3 * NODES, BISECTIONS = 55 };
static const double grid_log_min = -9.0, grid_step = 0.00375;

/* A piece of branch k between the wavenumbers p[0] < p[1]. */
typedef struct {
    int k;
    double p[2], alpha[2], q[2], turn[2]; /* turn: omega - p omega', whose absolute value is q */
} cell;

typedef struct {
    size_t count, max;
    double *alpha;
    double lo, hi;
} list;

static void add(list *l, double alpha)
{
    if (alpha > l->lo && alpha < l->hi && l->count < l->max)
        l->alpha[l->count++] = alpha;
}

static int compare(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

static double group_slope(const ref_dtrack *t, int k, double p)
{
    double omega[3], before[3], after[3], h = 1e-5 * p;
    ref_dispersion(omega, before, t, p - h);
    ref_dispersion(omega, after, t, p + h);
    return after[k] - before[k];
}

/* The wavenumber of the cusp between two grid points where the slope of omega' changes sign. */
static double find_cusp(const ref_dtrack *t, int k, double lo, double hi)
{
    double sign = group_slope(t, k, lo);
    for (int i = 0; i < BISECTIONS; i++) {
        double mid = 0.5 * (lo + hi);
        if (sign * group_slope(t, k, mid) > 0)
            lo = mid;
        else
            hi = mid;
    }
    return 0.5 * (lo + hi);
}

static void set_end(cell *c, int end, const ref_dtrack *t, double p)
{
    double omega[3], group[3];
    ref_dispersion(omega, group, t, p);
    c->p[end] = p;
    c->alpha[end] = fabs(group[c->k]);
    c->turn[end] = omega[c->k] - p * group[c->k];
    c->q[end] = fabs(c->turn[end]);
}

/* The cells of branch k, cusps included as nodes; the cusps' velocities go to the list. */
static size_t make_cells(cell *out, size_t n, const ref_dtrack *t, int k, list *found)
{
    double last = exp(grid_log_min), slope = group_slope(t, k, last);
    for (int i = 1; i < GRID_SIZE && n + 2 < CELLS; i++) {
        double p = exp(grid_log_min + grid_step * i), next = group_slope(t, k, p);
        if (slope * next < 0) {
            double cusp = find_cusp(t, k, last, p);
            out[n].k = k;
            set_end(&out[n], 0, t, last);
            set_end(&out[n], 1, t, cusp);
            add(found, out[n++].alpha[1]);
            last = cusp;
        }
        out[n].k = k;
        set_end(&out[n], 0, t, last);
        set_end(&out[n++], 1, t, p);
        last = p;
        slope = next;
    }
    return n;
}

/* q (want = 0) or the signed turn (want = 1) of the point of a monotone cell that has this alpha. */
static double cell_at(const cell *c, const ref_dtrack *t, double alpha, int want)
{
    cell x = *c;
    int rising = c->alpha[1] > c->alpha[0];
    for (int i = 0; i < BISECTIONS; i++) {
        cell mid = {.k = c->k};
        set_end(&mid, 0, t, 0.5 * (x.p[0] + x.p[1]));
        int end = (mid.alpha[0] < alpha) != rising;
        x.p[end] = mid.p[0];
        x.q[end] = mid.q[0];
        x.turn[end] = mid.turn[0];
    }
    return want ? 0.5 * (x.turn[0] + x.turn[1]) : 0.5 * (x.q[0] + x.q[1]);
}

/* The velocity where the curves of two cells cross (b NULL: where a crosses q = 0), if they do. */
static void find_crossing(list *found, const cell *a, const cell *b, const ref_dtrack *t)
{
    double lo = fmin(a->alpha[0], a->alpha[1]), hi = fmax(a->alpha[0], a->alpha[1]), at_lo = 0, at_hi = 0;
    if (b != NULL) {
        lo = fmax(lo, fmin(b->alpha[0], b->alpha[1]));
        hi = fmin(hi, fmax(b->alpha[0], b->alpha[1]));
    }
    at_lo = cell_at(a, t, lo, b == NULL) - (b == NULL ? 0 : cell_at(b, t, lo, 0));
    at_hi = cell_at(a, t, hi, b == NULL) - (b == NULL ? 0 : cell_at(b, t, hi, 0));
    if (!(at_lo * at_hi < 0))
        return;
    for (int i = 0; i < BISECTIONS; i++) {
        double mid = 0.5 * (lo + hi);
        double f = cell_at(a, t, mid, b == NULL) - (b == NULL ? 0 : cell_at(b, t, mid, 0));
        if (f * at_lo > 0)
            lo = mid;
        else
            hi = mid;
    }
    add(found, 0.5 * (lo + hi));
}

static int apart(const double x[2], const double y[2])
{
    return fmax(x[0], x[1]) < fmin(y[0], y[1]) || fmax(y[0], y[1]) < fmin(x[0], x[1]);
}

static void find_crossings(list *found, const cell *c, size_t n, const ref_dtrack *t)
{
    for (size_t i = 0; i < n; i++) {
        if (fmax(c[i].alpha[0], c[i].alpha[1]) < found->lo || fmin(c[i].alpha[0], c[i].alpha[1]) > found->hi)
            continue;
        if (c[i].turn[0] * c[i].turn[1] < 0)
            find_crossing(found, &c[i], NULL, t);
        for (size_t j = i + 2; j < n; j++)
            if (!apart(c[i].alpha, c[j].alpha) && !apart(c[i].q, c[j].q))
                find_crossing(found, &c[i], &c[j], t);
    }
}

size_t ref_special_velocities(double *alpha, size_t max, const ref_dtrack *t, double lo, double hi)
{
    list found = {0, max, alpha, lo, hi};
    cell *cells = malloc(CELLS * sizeof *cells);
    size_t n = 0, kept = 0;
    if (cells == NULL)
        return 0;
    for (int k = 0; k < 3; k++)
        n = make_cells(cells, n, t, k, &found);
    find_crossings(&found, cells, n, t);
    add(&found, sqrt(t->value[REF_ETA_S] / t->value[REF_MU_B]));
    qsort(alpha, found.count, sizeof *alpha, compare);
    for (size_t i = 0; i < found.count; i++)
        if (kept == 0 || alpha[i] > alpha[kept - 1] * (1 + 1e-13))
            alpha[kept++] = alpha[i];
    free(cells);
    return kept;
}
