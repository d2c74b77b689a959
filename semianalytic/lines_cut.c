#include <math.h>
#include <stdlib.h>

#include "semianalytic/lines_parts.h"

/* One line as a row of samples: a closed one begins and ends at the same sample, at a cut if there is one. */
typedef struct {
    sa_lines *lines;
    size_t line, count;
    sa_line_sample *sample;
    char *kept;
    size_t first_branch; /* of this line */
    int digits;
} row;

static cv_status make_row(row *r)
{
    const sa_line_store *store = r->lines->store;
    const sa_line *line = &store->line[r->line];
    const sa_line_sample *from = &store->samples.item[line->first];
    size_t start = 0;
    r->count = line->count + (line->closed ? 1 : 0);
    r->sample = calloc(r->count, sizeof *r->sample);
    r->kept = calloc(r->count, 1);
    if (r->sample == NULL || r->kept == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < line->count && line->closed && start == 0; ++i)
        start = from[i].marks & SA_MARK_CUT ? i : 0;
    for (size_t i = 0; i < r->count; ++i)
        r->sample[i] = from[(start + i) % line->count];
    return CV_OK;
}

static int inside(const row *r, size_t i)
{
    const sa_line_plot *plot = &r->lines->store->plot;
    double re = sqrt(r->sample[i].re * r->sample[i + 1].re);
    return re > plot->re_low && re < plot->re_high;
}

/* Which end of the range the sample is at; at: 0 the beginning of a branch, 1 its end. */
static sa_end_kind end_kind(const row *r, size_t i, int at)
{
    const sa_line_store *store = r->lines->store;
    const sa_line_sample *s = &r->sample[i];
    if (store->line[r->line].closed && !(r->sample[0].marks & SA_MARK_CUT))
        return SA_END_CLOSED;
    if (s->marks & SA_MARK_CUT)
        return fabs(log(s->re / store->plot.re_low)) < fabs(log(s->re / store->plot.re_high))
                   ? SA_END_MASS_HIGH
                   : SA_END_MASS_LOW;
    if (store->line[r->line].closed)
        return SA_END_CLOSED;
    if ((at == 0 && i == 0) || (at == 1 && i + 1 == r->count))
        return store->end[r->line][at].kind;
    return SA_END_UNDECIDED;
}

static cv_status add_vertex(sa_branch *b, const row *r, size_t i, sa_end_kind end)
{
    sa_line_vertex *v = &b->vertex[b->count];
    sa_line_sample around[3] = {r->sample[i], r->sample[i], r->sample[i]};
    around[0] = r->sample[i > 0 ? i - 1 : 0];
    around[2] = r->sample[i + 1 < r->count ? i + 1 : i];
    cv_status status = sa_line_refine(v, r->lines->store, &around[1], end, r->digits);
    ++b->count;
    if (status == CV_OK && v->decided != CV_OK && !sa_line_in_limit(&r->sample[i]))
        status = sa_lines_doubt(r->lines, r->sample[i].alpha, r->sample[i].q,
                                "a point of a line could not be refined");
    return status;
}

/* The closed line's last vertex is its first. */
static cv_status repeat_first(sa_branch *b)
{
    const sa_line_vertex *first = &b->vertex[0];
    sa_line_vertex *v = &b->vertex[b->count++];
    *v = *first;
    mpfr_init2(v->alpha, mpfr_get_prec(first->alpha));
    mpfr_init2(v->q, mpfr_get_prec(first->q));
    mpfr_init2(v->eta_M, mpfr_get_prec(first->eta_M));
    mpfr_set(v->alpha, first->alpha, MPFR_RNDN);
    mpfr_set(v->q, first->q, MPFR_RNDN);
    mpfr_set(v->eta_M, first->eta_M, MPFR_RNDN);
    return CV_OK;
}

static cv_status fill_branch(sa_branch *b, row *r, size_t from, size_t to)
{
    sa_line_simplify(r->kept + from, r->sample + from, to - from + 1, &r->lines->store->plot);
    b->vertex = calloc(to - from + 1, sizeof *b->vertex);
    cv_status status = b->vertex != NULL ? CV_OK : CV_FAILED;
    int closed = b->start.kind == SA_END_CLOSED;
    for (size_t i = from; i <= to && status == CV_OK; ++i) {
        sa_end_kind end = i == from ? b->start.kind : i == to ? b->end.kind : SA_END_CLOSED;
        if (closed && i == to)
            status = repeat_first(b);
        else if (r->kept[i])
            status = add_vertex(b, r, i, end);
    }
    return status == CV_OK ? sa_branch_count(b, r->lines->store) : status;
}

static cv_status add_branch(row *r, size_t from, size_t to)
{
    sa_lines *lines = r->lines;
    sa_branch *more = realloc(lines->branch, (lines->count + 1) * sizeof *more);
    if (more == NULL)
        return CV_FAILED;
    lines->branch = more;
    sa_branch *b = &more[lines->count++];
    *b = (sa_branch){.line = r->line, .counted = CV_UNDECIDED};
    b->start.kind = end_kind(r, from, 0);
    b->end.kind = end_kind(r, to, 1);
    return fill_branch(b, r, from, to);
}

/* What the end of the line means for the end of its first or last branch. */
static void set_outer(sa_line_end *end, const sa_line_end *of_line)
{
    int cut = end->kind == SA_END_MASS_LOW || end->kind == SA_END_MASS_HIGH;
    *end = (sa_line_end){.kind = end->kind,
                         .beyond = of_line->beyond,
                         .number = of_line->number,
                         .zero_alpha = of_line->zero_alpha,
                         .zero_q = of_line->zero_q};
    if (cut && of_line->kind == SA_END_ALPHA_LOW)
        end->beyond = SA_BEYOND_ALPHA_LOW;
    if (cut && of_line->kind == SA_END_ALPHA_HIGH)
        end->beyond = SA_BEYOND_ALPHA_HIGH;
}

static void set_beyond(row *r)
{
    const sa_line_store *store = r->lines->store;
    int closed = store->line[r->line].closed;
    for (size_t i = r->first_branch; i < r->lines->count; ++i) {
        sa_branch *b = &r->lines->branch[i];
        if (b->start.kind == SA_END_CLOSED)
            continue;
        b->start.beyond = b->end.beyond = SA_BEYOND_BRANCH;
        b->start.number = i > r->first_branch ? i - 1 : r->lines->count - 1;
        b->end.number = i + 1 < r->lines->count ? i + 1 : r->first_branch;
        if (!closed && i == r->first_branch)
            set_outer(&b->start, &store->end[r->line][0]);
        if (!closed && i + 1 == r->lines->count)
            set_outer(&b->end, &store->end[r->line][1]);
    }
}

static int is_lost(const sa_line_end *end)
{
    return end->kind == SA_END_MASS_HIGH && end->beyond == SA_BEYOND_NOTHING;
}

static sa_line_kind line_kind(const sa_line_store *store, size_t line)
{
    if (store->line[line].closed)
        return SA_LINE_CLOSED;
    sa_end_kind a = store->end[line][0].kind, b = store->end[line][1].kind;
    if (a == SA_END_UNDECIDED || b == SA_END_UNDECIDED || a >= SA_END_CURVE || b >= SA_END_CURVE ||
        is_lost(&store->end[line][0]) || is_lost(&store->end[line][1]))
        return SA_LINE_UNDECIDED;
    if (a == SA_END_MASS_HIGH && b == SA_END_MASS_HIGH)
        return SA_LINE_INFINITE;
    if (a != SA_END_ALPHA_LOW && b != SA_END_ALPHA_LOW && a != b)
        return SA_LINE_ZERO_MASS;
    return SA_LINE_OUT;
}

static cv_status cut_line(row *r)
{
    cv_status status = make_row(r);
    r->first_branch = r->lines->count;
    for (size_t i = 0; status == CV_OK && i + 1 < r->count;) {
        size_t from = i;
        while (i + 1 < r->count && inside(r, i))
            ++i;
        if (i > from)
            status = add_branch(r, from, i);
        else
            ++i;
    }
    if (status != CV_OK)
        return status;
    set_beyond(r);
    for (size_t i = r->first_branch; i < r->lines->count; ++i)
        r->lines->branch[i].kind = line_kind(r->lines->store, r->line);
    return CV_OK;
}

cv_status sa_lines_cut(sa_lines *lines, int digits)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < lines->line_count && status == CV_OK; ++i) {
        row r = {.lines = lines, .line = i, .digits = digits};
        status = cut_line(&r);
        free(r.sample);
        free(r.kept);
    }
    return status;
}
