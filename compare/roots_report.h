/* What critvel-compare roots writes. Same input, same bytes. */
#ifndef CRITVEL_COMPARE_ROOTS_REPORT_H
#define CRITVEL_COMPARE_ROOTS_REPORT_H

#include <stdio.h>

#include "common/selection.h"
#include "compare/roots.h"

/* What was compared: the choice names case, damping and digits, the selection alpha and eta_M. */
typedef struct {
    const cv_choice *choice;
    const cv_selection *selection;
    const char *names[CMP_METHODS];
    const cmp_roots *roots;
} cmp_roots_report;

cv_status cmp_roots_report_text(FILE *out, const cmp_roots_report *r, cv_message *why);

/* Schema "critvel-compare-roots/1" (README). */
cv_status cmp_roots_report_json(FILE *out, const cmp_roots_report *r, cv_message *why);

#endif
