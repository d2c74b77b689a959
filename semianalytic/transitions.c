#include "semianalytic/transitions.h"

#include <math.h>
#include <stdlib.h>

#include "semianalytic/crossings.h"
#include "semianalytic/transitions_parts.h"

struct sa_boundary {
    cv_params params;
    sa_track *track;
    sa_map map;
    sa_sweep *sweep;  /* for the refinement */
    sa_counts counts; /* of fields no longer there */
};

static cv_status prepare(sa_boundary *b, const cv_number *alpha_min, const cv_number *alpha_max,
                         cv_message *why)
{
    cv_status status = sa_track_new(&b->track, &b->params, why);
    if (status != CV_OK)
        return status;
    if (cv_number_sign(alpha_min) <= 0 || cv_number_compare(alpha_min, alpha_max) >= 0)
        return cv_fail(why, CV_BAD_INPUT, "the range of velocities must have 0 < alpha_min < alpha_max");
    b->sweep = sa_sweep_new();
    if (b->sweep == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    return sa_map_build(&b->map, &b->params, cv_number_get_double(alpha_min), cv_number_get_double(alpha_max),
                        why);
}

cv_status sa_boundary_new(sa_boundary **out, const cv_params *params, const cv_number *alpha_min,
                          const cv_number *alpha_max, cv_message *why)
{
    sa_boundary *b = calloc(1, sizeof *b);
    *out = NULL;
    if (b == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_params_init(&b->params);
    cv_params_set(&b->params, params);
    cv_status status = prepare(b, alpha_min, alpha_max, why);
    if (status == CV_OK)
        *out = b;
    else
        sa_boundary_free(b);
    return status;
}

void sa_boundary_free(sa_boundary *boundary)
{
    if (boundary == NULL)
        return;
    sa_map_clear(&boundary->map);
    sa_sweep_free(boundary->sweep);
    sa_track_free(boundary->track);
    cv_params_clear(&boundary->params);
    free(boundary);
}

static void add_counts(sa_counts *sum, sa_counts c)
{
    sum->evaluations += c.evaluations;
    sum->cold_starts += c.cold_starts;
    sum->beyond_double += c.beyond_double;
    if (c.largest_precision > sum->largest_precision)
        sum->largest_precision = c.largest_precision;
}

sa_counts sa_boundary_counts(const sa_boundary *boundary)
{
    sa_counts sum = sa_sweep_counts(boundary->sweep);
    add_counts(&sum, boundary->counts);
    return sum;
}

/* One pass over the map for some of the mass ratios. */
typedef struct {
    sa_boundary *boundary;
    sa_field *field;
    size_t count;
    const size_t *index; /* of the lists in question */
    double *level;
    sa_levels levels;
} search_pass;

static cv_status on_segment(void *context, sa_field *field, const sa_segment *segment)
{
    search_pass *p = context;
    return sa_levels_on_segment(&p->levels, field, segment);
}

static cv_status on_unresolved(void *context, const sa_sample *centre, double re_range)
{
    search_pass *p = context;
    for (size_t i = 0; i < p->count; ++i)
        if (!(fabs(centre->re - p->level[i]) > 2 * re_range)) {
            p->levels.doubtful[i] = 1;
            p->levels.doubtful_at[i] = centre->alpha;
        }
    return CV_OK;
}

static cv_status trace(search_pass *p, int refinement)
{
    sa_search search = {.re_low = INFINITY, .tolerance = 0.25, .largest_cell = 2.5, .context = p};
    search.segment = on_segment;
    search.unresolved = on_unresolved;
    for (size_t i = 0; i < p->count; ++i) {
        search.re_low = fmin(search.re_low, 0.98 * p->level[i]);
        search.re_high = fmax(search.re_high, 1.02 * p->level[i]);
    }
    for (int i = 0; i < refinement; ++i) {
        search.tolerance /= 2;
        search.largest_cell /= 1.7; /* not a multiple: other cells, not only smaller ones */
    }
    return sa_map_search(&p->boundary->map, p->field, &search);
}

/* N at the lowest velocity for every list */
static cv_status count_starts(sa_transitions *lists, const search_pass *p, double re_low, int refinement)
{
    sa_crossings start;
    const sa_map *map = &p->boundary->map;
    cv_status status =
        sa_crossings_find_finer(&start, map, p->field, map->curves.alpha_min, re_low, refinement, NULL);
    for (size_t i = 0; i < p->count && (status == CV_OK || status == CV_UNDECIDED); ++i) {
        sa_transitions *list = &lists[p->index[i]];
        cv_status counted = status;
        if (status == CV_OK)
            counted = sa_crossings_count(&list->roots_at_start, &start, p->level[i]);
        if (counted != CV_OK)
            sa_transitions_doubt(list, "unstable roots could not be counted at the lowest velocity");
    }
    sa_crossings_clear(&start);
    return status == CV_UNDECIDED ? CV_OK : status;
}

static cv_status finish_lists(sa_transitions *lists, search_pass *p, const cv_number *mass_ratios, int digits,
                              double re_low, int refinement)
{
    sa_boundary *b = p->boundary;
    cv_status status = count_starts(lists, p, re_low, refinement);
    for (size_t i = 0; i < p->count && status == CV_OK; ++i) {
        sa_transitions *list = &lists[p->index[i]];
        if (p->levels.doubtful[i])
            sa_transitions_doubt(list, "a line touches 1 / eta_M or meets another line near alpha = %.15g",
                                 p->levels.doubtful_at[i]);
        status = sa_transitions_assemble(list, b->sweep, b->track, &b->map, p->field, &p->levels.found, i,
                                         &mass_ratios[p->index[i]], digits);
    }
    const sa_verification v = {&b->map, p->field, lists, p->count, p->index, p->level, re_low, refinement};
    if (status == CV_OK)
        status = sa_transitions_verify(&v);
    for (size_t i = 0; i < p->count && b->map.undamped; ++i)
        sa_transitions_explain_limit(&lists[p->index[i]]);
    return status;
}

static cv_status run_pass(sa_transitions *lists, search_pass *p, const cv_number *mass_ratios, int digits,
                          int refinement)
{
    double lowest = INFINITY;
    for (size_t i = 0; i < p->count; ++i) {
        p->level[i] = 1 / cv_number_get_double(&mass_ratios[p->index[i]]);
        lowest = fmin(lowest, p->level[i]);
    }
    p->levels = (sa_levels){.count = p->count, .level = p->level};
    p->levels.doubtful = calloc(p->count, sizeof *p->levels.doubtful);
    p->levels.doubtful_at = calloc(p->count, sizeof *p->levels.doubtful_at);
    p->field = sa_field_new(&p->boundary->map, p->boundary->track, lowest / 4);
    cv_status status = CV_FAILED;
    if (p->levels.doubtful != NULL && p->levels.doubtful_at != NULL && p->field != NULL)
        status = trace(p, refinement);
    for (size_t i = 0; i < p->count; ++i) {
        sa_transitions_clear(&lists[p->index[i]]);
        if (status == CV_UNDECIDED)
            sa_transitions_doubt(&lists[p->index[i]], "the search for lines Im zeta = 0 came to no end");
    }
    if (status == CV_OK)
        status = finish_lists(lists, p, mass_ratios, digits, lowest / 2, refinement);
    status = status == CV_UNDECIDED ? CV_OK : status;
    if (p->field != NULL)
        add_counts(&p->boundary->counts, sa_field_counts(p->field));
    sa_field_free(p->field);
    free(p->levels.doubtful);
    free(p->levels.doubtful_at);
    free(p->levels.found.items);
    return status;
}

static size_t collect_undecided(size_t *index, const sa_transitions *lists, size_t mass_count)
{
    size_t n = 0;
    for (size_t i = 0; i < mass_count; ++i)
        if (lists[i].decided != CV_OK)
            index[n++] = i;
    return n;
}

cv_status sa_boundary_transitions(sa_transitions *lists, sa_boundary *boundary, size_t mass_count,
                                  const cv_number *mass_ratios, int digits, int level, cv_message *why)
{
    enum { PASSES = 3 };
    size_t *index = calloc(mass_count, sizeof *index), pending = mass_count;
    double *levels = calloc(mass_count, sizeof *levels);
    cv_status status = index != NULL && levels != NULL ? CV_OK : CV_FAILED;
    for (size_t i = 0; i < mass_count; ++i) {
        lists[i] = (sa_transitions){.decided = CV_UNDECIDED};
        if (status == CV_OK)
            index[i] = i;
    }
    for (int i = 0; i < PASSES && pending > 0 && status == CV_OK; ++i) {
        search_pass p = {.boundary = boundary, .count = pending, .index = index, .level = levels};
        status = run_pass(lists, &p, mass_ratios, digits, level + i);
        pending = status == CV_OK ? collect_undecided(index, lists, mass_count) : 0;
    }
    free(index);
    free(levels);
    if (status == CV_OK)
        return CV_OK;
    for (size_t i = 0; i < mass_count; ++i)
        sa_transitions_clear(&lists[i]);
    return cv_fail(why, status, "the search for transitions failed");
}

cv_status sa_boundary_unstable_roots(int *roots, sa_boundary *boundary, double alpha, size_t mass_count,
                                     const cv_number *mass_ratios, cv_message *why)
{
    double lowest = INFINITY;
    for (size_t i = 0; i < mass_count; ++i)
        lowest = fmin(lowest, 1 / cv_number_get_double(&mass_ratios[i]));
    sa_field *field = sa_field_new(&boundary->map, boundary->track, lowest / 4);
    sa_crossings crossings = {0};
    if (field == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = sa_crossings_find(&crossings, &boundary->map, field, alpha, lowest / 2, why);
    for (size_t i = 0; i < mass_count && status == CV_OK; ++i) {
        status = sa_crossings_count(&roots[i], &crossings, 1 / cv_number_get_double(&mass_ratios[i]));
        if (status == CV_UNDECIDED)
            cv_fail(why, status, "alpha = %.15g is a transition within double precision", alpha);
    }
    sa_crossings_clear(&crossings);
    add_counts(&boundary->counts, sa_field_counts(field));
    sa_field_free(field);
    return status;
}
