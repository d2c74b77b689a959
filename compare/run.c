#include "compare/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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
        cmp_verdict_init(&level->results[i].verdict);
        level->results[i].counts = (cmp_counts){-1, 0};
        mpfr_init2(level->results[i].worst.residual, 53);
        mpfr_set_zero(level->results[i].worst.residual, 1);
        level->results[i].worst.used = 0.0;
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

/* One unit of work: a level, while finding by one method. */
typedef struct {
    const cmp_case *in;
    size_t level, method;
    double damping; /* the smallest of the level's three, a measure of the work */
} unit;

typedef struct {
    cmp_run *run;
    size_t count;
    unit *units;
} plan;

/* Low dampings take longest: they start first, so that no thread is left with one at the end. Ties by
 * position, so that the order is always the same. */
static int costlier_first(const void *x, const void *y)
{
    const unit *a = x, *b = y;
    if (a->damping < b->damping || a->damping > b->damping)
        return a->damping < b->damping ? -1 : 1;
    if (a->in != b->in)
        return a->in < b->in ? -1 : 1;
    if (a->level != b->level)
        return a->level < b->level ? -1 : 1;
    return a->method < b->method ? -1 : a->method > b->method;
}

static double smallest_damping(const cv_params *p)
{
    return fmin(cv_number_get_double(&p->eta_p),
                fmin(cv_number_get_double(&p->eta_b), cv_number_get_double(&p->eta_f)));
}

/* Units of every level, "methods" of them each. */
static cv_status plan_init(plan *out, cmp_run *run, size_t methods, cv_message *why)
{
    size_t count = 0;
    for (size_t i = 0; i < run->case_count; i++)
        count += run->cases[i].level_count * methods;
    out->run = run;
    out->count = 0;
    out->units = malloc(count * sizeof *out->units);
    if (out->units == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < run->case_count; i++)
        for (size_t l = 0; l < run->cases[i].level_count; l++)
            for (size_t k = 0; k < methods; k++)
                out->units[out->count++] =
                    (unit){&run->cases[i], l, k, smallest_damping(&run->cases[i].levels[l].params)};
    qsort(out->units, out->count, sizeof *out->units, costlier_first);
    return CV_OK;
}

static double thread_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static cv_status find_unit(void *context, size_t index, cv_message *why)
{
    const plan *p = context;
    const unit *u = &p->units[index];
    cmp_level *level = &u->in->levels[u->level];
    const cmp_method *method = p->run->methods[u->method];
    const double start = thread_seconds();
    void *handle;
    cv_status status =
        method->open(&handle, &level->params, &p->run->file->alpha_min, &p->run->file->alpha_max, why);
    if (status != CV_OK)
        return status;
    status = method->find(handle, level->lists[u->method], &level->effort[u->method], u->in->from->mass_count,
                          u->in->from->mass_ratios, p->run->file->digits, why);
    method->close(handle);
    level->effort[u->method].cpu_seconds = thread_seconds() - start;
    return status;
}

/* Agreement about something a reader would not expect is still explained. */
static void remark(cmp_result *result, const cmp_list *const lists[CMP_METHODS])
{
    cv_message *reason = &result->verdict.reason;
    if (result->verdict.kind != CMP_AGREE)
        return;
    if (result->counts.start > 0)
        (void)cv_fail(reason, CV_OK, "already %d unstable roots at the lowest velocity",
                      result->counts.start);
    else if (lists[0]->count == 0)
        (void)cv_fail(reason, CV_OK, "no transition in the range");
}

/* Everything that can be said about one mass ratio once both lists are there. */
static cv_status check_mass(const cmp_run *run, const cmp_level *level, const cv_case *from, size_t mass,
                            void *const handles[CMP_METHODS], cv_message *why)
{
    const cmp_list *const lists[] = {&level->lists[0][mass], &level->lists[1][mass]};
    const char *const names[] = {run->methods[0]->name, run->methods[1]->name};
    const cv_number *eta_M = &from->mass_ratios[mass];
    cmp_result *result = &level->results[mass];
    cmp_pairing pairing;
    cv_status status = cmp_pair(&pairing, lists[0], lists[1], why);
    if (status != CV_OK)
        return status;
    cmp_judge(&result->verdict, lists, &pairing, names, &run->file->alpha_min, &run->file->alpha_max,
              run->file->digits);
    for (int claimant = 0; status == CV_OK && claimant < CMP_METHODS; claimant++)
        for (int m = 0; status == CV_OK && m < CMP_METHODS; m++)
            status = cmp_put_back(&result->verdict, &result->worst, lists[claimant], names[claimant],
                                  run->methods[m], handles[m], eta_M, why);
    if (status == CV_OK)
        status = cmp_check_counts(&result->verdict, &result->counts, lists, &pairing, run->methods, handles,
                                  &run->file->alpha_min, &run->file->alpha_max, eta_M, why);
    cmp_pairing_clear(&pairing);
    remark(result, lists);
    return status;
}

static cv_status judge_unit(void *context, size_t index, cv_message *why)
{
    const plan *p = context;
    const unit *u = &p->units[index];
    const cmp_level *level = &u->in->levels[u->level];
    const cv_casefile *file = p->run->file;
    void *handles[CMP_METHODS];
    int opened = 0;
    cv_status status = CV_OK;
    for (; status == CV_OK && opened < CMP_METHODS; opened += status == CV_OK)
        status = p->run->methods[opened]->open(&handles[opened], &level->params, &file->alpha_min,
                                               &file->alpha_max, why);
    for (size_t m = 0; status == CV_OK && m < u->in->from->mass_count; m++)
        status = check_mass(p->run, level, u->in->from, m, handles, why);
    while (opened-- > 0)
        p->run->methods[opened]->close(handles[opened]);
    return status;
}

static cv_status carry_out(cmp_run *run, size_t methods, cmp_job *job, size_t threads,
                           const cmp_listener *listener, cv_message *why)
{
    plan p;
    cv_status status = plan_init(&p, run, methods, why);
    if (status != CV_OK)
        return status;
    status = cmp_pool_run(threads, p.count, job, &p, listener, why);
    free(p.units);
    return status;
}

cv_status cmp_run_find(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why)
{
    return carry_out(run, CMP_METHODS, find_unit, threads, listener, why);
}

cv_status cmp_run_judge(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why)
{
    return carry_out(run, 1, judge_unit, threads, listener, why);
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
