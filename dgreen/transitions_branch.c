#include "dgreen/transitions_branch.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/branch_points_hunt.h"

enum { MAX_SAMPLES = 64 };
/* x(alpha) counts as smooth between two samples when the trapezoidal rule on its slopes misses the change by
 * less than this part of the change, or of x itself. */
static const double CHANGE_TOLERANCE = 0.25, X_TOLERANCE = 0.02;
/* Search of a crossing near its expected position: first step and last distance */
static const double FIRST_STEP = 0.05, LAST_STEP = 8;

typedef struct {
    double alpha;
    dg_crossing at;
} sample;

typedef struct {
    dg_sweep *sweep;
    size_t count;
    sample samples[MAX_SAMPLES];
    dg_station station; /* of the crossing that was looked for last */
    int points_alike;   /* the same branch points at both ends, so that positions compare */
    double x;           /* of the mass ratio that is hunted */
    size_t mass;
} branch;

/* Where a crossing between samples l and r is expected: q for the position plus "step". */
static double expected(const branch *b, const sample *l, const sample *r, double step)
{
    const double part = (b->station.alpha - l->alpha) / (r->alpha - l->alpha);
    if (b->points_alike)
        return dg_station_frequency(&b->station,
                                    l->at.position + part * (r->at.position - l->at.position) + step);
    return exp(log(l->at.q) + part * log(r->at.q / l->at.q) + step);
}

/* The crossing at alpha between the samples l and r: from the expected place in the direction where its sign
 * change must be, with growing steps. */
static cv_status follow(sample *m, branch *b, const sample *l, const sample *r)
{
    const dg_probe *p = &b->sweep->probe;
    dg_node here, next;
    cv_status status = dg_station_set(&b->station, p->branches, m->alpha, b->sweep->why);
    if (status == CV_OK)
        status = dg_probe_at(&here, p, m->alpha, expected(b, l, r, 0));
    if (status != CV_OK)
        return status;
    const int up = (here.im > 0) == (l->at.direction > 0); /* the crossing lies above */
    for (double step = FIRST_STEP; step < LAST_STEP; step *= 2, here = next) {
        const double q = expected(b, l, r, up ? step : -step);
        next = here;
        if (q != here.q)
            status = dg_probe_at(&next, p, m->alpha, q);
        if (status != CV_OK)
            return status;
        if ((next.im > 0) != (here.im > 0))
            return dg_curve_cross(&m->at, p, &b->station, up ? &here : &next, up ? &next : &here);
    }
    return CV_UNDECIDED;
}

static int smooth(const sample *l, const sample *r)
{
    const double change = r->at.x - l->at.x, trapezoid = (r->alpha - l->alpha) * (l->at.dx + r->at.dx) / 2;
    return fabs(change - trapezoid) <=
           CHANGE_TOLERANCE * fabs(change) + X_TOLERANCE * fmin(fabs(l->at.x), fabs(r->at.x));
}

/* Appends what lies between the last sample and r, and r itself. */
static cv_status sample_until(branch *b, const sample *r)
{
    const sample l = b->samples[b->count - 1];
    if (!smooth(&l, r)) {
        sample middle = {.alpha = l.alpha + (r->alpha - l.alpha) / 2};
        if (b->count + 1 >= MAX_SAMPLES || !(r->alpha - l.alpha > 8 * DBL_EPSILON * r->alpha))
            return CV_UNDECIDED;
        cv_status status = follow(&middle, b, &l, r);
        if (status == CV_OK)
            status = sample_until(b, &middle);
        return status == CV_OK ? sample_until(b, r) : status;
    }
    if (b->count == MAX_SAMPLES)
        return CV_UNDECIDED;
    b->samples[b->count++] = *r;
    return CV_OK;
}

/* The crossing at any alpha between the first and the last sample */
static cv_status crossing_at(sample *m, branch *b)
{
    size_t i = 1;
    while (i + 1 < b->count && b->samples[i].alpha < m->alpha)
        i++;
    return follow(m, b, &b->samples[i - 1], &b->samples[i]);
}

/* x(alpha) - 1/eta_M for the hunt */
static cv_status excess(dg_sample *s, void *context)
{
    branch *b = context;
    sample m = {.alpha = s->at};
    const cv_status status = crossing_at(&m, b);
    s->value = m.at.x - b->x;
    s->slope = m.at.dx;
    return status;
}

static cv_status found(const dg_sample *low, const dg_sample *high, void *context)
{
    branch *b = context;
    const dg_hunter h = {excess, NULL, b};
    dg_sample zero;
    cv_status status = dg_hunt_refine(&zero, &h, low, high);
    sample m = {.alpha = zero.at};
    if (status == CV_OK)
        status = crossing_at(&m, b);
    if (status != CV_OK)
        return status;
    const int rises = high->value >= 0; /* the crossing moves beyond 1/eta_M */
    const double special = dg_special_distance(b->sweep->probe.branches, m.alpha);
    const double reach = fmin(fmax(special, DBL_EPSILON * m.alpha), fabs(m.at.x / m.at.dx));
    const int change = (rises ? 2 : -2) * m.at.direction;
    const dg_find find = {m.alpha, m.at.q, m.at.dq, m.at.dx, m.at.scale, reach, change};
    return dg_sweep_add(b->sweep, b->mass, &find);
}

static cv_status hunt_mass(branch *b)
{
    const dg_hunter h = {excess, found, b};
    cv_status status = CV_OK;
    for (size_t i = 0; i + 1 < b->count && status == CV_OK; i++) {
        const sample *l = &b->samples[i], *r = l + 1;
        const dg_sample low = {l->alpha, l->at.x - b->x, l->at.dx, 0};
        const dg_sample high = {r->alpha, r->at.x - b->x, r->at.dx, 0};
        status = dg_hunt_zeros(&h, &low, &high);
    }
    return status;
}

cv_status dg_branch_scan(dg_sweep *s, const dg_curve *left, const dg_crossing *a, const dg_curve *right,
                         const dg_crossing *b)
{
    if (fmin(a->x, b->x) > 10 * s->x_roof)
        return CV_OK;
    branch *br = calloc(1, sizeof *br);
    if (br == NULL)
        return cv_fail(s->why, CV_FAILED, "out of memory");
    br->sweep = s;
    br->count = 1;
    br->samples[0] = (sample){left->at.alpha, *a};
    br->points_alike = left->at.hard_count == right->at.hard_count;
    const sample last = {right->at.alpha, *b};
    cv_status status = sample_until(br, &last);
    for (br->mass = 0; br->mass < s->mass_count && status == CV_OK; br->mass++) {
        br->x = s->masses[br->mass].x;
        status = hunt_mass(br);
    }
    dg_station_clear(&br->station);
    free(br);
    return status;
}
