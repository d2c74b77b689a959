#include "compare/efficiency.h"

#include <jansson.h>

#include "common/cli.h"
#include "compare/format.h"
#include "compare/table.h"

enum { DIGITS = 8 };

static size_t limits(const cmp_level *level, size_t mass_count, int method)
{
    size_t found = 0;
    for (size_t i = 0; i < mass_count; i++)
        found += cmp_list_limit(&level->lists[method][i]) < level->lists[method][i].count;
    return found;
}

static void add_row(cmp_table *t, const cmp_run *run, const cmp_case *c, const cmp_level *level, int method)
{
    const cmp_effort *e = &level->effort[method];
    const size_t found = limits(level, c->from->mass_count, method);
    char evaluations[32], wide[32], bits[32], count[32], total[32], each[32] = "-";
    cmp_damping_text damping;
    snprintf(evaluations, sizeof evaluations, "%lu", e->evaluations);
    snprintf(wide, sizeof wide, "%lu", e->evaluations_wide);
    snprintf(bits, sizeof bits, "%lu", e->largest_bits);
    snprintf(count, sizeof count, "%zu", found);
    snprintf(total, sizeof total, "%.1f", 1e3 * e->cpu_seconds);
    if (found > 0)
        snprintf(each, sizeof each, "%.1f", 1e3 * e->cpu_seconds / (double)found);
    cmp_table_add(t, (const char *const[]){cmp_format_damping(&damping, &level->params, DIGITS),
                                           run->methods[method]->name, evaluations, wide, bits, count, total,
                                           each});
}

cv_status cmp_efficiency_text(FILE *out, const cmp_run *run, cv_message *why)
{
    static const char *const heading[] = {"damping", "method", "evaluations", "above double",
                                          "bits",    "limits", "ms",          "ms per limit"};
    fprintf(out,
            "critvel-compare %s efficiency: search for the transitions to %d digits, processor time of one "
            "thread\n",
            CV_VERSION, run->file->digits);
    for (size_t i = 0; i < run->case_count; i++) {
        const cmp_case *c = &run->cases[i];
        cmp_table t;
        fprintf(out, "\n%s %s, %zu mass ratios\n\n", c->from->is_track ? "track" : "case", c->from->name,
                c->from->mass_count);
        cmp_table_init(&t, "llrrrrrr");
        cmp_table_add(&t, heading);
        for (size_t l = 0; l < c->level_count; l++)
            for (int m = 0; m < CMP_METHODS; m++)
                add_row(&t, run, c, &c->levels[l], m);
        cv_status status = cmp_table_print(&t, out, 2, why);
        cmp_table_clear(&t);
        if (status != CV_OK)
            return status;
    }
    return CV_OK;
}

static json_t *json_effort(const cmp_run *run, const cmp_case *c, const cmp_level *level, int method)
{
    const cmp_effort *e = &level->effort[method];
    const size_t found = limits(level, c->from->mass_count, method);
    cmp_damping_text damping;
    json_t *each = found > 0 ? json_real(e->cpu_seconds / (double)found) : json_null();
    return json_pack("{s:s, s:s, s:s, s:I, s:I, s:I, s:I, s:f, s:o}", "case", c->from->name, "damping",
                     cmp_format_damping(&damping, &level->params, DIGITS), "method",
                     run->methods[method]->name, "evaluations", (json_int_t)e->evaluations,
                     "evaluations_above_double", (json_int_t)e->evaluations_wide, "largest_precision_bits",
                     (json_int_t)e->largest_bits, "stability_limits", (json_int_t)found, "processor_seconds",
                     e->cpu_seconds, "processor_seconds_per_limit", each);
}

cv_status cmp_efficiency_json(FILE *out, const cmp_run *run, cv_message *why)
{
    json_t *rows = json_array();
    int failed = 0;
    for (size_t i = 0; i < run->case_count; i++)
        for (size_t l = 0; l < run->cases[i].level_count; l++)
            for (int m = 0; m < CMP_METHODS; m++)
                failed |= json_array_append_new(
                    rows, json_effort(run, &run->cases[i], &run->cases[i].levels[l], m));
    json_t *root = json_pack("{s:s, s:i, s:o}", "schema", "critvel-compare-efficiency/1", "digits",
                             run->file->digits, "searches", rows);
    failed |= root == NULL || json_dumpf(root, out, JSON_INDENT(1) | JSON_REAL_PRECISION(6));
    json_decref(root);
    return failed || fputc('\n', out) == EOF ? cv_fail(why, CV_FAILED, "the JSON report could not be written")
                                             : CV_OK;
}
