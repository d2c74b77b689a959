/* Instability lines of dgreen/ as compare sees them. */
#include <math.h>
#include <stdlib.h>

#include "compare/lines.h"
#include "dgreen/lines.h"
#include "dgreen/sampler.h"

/* Curves for counting are listed down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.3;

typedef struct {
    cv_params params;
    double range[4]; /* alpha_min, alpha_max, mass_min, mass_max */
    dg_sampler sampler;
} handle;

static void close_handle(void *opaque)
{
    handle *h = opaque;
    dg_sampler_clear(&h->sampler);
    cv_params_clear(&h->params);
    free(h);
}

static cv_status open_handle(void **out, const cv_params *track, const cv_number *const range[4],
                             cv_message *why)
{
    handle *h = calloc(1, sizeof *h);
    if (h == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (int i = 0; i < 4; i++)
        h->range[i] = cv_number_get_double(range[i]);
    cv_status status = dg_sampler_init(&h->sampler, track, h->range[0], h->range[1], why);
    if (status != CV_OK) {
        free(h);
        return status;
    }
    cv_params_init(&h->params);
    cv_params_set(&h->params, track);
    *out = h;
    return CV_OK;
}

/* What the list of asymptotes says about the one at this velocity. */
static double asymptote_error(const dg_lines *lines, double alpha)
{
    double error = (double)NAN, nearest = HUGE_VAL;
    for (size_t i = 0; i < lines->asymptotes.count; i++) {
        const dg_asymptote *a = &lines->asymptotes.items[i];
        const double off = fabs(mpfr_get_d(a->alpha, MPFR_RNDN) - alpha);
        if (off < nearest) {
            nearest = off;
            error = off + a->error;
        }
    }
    return error;
}

static cmp_line_end end_of(const dg_lines *lines, const dg_line *line, int e)
{
    static const cmp_end_kind kinds[] = {
        [DG_LINE_CLOSED] = CMP_END_CLOSED,       [DG_LINE_INFINITE_MASS] = CMP_END_MASS_HIGH,
        [DG_LINE_TOP] = CMP_END_MASS_HIGH,       [DG_LINE_BOTTOM] = CMP_END_MASS_LOW,
        [DG_LINE_ALPHA_MIN] = CMP_END_ALPHA_LOW, [DG_LINE_ALPHA_MAX] = CMP_END_ALPHA_HIGH,
        [DG_LINE_UNDECIDED] = CMP_END_UNDECIDED};
    cmp_line_end end = {kinds[line->exits[e]], (double)NAN, (double)NAN, 0, 0, 0};
    end.open = line->exits[e] == DG_LINE_TOP;
    end.zero_mass = line->zero_mass[e];
    if (line->exits[e] != DG_LINE_INFINITE_MASS)
        return end;
    end.asymptote = line->asymptote[e];
    end.asymptote_q = line->asymptote_q[e];
    if (end.asymptote_q <= 0)
        end.asymptote_error = asymptote_error(lines, end.asymptote);
    return end;
}

/* alpha is a double and taken as exact, except at a turning point. */
static cv_status copy_line(cmp_branch *to, const dg_lines *lines, const dg_line *from, cv_message *why)
{
    for (size_t i = 0; i < from->count; i++) {
        const dg_line_vertex *v = &from->vertices[i];
        cmp_line_point *p = cmp_branch_append(to);
        if (p == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        mpfr_set_d(p->alpha, v->alpha, MPFR_RNDN);
        mpfr_set_d(p->q, v->q, MPFR_RNDN);
        mpfr_set_d(p->eta_M, v->mass_ratio, MPFR_RNDN);
        p->turns = v->turns;
        p->alpha_error = v->turns ? (double)NAN : 0;
        p->q_error = v->turns ? (double)NAN : v->q_error;
    }
    for (int e = 0; e < 2; e++)
        to->ends[e] = end_of(lines, from, e);
    to->least_mass = from->count > 0 ? from->vertices[from->least].mass_ratio : (double)NAN;
    return CV_OK;
}

static cv_status find(void *opaque, cmp_branches *out, int digits, cv_message *why)
{
    const handle *h = opaque;
    dg_lines lines;
    (void)digits; /* of vertices in double; points have digits */
    cv_status status =
        dg_lines_find(&lines, &h->params, h->range[0], h->range[1], h->range[2], h->range[3], why);
    if (status == CV_UNDECIDED) {
        out->status = CV_UNDECIDED;
        out->why = *why;
        why->text[0] = '\0';
        return CV_OK;
    }
    for (size_t i = 0; status == CV_OK && i < lines.count; i++) {
        cmp_branch *b = cmp_branches_append(out);
        status =
            b != NULL ? copy_line(b, &lines, &lines.lines[i], why) : cv_fail(why, CV_FAILED, "out of memory");
    }
    if (status == CV_OK && lines.doubt_count > 0) {
        out->status = CV_UNDECIDED;
        cv_fail(&out->why, CV_UNDECIDED, "%.12g < alpha < %.12g: %.300s", lines.doubts[0].alpha_low,
                lines.doubts[0].alpha_high, lines.doubts[0].why.text);
    }
    dg_lines_clear(&lines);
    return status;
}

static void copy_coordinate(mpfr_ptr to, double *error, mpfr_srcptr from, double from_error)
{
    mpfr_set_prec(to, mpfr_get_prec(from));
    mpfr_set(to, from, MPFR_RNDN);
    *error = from_error;
}

static cv_status point(void *opaque, cmp_line_point *out, int by_q, mpfr_srcptr given, mpfr_srcptr start,
                       double reach, int digits, cv_message *why)
{
    const handle *h = opaque;
    dg_line_point p;
    dg_line_point_init(&p);
    cv_status status = by_q ? dg_line_at_frequency(&p, h->sampler.track, given, start, reach, digits, why)
                            : dg_line_at_alpha(&p, h->sampler.track, given, start, reach, digits, why);
    if (status == CV_OK) {
        copy_coordinate(out->alpha, &out->alpha_error, p.alpha, p.alpha_error);
        copy_coordinate(out->q, &out->q_error, p.frequency, p.frequency_error);
        copy_coordinate(out->eta_M, &out->eta_M_error, p.mass_ratio, p.mass_ratio_error);
    }
    out->decided = status;
    dg_line_point_clear(&p);
    return status;
}

/* By the winding of one curve that serves all mass ratios. */
static cv_status count(void *opaque, int *roots, cv_status *decided, double alpha, size_t mass_count,
                       const double *mass_ratios, cv_message *why)
{
    handle *h = opaque;
    double least = HUGE_VAL;
    for (size_t i = 0; i < mass_count; i++)
        least = fmin(least, 1 / mass_ratios[i]);
    const cv_status curve = dg_sampler_curve(&h->sampler, alpha, FLOOR * least, why);
    cv_status status = curve == CV_UNDECIDED ? CV_OK : curve;
    for (size_t i = 0; i < mass_count && status == CV_OK; i++) {
        decided[i] =
            curve == CV_OK ? dg_sampler_count(&roots[i], &h->sampler, 1 / mass_ratios[i], why) : curve;
        if (decided[i] != CV_OK && decided[i] != CV_UNDECIDED)
            status = decided[i];
    }
    if (status == CV_OK)
        why->text[0] = '\0';
    return status;
}

const cmp_line_method cmp_lines_dgreen = {"dgreen", open_handle, close_handle, find, point, count};
