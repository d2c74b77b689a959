/* The completeness check: the number of unstable roots between the claimed transitions, counted by both
 * methods. */
#ifndef CRITVEL_COMPARE_COUNTCHECK_H
#define CRITVEL_COMPARE_COUNTCHECK_H

#include "compare/judge.h"

/* What the check found for one mass ratio. */
typedef struct {
    int start;      /* unstable roots at alpha_min; -1 where it could not be counted */
    size_t samples; /* velocities at which both methods counted */
} cmp_counts;

/* Counts at alpha_min, alpha_max and between all neighbours among the transitions of both lists (a pair
 * counts once). Each method's count must be decided and equal the other's and what each list says there;
 * otherwise v becomes CMP_DISAGREE, incomplete, or, where a method cannot count, CMP_UNDECIDED. A sample a
 * method cannot count is moved within its interval first. */
cv_status cmp_check_counts(cmp_verdict *v, cmp_counts *out, const cmp_list *const lists[CMP_METHODS],
                           const cmp_pairing *pairing, const cmp_method *const methods[CMP_METHODS],
                           void *const handles[CMP_METHODS], const cv_number *alpha_min,
                           const cv_number *alpha_max, const cv_number *mass_ratio, cv_message *why);

/* The same judgement of what the methods "names" counted at one velocity. out->start is set if it is -1. */
void cmp_judge_counts(cmp_verdict *v, cmp_counts *out, const cmp_list *const lists[CMP_METHODS],
                      const char *const names[CMP_METHODS], double alpha, const int counted[CMP_METHODS]);

#endif
