/* Two manufactured "methods" with known transitions, whose claims, zeta and counts can be spoilt one by one.
 * The truth: for eta_M = 1, zeta = 1 + (alpha - a_k) + i (q - q_k) around the nearest q_k, so that z = 1
 * exactly at (a_k, q_k); N changes by step_k there. Other mass ratios have no transition and no unstable
 * root. */
#ifndef CRITVEL_TESTS_FAKE_METHODS_H
#define CRITVEL_TESTS_FAKE_METHODS_H

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "compare/run.h"

enum { FAKE_TRANSITIONS = 4 };

typedef struct {
    double alpha, q;
    int step;
} fake_transition;

static const fake_transition FAKE_TRUTH[FAKE_TRANSITIONS] = {
    {0.25, 0.125, 2}, {0.375, 0.25, 2}, {0.5, 0.375, -2}, {1.25, 0.75, -2}};

/* What a fake does wrong; all zero: nothing. */
typedef struct {
    int drop;            /* 1 + index of a transition that is not listed */
    int drop_from_count; /* 1 + index of a transition that the count does not know either */
    int move;  /* 1 + index of a transition claimed with a wrong alpha, both fakes alike if both say so */
    double by; /* relative */
    double zeta_offset;   /* added to Re zeta */
    double zeta_bound;    /* stated bound of the evaluation */
    int cannot_count;     /* count says CV_UNDECIDED */
    int count_all;        /* the count sees the transitions at every mass ratio */
    int start;            /* unstable roots at alpha_min */
    cv_status find, open; /* returned by find, open */
    int undecided_list;
    int mends; /* effort level of the search from which on drop, move and undecided_list do not happen */
    int missed_pair;      /* the count knows a pair of transitions that no search finds */
    unsigned searched[3]; /* mass ratios searched at each effort level */
} fake_faults;

/* Between these velocities two more roots are unstable, if missed_pair says so. */
static const double FAKE_PAIR[] = {0.8, 0.86};

static fake_faults fake[CMP_METHODS];
static pthread_mutex_t fake_lock = PTHREAD_MUTEX_INITIALIZER;

static void fake_reset(void)
{
    memset(fake, 0, sizeof fake);
}

static cv_status fake_list(const fake_faults *f, cmp_list *list, int level)
{
    const int spoilt = f->mends == 0 || level < f->mends;
    int roots = f->start;
    mpfr_t alpha, q;
    mpfr_inits2(200, alpha, q, (mpfr_ptr)0);
    for (int k = 0; k < FAKE_TRANSITIONS; k++) {
        if (spoilt && f->drop == k + 1)
            continue;
        mpfr_set_d(alpha, FAKE_TRUTH[k].alpha, MPFR_RNDN);
        if (spoilt && f->move == k + 1) {
            mpfr_t by;
            mpfr_init2(by, 200);
            mpfr_set_d(by, f->by, MPFR_RNDN);
            mpfr_fma(alpha, alpha, by, alpha, MPFR_RNDN);
            mpfr_clear(by);
        }
        mpfr_set_d(q, FAKE_TRUTH[k].q, MPFR_RNDN);
        if (cmp_list_append(list, alpha, q, 1e-24, 1e-24, roots, roots + FAKE_TRUTH[k].step, CV_OK, NULL) !=
            CV_OK)
            abort();
        roots += FAKE_TRUTH[k].step;
    }
    mpfr_clears(alpha, q, (mpfr_ptr)0);
    list->status = spoilt && f->undecided_list ? CV_UNDECIDED : CV_OK;
    return CV_OK;
}

static int fake_is_one(const cv_number *eta_M)
{
    return mpq_cmp_ui(eta_M->factor, 1, 1) == 0;
}

static cv_status fake_find(void *handle, cmp_list *lists, cmp_effort *effort, size_t mass_count,
                           const cv_number *mass_ratios, int digits, int level, cv_message *why)
{
    fake_faults *f = handle;
    (void)digits;
    pthread_mutex_lock(&fake_lock);
    f->searched[level] += (unsigned)mass_count;
    pthread_mutex_unlock(&fake_lock);
    if (f->find != CV_OK)
        return cv_fail(why, f->find, "the fake was told to fail");
    *effort = (cmp_effort){1, 2, 3, 0.0};
    for (size_t i = 0; i < mass_count; i++)
        if (fake_is_one(&mass_ratios[i]))
            (void)fake_list(f, &lists[i], level);
    return CV_OK;
}

static cv_status fake_count(void *handle, int *roots, double alpha, size_t mass_count,
                            const cv_number *mass_ratios, cv_message *why)
{
    const fake_faults *f = handle;
    if (f->cannot_count)
        return cv_fail(why, CV_UNDECIDED, "the fake cannot count");
    for (size_t i = 0; i < mass_count; i++) {
        roots[i] = f->start;
        for (int k = 0; k < FAKE_TRANSITIONS && (f->count_all || fake_is_one(&mass_ratios[i])); k++)
            if (f->drop_from_count != k + 1 && alpha > FAKE_TRUTH[k].alpha)
                roots[i] += FAKE_TRUTH[k].step;
        if (f->missed_pair && fake_is_one(&mass_ratios[i]) && alpha > FAKE_PAIR[0] && alpha < FAKE_PAIR[1])
            roots[i] += 2;
    }
    return CV_OK;
}

static cv_status fake_zeta(void *handle, mpc_ptr zeta, mpfr_ptr re_error, mpfr_ptr im_error,
                           mpfr_srcptr alpha, mpfr_srcptr q, mpfr_prec_t bits, cv_message *why)
{
    const fake_faults *f = handle;
    int k = 0;
    (void)bits, (void)why;
    while (k + 1 < FAKE_TRANSITIONS && mpfr_cmp_d(q, (FAKE_TRUTH[k].q + FAKE_TRUTH[k + 1].q) / 2.0) > 0)
        k++;
    mpfr_sub_d(mpc_realref(zeta), alpha, FAKE_TRUTH[k].alpha, MPFR_RNDN);
    mpfr_add_d(mpc_realref(zeta), mpc_realref(zeta), 1.0 + f->zeta_offset, MPFR_RNDN);
    mpfr_sub_d(mpc_imagref(zeta), q, FAKE_TRUTH[k].q, MPFR_RNDN);
    mpfr_set_d(re_error, f->zeta_bound, MPFR_RNDU);
    mpfr_set_d(im_error, f->zeta_bound, MPFR_RNDU);
    return CV_OK;
}

static cv_status fake_open_first(void **handle, const cv_params *track, const cv_number *low,
                                 const cv_number *high, cv_message *why)
{
    (void)track, (void)low, (void)high;
    *handle = &fake[0];
    return fake[0].open == CV_OK ? CV_OK : cv_fail(why, fake[0].open, "the fake does not open");
}

static cv_status fake_open_second(void **handle, const cv_params *track, const cv_number *low,
                                  const cv_number *high, cv_message *why)
{
    (void)track, (void)low, (void)high;
    *handle = &fake[1];
    return fake[1].open == CV_OK ? CV_OK : cv_fail(why, fake[1].open, "the fake does not open");
}

static void fake_close(void *handle)
{
    (void)handle;
}

static const cmp_method FAKE_FIRST = {"semianalytic", fake_open_first, fake_close,
                                      fake_find,      fake_count,      fake_zeta};
static const cmp_method FAKE_SECOND = {"dgreen",  fake_open_second, fake_close,
                                       fake_find, fake_count,       fake_zeta};
static const cmp_method *const FAKES[CMP_METHODS] = {&FAKE_FIRST, &FAKE_SECOND};

#endif
