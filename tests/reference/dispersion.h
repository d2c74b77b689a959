/* Dispersion branches of the undamped track in double: where zeta has branch points in q, and the special
 * velocities where those meet. Only used to place grids and test points, never to decide anything. */
#ifndef CRITVEL_REFERENCE_DISPERSION_H
#define CRITVEL_REFERENCE_DISPERSION_H

#include <stddef.h>

#include "arbtrack.h"

typedef struct {
    double value[REF_PARAMS]; /* in the order of the enum in arbtrack.h */
} ref_dtrack;

void ref_dtrack_set(ref_dtrack *to, const ref_track *from);

/* omega[k] >= 0 ascending and the group velocities omega'[k] at the real wavenumber p. */
void ref_dispersion(double omega[3], double group[3], const ref_dtrack *t, double p);

/* The branch curve of branch k at p: alpha = |omega'|, q = |omega - p omega'|. */
void ref_branch_point(double *alpha, double *q, const ref_dtrack *t, int k, double p);

/* All branch points q_b at the velocity alpha, at most max of them; returns how many. */
size_t ref_branch_points(double *q, size_t max, const ref_dtrack *t, double alpha);

/* Special velocities in (lo, hi): branch curves that cross each other or q = 0, cusps, alpha^2 mu_b = eta_s.
 * Ascending; returns how many (at most max). */
size_t ref_special_velocities(double *alpha, size_t max, const ref_dtrack *t, double lo, double hi);

#endif
