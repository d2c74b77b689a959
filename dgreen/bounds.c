#include "dgreen/bounds.h"

#include <math.h>

#include "dgreen/lanes.h"

/* Distances are computed in double with a few rounding errors. */
static const double SLACK = 1 - 1e-14;

void dg_separation_open(dg_separation *s, int count, int far, double unit)
{
    s->count = count;
    s->far = far;
    s->unit = unit;
    for (int k = 0; k < DG_DEGREE; k++) {
        s->value[k] = s->slope_error[k] = s->modulus[k] = 0;
        s->slope[k] = 1;
        for (int i = 0; i < DG_DEGREE; i++)
            s->distance[k][i] = HUGE_VAL;
    }
}

void dg_separation_set_distance(dg_separation *s, int i, int k, double distance)
{
    s->distance[(k - i + DG_DEGREE) % DG_DEGREE][i] = distance;
    s->distance[(i - k + DG_DEGREE) % DG_DEGREE][k] = distance;
}

/* |f/f'|, the derivative without its rounding error, and the half-widths of the first discs, twice in a row;
 * 0 for slots without a near root. */
typedef struct {
    double newton[DG_DEGREE], slope[DG_DEGREE], wide[2 * DG_DEGREE], wide_far;
} first_discs;

DG_PART void first_look(first_discs *f, const dg_separation *s)
{
    const int near = s->count - s->far;
    for (int i = 0; i < DG_DEGREE; i++) {
        f->slope[i] = s->slope[i] - s->slope_error[i] * s->unit;
        f->newton[i] = s->value[i] / (f->slope[i] * SLACK);
    }
    for (int i = 0; i < DG_DEGREE; i++)
        f->wide[i] = f->wide[i + DG_DEGREE] = i < near ? s->count * f->newton[i] * s->unit : 0;
    f->wide_far = s->far ? s->count * f->newton[near] * s->unit : 0;
}

/* Each near root against the other near ones: crowding = sum over k of 1/(distance to the nearest point of
 * disc k), spare = the least gap between its disc and another. */
DG_PART void near_crowding(double crowding[DG_DEGREE], double spare[DG_DEGREE], const first_discs *f,
                           const dg_separation *s)
{
    for (int i = 0; i < DG_DEGREE; i++) {
        crowding[i] = 0;
        spare[i] = HUGE_VAL;
    }
    for (int k = 1; k < DG_DEGREE; k++)
        for (int i = 0; i < DG_DEGREE; i++) {
            const double gap = s->distance[k][i] * SLACK - f->wide[i + k], left = gap - f->wide[i];
            spare[i] = left < spare[i] ? left : spare[i];
            crowding[i] += 1 / gap;
        }
}

/* The far root, which is kept as u = 1/y, against the others: in the y plane for those, in the u plane for
 * it. */
static void add_far(double crowding[DG_DEGREE], double spare[DG_DEGREE], const first_discs *f,
                    const dg_separation *s)
{
    const int last = s->count - 1;
    const double edge = 1 / (s->modulus[last] + f->wide_far);
    crowding[last] = 0;
    spare[last] = HUGE_VAL;
    for (int i = 0; i < last; i++) {
        const double gap = (edge - s->modulus[i]) * SLACK;
        crowding[i] += 1 / gap;
        spare[i] = fmin(spare[i], gap - fmax(f->wide[i], s->modulus[i]));
        const double far_gap = (1 / (s->modulus[i] + f->wide[i]) - s->modulus[last]) * SLACK;
        crowding[last] += 1 / far_gap;
        spare[last] = fmin(spare[last], far_gap - fmax(f->wide_far, s->modulus[last]));
    }
}

/* Disjoint discs, derivatives that are not rounding; NaN fails. */
DG_PART int is_separate(const first_discs *f, const double *crowding, const double *spare,
                       const dg_separation *s)
{
    int good = 1;
    for (int i = 0; i < s->count; i++)
        good &= 10 * s->slope_error[i] * s->unit < s->slope[i] && spare[i] > 0 &&
                f->newton[i] * s->unit * crowding[i] < 0.04;
    return good;
}

DG_CLONES cv_status dg_separate(double *radius, double *slope_relative, double *crowding,
                                const dg_separation *s)
{
    first_discs f;
    double sum[DG_DEGREE], spare[DG_DEGREE];
    first_look(&f, s);
    near_crowding(sum, spare, &f, s);
    if (s->far)
        add_far(sum, spare, &f, s);
    if (!is_separate(&f, sum, spare, s))
        return CV_UNDECIDED;
    for (int i = 0; i < DG_DEGREE; i++) {
        const double final = f.newton[i] / ((1 - f.newton[i] * s->unit * sum[i]) * SLACK);
        crowding[i] = sum[i];
        radius[i] = final;
        slope_relative[i] = s->slope_error[i] / f.slope[i] + 2.5 * final * sum[i];
    }
    return CV_OK;
}

dg_r_size dg_r_size_at(const dg_operator *op, int far, double x, double y, double reach)
{
    double re = 0, im = 0, d_re = 0, d_im = 0, size = 0;
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const int at = far ? DG_R_DEGREE - k : k;
        const double next = d_re * x - d_im * y + re;
        d_im = d_re * y + d_im * x + im;
        d_re = next;
        const double value = re * x - im * y + op->r_re[at];
        im = re * y + im * x + op->r_im[at];
        re = value;
        size = size * reach + op->r_size[at];
    }
    const double rounding = reach > 0 ? 8 * DG_R_UNITS * 0x1p-53 * size / reach : 0;
    return (dg_r_size){size, hypot(d_re, d_im) + rounding};
}
