/* The transitions of a moving mass: all (alpha, q), q > 0, with eta_M zeta(alpha, q) = 1, where the number N
 * of unstable roots (Re qbar > 0, qbar = i q on the axis) changes by 2. Lines Im zeta = 0 are traced in the
 * real (alpha, q) plane (map_search.h); transitions are where Re zeta passes 1 / eta_M along a line; each is
 * then refined by Newton's iteration in (alpha, q) in MPFR.
 *
 * Completeness rests on two independent things: the subdivision of the map, and N counted from the crossings
 * at alpha_min, at alpha_max and between all neighbouring transitions (crossings.h), which must be what the
 * transitions say. Where they differ the map is searched again in finer steps; if they still do, the list is
 * undecided.
 *
 * Without damping everything is the limit of vanishing damping, q - i0 (kernel.h). Every track radiates at
 * every (alpha, q), alpha > 0: the sleepers between rail and ballast at rest are a flat branch, which each
 * line q = omega + alpha p meets at least twice. So Im zeta vanishes nowhere but on lines, and these lines
 * are the limit of the damped ones, for all dampings eta_p : eta_b : eta_f alike. They may end on a branch
 * curve, where Re zeta becomes infinite on them (eta_M = 0), or in a special velocity of the branch curves,
 * from which the limit goes on along alpha = const: N changes there for a whole range of eta_M, because
 * crossings at infinity come and go. Such a velocity is listed as a transition with the q at which the curves
 * meet (0 for a resonance velocity). Lines that run along a branch curve at less than 1e-12 of it are counted
 * (crossings.h) but not traced: where one of them gives a transition the list is undecided.
 */
#ifndef CRITVEL_SEMIANALYTIC_TRANSITIONS_H
#define CRITVEL_SEMIANALYTIC_TRANSITIONS_H

#include <stddef.h>

#include "semianalytic/zeta.h"

typedef struct {
    mpfr_t alpha, q;
    double alpha_error, q_error; /* absolute bounds; 0 when below what a double holds */
    int below, above;            /* unstable roots on either side */
    cv_status decided; /* CV_UNDECIDED: the digits asked for were not reached, or below, above fail */
} sa_transition;

typedef struct {
    size_t count;
    sa_transition *items; /* alpha ascending */
    int roots_at_start;   /* N at alpha_min */
    cv_status decided;    /* CV_UNDECIDED: the list may be incomplete; reason says why */
    cv_message reason;
} sa_transitions;

/* One track and one range of velocities. For one thread at a time. */
typedef struct sa_boundary sa_boundary;

/* 0 < alpha_min < alpha_max. CV_BAD_INPUT: params are refused by cv_params_check, or the range is not one. */
cv_status sa_boundary_new(sa_boundary **out, const cv_params *params, const cv_number *alpha_min,
                          const cv_number *alpha_max, cv_message *why);
void sa_boundary_free(sa_boundary *boundary); /* NULL allowed */
sa_counts sa_boundary_counts(const sa_boundary *boundary);

/* All transitions for each of the mass ratios eta_M > 0: lists[0 .. mass_count - 1] are filled; relative
 * errors of alpha and q below 10^-digits where a transition is decided. level 0 is the usual search; each
 * further one begins with a finer pass over other cells, for who has reason to doubt the answer (a level more
 * takes about twice the time). CV_OK also when lists are undecided; on any other status all lists are empty.
 */
cv_status sa_boundary_transitions(sa_transitions *lists, sa_boundary *boundary, size_t mass_count,
                                  const cv_number *mass_ratios, int digits, int level, cv_message *why);
void sa_transitions_clear(sa_transitions *list);

/* N(alpha, eta_M) by the crossings at alpha (clamped to the range), independent of any transition.
 * CV_UNDECIDED: alpha is a transition within double precision, or the crossings cannot be told apart. */
cv_status sa_boundary_unstable_roots(int *roots, sa_boundary *boundary, double alpha, size_t mass_count,
                                     const cv_number *mass_ratios, cv_message *why);

#endif
