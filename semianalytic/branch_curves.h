/* Branch curves: the frequencies q_b(alpha) >= 0 at which the undamped d3(p, q) of (7) has a double real root
 * p, that is where a wave of the undamped track has no group velocity in the moving frame. There K(0, q) has
 * an inverse-square-root singularity that small damping moves off the real axis by about that damping. With s
 * = i(q - alpha p) of (8)-(10) a wave of branch k has q = alpha p + sign omega_k(p), sign = +-1; dq/dp = 0
 * gives alpha = -sign omega_k'(p). All quantities are dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_BRANCH_CURVES_H
#define CRITVEL_SEMIANALYTIC_BRANCH_CURVES_H

#include <stddef.h>

#include "semianalytic/branch_grid.h"

/* One point of a branch curve at a given alpha. */
typedef struct {
    int arc;          /* number of the arc it lies on: equal arcs at two velocities are one smooth curve */
    int k;            /* branch of dispersion.h */
    int sign;         /* of the frequency q - alpha p in the frame at rest, -1 or 1 */
    double p;         /* the double root of d3(p, q); of either sign */
    double q;         /* q_b = alpha p + sign omega_k(p) >= 0 */
    double curvature; /* d^2 q / dp^2 at fixed alpha = sign omega_k''(p); > 0: the two real roots p exist for
                       * q > q_b, < 0: for q < q_b. dq_b/dalpha = p. */
} sa_branch_point;

/* A monotone piece of a curve: for alpha_low <= alpha <= alpha_high exactly one wave number
 * p_low .. p_high (or down to) with direction * omega_k'(p) = alpha, p > 0, direction = +-1. */
typedef struct {
    int k, direction;
    long double alpha_low, alpha_high;
    long double p_low, p_high; /* at alpha_low, alpha_high; INFINITY where alpha_high is the shear speed */
} sa_branch_arc;

typedef enum {
    SA_SPECIAL_CUSP,      /* omega_k'' = 0: two arcs of a branch end here, at equal q */
    SA_SPECIAL_RESONANCE, /* q_b = 0, omega_k = p omega_k': a resonance velocity of the moving force */
    SA_SPECIAL_CROSSING,  /* two arcs with equal signs of omega - |p| alpha meet at one q */
    SA_SPECIAL_REFLECTED, /* the same with opposite signs: one of them is the reflection q -> -q */
    SA_SPECIAL_SHEAR /* alpha^2 mu_b = eta_s: a0 of Delta vanishes, a root p goes through infinity, q = 0 */
} sa_special_kind;

/* A velocity at which the arrangement of the branch points changes. */
typedef struct {
    sa_special_kind kind;
    double alpha;
    double q;   /* of the meeting; 0 for resonance and shear */
    int k, l;   /* branches that meet; equal for cusp and resonance; -1 for shear */
    double p;   /* |p| on branch k; INFINITY for shear */
    double p_l; /* |p| on branch l */
} sa_special;

typedef struct {
    double alpha_min, alpha_max;
    sa_branch_grid grid;
    size_t arc_count;
    sa_branch_arc *arc;
    size_t special_count;
    sa_special *special; /* alpha ascending, all within [alpha_min, alpha_max] */
} sa_branch_curves;

/* Prepares arcs and special velocities of the undamped track (dampings are ignored) for
 * 0 < alpha_min < alpha_max. params must have passed cv_params_check. The lists are complete as far as the
 * samples of branch_grid.h resolve the branches; special velocities are right to about 1e-15 relative, q to
 * about 1e-15 of omega. CV_FAILED: out of memory, nothing is then allocated. */
cv_status sa_branch_curves_build(sa_branch_curves *out, const cv_params *params, double alpha_min,
                                 double alpha_max, cv_message *why);
void sa_branch_curves_clear(sa_branch_curves *curves);

/* All branch points at one alpha in [alpha_min, alpha_max], q ascending, written to out[room]; returns how
 * many there are (arc_count is always room enough), or -1 when a wave cannot be computed. */
int sa_branch_points(sa_branch_point *out, size_t room, const sa_branch_curves *curves, double alpha);

/* The point of one arc at alpha_low <= alpha <= alpha_high: p > 0 as in sa_branch_arc, and the signed
 * q = omega_k(p) - |p| alpha direction. For the shear speed itself p is INFINITY and q = 0. */
cv_status sa_branch_arc_at(sa_wave *wave, long double *q, const sa_branch_curves *curves, size_t arc,
                           long double alpha);

#endif
