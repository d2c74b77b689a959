#include "dgreen/sampler.h"

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
    return (dg_probe){s->track, s->follow, s->branches, 0};
}

cv_status dg_sampler_curve(dg_sampler *s, double alpha, double x_floor, cv_message *why)
{
    const dg_probe probe = dg_sampler_probe(s);
    return dg_curve_at(&s->curve, &probe, alpha, x_floor, why);
}

cv_status dg_sampler_count(int *roots, dg_sampler *s, double x, cv_message *why)
{
    const dg_probe probe = dg_sampler_probe(s);
    cv_status status = dg_curve_separate(&s->curve, &probe, x, why);
    if (status == CV_UNDECIDED)
        status = dg_curve_separate_exactly(&s->curve, &probe, x, why);
    return status == CV_OK ? dg_winding(roots, &s->curve, x, why) : status;
}
