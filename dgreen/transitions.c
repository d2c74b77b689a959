#include "dgreen/transitions.h"

#include <stdlib.h>
#include <string.h>

#include "dgreen/limit_transitions.h"
#include "dgreen/transitions_check.h"
#include "dgreen/transitions_list.h"
#include "dgreen/transitions_sweep.h"

/* The curves are listed down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.3;

typedef struct {
    dg_probe probe;
    dg_track *track;
    dg_branch_curves *branches;
    double alpha_min, alpha_max;
    size_t count; /* mass ratios, and what belongs to each */
    const cv_number *mass_ratios;
    dg_transition_list *lists;
    double *x; /* 1/eta_M */
    double x_floor;
    int digits;
    dg_effort *effort;
    cv_message *why;
} finder;

static cv_status finder_init(finder *f, const cv_params *params)
{
    f->x = calloc(f->count, sizeof *f->x);
    if (f->x == NULL)
        return cv_fail(f->why, CV_FAILED, "out of memory");
    for (size_t k = 0; k < f->count; k++) {
        f->x[k] = 1 / cv_number_get_double(&f->mass_ratios[k]);
        f->x_floor = k == 0 || f->x[k] * FLOOR < f->x_floor ? f->x[k] * FLOOR : f->x_floor;
        f->lists[k].status = CV_UNDECIDED;
    }
    cv_status status = dg_track_new(&f->track, params, f->why);
    if (status == CV_OK)
        status = dg_follow_new(&f->probe.follow, f->why);
    if (status == CV_OK)
        status = dg_branch_curves_new(&f->branches, f->track, f->alpha_min, f->alpha_max, f->why);
    f->probe.track = f->track;
    f->probe.branches = f->branches;
    return status;
}

static void finder_clear(finder *f)
{
    free(f->x);
    dg_branch_curves_free(f->branches);
    dg_follow_free(f->probe.follow);
    dg_track_free(f->track);
}

/* The mass ratios without a decided list */
static cv_status sweep_init(dg_sweep *s, const finder *f)
{
    *s = (dg_sweep){.probe = f->probe, .x_floor = f->x_floor, .why = f->why};
    s->masses = calloc(f->count, sizeof *s->masses);
    if (s->masses == NULL)
        return cv_fail(f->why, CV_FAILED, "out of memory");
    for (size_t k = 0; k < f->count; k++) {
        const double x = f->x[k];
        if (f->lists[k].status == CV_OK)
            continue;
        s->x_roof = s->mass_count == 0 || x > s->x_roof ? x : s->x_roof;
        s->masses[s->mass_count++].x = x;
    }
    return CV_OK;
}

static void sweep_clear(dg_sweep *s)
{
    for (size_t k = 0; k < s->mass_count; k++)
        free(s->masses[k].finds);
    free(s->masses);
}

/* New lists in place of those that are not decided */
static cv_status fill_lists(finder *f, const dg_sweep *s)
{
    cv_status status = CV_OK;
    size_t m = 0;
    for (size_t k = 0; k < f->count && status == CV_OK; k++) {
        dg_transition_list *list = &f->lists[k];
        if (list->status == CV_OK)
            continue;
        dg_transition_list_clear(list);
        status =
            dg_list_fill(list, f->effort, f->track, &s->masses[m++], &f->mass_ratios[k], f->digits, f->why);
    }
    return status;
}

/* Nothing is left of an undecided list but the reason why a curve could not be had. */
static void give_up(finder *f)
{
    for (size_t k = 0; k < f->count; k++)
        if (f->lists[k].status != CV_OK) {
            dg_transition_list_clear(&f->lists[k]);
            f->lists[k].status = CV_UNDECIDED;
            f->lists[k].why = *f->why;
        }
    f->why->text[0] = '\0';
}

/* One search as f->probe.look says, for the mass ratios whose lists are not decided. */
static cv_status look(finder *f)
{
    dg_sweep s;
    cv_status status = sweep_init(&s, f);
    if (status == CV_OK)
        status = dg_sweep_run(&s, f->alpha_min, f->alpha_max);
    if (status == CV_OK)
        status = fill_lists(f, &s);
    else if (status == CV_UNDECIDED)
        give_up(f);
    dg_probe closer = f->probe;
    closer.look++;
    if (status == CV_OK)
        status =
            dg_check_lists(f->lists, f->count, f->x, f->x_floor, &closer, f->alpha_min, f->alpha_max, f->why);
    sweep_clear(&s);
    return status == CV_UNDECIDED ? CV_OK : status;
}

static int all_decided(const finder *f)
{
    size_t k = 0;
    while (k < f->count && f->lists[k].status == CV_OK)
        k++;
    return k == f->count;
}

static void add_effort(dg_effort *effort, const dg_follow *follow)
{
    const dg_counters c = dg_follow_counters(follow);
    effort->evaluations += c.evaluations;
    effort->above_double += c.above_double;
    if (c.largest_precision > effort->largest_precision)
        effort->largest_precision = c.largest_precision;
}

cv_status dg_find_transitions(dg_transition_list *lists, dg_effort *effort, const cv_params *params,
                              const cv_number *alpha_min, const cv_number *alpha_max, size_t mass_count,
                              const cv_number *mass_ratios, int digits, int first_look, cv_message *why)
{
    dg_effort unused;
    finder f = {.alpha_min = cv_number_get_double(alpha_min),
                .alpha_max = cv_number_get_double(alpha_max),
                .count = mass_count,
                .mass_ratios = mass_ratios,
                .lists = lists,
                .digits = digits,
                .effort = effort ? effort : &unused,
                .why = why};
    memset(lists, 0, mass_count * sizeof *lists);
    *f.effort = (dg_effort){0};
    if (cv_params_undamped(params))
        return dg_find_limit_transitions(lists, f.effort, params, alpha_min, alpha_max, mass_count,
                                         mass_ratios, digits, first_look, why);
    cv_status status = finder_init(&f, params);
    for (int i = 0; i <= DG_MORE_LOOKS && status == CV_OK && !all_decided(&f); i++) {
        f.probe.look = first_look + i;
        status = look(&f);
    }
    if (status == CV_OK)
        add_effort(f.effort, f.probe.follow);
    for (size_t k = 0; k < mass_count && status != CV_OK; k++)
        dg_transition_list_clear(&lists[k]);
    finder_clear(&f);
    return status;
}
