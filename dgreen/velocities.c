#include "dgreen/velocities.h"

#include <math.h>
#include <stdlib.h>

/* Steps of at most this part of alpha and of the range, and this many per decade of the distance from a
 * special velocity, down to this part of its width. */
static const double RELATIVE_STEP = 0.01, RANGE_STEP = 0.0035, FIRST = 0.3;
enum { PER_DECADE = 3 };

static cv_status push(dg_velocities *v, double alpha, cv_message *why)
{
    if (v->count == v->room) {
        const size_t room = v->room ? 2 * v->room : 512;
        double *grown = realloc(v->at, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        v->at = grown;
        v->room = room;
    }
    v->at[v->count++] = alpha;
    return CV_OK;
}

static cv_status push_graded(dg_velocities *v, const dg_special_velocity *s, double low, double high,
                             int look, cv_message *why)
{
    const double ratio = pow(10, 1.0 / ldexp(PER_DECADE, look));
    cv_status status = CV_OK;
    for (double d = fmax(FIRST * s->width, 4e-16 * s->alpha); d < high - low && status == CV_OK; d *= ratio) {
        if (s->alpha - d > low)
            status = push(v, s->alpha - d, why);
        if (status == CV_OK && s->alpha + d < high)
            status = push(v, s->alpha + d, why);
    }
    return status;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

cv_status dg_velocities_choose(dg_velocities *v, const dg_branch_curves *branches, double alpha_min,
                               double alpha_max, int look, cv_message *why)
{
    size_t n;
    const dg_special_velocity *special = dg_special_velocities(&n, branches);
    const double range = ldexp(RANGE_STEP, -look) * (alpha_max - alpha_min);
    const double relative = ldexp(RELATIVE_STEP, -look);
    cv_status status = push(v, alpha_max, why);
    for (double a = alpha_min; a < alpha_max && status == CV_OK; a += fmin(relative * a, range))
        status = push(v, a, why);
    for (size_t i = 0; i < n && status == CV_OK; i++) {
        const double low = i > 0 ? (special[i - 1].alpha + special[i].alpha) / 2 : alpha_min;
        const double high = i + 1 < n ? (special[i + 1].alpha + special[i].alpha) / 2 : alpha_max;
        status = push_graded(v, &special[i], low, high, look, why);
    }
    qsort(v->at, v->count, sizeof *v->at, ascending);
    size_t kept = 0;
    for (size_t i = 0; i < v->count; i++)
        if (kept == 0 || v->at[i] > v->at[kept - 1])
            v->at[kept++] = v->at[i];
    v->count = kept;
    return status;
}

double dg_velocities_middle(const dg_branch_curves *branches, double low, double high)
{
    size_t n;
    const dg_special_velocity *special = dg_special_velocities(&n, branches);
    double below = 0, above = INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (special[i].alpha <= low)
            below = fmax(below, special[i].alpha);
        if (special[i].alpha >= high)
            above = fmin(above, special[i].alpha);
    }
    double middle = low - below <= above - high ? below + sqrt((low - below) * (high - below))
                                                : above - sqrt((above - low) * (above - high));
    return middle > low && middle < high ? middle : low + (high - low) / 2;
}
