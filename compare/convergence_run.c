/* The searches behind convergence.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "compare/convergence.h"

static cv_level *make_levels(int first, int last)
{
    cv_level *levels = calloc((size_t)(last - first + 1), sizeof *levels);
    for (int k = first; levels != NULL && k <= last; k++) {
        cv_level *level = &levels[k - first];
        cv_number *eta[] = {&level->eta_p, &level->eta_b, &level->eta_f};
        char text[16];
        snprintf(text, sizeof text, "1e-%d", k);
        for (int i = 0; i < 3; i++) {
            cv_number_init(eta[i]);
            (void)cv_number_parse(eta[i], text, NULL);
        }
    }
    return levels;
}

cv_status cmp_convergence_levels(cv_casefile *file, int first, int last, cv_message *why)
{
    for (size_t c = 0; c < file->case_count; c++) {
        cv_case *at = &file->cases[c];
        cv_level *levels = make_levels(first, last);
        if (levels == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        for (size_t i = 0; i < at->level_count; i++) {
            cv_number_clear(&at->levels[i].eta_p);
            cv_number_clear(&at->levels[i].eta_b);
            cv_number_clear(&at->levels[i].eta_f);
        }
        free(at->levels);
        at->levels = levels;
        at->level_count = (size_t)(last - first + 1);
    }
    return CV_OK;
}

cv_status cmp_convergence_init(cmp_convergence_run *out, const cv_casefile *file, const char *case_name,
                               cv_message *why)
{
    static const cmp_method *const methods[] = {&cmp_method_semianalytic, &cmp_method_dgreen};
    cv_status status = cmp_run_init(&out->run, file, case_name, NULL, methods, why);
    if (status != CV_OK)
        return status;
    out->undamped = calloc(out->run.case_count, sizeof *out->undamped);
    out->counts = calloc(out->run.case_count, sizeof *out->counts);
    int complete = out->undamped != NULL && out->counts != NULL;
    for (size_t c = 0; c < out->run.case_count && complete; c++) {
        const size_t masses = out->run.cases[c].from->mass_count;
        out->undamped[c] = calloc(masses, sizeof *out->undamped[c]);
        out->counts[c] = calloc(masses, sizeof *out->counts[c]);
        complete = out->undamped[c] != NULL && out->counts[c] != NULL;
        for (size_t m = 0; m < masses && complete; m++)
            cmp_list_init(&out->undamped[c][m]);
    }
    if (complete)
        return CV_OK;
    cmp_convergence_clear(out);
    return cv_fail(why, CV_FAILED, "out of memory");
}

void cmp_convergence_clear(cmp_convergence_run *run)
{
    for (size_t c = 0; c < run->run.case_count; c++) {
        if (run->undamped != NULL && run->undamped[c] != NULL)
            for (size_t m = 0; m < run->run.cases[c].from->mass_count; m++)
                cmp_list_clear(&run->undamped[c][m]);
        if (run->undamped != NULL)
            free(run->undamped[c]);
        if (run->counts != NULL)
            free(run->counts[c]);
    }
    free(run->undamped);
    free(run->counts);
    cmp_run_clear(&run->run);
}

/* alpha (1 +- a little): a tenth of the way to the next transition, at most 1e-4. */
static double beside(const cmp_list *list, const cmp_transition *t, int sign)
{
    const double alpha = mpfr_get_d(t->alpha, MPFR_RNDN);
    double width = 1e-4 * alpha;
    for (size_t i = 0; i < list->count; i++) {
        const double gap = sign * (mpfr_get_d(list->items[i].alpha, MPFR_RNDN) - alpha);
        if (&list->items[i] != t && gap > 0)
            width = fmin(width, gap / 10);
    }
    return alpha + sign * width;
}

static cv_status check_counts(cmp_limit_counts *out, const cmp_list *list, void *handle,
                              const cv_number *mass_ratio)
{
    const size_t i = cmp_list_limit(list);
    *out = list->status == CV_OK ? CMP_COUNTS_AGREE : CMP_COUNTS_UNDECIDED;
    if (i == list->count || list->status != CV_OK)
        return CV_OK;
    const cmp_transition *t = &list->items[i];
    for (int sign = -1; sign <= 1; sign += 2) {
        int roots = 0;
        const cv_status status =
            cmp_method_dgreen.count(handle, &roots, beside(list, t, sign), 1, mass_ratio, NULL);
        if (status == CV_FAILED)
            return status;
        if (status != CV_OK && *out == CMP_COUNTS_AGREE)
            *out = CMP_COUNTS_UNDECIDED;
        if (status == CV_OK && roots != (sign < 0 ? t->below : t->above))
            *out = CMP_COUNTS_DIFFER;
    }
    return CV_OK;
}

static cv_status count_beside(cmp_convergence_run *run, size_t c, const cv_params *params, cv_message *why)
{
    const cv_casefile *file = run->run.file;
    const cv_case *from = run->run.cases[c].from;
    void *handle;
    cv_status status = cmp_method_dgreen.open(&handle, params, &file->alpha_min, &file->alpha_max, why);
    if (status != CV_OK)
        return status;
    for (size_t m = 0; m < from->mass_count && status == CV_OK; m++)
        status = check_counts(&run->counts[c][m], &run->undamped[c][m], handle, &from->mass_ratios[m]);
    cmp_method_dgreen.close(handle);
    return status == CV_OK ? status : cv_fail(why, status, "unstable roots could not be counted");
}

static cv_status find_undamped(cmp_convergence_run *run, size_t c, const cv_params *params, cv_message *why)
{
    const cv_casefile *file = run->run.file;
    const cv_case *from = run->run.cases[c].from;
    cmp_effort effort;
    void *handle;
    const int digits = file->digits < CMP_LIMIT_DIGITS ? file->digits : CMP_LIMIT_DIGITS;
    cv_status status = cmp_method_semianalytic.open(&handle, params, &file->alpha_min, &file->alpha_max, why);
    if (status != CV_OK)
        return status;
    status = cmp_method_semianalytic.find(handle, run->undamped[c], &effort, from->mass_count,
                                          from->mass_ratios, digits, 0, why);
    cmp_method_semianalytic.close(handle);
    return status;
}

/* One case without damping. */
static cv_status limit_job(void *context, size_t c, cv_message *why)
{
    cmp_convergence_run *run = context;
    cv_params params;
    cv_number zero;
    cv_params_init(&params);
    cv_number_init(&zero);
    cv_params_set(&params, &run->run.cases[c].from->params);
    cv_number_set(&params.eta_p, &zero);
    cv_number_set(&params.eta_b, &zero);
    cv_number_set(&params.eta_f, &zero);
    cv_status status = find_undamped(run, c, &params, why);
    if (status == CV_OK)
        status = count_beside(run, c, &params, why);
    cv_number_clear(&zero);
    cv_params_clear(&params);
    return status;
}

cv_status cmp_convergence_find(cmp_convergence_run *run, size_t threads, const cmp_listener *listener,
                               cv_message *why)
{
    cv_status status = cmp_pool_run(threads, run->run.case_count, limit_job, run, listener, why);
    if (status == CV_OK)
        status = cmp_run_find(&run->run, threads, listener, why);
    if (status == CV_OK)
        status = cmp_run_judge(&run->run, threads, listener, why);
    if (status == CV_OK)
        status = cmp_run_search_again(&run->run, threads, listener, why);
    return status;
}

cmp_kind cmp_convergence_verdict(const cmp_convergence_run *run)
{
    cmp_summary summary;
    cmp_run_summary(&summary, &run->run);
    cmp_kind worst = summary.worst;
    for (size_t c = 0; c < run->run.case_count; c++)
        for (size_t m = 0; m < run->run.cases[c].from->mass_count; m++) {
            const cmp_limit_counts counts = run->counts[c][m];
            if (counts == CMP_COUNTS_DIFFER)
                worst = CMP_DISAGREE;
            else if (counts == CMP_COUNTS_UNDECIDED && worst == CMP_AGREE)
                worst = CMP_UNDECIDED;
        }
    return worst;
}
