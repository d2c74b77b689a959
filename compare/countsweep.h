/* Counts in the gaps between transitions, where nobody claims that anything happens: for pairs of transitions
 * that both methods missed. */
#ifndef CRITVEL_COMPARE_COUNTSWEEP_H
#define CRITVEL_COMPARE_COUNTSWEEP_H

#include "compare/method.h"

/* Velocities of a sweep. */
enum { CMP_SWEEP = 48 };

/* The numbers of unstable roots at one velocity. */
typedef struct {
    double alpha;
    int *roots[CMP_METHODS]; /* by mass ratio */
    cv_status status;        /* CV_UNDECIDED: a method could not count at any of the velocities tried */
    cv_message why;
} cmp_sweep_sample;

typedef struct {
    cmp_sweep_sample samples[CMP_SWEEP]; /* alpha ascending */
} cmp_sweep;

/* Counts by both methods for all mass ratios at CMP_SWEEP velocities, evenly spread in the logarithm of alpha
 * but not on a lattice; wide gaps get many of them, narrow ones none. At one velocity a method serves all
 * mass ratios at once, which makes this cheap. On failure nothing is allocated. */
cv_status cmp_sweep_counts(cmp_sweep *out, const cmp_method *const methods[CMP_METHODS],
                           void *const handles[CMP_METHODS], const cv_number *alpha_min,
                           const cv_number *alpha_max, size_t mass_count, const cv_number *mass_ratios,
                           cv_message *why);
void cmp_sweep_clear(cmp_sweep *sweep);

#endif
