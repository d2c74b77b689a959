#include "compare/lines_run.h"

#include <math.h>
#include <stdlib.h>

static void level_init(cmp_lines_level *level, const cv_case *from, size_t index, const cv_number *damping)
{
    *level = (cmp_lines_level){0};
    cv_params_init(&level->params);
    cv_case_params(&level->params, from, index);
    if (damping != NULL) {
        cv_number_set(&level->params.eta_p, damping);
        cv_number_set(&level->params.eta_b, damping);
        cv_number_set(&level->params.eta_f, damping);
    }
    for (int m = 0; m < CMP_METHODS; m++)
        cmp_branches_init(&level->lists[m]);
    cmp_verdict_init(&level->verdict);
    cmp_verdict_init(&level->samples.verdict);
}

static cv_status case_init(cmp_lines_case *out, const cv_case *from, const cv_number *damping,
                           cv_message *why)
{
    const size_t count = damping == NULL ? from->level_count : 1;
    *out = (cmp_lines_case){from, 0, malloc(count * sizeof *out->levels)};
    if (out->levels == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (; out->level_count < count; out->level_count++)
        level_init(&out->levels[out->level_count], from, out->level_count, damping);
    return CV_OK;
}

cv_status cmp_lines_run_init(cmp_lines_run *out, const cv_casefile *file, const char *case_name,
                             const cv_number *damping, const cmp_lines_task *task,
                             const cmp_line_method *const methods[CMP_METHODS], cv_message *why)
{
    const cv_case *only = NULL;
    cv_status status = case_name != NULL ? cv_casefile_find(&only, file, case_name, why) : CV_OK;
    if (status != CV_OK)
        return status;
    *out = (cmp_lines_run){*task, {methods[0], methods[1]}, 0, NULL, CMP_AGREE};
    out->cases = malloc(file->case_count * sizeof *out->cases);
    if (out->cases == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; status == CV_OK && i < file->case_count; i++)
        if (only == NULL || only == &file->cases[i])
            status = case_init(&out->cases[out->case_count++], &file->cases[i], damping, why);
    if (status != CV_OK)
        cmp_lines_run_clear(out);
    return status;
}

static void close_handles(const cmp_lines_run *run, cmp_lines_level *level)
{
    for (int m = 0; m < CMP_METHODS; m++) {
        if (level->handles[m] != NULL)
            run->methods[m]->close(level->handles[m]);
        level->handles[m] = NULL;
    }
}

static void level_clear(const cmp_lines_run *run, cmp_lines_level *level)
{
    close_handles(run, level);
    cmp_branch_pairs_clear(&level->pairs);
    for (int m = 0; m < CMP_METHODS; m++)
        cmp_branches_clear(&level->lists[m]);
    cv_params_clear(&level->params);
}

void cmp_lines_run_clear(cmp_lines_run *run)
{
    for (size_t i = 0; i < run->case_count; i++) {
        for (size_t l = 0; l < run->cases[i].level_count; l++)
            level_clear(run, &run->cases[i].levels[l]);
        free(run->cases[i].levels);
    }
    free(run->cases);
    run->cases = NULL;
    run->case_count = 0;
}

static cv_status find(cmp_lines_run *run, cmp_lines_level *level, size_t m, cv_message *why)
{
    cmp_branches *list = &level->lists[m];
    cv_status status = run->methods[m]->open(&level->handles[m], &level->params, run->task.range, why);
    if (status != CV_OK) {
        level->handles[m] = NULL;
        return status;
    }
    list->alpha_min = cv_number_get_double(run->task.range[0]);
    list->alpha_max = cv_number_get_double(run->task.range[1]);
    list->mass_min = cv_number_get_double(run->task.range[2]);
    list->mass_max = cv_number_get_double(run->task.range[3]);
    return run->methods[m]->find(level->handles[m], list, run->task.digits, why);
}

static void gather(cmp_lines_run *run, cmp_lines_level *level)
{
    cmp_verdict *v = &level->verdict;
    for (int m = 0; m < CMP_METHODS; m++)
        if (level->lists[m].status != CV_OK)
            cmp_verdict_worsen(v, CMP_UNDECIDED, "%s could not decide: %.400s", run->methods[m]->name,
                               level->lists[m].why.text);
    for (size_t i = 0; i < level->pairs.count; i++) {
        const cmp_verdict *one = &level->pairs.pairs[i].verdict;
        if (one->kind != CMP_AGREE)
            cmp_verdict_worsen(v, one->kind, "%s", one->reason.text);
        v->digits = fmin(v->digits, one->digits);
    }
    if (level->samples.verdict.kind != CMP_AGREE)
        cmp_verdict_worsen(v, level->samples.verdict.kind, "%s", level->samples.verdict.reason.text);
}

static cv_status judge(cmp_lines_run *run, cmp_lines_level *level, cv_message *why)
{
    cv_status status = cmp_branches_pair(&level->pairs, level->lists, why);
    for (size_t i = 0; status == CV_OK && i < level->pairs.count; i++)
        status = cmp_branches_judge(&level->pairs.pairs[i], level->lists, run->methods, level->handles,
                                    run->task.digits, why);
    if (status == CV_OK)
        status = cmp_lines_sample(&level->samples, level->lists, run->methods, level->handles,
                                  run->task.points, run->task.seed, why);
    close_handles(run, level);
    gather(run, level);
    return status;
}

/* The level number "index" over all cases, lowest damping first within each case, since it takes longest. */
static cmp_lines_level *level_of(cmp_lines_run *run, size_t index)
{
    size_t i = 0;
    while (index >= run->cases[i].level_count)
        index -= run->cases[i++].level_count;
    return &run->cases[i].levels[run->cases[i].level_count - 1 - index];
}

static size_t level_count(const cmp_lines_run *run)
{
    size_t n = 0;
    for (size_t i = 0; i < run->case_count; i++)
        n += run->cases[i].level_count;
    return n;
}

static cv_status find_job(void *context, size_t index, cv_message *why)
{
    cmp_lines_run *run = context;
    return find(run, level_of(run, index / CMP_METHODS), index % CMP_METHODS, why);
}

static cv_status judge_job(void *context, size_t index, cv_message *why)
{
    cmp_lines_run *run = context;
    return judge(run, level_of(run, index), why);
}

cv_status cmp_lines_run_find(cmp_lines_run *run, size_t threads, const cmp_listener *listener,
                             cv_message *why)
{
    return cmp_pool_run(threads, level_count(run) * CMP_METHODS, find_job, run, listener, why);
}

cv_status cmp_lines_run_judge(cmp_lines_run *run, size_t threads, const cmp_listener *listener,
                              cv_message *why)
{
    cv_status status = cmp_pool_run(threads, level_count(run), judge_job, run, listener, why);
    for (size_t i = 0; status == CV_OK && i < level_count(run); i++)
        if (level_of(run, i)->verdict.kind > run->worst)
            run->worst = level_of(run, i)->verdict.kind;
    return status;
}
