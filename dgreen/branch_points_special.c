#include <math.h>
#include <stdlib.h>

#include "dgreen/branch_points_curves.h"
#include "dgreen/branch_points_hunt.h"

/* Points of the first look at a pair of families, dense towards both ends, where a family may have a cusp. */
enum { LOOKS = 48 };
static const double PI = 3.14159265358979323846;
/* Distance from the ends of a family, relative, at which its branch points are still well defined */
static const double END = 1e-13;

typedef struct {
    dg_branch_curves *b;
    size_t one, other; /* families; equal: the event is q_b = 0 */
    double sign;       /* +1: q_one = q_other; -1: q_one = -q_other */
    cv_message *why;
} meeting;

static cv_status add(dg_branch_curves *b, double alpha, double width, cv_message *why)
{
    if (b->special_count == b->special_room) {
        const size_t room = b->special_room ? 2 * b->special_room : 16;
        dg_special_velocity *grown = realloc(b->specials, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        b->specials = grown;
        b->special_room = room;
    }
    b->specials[b->special_count++] = (dg_special_velocity){alpha, fmax(width, 1e-15 * alpha)};
    return CV_OK;
}

static cv_status distance(dg_sample *s, void *context)
{
    const meeting *m = context;
    dg_branch_point one, other;
    dg_family_point(&one, m->b, m->one, s->at);
    s->value = one.signed_q;
    s->slope = one.p;
    s->aside = one.width;
    if (m->other != m->one) {
        dg_family_point(&other, m->b, m->other, s->at);
        s->value -= m->sign * other.signed_q;
        s->slope -= m->sign * other.p;
        s->aside += other.width;
    }
    return CV_OK;
}

static cv_status meet(const dg_sample *low, const dg_sample *high, void *context)
{
    const meeting *m = context;
    const dg_hunter h = {distance, NULL, context};
    dg_sample zero;
    const cv_status status = dg_hunt_refine(&zero, &h, low, high);
    return status == CV_OK ? add(m->b, zero.at, zero.aside / fabs(zero.slope), m->why) : status;
}

static cv_status find_meetings(meeting *m, double low, double high)
{
    const dg_hunter h = {distance, meet, m};
    dg_sample before = {.at = low}, here;
    cv_status status = distance(&before, m);
    for (int i = 1; i <= LOOKS && status == CV_OK; i++) {
        here.at = low + (high - low) * (1 - cos(PI * i / LOOKS)) / 2;
        status = distance(&here, m);
        if (status == CV_OK)
            status = dg_hunt_zeros(&h, &before, &here);
        if (status ==
            CV_UNDECIDED) /* the two curves touch: the place is special, whether or not they cross */
            status = add(m->b, here.at, here.at - before.at, m->why);
        before = here;
    }
    return status;
}

/* Two families that part at a cusp do not meet again: their distance has the slope p_one - p_other. */
static int parted_at_cusp(const meeting *m)
{
    const dg_family *f = &m->b->families[m->one], *g = &m->b->families[m->other];
    return m->one != m->other && m->sign > 0 && f->branch == g->branch && f->sign == g->sign &&
           (f->last == g->first || g->last == f->first);
}

static cv_status pair_events(meeting *m, double alpha_min, double alpha_max)
{
    const dg_family *f = &m->b->families[m->one], *g = &m->b->families[m->other];
    const double low = fmax(fmax(f->alpha_low, g->alpha_low) * (1 + END), alpha_min);
    const double high = fmin(fmin(f->alpha_high, g->alpha_high) * (1 - END), alpha_max);
    return low < high && !parted_at_cusp(m) ? find_meetings(m, low, high) : CV_OK;
}

/* Births of pairs: where two families end. */
static cv_status cusps(dg_branch_curves *b, cv_message *why)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < b->bend_count && status == CV_OK; i++) {
        const dg_bend *bend = &b->bends[i];
        if (!bend->cusp)
            continue;
        dg_wave w;
        dg_wave_at(&w, b->track, bend->p, bend->branch);
        status = add(b, fabs(bend->group), dg_wave_shift(b->track, bend->p, &w) / bend->p, why);
    }
    return status;
}

static int ascending(const void *a, const void *b)
{
    const double x = ((const dg_special_velocity *)a)->alpha, y = ((const dg_special_velocity *)b)->alpha;
    return (x > y) - (x < y);
}

/* Sorts, drops what is outside and what repeats its neighbour (two families meet at their common cusp). */
static void tidy(dg_branch_curves *b, double alpha_min, double alpha_max)
{
    size_t n = 0;
    qsort(b->specials, b->special_count, sizeof *b->specials, ascending);
    for (size_t i = 0; i < b->special_count; i++) {
        const dg_special_velocity s = b->specials[i];
        if (!(s.alpha > alpha_min && s.alpha < alpha_max))
            continue;
        if (n > 0 && s.alpha - b->specials[n - 1].alpha <= 1e-10 * s.alpha)
            b->specials[n - 1].width = fmin(b->specials[n - 1].width, s.width);
        else
            b->specials[n++] = s;
    }
    b->special_count = n;
}

cv_status dg_branch_curves_specials(dg_branch_curves *b, double alpha_min, double alpha_max, cv_message *why)
{
    cv_status status = cusps(b, why);
    for (size_t i = 0; i < b->family_count && status == CV_OK; i++) {
        meeting zero = {b, i, i, 1, why};
        status = pair_events(&zero, alpha_min, alpha_max);
        for (size_t j = i + 1; j < b->family_count && status == CV_OK; j++)
            for (double sign = 1; sign >= -1 && status == CV_OK; sign -= 2) {
                meeting m = {b, i, j, sign, why};
                status = pair_events(&m, alpha_min, alpha_max);
            }
    }
    const double drop = sqrt(b->track->eta_s / b->track->mu_b);
    if (status == CV_OK && drop > 0)
        status = add(b, drop, 1e-4 * drop, why);
    if (status == CV_OK && b->special_count > 0)
        tidy(b, alpha_min, alpha_max);
    return status;
}
