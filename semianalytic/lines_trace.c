#include <math.h>
#include <stdlib.h>

#include "semianalytic/lines_parts.h"

/* A point of a segment: x of its axis. */
typedef struct {
    double x;
    sa_sample at;
} station;

typedef struct {
    sa_line_trace *trace;
    sa_field *field;
    const sa_segment *segment;
} walk;

cv_status sa_line_samples_add(sa_line_samples *list, const sa_line_sample *item)
{
    if (list->count == list->room) {
        size_t room = 2 * list->room + 1024;
        sa_line_sample *more = realloc(list->item, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        list->item = more;
        list->room = room;
    }
    list->item[list->count++] = *item;
    return CV_OK;
}

cv_status sa_line_place_add(double (**place)[2], size_t *count, double alpha, double q)
{
    double(*more)[2] = realloc(*place, (*count + 1) * sizeof *more);
    if (more == NULL)
        return CV_FAILED;
    more[*count][0] = alpha;
    more[*count][1] = q;
    *place = more;
    ++*count;
    return CV_OK;
}

static cv_status append(const walk *w, const sa_sample *s, int marks)
{
    const sa_line_sample item = {.alpha = s->alpha,
                                 .q = s->q,
                                 .re = s->re,
                                 .re_alpha = s->re_alpha,
                                 .re_q = s->re_q,
                                 .im_alpha = s->im_alpha,
                                 .im_q = s->im_q,
                                 .marks = marks};
    return sa_line_samples_add(&w->trace->samples, &item);
}

/* The functions along a segment whose zeros become samples. */
typedef enum { AT_FLOOR, AT_LOW, AT_HIGH, EXTREME, TURN, EVENTS } event;

static double event_value(const walk *w, const sa_sample *s, event e)
{
    switch (e) {
    case AT_FLOOR:
        return s->re - w->trace->re_floor;
    case AT_LOW:
        return s->re - w->trace->plot.re_low;
    case AT_HIGH:
        return s->re - w->trace->plot.re_high;
    case EXTREME:
        return s->re_q * s->im_alpha - s->re_alpha * s->im_q;
    default:
        return s->im_q;
    }
}

static int event_marks(const walk *w, const station *a, event e)
{
    if (e == AT_FLOOR)
        return 0;
    if (e == AT_LOW || e == AT_HIGH)
        return SA_MARK_CUT;
    if (e == TURN)
        return SA_MARK_TURN;
    return sa_segment_slope(w->segment, &a->at) > 0 ? SA_MARK_LEAST_MASS : SA_MARK_MOST_MASS;
}

/* The zero of an event between a and b, where its signs differ: false position with halved weights. */
static cv_status locate(station *out, const walk *w, const station *a, const station *b, event e)
{
    double x0 = a->x, x1 = b->x, f0 = event_value(w, &a->at, e), f1 = event_value(w, &b->at, e);
    for (int i = 0, side = 0; i < 60 && fabs(x1 - x0) > 1e-13; ++i) {
        out->x = x0 + (x1 - x0) * f0 / (f0 - f1);
        cv_status status = sa_segment_point(&out->at, w->trace->sharp, w->segment, out->x);
        if (status != CV_OK)
            return status;
        double f = event_value(w, &out->at, e);
        if (fabs(f) <= 1e-13 * (fabs(f0) + fabs(f1)) || f == 0)
            break;
        if ((f > 0) == (f0 > 0)) {
            x0 = out->x;
            f0 = f;
            f1 = side == 1 ? f1 / 2 : f1;
            side = 1;
        } else {
            x1 = out->x;
            f1 = f;
            f0 = side == -1 ? f0 / 2 : f0;
            side = -1;
        }
    }
    return CV_OK;
}

/* a has been appended: the events between a and b in their order, then b. */
static cv_status append_events(const walk *w, const station *a, const station *b)
{
    station found[EVENTS];
    int marks[EVENTS], n = 0;
    for (event e = AT_FLOOR; e < EVENTS; ++e) {
        double f0 = event_value(w, &a->at, e), f1 = event_value(w, &b->at, e);
        if ((f0 > 0) == (f1 > 0))
            continue;
        station s = *a;
        cv_status status = locate(&s, w, a, b, e);
        if (status != CV_OK)
            return status;
        int i = n++;
        for (; i > 0 && found[i - 1].x > s.x; --i) {
            found[i] = found[i - 1];
            marks[i] = marks[i - 1];
        }
        found[i] = s;
        marks[i] = event_marks(w, a, e);
    }
    cv_status status = CV_OK;
    for (int i = 0; i < n && status == CV_OK; ++i)
        status = append(w, &found[i].at, marks[i]);
    return status == CV_OK ? append(w, &b->at, 0) : status;
}

static double log_re(const walk *w, const sa_sample *s)
{
    return log(fmax(s->re, 0.1 * w->trace->re_floor));
}

static double chord_error(const walk *w, const sa_sample *a, const sa_sample *m, const sa_sample *b)
{
    const sa_line_plot *plot = &w->trace->plot;
    double x = (b->alpha - a->alpha) / plot->alpha_span, y = (log_re(w, b) - log_re(w, a)) / plot->log_span;
    double u = (m->alpha - a->alpha) / plot->alpha_span, v = (log_re(w, m) - log_re(w, a)) / plot->log_span;
    double length2 = x * x + y * y, along = length2 > 0 ? (u * x + v * y) / length2 : 0;
    along = fmin(fmax(along, 0), 1);
    return hypot(u - along * x, v - along * y);
}

static int in_plot(const walk *w, const sa_sample *s)
{
    const sa_line_plot *plot = &w->trace->plot;
    return s->re > plot->re_low && s->re < plot->re_high;
}

/* What the cubic through values and slopes of log Re zeta says of the middle is what is found there. */
static int smooth(const walk *w, const sa_sample *a, const sa_sample *m, const sa_sample *b, double h)
{
    const double tolerance = 0.02;
    if (!(a->re > 0 && m->re > 0 && b->re > 0))
        return a->re < w->trace->re_floor && b->re < w->trace->re_floor;
    double f0 = log(a->re), f1 = log(m->re), f2 = log(b->re);
    double g0 = sa_segment_slope(w->segment, a) / a->re * h, g1 = sa_segment_slope(w->segment, m) / m->re * h,
           g2 = sa_segment_slope(w->segment, b) / b->re * h;
    return fabs(f1 - (f0 + f2) / 2 - (g0 - g2) / 8) < tolerance &&
           fabs(g1 - 1.5 * (f2 - f0) + (g0 + g2) / 4) < 4 * tolerance;
}

static int accepted(const walk *w, const station *a, const station *m, const station *b)
{
    const double chord = 2.5e-4, longest = 0.1;
    if (!smooth(w, &a->at, &m->at, &b->at, b->x - a->x))
        return 0;
    if (!in_plot(w, &a->at) && !in_plot(w, &m->at) && !in_plot(w, &b->at))
        return 1;
    return chord_error(w, &a->at, &m->at, &b->at) < chord &&
           fabs(b->at.alpha - a->at.alpha) < longest * w->trace->plot.alpha_span;
}

static cv_status divide(const walk *w, const station *a, const station *b, int depth)
{
    enum { DEEPEST = 24 };
    station m = {.x = (a->x + b->x) / 2};
    cv_status status = sa_segment_point(&m.at, w->field, w->segment, m.x);
    if (status == CV_OK && in_plot(w, &m.at))
        status = sa_segment_point(&m.at, w->trace->sharp, w->segment, m.x);
    if (status != CV_OK)
        return status;
    int leaf = depth >= DEEPEST || accepted(w, a, &m, b);
    status = leaf ? append_events(w, a, &m) : divide(w, a, &m, depth + 1);
    if (status == CV_OK)
        status = leaf ? append_events(w, &m, b) : divide(w, &m, b, depth + 1);
    return status;
}

/* 1 when N is larger by 2 to the left of the way from "from" to "to": Im zeta falls to the left in (alpha,
 * q).
 */
static int in_direction(const sa_segment *s)
{
    int turned = (s->side_u != 0) != (s->side_t != 0);
    double slope =
        s->axis == 0 ? -s->from.im_t * (s->to.u - s->from.u) : s->from.im_u * (s->to.t - s->from.t);
    return (slope > 0) != turned;
}

static void reverse(sa_line_sample *item, size_t count)
{
    for (size_t i = 0; i < count / 2; ++i) {
        sa_line_sample swap = item[i];
        item[i] = item[count - 1 - i];
        item[count - 1 - i] = swap;
    }
}

/* Number of the boundary of a column; a closed column (map.h) is so narrow that both of its are one. */
static long boundary(const sa_map *map, size_t column, int side_u)
{
    size_t i = column + (size_t)side_u;
    return (long)(i < map->count && map->column[i].closed ? i + 1 : i);
}

/* Along the boundary of two columns strips differ: there the coordinate is q. */
static cv_status column_edge(sa_line_edge *edge, const sa_map *map, sa_field *field, const sa_segment *s,
                             double q)
{
    sa_map_point low, high;
    const sa_map_node *node = sa_field_node(field, 0);
    if (node == NULL)
        return CV_FAILED;
    sa_map_point_at(&low, node, s->strip, s->side_t, edge->low);
    sa_map_point_at(&high, node, s->strip, s->side_t, edge->high);
    *edge = (sa_line_edge){.kind = SA_EDGE_COLUMN,
                           .id = {boundary(map, s->column, s->side_u)},
                           .low = fmin(low.q, high.q),
                           .high = fmax(low.q, high.q),
                           .at = q};
    return CV_OK;
}

/* No line goes on beyond the gap of a curve. */
static int at_gap(const sa_line_edge *edge, const sa_map *map, sa_field *field, const sa_segment *s, double u)
{
    const sa_map_node *node = map->undamped && edge->fixed == 0 ? sa_field_node(field, u) : NULL;
    return node != NULL && node->gap[s->strip + s->side_t] > 0;
}

static cv_status make_edge(sa_line_edge *edge, const sa_map *map, sa_field *field, const sa_segment *s,
                           int end)
{
    const sa_sample *at = end == 0 ? &s->from : &s->to;
    int along_t = s->edge[end].along;
    *edge = (sa_line_edge){.kind = along_t ? SA_EDGE_ALONG_T : SA_EDGE_ALONG_U,
                           .id = {(long)s->column, s->side_u, s->strip, s->side_t},
                           .fixed = along_t ? at->u : at->t,
                           .low = s->edge[end].low,
                           .high = s->edge[end].high,
                           .at = along_t ? at->t : at->u};
    if (along_t && edge->fixed == 0)
        return column_edge(edge, map, field, s, at->q);
    if (!along_t && at_gap(edge, map, field, s, at->u))
        edge->kind = SA_EDGE_NONE;
    if (edge->fixed > 1 - SA_SAME_EDGE) /* the middle of a column or of a strip */
        edge->id[along_t ? 1 : 3] = 0;
    if (!along_t && edge->fixed == 0 && s->side_t == 1) {
        ++edge->id[2]; /* the curve above a strip is below the next */
        edge->id[3] = 0;
    }
    return CV_OK;
}

static cv_status add_piece(sa_line_trace *trace, const sa_line_piece *piece)
{
    if (trace->piece_count == trace->piece_room) {
        size_t room = 2 * trace->piece_room + 256;
        sa_line_piece *more = realloc(trace->piece, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        trace->piece = more;
        trace->piece_room = room;
    }
    trace->piece[trace->piece_count++] = *piece;
    return CV_OK;
}

/* The parts of a piece with Re zeta above the floor; where it sinks below, that is an end on no edge. */
static cv_status add_parts(sa_line_trace *trace, const sa_line_piece *piece)
{
    const sa_line_sample *s = &trace->samples.item[piece->first];
    const double twice = 2 * trace->re_floor;
    cv_status status = CV_OK;
    for (size_t i = 0; i + 1 < piece->count && status == CV_OK;) {
        size_t from = i;
        while (i + 1 < piece->count && s[i].re + s[i + 1].re > twice)
            ++i;
        if (i == from) {
            ++i;
            continue;
        }
        sa_line_piece part = {.first = piece->first + from, .count = i + 1 - from};
        part.edge[0] = from == 0 ? piece->edge[0] : (sa_line_edge){.kind = SA_EDGE_NONE};
        part.edge[1] = i + 1 == piece->count ? piece->edge[1] : (sa_line_edge){.kind = SA_EDGE_NONE};
        status = add_piece(trace, &part);
    }
    return status;
}

static cv_status on_segment(void *context, sa_field *field, const sa_segment *segment)
{
    sa_line_trace *trace = context;
    walk w = {trace, field, segment};
    sa_line_piece piece = {.first = trace->samples.count};
    station end[2] = {{0, segment->from}, {1, segment->to}};
    int forward = in_direction(segment);
    sa_field_block(trace->sharp, segment->column, segment->side_u, segment->strip, segment->side_t);
    cv_status status = make_edge(&piece.edge[!forward], trace->map, field, segment, 0);
    if (status == CV_OK)
        status = make_edge(&piece.edge[forward], trace->map, field, segment, 1);
    for (int i = 0; i < 2 && status == CV_OK; ++i)
        if (in_plot(&w, &end[i].at))
            status = sa_segment_point(&end[i].at, trace->sharp, segment, end[i].x);
    if (status == CV_OK)
        status = append(&w, &end[0].at, 0);
    if (status == CV_OK)
        status = divide(&w, &end[0], &end[1], 0);
    if (status != CV_OK)
        return status;
    piece.count = trace->samples.count - piece.first;
    if (!forward)
        reverse(&trace->samples.item[piece.first], piece.count);
    return add_parts(trace, &piece);
}

static cv_status on_unresolved(void *context, const sa_sample *centre, double re_range)
{
    sa_line_trace *trace = context;
    if (centre->re + 2 * re_range < trace->re_floor)
        return CV_OK;
    return sa_line_place_add(&trace->place, &trace->place_count, centre->alpha, centre->q);
}

cv_status sa_lines_trace(sa_line_trace *trace, sa_field *field, int refinement, const sa_line_effort *effort)
{
    sa_search search = {.re_low = trace->re_floor,
                        .re_high = INFINITY,
                        .tolerance = 0.25,
                        .largest_cell = 2.5,
                        .cells = effort->cells,
                        .beyond_double = effort->beyond_double,
                        .context = trace,
                        .segment = on_segment,
                        .unresolved = on_unresolved};
    for (int i = 0; i < refinement; ++i) {
        search.tolerance /= 2;
        search.largest_cell /= 1.7; /* not a multiple: other cells, not only smaller ones */
    }
    return sa_map_search(trace->map, field, &search);
}

void sa_line_trace_clear(sa_line_trace *trace)
{
    free(trace->samples.item);
    free(trace->piece);
    free(trace->place);
    *trace = (sa_line_trace){.map = trace->map, .plot = trace->plot, .re_floor = trace->re_floor};
}
