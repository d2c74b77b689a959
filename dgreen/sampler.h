/* One track ready for D-decomposition curves at any velocity of a range: what counts, maps, figures and
 * roots begin with. */
#ifndef CRITVEL_DGREEN_SAMPLER_H
#define CRITVEL_DGREEN_SAMPLER_H

#include "dgreen/curve.h"

typedef struct {
    dg_track *track;
    dg_follow *follow;
    dg_branch_curves *branches;
    dg_curve curve; /* the last one sampled; its memory is used again */
} dg_sampler;

/* 0 < alpha_min <= alpha_max; params must have passed cv_params_check. One thread at a time. On failure
 * nothing is allocated.
 *
 * Damping may be zero: then all is the limit qbar -> i q + 0 of the undamped track, which is that of
 * vanishing damping ratios. For alpha > 0 it always has waves: the sleepers swing between rail and ballast at
 * rest, a flat branch of the dispersion relation that meets every line omega = +-(q - alpha p). So Im zeta is
 * zero only at crossings, with shear stiffness (eta_s > 0) too, though it may be tiny. */
cv_status dg_sampler_init(dg_sampler *s, const cv_params *params, double alpha_min, double alpha_max,
                          cv_message *why);
void dg_sampler_clear(dg_sampler *s);

/* For the functions of curve.h */
dg_probe dg_sampler_probe(const dg_sampler *s);

/* The curve at alpha down to x_floor (dg_curve_at) */
cv_status dg_sampler_curve(dg_sampler *s, double alpha, double x_floor, cv_message *why);

/* Number of roots of zeta = x > x_floor with Re qbar > 0, from the curve (dg_winding, with the crossings near
 * x separated from it). */
cv_status dg_sampler_count(int *roots, dg_sampler *s, double x, cv_message *why);

#endif
