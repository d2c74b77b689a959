#include "dgreen/sampler.h"

#include <math.h>
#include <string.h>

#include "dgreen/winding.h"

cv_status dg_sampler_init(dg_sampler *s, const cv_params *params, double alpha_min, double alpha_max,
                          cv_message *why)
{
    memset(s, 0, sizeof *s);
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
    return (dg_probe){s->track, s->follow, s->branches};
}

/* zeta ~ C/sqrt(q - q_b): what passes the real axis inside a bracket that holds q_b passes it at infinity. */
static void send_to_infinity(dg_curve *c)
{
    for (size_t i = 0; i < c->crossing_count; i++) {
        dg_crossing *x = &c->crossings[i];
        for (size_t k = 0; k < c->at.count; k++)
            if (!c->at.points[k].soft && c->at.points[k].q >= x->q_low && c->at.points[k].q <= x->q_high)
                x->x = x->x_low = x->x_high = INFINITY;
    }
}

cv_status dg_sampler_curve(dg_sampler *s, double alpha, double x_floor, cv_message *why)
{
    const dg_probe probe = dg_sampler_probe(s);
    const cv_status status = dg_curve_at(&s->curve, &probe, alpha, x_floor, why);
    for (size_t i = 0; status == CV_OK && i < s->curve.node_count; i++)
        if (s->curve.nodes[i].im == 0 && s->curve.nodes[i].re > x_floor)
            return cv_fail(why, CV_UNDECIDED,
                           "no damping and no radiation at alpha = %.17g, q = %.17g: z is real there", alpha,
                           s->curve.nodes[i].q);
    if (status == CV_OK && !s->track->damped)
        send_to_infinity(&s->curve);
    return status;
}

cv_status dg_sampler_count(int *roots, dg_sampler *s, double x, cv_message *why)
{
    const dg_probe probe = dg_sampler_probe(s);
    const cv_status status = dg_curve_separate(&s->curve, &probe, x, why);
    return status == CV_OK ? dg_winding(roots, &s->curve, x, why) : status;
}
