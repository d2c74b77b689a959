#include "dgreen/curve_probe.h"

#include <math.h>

/* Steps of the differences relative to the distances over which zeta changes: in q, and in alpha. Their
 * squares are the relative errors of central differences. */
static const double Q_STEP = 1e-4, ALPHA_STEP = 1e-3;
/* Closer to a branch point than the step suits, the rounding of its frequency (some 1e-15) asks for longer
 * steps in alpha, up to this part. */
static const double Q_NOISE = 1e-14, LONGEST_ALPHA_STEP = 0.02;

/* Largest error of Re zeta relative to |zeta|, so that the curve in double passes every 1/eta_M on its side
 */
static const double RE_TOLERANCE = 1e-3;

static int is_certain(const dg_value *v)
{
    return v->im_error < fabs(v->im);
}

static int is_coarse(const dg_value *v)
{
    return !(v->re_error <= RE_TOLERANCE * hypot(v->re, v->im));
}

cv_status dg_probe_at(dg_node *node, const dg_probe *p, double alpha, double q)
{
    dg_value v;
    const double complex qbar = CMPLX(0, q);
    cv_status status = dg_zeta_double(&v, p->follow, p->track, alpha, qbar);
    if (status == CV_UNDECIDED || (status == CV_OK && !is_certain(&v)))
        status = dg_zeta_above_double(&v, p->follow, p->track, alpha, qbar, INFINITY, 0.5);
    if (status == CV_OK)
        *node = (dg_node){q, v.re, v.im, v.re_error, 0};
    return status;
}

cv_status dg_probe_sharpen(dg_node *node, const dg_probe *p, double alpha)
{
    dg_value v;
    const double size = hypot(node->re, node->im), tol_re = RE_TOLERANCE * size / fabs(node->re);
    if (node->re_error <= RE_TOLERANCE * size)
        return CV_OK;
    const cv_status status = dg_zeta_adaptive(&v, p->follow, p->track, alpha, CMPLX(0, node->q), tol_re, 0.5);
    if (status == CV_OK)
        *node = (dg_node){node->q, v.re, v.im, v.re_error, node->position};
    return status;
}

cv_status dg_probe_value(dg_node *node, int *certain, const dg_probe *p, double alpha, double q)
{
    dg_value v;
    const double complex qbar = CMPLX(0, q);
    cv_status status = dg_zeta_double(&v, p->follow, p->track, alpha, qbar);
    if (status == CV_UNDECIDED || (status == CV_OK && is_coarse(&v)))
        status = dg_zeta_above_double(&v, p->follow, p->track, alpha, qbar, 1e-10, INFINITY);
    if (status == CV_OK) {
        *certain = is_certain(&v);
        *node = (dg_node){q, v.re, v.im, v.re_error, 0};
    }
    return status;
}

static cv_status difference(double *re, double *im, const dg_probe *p, const double alpha[2],
                            const double q[2])
{
    dg_node below, above;
    int certain;
    cv_status status = dg_probe_value(&below, &certain, p, alpha[0], q[0]);
    if (status == CV_OK)
        status = dg_probe_value(&above, &certain, p, alpha[1], q[1]);
    if (status == CV_OK) {
        *re = above.re - below.re;
        *im = above.im - below.im;
    }
    return status;
}

/* Two velocities around that of the station and the frequencies there that keep their distance from the
 * nearest branch point; where there is none on both sides, at the same frequency and closer. */
static double neighbours(double alpha[2], double frequency[2], const dg_probe *p, const dg_station *at,
                         double q)
{
    const double special = dg_special_distance(p->branches, at->alpha);
    const double part =
        fmin(fmax(ALPHA_STEP, Q_NOISE / (ALPHA_STEP * dg_station_scale(at, q))), LONGEST_ALPHA_STEP);
    const double step = fmax(part * special, 1e-14 * at->alpha);
    const dg_branch_point *nearest = dg_station_nearest(at, q);
    dg_branch_point low, high;
    alpha[0] = at->alpha - step;
    alpha[1] = at->alpha + step;
    if (nearest != NULL && dg_branch_point_on(&low, p->branches, nearest->curve, alpha[0]) &&
        dg_branch_point_on(&high, p->branches, nearest->curve, alpha[1])) {
        frequency[0] = low.q + (q - nearest->q);
        frequency[1] = high.q + (q - nearest->q);
        if (frequency[0] > 0 && frequency[1] > 0)
            return nearest->signed_q < 0 ? -nearest->p : nearest->p;
    }
    const double near = fmin(step, Q_STEP * dg_station_scale(at, q));
    alpha[0] = at->alpha - near;
    alpha[1] = at->alpha + near;
    frequency[0] = frequency[1] = q;
    return 0;
}

cv_status dg_probe_slopes(dg_slopes *s, const dg_probe *p, const dg_station *at, double q)
{
    const double h = Q_STEP * dg_station_scale(at, q), here[2] = {at->alpha, at->alpha},
                 beside[2] = {q - h, q + h};
    double alpha[2], frequency[2];
    s->drift = neighbours(alpha, frequency, p, at, q);
    cv_status status = difference(&s->re_q, &s->im_q, p, here, beside);
    if (status == CV_OK)
        status = difference(&s->re_alpha, &s->im_alpha, p, alpha, frequency);
    if (status != CV_OK)
        return status;
    s->re_q /= beside[1] - beside[0];
    s->im_q /= beside[1] - beside[0];
    s->re_alpha /= alpha[1] - alpha[0];
    s->im_alpha /= alpha[1] - alpha[0];
    const double moving = -s->im_alpha / s->im_q;
    s->dq = s->drift + moving;
    s->dx = s->re_alpha + s->re_q * moving;
    return CV_OK;
}
