#include "dgreen/branch_points.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/branch_points_curves.h"

cv_status dg_branch_curves_new(dg_branch_curves **out, const dg_track *t, double alpha_min, double alpha_max,
                               cv_message *why)
{
    dg_branch_curves *b = calloc(1, sizeof *b);
    *out = NULL;
    if (b == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    b->track = t;
    cv_status status = dg_branch_curves_fill(b, alpha_min, alpha_max, why);
    if (status == CV_OK)
        status = dg_branch_curves_specials(b, alpha_min, alpha_max, why);
    if (status == CV_OK)
        *out = b;
    else
        dg_branch_curves_free(b);
    return status;
}

void dg_branch_curves_free(dg_branch_curves *b)
{
    if (b == NULL)
        return;
    for (int k = 0; k < DG_WAVE_BRANCHES; k++)
        free(b->tables[k].at);
    free(b->specials);
    free(b);
}

size_t dg_branch_points_max(const dg_branch_curves *b)
{
    return b->family_count + 2 * b->bend_count;
}

const dg_special_velocity *dg_special_velocities(size_t *count, const dg_branch_curves *b)
{
    *count = b->special_count;
    return b->specials;
}

double dg_special_distance(const dg_branch_curves *b, double alpha)
{
    double distance = alpha;
    for (size_t i = 0; i < b->special_count; i++)
        distance = fmin(distance, fabs(alpha - b->specials[i].alpha));
    return distance;
}

int dg_branch_point_on(dg_branch_point *point, const dg_branch_curves *b, int curve, double alpha)
{
    if (curve < 0 || (size_t)curve >= b->family_count)
        return 0;
    const dg_family *f = &b->families[curve];
    if (!(alpha >= f->alpha_low && alpha <= f->alpha_high))
        return 0;
    dg_family_point(point, b, (size_t)curve, alpha);
    return 1;
}

/* Before a pair is born its two branch points are complex: q = q_c +- i |Im q| with, from the cubic expansion
 * of omega at the cusp, |Im q| = (2/3) sqrt(2 |alpha - alpha_c|^3 / |omega'''|). Next to a peak of the
 * curvature two branches nearly cross, and zeta varies over the inverse of the curvature where alpha lies
 * between their group velocities. Elsewhere both waves are on the same side of the source, and the sum of
 * their residues does not see how close they are. */
static size_t add_soft(dg_branch_point *points, size_t n, const dg_bend *bend, size_t curve, double alpha)
{
    for (int sign = 1; sign >= -1; sign -= 2) {
        const double missing = alpha - sign * bend->group, q = sign * alpha * bend->p - bend->omega;
        if (bend->cusp && (sign * bend->group < 0 || missing * bend->scale * sign > 0))
            continue; /* no event for this sign of p, or the pair is real and in the list already */
        if (!bend->cusp && !(sign * alpha > bend->group_low && sign * alpha < bend->group_high))
            continue;
        const double width = bend->cusp ? sqrt(2 * fabs(missing * missing * missing / bend->scale)) * 2 / 3
                                        : 0.1 / fabs(bend->scale);
        points[n++] =
            (dg_branch_point){fabs(q), q, sign * bend->p, fmax(width, 1e-15), 0, (int)curve, 1, 0, 0};
    }
    return n;
}

static int ascending(const void *a, const void *b)
{
    const double x = ((const dg_branch_point *)a)->q, y = ((const dg_branch_point *)b)->q;
    return (x > y) - (x < y);
}

size_t dg_branch_points_at(dg_branch_point *points, const dg_branch_curves *b, double alpha)
{
    size_t n = 0;
    for (size_t i = 0; i < b->family_count; i++)
        n += (size_t)dg_branch_point_on(&points[n], b, (int)i, alpha);
    for (size_t i = 0; i < b->bend_count; i++)
        n = add_soft(points, n, &b->bends[i], b->family_count + i, alpha);
    qsort(points, n, sizeof *points, ascending);
    return n;
}
