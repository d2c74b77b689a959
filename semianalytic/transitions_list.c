#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "semianalytic/crossings.h"
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
                                  const sa_candidates *found, size_t level, const cv_number *mass_ratio,
                                  int digits)
{
    list->items = calloc(found->count + 1, sizeof *list->items);
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
    qsort(list->items, list->count, sizeof *list->items, by_alpha);
    join_equal(list);
    number_roots(list);
    return CV_OK;
}

/* N at a velocity between low and high; another one when the first is too near a transition. */
static cv_status count_between(int *roots, double *where, const sa_map *map, sa_field *field, double low,
                               double high, double level)
{
    static const double fractions[] = {0.5, 0.4375, 0.59375, 0.3125, 0.71875};
    cv_status status = CV_UNDECIDED;
    for (int i = 0; i < 5 && status == CV_UNDECIDED; ++i) {
        sa_crossings crossings;
        *where = low + fractions[i] * (high - low);
        status = sa_crossings_find(&crossings, map, field, *where, level / 2, NULL);
        if (status == CV_OK)
            status = sa_crossings_count(roots, &crossings, level);
        sa_crossings_clear(&crossings);
    }
    return status;
}

cv_status sa_transitions_verify(sa_transitions *list, const sa_map *map, sa_field *field, double level)
{
    for (size_t i = 0; i <= list->count; ++i) {
        const sa_transition *left = i > 0 ? &list->items[i - 1] : NULL;
        const sa_transition *right = i < list->count ? &list->items[i] : NULL;
        double low = left != NULL ? mpfr_get_d(left->alpha, MPFR_RNDU) : map->curves.alpha_min;
        double high = right != NULL ? mpfr_get_d(right->alpha, MPFR_RNDD) : map->curves.alpha_max;
        int expected = left != NULL ? left->above : list->roots_at_start, roots = 0;
        double where = low;
        if (!(high - low > 8e-16 * high))
            continue;
        cv_status status = count_between(&roots, &where, map, field, low, high, level);
        if (status == CV_UNDECIDED)
            sa_transitions_doubt(list, "unstable roots could not be counted near alpha = %.15g", where);
        else if (status != CV_OK)
            return status;
        else if (roots != expected)
            sa_transitions_doubt(list,
                                 "%d unstable roots at alpha = %.15g by crossings, %d by the transitions",
                                 roots, where, expected);
    }
    return CV_OK;
}
