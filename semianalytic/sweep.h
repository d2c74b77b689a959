/* Inside of sa_sweep, for the files that evaluate zeta. */
#ifndef CRITVEL_SEMIANALYTIC_SWEEP_H
#define CRITVEL_SEMIANALYTIC_SWEEP_H

#include "semianalytic/poles.h"

/* Poles of an undamped track for the limit q - i0: the real ones (imaginary part exactly 0) and one of each
 * conjugate pair. */
typedef struct {
    int count; /* 0: cold */
    double alpha, q;
    double complex p[SA_POLES_MAX];
    sa_slopes slopes[SA_POLES_MAX];
} sa_limit_poles;

struct sa_sweep {
    sa_counts counts;
    sa_limit_poles limit;
    int count; /* poles known; 0: cold */
    double alpha;
    double complex q;
    double complex p[SA_UPPER_MAX];
    sa_slopes slopes[SA_UPPER_MAX];
};

/* sa_zeta_double for an undamped track, alpha > 0. */
cv_status sa_zeta_limit(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q);

/* Where the known poles should be at (alpha, q), to first order. */
void sa_sweep_predict(double complex p[SA_UPPER_MAX], const sa_sweep *s, double alpha, double complex q);

#endif
