#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "semianalytic/transitions_parts.h"

void sa_transitions_doubt(sa_transitions *list, const char *format, ...)
{
    va_list args;
    if (list->decided != CV_OK)
        return;
    list->decided = CV_UNDECIDED;
    va_start(args, format);
    if (vsnprintf(list->reason.text, sizeof list->reason.text, format, args) < 0)
        list->reason.text[0] = '\0';
    va_end(args);
}

void sa_transitions_clear(sa_transitions *list)
{
    for (size_t i = 0; i < list->count; ++i)
        mpfr_clears(list->items[i].alpha, list->items[i].q, (mpfr_ptr)0);
    free(list->items);
    *list = (sa_transitions){0};
}

static int by_alpha(const void *left, const void *right)
{
    const sa_transition *a = left, *b = right;
    int c = mpfr_cmp(a->alpha, b->alpha);
    return c != 0 ? c : mpfr_cmp(a->q, b->q);
}

static int within(const mpfr_t a, const mpfr_t b, double bound)
{
    mpfr_t difference;
    mpfr_init2(difference, mpfr_get_prec(a));
    mpfr_sub(difference, a, b, MPFR_RNDA);
    int yes = mpfr_cmpabs(difference, a) < 0 && fabs(mpfr_get_d(difference, MPFR_RNDA)) <= bound;
    mpfr_clear(difference);
    return yes;
}

/* A line found in two neighbouring cells gives the same point twice. One that could not be refined has no
 * bounds and is joined to nothing. */
static void join_equal(sa_transitions *list)
{
    size_t kept = 0;
    for (size_t i = 0; i < list->count; ++i) {
        sa_transition *a = &list->items[i], *b = kept > 0 ? &list->items[kept - 1] : NULL;
        if (b != NULL && a->decided == CV_OK && b->decided == CV_OK &&
            within(a->alpha, b->alpha, a->alpha_error + b->alpha_error) &&
            within(a->q, b->q, a->q_error + b->q_error))
            mpfr_clears(a->alpha, a->q, (mpfr_ptr)0);
        else
            list->items[kept++] = *a;
    }
    list->count = kept;
}

static void number_roots(sa_transitions *list)
{
    int roots = list->roots_at_start;
    for (size_t i = 0; i < list->count; ++i) {
        sa_transition *t = &list->items[i];
        int step = t->above - t->below;
        t->below = roots;
        roots += step;
        t->above = roots;
        if (t->below < 0 || t->above < 0)
            sa_transitions_doubt(list, "a negative number of unstable roots at alpha = %.15g",
                                 mpfr_get_d(t->alpha, MPFR_RNDN));
        if (t->decided != CV_OK)
            sa_transitions_doubt(list, "a transition near alpha = %.15g could not be refined",
                                 mpfr_get_d(t->alpha, MPFR_RNDN));
    }
}

cv_status sa_transitions_assemble(sa_transitions *list, sa_sweep *sweep, const sa_track *track,
                                  const sa_map *map, sa_field *field, const sa_candidates *found,
                                  size_t level, const cv_number *mass_ratio, int digits)
{
    list->items = calloc(found->count + map->count + 1, sizeof *list->items);
    if (list->items == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < found->count; ++i) {
        const sa_candidate *c = &found->items[i];
        if (c->level != level)
            continue;
        sa_transition *t = &list->items[list->count++];
        cv_status status = sa_transition_refine(t, sweep, track, c, mass_ratio, digits);
        if (status != CV_OK)
            return status;
        t->above = sa_transition_step(c);
    }
    if (map->undamped) {
        cv_status status =
            sa_transitions_jumps(list, track, map, field, 1 / cv_number_get_double(mass_ratio), digits);
        if (status != CV_OK)
            return status;
    }
    qsort(list->items, list->count, sizeof *list->items, by_alpha);
    join_equal(list);
    number_roots(list);
    return CV_OK;
}
