/* What each method spent on its search: the comparison of computational efficiency. Counts are the same from
 * run to run; processor times are not. */
#ifndef CRITVEL_COMPARE_EFFICIENCY_H
#define CRITVEL_COMPARE_EFFICIENCY_H

#include <stdio.h>

#include "compare/run.h"

/* Of a run after cmp_run_find. Columns: damping, method, evaluations of zeta, those above double precision,
 * largest precision in bits, stability limits found, processor time in ms, and the same per stability limit.
 */
cv_status cmp_efficiency_text(FILE *out, const cmp_run *run, cv_message *why);

/* Schema "critvel-compare-efficiency/1". */
cv_status cmp_efficiency_json(FILE *out, const cmp_run *run, cv_message *why);

#endif
