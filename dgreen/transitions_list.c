#include "dgreen/transitions_list.h"

#include <stdlib.h>
#include <string.h>

#include "dgreen/transitions_refine.h"

void dg_transition_list_clear(dg_transition_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        mpfr_clears(list->items[i].alpha, list->items[i].frequency, (mpfr_ptr)NULL);
    free(list->items);
    memset(list, 0, sizeof *list);
}

static int ascending(const void *a, const void *b)
{
    return mpfr_cmp(((const dg_transition *)a)->alpha, ((const dg_transition *)b)->alpha);
}

static void doubt(dg_transition_list *list, const char *reason, mpfr_srcptr alpha)
{
    if (list->status == CV_OK)
        list->status =
            cv_fail(&list->why, CV_UNDECIDED, "%s near alpha = %.17g", reason, mpfr_get_d(alpha, MPFR_RNDN));
}

/* Orders the transitions and counts along them. The change of each is carried in count_above. */
static void count_along(dg_transition_list *list)
{
    int count = list->count_at_min;
    if (list->count > 0)
        qsort(list->items, list->count, sizeof *list->items, ascending);
    for (size_t i = 0; i < list->count; i++) {
        dg_transition *t = &list->items[i];
        t->count_below = count;
        t->count_above += count;
        count = t->count_above;
        if (t->decided != CV_OK)
            doubt(list, "transition not confirmed to the digits asked for", t->alpha);
        if (count < 0)
            doubt(list, "negative number of unstable roots", t->alpha);
        if (i > 0) {
            mpfr_t gap;
            mpfr_init2(gap, mpfr_get_prec(t->alpha));
            mpfr_sub(gap, t->alpha, t[-1].alpha, MPFR_RNDD);
            if (!(mpfr_cmp_d(gap, t->alpha_error + t[-1].alpha_error) > 0))
                doubt(list, "transitions that cannot be told apart", t->alpha);
            mpfr_clear(gap);
        }
    }
}

cv_status dg_list_fill(dg_transition_list *list, dg_effort *effort, const dg_track *track,
                       const dg_mass *mass, const cv_number *mass_ratio, int digits, cv_message *why)
{
    list->count_at_min = mass->count_at_min;
    list->status = mass->status;
    list->why = mass->why;
    if (mass->count == 0)
        return CV_OK;
    list->items = calloc(mass->count, sizeof *list->items);
    if (list->items == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < mass->count; i++) {
        dg_transition *t = &list->items[list->count++];
        mpfr_inits2(53, t->alpha, t->frequency, (mpfr_ptr)NULL);
        const cv_status status = dg_refine(t, effort, track, &mass->finds[i], mass_ratio, digits);
        if (status != CV_OK && status != CV_UNDECIDED)
            return cv_fail(why, status, "refinement of a transition failed");
        t->count_above = mass->finds[i].change;
    }
    count_along(list);
    return CV_OK;
}
