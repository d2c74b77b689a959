#include "dgreen/count.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/winding.h"

struct dg_counter {
    dg_track *track;
    dg_follow *follow;
    dg_branch_curves *branches;
    dg_curve curve; /* its memory is used again */
};

/* The curve is listed down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.3;

cv_status dg_counter_new(dg_counter **out, const cv_params *params, double alpha_min, double alpha_max,
                         cv_message *why)
{
    *out = NULL;
    if (cv_params_undamped(params))
        return cv_fail(why, CV_BAD_INPUT, "counting needs damping: all damping ratios are zero");
    dg_counter *c = calloc(1, sizeof *c);
    if (c == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = dg_track_new(&c->track, params, why);
    if (status == CV_OK)
        status = dg_follow_new(&c->follow, why);
    if (status == CV_OK)
        status = dg_branch_curves_new(&c->branches, c->track, alpha_min, alpha_max, why);
    if (status == CV_OK)
        *out = c;
    else
        dg_counter_free(c);
    return status;
}

void dg_counter_free(dg_counter *c)
{
    if (c == NULL)
        return;
    dg_curve_clear(&c->curve);
    dg_branch_curves_free(c->branches);
    dg_follow_free(c->follow);
    dg_track_free(c->track);
    free(c);
}

cv_status dg_count_unstable(int *roots, size_t *failed, dg_counter *c, double alpha, size_t mass_count,
                            const cv_number *mass_ratios, cv_message *why)
{
    const dg_probe probe = {c->track, c->follow, c->branches};
    double least = HUGE_VAL;
    for (size_t i = 0; i < mass_count; i++)
        least = fmin(least, 1 / cv_number_get_double(&mass_ratios[i]));
    *failed = 0;
    cv_status status = dg_curve_at(&c->curve, &probe, alpha, FLOOR * least, why);
    for (size_t i = 0; i < mass_count && status == CV_OK; i++) {
        const double x = 1 / cv_number_get_double(&mass_ratios[i]);
        *failed = i;
        status = dg_curve_separate(&c->curve, &probe, x, why);
        if (status == CV_OK)
            status = dg_winding(&roots[i], &c->curve, x, why);
    }
    return status;
}
