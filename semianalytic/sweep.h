/* Inside of sa_sweep, for the files that evaluate zeta. */
#ifndef CRITVEL_SEMIANALYTIC_SWEEP_H
#define CRITVEL_SEMIANALYTIC_SWEEP_H

#include "semianalytic/poles.h"

struct sa_sweep {
    sa_counts counts;
    int count; /* poles known; 0: cold */
    double alpha;
    double complex q;
    double complex p[SA_UPPER_MAX];
    sa_slopes slopes[SA_UPPER_MAX];
};

/* Where the known poles should be at (alpha, q), to first order. */
void sa_sweep_predict(double complex p[SA_UPPER_MAX], const sa_sweep *s, double alpha, double complex q);

#endif
