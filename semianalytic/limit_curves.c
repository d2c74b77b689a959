#include "semianalytic/limit_curves.h"

#include <math.h>
#include <stdlib.h>

/* What is found at one velocity of an arc: on the side without waves and on that of the waves. */
typedef struct {
    double alpha, q;
    int runs[2];     /* by zero_mass: a run is here */
    double re;       /* Re zeta on the side of the waves */
    int doppler, up; /* S; waves at q above the curve */
} station;

typedef struct {
    sa_curve_runs *out;
    const sa_map *map;
    sa_field *field;
    double re_floor;
    const sa_meeting *meeting;
    double level[2]; /* Re zeta at the ends of the range of eta_M, ascending */
    size_t rim_count;
    const double *rim;
    int arc;
    int open[2];      /* by zero_mass: the last run of this kind goes on */
    size_t last[2];   /* its number */
    sa_run_end begin; /* what a run that is there at the first station of a column begins with */
} walk;

static cv_status add_run(sa_curve_runs *list, const sa_curve_run *run)
{
    if (list->count == list->room) {
        size_t room = 2 * list->room + 16;
        sa_curve_run *more = realloc(list->item, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        list->item = more;
        list->room = room;
    }
    list->item[list->count++] = *run;
    return CV_OK;
}

/* Signed q of the arc and its wave; 0 where the arc is not. */
static int arc_wave(sa_wave *wave, long double *q, const sa_map *map, int arc, double alpha)
{
    const sa_branch_arc *a = &map->curves.arc[arc];
    return alpha >= a->alpha_low && alpha <= a->alpha_high &&
           sa_branch_arc_at(wave, q, &map->curves, (size_t)arc, alpha) == CV_OK && isfinite(wave->p);
}

double sa_curve_distance(const sa_map *map, int arc, double alpha, double q)
{
    sa_wave wave;
    long double at;
    if (!arc_wave(&wave, &at, map, arc, alpha))
        return (double)NAN;
    int up = (at >= 0) == (wave.d[2] > 0);
    return (up ? 1 : -1) * (q - (double)fabsl(at));
}

static cv_status rim_at(sa_sample *s, const walk *w, const sa_map_node *node, int curve, int above)
{
    int strip = above ? curve : curve - 1, side = !above;
    sa_field_block(w->field, 0, 0, strip, side);
    return sa_field_at_node(s, w->field, node, strip, side, 0, 1);
}

/* A curve that the map leaves out: zeta is the same on either side. */
static cv_status rim_hidden(sa_sample rim[2], const walk *w, const sa_map_node *node, double q)
{
    const double beside = 1e-9;
    int strip, side;
    double t;
    sa_map_locate(&strip, &side, &t, node, q * (1 + beside));
    sa_field_block(w->field, 0, 0, strip, side);
    cv_status status = sa_field_at_node(&rim[0], w->field, node, strip, side, t, 1);
    rim[1] = rim[0];
    return status;
}

/* Number of the curve at a node of the column; 0: left out by the map */
static int curve_of(const sa_column *column, int arc)
{
    for (int i = 0; i < column->count; ++i)
        if (column->curve[i] == arc)
            return i + 1;
    return 0;
}

static cv_status look(station *out, const walk *w, const sa_column *column, double alpha)
{
    sa_map_node node;
    sa_wave wave;
    sa_sample rim[2]; /* on the side of the waves, on the other */
    long double q;
    int curve = curve_of(column, w->arc);
    cv_status status = sa_map_node_of(&node, w->map, alpha);
    if (status != CV_OK || !arc_wave(&wave, &q, w->map, w->arc, node.alpha))
        return CV_FAILED;
    *out = (station){.alpha = node.alpha, .q = (double)fabsl(q), .doppler = q < 0 ? -1 : 1};
    out->up = (q >= 0) == (wave.d[2] > 0);
    if (curve == 0)
        status = rim_hidden(rim, w, &node, out->q);
    else
        status = rim_at(&rim[0], w, &node, curve, out->up);
    if (status == CV_OK && curve != 0)
        status = rim_at(&rim[1], w, &node, curve, !out->up);
    if (status != CV_OK)
        return status;
    int reaches = out->up ? out->doppler : -out->doppler;
    out->re = rim[0].re;
    out->runs[0] = (rim[0].im > 0) == (out->doppler > 0) && rim[0].re > w->re_floor;
    out->runs[1] = (rim[1].im > 0) == (out->doppler > 0) && reaches > 0;
    return CV_OK;
}

static cv_status add_sample(walk *w, const station *s, int zero_mass)
{
    const sa_line_sample item = {
        .alpha = s->alpha, .q = s->q, .re = zero_mass ? (double)INFINITY : s->re, .marks = SA_MARK_CURVE};
    ++w->out->item[w->last[zero_mass]].count;
    return sa_line_samples_add(&w->out->samples, &item);
}

/* Of crossings.h: on the side of the waves Im zeta goes from S at the rim to -S at the curve, on the other
 * side too. */
static int direction_of(const station *s, int zero_mass)
{
    int falls_with_q = (s->doppler > 0) != s->up;
    return falls_with_q == (zero_mass == 0) ? 1 : -1;
}

static cv_status begin_run(walk *w, const station *s, int zero_mass, sa_run_end from)
{
    sa_curve_run run = {.arc = w->arc, .zero_mass = zero_mass, .direction = direction_of(s, zero_mass)};
    run.end[0] = from;
    run.end[0].alpha = s->alpha;
    run.first = w->out->samples.count;
    w->last[zero_mass] = w->out->count;
    w->open[zero_mass] = 1;
    return add_run(w->out, &run);
}

static void end_run(walk *w, int zero_mass, sa_run_end to)
{
    sa_curve_run *run = &w->out->item[w->last[zero_mass]];
    run->end[1] = to;
    w->open[zero_mass] = 0;
}

/* Where the runs of one kind between two stations begin or end; or, given a level, where Re zeta on the side
 * of the waves passes it. */
static cv_status bisect(station *at, const walk *w, const sa_column *column, station low, station high,
                        int zero_mass, double level)
{
    const double spacing = 4e-16;
    *at = low.runs[zero_mass] ? low : high;
    for (int i = 0; i < 60 && high.alpha - low.alpha > spacing * high.alpha; ++i) {
        station middle;
        cv_status status = look(&middle, w, column, low.alpha + (high.alpha - low.alpha) / 2);
        if (status != CV_OK)
            return status;
        int as_low = level > 0 ? (middle.re > level) == (low.re > level)
                               : middle.runs[zero_mass] == low.runs[zero_mass];
        *(as_low ? &low : &high) = middle;
        *at = low.runs[zero_mass] ? low : high;
    }
    return CV_OK;
}

static cv_status change(walk *w, const sa_column *column, const station *a, const station *b, int zero_mass)
{
    const double sunk = 2;
    station at;
    cv_status status = bisect(&at, w, column, *a, *b, zero_mass, 0);
    if (status != CV_OK)
        return status;
    int sinks = !zero_mass && at.re < sunk * w->re_floor;
    const sa_run_end end = {sinks ? SA_RUN_SINKS : SA_RUN_RIM, SA_COLUMN_PLAIN, at.alpha};
    if (!sinks && curve_of(column, w->arc) == 0) {
        w->out->hidden = 1;
        w->out->hidden_at[0] = at.alpha;
        w->out->hidden_at[1] = at.q;
    }
    if (b->runs[zero_mass])
        status = begin_run(w, &at, zero_mass, end);
    if (status == CV_OK)
        status = add_sample(w, &at, zero_mass);
    if (status == CV_OK && !b->runs[zero_mass])
        end_run(w, zero_mass, end);
    return status;
}

/* Samples at the ends of the range of eta_M. */
static cv_status add_cuts(walk *w, const sa_column *column, const station *a, const station *b)
{
    int first = a->re < b->re ? 0 : 1;
    cv_status status = CV_OK;
    for (int i = 0; i < 2 && status == CV_OK; ++i) {
        double level = w->level[first ? 1 - i : i];
        station at;
        if ((a->re > level) == (b->re > level))
            continue;
        status = bisect(&at, w, column, *a, *b, 0, level);
        at.re = level;
        if (status == CV_OK)
            status = add_sample(w, &at, 0);
        w->out->samples.item[w->out->samples.count - 1].marks |= SA_MARK_CUT;
    }
    return status;
}

/* From one station to the next, both in the column. Samples of the two kinds of runs must not mix: one kind
 * is walked at a time. */
static cv_status advance(walk *w, const sa_column *column, const station *a, const station *b, int zero_mass)
{
    cv_status status = CV_OK;
    if (a->runs[zero_mass] != b->runs[zero_mass])
        status = change(w, column, a, b, zero_mass);
    else if (b->runs[zero_mass] && !zero_mass)
        status = add_cuts(w, column, a, b);
    if (status == CV_OK && b->runs[zero_mass])
        status = add_sample(w, b, zero_mass);
    return status;
}

static int ascending(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

enum { GRADED = 8 };

/* The part of a column in which the arc is; 0: none */
static int overlap(double range[2], const walk *w, const sa_column *c)
{
    const double beside = 1e-9;
    const sa_branch_arc *a = &w->map->curves.arc[w->arc];
    double high = (double)a->alpha_high * (isinf(a->p_high) ? 1 - beside : 1);
    range[0] = fmax(c->alpha_low, (double)a->alpha_low);
    /* the upper end belongs to the next column (sa_map_node_of) */
    range[1] = fmin(nextafter(c->alpha_high, 0), high);
    return range[0] < range[1];
}

/* Velocities at which the arc is looked at: graded, and beside the ends of lines. Returns how many; room for
 * 2 GRADED + 1 + 2 rim_count. */
static size_t velocities(double *alpha, const walk *w, const sa_column *c, const double range[2])
{
    const double beside = 1e-9;
    size_t n = 0;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < GRADED + side; ++i) {
            double length = side ? c->length_high : c->length_low;
            double distance = length * expm1((double)i / GRADED * sa_map_column_extent(c, side));
            alpha[n++] = side ? c->alpha_high - distance : c->alpha_low + distance;
        }
    for (size_t i = 0; i < w->rim_count; ++i)
        for (int side = -1; side <= 1; side += 2) {
            double at = w->rim[i] * (1 + side * beside);
            if (at > range[0] && at < range[1])
                alpha[n++] = at;
        }
    for (size_t i = 0; i < n; ++i)
        alpha[i] = fmin(fmax(alpha[i], range[0]), range[1]);
    qsort(alpha, n, sizeof *alpha, ascending);
    return n;
}

static cv_status walk_column(walk *w, const sa_column *c, const double range[2], int zero_mass)
{
    double *alpha = calloc(2 * GRADED + 2 + 2 * w->rim_count, sizeof *alpha);
    if (alpha == NULL)
        return CV_FAILED;
    size_t n = velocities(alpha, w, c, range);
    station a, b;
    cv_status status = look(&a, w, c, alpha[0]);
    if (status == CV_OK && a.runs[zero_mass] && !w->open[zero_mass])
        status = begin_run(w, &a, zero_mass, w->begin);
    if (status == CV_OK && w->open[zero_mass] && !a.runs[zero_mass])
        end_run(w, zero_mass, (sa_run_end){SA_RUN_RIM, SA_COLUMN_PLAIN, a.alpha});
    if (status == CV_OK && a.runs[zero_mass])
        status = add_sample(w, &a, zero_mass);
    for (size_t i = 1; i < n && status == CV_OK; ++i) {
        if (alpha[i] == alpha[i - 1])
            continue;
        status = look(&b, w, c, alpha[i]);
        if (status == CV_OK)
            status = advance(w, c, &a, &b, zero_mass);
        a = b;
    }
    free(alpha);
    return status;
}

static int has_terminal(const sa_meeting *m, int arc, int side)
{
    for (size_t i = 0; i < 2 * m->count; ++i) {
        const sa_terminal *t = &m->bridge[i / 2].end[i % 2];
        if (t->kind == SA_TERMINAL_CURVE && t->arc == arc && t->side == side)
            return 1;
    }
    return 0;
}

/* A run between two special velocities in one closed column, which the map does not resolve. */
static cv_status add_between(walk *w, long low, long high)
{
    const sa_meeting *m[2] = {&w->meeting[low], &w->meeting[high]};
    sa_wave wave;
    long double q;
    if (!has_terminal(m[0], w->arc, 1) || !has_terminal(m[1], w->arc, -1))
        return CV_OK;
    if (!arc_wave(&wave, &q, w->map, w->arc, m[0]->alpha + (m[1]->alpha - m[0]->alpha) / 2))
        return CV_FAILED;
    station s = {.alpha = m[0]->alpha, .q = m[0]->q, .doppler = q < 0 ? -1 : 1};
    s.up = (q >= 0) == (wave.d[2] > 0);
    cv_status status = begin_run(w, &s, 1, (sa_run_end){SA_RUN_SPECIAL, low, m[0]->alpha});
    if (status == CV_OK)
        status = add_sample(w, &s, 1);
    s.alpha = m[1]->alpha;
    s.q = m[1]->q;
    if (status == CV_OK)
        status = add_sample(w, &s, 1);
    if (status == CV_OK)
        end_run(w, 1, (sa_run_end){SA_RUN_SPECIAL, high, m[1]->alpha});
    return status;
}

/* A closed column: a run ends at the first special velocity at which this arc meets another, and begins at
 * the last. */
static cv_status pass_closed(walk *w, const sa_column *c, int zero_mass)
{
    long before = SA_COLUMN_PLAIN;
    cv_status status = CV_OK;
    for (size_t i = 0; i < w->map->curves.special_count && status == CV_OK; ++i) {
        const sa_meeting *m = &w->meeting[i];
        if (m->alpha < c->alpha_low || m->alpha > c->alpha_high ||
            (m->arc[0] != w->arc && m->arc[1] != w->arc))
            continue;
        const sa_run_end end = {SA_RUN_SPECIAL, (long)i, m->alpha};
        if (w->open[zero_mass])
            end_run(w, zero_mass, end);
        if (before != SA_COLUMN_PLAIN && zero_mass)
            status = add_between(w, before, (long)i);
        w->begin = end;
        before = (long)i;
    }
    return status;
}

/* Where the arc ends: at the shear speed, where its wave goes to p = infinity, or in a cusp, next to which
 * there are no runs. */
static sa_run_end end_of_arc(const walk *w, double alpha)
{
    const sa_branch_arc *arc = &w->map->curves.arc[w->arc];
    if (isinf(arc->p_high) && arc->alpha_high <= w->map->curves.alpha_max)
        return (sa_run_end){SA_RUN_SHEAR, SA_COLUMN_PLAIN, (double)arc->alpha_high};
    return (sa_run_end){SA_RUN_RIM, SA_COLUMN_PLAIN, alpha};
}

static cv_status walk_arc(walk *w, int zero_mass)
{
    const double near = 1e-8;
    cv_status status = CV_OK;
    w->begin = (sa_run_end){SA_RUN_RANGE, SA_COLUMN_PLAIN, 0};
    for (size_t i = 0; i < w->map->count && status == CV_OK; ++i) {
        const sa_column *c = &w->map->column[i];
        double range[2];
        if (c->closed) {
            status = pass_closed(w, c, zero_mass);
            continue;
        }
        int here = overlap(range, w, c);
        if (here)
            status = walk_column(w, c, range, zero_mass);
        w->begin = (sa_run_end){SA_RUN_RIM, SA_COLUMN_PLAIN, c->alpha_low};
        if (w->open[zero_mass] && !(here && range[1] > c->alpha_high * (1 - near)))
            end_run(w, zero_mass, end_of_arc(w, c->alpha_low));
    }
    if (w->open[zero_mass])
        end_run(w, zero_mass, (sa_run_end){SA_RUN_RANGE, SA_COLUMN_PLAIN, w->map->curves.alpha_max});
    return status;
}

cv_status sa_curve_runs_find(sa_curve_runs *out, const sa_map *map, sa_field *field, double re_floor,
                             const sa_meeting *meeting, const double level[2], size_t rim_count,
                             const double *rim)
{
    walk w = {.out = out,
              .map = map,
              .field = field,
              .re_floor = re_floor,
              .meeting = meeting,
              .level = {level[0], level[1]},
              .rim_count = rim_count,
              .rim = rim};
    cv_status status = CV_OK;
    for (w.arc = 0; w.arc < (int)map->curves.arc_count && status == CV_OK; ++w.arc) {
        status = walk_arc(&w, 1);
        if (status == CV_OK)
            status = walk_arc(&w, 0);
    }
    return status;
}

void sa_curve_runs_clear(sa_curve_runs *runs)
{
    free(runs->item);
    free(runs->samples.item);
    *runs = (sa_curve_runs){0};
}
