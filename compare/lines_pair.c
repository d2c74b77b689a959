#include "compare/lines.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* Branches further apart, in parts of the range, are not one branch found twice. */
static const double PAIR_DISTANCE = 0.02;
/* Weight of log q beside the plot's coordinates: the chord error of q is not controlled, but lines that cross
 * in the plot differ in q. */
static const double WEIGHT_OF_Q = 0.05;
/* Between branches that are near one another everywhere those with the same ends belong together. */
static const double OTHER_ENDS = 5e-4;
/* Polylines may be off their line by so much. */
static const double CHORD_ERROR = 1e-3;

/* A vertex in the plot; coordinates in parts of the range, and log q with its weight. */
typedef struct {
    double x[3];
} place;

typedef struct {
    size_t count;
    place *at;
    double low[2], high[2]; /* of the first two coordinates */
} polyline;

static int polyline_init(polyline *out, const cmp_branch *b, const cmp_branches *in)
{
    const double width = in->alpha_max - in->alpha_min, height = log(in->mass_max / in->mass_min);
    *out = (polyline){
        b->count, malloc((b->count + 1) * sizeof *out->at), {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (size_t i = 0; out->at != NULL && i < b->count; i++) {
        const cmp_line_point *v = &b->vertices[i];
        place *p = &out->at[i];
        *p = (place){{(mpfr_get_d(v->alpha, MPFR_RNDN) - in->alpha_min) / width,
                      log(mpfr_get_d(v->eta_M, MPFR_RNDN) / in->mass_min) / height,
                      WEIGHT_OF_Q * log(mpfr_get_d(v->q, MPFR_RNDN))}};
        for (int k = 0; k < 2; k++) {
            out->low[k] = fmin(out->low[k], p->x[k]);
            out->high[k] = fmax(out->high[k], p->x[k]);
        }
    }
    return out->at != NULL;
}

static double step_length(const place *a, const place *b)
{
    return hypot(b->x[0] - a->x[0], b->x[1] - a->x[1]);
}

/* Whether the step a -> b does not run against the step c -> d, in the plot. A step shorter than polylines
 * may be off has no direction to speak of. */
static int along(const place *a, const place *b, const place *c, const place *d)
{
    return (b->x[0] - a->x[0]) * (d->x[0] - c->x[0]) + (b->x[1] - a->x[1]) * (d->x[1] - c->x[1]) >= 0 ||
           step_length(a, b) < CHORD_ERROR;
}

/* Whether the step c -> d runs with the polyline before or after its vertex i. */
static int runs_with(const polyline *p, size_t i, const place *c, const place *d)
{
    return p->count < 2 || (i > 0 && along(&p->at[i - 1], &p->at[i], c, d)) ||
           (i + 1 < p->count && along(&p->at[i], &p->at[i + 1], c, d));
}

/* Distance of p from the step c -> d in the first two or in all three coordinates. */
static double distance_to_step(const place *p, const place *c, const place *d, int coordinates)
{
    double length = 0, part = 0, sum = 0;
    for (int k = 0; k < coordinates; k++) {
        length += (d->x[k] - c->x[k]) * (d->x[k] - c->x[k]);
        part += (d->x[k] - c->x[k]) * (p->x[k] - c->x[k]);
    }
    part = length > 0 ? fmin(fmax(part / length, 0), 1) : 0;
    for (int k = 0; k < coordinates; k++) {
        const double gap = p->x[k] - c->x[k] - part * (d->x[k] - c->x[k]);
        sum += gap * gap;
    }
    return sqrt(sum);
}

/* Largest distance of a vertex of a from b; stops above PAIR_DISTANCE. NaN coordinates are infinitely far. */
static double reach_of(const polyline *a, const polyline *b, int coordinates)
{
    double largest = 0;
    for (size_t i = 0; i < a->count && largest <= PAIR_DISTANCE; i++) {
        double nearest =
            b->count == 1 ? distance_to_step(&a->at[i], &b->at[0], &b->at[0], coordinates) : HUGE_VAL;
        for (size_t k = 0; k + 1 < b->count; k++)
            if (runs_with(a, i, &b->at[k], &b->at[k + 1]))
                nearest = fmin(nearest, distance_to_step(&a->at[i], &b->at[k], &b->at[k + 1], coordinates));
        largest = fmax(largest, isnan(nearest) ? HUGE_VAL : nearest);
    }
    return largest;
}

static double distance(const polyline *a, const polyline *b, int coordinates)
{
    for (int k = 0; k < 2; k++)
        if (!(fabs(a->low[k] - b->low[k]) <= PAIR_DISTANCE) ||
            !(fabs(a->high[k] - b->high[k]) <= PAIR_DISTANCE))
            return HUGE_VAL;
    const double there = reach_of(a, b, coordinates);
    return there <= PAIR_DISTANCE ? fmax(there, reach_of(b, a, coordinates)) : there;
}

static int same_ends(const cmp_branch *a, const cmp_branch *b)
{
    return a->ends[0].kind == b->ends[0].kind && a->ends[1].kind == b->ends[1].kind;
}

/* Distances of all branches of one list from all of the other. */
typedef struct {
    size_t rows, columns;
    double *at, *in_plot; /* with and without q */
} matrix;

static int all_polylines(polyline *out, const cmp_branches *in)
{
    int done = 1;
    for (size_t i = 0; i < in->count; i++)
        done &= polyline_init(&out[i], &in->branches[i], in);
    return done;
}

static int matrix_init(matrix *m, const cmp_branches lists[])
{
    polyline *p[CMP_METHODS];
    int done = 1;
    *m = (matrix){lists[0].count, lists[1].count, NULL, NULL};
    for (int k = 0; k < CMP_METHODS; k++) {
        p[k] = calloc(lists[k].count + 1, sizeof *p[k]);
        done = done && p[k] != NULL && all_polylines(p[k], &lists[k]);
    }
    m->at = malloc((m->rows * m->columns + 1) * sizeof *m->at);
    m->in_plot = malloc((m->rows * m->columns + 1) * sizeof *m->in_plot);
    done = done && m->at != NULL && m->in_plot != NULL;
    for (size_t i = 0; done && i < m->rows; i++)
        for (size_t j = 0; j < m->columns; j++) {
            m->at[i * m->columns + j] = distance(&p[0][i], &p[1][j], 3);
            m->in_plot[i * m->columns + j] = distance(&p[0][i], &p[1][j], 2);
        }
    for (int k = 0; k < CMP_METHODS; k++) {
        for (size_t i = 0; p[k] != NULL && i < lists[k].count; i++)
            free(p[k][i].at);
        free(p[k]);
    }
    return done;
}

static void matrix_clear(matrix *m)
{
    free(m->at);
    free(m->in_plot);
}

/* Index of the smallest of count values, "step" apart, with what other ends add; SIZE_MAX: all too large. */
static size_t nearest(const matrix *m, const cmp_branches lists[], int of, size_t index)
{
    const size_t count = of == 0 ? m->columns : m->rows;
    size_t best = SIZE_MAX;
    double smallest = HUGE_VAL;
    for (size_t k = 0; k < count; k++) {
        const size_t i = of == 0 ? index : k, j = of == 0 ? k : index;
        const double plain = m->at[i * m->columns + j];
        const double d = plain + (same_ends(&lists[0].branches[i], &lists[1].branches[j]) ? 0 : OTHER_ENDS);
        if (plain <= PAIR_DISTANCE && d < smallest) {
            best = k;
            smallest = d;
        }
    }
    return best;
}

static cmp_branch_pair pair_of(const cmp_branch *a, const cmp_branch *b, double plot_distance)
{
    cmp_branch_pair pair = {.by = {a, b}, .plot_distance = plot_distance};
    cmp_verdict_init(&pair.verdict);
    return pair;
}

static double lowest_velocity(const cmp_branch_pair *p)
{
    const cmp_branch *b = p->by[0] != NULL ? p->by[0] : p->by[1];
    double lowest = HUGE_VAL;
    for (size_t i = 0; i < b->count; i++)
        lowest = fmin(lowest, mpfr_get_d(b->vertices[i].alpha, MPFR_RNDN));
    return lowest;
}

static int by_velocity(const void *x, const void *y)
{
    const double a = lowest_velocity(x), b = lowest_velocity(y);
    return (a > b) - (a < b);
}

cv_status cmp_branches_pair(cmp_branch_pairs *out, const cmp_branches lists[CMP_METHODS], cv_message *why)
{
    matrix m;
    *out = (cmp_branch_pairs){0, malloc((lists[0].count + lists[1].count + 1) * sizeof *out->pairs)};
    if (!matrix_init(&m, lists) || out->pairs == NULL) {
        matrix_clear(&m);
        cmp_branch_pairs_clear(out);
        return cv_fail(why, CV_FAILED, "out of memory");
    }
    for (size_t i = 0; i < m.rows; i++) {
        const size_t j = nearest(&m, lists, 0, i);
        const int mutual = j != SIZE_MAX && nearest(&m, lists, 1, j) == i;
        out->pairs[out->count++] = pair_of(&lists[0].branches[i], mutual ? &lists[1].branches[j] : NULL,
                                           mutual ? m.in_plot[i * m.columns + j] : (double)NAN);
    }
    for (size_t j = 0; j < m.columns; j++) {
        const size_t i = nearest(&m, lists, 1, j);
        if (i == SIZE_MAX || nearest(&m, lists, 0, i) != j)
            out->pairs[out->count++] = pair_of(NULL, &lists[1].branches[j], (double)NAN);
    }
    matrix_clear(&m);
    qsort(out->pairs, out->count, sizeof *out->pairs, by_velocity);
    return CV_OK;
}

void cmp_branch_pairs_clear(cmp_branch_pairs *p)
{
    free(p->pairs);
    *p = (cmp_branch_pairs){0, NULL};
}
