/* Instability lines of semianalytic/ as compare sees them. */
#include <math.h>
#include <stdlib.h>

#include "compare/lines.h"
#include "semianalytic/crossings.h"
#include "semianalytic/lines.h"

typedef struct {
    cv_params params;
    cv_number range[4]; /* alpha_min, alpha_max, mass_min, mass_max */
    sa_track *track;
    sa_sweep *sweep;
    sa_lines lines; /* after find; for counting */
    int has_lines;
    sa_map map; /* for counting by crossings; made when needed */
    sa_field *field;
    double field_floor; /* of Re zeta */
} handle;

/* Crossings are found down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.5;

static void close_handle(void *opaque)
{
    handle *h = opaque;
    if (h->has_lines)
        sa_lines_clear(&h->lines);
    if (h->field != NULL)
        sa_map_clear(&h->map);
    sa_field_free(h->field);
    sa_sweep_free(h->sweep);
    sa_track_free(h->track);
    for (int i = 0; i < 4; i++)
        cv_number_clear(&h->range[i]);
    cv_params_clear(&h->params);
    free(h);
}

static cv_status open_handle(void **out, const cv_params *track, const cv_number *const range[4],
                             cv_message *why)
{
    handle *h = calloc(1, sizeof *h);
    if (h == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_params_init(&h->params);
    cv_params_set(&h->params, track);
    for (int i = 0; i < 4; i++) {
        cv_number_init(&h->range[i]);
        cv_number_set(&h->range[i], range[i]);
    }
    h->sweep = sa_sweep_new();
    cv_status status =
        h->sweep != NULL ? sa_track_new(&h->track, track, why) : cv_fail(why, CV_FAILED, "out of memory");
    if (status == CV_OK)
        *out = h;
    else
        close_handle(h);
    return status;
}

static void copy_coordinate(mpfr_ptr to, double *error, mpfr_srcptr from, double from_error)
{
    mpfr_set_prec(to, mpfr_get_prec(from));
    mpfr_set(to, from, MPFR_RNDN);
    *error = from_error;
}

static void copy_vertex(cmp_line_point *to, const sa_line_vertex *from)
{
    copy_coordinate(to->alpha, &to->alpha_error, from->alpha, from->alpha_error);
    copy_coordinate(to->q, &to->q_error, from->q, from->q_error);
    copy_coordinate(to->eta_M, &to->eta_M_error, from->eta_M, from->eta_M_error);
    to->turns = (from->marks & SA_MARK_TURN) != 0;
    to->decided = from->decided;
}

static cmp_line_end end_of(const sa_lines *lines, const sa_branch *branch, const sa_line_end *end)
{
    static const cmp_end_kind kinds[] = {
        [SA_END_CLOSED] = CMP_END_CLOSED,         [SA_END_ALPHA_LOW] = CMP_END_ALPHA_LOW,
        [SA_END_ALPHA_HIGH] = CMP_END_ALPHA_HIGH, [SA_END_MASS_LOW] = CMP_END_MASS_LOW,
        [SA_END_MASS_HIGH] = CMP_END_MASS_HIGH,   [SA_END_UNDECIDED] = CMP_END_UNDECIDED,
        [SA_END_CURVE] = CMP_END_UNDECIDED,       [SA_END_SPECIAL] = CMP_END_UNDECIDED};
    cmp_line_end out = {kinds[end->kind], (double)NAN, (double)NAN, 0, 0, 0};
    out.open = end->beyond == SA_BEYOND_NOTHING;
    out.zero_mass = branch->kind == SA_LINE_ZERO_MASS &&
                    (end->kind == SA_END_ALPHA_HIGH || end->beyond == SA_BEYOND_ALPHA_HIGH);
    if (end->beyond == SA_BEYOND_ASYMPTOTE) {
        const sa_asymptote *a = &lines->asymptotes.item[end->number];
        out.asymptote = mpfr_get_d(a->alpha, MPFR_RNDN);
        out.asymptote_error = a->alpha_error;
    } else if (end->beyond == SA_BEYOND_ZERO) {
        out.asymptote = end->zero_alpha;
        out.asymptote_q = end->zero_q;
    }
    return out;
}

static void set_least(cmp_branch *to, const sa_branch *from)
{
    for (size_t i = 0; i < from->count; i++) {
        const sa_line_vertex *v = &from->vertex[i];
        const double mass = mpfr_get_d(v->eta_M, MPFR_RNDN);
        if (i > 0 && !(mass < to->least_mass))
            continue;
        to->least_mass = mass;
        to->least_mass_error = (v->eta_M_error + v->value_error) / mass;
    }
}

static cv_status copy_branch(cmp_branch *to, const sa_lines *lines, const sa_branch *from, cv_message *why)
{
    for (size_t i = 0; i < from->count; i++) {
        cmp_line_point *p = cmp_branch_append(to);
        if (p == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        copy_vertex(p, &from->vertex[i]);
    }
    to->ends[0] = end_of(lines, from, &from->start);
    to->ends[1] = end_of(lines, from, &from->end);
    set_least(to, from);
    return CV_OK;
}

static cv_status find(void *opaque, cmp_branches *out, int digits, cv_message *why)
{
    handle *h = opaque;
    const sa_lines_range range = {&h->range[0], &h->range[1], &h->range[2], &h->range[3]};
    cv_status status = sa_lines_find(&h->lines, &h->params, &range, digits, why);
    if (status != CV_OK)
        return status;
    h->has_lines = 1;
    out->status = h->lines.decided;
    out->why = h->lines.reason;
    for (size_t i = 0; status == CV_OK && i < h->lines.count; i++) {
        cmp_branch *b = cmp_branches_append(out);
        status = b != NULL ? copy_branch(b, &h->lines, &h->lines.branch[i], why)
                           : cv_fail(why, CV_FAILED, "out of memory");
    }
    return status;
}

static cv_status point(void *opaque, cmp_line_point *out, int by_q, mpfr_srcptr given, mpfr_srcptr start,
                       double reach, int digits, cv_message *why)
{
    const handle *h = opaque;
    sa_line_vertex v;
    int rises;
    cv_status status = sa_line_point_from(&v, &rises, h->sweep, h->track, by_q ? SA_GIVEN_Q : SA_GIVEN_ALPHA,
                                          given, start, digits);
    if (status != CV_OK)
        return cv_fail(why, status, "no point of a line next to %.15g", mpfr_get_d(start, MPFR_RNDN));
    copy_vertex(out, &v);
    out->turns = 0;
    const double from = mpfr_get_d(start, MPFR_RNDN);
    const double off = mpfr_get_d(by_q ? v.alpha : v.q, MPFR_RNDN) - from;
    if (!(fabs(off) <= reach + 4e-16 * from) || rises == 0)
        out->decided = CV_UNDECIDED;
    sa_line_vertex_clear(&v);
    return CV_OK;
}

static cv_status need_field(handle *h, cv_message *why)
{
    if (h->field != NULL)
        return CV_OK;
    h->field_floor = FLOOR / cv_number_get_double(&h->range[3]);
    cv_status status = sa_map_build(&h->map, &h->params, cv_number_get_double(&h->range[0]),
                                    cv_number_get_double(&h->range[1]), why);
    if (status != CV_OK)
        return status;
    h->field = sa_field_new(&h->map, h->track, h->field_floor / 2);
    if (h->field != NULL)
        return CV_OK;
    sa_map_clear(&h->map);
    return cv_fail(why, CV_FAILED, "out of memory");
}

/* Where the lines do not tell: by the crossings of the real axis at this velocity. */
static cv_status count_crossings(handle *h, int *roots, cv_status *decided, double alpha, size_t mass_count,
                                 const double *mass_ratios, cv_message *why)
{
    sa_crossings list;
    cv_status status = need_field(h, why);
    if (status == CV_OK)
        status = sa_crossings_find(&list, &h->map, h->field, alpha, h->field_floor, why);
    if (status != CV_OK)
        return status == CV_UNDECIDED ? CV_OK : status;
    for (size_t i = 0; i < mass_count; i++)
        if (decided[i] != CV_OK)
            decided[i] = sa_crossings_count(&roots[i], &list, 1 / mass_ratios[i]);
    sa_crossings_clear(&list);
    return CV_OK;
}

/* By the lines passed. */
static cv_status count(void *opaque, int *roots, cv_status *decided, double alpha, size_t mass_count,
                       const double *mass_ratios, cv_message *why)
{
    handle *h = opaque;
    int all = 1;
    cv_status status = CV_OK;
    for (size_t i = 0; i < mass_count; i++) {
        decided[i] = sa_lines_count(&roots[i], &h->lines, alpha, mass_ratios[i], why);
        if (decided[i] != CV_OK && decided[i] != CV_UNDECIDED)
            return decided[i];
        all = all && decided[i] == CV_OK;
    }
    if (!all)
        status = count_crossings(h, roots, decided, alpha, mass_count, mass_ratios, why);
    if (status == CV_OK)
        why->text[0] = '\0';
    return status;
}

const cmp_line_method cmp_lines_semianalytic = {"semianalytic", open_handle, close_handle,
                                                find,           point,       count};
