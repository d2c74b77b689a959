/* Special velocities: see dispersion.h. The branch curves are cut into cells that are monotone in alpha and
 * do not touch q = 0 inside. */
#include "dispersion.h"

#include <math.h>
#include <stdlib.h>

enum { GRID_SIZE = 4000, NODES = GRID_SIZE + 60, CELLS = 3 * NODES, BISECTIONS = 55 };
static const double grid_log_min = -9.0, grid_step = 0.00375;

/* A piece of branch k between the wavenumbers p[0] < p[1]. */
typedef struct {
    int k;
    double p[2], alpha[2], q[2];
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

/* What cuts a branch into cells: the slope of omega', or omega - p omega'; both change sign at a node. */
typedef enum { CUSP, TURN } node;

static double node_value(const ref_dtrack *t, int k, node what, double p)
{
    double omega[3], before[3], after[3], h = 1e-5 * p;
    if (what == TURN) {
        ref_dispersion(omega, before, t, p);
        return omega[k] - p * before[k];
    }
    ref_dispersion(omega, before, t, p - h);
    ref_dispersion(omega, after, t, p + h);
    return after[k] - before[k];
}

/* The wavenumber between two grid points where the value changes sign. */
static double find_node(const ref_dtrack *t, int k, node what, double lo, double hi)
{
    double sign = node_value(t, k, what, lo);
    for (int i = 0; i < BISECTIONS; i++) {
        double mid = 0.5 * (lo + hi);
        if (sign * node_value(t, k, what, mid) > 0)
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
    c->q[end] = fabs(omega[c->k] - p * group[c->k]);
}

static size_t add_cell(cell *out, size_t n, const ref_dtrack *t, int k, double from, double to)
{
    out[n].k = k;
    set_end(&out[n], 0, t, from);
    set_end(&out[n], 1, t, to);
    return n + 1;
}

/* The cells of branch k; the velocities of its nodes (cusps, q = 0) go to the list. */
static size_t make_cells(cell *out, size_t n, const ref_dtrack *t, int k, list *found)
{
    double last = exp(grid_log_min), value[2] = {node_value(t, k, CUSP, last), node_value(t, k, TURN, last)};
    for (int i = 1; i < GRID_SIZE && n + 3 < CELLS; i++) {
        double p = exp(grid_log_min + grid_step * i), cut[2] = {p, p};
        for (int what = CUSP; what <= TURN; what++) {
            double next = node_value(t, k, (node)what, p);
            if (value[what] * next < 0)
                cut[what] = find_node(t, k, (node)what, last, p);
            value[what] = next;
        }
        double ends[] = {fmin(cut[0], cut[1]), fmax(cut[0], cut[1]), p};
        for (int j = 0; j < 3; j++) {
            if (!(ends[j] > last))
                continue;
            n = add_cell(out, n, t, k, last, ends[j]);
            if (j < 2 && ends[j] < p)
                add(found, out[n - 1].alpha[1]);
            last = ends[j];
        }
    }
    return n;
}

/* q of the point of a monotone cell that has this alpha. */
static double cell_at(const cell *c, const ref_dtrack *t, double alpha)
{
    cell x = *c;
    int rising = c->alpha[1] > c->alpha[0];
    for (int i = 0; i < BISECTIONS; i++) {
        cell mid = {.k = c->k};
        set_end(&mid, 0, t, 0.5 * (x.p[0] + x.p[1]));
        int end = (mid.alpha[0] < alpha) != rising;
        x.p[end] = mid.p[0];
        x.q[end] = mid.q[0];
    }
    return 0.5 * (x.q[0] + x.q[1]);
}

/* The velocity where the curves of two cells cross, if they do. */
static void find_crossing(list *found, const cell *a, const cell *b, const ref_dtrack *t)
{
    double lo = fmax(fmin(a->alpha[0], a->alpha[1]), fmin(b->alpha[0], b->alpha[1]));
    double hi = fmin(fmax(a->alpha[0], a->alpha[1]), fmax(b->alpha[0], b->alpha[1]));
    double at_lo = cell_at(a, t, lo) - cell_at(b, t, lo), at_hi = cell_at(a, t, hi) - cell_at(b, t, hi);
    if (!(at_lo * at_hi < 0))
        return;
    for (int i = 0; i < BISECTIONS; i++) {
        double mid = 0.5 * (lo + hi);
        if ((cell_at(a, t, mid) - cell_at(b, t, mid)) * at_lo > 0)
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
