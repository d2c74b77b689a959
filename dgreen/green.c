#include "dgreen/green.h"

#include <math.h>

#include "dgreen/roots.h"

/* lambda of root i; the far root is kept as u = 1/y, lambda = i y. */
static double complex lambda_of(const dg_roots *roots, int i)
{
    const double complex kept = CMPLX(roots->re[i], roots->im[i]);
    return roots->far && i == roots->count - 1 ? CMPLX(0, 1) / kept : CMPLX(0, 1) * kept;
}

/* c[k] belongs to y^k = (lambda/i)^k */
static double complex to_lambda(double re, double im, int power)
{
    static const double complex inverse_i[4] = {1, CMPLX(0, -1), -1, CMPLX(0, 1)};
    return CMPLX(re, im) * inverse_i[power % 4];
}

/* Finite roots, those with Re lambda > 0 first. CV_UNDECIDED when a disc meets the axis. */
static cv_status sort_roots(dg_green *g, const dg_roots *roots, const dg_discs *discs)
{
    const int last = roots->count - 1;
    const int infinite = roots->far && roots->re[last] == 0 && roots->im[last] == 0;
    g->count = roots->count - infinite;
    int first = 0, end = g->count;
    for (int i = 0; i < g->count; i++) {
        const double complex lambda = lambda_of(roots, i);
        if (!(fabs(roots->im[i]) > discs->radius_im[i] * 0x1p-53))
            return CV_UNDECIDED;
        if (creal(lambda) > 0)
            g->lambda[first++] = lambda;
        else
            g->lambda[--end] = lambda;
    }
    g->right_count = first;
    return CV_OK;
}

static void set_weights(dg_green *g)
{
    for (int i = 0; i < g->count; i++) {
        double complex product = g->a0;
        for (int k = 0; k < g->count; k++)
            if (k != i)
                product *= g->lambda[k] - g->lambda[i];
        g->weight[i] = 1 / product;
    }
}

cv_status dg_green_set(dg_green *g, const dg_track *track, double alpha, double complex qbar)
{
    dg_operator op;
    dg_roots roots;
    dg_discs discs;
    dg_operator_set(&op, track, alpha, qbar);
    cv_status status = dg_roots_cold(&roots, &op);
    if (status == CV_OK)
        status = dg_roots_polish_cold(&roots, &op);
    if (status == CV_OK)
        status = dg_roots_enclose(&discs, &roots, &op);
    if (status == CV_OK)
        status = sort_roots(g, &roots, &discs);
    if (status != CV_OK)
        return status;
    g->a0 = to_lambda(op.re[g->count], op.im[g->count], g->count);
    for (int j = 0; j <= DG_R_DEGREE; j++)
        g->r[j] = to_lambda(op.r_re[j], op.r_im[j], j);
    set_weights(g);
    return CV_OK;
}

/* (28) with the factor f(lambda) in each term; n - 1 differences turn (lambda_k - lambda_i) into
 * (lambda_i - lambda_k): the sign of (28) is that of an even degree, with an odd one it turns. */
static double complex sum(const dg_green *g, const double complex *factor, double distance, dg_side side)
{
    const int before = distance < 0 || (distance == 0 && side == DG_BEFORE);
    const int from = before ? 0 : g->right_count, to = before ? g->right_count : g->count;
    double complex total = 0;
    for (int i = from; i < to; i++)
        total += factor[i] * g->weight[i] * cexp(g->lambda[i] * distance);
    return (before != g->count % 2) ? total : -total;
}

double complex dg_green_derivative(const dg_green *g, int order, double distance, dg_side side)
{
    double complex factor[DG_DEGREE];
    for (int i = 0; i < g->count; i++) {
        factor[i] = 1;
        for (int k = 0; k < order; k++)
            factor[i] *= g->lambda[i];
    }
    return sum(g, factor, distance, side);
}

double complex dg_green_deflection(const dg_green *g, double xi)
{
    double complex factor[DG_DEGREE];
    for (int i = 0; i < g->count; i++) {
        factor[i] = 0;
        for (int j = DG_R_DEGREE; j >= 0; j--)
            factor[i] = factor[i] * g->lambda[i] + g->r[j];
        factor[i] *= 4;
    }
    return sum(g, factor, xi, DG_BEFORE);
}
