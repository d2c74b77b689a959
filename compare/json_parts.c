#include "compare/json_parts.h"

#include <math.h>

#include "compare/format.h"

enum { PARAMETER_DIGITS = 20 };

json_t *cmp_json_damping(const cv_params *p)
{
    cmp_number_text a, b, c;
    return json_pack("{s:s, s:s, s:s}", "eta_p", cmp_format_exact(&a, &p->eta_p, PARAMETER_DIGITS), "eta_b",
                     cmp_format_exact(&b, &p->eta_b, PARAMETER_DIGITS), "eta_f",
                     cmp_format_exact(&c, &p->eta_f, PARAMETER_DIGITS));
}

json_t *cmp_json_verdict(const cmp_verdict *v)
{
    const int known = v->kind == CMP_AGREE && isfinite(v->digits);
    return json_pack("{s:s, s:o, s:o}", "verdict", cmp_kind_name(v->kind), "digits",
                     known ? json_real(cmp_floor_tenth(v->digits)) : json_null(), "reason",
                     v->reason.text[0] != '\0' ? json_string(v->reason.text) : json_null());
}

json_t *cmp_json_number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

cv_status cmp_json_write(json_t *root, int failed, FILE *out, cv_message *why)
{
    failed |= root == NULL || json_dumpf(root, out, JSON_INDENT(1) | JSON_REAL_PRECISION(15)) != 0;
    json_decref(root);
    return failed || fputc('\n', out) == EOF ? cv_fail(why, CV_FAILED, "the JSON report could not be written")
                                             : CV_OK;
}
