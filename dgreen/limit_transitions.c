#include "dgreen/limit_transitions.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/limit_search.h"
#include "dgreen/transitions_refine.h"

/* One mass ratio after the search: N at the lower end, changes between special velocities and at them. */
typedef struct {
    const dg_limit_search *search;
    size_t mass;
    const cv_number *mass_ratio;
    int digits;
    dg_effort *effort;
} assembly;

/* The frequency at which branch points meet, or one is next to zero, at a special velocity. */
static void meeting(double *q, double *error, const dg_branch_curves *branches, double alpha)
{
    dg_branch_point *points = calloc(dg_branch_points_max(branches), sizeof *points);
    *q = 0;
    *error = INFINITY;
    if (points == NULL)
        return;
    const size_t n = dg_branch_points_at(points, branches, alpha);
    for (size_t i = 0; i < n; i++) {
        const double gap = points[i].q - (i > 0 ? points[i - 1].q : 0);
        if (points[i].soft || (i > 0 && points[i - 1].soft) || !(gap < *error))
            continue;
        *error = gap;
        *q = i > 0 ? points[i].q : 0;
    }
    *error += 1e-14 * (1 + *q);
    free(points);
}

static void set_jump(dg_transition *t, const assembly *a, const dg_limit_event *event)
{
    double q;
    meeting(&q, &t->frequency_error, a->search->probe.branches, event->find.alpha);
    mpfr_set_d(t->alpha, event->find.alpha, MPFR_RNDN);
    mpfr_set_d(t->frequency, q, MPFR_RNDN);
    t->alpha_error = 16 * DBL_EPSILON * event->find.alpha;
    t->decided = t->alpha_error < pow(10, -a->digits) * event->find.alpha ? CV_OK : CV_UNDECIDED;
}

static cv_status add(dg_transition_list *list, const assembly *a, const dg_limit_event *event)
{
    dg_transition *t = &list->items[list->count++];
    cv_status status = CV_OK;
    mpfr_inits2(53, t->alpha, t->frequency, (mpfr_ptr)NULL);
    if (event->jump)
        set_jump(t, a, event);
    else
        status = dg_refine(t, a->effort, a->search->probe.track, &event->find, a->mass_ratio, a->digits);
    t->count_above = event->find.change;
    return status == CV_UNDECIDED ? CV_OK : status;
}

static void doubt(dg_transition_list *list, const char *reason, const dg_transition *t)
{
    if (list->status == CV_OK)
        list->status = cv_fail(&list->why, CV_UNDECIDED, "%s near alpha = %.17g", reason,
                               mpfr_get_d(t->alpha, MPFR_RNDN));
}

static void count_along(dg_transition_list *list, const dg_limit_event *event)
{
    int count = list->count_at_min;
    for (size_t i = 0; i < list->count; i++) {
        dg_transition *t = &list->items[i];
        t->count_below = count;
        t->count_above += count;
        count = t->count_above;
        if (i > 0 && !(mpfr_cmp(t[-1].alpha, t->alpha) < 0))
            doubt(list, "transitions that cannot be told apart", t);
        if (count < 0)
            doubt(list, "negative number of unstable roots", t);
        if (t->decided != CV_OK)
            doubt(list,
                  event[i].jump
                      ? "without damping N jumps at a special velocity, known to double precision only,"
                      : "transition not confirmed to the digits asked for",
                  t);
    }
}

static cv_status assemble(dg_transition_list *list, const assembly *a)
{
    const dg_limit_mass *m = &a->search->masses[a->mass];
    cv_status status = CV_OK;
    list->count_at_min = m->count_at_min;
    list->status = m->status;
    list->why = m->why;
    list->items = calloc(m->count + 1, sizeof *list->items);
    if (list->items == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < m->count && status == CV_OK; i++)
        status = add(list, a, &m->events[i]);
    if (status == CV_OK)
        count_along(list, m->events);
    return status;
}

static void add_effort(dg_effort *effort, const dg_follow *follow)
{
    const dg_counters c = dg_follow_counters(follow);
    effort->evaluations += c.evaluations;
    effort->above_double += c.above_double;
    if (c.largest_precision > effort->largest_precision)
        effort->largest_precision = c.largest_precision;
}

cv_status dg_find_limit_transitions(dg_transition_list *lists, dg_effort *effort, const cv_params *params,
                                    const cv_number *alpha_min, const cv_number *alpha_max, size_t mass_count,
                                    const cv_number *mass_ratios, int digits, int first_look, cv_message *why)
{
    const double range[2] = {cv_number_get_double(alpha_min), cv_number_get_double(alpha_max)};
    dg_limit_search s = {.mass_count = mass_count, .look = first_look, .why = why};
    dg_sampler sampler;
    cv_status status = dg_sampler_init(&sampler, params, range[0], range[1], why);
    if (status != CV_OK)
        return status;
    s.probe = dg_sampler_probe(&sampler);
    s.probe.look = first_look;
    s.masses = calloc(mass_count, sizeof *s.masses);
    status = s.masses != NULL ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
    for (size_t k = 0; k < mass_count && status == CV_OK; k++)
        s.masses[k].x = 1 / cv_number_get_double(&mass_ratios[k]);
    if (status == CV_OK)
        status = dg_limit_search_run(&s, range[0], range[1]);
    for (size_t k = 0; k < mass_count && status == CV_OK; k++) {
        const assembly a = {&s, k, &mass_ratios[k], digits, effort};
        status = assemble(&lists[k], &a);
    }
    add_effort(effort, s.probe.follow);
    for (size_t k = 0; k < mass_count; k++) {
        if (s.masses != NULL)
            free(s.masses[k].events);
        if (status != CV_OK)
            dg_transition_list_clear(&lists[k]);
    }
    free(s.masses);
    dg_sampler_clear(&sampler);
    return status;
}
