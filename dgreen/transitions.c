#include "dgreen/transitions.h"

#include <stdlib.h>
#include <string.h>

#include "dgreen/transitions_refine.h"
#include "dgreen/transitions_sweep.h"

/* The curves are listed down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.3;

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

/* The list of one mass ratio from what the search in double found. */
static cv_status finish(dg_transition_list *list, dg_effort *effort, const dg_track *track,
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

static cv_status set_masses(dg_sweep *s, size_t mass_count, const cv_number *mass_ratios)
{
    s->masses = calloc(mass_count, sizeof *s->masses);
    if (s->masses == NULL)
        return cv_fail(s->why, CV_FAILED, "out of memory");
    s->mass_count = mass_count;
    for (size_t k = 0; k < mass_count; k++) {
        const double x = 1 / cv_number_get_double(&mass_ratios[k]);
        s->masses[k].x = x;
        s->x_roof = k == 0 || x > s->x_roof ? x : s->x_roof;
        s->x_floor = k == 0 || x * FLOOR < s->x_floor ? x * FLOOR : s->x_floor;
    }
    return CV_OK;
}

static void sweep_clear(dg_sweep *s, dg_branch_curves *branches, dg_track *track)
{
    for (size_t k = 0; k < s->mass_count; k++)
        free(s->masses[k].finds);
    free(s->masses);
    dg_branch_curves_free(branches);
    dg_follow_free(s->probe.follow);
    dg_track_free(track);
}

static cv_status search(dg_sweep *s, dg_track **track, dg_branch_curves **branches, const cv_params *params,
                        double alpha_min, double alpha_max)
{
    cv_status status = dg_track_new(track, params, s->why);
    s->probe.track = *track;
    if (status == CV_OK)
        status = dg_follow_new(&s->probe.follow, s->why);
    if (status == CV_OK)
        status = dg_branch_curves_new(branches, *track, alpha_min, alpha_max, s->why);
    s->probe.branches = *branches;
    return status == CV_OK ? dg_sweep_run(s, alpha_min, alpha_max) : status;
}

cv_status dg_find_transitions(dg_transition_list *lists, dg_effort *effort, const cv_params *params,
                              const cv_number *alpha_min, const cv_number *alpha_max, size_t mass_count,
                              const cv_number *mass_ratios, int digits, cv_message *why)
{
    dg_effort unused, *used = effort ? effort : &unused;
    dg_sweep s = {.why = why};
    dg_track *track = NULL;
    dg_branch_curves *branches = NULL;
    memset(lists, 0, mass_count * sizeof *lists);
    *used = (dg_effort){0};
    if (cv_params_undamped(params))
        return cv_fail(why, CV_BAD_INPUT, "transitions need damping: all damping ratios are zero");
    cv_status status = set_masses(&s, mass_count, mass_ratios);
    if (status == CV_OK)
        status = search(&s, &track, &branches, params, cv_number_get_double(alpha_min),
                        cv_number_get_double(alpha_max));
    if (status == CV_OK) {
        const dg_counters c = dg_follow_counters(s.probe.follow);
        *used = (dg_effort){c.evaluations, c.above_double, c.largest_precision};
    }
    for (size_t k = 0; k < mass_count && status == CV_OK; k++)
        status = finish(&lists[k], used, track, &s.masses[k], &mass_ratios[k], digits, why);
    if (status != CV_OK)
        for (size_t k = 0; k < mass_count; k++)
            dg_transition_list_clear(&lists[k]);
    sweep_clear(&s, branches, track);
    return status;
}
