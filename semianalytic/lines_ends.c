#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "semianalytic/lines_parts.h"

/* The end of a line where Re zeta falls to the floor at a small q. */
typedef struct {
    size_t line;
    int end; /* 0: its beginning */
    double alpha;
} descent;

cv_status sa_lines_doubt(sa_lines *lines, double alpha, double q, const char *what)
{
    if (lines->decided == CV_OK) {
        lines->decided = CV_UNDECIDED;
        if (snprintf(lines->reason.text, sizeof lines->reason.text, "%s near alpha = %.15g, q = %.6g", what,
                     alpha, q) < 0)
            lines->reason.text[0] = '\0';
    }
    return sa_line_place_add(&lines->place, &lines->place_count, alpha, q);
}

/* Newton's iteration in (alpha, q) to zeta = 0 from the end of a line. 1: there is one so near that it must
 * be where the line ends. */
static int near_zero(sa_line_end *end, const sa_line_store *store, const sa_line_sample *s)
{
    enum { STEPS = 20 };
    const double reach = 1e-3, converged = 1e-9, spacing = 1e-14;
    double alpha = s->alpha, q = s->q;
    for (int i = 0; i < STEPS; ++i) {
        sa_value v;
        if (sa_zeta_adaptive(&v, store->sweep, store->track, alpha, q, 0.01) != CV_OK)
            return 0;
        double det = creal(v.d_alpha) * cimag(v.d_q) - creal(v.d_q) * cimag(v.d_alpha);
        double d_alpha = (v.im * creal(v.d_q) - v.re * cimag(v.d_q)) / det;
        double d_q = (v.re * cimag(v.d_alpha) - v.im * creal(v.d_alpha)) / det;
        alpha += d_alpha;
        q += d_q;
        if (!(fabs(q - s->q) < reach * s->q && fabs(alpha - s->alpha) < reach * s->alpha))
            return 0;
        if (fabs(d_q) > fmax(converged * q, spacing) || fabs(d_alpha) > fmax(converged * alpha, spacing))
            continue;
        end->kind = SA_END_MASS_HIGH;
        end->beyond = SA_BEYOND_ZERO;
        end->zero_alpha = alpha;
        end->zero_q = q;
        return 1;
    }
    return 0;
}

/* Where zeta is steep, doubles leave more than the floor of it at a zero: a step of their spacing leads
 * there. */
static int at_zero(const sa_line_sample *s)
{
    const double spacing = 1e-11;
    double det = s->re_alpha * s->im_q - s->re_q * s->im_alpha;
    return fabs(s->re * s->im_q / det) < spacing && fabs(s->re * s->im_alpha / det) < spacing;
}

static int same_velocity(double a, double b)
{
    return fabs(a - b) <= 1e-13 * b;
}

/* At the rim of the gap of a branch curve? */
static int at_curve(const sa_line_store *store, const sa_line_sample *s)
{
    const double slack = 0.1;
    sa_map_node node;
    if (sa_map_node_of(&node, &store->map, s->alpha) != CV_OK)
        return 0;
    for (int i = 1; i < node.count - 1; ++i)
        if (node.gap[i] > 0 && fabs(fabs(s->q - node.q[i]) - node.gap[i]) < slack * node.gap[i])
            return 1;
    return 0;
}

/* At an end of a closed column? */
static int at_special(const sa_line_store *store, const sa_line_sample *s)
{
    const double slack = 0.1;
    for (size_t i = 0; i < store->map.count; ++i) {
        const sa_column *c = &store->map.column[i];
        double width = c->alpha_high - c->alpha_low;
        if (c->closed && s->alpha > c->alpha_low - slack * width && s->alpha < c->alpha_high + slack * width)
            return 1;
    }
    return 0;
}

/* kind, and beyond but for asymptotes */
static void classify(sa_line_end *end, const sa_line_store *store, const sa_line_sample *s)
{
    int at_floor = s->re < 1.01 * store->re_floor;
    *end = (sa_line_end){.kind = SA_END_UNDECIDED, .beyond = SA_BEYOND_NOTHING};
    if (same_velocity(s->alpha, store->map.curves.alpha_min))
        end->kind = SA_END_ALPHA_LOW;
    else if (same_velocity(s->alpha, store->map.curves.alpha_max))
        end->kind = SA_END_ALPHA_HIGH;
    else if (store->map.undamped && at_special(store, s))
        end->kind = SA_END_SPECIAL;
    else if (store->map.undamped && at_curve(store, s))
        end->kind = SA_END_CURVE;
    else if ((at_floor || at_zero(s)) && !near_zero(end, store, s) && at_floor)
        end->kind = SA_END_MASS_HIGH;
}

/* A line followed beyond the floor: alpha as a function of log q. */
typedef struct {
    double alpha, q, eta_M;
    double slope, bend, last; /* d alpha / d log q over the last step, how it changes with log q, that step */
    int rises;                /* Im zeta with alpha there, 1 or -1; 0 before the first step */
} runner;

/* One step of the logarithm of q; 1 when the line is where its slope says, 0 when the step was too long. */
static cv_status run(int *on_line, runner *r, const sa_line_store *store, double step)
{
    enum { DIGITS = 16 };
    const double unsteady = 0.25, least = r->rises == 0 ? 1e-9 : 1e-13, most = 3;
    const double q = r->q * exp(step), slope = r->slope + r->bend * (r->last + step) / 2,
                 expected = r->alpha + slope * step;
    sa_line_vertex v;
    mpfr_t exact_q;
    int rises;
    *on_line = 0;
    if (!(expected > 0))
        return CV_OK;
    mpfr_init_set_d(exact_q, q, MPFR_RNDN);
    cv_status status =
        sa_line_point(&v, &rises, store->sweep, store->track, SA_GIVEN_Q, exact_q, expected, DIGITS);
    double alpha = mpfr_get_d(v.alpha, MPFR_RNDN), eta_M = mpfr_get_d(v.eta_M, MPFR_RNDN);
    int near = fabs(alpha - expected) < unsteady * fabs(slope * step) + least * alpha &&
               (r->rises == 0 || r->rises == rises) &&
               (isinf(r->eta_M) || (fabs(eta_M) * most > r->eta_M && eta_M < most * r->eta_M));
    if (status == CV_OK && v.decided == CV_OK && near) {
        const double mean = (alpha - r->alpha) / step, change = 2 * (mean - r->slope) / (step + r->last);
        *r = (runner){alpha, q, eta_M, mean, r->rises == 0 ? 0 : change, step, rises};
        *on_line = 1;
    }
    sa_line_vertex_clear(&v);
    mpfr_clear(exact_q);
    return status;
}

/* An asymptote is at q = 0. */
static double smallest_q(const sa_line_store *store)
{
    return 1e-3 * sqrt(store->re_floor);
}

/* Follows a line beyond the floor, log q growing (1) or falling (-1), until Re zeta is negative (*zero: 1) or
 * above the floor again, or q tiny, or the line lost (0). */
static cv_status follow(int *zero, runner *r, const sa_line_store *store, int direction)
{
    enum { STEPS = 600 };
    const double smallest = smallest_q(store), shortest = 1e-13, longest = 0.3;
    double step = 0.02;
    runner before = *r;
    cv_status status = CV_OK;
    for (int i = 0; i < STEPS && status == CV_OK && r->eta_M > 1 / store->re_floor &&
                    (direction > 0 || r->q >= smallest) && step > shortest;
         ++i) {
        int on_line;
        before = *r;
        status = run(&on_line, r, store, direction * step);
        step = on_line ? fmin(1.5 * step, longest) : step / 4;
    }
    *zero = status == CV_OK && r->eta_M < 0;
    if (*zero) { /* Re zeta = 1 / eta_M is linear there */
        const double part = r->eta_M / (r->eta_M - before.eta_M);
        r->alpha = before.alpha + part * (r->alpha - before.alpha);
        r->q = before.q + part * (r->q - before.q);
    }
    return status;
}

static int by_alpha(const void *left, const void *right)
{
    const descent *a = left, *b = right;
    return (a->alpha > b->alpha) - (a->alpha < b->alpha);
}

/* A line begins at an asymptote where c rises with alpha, and ends where it falls. */
static int fits(const sa_asymptote *a, const descent *d)
{
    return a->has_line && (a->rises > 0) == (d->end == 0);
}

/* Lines do not cross: below the floor, which is at small q, they keep their order, as long as all are there
 * and none turns back. */
static void match(sa_lines *lines, const descent *d, size_t count)
{
    const double lowest_floor = 1e-8, near = 1e-3;
    const sa_asymptote_list *list = &lines->asymptotes;
    size_t next = 0;
    for (size_t i = 0; i < list->count && lines->store->re_floor < lowest_floor; ++i) {
        const sa_asymptote *a = &list->item[i];
        double alpha = mpfr_get_d(a->alpha, MPFR_RNDN);
        if (!a->has_line)
            continue;
        size_t found = next;
        while (found < count && !(fits(a, &d[found]) && fabs(d[found].alpha - alpha) < near * alpha) &&
               d[found].alpha < alpha + near * alpha)
            ++found;
        if (found == count || !fits(a, &d[found]) || !(fabs(d[found].alpha - alpha) < near * alpha))
            continue;
        sa_line_end *end = &lines->store->end[d[found].line][d[found].end];
        end->beyond = SA_BEYOND_ASYMPTOTE;
        end->number = i;
        next = found + 1;
    }
}

static int is_taken(const sa_line_store *store, size_t asymptote)
{
    for (size_t i = 0; i < store->line_count; ++i)
        for (int k = 0; k < 2; ++k)
            if (!store->line[i].closed && store->end[i][k].beyond == SA_BEYOND_ASYMPTOTE &&
                store->end[i][k].number == asymptote)
                return 1;
    return 0;
}

/* The asymptote to which the runner has come with a tiny q, from end "at" of a line; list->count: none. */
static size_t asymptote_at(const sa_lines *lines, int at, const runner *r)
{
    const sa_asymptote_list *list = &lines->asymptotes;
    const descent d = {.end = at};
    double nearest = 1e-3 * r->alpha * r->q + fabs(r->slope) + 1e-12 * r->alpha;
    size_t best = list->count;
    for (size_t i = 0; i < list->count; ++i) {
        const double distance = fabs(mpfr_get_d(list->item[i].alpha, MPFR_RNDN) - r->alpha);
        if (fits(&list->item[i], &d) && distance <= nearest && !is_taken(lines->store, i)) {
            nearest = distance;
            best = i;
        }
    }
    return best;
}

/* Distance of the runner, back at the floor, from the beginning (at = 1: the runner has left the end of a
 * line) or end of a line, in parts of what it may be; infinite where that line is known to go elsewhere. */
static double distance_from(const sa_line_store *store, size_t number, int at, const runner *r)
{
    const double reach = 0.7;
    const sa_line *line = &store->line[number];
    const sa_line_sample *s = &store->samples.item[line->first + (at == 0 ? line->count - 1 : 0)];
    const sa_line_end *end = &store->end[number][!at];
    if (line->closed || end->kind != SA_END_MASS_HIGH || end->beyond != SA_BEYOND_NOTHING)
        return INFINITY;
    return fmax(fabs(log(s->q / r->q)) / reach, fabs(s->alpha - r->alpha) / (reach * fabs(r->slope) + 1e-9));
}

/* The line that the runner has come back to; its own is a closed one then. line_count: none. */
static size_t comes_back(const sa_line_store *store, int at, const runner *r)
{
    size_t best = store->line_count;
    double nearest = 1;
    for (size_t i = 0; i < store->line_count; ++i) {
        const double distance = distance_from(store, i, at, r);
        if (distance < nearest) {
            nearest = distance;
            best = i;
        }
    }
    return best;
}

/* A line that has sunk to the floor where no asymptote is near: it may come to a zero of zeta, to an
 * asymptote farther off, or rise again as another line or as itself. */
static cv_status sink(sa_lines *lines, size_t number, int at, const sa_line_sample *last,
                      const sa_line_sample *before)
{
    const double lost_far_above = 10;
    int zero;
    sa_line_store *store = lines->store;
    runner r = {.alpha = last->alpha,
                .q = last->q,
                .eta_M = 1.5 / store->re_floor,
                .slope = -last->im_q * last->q / last->im_alpha};
    cv_status status = follow(&zero, &r, store, last->q > before->q ? 1 : -1);
    sa_line_end *end = &store->end[number][at];
    if (status != CV_OK)
        return status;
    if (zero) {
        const sa_line_sample there = {.alpha = r.alpha, .q = r.q};
        end->beyond = SA_BEYOND_ZERO;
        end->zero_alpha = r.alpha;
        end->zero_q = r.q;
        (void)near_zero(end, store, &there);
        return CV_OK;
    }
    const size_t asymptote = r.q < smallest_q(store) ? asymptote_at(lines, at, &r) : lines->asymptotes.count;
    if (asymptote < lines->asymptotes.count) {
        end->beyond = SA_BEYOND_ASYMPTOTE;
        end->number = asymptote;
        return CV_OK;
    }
    const size_t other = r.eta_M <= 1 / store->re_floor ? comes_back(store, at, &r) : store->line_count;
    if (other == store->line_count && r.eta_M > lost_far_above * SA_LINES_MASS_MAX)
        return CV_OK; /* where it goes is not known, but no range of eta_M reaches there */
    if (other == store->line_count)
        return sa_lines_doubt(lines, last->alpha, last->q, "a line without an asymptote");
    *end = (sa_line_end){.kind = SA_END_MASS_HIGH, .beyond = SA_BEYOND_BRANCH, .number = other};
    store->end[other][!at] =
        (sa_line_end){.kind = SA_END_MASS_HIGH, .beyond = SA_BEYOND_BRANCH, .number = number};
    return CV_OK;
}

static cv_status settle(sa_lines *lines, size_t number, int at)
{
    sa_line_store *store = lines->store;
    const sa_line *line = &store->line[number];
    const sa_line_sample *s = &store->samples.item[line->first + (at == 0 ? 0 : line->count - 1)];
    sa_line_end *end = &store->end[number][at];
    if (end->kind == SA_END_UNDECIDED) {
        store->torn = 1;
        return sa_lines_doubt(lines, s->alpha, s->q, "a line ends");
    }
    if (end->kind == SA_END_MASS_HIGH && end->beyond == SA_BEYOND_NOTHING)
        return sink(lines, number, at, s, at == 0 ? s + 1 : s - 1);
    return CV_OK;
}

static cv_status settle_all(sa_lines *lines)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < lines->store->line_count; ++i)
        for (int k = 0; k < 2 && status == CV_OK && !lines->store->line[i].closed; ++k)
            status = settle(lines, i, k);
    return status;
}

/* An asymptote to which no line has come: its own may stay below the floor until Re zeta becomes negative,
 * since K(0, 0) is tiny there. */
static cv_status check_asymptote(sa_lines *lines, size_t number)
{
    const sa_asymptote *a = &lines->asymptotes.item[number];
    runner r = {.alpha = mpfr_get_d(a->alpha, MPFR_RNDN),
                .q = fmin(3e-8, 2 * smallest_q(lines->store)),
                .eta_M = INFINITY};
    int stays_below;
    cv_status status = follow(&stays_below, &r, lines->store, 1);
    if (status != CV_OK || stays_below)
        return status;
    lines->store->torn = 1;
    return sa_lines_doubt(lines, mpfr_get_d(a->alpha, MPFR_RNDN), 0, "an asymptote without a line");
}

static cv_status check_asymptotes(sa_lines *lines)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < lines->asymptotes.count && status == CV_OK; ++i)
        if (lines->asymptotes.item[i].has_line && !is_taken(lines->store, i))
            status = check_asymptote(lines, i);
    return status;
}

cv_status sa_lines_ends(sa_lines *lines)
{
    sa_line_store *store = lines->store;
    size_t count = 0;
    descent *d = calloc(2 * store->line_count + 1, sizeof *d);
    store->end = calloc(store->line_count + 1, sizeof *store->end);
    if (d == NULL || store->end == NULL) {
        free(d);
        return CV_FAILED;
    }
    for (size_t i = 0; i < store->line_count; ++i) {
        const sa_line *line = &store->line[i];
        for (int k = 0; k < 2 && !line->closed; ++k) {
            const sa_line_sample *s = &store->samples.item[line->first + (k == 0 ? 0 : line->count - 1)];
            sa_line_end *end = &store->end[i][k];
            classify(end, store, s);
            if (end->kind == SA_END_MASS_HIGH && end->beyond == SA_BEYOND_NOTHING)
                d[count++] = (descent){i, k, s->alpha};
        }
    }
    qsort(d, count, sizeof *d, by_alpha);
    match(lines, d, count);
    free(d);
    cv_status status = settle_all(lines);
    if (status == CV_OK)
        status = check_asymptotes(lines);
    return status == CV_OK ? sa_lines_join(lines) : status;
}
