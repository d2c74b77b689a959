/* K and zeta as boxes, from a set of certified poles. */
#ifndef CRITVEL_SEMIANALYTIC_KERNEL_BOX_H
#define CRITVEL_SEMIANALYTIC_KERNEL_BOX_H

#include "semianalytic/poles_box.h"

enum { SA_STARTS_MAX = SA_POLES_MAX + 1 };

/* Starting values for all poles: those of sa_poles_cold at the rounded point and, next to alpha^2 mu_b =
 * eta_s, the pole that goes through infinity. CV_FAILED: LAPACK reports an error. */
cv_status sa_kernel_starts(double complex start[SA_STARTS_MAX], int *n, const sa_track *t,
                           const cv_number *alpha, const cv_number *q);

/* K(xi, q) / (2 pi) at set->place. xi < 0 needs all poles in the set, undamped tracks too; else the upper
 * ones are enough. */
void sa_kernel_box(sa_box *out, const sa_pole_set *set, const sa_span *xi);

/* zeta = q^2 K(0, q) / (2 pi) */
void sa_zeta_box(sa_box *out, const sa_pole_set *set);

#endif
