/* All zeros in q of Im zeta with Re zeta > 0 at one velocity, by stepping through q so that no root p moves
 * more than a fraction of its distance to the others: steps shrink by themselves next to branch points, real
 * or complex. Brute force. */
#ifndef CRITVEL_REFERENCE_FASTSCAN_H
#define CRITVEL_REFERENCE_FASTSCAN_H

#include "fastroots.h"

enum { REF_ZEROS = 64 };

typedef struct {
    ref_real q, re; /* where Im zeta = 0, and Re zeta there */
    int fall;       /* 1: Im zeta goes + to - as q grows, -1: - to + */
} ref_zero;

typedef struct {
    ref_real alpha;
    int count;
    long steps;
    ref_zero zero[REF_ZEROS]; /* ascending in q */
} ref_column;

/* Only zeros with Re zeta > re_min are kept. 0, or -1 when a root is lost or there are too many zeros. */
int ref_scan(ref_column *out, const ref_dtrack *t, ref_real alpha, double re_min);

/* Number of unstable roots by the crossings: 2 sum of fall over the zeros with Re zeta > 1/eta_M. */
int ref_scan_unstable(const ref_column *c, double eta_M);

#endif
