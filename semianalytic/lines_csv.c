#include <math.h>
#include <stdlib.h>

#include "semianalytic/decimal.h"
#include "semianalytic/lines_report.h"

const char *sa_line_kind_text(sa_line_kind kind)
{
    static const char *const text[] = {"closed", "infinite mass at both ends", "to zero mass",
                                       "leaves the range of alpha", "undecided"};
    return text[kind];
}

const char *sa_end_kind_text(sa_end_kind kind)
{
    static const char *const text[] = {"closed",        "lowest alpha", "highest alpha", "lowest eta_M",
                                       "highest eta_M", "undecided",    "branch curve",  "special velocity"};
    return text[kind];
}

const char *sa_beyond_text(sa_beyond_kind kind)
{
    static const char *const text[] = {"nothing",      "asymptote",     "zero of zeta",    "branch",
                                       "lowest alpha", "highest alpha", "special velocity"};
    return text[kind];
}

static int leads_to(const sa_line_end *end, size_t asymptote)
{
    return end->beyond == SA_BEYOND_ASYMPTOTE && end->number == asymptote;
}

long sa_lines_branch_of(int *at_end, const sa_lines *lines, size_t asymptote)
{
    for (size_t i = 0; i < lines->count; ++i) {
        *at_end = leads_to(&lines->branch[i].end, asymptote);
        if (*at_end || leads_to(&lines->branch[i].start, asymptote))
            return (long)i;
    }
    return -1;
}

char *sa_lines_decimal(const mpfr_t x, double error, int digits)
{
    double size = fabs(mpfr_get_d(x, MPFR_RNDN));
    int held = error > 0 && size > 0 ? (int)floor(fmin(log10(size / error), CV_DIGITS_MAX)) : digits;
    held = held < digits ? held : digits;
    return sa_decimal_text(x, held < 1 ? 1 : held);
}

static const char *mark_text(int marks)
{
    if (marks & SA_MARK_VERTICAL)
        return "vertical";
    if (marks & SA_MARK_CURVE)
        return "branch curve";
    if (marks & SA_MARK_CUT)
        return "cut";
    if (marks & SA_MARK_TURN)
        return "turning point";
    if (marks & SA_MARK_LEAST_MASS)
        return "least eta_M";
    return marks & SA_MARK_MOST_MASS ? "most eta_M" : "";
}

static int write_vertex(FILE *out, const sa_branch *b, size_t branch, size_t i, int digits)
{
    const sa_line_vertex *v = &b->vertex[i];
    char *alpha = sa_lines_decimal(v->alpha, v->alpha_error, digits);
    char *q = sa_lines_decimal(v->q, v->q_error, digits);
    char *eta_M = sa_lines_decimal(v->eta_M, v->eta_M_error, digits);
    int done = alpha && q && eta_M &&
               fprintf(out, "%zu,%zu,%s,%s,%s,%s,%s\n", branch + 1, b->line + 1, alpha, q, eta_M,
                       mark_text(v->marks), v->decided == CV_OK ? "" : "undecided") > 0;
    free(alpha);
    free(q);
    free(eta_M);
    return done;
}

cv_status sa_lines_write_csv(FILE *out, const sa_lines_report *report)
{
    int done = fputs("branch,line,alpha,q,eta_M,mark,decided\n", out) >= 0;
    for (size_t i = 0; i < report->lines->count; ++i)
        for (size_t k = 0; k < report->lines->branch[i].count && done; ++k)
            done = write_vertex(out, &report->lines->branch[i], i, k, report->digits);
    return done ? CV_OK : CV_FAILED;
}
