#include "compare/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void cmp_result_reset(cmp_result *r)
{
    cmp_verdict_init(&r->verdict);
    r->counts = (cmp_counts){-1, 0};
    mpfr_set_zero(r->worst.residual, 1);
    r->worst.used = 0.0;
}

static cv_status level_init(cmp_level *level, size_t mass_count, cv_message *why)
{
    cv_params_init(&level->params);
    memset(level->effort, 0, sizeof level->effort);
    level->results = malloc(mass_count * sizeof *level->results);
    for (int m = 0; m < CMP_METHODS; m++)
        level->lists[m] = malloc(mass_count * sizeof *level->lists[m]);
    if (level->results == NULL || level->lists[0] == NULL || level->lists[1] == NULL) {
        cv_params_clear(&level->params);
        free(level->results);
        free(level->lists[0]);
        free(level->lists[1]);
        return cv_fail(why, CV_FAILED, "out of memory");
    }
    for (size_t i = 0; i < mass_count; i++) {
        cmp_list_init(&level->lists[0][i]);
        cmp_list_init(&level->lists[1][i]);
        mpfr_init2(level->results[i].worst.residual, 53);
        cmp_result_reset(&level->results[i]);
        level->results[i].searches = 0;
    }
    return CV_OK;
}

static void level_clear(cmp_level *level, size_t mass_count)
{
    for (size_t i = 0; i < mass_count; i++) {
        cmp_list_clear(&level->lists[0][i]);
        cmp_list_clear(&level->lists[1][i]);
        mpfr_clear(level->results[i].worst.residual);
    }
    free(level->lists[0]);
    free(level->lists[1]);
    free(level->results);
    cv_params_clear(&level->params);
}

static cv_status case_init(cmp_case *out, const cv_case *from, const cv_number *damping, cv_message *why)
{
    const size_t wanted = damping == NULL ? from->level_count : 1;
    out->from = from;
    out->level_count = 0;
    out->levels = malloc(wanted * sizeof *out->levels);
    if (out->levels == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (; out->level_count < wanted; out->level_count++) {
        cmp_level *level = &out->levels[out->level_count];
        cv_status status = level_init(level, from->mass_count, why);
        if (status != CV_OK)
            return status;
        cv_case_params(&level->params, from, out->level_count);
        if (damping != NULL) {
            cv_number_set(&level->params.eta_p, damping);
            cv_number_set(&level->params.eta_b, damping);
            cv_number_set(&level->params.eta_f, damping);
        }
    }
    return CV_OK;
}

cv_status cmp_run_init(cmp_run *out, const cv_casefile *file, const char *case_name, const cv_number *damping,
                       const cmp_method *const methods[CMP_METHODS], cv_message *why)
{
    const cv_case *only = NULL;
    if (case_name != NULL) {
        cv_status status = cv_casefile_find(&only, file, case_name, why);
        if (status != CV_OK)
            return status;
    }
    out->file = file;
    out->methods[0] = methods[0];
    out->methods[1] = methods[1];
    out->case_count = 0;
    out->cases = malloc(file->case_count * sizeof *out->cases);
    if (out->cases == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < file->case_count; i++) {
        if (only != NULL && only != &file->cases[i])
            continue;
        cv_status status = case_init(&out->cases[out->case_count++], &file->cases[i], damping, why);
        if (status != CV_OK) {
            cmp_run_clear(out);
            return status;
        }
    }
    return CV_OK;
}

void cmp_run_clear(cmp_run *run)
{
    for (size_t i = 0; i < run->case_count; i++) {
        for (size_t l = 0; l < run->cases[i].level_count; l++)
            level_clear(&run->cases[i].levels[l], run->cases[i].from->mass_count);
        free(run->cases[i].levels);
    }
    free(run->cases);
    run->cases = NULL;
    run->case_count = 0;
}

/* Combinations without transitions have no digits of their own: they do not lower those of the others. */
static void add_result(cmp_summary *s, const cmp_level *level, size_t mass)
{
    const cmp_result *r = &level->results[mass];
    s->total++;
    s->of_kind[r->verdict.kind]++;
    if (r->verdict.kind > s->worst)
        s->worst = r->verdict.kind;
    if (r->verdict.kind == CMP_AGREE && level->lists[0][mass].count > 0)
        s->fewest_digits = fmin(s->fewest_digits, r->verdict.digits);
    s->used = fmax(s->used, r->worst.used);
}

void cmp_run_summary(cmp_summary *out, const cmp_run *run)
{
    *out = (cmp_summary){0, {0, 0, 0}, HUGE_VAL, 0.0, CMP_AGREE};
    for (size_t i = 0; i < run->case_count; i++)
        for (size_t l = 0; l < run->cases[i].level_count; l++)
            for (size_t m = 0; m < run->cases[i].from->mass_count; m++)
                add_result(out, &run->cases[i].levels[l], m);
}
