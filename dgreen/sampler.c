#include "dgreen/sampler.h"

#include <math.h>
#include <string.h>

#include "dgreen/winding.h"

cv_status dg_sampler_init(dg_sampler *s, const cv_params *params, double alpha_min, double alpha_max,
                          cv_message *why)
{
    memset(s, 0, sizeof *s);
    s->undamped = cv_params_undamped(params);
    cv_status status = dg_track_new(&s->track, params, why);
    if (status == CV_OK)
        status = dg_follow_new(&s->follow, why);
    if (status == CV_OK)
        status = dg_branch_curves_new(&s->branches, s->track, alpha_min, alpha_max, why);
    if (status != CV_OK)
        dg_sampler_clear(s);
    return status;
}

void dg_sampler_clear(dg_sampler *s)
{
    dg_curve_clear(&s->curve);
    dg_branch_curves_free(s->branches);
    dg_follow_free(s->follow);
    dg_track_free(s->track);
    memset(s, 0, sizeof *s);
}

dg_probe dg_sampler_probe(const dg_sampler *s)
{
    return (dg_probe){s->track, s->follow, s->branches, 0};
}

/* zeta ~ C/sqrt(q - q_b): what passes the real axis next to q_b, as near as that is known in double, passes
 * it at infinity. */
static void send_to_infinity(dg_curve *c)
{
    static const double ROUNDING = 1e-13, RESIDUE = 1e-15; /* q_b = alpha p - omega may cancel */
    for (size_t i = 0; i < c->crossing_count; i++) {
        dg_crossing *x = &c->crossings[i];
        for (size_t k = 0; k < c->at.count; k++) {
            const dg_branch_point *point = &c->at.points[k];
            const double near = ROUNDING * point->q + RESIDUE * c->at.alpha * fabs(point->p);
            if (!point->soft && point->q >= x->q_low - near && point->q <= x->q_high + near)
                x->x = x->x_low = x->x_high = INFINITY;
        }
    }
}

cv_status dg_sampler_curve(dg_sampler *s, double alpha, double x_floor, cv_message *why)
{
    const dg_probe probe = dg_sampler_probe(s);
    const cv_status status = dg_curve_at(&s->curve, &probe, alpha, x_floor, why);
    if (status == CV_OK && s->undamped)
        send_to_infinity(&s->curve);
    return status;
}

cv_status dg_sampler_count(int *roots, dg_sampler *s, double x, cv_message *why)
{
    const dg_probe probe = dg_sampler_probe(s);
    const cv_status status = dg_curve_separate(&s->curve, &probe, x, why);
    return status == CV_OK ? dg_winding(roots, &s->curve, x, why) : status;
}
