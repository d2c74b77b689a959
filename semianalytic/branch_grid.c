#include "semianalytic/branch_grid.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NODES = 1000000, MAX_DEPTH = 80 };

static cv_status node_set(sa_branch_node *node, const sa_dispersion *track, long double p,
                          const sa_branch_node *near)
{
    node->p = p;
    for (int k = 0; k < SA_BRANCHES; k++) {
        long double guess = 0;
        if (near) {
            const long double *d = near->wave[k].d;
            long double h = p - near->p;
            guess = d[0] + h * (d[1] + h * d[2] / 2);
        }
        cv_status status = sa_dispersion_wave(&node->wave[k], track, k, p, guess);
        if (status != CV_OK) {
            return status;
        }
    }
    return CV_OK;
}

static cv_status push(sa_branch_grid *grid, const sa_branch_node *node)
{
    if (grid->count == grid->room) {
        size_t room = grid->room ? 2 * grid->room : 256;
        sa_branch_node *larger = realloc(grid->node, room * sizeof *larger);
        if (!larger || room > MAX_NODES) {
            grid->node = larger ? larger : grid->node;
            return CV_FAILED;
        }
        grid->node = larger;
        grid->room = room;
    }
    grid->node[grid->count++] = *node;
    return CV_OK;
}

/* Largest change that a Taylor polynomial of third order allows over h. */
static long double reach(const long double a[4], const long double b[4], long double h)
{
    return h * (fabsl(a[1] - b[1]) + h * (fabsl(a[2] - b[2]) / 2 + h * fabsl(a[3] - b[3]) / 6));
}

/* Branch points of omega_k(p) lie where omega_k = omega_j or omega_k = 0: the spacing must not reach half-way
 * to any, seen from this end. */
static int is_regular(const sa_branch_node *end, long double h)
{
    const long double zero[4] = {0};

    for (int k = 0; k < SA_BRANCHES; k++) {
        const long double *below = k > 0 ? end->wave[k - 1].d : zero;
        const long double *here = end->wave[k].d;
        if (!(reach(here, below, h) <= (here[0] - below[0]) / 2) || !(reach(here, zero, h) <= here[0] / 2)) {
            return 0;
        }
    }
    return 1;
}

/* omega'' at the middle against the cubic Hermite interpolant of omega'', omega''' at the ends. */
static int is_resolved(const sa_branch_node *a, const sa_branch_node *mid, const sa_branch_node *b)
{
    long double h = b->p - a->p;
    long double t = (mid->p - a->p) / h;

    for (int k = 0; k < SA_BRANCHES; k++) {
        const long double *da = a->wave[k].d, *db = b->wave[k].d;
        long double cubic = (1 - t) * (1 - t) * ((1 + 2 * t) * da[2] + t * h * da[3]) +
                            t * t * ((3 - 2 * t) * db[2] - (1 - t) * h * db[3]);
        long double size = fmaxl(fabsl(da[2]), fabsl(db[2]));
        long double noise = LDBL_EPSILON * 1e4L * mid->wave[k].omega / (mid->p * mid->p);
        if (!(fabsl(cubic - mid->wave[k].d[2]) <= size / 50 + noise)) {
            return 0;
        }
    }
    return 1;
}

/* Appends the nodes of (a, b]. */
static cv_status refine(sa_branch_grid *grid, const sa_branch_node *a, const sa_branch_node *b, int depth)
{
    long double h = b->p - a->p;
    sa_branch_node mid;
    cv_status status = node_set(&mid, &grid->track, b->p > 4 * a->p ? b->p / 2 : a->p + h / 2, a);

    if (status != CV_OK) {
        return status;
    }
    if (depth >= MAX_DEPTH || h <= 1e4L * LDBL_EPSILON * b->p ||
        (is_regular(a, h) && is_regular(b, h) && is_resolved(a, &mid, b))) {
        status = push(grid, &mid);
        return status == CV_OK ? push(grid, b) : status;
    }
    status = refine(grid, a, &mid, depth + 1);
    return status == CV_OK ? refine(grid, &mid, b, depth + 1) : status;
}

/* The bounds of the header on the tails, from the eigenvector components that couple a flat branch to the
 * rail (v_1 <= b_1 / (a_1 - L)) and to a stiff ballast (v_3 <= b_2 / (a_3 - L)); a_i, b_i are the entries of
 * M^(-1/2) K M^(-1/2). Each decreases with p from where the conditions before it hold. */
static int is_asymptotic(const sa_branch_node *node, const sa_dispersion *t, double alpha_min,
                         double alpha_max)
{
    long double p = node->p, x = p * p;
    long double a1 = x * (x / 4 - t->eta_N), a2 = (t->kappa_p + t->kappa_b) / t->mu_s;
    long double shear = t->eta_s * x / t->mu_b, m2 = (t->kappa_b + 1) / t->mu_b;
    long double b1_2 = t->kappa_p * t->kappa_p / t->mu_s,
                b2_2 = t->kappa_b * t->kappa_b / (t->mu_s * t->mu_b);

    if (!(a1 > 16 * (a2 + shear + m2 + t->kappa_p) && x > 16 * fabsl(t->eta_N) &&
          node->wave[2].d[1] > alpha_max)) {
        return 0;
    }
    long double slope = p * x * b1_2 / (a1 * a1 / 4);
    if (t->eta_s > 0) {
        if (!(shear > 16 * (a2 + m2) && shear * m2 > 256 * b2_2)) {
            return 0;
        }
        slope += 2 * shear / p * b2_2 / (shear * shear / 4);
    }
    return slope < 2 * node->wave[0].omega * alpha_min;
}

cv_status sa_branch_grid_build(sa_branch_grid *grid, const sa_dispersion *track, double alpha_min,
                               double alpha_max, cv_message *why)
{
    sa_branch_node last, next;

    memset(grid, 0, sizeof *grid);
    grid->track = *track;
    cv_status status = node_set(&last, track, 0, NULL);
    if (status == CV_OK) {
        status = push(grid, &last);
    }
    for (long double p = 0x1p-10L; status == CV_OK; p *= 2) {
        status = p < 1e12L ? node_set(&next, track, p, NULL) : CV_FAILED;
        if (status == CV_OK) {
            status = refine(grid, &last, &next, 0);
        }
        last = next;
        if (status == CV_OK && is_asymptotic(&last, track, alpha_min, alpha_max)) {
            return CV_OK;
        }
    }
    sa_branch_grid_clear(grid);
    return cv_fail(why, status, "the dispersion branches cannot be followed for this track");
}

void sa_branch_grid_clear(sa_branch_grid *grid)
{
    free(grid->node);
    memset(grid, 0, sizeof *grid);
}
