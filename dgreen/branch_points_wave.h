/* Free waves of the undamped track, from the operator Delta (19) alone.
 *
 * Without damping Delta(lambda = i p)/4 depends on p and q only through Y = p^2 and X = sigma^2,
 * sigma = q - alpha p, and is a cubic in X with three positive roots X = omega_k(p)^2, k = 0, 1, 2 in
 * ascending order (the resting track does not buckle). All dimensionless. */
#ifndef CRITVEL_DGREEN_BRANCH_POINTS_WAVE_H
#define CRITVEL_DGREEN_BRANCH_POINTS_WAVE_H

#include "dgreen/operator.h"

enum { DG_WAVE_BRANCHES = 3 };

typedef struct {
    double omega;     /* frequency omega_k(p) > 0 at rest */
    double group;     /* d omega/dp */
    double curvature; /* d^2 omega/dp^2 */
} dg_wave;

/* Any p >= 0; branch 0, 1 or 2. Relative error of omega a few units of 1e-16; group and curvature lose as
 * many digits as their terms cancel. */
void dg_wave_at(dg_wave *w, const dg_track *t, double p, int branch);
/* The same, faster when omega is near the frequency; 0: not known. */
void dg_wave_near(dg_wave *w, const dg_track *t, double p, int branch, double omega);

/* |R/(d Delta/dq)| at that wave, undamped: its share in zeta, without q^2 and the slope of q. */
double dg_wave_strength(const dg_track *t, double p, const dg_wave *w);

/* How far damping moves a branch point of that wave off the real q axis, to first order in the damping:
 * |Im Delta / (d Delta/dq)| at the real p and sigma = -omega of the undamped wave. */
double dg_wave_shift(const dg_track *t, double p, const dg_wave *w);

#endif
