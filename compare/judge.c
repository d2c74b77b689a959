#include "compare/judge.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

void cmp_verdict_init(cmp_verdict *v)
{
    v->kind = CMP_AGREE;
    v->digits = HUGE_VAL;
    v->incomplete = 0;
    v->reason.text[0] = '\0';
}

static void worsen(cmp_verdict *v, cmp_kind kind, const char *format, va_list arguments)
{
    if (kind <= v->kind)
        return;
    v->kind = kind;
    vsnprintf(v->reason.text, sizeof v->reason.text, format, arguments);
}

void cmp_verdict_worsen(cmp_verdict *v, cmp_kind kind, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    worsen(v, kind, format, arguments);
    va_end(arguments);
}

void cmp_verdict_incomplete(cmp_verdict *v, cmp_kind kind, const char *format, ...)
{
    va_list arguments;
    v->incomplete = 1;
    va_start(arguments, format);
    worsen(v, kind, format, arguments);
    va_end(arguments);
}

const char *cmp_kind_name(cmp_kind kind)
{
    static const char *const names[] = {"agree", "undecided", "disagree"};
    return names[kind];
}

double cmp_log10(mpfr_srcptr x)
{
    if (mpfr_nan_p(x))
        return (double)NAN;
    if (mpfr_zero_p(x))
        return -HUGE_VAL;
    if (mpfr_inf_p(x))
        return HUGE_VAL;
    long exponent;
    double mantissa = mpfr_get_d_2exp(&exponent, x, MPFR_RNDN);
    return log10(fabs(mantissa)) + (double)exponent * log10(2.0);
}

/* log10 of |x / y| */
static double log10_ratio(mpfr_srcptr x, mpfr_srcptr y)
{
    return cmp_log10(x) - cmp_log10(y);
}

static int usable(const cmp_transition *t)
{
    const int q = t->at_resonance ? mpfr_zero_p(t->q) != 0
                                  : mpfr_number_p(t->q) && mpfr_sgn(t->q) > 0 && mpfr_number_p(t->q_error) &&
                                        mpfr_sgn(t->q_error) > 0;
    return mpfr_number_p(t->alpha) && mpfr_sgn(t->alpha) > 0 && mpfr_number_p(t->alpha_error) &&
           mpfr_sgn(t->alpha_error) > 0 && q;
}

/* One list by itself: what it says about itself, and whether it can be the list of one mass. */
static void judge_list(cmp_verdict *v, const cmp_list *list, const char *name, int digits)
{
    if (list->status != CV_OK)
        cmp_verdict_incomplete(v, CMP_UNDECIDED, "%s could not decide: %.400s", name, list->why.text);
    for (size_t i = 0; i < list->count; i++) {
        const cmp_transition *t = &list->items[i];
        const double alpha = mpfr_get_d(t->alpha, MPFR_RNDN), q = mpfr_get_d(t->q, MPFR_RNDN);
        if (!usable(t)) {
            cmp_verdict_worsen(v, CMP_DISAGREE,
                               "%s gives alpha = %.10g, q = %.10g, not a positive number with a bound", name,
                               alpha, q);
            continue;
        }
        if (t->decided != CV_OK)
            cmp_verdict_incomplete(v, CMP_UNDECIDED, "%s is undecided about alpha = %.15g, q = %.15g", name,
                                   alpha, q);
        if (!(log10_ratio(t->alpha_error, t->alpha) <= -digits) ||
            (!t->at_resonance && !(log10_ratio(t->q_error, t->q) <= -digits)))
            cmp_verdict_worsen(v, CMP_UNDECIDED, "the bounds of %s at alpha = %.15g do not give %d digits",
                               name, alpha, digits);
        const int impossible =
            t->below < 0 || t->above < 0 || t->below % 2 != 0 || t->above % 2 != 0 || t->below == t->above;
        if (impossible && list->status == CV_OK) /* an incomplete list may well have such numbers */
            cmp_verdict_worsen(v, CMP_DISAGREE, "%s has unstable roots %d to %d at alpha = %.15g", name,
                               t->below, t->above, alpha);
        if (i > 0 && mpfr_less_p(t->alpha, t[-1].alpha))
            cmp_verdict_worsen(v, CMP_DISAGREE, "%s is not in ascending order at alpha = %.15g", name, alpha);
        if (i > 0 && t->below != t[-1].above)
            cmp_verdict_incomplete(v, CMP_DISAGREE,
                                   "%s has %d unstable roots above alpha = %.15g but %d below %.15g", name,
                                   t[-1].above, mpfr_get_d(t[-1].alpha, MPFR_RNDN), t->below, alpha);
    }
}

void cmp_judge_coordinate(cmp_verdict *v, const char *what, const mpfr_srcptr x[CMP_METHODS],
                          const mpfr_srcptr error[CMP_METHODS], int digits)
{
    mpfr_t difference, bound;
    mpfr_inits2(64, difference, bound, (mpfr_ptr)0);
    mpfr_sub(difference, x[0], x[1], MPFR_RNDA);
    mpfr_abs(difference, difference, MPFR_RNDN);
    mpfr_add(bound, error[0], error[1], MPFR_RNDU);
    const double relative = log10_ratio(difference, x[0]);
    if (!mpfr_lessequal_p(difference, bound))
        cmp_verdict_worsen(v, CMP_DISAGREE, "%s = %.15g: they differ by %.2e, their bounds allow %.2e", what,
                           mpfr_get_d(x[0], MPFR_RNDN), mpfr_get_d(difference, MPFR_RNDN),
                           mpfr_get_d(bound, MPFR_RNDN));
    else if (!(relative < -digits))
        cmp_verdict_worsen(v, CMP_UNDECIDED,
                           "%s = %.15g: they differ by %.2e, within their bounds but too much for "
                           "%d digits",
                           what, mpfr_get_d(x[0], MPFR_RNDN), mpfr_get_d(difference, MPFR_RNDN), digits);
    mpfr_srcptr wider = mpfr_greater_p(error[0], error[1]) ? error[0] : error[1];
    v->digits = fmin(v->digits, -fmax(relative, log10_ratio(wider, x[0])));
    mpfr_clears(difference, bound, (mpfr_ptr)0);
}

/* Where a list is incomplete by its own account (partial) it may have missed roots that came and went before:
 * only how many come here means something. */
static int same_roots(const cmp_transition *a, const cmp_transition *b, int partial)
{
    return a->above - a->below == b->above - b->below && (partial || a->below == b->below);
}

static void judge_pair(cmp_verdict *v, const cmp_transition *a, const cmp_transition *b, int partial,
                       const char *const names[], int digits)
{
    cmp_judge_coordinate(v, "alpha", (const mpfr_srcptr[]){a->alpha, b->alpha},
                         (const mpfr_srcptr[]){a->alpha_error, b->alpha_error}, digits);
    if (!a->at_resonance && !b->at_resonance)
        cmp_judge_coordinate(v, "q", (const mpfr_srcptr[]){a->q, b->q},
                             (const mpfr_srcptr[]){a->q_error, b->q_error}, digits);
    if (!same_roots(a, b, partial))
        cmp_verdict_worsen(v, CMP_DISAGREE, "alpha = %.15g: unstable roots %d to %d by %s, %d to %d by %s",
                           mpfr_get_d(a->alpha, MPFR_RNDN), a->below, a->above, names[0], b->below, b->above,
                           names[1]);
}

/* Transitions without a partner; judged first, because a missing one upsets the numbers of roots of the
 * others. Where a list is incomplete by its own account they prove nothing. */
static void judge_single(cmp_verdict *v, const cmp_list *const lists[], const cmp_pairing *pairing, int m,
                         const char *const names[], const cv_number *const ends[])
{
    if (lists[0]->status != CV_OK || lists[1]->status != CV_OK)
        return;
    for (size_t i = 0; i < lists[m]->count; i++) {
        const cmp_transition *t = &lists[m]->items[i];
        if (pairing->partner[m][i] != SIZE_MAX || !usable(t))
            continue;
        const double alpha = mpfr_get_d(t->alpha, MPFR_RNDN), q = mpfr_get_d(t->q, MPFR_RNDN);
        if (cmp_transition_at(t, ends[0]) || cmp_transition_at(t, ends[1]))
            cmp_verdict_worsen(v, CMP_UNDECIDED, "alpha = %.15g of %s is at the end of the range: in or out",
                               alpha, names[m]);
        else
            cmp_verdict_incomplete(v, CMP_DISAGREE,
                                   "only %s has alpha = %.15g, q = %.15g (unstable roots %d to %d)", names[m],
                                   alpha, q, t->below, t->above);
    }
}

void cmp_judge(cmp_verdict *v, const cmp_list *const lists[CMP_METHODS], const cmp_pairing *pairing,
               const char *const names[CMP_METHODS], const cv_number *alpha_min, const cv_number *alpha_max,
               int digits)
{
    const int partial = lists[0]->status != CV_OK || lists[1]->status != CV_OK;
    for (int m = 0; m < CMP_METHODS; m++)
        judge_single(v, lists, pairing, m, names, (const cv_number *const[]){alpha_min, alpha_max});
    for (int m = 0; m < CMP_METHODS; m++)
        judge_list(v, lists[m], names[m], digits);
    for (size_t i = 0; i < lists[0]->count; i++)
        if (pairing->partner[0][i] != SIZE_MAX)
            judge_pair(v, &lists[0]->items[i], &lists[1]->items[pairing->partner[0][i]], partial, names,
                       digits);
    if (isinf(v->digits))
        v->digits = digits;
}
