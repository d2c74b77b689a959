/* Number of unstable roots at one velocity, by the winding of the D-decomposition curve. */
#ifndef CRITVEL_DGREEN_COUNT_H
#define CRITVEL_DGREEN_COUNT_H

#include <stddef.h>

#include "common/params.h"

/* Prepared for one track and a range of velocities; one thread at a time. */
typedef struct dg_counter dg_counter;

/* 0 < alpha_min <= alpha_max. params must have passed cv_params_check. Without damping: the limit of
 * dgreen/sampler.h.
 */
cv_status dg_counter_new(dg_counter **out, const cv_params *params, double alpha_min, double alpha_max,
                         cv_message *why);
void dg_counter_free(dg_counter *c); /* NULL allowed */

/* roots[i] = number of roots of 1 - eta_M zeta(alpha, qbar) with Re qbar > 0 for each mass ratio (> 0), alpha
 * in the range. The curve is sampled once for all. CV_UNDECIDED: alpha is a transition of one of them to
 * double precision, or a count could not be certified (dgreen/winding.h); why names it and *failed is its
 * index. */
cv_status dg_count_unstable(int *roots, size_t *failed, dg_counter *c, double alpha, size_t mass_count,
                            const cv_number *mass_ratios, cv_message *why);

#endif
