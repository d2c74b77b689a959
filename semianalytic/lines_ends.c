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

/* Newton's step to zeta = 0. Towards q = 0, where Re zeta ~ q^2, it goes half the way. Where zeta is steep,
 * doubles leave more than the floor of it: then the step must be as small as their spacing. */
static int near_zero(sa_line_end *end, const sa_line_sample *s, int at_floor)
{
    const double spacing = 1e-13, step = at_floor ? 0.25 : spacing;
    double det = s->re_alpha * s->im_q - s->re_q * s->im_alpha;
    double d_alpha = -s->re * s->im_q / det, d_q = s->re * s->im_alpha / det;
    if (!(fabs(d_q) < step * s->q && fabs(d_alpha) < step * s->alpha))
        return 0;
    end->kind = SA_END_MASS_HIGH;
    end->beyond = SA_BEYOND_ZERO;
    end->zero_alpha = s->alpha + d_alpha;
    end->zero_q = s->q + d_q;
    return 1;
}

static int same_velocity(double a, double b)
{
    return fabs(a - b) <= 1e-13 * b;
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
    else if (!near_zero(end, s, at_floor) && at_floor)
        end->kind = SA_END_MASS_HIGH;
}

/* Follows a line beyond the floor, q changing by a factor at each step, until Re zeta is negative (*zero: 1)
 * or above the floor again or q tiny (0). */
static cv_status follow(int *zero, double *alpha, double *q, const sa_line_store *store, double factor)
{
    const double smallest = 1e-3 * sqrt(store->re_floor);
    double eta_M = INFINITY;
    cv_status status = CV_OK;
    while (status == CV_OK && eta_M > 1 / store->re_floor && *q >= smallest) {
        sa_line_vertex v;
        mpfr_t exact_q;
        int rises;
        *q *= factor;
        mpfr_init_set_d(exact_q, *q, MPFR_RNDN);
        status = sa_line_point(&v, &rises, store->sweep, store->track, SA_GIVEN_Q, exact_q, *alpha, 8);
        if (status == CV_OK && v.decided != CV_OK)
            status = CV_UNDECIDED;
        *alpha = mpfr_get_d(v.alpha, MPFR_RNDN);
        eta_M = mpfr_get_d(v.eta_M, MPFR_RNDN);
        sa_line_vertex_clear(&v);
        mpfr_clear(exact_q);
    }
    *zero = status == CV_OK && eta_M < 0;
    return status == CV_FAILED ? status : CV_OK;
}

/* Steps of follow() */
static const double growth = 1.1;

/* The line of an asymptote may stay above the largest eta_M until Re zeta becomes negative: K(0, 0) is tiny
 * there. */
static cv_status stays_above(int *above, const sa_line_store *store, const sa_asymptote *a)
{
    double alpha = mpfr_get_d(a->alpha, MPFR_RNDN), q = 1e-3 * sqrt(store->re_floor);
    return follow(above, &alpha, &q, store, growth);
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

/* Lines do not cross: below the floor they keep their order. Those that turn back there, or are missing,
 * upset it: then only what is near and fits is joined. */
static cv_status match(sa_lines *lines, const descent *d, size_t count)
{
    const double near = 1e-4;
    const sa_asymptote_list *list = &lines->asymptotes;
    cv_status status = CV_OK;
    size_t next = 0;
    for (size_t i = 0; i < list->count && status == CV_OK; ++i) {
        const sa_asymptote *a = &list->item[i];
        double alpha = mpfr_get_d(a->alpha, MPFR_RNDN);
        if (!a->has_line)
            continue;
        size_t found = next;
        while (found < count && !(fits(a, &d[found]) && fabs(d[found].alpha - alpha) < near * alpha) &&
               d[found].alpha < alpha + near * alpha)
            ++found;
        if (found == count || !fits(a, &d[found]) || !(fabs(d[found].alpha - alpha) < near * alpha)) {
            int above;
            status = stays_above(&above, lines->store, a);
            if (status == CV_OK && !above)
                status = sa_lines_doubt(lines, alpha, 0, "an asymptote without a line");
            continue;
        }
        sa_line_end *end = &lines->store->end[d[found].line][d[found].end];
        end->beyond = SA_BEYOND_ASYMPTOTE;
        end->number = i;
        next = found + 1;
    }
    return status;
}

/* A line that has sunk to the floor without an asymptote there: does it come to a zero of zeta? */
static cv_status sink(sa_lines *lines, sa_line_end *end, const sa_line_sample *last,
                      const sa_line_sample *before)
{
    int zero;
    double alpha = last->alpha, q = last->q;
    cv_status status = follow(&zero, &alpha, &q, lines->store, q > before->q ? growth : 1 / growth);
    if (status != CV_OK)
        return status;
    if (!zero)
        return sa_lines_doubt(lines, last->alpha, last->q, "a line without an asymptote");
    end->beyond = SA_BEYOND_ZERO;
    end->zero_alpha = alpha;
    end->zero_q = q;
    return CV_OK;
}

static cv_status settle(sa_lines *lines, size_t number, int at)
{
    const sa_line_store *store = lines->store;
    const sa_line *line = &store->line[number];
    const sa_line_sample *s = &store->samples.item[line->first + (at == 0 ? 0 : line->count - 1)];
    sa_line_end *end = &store->end[number][at];
    if (end->kind == SA_END_UNDECIDED)
        return sa_lines_doubt(lines, s->alpha, s->q, "a line ends");
    if (end->kind == SA_END_MASS_HIGH && end->beyond == SA_BEYOND_NOTHING)
        return sink(lines, end, s, at == 0 ? s + 1 : s - 1);
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
    cv_status status = match(lines, d, count);
    free(d);
    return status == CV_OK ? settle_all(lines) : status;
}
