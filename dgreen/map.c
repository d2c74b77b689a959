#include "dgreen/map.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/path.h"

/* The curve is listed down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.3;

typedef struct {
    dg_map_cell *cells;
    int *found; /* pairs of roots followed into each cell */
    size_t count;
    const double *mass_ratios;
} row;

static void enter(row *r, size_t i, double complex qbar)
{
    dg_map_cell *cell = &r->cells[i];
    r->found[i]++;
    if (creal(qbar) > cell->growth) {
        cell->growth = creal(qbar);
        cell->frequency = cimag(qbar);
    }
}

/* Follows the root that enters at this crossing through all greater mass ratios until it leaves the right
 * half-plane; should it come back, another crossing says so. */
static void follow(row *r, const dg_probe *probe, const dg_curve *curve, const dg_crossing *crossing)
{
    dg_path path;
    if (dg_path_enter(&path, probe, curve, crossing) != CV_OK)
        return;
    for (size_t i = 0; i < r->count; i++) {
        const double x = 1 / r->mass_ratios[i];
        if (x >= crossing->x)
            continue;
        if (dg_path_go(&path, x) != CV_OK || !(creal(path.at.qbar) > 0))
            return;
        enter(r, i, path.at.qbar);
    }
}

static void count_cells(row *r, dg_sampler *s)
{
    for (size_t i = 0; i < r->count; i++)
        if (dg_sampler_count(&r->cells[i].count, s, 1 / r->mass_ratios[i], NULL) != CV_OK)
            r->cells[i].count = -1;
}

/* A growth rate counts only when it is the greatest of all roots there are. */
static void compare_counts(row *r)
{
    for (size_t i = 0; i < r->count; i++)
        if (2 * r->found[i] != r->cells[i].count)
            r->cells[i].growth = r->cells[i].frequency = NAN;
}

cv_status dg_map_row(dg_map_cell *cells, dg_sampler *s, double alpha, size_t mass_count,
                     const double *mass_ratios, cv_message *why)
{
    row r = {cells, calloc(mass_count, sizeof *r.found), mass_count, mass_ratios};
    if (r.found == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < mass_count; i++)
        cells[i] = (dg_map_cell){-1, 0, 0};
    const cv_status status = dg_sampler_curve(s, alpha, FLOOR / mass_ratios[mass_count - 1], why);
    if (status == CV_OK) {
        const dg_probe probe = dg_sampler_probe(s);
        count_cells(&r, s);
        for (size_t i = 0; i < s->curve.crossing_count; i++)
            if (s->curve.crossings[i].direction > 0)
                follow(&r, &probe, &s->curve, &s->curve.crossings[i]);
    }
    compare_counts(&r);
    free(r.found);
    return status;
}
