#include "compare/figure_line_data.h"

#include <math.h>
#include <stdlib.h>

#include "compare/format.h"
#include "semianalytic/lines.h"

enum { DIGITS = 10 };

cmp_line_range cmp_line_range_of(const cmp_velocities *v, const cv_case *c)
{
    cmp_line_range r = {.low = v->low, .end = cmp_velocities_end(v)};
    r.begin = cmp_velocities_begin(v, r.end);
    cmp_mass_range(&r.lightest, &r.heaviest, c);
    return r;
}

static const char *kind_text(sa_line_kind kind)
{
    static const char *const texts[] = {[SA_LINE_CLOSED] = "closed",
                                        [SA_LINE_INFINITE] = "infinite mass at both ends",
                                        [SA_LINE_ZERO_MASS] = "to zero mass",
                                        [SA_LINE_OUT] = "leaves the velocities",
                                        [SA_LINE_UNDECIDED] = "undecided"};
    return texts[kind];
}

static void write_branches(FILE *data, const sa_lines *lines)
{
    for (size_t i = 0; i < lines->count; i++) {
        const sa_branch *b = &lines->branch[i];
        fprintf(data, "%s# branch %zu, line %zu, %s", i > 0 ? "\n" : "", i + 1, b->line + 1,
                kind_text(b->kind));
        if (b->counted == CV_OK)
            fprintf(data, "; unstable roots on its left %d, right %d", b->roots_left, b->roots_right);
        fputc('\n', data);
        for (size_t j = 0; j < b->count; j++)
            fprintf(data, "%.10g %.10g %.10g\n", mpfr_get_d(b->vertex[j].alpha, MPFR_RNDN),
                    mpfr_get_d(b->vertex[j].eta_M, MPFR_RNDN), mpfr_get_d(b->vertex[j].q, MPFR_RNDN));
    }
}

static cv_status exact(cv_number *out, double x, cv_message *why)
{
    char text[32];
    snprintf(text, sizeof text, "%.12g", x);
    return cv_number_parse(out, text, why);
}

static cv_status find(sa_lines *out, const cv_params *params, const cmp_line_range *r, cv_message *why)
{
    cv_number ends[4];
    const double values[] = {r->low, r->end, r->lightest, r->heaviest};
    const sa_lines_range range = {&ends[0], &ends[1], &ends[2], &ends[3]};
    cv_status status = CV_OK;
    for (int i = 0; i < 4; i++)
        cv_number_init(&ends[i]);
    for (int i = 0; i < 4 && status == CV_OK; i++)
        status = exact(&ends[i], values[i], why);
    if (status == CV_OK)
        status = sa_lines_find(out, params, &range, DIGITS, why);
    for (int i = 0; i < 4; i++)
        cv_number_clear(&ends[i]);
    return status;
}

static cv_status add_extents(cmp_extents *extents, const sa_lines *lines, cv_message *why)
{
    double(*more)[2] = realloc(extents->ends, (extents->count + lines->count + 1) * sizeof *more);
    if (more == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    extents->ends = more;
    for (size_t i = 0; i < lines->count; i++) {
        double *ends = extents->ends[extents->count++];
        ends[0] = HUGE_VAL;
        ends[1] = -HUGE_VAL;
        for (size_t j = 0; j < lines->branch[i].count; j++) {
            const double alpha = mpfr_get_d(lines->branch[i].vertex[j].alpha, MPFR_RNDN);
            ends[0] = fmin(ends[0], alpha);
            ends[1] = fmax(ends[1], alpha);
        }
    }
    return CV_OK;
}

cv_status cmp_line_data(cmp_picture *p, const char *name, size_t *branches, cmp_extents *extents,
                        const cv_params *params, const cmp_line_range *range, size_t level, cv_message *why)
{
    sa_lines lines;
    cmp_damping_text damping;
    *branches = 0;
    cv_status status = find(&lines, params, range, why);
    if (status == CV_BAD_INPUT || status == CV_UNDECIDED) {
        cmp_picture_doubt(p, why->text);
        return CV_OK;
    }
    if (status != CV_OK)
        return status;
    if (lines.decided != CV_OK)
        cmp_picture_doubt(p, lines.reason.text);
    *branches = lines.count;
    if (lines.count > 0) {
        fprintf(p->data, "\n\n# %s %zu\n# alpha, eta_M, q at damping %s\n", name, level + 1,
                cmp_format_damping(&damping, params, DIGITS));
        write_branches(p->data, &lines);
    }
    if (extents != NULL)
        status = add_extents(extents, &lines, why);
    sa_lines_clear(&lines);
    return status;
}
