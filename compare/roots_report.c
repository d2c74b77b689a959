#include "compare/roots_report.h"

#include <math.h>

#include "common/cli.h"
#include "compare/format.h"
#include "compare/json_parts.h"
#include "compare/table.h"

enum { PARAMETER_DIGITS = 20 };

static const cmp_root *first_claim(const cmp_root_row *row)
{
    return row->by[0] != NULL ? row->by[0] : row->by[1];
}

static const char *found_by(const cmp_root_row *row, const cmp_roots_report *r)
{
    if (row->by[0] != NULL && row->by[1] != NULL)
        return "both";
    return r->names[row->by[0] == NULL];
}

static void add_row(cmp_table *t, const cmp_root_row *row, const cmp_roots_report *r)
{
    const cmp_root *claim = first_claim(row);
    const int digits = r->choice->digits;
    cmp_number_text re, im, agreed, residual;
    cmp_format_claimed(&re, claim->re, claim->error, digits);
    cmp_format_claimed(&im, claim->im, claim->error, digits);
    snprintf(agreed.text, sizeof agreed.text, "-");
    if (row->verdict.kind == CMP_AGREE && isfinite(row->verdict.digits))
        cmp_format_digits(&agreed, row->verdict.digits);
    snprintf(residual.text, sizeof residual.text, "-");
    if (!mpfr_zero_p(row->residual))
        cmp_format_mpfr(&residual, row->residual, 2);
    cmp_table_add(t, (const char *const[]){row->unstable ? "unstable" : "stable", found_by(row, r), re.text,
                                           im.text, agreed.text, residual.text,
                                           cmp_kind_name(row->verdict.kind)});
}

static void print_counts(FILE *out, const cmp_roots_report *r)
{
    fputs("\nunstable roots by the argument principle:", out);
    for (int m = 0; m < CMP_METHODS; m++) {
        const int n = r->roots->lists[m].unstable;
        if (n >= 0)
            fprintf(out, " %d by %s%s", n, r->names[m], m == 0 ? "," : "\n");
        else
            fprintf(out, " undecided by %s%s", r->names[m], m == 0 ? "," : "\n");
    }
}

static void print_reasons(FILE *out, const cmp_roots_report *r)
{
    for (size_t i = 0; i < r->roots->count; i++) {
        const cmp_verdict *v = &r->roots->rows[i].verdict;
        if (v->kind != CMP_AGREE)
            fprintf(out, "  %s: %s\n", cmp_kind_name(v->kind), v->reason.text);
    }
}

static void print_verdict(FILE *out, const cmp_roots_report *r)
{
    const cmp_verdict *v = &r->roots->verdict;
    cmp_number_text text;
    double used = 0.0;
    for (size_t i = 0; i < r->roots->count; i++)
        used = fmax(used, r->roots->rows[i].used);
    fprintf(out, "\nverdict: %s", cmp_kind_name(v->kind));
    if (v->kind != CMP_AGREE)
        fprintf(out, " (%s)\n", v->reason.text);
    else
        fprintf(out, " (at least %s digits; put back, |z - 1| is at most %.2g of what the bounds allow)\n",
                cmp_format_digits(&text, v->digits), used);
}

cv_status cmp_roots_report_text(FILE *out, const cmp_roots_report *r, cv_message *why)
{
    static const char *const heading[] = {"root",   "found by", "Re qbar", "Im qbar",
                                          "digits", "|z - 1|",  "verdict"};
    const cv_case *c = r->choice->chosen;
    cmp_damping_text damping;
    cmp_number_text alpha, eta_M;
    cmp_table t;
    fprintf(out, "critvel-compare %s roots: %s against %s, %d digits\n\n", CV_VERSION, r->names[0],
            r->names[1], r->choice->digits);
    fprintf(out, "%s %s, damping %s, alpha = %s, eta_M = %s\n\n", c->is_track ? "track" : "case", c->name,
            cmp_format_damping(&damping, &r->choice->params, PARAMETER_DIGITS),
            cmp_format_exact(&alpha, &r->selection->alpha.value, PARAMETER_DIGITS),
            cmp_format_exact(&eta_M, &r->selection->mass_ratio.value, PARAMETER_DIGITS));
    cmp_table_init(&t, "llllrrl");
    cmp_table_add(&t, heading);
    for (size_t i = 0; i < r->roots->count; i++)
        add_row(&t, &r->roots->rows[i], r);
    cv_status status = cmp_table_print(&t, out, 2, why);
    cmp_table_clear(&t);
    if (status != CV_OK)
        return status;
    print_reasons(out, r);
    print_counts(out, r);
    print_verdict(out, r);
    return CV_OK;
}

static json_t *json_claim(const cmp_root *claim, int digits)
{
    cmp_number_text re, im, error;
    if (claim == NULL)
        return json_null();
    cmp_format_claimed(&re, claim->re, claim->error, digits);
    cmp_format_claimed(&im, claim->im, claim->error, digits);
    return json_pack("{s:s, s:s, s:s, s:b}", "re", re.text, "im", im.text, "error",
                     cmp_format_mpfr(&error, claim->error, 2), "decided", claim->decided == CV_OK);
}

static json_t *json_row(const cmp_root_row *row, const cmp_roots_report *r)
{
    const int digits = r->choice->digits;
    cmp_number_text residual;
    return json_pack(
        "{s:b, s:o, s:o, s:o, s:o}", "unstable", row->unstable, r->names[0], json_claim(row->by[0], digits),
        r->names[1], json_claim(row->by[1], digits), "largest_residual",
        mpfr_zero_p(row->residual) ? json_null() : json_string(cmp_format_mpfr(&residual, row->residual, 2)),
        "agreement", cmp_json_verdict(&row->verdict));
}

static json_t *json_count(const cmp_root_list *list)
{
    return list->unstable >= 0 ? json_integer(list->unstable) : json_null();
}

cv_status cmp_roots_report_json(FILE *out, const cmp_roots_report *r, cv_message *why)
{
    const cmp_roots *roots = r->roots;
    cmp_number_text alpha, eta_M;
    json_t *rows = json_array();
    int failed = 0;
    for (size_t i = 0; i < roots->count; i++)
        failed |= json_array_append_new(rows, json_row(&roots->rows[i], r));
    json_t *counts = json_pack("{s:o, s:o}", r->names[0], json_count(&roots->lists[0]), r->names[1],
                               json_count(&roots->lists[1]));
    json_t *root = json_pack("{s:s, s:s, s:s, s:s, s:o, s:s, s:s, s:i, s:o, s:o, s:o}", "schema",
                             "critvel-compare-roots/1", "version", CV_VERSION, "verdict",
                             cmp_kind_name(roots->verdict.kind), "case", r->choice->chosen->name, "damping",
                             cmp_json_damping(&r->choice->params), "alpha",
                             cmp_format_exact(&alpha, &r->selection->alpha.value, PARAMETER_DIGITS), "eta_M",
                             cmp_format_exact(&eta_M, &r->selection->mass_ratio.value, PARAMETER_DIGITS),
                             "digits", r->choice->digits, "unstable_roots", counts, "roots", rows,
                             "agreement", cmp_json_verdict(&roots->verdict));
    return cmp_json_write(root, failed, out, why);
}
