#include <stdlib.h>

#include "semianalytic/decimal.h"
#include "semianalytic/lines_report.h"

/* Digits of places that only help to find something in the text. */
enum { PLACE_DIGITS = 12 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int write_heading(FILE *out, const sa_lines_report *r)
{
    const cv_number *numbers[] = {&r->params->eta_p,  &r->params->eta_b,  &r->params->eta_f,
                                  r->range.alpha_min, r->range.alpha_max, r->range.mass_min,
                                  r->range.mass_max};
    char *text[7];
    int done = 1;
    for (int i = 0; i < 7; ++i) {
        text[i] = cv_number_text(numbers[i], PLACE_DIGITS);
        done = done && text[i] != NULL;
    }
    done = done &&
           fprintf(out,
                   "case %s: eta_p = %s, eta_b = %s, eta_f = %s; %s <= alpha <= %s, %s <= eta_M <= "
                   "%s\n%zu branches of %zu lines; two more roots are unstable on the left of each, with "
                   "alpha to the right and eta_M upwards\n",
                   r->case_name, text[0], text[1], text[2], text[3], text[4], text[5], text[6],
                   r->lines->count, r->lines->line_count) > 0;
    for (int i = 0; i < 7; ++i)
        free(text[i]);
    return done;
}

static int write_point(FILE *out, const char *label, const sa_line_vertex *v, int digits, const char *after)
{
    char *alpha = sa_lines_decimal(v->alpha, v->alpha_error, digits);
    char *q = sa_lines_decimal(v->q, v->q_error, digits);
    char *eta_M = sa_lines_decimal(v->eta_M, v->eta_M_error, digits);
    int done = alpha && q && eta_M &&
               fprintf(out, "  %-14s alpha = %s, eta_M = %s, q = %s%s%s", label, alpha, eta_M, q, after,
                       v->decided == CV_OK ? "\n" : " (undecided)\n") > 0;
    free(alpha);
    free(q);
    free(eta_M);
    return done;
}

static int write_beyond(FILE *out, const sa_lines *lines, const sa_line_end *end, int digits)
{
    char *alpha = NULL;
    int done = 1;
    switch (end->beyond) {
    case SA_BEYOND_ASYMPTOTE:
        alpha = sa_lines_decimal(lines->asymptotes.item[end->number].alpha,
                                 lines->asymptotes.item[end->number].alpha_error, digits);
        done = alpha && fprintf(out, "%17sthen to infinite mass at alpha = %s\n", "", alpha) > 0;
        break;
    case SA_BEYOND_ZERO:
        done = fprintf(out, "%17sthen to infinite mass where zeta = 0: alpha = %.10g, q = %.10g\n", "",
                       end->zero_alpha, end->zero_q) > 0;
        break;
    case SA_BEYOND_BRANCH:
        done = fprintf(out, "%17sthen branch %zu\n", "", end->number + 1) > 0;
        break;
    case SA_BEYOND_ALPHA_LOW:
    case SA_BEYOND_ALPHA_HIGH:
        done = fprintf(out, "%17sthen out of the range of alpha at its %s end\n", "",
                       end->beyond == SA_BEYOND_ALPHA_LOW ? "lower" : "upper") > 0;
        break;
    case SA_BEYOND_VERTICAL:
        done = fprintf(out, "%17sthen to infinite mass at alpha = %.10g, q = %.10g\n", "", end->zero_alpha,
                       end->zero_q) > 0;
        break;
    default:
        break;
    }
    free(alpha);
    return done;
}

static int write_end(FILE *out, const sa_lines *lines, const char *label, const sa_line_end *end,
                     const sa_line_vertex *v, int digits)
{
    char after[32];
    snprintf(after, sizeof after, " (%s)", sa_end_kind_text(end->kind));
    return write_point(out, label, v, digits, after) && write_beyond(out, lines, end, digits);
}

static int write_marks(FILE *out, const sa_branch *b, int digits)
{
    int done = 1;
    for (size_t i = 0; i < b->count && done; ++i) {
        const sa_line_vertex *v = &b->vertex[i];
        if (v->marks & SA_MARK_TURN)
            done = write_point(out, "turning point", v, digits, "");
        else if (v->marks & SA_MARK_LEAST_MASS)
            done = write_point(out, "least mass", v, digits, "");
        else if (v->marks & SA_MARK_MOST_MASS)
            done = write_point(out, "most mass", v, digits, "");
    }
    return done;
}

static int write_counts(FILE *out, const sa_branch *b)
{
    if (b->counted != CV_OK)
        return fputs("  roots          not counted: other lines are too near\n", out) >= 0;
    const sa_line_vertex *v = &b->vertex[b->counted_at];
    if (v->marks & SA_MARK_VERTICAL)
        return fprintf(out, "  roots          %d unstable on the left, %d on the right\n", b->roots_left,
                       b->roots_right) > 0;
    return fprintf(
               out,
               "  roots          %d unstable on the left, %d on the right, at alpha = %.10g, eta_M = %.10g\n",
               b->roots_left, b->roots_right, mpfr_get_d(v->alpha, MPFR_RNDN),
               mpfr_get_d(v->eta_M, MPFR_RNDN)) > 0;
}

static int write_branch(FILE *out, const sa_lines *lines, size_t i, int digits)
{
    const sa_branch *b = &lines->branch[i];
    int done = fprintf(out, "\nbranch %zu of line %zu (%s), %zu points\n", i + 1, b->line + 1,
                       sa_line_kind_text(b->kind), b->count) > 0;
    done = done && write_end(out, lines, "from", &b->start, &b->vertex[0], digits);
    done = done && write_marks(out, b, digits);
    if (b->vertex[0].marks & b->vertex[b->count - 1].marks & SA_MARK_VERTICAL)
        done = done && fputs("  vertical\n", out) >= 0;
    if (b->start.kind != SA_END_CLOSED)
        done = done && write_end(out, lines, "to", &b->end, &b->vertex[b->count - 1], digits);
    return done && write_counts(out, b);
}

/* One row of the table of velocities. */
typedef struct {
    mpfr_srcptr alpha;
    double error;
    const sa_asymptote *asymptote; /* or */
    const sa_resonance *resonance;
    size_t number;
} velocity;

static int by_alpha(const void *left, const void *right)
{
    const velocity *a = left, *b = right;
    return mpfr_cmp(a->alpha, b->alpha);
}

static int write_asymptote(FILE *out, const sa_lines *lines, const velocity *v)
{
    int at_end;
    long branch = sa_lines_branch_of(&at_end, lines, v->number);
    const char *undecided = v->asymptote->decided == CV_OK ? "" : " (undecided)";
    if (!v->asymptote->has_line)
        return fprintf(out, "zeros of c with zeta <= 0: no line%s\n", undecided) > 0;
    if (branch < 0)
        return fprintf(out, "asymptote, no branch in the range%s\n", undecided) > 0;
    return fprintf(out, "asymptote, branch %ld %s%s\n", branch + 1, at_end ? "ends" : "begins", undecided) >
           0;
}

static int write_velocity(FILE *out, const sa_lines_report *r, const velocity *v)
{
    char *alpha = sa_lines_decimal(v->alpha, v->error, r->digits);
    int done = alpha && fprintf(out, "  %-*s  ", r->digits + 2, alpha) > 0;
    if (done && v->resonance != NULL)
        done = fprintf(out, "resonance of the moving force, %s\n",
                       sa_resonance_kind_text(v->resonance->kind)) > 0;
    else if (done)
        done = write_asymptote(out, r->lines, v);
    free(alpha);
    return done;
}

static int write_velocities(FILE *out, const sa_lines_report *r)
{
    const sa_asymptote_list *asymptotes = &r->lines->asymptotes;
    size_t n = 0;
    velocity *row = calloc(asymptotes->count + r->resonances->count + 1, sizeof *row);
    int done =
        row && fputs("\nvertical asymptotes, and resonance velocities of the moving force (of all alpha)\n",
                     out) >= 0;
    for (size_t i = 0; i < asymptotes->count && done; ++i)
        row[n++] = (velocity){asymptotes->item[i].alpha, asymptotes->item[i].alpha_error,
                              &asymptotes->item[i], NULL, i};
    for (size_t i = 0; i < r->resonances->count && done; ++i)
        row[n++] = (velocity){r->resonances->item[i].alpha, 0, NULL, &r->resonances->item[i], i};
    if (done && n > 0)
        qsort(row, n, sizeof *row, by_alpha);
    for (size_t i = 0; i < n && done; ++i)
        done = write_velocity(out, r, &row[i]);
    free(row);
    return done;
}

cv_status sa_lines_write_text(FILE *out, const sa_lines_report *r)
{
    const sa_lines *lines = r->lines;
    int done = write_heading(out, r);
    for (size_t i = 0; i < lines->count && done; ++i)
        done = write_branch(out, lines, i, least(r->digits, PLACE_DIGITS));
    done = done && write_velocities(out, r);
    if (lines->place_count > 0)
        done = done && fputs("\nundecided\n", out) >= 0;
    for (size_t i = 0; i < lines->place_count && done; ++i)
        done = fprintf(out, "  alpha = %.15g, q = %.6g\n", lines->place[i][0], lines->place[i][1]) > 0;
    return done ? CV_OK : CV_FAILED;
}
