/* Branch points of zeta on the real q axis, and the velocities where their pattern changes.
 *
 * A branch point is a real q at which the undamped Delta has a double root lambda = i p, p real. With
 * sigma = q - alpha p = -omega_k(p) (dgreen/branch_points_wave.h) that is d q/dp = 0, in the form
 *     p f_Y = alpha sigma f_X,   i.e. omega_k'(p) = alpha,   q_b = alpha p - omega_k(p),
 * and d q_b/d alpha = p. Negative q_b stand for their reflections |q_b|, since zeta(-q) = conj zeta(q).
 * At low damping zeta changes over distances as small as the damping next to |q_b|, but smoothly in the
 * logarithm of the distance. All dimensionless.
 *
 * Method: on each branch k the zeros of omega_k'' cut p > 0 into stretches of monotone group velocity, found
 * once per track on a grid that is refined until cubic interpolation of omega_k' holds; on a stretch the
 * equation omega_k' = +-alpha is one bracketed root. Not found: two zeros of omega_k'' inside one step of the
 * refined grid. */
#ifndef CRITVEL_DGREEN_BRANCH_POINTS_H
#define CRITVEL_DGREEN_BRANCH_POINTS_H

#include <stddef.h>

#include "dgreen/operator.h"

typedef struct {
    double q; /* |q_b| >= 0 */
    double signed_q;
    double p;     /* signed; d signed_q / d alpha */
    double width; /* > 0: distance of the damped branch point from the real axis, to first order; soft: see
                     below */
    double peak; /* the largest |zeta| of the singular part, where it reaches that, to first order; soft: 0 */
    int curve;   /* which family alpha -> q_b(alpha); the same number at every alpha */
    int soft;  /* 1: no branch point at this alpha, but a wave of extreme curvature or none (two branch points
                  that meet at another alpha): zeta varies over the distance width around q */
    int bend;  /* sign of the curvature of omega(p); 0: soft */
    int quiet; /* 1: found to be of no account (dgreen/curve.c); 0 in lists that are new */
} dg_branch_point;

/* Where the pattern of branch points changes: two of them meet (one of them possibly reflected), one reaches
 * q = 0 (a resonance velocity of the moving force), a pair is born, or alpha^2 mu_b = eta_s. */
typedef struct {
    double alpha;
    double width; /* > 0: below this distance in alpha damping blurs the event */
} dg_special_velocity;

typedef struct dg_branch_curves dg_branch_curves;

/* For 0 < alpha_min <= alpha <= alpha_max. t is kept, not copied. CV_FAILED: out of memory. */
cv_status dg_branch_curves_new(dg_branch_curves **out, const dg_track *t, double alpha_min, double alpha_max,
                               cv_message *why);
void dg_branch_curves_free(dg_branch_curves *b); /* NULL allowed */

/* No alpha has more branch points, soft ones included. */
size_t dg_branch_points_max(const dg_branch_curves *b);

/* Writes the branch points at alpha, ascending in q, and returns their number. points holds at least
 * dg_branch_points_max. */
size_t dg_branch_points_at(dg_branch_point *points, const dg_branch_curves *b, double alpha);

/* The point of one curve (dg_branch_point.curve, not soft) at another alpha. Returns 0 where that curve has
 * none. */
int dg_branch_point_on(dg_branch_point *point, const dg_branch_curves *b, int curve, double alpha);

/* Ascending, inside (alpha_min, alpha_max). Owned by b. */
const dg_special_velocity *dg_special_velocities(size_t *count, const dg_branch_curves *b);
/* Distance from alpha to the nearest of them, at most alpha itself. */
double dg_special_distance(const dg_branch_curves *b, double alpha);

#endif
