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

static cv_status look(station *out, const walk *w, const sa_column *column, double alpha)
{
    sa_map_node node;
    sa_wave wave;
    sa_sample rim[2];
    long double q;
    int curve = 0;
    while (curve < column->count && column->curve[curve] != w->arc)
        ++curve;
    ++curve; /* 0 is q = 0 */
    cv_status status = sa_map_node_of(&node, w->map, alpha);
    if (status != CV_OK || !arc_wave(&wave, &q, w->map, w->arc, node.alpha))
        return CV_FAILED;
    *out = (station){.alpha = node.alpha, .q = (double)fabsl(q), .doppler = q < 0 ? -1 : 1};
    out->up = (q >= 0) == (wave.d[2] > 0);
    status = rim_at(&rim[0], w, &node, curve, out->up);
    if (status == CV_OK)
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

/* Where the runs of one kind between two stations begin or end. */
static cv_status bisect(station *at, const walk *w, const sa_column *column, station low, station high,
                        int zero_mass)
{
    const double spacing = 4e-16;
    *at = low.runs[zero_mass] ? low : high;
    for (int i = 0; i < 60 && high.alpha - low.alpha > spacing * high.alpha; ++i) {
        station middle;
        cv_status status = look(&middle, w, column, low.alpha + (high.alpha - low.alpha) / 2);
        if (status != CV_OK)
            return status;
        *(middle.runs[zero_mass] == low.runs[zero_mass] ? &low : &high) = middle;
        *at = low.runs[zero_mass] ? low : high;
    }
    return CV_OK;
}

static cv_status change(walk *w, const sa_column *column, const station *a, const station *b, int zero_mass)
{
    const double sunk = 2;
    station at;
    cv_status status = bisect(&at, w, column, *a, *b, zero_mass);
    if (status != CV_OK)
        return status;
    int sinks = !zero_mass && at.re < sunk * w->re_floor;
    const sa_run_end end = {sinks ? SA_RUN_SINKS : SA_RUN_RIM, SA_COLUMN_PLAIN, at.alpha};
    if (b->runs[zero_mass])
        status = begin_run(w, &at, zero_mass, end);
    if (status == CV_OK)
        status = add_sample(w, &at, zero_mass);
    if (status == CV_OK && !b->runs[zero_mass])
        end_run(w, zero_mass, end);
    return status;
}

/* From one station to the next, both in the column. Samples of the two kinds of runs must not mix: one kind
 * is walked at a time. */
static cv_status advance(walk *w, const sa_column *column, const station *a, const station *b, int zero_mass)
{
    cv_status status = CV_OK;
    if (a->runs[zero_mass] != b->runs[zero_mass])
        status = change(w, column, a, b, zero_mass);
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

/* Velocities at which the arc is looked at in a column: graded, and beside the ends of lines. Returns how
 * many; room for 2 GRADED + 1 + 2 rim_count. */
static size_t velocities(double *alpha, const walk *w, size_t column)
{
    const double beside = 1e-9;
    const sa_column *c = &w->map->column[column];
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
            if (at > c->alpha_low && at < c->alpha_high)
                alpha[n++] = at;
        }
    qsort(alpha, n, sizeof *alpha, ascending);
    alpha[n - 1] =
        nextafter(c->alpha_high, 0); /* the upper end belongs to the next column (sa_map_node_of) */
    return n;
}

static cv_status walk_column(walk *w, size_t column, int zero_mass)
{
    const sa_column *c = &w->map->column[column];
    double *alpha = calloc(2 * GRADED + 2 + 2 * w->rim_count, sizeof *alpha);
    if (alpha == NULL)
        return CV_FAILED;
    size_t n = velocities(alpha, w, column);
    station a, b;
    cv_status status = look(&a, w, c, alpha[0]);
    if (status == CV_OK && a.runs[zero_mass] && !w->open[zero_mass])
        status = begin_run(w, &a, zero_mass, w->begin);
    if (status == CV_OK && w->open[zero_mass] && !a.runs[zero_mass])
        end_run(w, zero_mass, (sa_run_end){SA_RUN_RIM, SA_COLUMN_PLAIN, a.alpha});
    if (status == CV_OK && a.runs[zero_mass])
        status = add_sample(w, &a, zero_mass);
    for (size_t i = 1; i < n && status == CV_OK; ++i) {
        status = look(&b, w, c, alpha[i]);
        if (status == CV_OK)
            status = advance(w, c, &a, &b, zero_mass);
        a = b;
    }
    free(alpha);
    return status;
}

/* The special velocity in a closed column at which this arc meets another curve; SA_COLUMN_PLAIN: none. */
static long meets(const walk *w, const sa_column *c)
{
    long found = SA_COLUMN_PLAIN;
    for (size_t i = 0; i < w->map->curves.special_count; ++i) {
        const sa_meeting *m = &w->meeting[i];
        if (m->alpha < c->alpha_low || m->alpha > c->alpha_high ||
            (m->arc[0] != w->arc && m->arc[1] != w->arc))
            continue;
        found = found == SA_COLUMN_PLAIN ? (long)i : SA_COLUMN_SEVERAL;
    }
    return found;
}

static int holds(const sa_column *c, int arc)
{
    for (int i = 0; i < c->count; ++i)
        if (c->curve[i] == arc)
            return 1;
    return 0;
}

static cv_status walk_arc(walk *w, int zero_mass)
{
    cv_status status = CV_OK;
    w->begin = (sa_run_end){SA_RUN_RANGE, SA_COLUMN_PLAIN, 0};
    for (size_t i = 0; i < w->map->count && status == CV_OK; ++i) {
        const sa_column *c = &w->map->column[i];
        long special = c->closed ? meets(w, c) : SA_COLUMN_PLAIN;
        sa_run_end end = {special == SA_COLUMN_PLAIN ? SA_RUN_RIM : SA_RUN_SPECIAL, special, c->alpha_low};
        if (!c->closed && holds(c, w->arc))
            status = walk_column(w, i, zero_mass);
        else if (w->open[zero_mass] && (!c->closed || special != SA_COLUMN_PLAIN))
            end_run(w, zero_mass, end);
        w->begin = end;
    }
    if (w->open[zero_mass])
        end_run(w, zero_mass, (sa_run_end){SA_RUN_RANGE, SA_COLUMN_PLAIN, w->map->curves.alpha_max});
    return status;
}

/* Curves that the map leaves out are looked at in the middle of the column, where zeta is the same on either
 * side. */
static cv_status look_hidden(walk *w)
{
    const double beside = 1e-9;
    for (size_t i = 0; i < w->map->count; ++i) {
        const sa_column *c = &w->map->column[i];
        double alpha = c->alpha_low + (c->alpha_high - c->alpha_low) / 2, t;
        sa_map_node node;
        sa_sample s;
        sa_wave wave;
        long double q;
        int strip, side;
        if (c->closed || holds(c, w->arc) || !arc_wave(&wave, &q, w->map, w->arc, alpha))
            continue;
        if (sa_map_node_of(&node, w->map, alpha) != CV_OK)
            return CV_FAILED;
        sa_map_locate(&strip, &side, &t, &node, (double)fabsl(q) * (1 + beside));
        sa_field_block(w->field, 0, 0, strip, side);
        cv_status status = sa_field_at_node(&s, w->field, &node, strip, side, t, 1);
        if (status != CV_OK)
            return status;
        if ((s.im > 0) == (q >= 0)) {
            w->out->hidden = 1;
            w->out->hidden_at[0] = alpha;
            w->out->hidden_at[1] = (double)fabsl(q);
        }
    }
    return CV_OK;
}

cv_status sa_curve_runs_find(sa_curve_runs *out, const sa_map *map, sa_field *field, double re_floor,
                             const sa_meeting *meeting, size_t rim_count, const double *rim)
{
    walk w = {.out = out,
              .map = map,
              .field = field,
              .re_floor = re_floor,
              .meeting = meeting,
              .rim_count = rim_count,
              .rim = rim};
    cv_status status = CV_OK;
    for (w.arc = 0; w.arc < (int)map->curves.arc_count && status == CV_OK; ++w.arc) {
        status = walk_arc(&w, 1);
        if (status == CV_OK)
            status = walk_arc(&w, 0);
        if (status == CV_OK)
            status = look_hidden(&w);
    }
    return status;
}

void sa_curve_runs_clear(sa_curve_runs *runs)
{
    free(runs->item);
    free(runs->samples.item);
    *runs = (sa_curve_runs){0};
}
