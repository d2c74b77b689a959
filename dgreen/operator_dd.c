#include "dgreen/operator_dd.h"

#include <string.h>

/* A polynomial in y, ascending */
typedef struct {
    dg_dd_complex c[DG_DEGREE + 1];
} polynomial;

/* s = i (w - alpha y), w = -i qbar, and the coefficients of s^2 */
typedef struct {
    double alpha, w_re, w_im;
    dg_dd_complex square[3];
} shift;

static shift shift_at(double alpha, double complex qbar)
{
    shift s = {.alpha = alpha, .w_re = cimag(qbar), .w_im = -creal(qbar)};
    const dg_dd_complex w = {{s.w_re, 0}, {s.w_im, 0}};
    s.square[0] = dg_dd_complex_scale(dg_dd_complex_mul(w, w), (dg_dd){-1, 0});
    s.square[1] = dg_dd_complex_scale(w, (dg_dd){2 * alpha, 0});
    s.square[2].re = dg_dd_scale((dg_dd){-alpha, 0}, alpha);
    return s;
}

static void add_real(polynomial *p, int k, dg_dd x)
{
    p->c[k].re = dg_dd_add(p->c[k].re, x);
}

/* p += mass * s^2 */
static void add_inertia(polynomial *p, dg_dd mass, const shift *s)
{
    for (int k = 0; k < 3; k++)
        p->c[k] = dg_dd_complex_add(p->c[k], dg_dd_complex_scale(s->square[k], mass));
}

/* p += 2 eta s + kappa */
static void add_spring(polynomial *p, dg_dd eta, dg_dd kappa, const shift *s)
{
    const dg_dd_complex damper = {dg_dd_scale(eta, -2 * s->w_im), dg_dd_scale(eta, 2 * s->w_re)};
    add_real(p, 0, kappa);
    p->c[0] = dg_dd_complex_add(p->c[0], damper);
    p->c[1].im = dg_dd_add(p->c[1].im, dg_dd_scale(eta, -2 * s->alpha));
}

static void add(polynomial *sum, const polynomial *a, int degree)
{
    for (int k = 0; k <= degree; k++)
        sum->c[k] = dg_dd_complex_add(sum->c[k], a->c[k]);
}

/* sum += a * b */
static void add_product(polynomial *sum, const polynomial *a, int degree_a, const polynomial *b, int degree_b)
{
    for (int i = 0; i <= degree_a; i++)
        for (int j = 0; j <= degree_b; j++)
            sum->c[i + j] = dg_dd_complex_add(sum->c[i + j], dg_dd_complex_mul(a->c[i], b->c[j]));
}

/* Rounding errors of products of coefficients and powers of roots stay far above the smallest double, and
 * products far below the largest, between these. */
static int in_range(const dg_operator *op)
{
    static const double LEAST = 1e-100, MOST = 1e100;
    for (int k = 0; k <= op->degree; k++)
        if (op->size[k] != 0 && !(op->size[k] > LEAST && op->size[k] < MOST))
            return 0;
    return 1;
}

cv_status dg_dd_operator_set(dg_dd_operator *op, const dg_track *t, double alpha, double complex qbar)
{
    const dg_dd *k = t->twofold, one = {1, 0};
    const shift s = shift_at(alpha, qbar);
    polynomial beam = {0}, pad = {0}, sleeper = {0}, ballast = {0}, foundation = {0};
    dg_operator_set(&op->rounded, t, alpha, qbar);
    if (!in_range(&op->rounded))
        return CV_UNDECIDED;
    add_inertia(&beam, (dg_dd){4, 0}, &s);
    add_real(&beam, 2, dg_dd_scale(k[DG_ETA_N], -4));
    add_real(&beam, 4, one);
    add_spring(&pad, k[DG_ETA_P], k[DG_KAPPA_P], &s);
    add_inertia(&sleeper, k[DG_MU_S], &s);
    add_spring(&ballast, k[DG_ETA_B], k[DG_KAPPA_B], &s);
    add_spring(&foundation, k[DG_ETA_F], one, &s);
    add_inertia(&foundation, k[DG_MU_B], &s);
    add_real(&foundation, 2, k[DG_ETA_S]);

    polynomial both = foundation, inner = {0}, r, delta = {0};
    add(&both, &ballast, 1);
    add_product(&inner, &sleeper, 2, &both, 2);
    add_product(&inner, &ballast, 1, &foundation, 2);
    r = inner;
    add_product(&r, &pad, 1, &both, 2);
    add_product(&delta, &pad, 1, &inner, 4);
    for (int i = 0; i <= DG_DEGREE; i++)
        delta.c[i] = dg_dd_complex_scale(delta.c[i], (dg_dd){4, 0});
    add_product(&delta, &beam, 4, &r, 4);
    memcpy(op->delta, delta.c, sizeof op->delta);
    memcpy(op->r, r.c, sizeof op->r);
    return CV_OK;
}
