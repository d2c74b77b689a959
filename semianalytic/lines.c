#include "semianalytic/lines.h"

#include <math.h>
#include <stdlib.h>

#include "semianalytic/lines_parts.h"

static cv_status check_range(const sa_lines_range *range, cv_message *why)
{
    const double most = SA_LINES_MASS_MAX;
    if (cv_number_sign(range->alpha_min) <= 0 || cv_number_compare(range->alpha_min, range->alpha_max) >= 0)
        return cv_fail(why, CV_BAD_INPUT, "the range of velocities must have 0 < alpha_min < alpha_max");
    if (cv_number_sign(range->mass_min) <= 0 || cv_number_compare(range->mass_min, range->mass_max) >= 0)
        return cv_fail(why, CV_BAD_INPUT, "the range of mass ratios must have 0 < eta_M,min < eta_M,max");
    if (cv_number_get_double(range->mass_min) < 1 / most || cv_number_get_double(range->mass_max) > most)
        return cv_fail(why, CV_BAD_INPUT, "mass ratios must be within %g .. %g", 1 / most, most);
    return CV_OK;
}

static void store_free(sa_line_store *s)
{
    if (s == NULL)
        return;
    sa_field_free(s->field);
    sa_field_free(s->sharp);
    sa_sweep_free(s->sweep);
    sa_map_clear(&s->map);
    sa_track_free(s->track);
    cv_params_clear(&s->params);
    cv_number_clear(&s->alpha_min);
    cv_number_clear(&s->alpha_max);
    cv_number_clear(&s->mass_min);
    cv_number_clear(&s->mass_max);
    sa_resonances_clear(&s->resonances);
    free(s->samples.item);
    free(s->line);
    free(s->end);
    free(s);
}

/* Sets the plot. Returns Re zeta so small that q is, and lines stand upright on asymptotes. */
static double set_plot(sa_line_store *s)
{
    double low = cv_number_get_double(&s->mass_min), high = cv_number_get_double(&s->mass_max);
    s->plot.alpha_span = cv_number_get_double(&s->alpha_max) - cv_number_get_double(&s->alpha_min);
    s->plot.log_span = log(high / low);
    s->plot.re_low = 1 / high;
    s->plot.re_high = 1 / low;
    return fmin(1e-9, 0.1 / high);
}

static cv_status set_floor(sa_line_store *s, double re_floor)
{
    const double sharp = 1e-6;
    sa_field_free(s->field);
    sa_field_free(s->sharp);
    s->re_floor = re_floor;
    s->field = sa_field_new(&s->map, s->track, re_floor / 4);
    s->sharp = sa_field_new(&s->map, s->track, re_floor / 4);
    if (s->field == NULL || s->sharp == NULL)
        return CV_FAILED;
    sa_field_resolution(s->sharp, sharp);
    return CV_OK;
}

static cv_status store_new(sa_line_store **out, const cv_params *params, const sa_lines_range *range,
                           int digits, cv_message *why)
{
    sa_line_store *s = calloc(1, sizeof *s);
    *out = s;
    if (s == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_params_init(&s->params);
    cv_params_set(&s->params, params);
    const cv_number *from[] = {range->alpha_min, range->alpha_max, range->mass_min, range->mass_max};
    cv_number *to[] = {&s->alpha_min, &s->alpha_max, &s->mass_min, &s->mass_max};
    for (int i = 0; i < 4; ++i) {
        cv_number_init(to[i]);
        cv_number_set(to[i], from[i]);
    }
    const double re_floor = set_plot(s);
    cv_status status = sa_track_new(&s->track, params, why);
    if (status == CV_OK)
        status = sa_map_build(&s->map, params, cv_number_get_double(range->alpha_min),
                              cv_number_get_double(range->alpha_max), why);
    if (status == CV_OK && s->map.undamped)
        status = sa_resonances(&s->resonances, params, digits + 1, why);
    if (status != CV_OK)
        return status;
    s->sweep = sa_sweep_new();
    if (set_floor(s, re_floor) == CV_OK && s->sweep != NULL)
        return CV_OK;
    return cv_fail(why, CV_FAILED, "out of memory");
}

static void forget(sa_lines *lines)
{
    sa_line_store *s = lines->store;
    free(s->samples.item);
    free(s->line);
    free(s->end);
    free(lines->place);
    s->samples = (sa_line_samples){0};
    s->line = NULL;
    s->end = NULL;
    lines->place = NULL;
    lines->place_count = lines->line_count = s->line_count = 0;
    lines->decided = CV_OK;
    s->torn = 0;
}

/* A few seconds, and up to half a minute where Im zeta needs many digits everywhere. */
static const sa_line_effort little = {150000, 8000}, much = {0, 100000};

/* One search of the map; what does not fit together is listed in lines. *exhausted: 1 when it came to no end.
 */
static cv_status run_pass(int *exhausted, sa_lines *lines, int refinement, const sa_line_effort *effort)
{
    sa_line_store *s = lines->store;
    sa_line_trace trace = {.map = &s->map, .plot = s->plot, .re_floor = s->re_floor, .sharp = s->sharp};
    forget(lines);
    cv_status status = sa_lines_trace(&trace, s->field, refinement, effort);
    *exhausted = status == CV_UNDECIDED;
    s->torn = trace.place_count > 0;
    if (status == CV_UNDECIDED)
        status = sa_lines_doubt(lines, s->map.curves.alpha_min, 0, "the search for lines came to no end");
    else if (status == CV_OK)
        status = sa_lines_chain(&s->line, &s->line_count, &s->samples, &trace);
    lines->line_count = s->line_count;
    if (status == CV_OK && !*exhausted)
        status = sa_lines_ends(lines);
    if (status == CV_OK && !*exhausted && s->map.undamped)
        status = sa_lines_complete_limit(lines);
    for (size_t i = 0; i < trace.place_count && status == CV_OK; ++i)
        status =
            sa_lines_doubt(lines, trace.place[i][0], trace.place[i][1], "lines meet or cannot be resolved");
    sa_line_trace_clear(&trace);
    return status;
}

/* Where Re zeta is tiny, Im zeta may be tiny, too, and cost very many cells: then what is above the largest
 * eta_M is left to sa_lines_ends. */
static cv_status search(sa_lines *lines)
{
    const double factor = 100, margin = 0.3;
    sa_line_store *s = lines->store;
    int exhausted, last = 0;
    cv_status status = run_pass(&exhausted, lines, 0, &little);
    while (status == CV_OK && exhausted && !last) {
        last = s->re_floor * factor > margin * s->plot.re_low;
        status = set_floor(s, fmin(s->re_floor * factor, margin * s->plot.re_low));
        if (status == CV_OK)
            status = run_pass(&exhausted, lines, 0, last ? &much : &little);
    }
    return status;
}

/* What a pass has found */
typedef struct {
    sa_line_samples samples;
    sa_line *line;
    sa_line_end (*end)[2];
    size_t line_count, place_count;
    double (*place)[2];
    cv_status decided;
    cv_message reason;
    int torn;
} outcome;

static outcome take(sa_lines *lines)
{
    sa_line_store *s = lines->store;
    const outcome o = {s->samples,   s->line,        s->end,        s->line_count, lines->place_count,
                       lines->place, lines->decided, lines->reason, s->torn};
    s->samples = (sa_line_samples){0};
    s->line = NULL;
    s->end = NULL;
    lines->place = NULL;
    return o;
}

static void put_back(sa_lines *lines, const outcome *o)
{
    sa_line_store *s = lines->store;
    forget(lines);
    s->samples = o->samples;
    s->line = o->line;
    s->end = o->end;
    lines->line_count = s->line_count = o->line_count;
    lines->place_count = o->place_count;
    lines->place = o->place;
    lines->decided = o->decided;
    lines->reason = o->reason;
    s->torn = o->torn;
}

/* One more pass with finer cells; what was found before is better than a search without an end. */
static cv_status refine(int *exhausted, sa_lines *lines, int refinement)
{
    outcome before = take(lines);
    cv_status status = run_pass(exhausted, lines, refinement, &much);
    if (status == CV_OK && *exhausted) {
        put_back(lines, &before);
        return status;
    }
    free(before.samples.item);
    free(before.line);
    free(before.end);
    free(before.place);
    return status;
}

static cv_status find(sa_lines *lines, int digits)
{
    enum { PASSES = 3 };
    int exhausted = 0;
    cv_status status = search(lines);
    for (int i = 1; i < PASSES && status == CV_OK && lines->store->torn && !exhausted; ++i)
        status = refine(&exhausted, lines, i);
    return status == CV_OK ? sa_lines_cut(lines, digits) : status;
}

cv_status sa_lines_find(sa_lines *out, const cv_params *params, const sa_lines_range *range, int digits,
                        cv_message *why)
{
    *out = (sa_lines){.decided = CV_OK};
    cv_status status = check_range(range, why);
    if (status == CV_OK)
        status = store_new(&out->store, params, range, digits, why);
    if (status == CV_OK)
        status =
            sa_asymptotes_find(&out->asymptotes, params, range->alpha_min, range->alpha_max, digits, why);
    if (status == CV_OK) {
        status = find(out, digits);
        if (status != CV_OK)
            cv_fail(why, status, "the search for instability lines failed");
    }
    if (status != CV_OK)
        sa_lines_clear(out);
    return status;
}

void sa_lines_clear(sa_lines *lines)
{
    for (size_t i = 0; i < lines->count; ++i) {
        sa_branch *b = &lines->branch[i];
        for (size_t k = 0; k < b->count; ++k)
            sa_line_vertex_clear(&b->vertex[k]);
        free(b->vertex);
    }
    free(lines->branch);
    free(lines->place);
    sa_asymptotes_clear(&lines->asymptotes);
    store_free(lines->store);
    *lines = (sa_lines){0};
}
