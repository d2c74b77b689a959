#include "dgreen/curve_probe.h"

#include <math.h>

/* Step of the differences relative to the distance over which zeta changes: its square is the relative error
 * of a central difference. */
static const double STEP = 1e-4;

cv_status dg_probe_at(dg_node *node, const dg_probe *p, double alpha, double q)
{
    dg_value v;
    const double complex qbar = CMPLX(0, q);
    cv_status status = dg_zeta_double(&v, p->follow, p->track, alpha, qbar);
    if (status == CV_UNDECIDED || (status == CV_OK && !(v.im_error < fabs(v.im))))
        status = dg_zeta_adaptive(&v, p->follow, p->track, alpha, qbar, INFINITY, 0.5);
    if (status == CV_OK)
        *node = (dg_node){q, v.re, v.im, v.re_error};
    return status;
}

/* zeta without asking for a sign */
static cv_status plain(double complex *z, const dg_probe *p, double alpha, double q)
{
    dg_value v;
    const double complex qbar = CMPLX(0, q);
    cv_status status = dg_zeta_double(&v, p->follow, p->track, alpha, qbar);
    if (status == CV_UNDECIDED)
        status = dg_zeta_adaptive(&v, p->follow, p->track, alpha, qbar, 1e-10, INFINITY);
    *z = CMPLX(v.re, v.im);
    return status;
}

static cv_status difference(double complex *d, const dg_probe *p, double alpha, double q, double d_alpha,
                            double d_q)
{
    double complex above, below;
    cv_status status = plain(&below, p, alpha - d_alpha, q - d_q);
    if (status == CV_OK)
        status = plain(&above, p, alpha + d_alpha, q + d_q);
    if (status == CV_OK)
        *d = (above - below) / 2;
    return status;
}

cv_status dg_probe_slopes(dg_slopes *s, const dg_probe *p, double alpha, double q, double distance,
                          double wave)
{
    const double h_q = STEP * distance, h_alpha = fmin(h_q / wave, STEP * alpha);
    double complex by_q, by_alpha;
    cv_status status = difference(&by_q, p, alpha, q, 0, h_q);
    if (status == CV_OK)
        status = difference(&by_alpha, p, alpha, q, h_alpha, 0);
    if (status != CV_OK)
        return status;
    by_q /= h_q;
    by_alpha /= h_alpha;
    s->im_q = cimag(by_q);
    s->im_alpha = cimag(by_alpha);
    s->dq = -s->im_alpha / s->im_q;
    s->dx = creal(by_alpha) + creal(by_q) * s->dq;
    return CV_OK;
}
