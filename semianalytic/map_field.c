#include "semianalytic/map_field.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 1 << 11, SAMPLES = 1 << 13, SWEEPS = 32 };

/* Warm starts are kept for several places at once, because cells are visited in no smooth order. */
typedef struct {
    sa_sweep *sweep;
    double x, y;         /* where it was used last, natural logarithms within its block */
    unsigned long block; /* 0: never */
    unsigned long used;
} warm_start;

typedef struct {
    unsigned long stamp; /* of the side of a column; 0: free */
    double u;
    sa_map_node node;
} node_slot;

typedef struct {
    unsigned long stamp; /* of the block; 0: free */
    sa_sample sample;
} sample_slot;

struct sa_field {
    const sa_map *map;
    const sa_track *track;
    double re_floor, resolution;
    size_t column;
    int side_u, strip, side_t;
    unsigned long column_stamp, block_stamp, clock;
    size_t node_count, sample_count;
    node_slot *nodes;
    sample_slot *samples;
    sa_map_node spare;
    warm_start warm[SWEEPS];
};

sa_field *sa_field_new(const sa_map *map, const sa_track *track, double re_floor)
{
    sa_field *f = calloc(1, sizeof *f);
    if (f == NULL)
        return NULL;
    f->map = map;
    f->track = track;
    f->re_floor = re_floor;
    f->resolution = SA_FIELD_RESOLUTION;
    f->nodes = calloc(NODES, sizeof *f->nodes);
    f->samples = calloc(SAMPLES, sizeof *f->samples);
    int complete = f->nodes != NULL && f->samples != NULL;
    for (int i = 0; i < SWEEPS; ++i) {
        f->warm[i].sweep = sa_sweep_new();
        complete = complete && f->warm[i].sweep != NULL;
    }
    if (complete)
        return f;
    sa_field_free(f);
    return NULL;
}

void sa_field_free(sa_field *field)
{
    if (field == NULL)
        return;
    for (int i = 0; i < SWEEPS; ++i)
        sa_sweep_free(field->warm[i].sweep);
    free(field->nodes);
    free(field->samples);
    free(field);
}

sa_counts sa_field_counts(const sa_field *field)
{
    sa_counts sum = {0};
    for (int i = 0; i < SWEEPS; ++i) {
        sa_counts c = sa_sweep_counts(field->warm[i].sweep);
        sum.evaluations += c.evaluations;
        sum.cold_starts += c.cold_starts;
        sum.beyond_double += c.beyond_double;
        if (c.largest_precision > sum.largest_precision)
            sum.largest_precision = c.largest_precision;
    }
    return sum;
}

void sa_field_resolution(sa_field *field, double resolution)
{
    field->resolution = resolution;
}

void sa_field_block(sa_field *field, size_t column, int side_u, int strip, int side_t)
{
    if (column != field->column || side_u != field->side_u || field->column_stamp == 0) {
        ++field->column_stamp;
        field->node_count = 0;
    }
    ++field->block_stamp;
    field->sample_count = 0;
    field->column = column;
    field->side_u = side_u;
    field->strip = strip;
    field->side_t = side_t;
}

static size_t hash(double u, double t, size_t size)
{
    uint64_t a, b;
    memcpy(&a, &u, sizeof a);
    memcpy(&b, &t, sizeof b);
    a = a * UINT64_C(0x9E3779B97F4A7C15) ^ (b + UINT64_C(0x7F4A7C15)) * UINT64_C(0xC2B2AE3D27D4EB4F);
    return (size_t)(a >> 32) % size;
}

const sa_map_node *sa_field_node(sa_field *field, double u)
{
    size_t i = hash(u, 0, NODES);
    sa_map_node *node = &field->spare;
    for (; field->nodes[i].stamp == field->column_stamp; i = (i + 1) % NODES)
        if (field->nodes[i].u == u)
            return &field->nodes[i].node;
    if (field->node_count < NODES * 3 / 4) {
        ++field->node_count;
        field->nodes[i].stamp = field->column_stamp;
        field->nodes[i].u = u;
        node = &field->nodes[i].node;
    }
    if (sa_map_node_at(node, field->map, field->column, field->side_u, u) == CV_OK)
        return node;
    field->nodes[i].stamp = 0;
    return NULL;
}

/* Where a point lies, for the warm starts. */
typedef struct {
    const sa_map_node *node;
    int strip, side_t;
    double t, extent_t;
    double x, y;
} place;

/* The warm start used nearest to here in this block, else the one unused for longest. Poles depend on the
 * distance to the curve (y) more than on that to the special velocity (x). */
static warm_start *choose(sa_field *field, const place *here)
{
    const double weight_x = 0.3;
    warm_start *best = NULL, *oldest = &field->warm[0];
    double nearest = INFINITY;
    for (int i = 0; i < SWEEPS; ++i) {
        warm_start *w = &field->warm[i];
        double distance = weight_x * fabs(w->x - here->x) + fabs(w->y - here->y);
        if (w->block == field->block_stamp && distance < nearest) {
            nearest = distance;
            best = w;
        }
        if (w->used < oldest->used)
            oldest = w;
    }
    if (best == NULL) {
        best = oldest;
        best->y = here->y;
    }
    return best;
}

/* Follows the poles in steps that keep them in Newton's reach, which is much cheaper than a cold start. */
static void approach(sa_field *field, warm_start *warm, const place *here)
{
    const double longest = 3;
    double from = warm->y;
    int steps = (int)(fabs(here->y - from) / longest);
    for (int i = 1; i <= steps; ++i) {
        sa_map_point point;
        sa_value ignored;
        double y = from + (here->y - from) * i / (steps + 1);
        sa_map_point_at(&point, here->node, here->strip, here->side_t, y / here->extent_t);
        (void)sa_zeta_double(&ignored, warm->sweep, field->track, point.alpha, point.q);
    }
    warm->x = here->x;
    warm->y = here->y;
    warm->block = field->block_stamp;
    warm->used = ++field->clock;
}

/* What a sample must tell: at a corner of a cell the sign of Im zeta, on a line Im zeta = 0 its place. */
typedef enum { SIGN, PLACE } purpose;

static void set_sample(sa_sample *s, const sa_value *v, const sa_map_point *point)
{
    s->re = v->re;
    s->im = v->im;
    s->re_error = v->re_error;
    s->im_error = v->im_error;
    s->re_alpha = creal(v->d_alpha);
    s->im_alpha = cimag(v->d_alpha);
    s->re_q = creal(v->d_q);
    s->im_q = cimag(v->d_q);
    s->re_u = s->re_alpha * point->alpha_u + s->re_q * point->q_u;
    s->im_u = s->im_alpha * point->alpha_u + s->im_q * point->q_u;
    s->re_t = s->re_q * point->q_t;
    s->im_t = s->im_q * point->q_t;
}

/* Double precision tells what is needed. Nothing is where Re zeta is below the floor. */
static int sufficient(const sa_sample *s, const sa_field *field, purpose why, double accuracy)
{
    int placed = why == PLACE && s->im_error < field->resolution * hypot(s->im_u, s->im_t);
    if (s->re + s->re_error < field->re_floor)
        return 1;
    return s->re_error < accuracy * fmax(fabs(s->re), field->re_floor) &&
           (placed || s->im_error < 0.1 * fabs(s->im));
}

static cv_status evaluate(sa_sample *s, sa_field *field, const place *here, purpose why)
{
    const double lowest_q = 1e-9, nudge = 1e-13, accuracy = why == PLACE ? field->resolution : 0.01;
    const sa_need need = {.re_rel = accuracy,
                          .re_abs = accuracy * field->re_floor,
                          .im_rel = 0.1,
                          .im_share = why == PLACE ? 1e-24 : 0};
    sa_value v;
    sa_map_point point;
    warm_start *warm = choose(field, here);
    sa_map_point_at(&point, here->node, here->strip, here->side_t, here->t);
    approach(field, warm, here);
    s->alpha = point.alpha;
    s->q = fmax(point.q, lowest_q);
    cv_status status = sa_zeta_double(&v, warm->sweep, field->track, s->alpha, s->q);
    if (status == CV_OK) {
        set_sample(s, &v, &point);
        if (sufficient(s, field, why, accuracy))
            return CV_OK;
    } else if (status != CV_UNDECIDED) {
        return status;
    }
    status = sa_zeta_needed(&v, warm->sweep, field->track, s->alpha, s->q, &need);
    if (status == CV_UNDECIDED) { /* a pole at infinity, at the shear speed and nowhere else */
        s->alpha *= 1 + nudge;
        status = sa_zeta_needed(&v, warm->sweep, field->track, s->alpha, s->q, &need);
    }
    if (status == CV_OK)
        set_sample(s, &v, &point);
    return status;
}

cv_status sa_field_at_node(sa_sample *out, sa_field *field, const sa_map_node *node, int strip, int side_t,
                           double t, int certain)
{
    double extent = sa_map_strip_extent(node, strip, side_t);
    place here = {node, strip, side_t, t, extent, 0, t * extent};
    out->u = 0;
    out->t = t;
    return evaluate(out, field, &here, certain ? SIGN : PLACE);
}

static cv_status at(sa_sample *out, sa_field *field, double u, double t, int certain)
{
    const sa_map_node *node = sa_field_node(field, u);
    if (node == NULL)
        return CV_FAILED;
    double extent = sa_map_strip_extent(node, field->strip, field->side_t);
    place here = {node, field->strip, field->side_t, t, extent, 0, t * extent};
    here.x = u * sa_map_column_extent(&field->map->column[field->column], field->side_u);
    out->u = u;
    out->t = t;
    return evaluate(out, field, &here, certain ? SIGN : PLACE);
}

cv_status sa_field_at(sa_sample *out, sa_field *field, double u, double t)
{
    return at(out, field, u, t, 0);
}

cv_status sa_field_corner(sa_sample *out, sa_field *field, double u, double t)
{
    size_t i = hash(u, t, SAMPLES);
    for (; field->samples[i].stamp == field->block_stamp; i = (i + 1) % SAMPLES)
        if (field->samples[i].sample.u == u && field->samples[i].sample.t == t) {
            *out = field->samples[i].sample;
            return CV_OK;
        }
    cv_status status = at(out, field, u, t, 1);
    if (status == CV_OK && field->sample_count < SAMPLES * 3 / 4) {
        ++field->sample_count;
        field->samples[i].stamp = field->block_stamp;
        field->samples[i].sample = *out;
    }
    return status;
}
