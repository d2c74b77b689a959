/* The work of a run, cut into jobs for the pool: searching, judging, searching again. */
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "compare/countsweep.h"
#include "compare/run.h"

/* One job: a damping level, while searching by one method. Its mass ratios are those that had "searches"
 * searches so far and, after the first, an incomplete verdict. */
typedef struct {
    const cmp_case *in;
    size_t level, method;
    double damping; /* the smallest of the level's three, a measure of the work */
} unit;

typedef struct {
    cmp_run *run;
    int searches; /* done before */
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

static int concerned(const cmp_result *r, int searches)
{
    return r->searches == searches && (searches == 0 || r->verdict.incomplete);
}

static size_t concerned_masses(size_t *index, const cmp_case *c, size_t level, int searches)
{
    size_t n = 0;
    for (size_t m = 0; m < c->from->mass_count; m++)
        if (concerned(&c->levels[level].results[m], searches))
            index[n++] = m;
    return n;
}

/* The mass ratios of one unit. */
typedef struct {
    size_t count;
    size_t *index;
    cv_number *ratios; /* values of the case file, not to be cleared */
} masses;

static void masses_clear(masses *m)
{
    free(m->index);
    free(m->ratios);
}

static cv_status masses_init(masses *out, const cmp_case *c, size_t level, int searches, cv_message *why)
{
    const size_t room = c->from->mass_count + 1;
    *out = (masses){0, malloc(room * sizeof *out->index), malloc(room * sizeof *out->ratios)};
    if (out->index == NULL || out->ratios == NULL) {
        masses_clear(out);
        return cv_fail(why, CV_FAILED, "out of memory");
    }
    out->count = concerned_masses(out->index, c, level, searches);
    for (size_t i = 0; i < out->count; i++)
        out->ratios[i] = c->from->mass_ratios[out->index[i]];
    return CV_OK;
}

static int any_concerned(const cmp_case *c, size_t level, int searches)
{
    for (size_t m = 0; m < c->from->mass_count; m++)
        if (concerned(&c->levels[level].results[m], searches))
            return 1;
    return 0;
}

/* "methods" units for every level with something to do. */
static cv_status plan_init(plan *out, cmp_run *run, int searches, size_t methods, cv_message *why)
{
    size_t room = 1;
    for (size_t i = 0; i < run->case_count; i++)
        room += run->cases[i].level_count * methods;
    *out = (plan){run, searches, 0, malloc(room * sizeof *out->units)};
    if (out->units == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < run->case_count; i++)
        for (size_t l = 0; l < run->cases[i].level_count; l++)
            for (size_t k = 0; k < methods && any_concerned(&run->cases[i], l, searches); k++)
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

static void add_effort(cmp_effort *sum, const cmp_effort *e, double cpu_seconds)
{
    sum->evaluations += e->evaluations;
    sum->evaluations_wide += e->evaluations_wide;
    if (e->largest_bits > sum->largest_bits)
        sum->largest_bits = e->largest_bits;
    sum->cpu_seconds += cpu_seconds;
}

/* Searches into lists of its own, which replace those of the run when all went well. */
static cv_status search(const plan *p, const unit *u, const masses *m, cmp_list *found, cmp_effort *effort,
                        cv_message *why)
{
    const cv_casefile *file = p->run->file;
    const cmp_method *method = p->run->methods[u->method];
    void *handle;
    cv_status status =
        method->open(&handle, &u->in->levels[u->level].params, &file->alpha_min, &file->alpha_max, why);
    if (status != CV_OK)
        return status;
    status = method->find(handle, found, effort, m->count, m->ratios, file->digits, p->searches, why);
    method->close(handle);
    return status;
}

static cv_status search_unit(void *context, size_t index, cv_message *why)
{
    const plan *p = context;
    const unit *u = &p->units[index];
    cmp_level *level = &u->in->levels[u->level];
    const double start = thread_seconds();
    cmp_effort effort = {0, 0, 0, 0.0};
    masses m;
    cv_status status = masses_init(&m, u->in, u->level, p->searches, why);
    if (status != CV_OK)
        return status;
    cmp_list *found = malloc((m.count + 1) * sizeof *found);
    if (found == NULL) {
        masses_clear(&m);
        return cv_fail(why, CV_FAILED, "out of memory");
    }
    for (size_t i = 0; i < m.count; i++)
        cmp_list_init(&found[i]);
    status = search(p, u, &m, found, &effort, why);
    for (size_t i = 0; i < m.count; i++) {
        cmp_list *kept = &level->lists[u->method][m.index[i]];
        cmp_list_clear(status == CV_OK ? kept : &found[i]);
        if (status == CV_OK)
            *kept = found[i];
    }
    free(found);
    masses_clear(&m);
    add_effort(&level->effort[u->method], &effort, thread_seconds() - start);
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

/* What the sweep over the range counted for the i-th of its mass ratios. */
static void judge_sweep(cmp_result *result, const cmp_sweep *sweep, size_t i,
                        const cmp_list *const lists[CMP_METHODS], const char *const names[CMP_METHODS])
{
    for (size_t k = 0; k < CMP_SWEEP; k++) {
        const cmp_sweep_sample *s = &sweep->samples[k];
        if (s->status == CV_OK)
            cmp_judge_counts(&result->verdict, &result->counts, lists, names, s->alpha,
                             (const int[]){s->roots[0][i], s->roots[1][i]});
        else
            cmp_verdict_worsen(&result->verdict, CMP_UNDECIDED,
                               "the unstable roots near alpha = %.15g could not be counted: %.300s", s->alpha,
                               s->why.text);
    }
}

/* Everything that can be said about mass ratio "mass", the i-th of the sweep, once both lists are there. */
static cv_status check_mass(const cmp_run *run, const cmp_level *level, const cv_case *from, size_t mass,
                            void *const handles[CMP_METHODS], const cmp_sweep *sweep, size_t i,
                            cv_message *why)
{
    const cmp_list *const lists[] = {&level->lists[0][mass], &level->lists[1][mass]};
    const char *const names[] = {run->methods[0]->name, run->methods[1]->name};
    const cv_number *eta_M = &from->mass_ratios[mass];
    cmp_result *result = &level->results[mass];
    cmp_pairing pairing;
    cmp_result_reset(result);
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
    if (status == CV_OK)
        judge_sweep(result, sweep, i, lists, names);
    cmp_pairing_clear(&pairing);
    remark(result, lists);
    result->searches++;
    return status;
}

static cv_status judge_masses(const plan *p, const unit *u, const masses *m, void *const handles[CMP_METHODS],
                              cv_message *why)
{
    const cv_casefile *file = p->run->file;
    cmp_sweep sweep;
    cv_status status = cmp_sweep_counts(&sweep, p->run->methods, handles, &file->alpha_min, &file->alpha_max,
                                        m->count, m->ratios, why);
    if (status != CV_OK)
        return status;
    for (size_t i = 0; status == CV_OK && i < m->count; i++)
        status =
            check_mass(p->run, &u->in->levels[u->level], u->in->from, m->index[i], handles, &sweep, i, why);
    cmp_sweep_clear(&sweep);
    return status;
}

static cv_status judge_unit(void *context, size_t index, cv_message *why)
{
    const plan *p = context;
    const unit *u = &p->units[index];
    const cv_casefile *file = p->run->file;
    void *handles[CMP_METHODS];
    int opened = 0;
    masses m;
    cv_status status = masses_init(&m, u->in, u->level, p->searches, why);
    if (status != CV_OK)
        return status;
    for (; status == CV_OK && opened < CMP_METHODS; opened += status == CV_OK)
        status = p->run->methods[opened]->open(&handles[opened], &u->in->levels[u->level].params,
                                               &file->alpha_min, &file->alpha_max, why);
    if (status == CV_OK)
        status = judge_masses(p, u, &m, handles, why);
    while (opened-- > 0)
        p->run->methods[opened]->close(handles[opened]);
    masses_clear(&m);
    return status;
}

static cv_status carry_out(cmp_run *run, int searches, size_t methods, cmp_job *job, size_t threads,
                           const cmp_listener *listener, cv_message *why)
{
    plan p;
    cv_status status = plan_init(&p, run, searches, methods, why);
    if (status != CV_OK)
        return status;
    status = cmp_pool_run(threads, p.count, job, &p, listener, why);
    free(p.units);
    return status;
}

cv_status cmp_run_find(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why)
{
    return carry_out(run, 0, CMP_METHODS, search_unit, threads, listener, why);
}

cv_status cmp_run_judge(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why)
{
    return carry_out(run, 0, 1, judge_unit, threads, listener, why);
}

cv_status cmp_run_search_again(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why)
{
    cv_status status = CV_OK;
    for (int searches = 1; status == CV_OK && searches < CMP_SEARCHES; searches++) {
        status = carry_out(run, searches, CMP_METHODS, search_unit, threads, listener, why);
        if (status == CV_OK)
            status = carry_out(run, searches, 1, judge_unit, threads, listener, why);
    }
    return status;
}
