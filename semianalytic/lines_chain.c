#include <math.h>
#include <stdlib.h>

#include "semianalytic/lines_parts.h"

/* The end of piece "head" may be the beginning of piece "tail". */
typedef struct {
    double distance;
    size_t head, tail;
} joint;

typedef struct {
    const sa_line_trace *trace;
    size_t *order; /* pieces by the edge of their last sample */
    size_t joint_count, joint_room;
    joint *joint;
    size_t *next, *previous; /* piece, or NONE */
} chaining;

static const size_t NONE = (size_t)-1;

/* Order of the lines that edges lie on. */
static int compare_ids(const sa_line_edge *a, const sa_line_edge *b)
{
    if (a->kind != b->kind)
        return a->kind > b->kind ? 1 : -1;
    for (int i = 0; i < 4; ++i)
        if (a->id[i] != b->id[i])
            return a->id[i] > b->id[i] ? 1 : -1;
    return 0;
}

typedef struct {
    sa_line_edge edge;
    size_t piece;
} key;

static int by_edge(const void *left, const void *right)
{
    const key *a = left, *b = right;
    int c = compare_ids(&a->edge, &b->edge);
    if (c != 0)
        return c;
    if (a->edge.fixed != b->edge.fixed)
        return a->edge.fixed > b->edge.fixed ? 1 : -1;
    return (a->piece > b->piece) - (a->piece < b->piece);
}

static cv_status sort_pieces(chaining *c)
{
    size_t n = c->trace->piece_count;
    key *keys = calloc(n + 1, sizeof *keys);
    if (keys == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < n; ++i)
        keys[i] = (key){c->trace->piece[i].edge[1], i};
    qsort(keys, n, sizeof *keys, by_edge);
    for (size_t i = 0; i < n; ++i)
        c->order[i] = keys[i].piece;
    free(keys);
    return CV_OK;
}

static cv_status add_joint(chaining *c, joint j)
{
    if (c->joint_count == c->joint_room) {
        size_t room = 2 * c->joint_room + 256;
        joint *more = realloc(c->joint, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        c->joint = more;
        c->joint_room = room;
    }
    c->joint[c->joint_count++] = j;
    return CV_OK;
}

/* Distance of the zeros of two stretches of one edge, in parts of the larger stretch; infinite when the
 * stretches have nothing in common: the zeros are then not the same. */
static double zero_distance(const sa_line_edge *a, const sa_line_edge *b)
{
    const double touching = 1e-6;
    double larger = fmax(a->high - a->low, b->high - b->low);
    double overlap = fmin(a->high, b->high) - fmax(a->low, b->low);
    double distance = fabs(a->at - b->at) / larger;
    return overlap > 1e-3 * fmin(a->high - a->low, b->high - b->low) || distance < touching
               ? distance
               : (double)INFINITY;
}

/* All pieces that may end where this one begins. */
static cv_status joints_of(chaining *c, size_t tail)
{
    const sa_line_piece *piece = c->trace->piece;
    const sa_line_edge *from = &piece[tail].edge[0];
    size_t low = 0, high = c->trace->piece_count;
    if (from->kind == SA_EDGE_NONE)
        return CV_OK;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const sa_line_edge *edge = &piece[c->order[middle]].edge[1];
        int order = compare_ids(edge, from);
        if (order < 0 || (order == 0 && edge->fixed < from->fixed - SA_SAME_EDGE))
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < c->trace->piece_count; ++low) {
        const sa_line_edge *edge = &piece[c->order[low]].edge[1];
        if (compare_ids(edge, from) != 0 || edge->fixed > from->fixed + SA_SAME_EDGE)
            break;
        double distance = zero_distance(edge, from);
        if (isfinite(distance) && add_joint(c, (joint){distance, c->order[low], tail}) != CV_OK)
            return CV_FAILED;
    }
    return CV_OK;
}

static int by_distance(const void *left, const void *right)
{
    const joint *a = left, *b = right;
    if (a->distance != b->distance)
        return a->distance > b->distance ? 1 : -1;
    return a->tail != b->tail ? (a->tail > b->tail) - (a->tail < b->tail)
                              : (a->head > b->head) - (a->head < b->head);
}

static cv_status join(chaining *c)
{
    cv_status status = sort_pieces(c);
    for (size_t i = 0; i < c->trace->piece_count && status == CV_OK; ++i) {
        c->next[i] = c->previous[i] = NONE;
        status = joints_of(c, i);
    }
    if (status != CV_OK)
        return status;
    if (c->joint_count > 0)
        qsort(c->joint, c->joint_count, sizeof *c->joint, by_distance);
    for (size_t i = 0; i < c->joint_count; ++i) {
        const joint *j = &c->joint[i];
        if (c->next[j->head] == NONE && c->previous[j->tail] == NONE) {
            c->next[j->head] = j->tail;
            c->previous[j->tail] = j->head;
        }
    }
    return CV_OK;
}

/* Moves the samples of all pieces from "piece" on into one line. */
static cv_status unroll(sa_line *line, sa_line_samples *samples, chaining *c, size_t piece, char *used)
{
    *line = (sa_line){.first = samples->count};
    for (; piece != NONE && !used[piece]; piece = c->next[piece]) {
        const sa_line_piece *p = &c->trace->piece[piece];
        used[piece] = 1;
        /* the first sample repeats the last one of the piece before */
        for (size_t i = c->previous[piece] == NONE ? 0 : 1; i < p->count; ++i)
            if (sa_line_samples_add(samples, &c->trace->samples.item[p->first + i]) != CV_OK)
                return CV_FAILED;
    }
    line->closed = piece != NONE;
    line->count = samples->count - line->first;
    return CV_OK;
}

cv_status sa_lines_chain(sa_line **line, size_t *line_count, sa_line_samples *samples,
                         const sa_line_trace *trace)
{
    size_t n = trace->piece_count;
    chaining c = {.trace = trace};
    c.order = calloc(n + 1, sizeof *c.order);
    c.next = calloc(n + 1, sizeof *c.next);
    c.previous = calloc(n + 1, sizeof *c.previous);
    char *used = calloc(n + 1, 1);
    *line = calloc(n + 1, sizeof **line);
    *line_count = 0;
    cv_status status = CV_FAILED;
    if (c.order != NULL && c.next != NULL && c.previous != NULL && used != NULL && *line != NULL)
        status = join(&c);
    for (int closed = 0; closed < 2; ++closed) /* open lines from their beginnings, then what is left */
        for (size_t i = 0; i < n && status == CV_OK; ++i)
            if (!used[i] && (closed || c.previous[i] == NONE))
                status = unroll(&(*line)[(*line_count)++], samples, &c, i, used);
    free(c.order);
    free(c.next);
    free(c.previous);
    free(c.joint);
    free(used);
    return status;
}
