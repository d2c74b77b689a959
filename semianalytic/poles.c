#include "semianalytic/poles.h"

#include <lapacke.h>
#include <string.h>

/* Rows and columns of the pencil A - p B, order 8: the unknowns W, pW, p^2 W, p^3 W, V, pV, U, pU. */
enum { W0, W1, W2, W3, V0, V1, U0, U1, SIZE };

typedef struct {
    double complex a[SIZE][SIZE], b[SIZE][SIZE];
} pencil;

/* coefficients of 1, p, p^2 in a dynamic stiffness k + c s + m s^2 + e p^2, s = i (q - alpha p) */
typedef struct {
    double complex c[3];
} quadratic;

static quadratic stiffness(double k, double c, double m, double e, double alpha, double complex q)
{
    double complex iq = CMPLX(-cimag(q), creal(q)), s_p = CMPLX(0, -alpha);
    return (quadratic){{k + c * iq + m * iq * iq, (c + 2 * m * iq) * s_p, e - m * alpha * alpha}};
}

/* sign * polynomial into row "row" of A, at the unknowns that start at column "column" */
static void put(pencil *x, int row, int column, quadratic f, double sign)
{
    x->a[row][column] += sign * f.c[0];
    x->a[row][column + 1] += sign * f.c[1];
}

static void build(pencil *x, const sa_track *t, double alpha, double complex q)
{
    quadratic rail = stiffness(0, 0, 1, -t->eta_N.m, alpha, q);
    quadratic pad = stiffness(t->kappa_p.m, t->loss_p.m, 0, 0, alpha, q);
    quadratic sleeper = stiffness(0, 0, t->mu_s.m, 0, alpha, q);
    quadratic ballast = stiffness(t->kappa_b.m, t->loss_b.m, 0, 0, alpha, q);
    quadratic ground = stiffness(1, t->loss_f.m, t->mu_b.m, t->eta_s.m, alpha, q);
    memset(x, 0, sizeof *x);
    const int links[] = {W0, W1, W2, V0, U0};
    for (size_t i = 0; i < sizeof links / sizeof links[0]; i++)
        x->a[links[i]][links[i] + 1] = x->b[links[i]][links[i]] = 1;
    put(x, W3, W0, rail, 1);
    put(x, W3, W0, pad, 1);
    put(x, W3, V0, pad, -1);
    x->a[W3][W2] = rail.c[2];
    x->b[W3][W3] = -0.25;
    put(x, V1, W0, pad, -1);
    put(x, V1, V0, pad, 1);
    put(x, V1, V0, sleeper, 1);
    put(x, V1, V0, ballast, 1);
    put(x, V1, U0, ballast, -1);
    x->b[V1][V1] = -sleeper.c[2];
    put(x, U1, V0, ballast, -1);
    put(x, U1, U0, ballast, 1);
    put(x, U1, U0, ground, 1);
    x->b[U1][U1] = -ground.c[2];
}

/* Newton's step for d3 divided by the product of (p - found[j]); the plain step for n = 0. */
static double complex deflated_step(const sa_point *m, const double complex *found, int n)
{
    double complex pull = 0;
    for (int j = 0; j < n; j++)
        pull += 1 / (m->p - found[j]);
    return m->det / (m->det_p - m->det * pull);
}

static int small(double complex step, double complex p, double limit)
{
    return fabs(creal(step)) <= limit * cabs(p) && fabs(cimag(step)) <= limit * fabs(cimag(p));
}

static int iterate(double complex *p, sa_point *m, const sa_track *t, double alpha, double complex q,
                   const double complex *found, int n, int limit)
{
    /* Near a double root rounding keeps the relative step of a tiny imaginary part above the fine limit: two
     * steps below the coarse one are as good as it gets, and the enclosure judges. */
    const double fine = 0x1p-23, coarse = 0x1p-14;
    int close = 0;
    for (int i = 0; i < limit && close < 2; i++) {
        sa_matrix_point(m, t, alpha, q, *p);
        double complex step = deflated_step(m, found, n);
        *p -= step;
        if (!isfinite(creal(*p)) || !isfinite(cimag(*p)))
            return 0;
        if (small(step, *p, fine))
            close = 2;
        else if (small(step, *p, coarse))
            close++;
        else
            close = 0;
    }
    sa_matrix_point(m, t, alpha, q, *p);
    return close > 0;
}

int sa_poles_newton(double complex *p, sa_point *m, const sa_track *t, double alpha, double complex q)
{
    enum { WARM_STEPS = 16 };
    return iterate(p, m, t, alpha, q, NULL, 0, WARM_STEPS);
}

cv_status sa_poles_cold(double complex out[SA_POLES_MAX], int *count, const sa_track *t, double alpha,
                        double complex q)
{
    enum { DEFLATED_STEPS = 30, COLD_STEPS = 4 };
    pencil x;
    double complex top[SIZE], bottom[SIZE];
    sa_point m;
    build(&x, t, alpha, q);
    if (LAPACKE_zggev(LAPACK_ROW_MAJOR, 'N', 'N', SIZE, &x.a[0][0], SIZE, &x.b[0][0], SIZE, top, bottom, NULL,
                      1, NULL, 1) != 0)
        return CV_FAILED;
    *count = 0;
    for (int i = 0; i < SIZE; i++) {
        double complex p = top[i] / bottom[i];
        if (!isfinite(creal(p)) || !isfinite(cimag(p)) || cabs(p) > 1e15)
            continue;
        out[*count] = p;
        iterate(&p, &m, t, alpha, q, out, *count, DEFLATED_STEPS);
        iterate(&p, &m, t, alpha, q, NULL, 0, COLD_STEPS);
        if (isfinite(creal(p)) && isfinite(cimag(p)))
            out[*count] = p;
        (*count)++;
    }
    return CV_OK;
}

/* p - det / det_p(box) inside the box? */
static int newton_inside(const sa_enclosure *thin, const sa_enclosure *wide)
{
    sa_rect step = sa_rect_div(thin->det, wide->det_p);
    return (fabs(step.re) + step.re_rad) * SA_INFLATE <= wide->p.re_rad &&
           (fabs(step.im) + step.im_rad) * SA_INFLATE <= wide->p.im_rad;
}

int sa_poles_enclose(sa_pole *out, const sa_point *m, const sa_track *t, double alpha, double complex q)
{
    sa_enclosure thin, wide;
    sa_matrix_enclose(&thin, t, alpha, q, sa_rect_exact(m->p));
    sa_rect step = sa_rect_div(thin.det, sa_rect_exact(m->det_p));
    sa_rect box = {creal(m->p), cimag(m->p), 2 * (fabs(step.re) + step.re_rad),
                   2 * (fabs(step.im) + step.im_rad)};
    for (int attempt = 0; attempt < 3; attempt++) {
        sa_matrix_enclose(&wide, t, alpha, q, box);
        sa_matrix_enclose_slope(&wide, t, alpha);
        if (newton_inside(&thin, &wide)) {
            *out = (sa_pole){box, sa_matrix_enclose_residue(&wide)};
            return 1;
        }
        box.re_rad *= 3;
        box.im_rad *= 3;
    }
    return 0;
}

int sa_poles_separate(const sa_pole *poles, int n)
{
    for (int i = 0; i < n; i++) {
        if (!(poles[i].box.im > poles[i].box.im_rad * SA_INFLATE))
            return 0;
        for (int j = 0; j < i; j++)
            if (!sa_rect_disjoint(poles[i].box, poles[j].box))
                return 0;
    }
    return 1;
}
