#include "dgreen/lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/lines_graph.h"
#include "dgreen/velocities.h"

/* Lines are followed to this many times the greatest eta_M, but not beyond LARGEST_MASS on that account; the
 * curves are listed down to this part of the smallest 1/eta_M. */
static const double BEYOND = 100, LARGEST_MASS = 1e6, FLOOR = 0.3;
enum { ASYMPTOTE_DIGITS = 20 };

static void graph_free(dg_line_graph *g)
{
    if (g == NULL)
        return;
    dg_station_clear(&g->station);
    dg_branch_curves_free(g->branches);
    dg_follow_free(g->follow);
    dg_track_free(g->track);
    free(g->nodes);
    free(g);
}

void dg_lines_clear(dg_lines *l)
{
    for (size_t i = 0; i < l->count; i++)
        free(l->lines[i].vertices);
    free(l->lines);
    free(l->doubts);
    dg_asymptote_list_clear(&l->asymptotes);
    graph_free(l->graph);
    memset(l, 0, sizeof *l);
}

/* Every line ends at the first and at the last velocity. */
static void mark_ends(dg_line_graph *g, const dg_line_column *c, int side, dg_line_exit exit)
{
    for (size_t k = 0; k < c->curve.crossing_count; k++)
        g->nodes[c->first + (int)k].exit[side] = exit;
}

/* All columns, each linked to the last one; one between that cannot be evaluated is left out. */
static cv_status walk(dg_line_graph *g, const dg_velocities *v, dg_line_column *columns)
{
    cv_status status = CV_OK;
    size_t n = 0;
    for (size_t i = 0; i < v->count && status == CV_OK; i++) {
        dg_line_column *here = &columns[n % 2];
        status = dg_line_column_at(here, g, v->at[i]);
        if (status == CV_UNDECIDED && i > 0 && i + 1 < v->count) {
            status = CV_OK;
            continue;
        }
        if (status == CV_OK && i == 0)
            mark_ends(g, here, DG_LINE_LOWER, DG_LINE_ALPHA_MIN);
        if (status == CV_OK && i + 1 == v->count)
            mark_ends(g, here, DG_LINE_HIGHER, DG_LINE_ALPHA_MAX);
        if (n > 0 && status == CV_OK)
            status = dg_line_cell(g, &columns[(n + 1) % 2], here);
        n++;
    }
    if (status == CV_OK)
        g->why->text[0] = '\0'; /* of those left out */
    return status;
}

static cv_status search(dg_line_graph *g)
{
    dg_velocities v = {0};
    dg_line_column columns[2];
    memset(columns, 0, sizeof columns);
    cv_status status = dg_velocities_choose(&v, g->probe.branches, g->alpha_min, g->alpha_max, 0, g->why);
    if (status == CV_OK)
        status = walk(g, &v, columns);
    if (status == CV_OK)
        status = dg_asymptotes_find(&g->lines->asymptotes, g->track, g->branches, g->alpha_min, g->alpha_max,
                                    ASYMPTOTE_DIGITS, g->why);
    if (status == CV_OK)
        status = dg_line_collect(g);
    dg_curve_clear(&columns[0].curve);
    dg_curve_clear(&columns[1].curve);
    free(v.at);
    return status;
}

static cv_status prepare_and_search(dg_line_graph *g, const cv_params *params)
{
    cv_status status = dg_track_new(&g->track, params, g->why);
    if (status == CV_OK)
        status = dg_follow_new(&g->follow, g->why);
    if (status == CV_OK)
        status = dg_branch_curves_new(&g->branches, g->track, g->alpha_min, g->alpha_max, g->why);
    g->probe = (dg_probe){g->track, g->follow, g->branches, 0};
    return status == CV_OK ? search(g) : status;
}

cv_status dg_lines_find(dg_lines *out, const cv_params *params, double alpha_min, double alpha_max,
                        double mass_min, double mass_max, cv_message *why)
{
    cv_message unread;
    why = why ? why : &unread;
    memset(out, 0, sizeof *out);
    if (cv_params_undamped(params))
        return cv_fail(why, CV_BAD_INPUT, "instability lines need damping: all damping ratios are zero");
    if (mass_max > DG_LINES_MASS_MAX)
        return cv_fail(why, CV_BAD_INPUT, "instability lines only up to eta_M = %g", DG_LINES_MASS_MAX);
    if (!(alpha_min > 0 && alpha_max > alpha_min && mass_min > 0 && mass_max > mass_min))
        return cv_fail(why, CV_BAD_INPUT, "instability lines need ranges 0 < first < last");
    dg_line_graph *g = calloc(1, sizeof *g);
    if (g == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    *out = (dg_lines){.alpha_min = alpha_min,
                      .alpha_max = alpha_max,
                      .mass_min = mass_min,
                      .mass_max = mass_max,
                      .graph = g};
    const double hidden = fmax(mass_max, fmin(BEYOND * mass_max, LARGEST_MASS));
    *g = (dg_line_graph){.alpha_min = alpha_min,
                         .alpha_max = alpha_max,
                         .x_min = 1 / mass_max,
                         .x_max = 1 / mass_min,
                         .x_hidden = 1 / hidden,
                         .x_floor = FLOOR / hidden,
                         .scale_alpha = alpha_max - alpha_min,
                         .scale_log = log(mass_max / mass_min),
                         .lines = out,
                         .why = why};
    const cv_status status = prepare_and_search(g, params);
    g->lines = NULL; /* out may move */
    g->why = NULL;
    if (status != CV_OK)
        dg_lines_clear(out);
    return status;
}

cv_status dg_lines_asymptotes(dg_asymptote_list *list, const dg_lines *l, int digits, cv_message *why)
{
    return dg_asymptotes_sharpen(list, &l->asymptotes, l->graph->track, digits, why);
}
