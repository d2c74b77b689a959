/* All transitions of one track at one damping, for any number of mass ratios at once, by D-decomposition.
 *
 * A transition is a velocity alpha at which eta_M zeta(alpha, i q) = 1 for a real frequency q > 0, so that
 * the number N of roots of 1 - eta_M zeta with Re qbar > 0 changes by two. All dimensionless.
 *
 * Method: N by the winding of the curve zeta(i q) (dgreen/winding.h) at velocities graded logarithmically
 * towards every special velocity (dgreen/branch_points.h); cells in alpha are cut until the crossings of the
 * curve with the real axis at both ends pair up and every change of N is explained by a crossing that passes
 * 1/eta_M (dgreen/transitions_cell.h); then for each transition a root in q inside a root in alpha, both
 * bracketed, with certified signs at the ends (dgreen/transitions_refine.h).
 * Not found: two transitions of one mass ratio closer together than the cells resolve that leave no trace in
 * the curves at both ends of the cell, nor in their slopes. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_H
#define CRITVEL_DGREEN_TRANSITIONS_H

#include <mpfr.h>
#include <stddef.h>

#include "common/params.h"

typedef struct {
    mpfr_t alpha, frequency;             /* velocity ratio and q */
    double alpha_error, frequency_error; /* absolute bounds; above zero */
    int count_below, count_above;        /* N just below and just above alpha */
    cv_status decided; /* CV_UNDECIDED: the largest precision could not confirm it or reach the
                          digits asked for; alpha and frequency are the best there is */
} dg_transition;

/* The transitions of one mass ratio. */
typedef struct {
    size_t count;
    dg_transition *items; /* ascending in alpha */
    int count_at_min;     /* N at alpha_min */
    cv_status status;     /* CV_OK: complete and each decided. CV_UNDECIDED: why says what is not */
    cv_message why;
} dg_transition_list;

enum { DG_LOOK_MAX = 4, DG_MORE_LOOKS = 2 };

typedef struct {
    unsigned long evaluations;  /* of zeta, at any precision */
    unsigned long above_double; /* those that needed more than double */
    long largest_precision;     /* bits */
} dg_effort;

/* Fills lists[0 .. mass_count-1], one per mass ratio (each > 0), for 0 < alpha_min < alpha_max; relative
 * errors of alpha and q below 10^-digits. params must have passed cv_params_check. effort may be NULL.
 *
 * first_look: how dense the search begins, 0 .. DG_LOOK_MAX. 0 is normal; each further one halves the first
 * steps in alpha and in q and what passes for smooth, and about doubles the cost. A list that does not hold
 * (a negative count, crossings that cannot be paired, another count by the winding between two of its
 * transitions) is dropped and its mass ratio searched again, up to DG_MORE_LOOKS looks closer; only then it
 * is undecided.
 *
 * What cannot be decided is said in the lists; the status returned is CV_OK then, too. Without
 * damping: dgreen/limit_transitions.h. CV_FAILED: out of memory. Unless CV_OK is returned no list holds
 * anything. Reentrant. */
cv_status dg_find_transitions(dg_transition_list *lists, dg_effort *effort, const cv_params *params,
                              const cv_number *alpha_min, const cv_number *alpha_max, size_t mass_count,
                              const cv_number *mass_ratios, int digits, int first_look, cv_message *why);

void dg_transition_list_clear(dg_transition_list *list);

#endif
