/* Pieces of JSON that several reports have. NULL when out of memory, which json_pack hands on. */
#ifndef CRITVEL_COMPARE_JSON_PARTS_H
#define CRITVEL_COMPARE_JSON_PARTS_H

#include <stdio.h>

#include <jansson.h>

#include "compare/judge.h"

/* {"eta_p": "1e-10", "eta_b": ..., "eta_f": ...} */
json_t *cmp_json_damping(const cv_params *p);

/* {"verdict": "agree", "digits": 21.3 or null, "reason": "..." or null} */
json_t *cmp_json_verdict(const cmp_verdict *v);

/* x, or null where it is not a finite number */
json_t *cmp_json_number(double x);

/* Writes the document and a newline, and lets it go. failed: 1 when a part of it was lost. */
cv_status cmp_json_write(json_t *root, int failed, FILE *out, cv_message *why);

#endif
