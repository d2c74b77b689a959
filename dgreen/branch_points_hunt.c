#include "dgreen/branch_points_hunt.h"

#include <float.h>
#include <math.h>

enum { MAX_DEPTH = 120, MAX_STEPS = 200 };

/* A tangent that ends above this part of the nearer value has enough room for the curvature it ignores. */
static const double CLEARANCE = 0.3;

static int too_narrow(const dg_sample *low, const dg_sample *high)
{
    return high->at - low->at <= 4 * DBL_EPSILON * fabs(high->at);
}

/* Where to cut an interval whose ends have the same sign; 0 when no zero is expected inside. */
static int cut_between(double *at, const dg_sample *low, const dg_sample *high)
{
    const double sign = low->value >= 0 ? 1 : -1;
    if (!(sign * low->slope < 0 && sign * high->slope > 0))
        return 0;
    const double width = high->at - low->at;
    const double from_low = (low->value - high->value + high->slope * width) / (high->slope - low->slope);
    const double meeting = sign * (low->value + low->slope * from_low);
    if (meeting > CLEARANCE * fmin(fabs(low->value), fabs(high->value)))
        return 0;
    *at = low->at + fmin(fmax(from_low, 0.05 * width), 0.95 * width);
    return 1;
}

static cv_status hunt(const dg_hunter *h, const dg_sample *low, const dg_sample *high, int depth)
{
    double at = low->at + (high->at - low->at) / 2;
    if ((low->value >= 0) != (high->value >= 0)) {
        const double rise = high->value >= 0 ? 1 : -1;
        if ((rise * low->slope >= 0 && rise * high->slope >= 0) || too_narrow(low, high))
            return h->found(low, high, h->context);
    } else {
        if (!cut_between(&at, low, high))
            return CV_OK;
        if (too_narrow(low, high))
            return CV_UNDECIDED;
    }
    if (depth == 0)
        return CV_UNDECIDED;
    dg_sample middle = {.at = at};
    cv_status status = h->function(&middle, h->context);
    if (status == CV_OK)
        status = hunt(h, low, &middle, depth - 1);
    return status == CV_OK ? hunt(h, &middle, high, depth - 1) : status;
}

cv_status dg_hunt_zeros(const dg_hunter *h, const dg_sample *low, const dg_sample *high)
{
    return hunt(h, low, high, MAX_DEPTH);
}

cv_status dg_hunt_refine(dg_sample *zero, const dg_hunter *h, const dg_sample *low, const dg_sample *high)
{
    dg_sample a = *low, b = *high;
    double step = INFINITY;
    *zero = fabs(a.value) < fabs(b.value) ? a : b;
    for (int i = 0; i < MAX_STEPS && !too_narrow(&a, &b) && zero->value != 0; i++) {
        double at = zero->at - zero->value / zero->slope;
        if (!(at > a.at && at < b.at && fabs(at - zero->at) < fabs(step) / 2))
            at = a.at + (b.at - a.at) / 2;
        step = at - zero->at;
        if (fabs(step) <= DBL_EPSILON * fabs(at))
            break;
        zero->at = at;
        const cv_status status = h->function(zero, h->context);
        if (status != CV_OK)
            return status;
        *((zero->value >= 0) == (a.value >= 0) ? &a : &b) = *zero;
    }
    return CV_OK;
}
