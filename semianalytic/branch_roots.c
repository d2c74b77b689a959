/* Roots over p of the functions of the branches declared in branch_grid.h. */
#include "semianalytic/branch_grid.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

typedef struct {
    long double p, value, slope;
} sample;

typedef struct {
    const sa_branch_grid *grid;
    const sa_branch_function *function;
    long double *root;
    size_t count, room;
} collector;

static sample from_waves(const sa_branch_function *f, const sa_wave *k, const sa_wave *l)
{
    if (f->kind == 1) {
        return (sample){k->p, k->d[2], k->d[3]};
    }
    long double sign = f->sign;
    return (sample){k->p, k->d[1] - sign * l->d[1], k->d[2] - sign * l->d[2]};
}

static cv_status sample_at(sample *out, const collector *c, long double p, size_t near)
{
    const sa_branch_node *node = &c->grid->node[near];
    sa_wave k, l;
    cv_status status =
        sa_dispersion_wave(&k, &c->grid->track, c->function->k, p, node->wave[c->function->k].omega);

    l = k;
    if (status == CV_OK && c->function->kind == 2) {
        status = sa_dispersion_wave(&l, &c->grid->track, c->function->l, p, node->wave[c->function->l].omega);
    }
    *out = from_waves(c->function, &k, &l);
    return status;
}

static cv_status keep(collector *c, long double p)
{
    if (c->count == c->room) {
        size_t room = c->room ? 2 * c->room : 16;
        long double *larger = realloc(c->root, room * sizeof *larger);
        if (!larger) {
            return CV_FAILED;
        }
        c->root = larger;
        c->room = room;
    }
    c->root[c->count++] = p;
    return CV_OK;
}

/* The root between two samples of opposite sign: Newton, bisection where it leaves the bracket. */
static cv_status bracketed(collector *c, sample a, sample b, size_t near)
{
    int rising = a.value < 0;
    sample s = fabsl(a.value) < fabsl(b.value) ? a : b;

    for (int i = 0; i < 200; i++) {
        long double next = s.p - s.value / s.slope;
        if (!(next > a.p && next < b.p)) {
            next = a.p + (b.p - a.p) / 2;
        }
        if (fabsl(next - s.p) <= 2 * LDBL_EPSILON * s.p || b.p - a.p <= 2 * LDBL_EPSILON * b.p) {
            break;
        }
        cv_status status = sample_at(&s, c, next, near);
        if (status != CV_OK) {
            return status;
        }
        if ((s.value < 0) == rising) {
            a = s;
        } else {
            b = s;
        }
    }
    return keep(c, s.p);
}

/* Both samples on one side, sloping towards zero from both ends: a pair of roots shows at the extremum. */
static cv_status hidden_pair(collector *c, sample a, sample b, size_t near)
{
    int positive = a.value > 0;
    sample low = a, high = b, mid = a;

    for (int i = 0; i < 80 && high.p - low.p > 4 * LDBL_EPSILON * high.p; i++) {
        cv_status status = sample_at(&mid, c, low.p + (high.p - low.p) / 2, near);
        if (status != CV_OK) {
            return status;
        }
        if ((mid.value > 0) != positive) {
            status = bracketed(c, a, mid, near);
            return status == CV_OK ? bracketed(c, mid, b, near) : status;
        }
        if ((mid.slope < 0) == positive) {
            low = mid;
        } else {
            high = mid;
        }
    }
    return CV_OK;
}

cv_status sa_branch_grid_roots(long double **out, size_t *count, const sa_branch_grid *grid,
                               const sa_branch_function *function)
{
    collector c = {.grid = grid, .function = function};
    cv_status status = CV_OK;
    const sa_branch_node *node = grid->node;

    /* the odd functions vanish at p = 0; the first interval starts where they do not */
    for (size_t i = 1; i + 1 < grid->count && status == CV_OK; i++) {
        sample a = from_waves(function, &node[i].wave[function->k], &node[i].wave[function->l]);
        sample b = from_waves(function, &node[i + 1].wave[function->k], &node[i + 1].wave[function->l]);
        int positive = a.value > 0;
        if (a.value == 0) {
            status = keep(&c, a.p);
        } else if (b.value != 0 && (b.value > 0) != positive) {
            status = bracketed(&c, a, b, i);
        } else if ((a.slope < 0) == positive && (b.slope > 0) == positive) {
            status = hidden_pair(&c, a, b, i);
        }
    }
    if (status != CV_OK) {
        free(c.root);
        c = (collector){.count = 0};
    }
    *out = c.root;
    *count = c.count;
    return status;
}
