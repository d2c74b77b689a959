/* The reports of critvel-compare. Same input, same bytes: no dates, no timings. */
#ifndef CRITVEL_COMPARE_REPORT_H
#define CRITVEL_COMPARE_REPORT_H

#include <stdio.h>

#include "compare/printed.h"
#include "compare/run.h"

/* For people. with_transitions: every transition of every mass ratio is listed, too. */
cv_status cmp_report_text(FILE *out, const cmp_run *run, const cmp_printed *printed, int with_transitions,
                          cv_message *why);

/* For programs: schema "critvel-compare/1" (DESIGN, README). */
cv_status cmp_report_json(FILE *out, const cmp_run *run, const cmp_printed *printed, cv_message *why);

#endif
