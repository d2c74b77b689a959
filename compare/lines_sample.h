/* The count check of instability lines: unstable roots at sample points, by the winding of the second method
 * and by counting the lines of the first. */
#ifndef CRITVEL_COMPARE_LINES_SAMPLE_H
#define CRITVEL_COMPARE_LINES_SAMPLE_H

#include "compare/lines.h"

enum { CMP_MISMATCHES_KEPT = 8 };

typedef struct {
    double alpha, eta_M;
    int roots[CMP_METHODS];
} cmp_mismatch;

typedef struct {
    size_t points, near_lines;              /* points in all; those of them drawn near lines */
    size_t undecided[CMP_METHODS];          /* points at which a method cannot tell */
    size_t undecided_points;                /* points at which one of them cannot */
    size_t mismatches;                      /* points at which the methods count differently */
    cmp_mismatch kept[CMP_MISMATCHES_KEPT]; /* the first of them */
    cmp_verdict verdict;
} cmp_line_samples;

/* Draws "points" points, all reproducible from the seed. Every second velocity is drawn from the whole range,
 * with masses even in log eta_M; the others on, between and next to vertices of branches (each branch alike,
 * however small), with masses 10^-1 .. 10^-10 relative off the lines at that velocity or midway between
 * neighbouring lines. At one velocity several mass ratios are counted at once. Any mismatch is CMP_DISAGREE;
 * more than one undecided point in 100 is CMP_UNDECIDED. */
cv_status cmp_lines_sample(cmp_line_samples *out, const cmp_branches lists[CMP_METHODS],
                           const cmp_line_method *const methods[CMP_METHODS],
                           void *const handles[CMP_METHODS], size_t points, unsigned long seed,
                           cv_message *why);

#endif
