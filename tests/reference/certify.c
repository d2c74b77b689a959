#include "certify.h"

#include <math.h>

enum { PRECISION = 512, NEWTON_STEPS = 40, RADII = 14 };

/* The Newton step of (Re zeta - target, Im zeta): (f1, f2) by Cramer's rule from values z at the point and
 * derivatives d (possibly over a box). Returns -1 when the determinant may vanish. */
static int newton_step(arb_t step_alpha, arb_t step_q, const ref_zeta *z, const ref_zeta *d,
                       const arb_t target, slong prec)
{
    arb_t det, t, f;
    arb_init(det);
    arb_init(t);
    arb_init(f);
    arb_sub(f, acb_realref(z->zeta), target, prec);
    arb_mul(det, acb_realref(d->d_alpha), acb_imagref(d->d_q), prec);
    arb_mul(t, acb_realref(d->d_q), acb_imagref(d->d_alpha), prec);
    arb_sub(det, det, t, prec);
    arb_mul(step_alpha, f, acb_imagref(d->d_q), prec);
    arb_mul(t, acb_imagref(z->zeta), acb_realref(d->d_q), prec);
    arb_sub(step_alpha, step_alpha, t, prec);
    arb_mul(step_q, acb_imagref(z->zeta), acb_realref(d->d_alpha), prec);
    arb_mul(t, f, acb_imagref(d->d_alpha), prec);
    arb_sub(step_q, step_q, t, prec);
    arb_div(step_alpha, step_alpha, det, prec);
    arb_div(step_q, step_q, det, prec);
    int status = arb_contains_zero(det) ? -1 : 0;
    arb_clear(det);
    arb_clear(t);
    arb_clear(f);
    return status;
}

void ref_transition_init(ref_transition *x)
{
    arb_init(x->alpha);
    arb_init(x->q);
    x->unique_radius = 0;
    x->jump = 0;
}

void ref_transition_clear(ref_transition *x)
{
    arb_clear(x->alpha);
    arb_clear(x->q);
}

static double to_double(const arb_t x)
{
    return arf_get_d(arb_midref(x), ARF_RND_NEAR);
}

/* Plain Newton on midpoints until the steps are far below 1e-60. */
static int newton(ref_transition *x, const ref_track *t, const arb_t target, double alpha0, double reach)
{
    ref_zeta z;
    arb_t da, dq;
    int status = -1;
    ref_zeta_init(&z);
    arb_init(da);
    arb_init(dq);
    slong prec = 128;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        if (ref_zeta_ball(&z, t, x->alpha, x->q, 0, prec) != 0 ||
            newton_step(da, dq, &z, &z, target, prec) != 0)
            break;
        arb_sub(x->alpha, x->alpha, da, prec);
        arb_sub(x->q, x->q, dq, prec);
        mag_zero(arb_radref(x->alpha));
        mag_zero(arb_radref(x->q));
        if (!(fabs(to_double(x->alpha) - alpha0) <= reach) || !arb_is_positive(x->q))
            break;
        double moved = fabs(to_double(da)) / to_double(x->alpha) + fabs(to_double(dq)) / to_double(x->q);
        if (moved < 1e-80) {
            status = 0;
            break;
        }
        prec = moved < 1e-10 ? PRECISION : 128;
    }
    ref_zeta_clear(&z);
    arb_clear(da);
    arb_clear(dq);
    return status;
}

/* The interval Newton test on the box of half-width r around x. On success x becomes the (tiny) enclosure
 * when shrink is set. */
static int prove(ref_transition *x, const ref_track *t, const arb_t target, double r, int shrink)
{
    ref_zeta mid, box;
    arb_t a, q, da, dq;
    mag_t radius;
    ref_zeta_init(&mid);
    ref_zeta_init(&box);
    arb_init(a);
    arb_init(q);
    arb_init(da);
    arb_init(dq);
    mag_init(radius);
    mag_set_d(radius, r);
    arb_set(a, x->alpha);
    arb_set(q, x->q);
    arb_add_error_mag(a, radius);
    arb_add_error_mag(q, radius);
    int status = ref_zeta_ball(&mid, t, x->alpha, x->q, 0, PRECISION);
    if (status == 0)
        status = ref_zeta_ball(&box, t, a, q, 0, PRECISION);
    if (status == 0)
        status = newton_step(da, dq, &mid, &box, target, PRECISION);
    if (status == 0) {
        arb_sub(da, x->alpha, da, PRECISION);
        arb_sub(dq, x->q, dq, PRECISION);
        status = arb_contains_interior(a, da) && arb_contains_interior(q, dq) ? 0 : -1;
    }
    if (status == 0 && shrink) {
        arb_set(x->alpha, da);
        arb_set(x->q, dq);
        /* a root of 1 = eta_M zeta crosses the axis with Re(d qbar/d alpha) = Im(zeta_alpha / zeta_q) */
        acb_div(box.zeta, box.d_alpha, box.d_q, PRECISION);
        x->jump = arb_is_positive(acb_imagref(box.zeta))   ? 2
                  : arb_is_negative(acb_imagref(box.zeta)) ? -2
                                                           : 0;
        status = x->jump == 0 ? -1 : 0;
    }
    ref_zeta_clear(&mid);
    ref_zeta_clear(&box);
    arb_clear(a);
    arb_clear(q);
    arb_clear(da);
    arb_clear(dq);
    mag_clear(radius);
    return status;
}

int ref_certify(ref_transition *out, const ref_track *t, const fmpq_t eta_M, double alpha0, double q0,
                double reach)
{
    arb_t target;
    arb_init(target);
    arb_set_fmpq(target, eta_M, PRECISION);
    arb_inv(target, target, PRECISION);
    arb_set_d(out->alpha, alpha0);
    arb_set_d(out->q, q0);
    int status = newton(out, t, target, alpha0, reach);
    out->unique_radius = 0;
    double r = 1e-7;
    for (int i = 0; status == 0 && i < RADII && out->unique_radius == 0; i++, r *= 1e-3)
        if (prove(out, t, target, r, 0) == 0)
            out->unique_radius = r;
    if (status == 0)
        status = out->unique_radius > 0 ? prove(out, t, target, 1e-60, 1) : -1;
    arb_clear(target);
    return status;
}
