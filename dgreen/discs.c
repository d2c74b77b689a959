/* dg_roots_enclose: inclusion discs in double. */
#include <float.h>
#include <math.h>

#include "dgreen/bounds.h"
#include "dgreen/roots.h"

static inline void sample(dg_discs *discs, dg_separation *s, const dg_operator *op, int i, int reversed,
                          double x, double y)
{
    const int n = op->degree;
    double re = 0, im = 0, d_re = 0, d_im = 0, size = 0, d_size = 0;
    const double modulus = sqrt(x * x + y * y);
    for (int k = n; k >= 0; k--) {
        const int at = reversed ? n - k : k;
        const double slope_re = d_re * x - d_im * y + re;
        d_im = d_re * y + d_im * x + im;
        d_re = slope_re;
        d_size = d_size * modulus + size;
        const double value_re = re * x - im * y + op->re[at];
        im = re * y + im * x + op->im[at];
        re = value_re;
        size = size * modulus + op->size[at];
    }
    discs->d_re[i] = d_re;
    discs->d_im[i] = d_im;
    s->modulus[i] = modulus;
    s->value[i] = sqrt(re * re + im * im) / s->unit + DG_VALUE_UNITS * size;
    s->slope[i] = sqrt(d_re * d_re + d_im * d_im);
    s->slope_error[i] = DG_SLOPE_UNITS * d_size;
}

cv_status dg_roots_enclose(dg_discs *discs, const dg_roots *roots, const dg_operator *op)
{
    dg_separation s;
    s.count = roots->count;
    s.far = roots->far;
    s.unit = DBL_EPSILON / 2;
    const int near = s.count - s.far;
    for (int i = 0; i < s.count; i++) {
        sample(discs, &s, op, i, i >= near, roots->re[i], roots->im[i]);
        for (int k = 0; k < i; k++) {
            const double dx = roots->re[i] - roots->re[k], dy = roots->im[i] - roots->im[k];
            s.distance[i][k] = s.distance[k][i] = sqrt(dx * dx + dy * dy);
        }
    }
    return dg_separate(discs->radius, discs->d_error, &s);
}
