#include "dgreen/map.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/mass_roots_refine.h"
#include "dgreen/path.h"

/* The curve is listed down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.3;
/* Growth rates smaller than this part of the frequency are computed in MPFR, to so many digits. */
static const double DOUBTFUL = 1e-9;
enum { DIGITS = 9 };

typedef struct {
    dg_map_cell *cells;
    int *found; /* pairs of roots followed into each cell */
    size_t count;
    const double *mass_ratios;
} row;

static void enter(row *r, size_t i, double growth, double frequency)
{
    dg_map_cell *cell = &r->cells[i];
    r->found[i]++;
    if (growth > cell->growth) {
        cell->growth = growth;
        cell->frequency = frequency;
    }
}

/* Re qbar of a root so near the axis that double does not tell; NAN where that cannot be had. */
static double rate_from_digits(const dg_path *path, double x)
{
    double complex slope;
    dg_mass_root root;
    cv_number alpha, mass_ratio;
    if (dg_continued_slope(&slope, &path->at, dg_path_room(path->station, path->at.qbar)) != CV_OK)
        return NAN;
    cv_number_init(&alpha);
    cv_number_init(&mass_ratio);
    mpq_set_d(alpha.factor, path->at.alpha);
    mpq_set_d(mass_ratio.factor, x);
    mpq_inv(mass_ratio.factor, mass_ratio.factor);
    const cv_status status = dg_mass_root_refine(&root, &path->at, slope, &alpha, &mass_ratio, DIGITS, NULL);
    const double rate = status == CV_OK ? mpfr_get_d(root.re, MPFR_RNDN) : (double)NAN;
    mpfr_clears(root.re, root.im, (mpfr_ptr)0);
    cv_number_clear(&alpha);
    cv_number_clear(&mass_ratio);
    return rate;
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
        if (dg_path_go(&path, x) != CV_OK)
            return;
        double rate = creal(path.at.qbar);
        if (!(fabs(rate) > DOUBTFUL * cabs(path.at.qbar)))
            rate = rate_from_digits(&path, x);
        if (!(rate > 0))
            return;
        enter(r, i, rate, cimag(path.at.qbar));
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
