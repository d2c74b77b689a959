/* Whether two lists of transitions, found independently, are the same. */
#ifndef CRITVEL_COMPARE_JUDGE_H
#define CRITVEL_COMPARE_JUDGE_H

#include "compare/method.h"

typedef enum { CMP_AGREE = 0, CMP_UNDECIDED = 1, CMP_DISAGREE = 2 } cmp_kind; /* ascending: worse */

typedef struct {
    cmp_kind kind;
    double digits;     /* digits of agreement; meaningful only where the kind is CMP_AGREE */
    int incomplete;    /* 1: a list may lack a transition or have one too many, by its own account, by the
                          other list or by a count, so that a denser search may change the verdict */
    cv_message reason; /* why not CMP_AGREE, or a remark; may be empty */
} cmp_verdict;

void cmp_verdict_init(cmp_verdict *v); /* CMP_AGREE, digits infinite, no reason */

/* The verdict becomes "kind" with this reason unless it is already as bad or worse: the first reason of the
 * worst kind stands. */
void cmp_verdict_worsen(cmp_verdict *v, cmp_kind kind, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same, and the verdict is incomplete whether or not this reason stands. */
void cmp_verdict_incomplete(cmp_verdict *v, cmp_kind kind, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

const char *cmp_kind_name(cmp_kind kind); /* "agree", "undecided", "disagree" */

/* partner[m][i] is the index in the other list of the transition that pairs with item i of list m, or
 * SIZE_MAX. */
typedef struct {
    size_t *partner[CMP_METHODS];
} cmp_pairing;

/* Pairs transitions that are mutually nearest in (alpha, q), relative distances, among those that change the
 * number of roots in the same direction, and nearer than 1e-3. Non-finite ones stay alone. CV_FAILED when out
 * of memory, and then nothing is allocated. */
cv_status cmp_pair(cmp_pairing *out, const cmp_list *first, const cmp_list *second, cv_message *why);
void cmp_pairing_clear(cmp_pairing *p);

/* Judges the lists of methods "names" with their pairing for "digits" digits.
 * Agree: both complete and decided, ascending, the numbers of roots following from one to the next; each
 * transition has a partner; partners differ by less than 10^-digits relative in alpha and in q and by no more
 * than the sum of the stated bounds; the same numbers of roots below and above. The stability limit is then
 * the same. Undecided: a list or a transition says so, or its bounds are wider than the digits asked for.
 * Disagree: anything else, with what and where.
 * v->digits becomes the smallest -log10 of the relative difference of any pair, but never more than the
 * larger of the two stated bounds allows; without transitions, the digits asked for. */
void cmp_judge(cmp_verdict *v, const cmp_list *const lists[CMP_METHODS], const cmp_pairing *pairing,
               const char *const names[CMP_METHODS], const cv_number *alpha_min, const cv_number *alpha_max,
               int digits);

/* One coordinate x of a pair, with absolute bounds: CMP_DISAGREE where the two differ by more than the sum of
 * the bounds, CMP_UNDECIDED where by more than 10^-digits relative; v->digits is lowered to what the
 * difference and the wider bound leave. "what" names the coordinate. */
void cmp_judge_coordinate(cmp_verdict *v, const char *what, const mpfr_srcptr x[CMP_METHODS],
                          const mpfr_srcptr error[CMP_METHODS], int digits);

/* log10 |x| for any exponent range; -infinity for 0, NaN for NaN. */
double cmp_log10(mpfr_srcptr x);

#endif
