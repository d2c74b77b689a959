/* Special velocities of an undamped track as transitions: where branch curves meet, end or reach q = 0, the
 * crossings of zeta(iq) at infinity change their number or order, and N with them for a whole range of mass
 * ratios. In the (eta_M, alpha) plane the lines have vertical parts there. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "semianalytic/crossings.h"
#include "semianalytic/matrix.h"
#include "semianalytic/resonances.h"
#include "semianalytic/transitions_parts.h"

/* N at one end of a closed column, and how near, relatively, a line passes 1 / eta_M there. */
typedef struct {
    int roots;
    double nearest;
} side;

static cv_status count_at(side *out, const sa_map *map, sa_field *field, double alpha, double level)
{
    sa_crossings crossings;
    cv_status status = sa_crossings_find(&crossings, map, field, alpha, level / 2, NULL);
    if (status == CV_OK)
        status = sa_crossings_count(&out->roots, &crossings, level);
    for (size_t i = 0; i < crossings.count; ++i)
        out->nearest = fmin(out->nearest, fabs(crossings.items[i].re / level - 1));
    sa_crossings_clear(&crossings);
    return status;
}

/* A resonance velocity to the digits, proven; q = 0 is exact there. */
static cv_status refine_resonance(sa_transition *t, const sa_track *track, int digits)
{
    sa_resonance_list list;
    cv_status status = sa_resonances(&list, &track->exact, digits + 1, NULL);
    if (status != CV_OK)
        return status;
    for (size_t i = 0; i < list.count; ++i) {
        const sa_resonance *r = &list.item[i];
        double alpha = mpfr_get_d(r->alpha, MPFR_RNDN);
        if (!(fabs(alpha - mpfr_get_d(t->alpha, MPFR_RNDN)) < 1e-13 * alpha))
            continue;
        mpfr_set_prec(t->alpha, mpfr_get_prec(r->alpha));
        mpfr_set(t->alpha, r->alpha, MPFR_RNDN);
        t->alpha_error = ldexp(alpha, -(int)r->bits);
        t->q_error = 0;
        break;
    }
    sa_resonances_clear(&list);
    return CV_OK;
}

/* The special velocity, or where there is none or several, or where a line passes 1 / eta_M so nearly that it
 * may do so inside, anywhere in the column. */
static cv_status append(sa_transitions *list, const sa_track *track, const sa_map *map, const sa_column *c,
                        int step, int certain, int digits)
{
    sa_transition *t = &list->items[list->count++];
    cv_status status = CV_OK;
    double width = c->alpha_high - c->alpha_low;
    mpfr_inits2(53, t->alpha, t->q, (mpfr_ptr)0);
    mpfr_set_d(t->alpha, c->alpha_low + width / 2, MPFR_RNDN);
    mpfr_set_zero(t->q, 1);
    t->alpha_error = width;
    t->q_error = INFINITY;
    if (c->special >= 0 && certain) {
        const sa_special *special = &map->curves.special[c->special];
        mpfr_set_d(t->alpha, special->alpha, MPFR_RNDN);
        mpfr_set_d(t->q, special->q, MPFR_RNDN);
        t->alpha_error = 4e-15 * special->alpha;
        t->q_error = 4e-15 * (1 + special->q);
        if (special->kind == SA_SPECIAL_RESONANCE)
            status = refine_resonance(t, track, digits);
    }
    t->above = step;
    t->decided = t->alpha_error < pow(10, -digits) * mpfr_get_d(t->alpha, MPFR_RNDN) ? CV_OK : CV_UNDECIDED;
    return status;
}

void sa_transitions_explain_limit(sa_transitions *list)
{
    size_t used = strlen(list->reason.text), room = sizeof list->reason.text - used;
    if (list->decided != CV_OK &&
        snprintf(list->reason.text + used, room,
                 "; without damping, lines nearer than 1e-12 to a branch curve are counted, not traced") < 0)
        list->reason.text[used] = '\0';
}

/* Counts at alpha[0] and alpha[1] on both sides of c; a transition where they differ. */
static cv_status jump(sa_transitions *list, const sa_track *track, const sa_map *map, sa_field *field,
                      const sa_column *c, const double alpha[2], double level, int digits)
{
    const double near = 1e-3; /* much more than Re zeta varies along a line in a closed column */
    side below = {0, INFINITY}, above = {0, INFINITY};
    cv_status status = count_at(&below, map, field, alpha[0], level);
    if (status == CV_OK)
        status = count_at(&above, map, field, alpha[1], level);
    if (status == CV_UNDECIDED)
        sa_transitions_doubt(list, "unstable roots could not be counted beside alpha = %.15g", alpha[0]);
    else if (status == CV_OK && above.roots != below.roots)
        status = append(list, track, map, c, above.roots - below.roots,
                        fmin(below.nearest, above.nearest) > near, digits);
    return status == CV_UNDECIDED ? CV_OK : status;
}

/* The shear speed, where an arc ends in q = 0, is in no closed column: zeta is smooth there. */
static cv_status shear_jump(sa_transitions *list, const sa_track *track, const sa_map *map, sa_field *field,
                            int number, double level, int digits)
{
    const double beside = 1e-9, speed = map->curves.special[number].alpha;
    const double alpha[2] = {speed * (1 - beside), speed * (1 + beside)};
    const sa_column c = {.alpha_low = alpha[0], .alpha_high = alpha[1], .special = number};
    if (!(alpha[0] > map->curves.alpha_min && alpha[1] < map->curves.alpha_max))
        return CV_OK;
    return jump(list, track, map, field, &c, alpha, level, digits);
}

cv_status sa_transitions_jumps(sa_transitions *list, const sa_track *track, const sa_map *map,
                               sa_field *field, double level, int digits)
{
    cv_status status = CV_OK;
    for (size_t i = 1; i + 1 < map->count && status == CV_OK; ++i) {
        const sa_column *c = &map->column[i];
        const double alpha[2] = {c->alpha_low - c[-1].length_high / 10, c->alpha_high + c[1].length_low / 10};
        if (c->closed)
            status = jump(list, track, map, field, c, alpha, level, digits);
    }
    for (size_t i = 0; i < map->curves.special_count && status == CV_OK; ++i)
        if (map->curves.special[i].kind == SA_SPECIAL_SHEAR)
            status = shear_jump(list, track, map, field, (int)i, level, digits);
    return status;
}
