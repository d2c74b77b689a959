#include "compare/printed.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/printed_file.h"
#include "compare/printed_formulas.h"
#include "compare/printed_velocities.h"

enum { MAX_ROWS = 64 };

/* Which cases of table 1 the run has, by exact parameters; the damping is not part of the table. */
static int same_track(const cv_params *a, const cv_params *b)
{
    return cv_number_compare(&a->mu_s, &b->mu_s) == 0 && cv_number_compare(&a->mu_b, &b->mu_b) == 0 &&
           cv_number_compare(&a->kappa_p, &b->kappa_p) == 0 &&
           cv_number_compare(&a->kappa_b, &b->kappa_b) == 0 && cv_number_compare(&a->eta_s, &b->eta_s) == 0 &&
           cv_number_compare(&a->eta_N, &b->eta_N) == 0;
}

/* The case of the run that is case "key" of table 1 goes to *out; NULL if there is none. */
static cv_status find_case(const cmp_case **out, const cmp_run *run, const cmp_printed_file *file,
                           const char *key, cv_message *why)
{
    cv_params printed;
    *out = NULL;
    cv_params_init(&printed);
    cv_status status = cmp_printed_case(&printed, file, key, why);
    for (size_t i = 0; status == CV_OK && *out == NULL && i < run->case_count; i++)
        if (same_track(&printed, &run->cases[i].from->params))
            *out = &run->cases[i];
    cv_params_clear(&printed);
    return status;
}

/* Whether any case of table 1 is in the run. */
static cv_status concerns(int *out, const cmp_run *run, const cmp_printed_file *file, cv_message *why)
{
    *out = 0;
    for (size_t i = 0; !*out && i < file->count; i++) {
        const cmp_case *found = NULL;
        if (strcmp(file->entries[i].kind, "case") != 0)
            continue;
        cv_status status = find_case(&found, run, file, file->entries[i].key, why);
        if (status != CV_OK)
            return status;
        *out = found != NULL;
    }
    return CV_OK;
}

static cmp_printed_row *new_row(cmp_printed *p, const cmp_printed_entry *e)
{
    if (p->count == MAX_ROWS)
        return NULL;
    cmp_printed_row *row = &p->rows[p->count++];
    snprintf(row->item, sizeof row->item, "%s", e->item);
    snprintf(row->where, sizeof row->where, "%s", e->where);
    return row;
}

static cv_status add_formula(cmp_printed *p, const cmp_printed_entry *e, const cmp_run *run,
                             const cmp_printed_file *file, cv_message *why)
{
    cmp_formula_values v;
    cv_status status = cmp_formula(&v, e->key, run->methods[CMP_DGREEN], &run->file->alpha_min,
                                   &run->file->alpha_max, file, why);
    cmp_printed_row *row = status == CV_OK ? new_row(p, e) : NULL;
    if (row == NULL)
        return status != CV_OK ? status : cv_fail(why, CV_FAILED, "too many printed values");
    snprintf(row->printed, sizeof row->printed, "%.4f", v.as_printed);
    snprintf(row->computed, sizeof row->computed, "%.4f", v.derived);
    row->agrees = fabs(v.as_printed - v.derived) < 5e-5;
    return CV_OK;
}

static cv_status add_notation(cmp_printed *p, const cmp_printed_entry *e, cv_message *why)
{
    cmp_printed_row *row = new_row(p, e);
    if (row == NULL)
        return cv_fail(why, CV_FAILED, "too many printed values");
    snprintf(row->printed, sizeof row->printed, "%s", e->printed);
    snprintf(row->computed, sizeof row->computed, "%s", e->meant);
    row->agrees = strcmp(e->printed, e->meant) == 0;
    return CV_OK;
}

/* Velocities of the moving force; only for a case that is in the run. */
static cv_status add_velocities(cmp_printed *p, const cmp_printed_entry *e, const cmp_run *run,
                                const cmp_printed_file *file, cv_message *why)
{
    const cmp_case *found = NULL;
    cv_status status = find_case(&found, run, file, e->key, why);
    if (status != CV_OK || found == NULL)
        return status;
    if (strcmp(e->kind, "resonances") == 0)
        return cmp_printed_resonances(p, MAX_ROWS, e, &found->from->params, why);
    return cmp_printed_pseudocritical(p, MAX_ROWS, e, &found->from->params, why);
}

static cv_status add_entry(cmp_printed *p, const cmp_printed_entry *e, const cmp_run *run,
                           const cmp_printed_file *file, cv_message *why)
{
    if (strcmp(e->kind, "formula") == 0)
        return add_formula(p, e, run, file, why);
    if (strcmp(e->kind, "notation") == 0)
        return add_notation(p, e, why);
    if (strcmp(e->kind, "case") == 0)
        return CV_OK;
    return add_velocities(p, e, run, file, why);
}

cv_status cmp_printed_make(cmp_printed *out, const cmp_run *run, cv_message *why)
{
    cmp_printed_file file;
    int wanted = 0;
    *out = (cmp_printed){0, NULL};
    cv_status status = cmp_printed_file_read(&file, why);
    if (status == CV_OK)
        status = concerns(&wanted, run, &file, why);
    if (status != CV_OK || !wanted)
        return status;
    out->rows = calloc(MAX_ROWS, sizeof *out->rows);
    if (out->rows == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; status == CV_OK && i < file.count; i++)
        status = add_entry(out, &file.entries[i], run, &file, why);
    if (status != CV_OK)
        cmp_printed_clear(out);
    return status;
}

void cmp_printed_clear(cmp_printed *p)
{
    free(p->rows);
    *p = (cmp_printed){0, NULL};
}
