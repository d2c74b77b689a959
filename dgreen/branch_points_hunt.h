/* All sign changes of a smooth real function on an interval, from values and slopes. */
#ifndef CRITVEL_DGREEN_BRANCH_POINTS_HUNT_H
#define CRITVEL_DGREEN_BRANCH_POINTS_HUNT_H

#include "common/status.h"

typedef struct {
    double at, value, slope;
    double aside; /* whatever the function wants to remember with the sample */
} dg_sample;

/* Fills value, slope and aside for s->at. Any status but CV_OK ends the hunt. */
typedef cv_status dg_sloped(dg_sample *s, void *context);
/* One sign change: value(low) and value(high) differ in sign, the slopes agree with it. */
typedef cv_status dg_found(const dg_sample *low, const dg_sample *high, void *context);

typedef struct {
    dg_sloped *function;
    dg_found *found;
    void *context;
} dg_hunter;

/* Method: between two samples of equal sign zeros are possible when both slopes lead towards zero and the
 * tangents meet beyond it or close to it; then the interval is cut where they meet. Between two samples of
 * different sign there is one zero when both slopes agree with the change; otherwise the interval is halved.
 * Complete for functions with at most one extremum between low and high; not promised for more. A value of
 * zero counts as positive.
 * CV_UNDECIDED: an extremum touches zero within the spacing of doubles. */
cv_status dg_hunt_zeros(const dg_hunter *h, const dg_sample *low, const dg_sample *high);

/* The zero in a bracket that dg_hunt_zeros found, to the spacing of doubles. */
cv_status dg_hunt_refine(dg_sample *zero, const dg_hunter *h, const dg_sample *low, const dg_sample *high);

#endif
