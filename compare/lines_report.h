/* What critvel-compare lines writes. Same input, same bytes. */
#ifndef CRITVEL_COMPARE_LINES_REPORT_H
#define CRITVEL_COMPARE_LINES_REPORT_H

#include <stdio.h>

#include "compare/lines_run.h"

cv_status cmp_lines_report_text(FILE *out, const cmp_lines_run *run, cv_message *why);

/* Schema "critvel-compare-lines/1" (README). */
cv_status cmp_lines_report_json(FILE *out, const cmp_lines_run *run, cv_message *why);

#endif
