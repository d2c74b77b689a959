#include "semianalytic/map_search.h"

#include <math.h>

typedef struct {
    const sa_map *map;
    sa_field *field;
    const sa_search *search;
    double extent_u, extent_t; /* of the block, natural logarithms */
    sa_segment block;          /* without ends */
    unsigned long cells, most_cells, beyond_before;
} search_state;

typedef struct {
    double u, t, size_u, size_t;
} cell;

/* What is known of a cell. */
typedef struct {
    sa_sample s[SA_CELL_POINTS];
    sa_cell_values im;
    double roughness[2];
} cell_data;

static cv_status sample_cell(cell_data *d, sa_field *field, const cell *c)
{
    static const double at_u[] = {0, 1, 0, 1, 0.5}, at_t[] = {0, 0, 1, 1, 0.5};
    for (int i = 0; i < SA_CELL_POINTS; ++i) {
        cv_status status =
            sa_field_corner(&d->s[i], field, c->u + at_u[i] * c->size_u, c->t + at_t[i] * c->size_t);
        if (status != CV_OK)
            return status;
        d->im.f[i] = d->s[i].im;
        d->im.f_u[i] = d->s[i].im_u * c->size_u;
        d->im.f_t[i] = d->s[i].im_t * c->size_t;
    }
    return CV_OK;
}

/* Size of a cell relative to the largest that is believed in without further demands; > 1: oversized. */
static double excess(const search_state *st, const cell *c)
{
    return fmax(c->size_u * st->extent_u, c->size_t * st->extent_t) / st->search->largest_cell;
}

/* How smooth a function must be: the larger the cell, the nearer to a power law. */
typedef struct {
    double tolerance, steepest;
} demand;

static demand demand_on(const search_state *st, const cell *c)
{
    const double steepest = 6;
    double size = fmax(excess(st, c), 1);
    return (demand){st->search->tolerance / (size * size), steepest * size};
}

/* Re zeta - level keeps this sign in the cell */
static int re_beyond(const cell_data *d, const cell *c, double level, double sign, demand need)
{
    sa_cell_values v;
    double roughness[2];
    for (int i = 0; i < SA_CELL_POINTS; ++i) {
        v.f[i] = d->s[i].re - level;
        if (!(v.f[i] * sign > 0))
            return 0;
        v.f_u[i] = d->s[i].re_u * c->size_u;
        v.f_t[i] = d->s[i].re_t * c->size_t;
    }
    return sa_cell_one_signed(roughness, &v, need.tolerance, need.steepest);
}

/* Nothing of interest in the cell. */
static int dismissed(cell_data *d, const cell *c, const search_state *st)
{
    demand need = demand_on(st, c);
    return sa_cell_one_signed(d->roughness, &d->im, need.tolerance, need.steepest) ||
           re_beyond(d, c, st->search->re_low, -1, need) || re_beyond(d, c, st->search->re_high, 1, need);
}

/* Zero of Im zeta on the edge from a to b, where its signs differ. */
static cv_status edge_zero(sa_sample *out, sa_field *field, const sa_sample *a, const sa_sample *b)
{
    double du = b->u - a->u, dt = b->t - a->t, low = 0, high = 1, x = a->im / (a->im - b->im);
    for (int i = 0; i < 60; ++i) {
        cv_status status = sa_field_at(out, field, a->u + x * du, a->t + x * dt);
        if (status != CV_OK)
            return status;
        if (out->im * a->im > 0)
            low = x;
        else
            high = x;
        double next = x - out->im / (out->im_u * du + out->im_t * dt);
        if (fabs(next - x) < 1e-9 || high - low < 1e-12 || fabs(out->im) <= 2 * out->im_error)
            break;
        x = next > low && next < high ? next : (low + high) / 2;
    }
    return CV_OK;
}

static int differ(const cell_data *d, int i, int j)
{
    return (d->s[i].im > 0) != (d->s[j].im > 0);
}

static cv_status emit(const search_state *st, const cell_data *d, const int edge[2][2], int axis)
{
    sa_segment segment = st->block;
    segment.axis = axis;
    for (int i = 0; i < 2; ++i) {
        const sa_sample *a = &d->s[edge[i][0]], *b = &d->s[edge[i][1]];
        segment.edge[i].along = a->u == b->u;
        segment.edge[i].low = a->u == b->u ? a->t : a->u;
        segment.edge[i].high = a->u == b->u ? b->t : b->u;
    }
    cv_status status = edge_zero(&segment.from, st->field, &d->s[edge[0][0]], &d->s[edge[0][1]]);
    if (status == CV_OK)
        status = edge_zero(&segment.to, st->field, &d->s[edge[1][0]], &d->s[edge[1][1]]);
    if (status == CV_OK)
        status = st->search->segment(st->search->context, st->field, &segment);
    return status;
}

/* Im zeta strictly monotone along u and along t: no line, or one from edge to edge. */
static cv_status monotone_cell(const search_state *st, const cell_data *d)
{
    static const int edges[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    int crossed[2][2], n = 0;
    for (int i = 0; i < 4; ++i)
        if (differ(d, edges[i][0], edges[i][1]) && n < 2) {
            crossed[n][0] = edges[i][0];
            crossed[n++][1] = edges[i][1];
        }
    if (n == 0)
        return CV_OK;
    double slope_u = fabs(d->im.f_u[4]), slope_t = fabs(d->im.f_t[4]);
    return emit(st, d, (const int(*)[2])crossed, slope_t > slope_u ? 0 : 1);
}

/* Monotone along t only: simple when the line runs from the edge u0 to the edge u1 and touches no other. */
static int spans_u(const cell_data *d)
{
    const sa_cell_values *v = &d->im;
    return differ(d, 0, 2) && !differ(d, 0, 1) && !differ(d, 2, 3) &&
           sa_cubic_one_signed(v->f[0], v->f[1], v->f_u[0], v->f_u[1]) &&
           sa_cubic_one_signed(v->f[2], v->f[3], v->f_u[2], v->f_u[3]);
}

static int spans_t(const cell_data *d)
{
    const sa_cell_values *v = &d->im;
    return differ(d, 0, 1) && !differ(d, 0, 2) && !differ(d, 1, 3) &&
           sa_cubic_one_signed(v->f[0], v->f[2], v->f_t[0], v->f_t[2]) &&
           sa_cubic_one_signed(v->f[1], v->f[3], v->f_t[1], v->f_t[3]);
}

/* 1: the lines in the cell are simple and have been handed over. */
static int simple(cv_status *status, const search_state *st, const cell_data *d)
{
    static const int left_right[2][2] = {{0, 2}, {1, 3}}, bottom_top[2][2] = {{0, 1}, {2, 3}};
    int steady_u = sa_cell_steady(&d->im, 0), steady_t = sa_cell_steady(&d->im, 1);
    *status = CV_OK;
    if (steady_u && steady_t)
        *status = monotone_cell(st, d);
    else if (steady_t && spans_u(d))
        *status = emit(st, d, left_right, 0);
    else if (steady_u && spans_t(d))
        *status = emit(st, d, bottom_top, 1);
    else
        return 0;
    return 1;
}

/* The direction in which Im zeta is farther from a linear function, or in which the cell is too large. */
static int split_along_u(const cell_data *d, const cell *c, const search_state *st)
{
    const double most_oblong = 4096;
    if (excess(st, c) > 1)
        return c->size_u * st->extent_u > c->size_t * st->extent_t;
    if (c->size_u > most_oblong * c->size_t)
        return 1;
    if (c->size_t > most_oblong * c->size_u)
        return 0;
    if (isfinite(d->roughness[0]) && isfinite(d->roughness[1]))
        return d->roughness[0] > d->roughness[1];
    const double *u = d->im.f_u, *t = d->im.f_t;
    return fabs(u[1] - u[0]) + fabs(u[3] - u[2]) > fabs(t[2] - t[0]) + fabs(t[3] - t[1]);
}

static cv_status give_up(const search_state *st, const cell_data *d)
{
    double range = 0;
    for (int i = 0; i < SA_CELL_CORNERS; ++i)
        range = fmax(range, fabs(d->s[i].re - d->s[4].re));
    return st->search->unresolved(st->search->context, &d->s[4], range);
}

static int too_expensive(const search_state *st)
{
    unsigned long most = st->search->beyond_double;
    return most > 0 && sa_field_counts(st->field).beyond_double - st->beyond_before > most;
}

static cv_status search_cell(search_state *st, cell c)
{
    const double smallest = 1e-9;
    cell_data d;
    if (++st->cells > st->most_cells || too_expensive(st))
        return CV_UNDECIDED;
    cv_status status = sample_cell(&d, st->field, &c);
    if (status != CV_OK || dismissed(&d, &c, st) || (excess(st, &c) <= 1 && simple(&status, st, &d)))
        return status;
    if (c.size_u < smallest || c.size_t < smallest)
        return give_up(st, &d);
    cell second = c;
    if (split_along_u(&d, &c, st)) {
        c.size_u = second.size_u = c.size_u / 2;
        second.u += c.size_u;
    } else {
        c.size_t = second.size_t = c.size_t / 2;
        second.t += c.size_t;
    }
    status = search_cell(st, c);
    return status == CV_OK ? search_cell(st, second) : status;
}

/* The largest extent of the strip within the block. */
static cv_status measure(search_state *st, size_t column, int side_u, int strip, int side_t)
{
    enum { PLACES = 16 };
    st->extent_u = sa_map_column_extent(&st->map->column[column], side_u);
    st->extent_t = 0;
    for (int i = 0; i <= PLACES; ++i) {
        const sa_map_node *node = sa_field_node(st->field, (double)i / PLACES);
        if (node == NULL)
            return CV_FAILED;
        st->extent_t = fmax(st->extent_t, sa_map_strip_extent(node, strip, side_t));
    }
    return CV_OK;
}

/* First cells: up to twice too large, so that one division leads to the largest size. */
static int first_cells(double extent, double largest)
{
    const double times = 2;
    return extent > largest ? (int)ceil(extent / (times * largest)) : 1;
}

static cv_status search_block(search_state *st, size_t column, int side_u, int strip, int side_t)
{
    sa_field_block(st->field, column, side_u, strip, side_t);
    st->block = (sa_segment){.column = column, .side_u = side_u, .strip = strip, .side_t = side_t};
    cv_status status = measure(st, column, side_u, strip, side_t);
    int n = first_cells(st->extent_u, st->search->largest_cell),
        m = first_cells(st->extent_t, st->search->largest_cell);
    for (int i = 0; status == CV_OK && i < n * m; ++i) {
        cell c = {i / m * (1.0 / n), i % m * (1.0 / m), 1.0 / n, 1.0 / m};
        status = search_cell(st, c);
    }
    return status;
}

cv_status sa_map_search(const sa_map *map, sa_field *field, const sa_search *search)
{
    search_state st = {.map = map, .field = field, .search = search};
    st.beyond_before = sa_field_counts(field).beyond_double;
    st.most_cells = search->cells > 0 ? search->cells : SA_MAP_CELLS_MAX;
    cv_status status = CV_OK;
    for (size_t i = 0; i < 2 * map->count; ++i) { /* one side of a column after the other: nodes are kept */
        int strips = map->column[i / 2].closed ? 0 : map->column[i / 2].count + 1;
        for (int k = 0; k < 2 * strips - 1 && status == CV_OK; ++k) /* the last strip has one side */
            status = search_block(&st, i / 2, (int)(i % 2), k / 2, k % 2);
    }
    return status;
}
