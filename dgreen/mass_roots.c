#include "dgreen/mass_roots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/mass_roots_refine.h"
#include "dgreen/path.h"

/* The curve is listed down to this part of 1/eta_M. */
static const double FLOOR = 0.1;
/* Roots closer than this, relative to their modulus, are one root found twice. */
static const double SAME = 1e-7;

typedef struct {
    dg_continued at;
    double complex slope;
} candidate;

typedef struct {
    dg_sampler *sampler;
    dg_probe probe;
    double x; /* 1/eta_M */
    size_t count, room;
    candidate *items;
} search;

static int unstable_pairs(const search *s)
{
    int pairs = 0;
    for (size_t i = 0; i < s->count; i++)
        pairs += creal(s->items[i].at.qbar) > 0;
    return pairs;
}

static int is_known(const search *s, double complex qbar)
{
    for (size_t i = 0; i < s->count; i++)
        if (cabs(s->items[i].at.qbar - qbar) <= SAME * cabs(qbar))
            return 1;
    return 0;
}

static cv_status push(search *s, const candidate *c, cv_message *why)
{
    if (s->count == s->room) {
        const size_t room = s->room ? 2 * s->room : 16;
        candidate *grown = realloc(s->items, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        s->items = grown;
        s->room = room;
    }
    s->items[s->count++] = *c;
    return CV_OK;
}

/* Whether the root belongs to zeta continued from the axis along Im qbar = const; c then holds the roots
 * lambda that way. */
static int is_straight_left(candidate *c, const search *s, double complex qbar)
{
    static const double TOLERANCE = 1e-6, ASIDE = 1e-3;
    const dg_station *station = &s->sampler->curve.at;
    const double q = cimag(qbar), room = dg_path_room(station, qbar);
    if (dg_continued_start(&c->at, s->probe.follow, s->probe.track, station->alpha, q,
                           ASIDE * dg_station_scale(station, q)) != CV_OK ||
        dg_continued_move(&c->at, qbar) != CV_OK || dg_continued_slope(&c->slope, &c->at, room) != CV_OK)
        return 0;
    const double complex off = (dg_continued_zeta(&c->at) - s->x) / c->slope;
    return cabs(off) <= TOLERANCE * room;
}

/* Follows the path to x and keeps what it finds there; a path that fails finds nothing. */
static cv_status follow(search *s, dg_path *path, cv_message *why)
{
    candidate c;
    if (dg_path_go(path, s->x) != CV_OK)
        return CV_OK;
    const double complex qbar = path->at.qbar;
    if (!(cimag(qbar) > 0) || is_known(s, qbar) || !is_straight_left(&c, s, qbar))
        return CV_OK;
    return push(s, &c, why);
}

static cv_status from_crossings(search *s, cv_message *why)
{
    const dg_curve *curve = &s->sampler->curve;
    cv_status status = CV_OK;
    for (size_t i = 0; i < curve->crossing_count && status == CV_OK; i++) {
        dg_path path;
        if (dg_path_enter(&path, &s->probe, curve, &curve->crossings[i]) == CV_OK)
            status = follow(s, &path, why);
    }
    return status;
}

/* First-order distance in q from a node to the root */
static double distance(const search *s, size_t i)
{
    const dg_node *n = &s->sampler->curve.nodes[i];
    const double complex change = CMPLX(n[1].re - n->re, n[1].im - n->im);
    return cabs(CMPLX(n->re - s->x, n->im)) * (n[1].q - n->q) / cabs(change);
}

/* From the nodes nearest to a root, or from all */
static cv_status from_nodes(search *s, int all, cv_message *why)
{
    const dg_curve *curve = &s->sampler->curve;
    cv_status status = CV_OK;
    for (size_t i = 1; i + 2 < curve->node_count && status == CV_OK; i++) {
        const double here = distance(s, i);
        dg_path path;
        if (!all && !(here <= distance(s, i - 1) && here <= distance(s, i + 1)))
            continue;
        if (dg_path_start(&path, &s->probe, &curve->at, curve->nodes[i].q) == CV_OK)
            status = follow(s, &path, why);
    }
    return status;
}

static int descending(const void *a, const void *b)
{
    const double x = creal(((const candidate *)a)->at.qbar), y = creal(((const candidate *)b)->at.qbar);
    return (x < y) - (x > y);
}

static cv_status find(int *unstable, search *s, double alpha, cv_message *why)
{
    cv_status status = dg_sampler_curve(s->sampler, alpha, FLOOR * s->x, why);
    if (status == CV_OK)
        status = dg_sampler_count(unstable, s->sampler, s->x, why);
    if (status == CV_OK)
        status = from_crossings(s, why);
    if (status == CV_OK)
        status = from_nodes(s, 0, why);
    if (status == CV_OK && 2 * unstable_pairs(s) != *unstable)
        status = from_nodes(s, 1, why);
    if (status == CV_OK && 2 * unstable_pairs(s) != *unstable)
        return cv_fail(why, CV_UNDECIDED, "%d unstable roots by the argument principle, %d found", *unstable,
                       2 * unstable_pairs(s));
    if (s->count > 0)
        qsort(s->items, s->count, sizeof *s->items, descending);
    return status;
}

static cv_status refine(dg_mass_roots *out, const search *s, const cv_number *alpha,
                        const cv_number *mass_ratio, int digits, cv_message *why)
{
    out->items = calloc(s->count + 1, sizeof *out->items);
    if (out->items == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = CV_OK;
    int pairs = 0;
    for (size_t i = 0; i < s->count && status == CV_OK; i++) {
        dg_mass_root *root = &out->items[out->count++];
        status =
            dg_mass_root_refine(root, &s->items[i].at, s->items[i].slope, alpha, mass_ratio, digits, why);
        pairs += mpfr_sgn(root->re) > 0;
    }
    if (status == CV_OK && 2 * pairs != out->unstable_count)
        return cv_fail(why, CV_UNDECIDED, "a root on the stability boundary");
    return status;
}

cv_status dg_find_mass_roots(dg_mass_roots *out, dg_sampler *sampler, const cv_number *alpha,
                             const cv_number *mass_ratio, int digits, cv_message *why)
{
    search s = {sampler, dg_sampler_probe(sampler), 1 / cv_number_get_double(mass_ratio), 0, 0, NULL};
    *out = (dg_mass_roots){0};
    cv_status status = find(&out->unstable_count, &s, cv_number_get_double(alpha), why);
    if (status == CV_OK)
        status = refine(out, &s, alpha, mass_ratio, digits, why);
    if (status != CV_OK)
        dg_mass_roots_clear(out);
    free(s.items);
    return status;
}

void dg_mass_roots_clear(dg_mass_roots *roots)
{
    for (size_t i = 0; i < roots->count; i++)
        mpfr_clears(roots->items[i].re, roots->items[i].im, (mpfr_ptr)0);
    free(roots->items);
    *roots = (dg_mass_roots){0};
}
