#include "dgreen/transitions_branch.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/branch_points_hunt.h"
#include "dgreen/crossing_follow.h"

enum { MAX_SAMPLES = 64 };
/* x(alpha) counts as smooth between two samples when the trapezoidal rule on its slopes misses the change by
 * less than this part of the change, or of x itself. */
static const double CHANGE_TOLERANCE = 0.25, X_TOLERANCE = 0.02;

typedef struct {
    dg_sweep *sweep;
    size_t count;
    dg_followed samples[MAX_SAMPLES];
    dg_station station; /* of the crossing that was looked for last */
    int points_alike;   /* the same branch points at both ends, so that positions compare */
    double x;           /* of the mass ratio that is hunted */
    size_t mass;
} branch;

static cv_status follow(dg_followed *m, branch *b, const dg_followed *l, const dg_followed *r)
{
    return dg_crossing_between(m, &b->station, &b->sweep->probe, l, r, b->points_alike, b->sweep->why);
}

static int smooth(const dg_followed *l, const dg_followed *r)
{
    const double change = r->at.x - l->at.x, trapezoid = (r->alpha - l->alpha) * (l->at.dx + r->at.dx) / 2;
    return fabs(change - trapezoid) <=
           CHANGE_TOLERANCE * fabs(change) + X_TOLERANCE * fmin(fabs(l->at.x), fabs(r->at.x));
}

/* Appends what lies between the last sample and r, and r itself. */
static cv_status sample_until(branch *b, const dg_followed *r)
{
    const dg_followed l = b->samples[b->count - 1];
    if (!smooth(&l, r)) {
        dg_followed middle = {.alpha = l.alpha + (r->alpha - l.alpha) / 2};
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
static cv_status crossing_at(dg_followed *m, branch *b)
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
    dg_followed m = {.alpha = s->at};
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
    dg_followed m = {.alpha = zero.at};
    if (status == CV_OK)
        status = crossing_at(&m, b);
    if (status != CV_OK)
        return status;
    const int rises = high->value >= 0; /* the crossing moves beyond 1/eta_M */
    const double special = dg_special_distance(b->sweep->probe.branches, m.alpha);
    const double reach = fmin(fmax(special, DBL_EPSILON * m.alpha), fabs(m.at.x / m.at.dx));
    const int change = (rises ? 2 : -2) * m.at.direction;
    const dg_find find = {m.alpha, m.at.q, m.at.dq, m.at.dx, m.at.scale, reach, change, 0};
    return dg_sweep_add(b->sweep, b->mass, &find);
}

static cv_status hunt_mass(branch *b)
{
    const dg_hunter h = {excess, found, b};
    cv_status status = CV_OK;
    for (size_t i = 0; i + 1 < b->count && status == CV_OK; i++) {
        const dg_followed *l = &b->samples[i], *r = l + 1;
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
    br->samples[0] = (dg_followed){left->at.alpha, *a};
    br->points_alike = left->at.hard_count == right->at.hard_count;
    const dg_followed last = {right->at.alpha, *b};
    cv_status status = sample_until(br, &last);
    for (br->mass = 0; br->mass < s->mass_count && status == CV_OK; br->mass++) {
        br->x = s->masses[br->mass].x;
        status = hunt_mass(br);
    }
    dg_station_clear(&br->station);
    free(br);
    return status;
}
