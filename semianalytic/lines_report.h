/* Instability lines for people and programs; used by command_lines.c only. */
#ifndef CRITVEL_SEMIANALYTIC_LINES_REPORT_H
#define CRITVEL_SEMIANALYTIC_LINES_REPORT_H

#include <stdio.h>

#include "common/casefile.h"
#include "semianalytic/lines.h"
#include "semianalytic/resonances.h"

typedef struct {
    const char *case_name;
    const cv_params *params;
    sa_lines_range range;
    int digits;
    const sa_lines *lines;
    const sa_resonance_list *resonances;
} sa_lines_report;

/* CV_FAILED: out of memory. */
cv_status sa_lines_write_text(FILE *out,
                              const sa_lines_report *report); /* branches, asymptotes beside resonances */
cv_status sa_lines_write_csv(FILE *out, const sa_lines_report *report); /* header, then a row per vertex */
cv_status sa_lines_write_json(FILE *out, const sa_lines_report *report);

/* Names that stand in both. */
const char *sa_line_kind_text(sa_line_kind kind);
const char *sa_end_kind_text(sa_end_kind kind);
const char *sa_beyond_text(sa_beyond_kind kind);

/* Branch that ends at an asymptote: its number, and *at_end 0 for its beginning, 1 for its end; -1: none in
 * the range. */
long sa_lines_branch_of(int *at_end, const sa_lines *lines, size_t asymptote);

/* Decimal text of a coordinate with as many digits as its bound leaves, at most those asked for. Caller
 * frees; NULL when out of memory. */
char *sa_lines_decimal(const mpfr_t x, double error, int digits);

#endif
