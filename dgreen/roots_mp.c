#include "dgreen/roots_mp.h"

#include <complex.h>
#include <math.h>

#include "dgreen/bounds.h"

static const mpfr_rnd_t RND = MPFR_RNDN;
static const mpc_rnd_t CRND = MPC_RNDNN;

void dg_mp_roots_init(dg_mp_roots *roots, mpfr_prec_t precision)
{
    roots->precision = precision;
    roots->unit = ldexp(1, -(int)precision);
    for (int i = 0; i < DG_DEGREE; i++) {
        mpc_init2(roots->y[i], precision);
        mpc_init2(roots->slope[i], precision);
    }
    mpc_init2(roots->value, precision);
    mpc_init2(roots->derivative, precision);
    mpc_init2(roots->step, precision);
    for (int i = 0; i < 4; i++)
        mpfr_init2(roots->t[i], precision);
    mpfr_init2(roots->difference, 53);
}

void dg_mp_roots_clear(dg_mp_roots *roots)
{
    for (int i = 0; i < DG_DEGREE; i++) {
        mpc_clear(roots->y[i]);
        mpc_clear(roots->slope[i]);
    }
    mpc_clear(roots->value);
    mpc_clear(roots->derivative);
    mpc_clear(roots->step);
    for (int i = 0; i < 4; i++)
        mpfr_clear(roots->t[i]);
    mpfr_clear(roots->difference);
}

double dg_mp_units(mpc_srcptr x, mpfr_prec_t precision)
{
    long re_exponent, im_exponent;
    const double re = mpfr_get_d_2exp(&re_exponent, mpc_realref(x), RND);
    const double im = mpfr_get_d_2exp(&im_exponent, mpc_imagref(x), RND);
    return hypot(ldexp(re, (int)(re_exponent + precision)), ldexp(im, (int)(im_exponent + precision)));
}

double dg_mp_modulus(mpc_srcptr x)
{
    return dg_mp_units(x, 0);
}

void dg_mp_horner(mpc_ptr value, mpc_srcptr y, mpc_srcptr c, mpfr_t t[4])
{
    mpfr_ptr re = mpc_realref(value), im = mpc_imagref(value);
    mpfr_mul(t[0], re, mpc_realref(y), RND);
    mpfr_mul(t[1], im, mpc_imagref(y), RND);
    mpfr_mul(t[2], re, mpc_imagref(y), RND);
    mpfr_mul(t[3], im, mpc_realref(y), RND);
    mpfr_sub(re, t[0], t[1], RND);
    mpfr_add(im, t[2], t[3], RND);
    mpfr_add(re, re, mpc_realref(c), RND);
    mpfr_add(im, im, mpc_imagref(c), RND);
}

/* Value and derivative of Delta(i y), or of the reversed polynomial, into roots->value and roots->derivative.
 */
static void evaluate(dg_mp_roots *roots, const dg_mp_operator *op, mpc_srcptr y, int reversed)
{
    const int n = roots->count;
    mpc_set(roots->value, op->delta.c[reversed ? 0 : n], CRND);
    mpc_set(roots->derivative, roots->value, CRND);
    for (int k = n - 1; k >= 0; k--) {
        if (k < n - 1)
            dg_mp_horner(roots->derivative, y, roots->value, roots->t);
        dg_mp_horner(roots->value, y, op->delta.c[reversed ? n - k : k], roots->t);
    }
}

/* a - b in double; exact to a rounding even for close numbers */
static double complex difference(dg_mp_roots *roots, mpc_srcptr a, mpc_srcptr b)
{
    mpfr_sub(roots->difference, mpc_realref(a), mpc_realref(b), RND);
    const double re = mpfr_get_d(roots->difference, RND);
    mpfr_sub(roots->difference, mpc_imagref(a), mpc_imagref(b), RND);
    return CMPLX(re, mpfr_get_d(roots->difference, RND));
}

static double complex rounded(mpc_srcptr y)
{
    return CMPLX(mpfr_get_d(mpc_realref(y), RND), mpfr_get_d(mpc_imagref(y), RND));
}

/* sum over k != i of 1/(y_i - y_k) in double, the far root included: enough, for it multiplies f/f'. */
static double complex repulsion(dg_mp_roots *roots, int i, double *nearest)
{
    const int near = roots->count - roots->far;
    double complex sum = 0;
    *nearest = 0;
    for (int k = 0; k < near; k++) {
        if (k == i)
            continue;
        const double complex d = difference(roots, roots->y[i], roots->y[k]);
        const double inverse = 1 / cabs(d);
        if (!isfinite(inverse))
            continue; /* coinciding starts: the others separate them */
        sum += conj(d) * (inverse * inverse);
        *nearest = fmax(*nearest, inverse);
    }
    if (roots->far) {
        const double complex u = rounded(roots->y[near]);
        sum += u / (u * rounded(roots->y[i]) - 1);
    }
    return sum;
}

/* One update N/(1 - N A), N = f/f'; returns |step| / distance to the nearest root. */
static double update(dg_mp_roots *roots, const dg_mp_operator *op, int i)
{
    double nearest;
    const double complex a = repulsion(roots, i, &nearest);
    evaluate(roots, op, roots->y[i], 0);
    mpc_set_d_d(roots->step, creal(a), cimag(a), CRND);
    mpc_mul(roots->step, roots->step, roots->value, CRND);
    mpc_sub(roots->derivative, roots->derivative, roots->step, CRND);
    mpc_div(roots->step, roots->value, roots->derivative, CRND);
    mpc_sub(roots->y[i], roots->y[i], roots->step, CRND);
    return dg_mp_modulus(roots->step) * nearest;
}

static double update_far(dg_mp_roots *roots, const dg_mp_operator *op)
{
    const int last = roots->count - 1;
    evaluate(roots, op, roots->y[last], 1);
    mpc_div(roots->step, roots->value, roots->derivative, CRND);
    mpc_sub(roots->y[last], roots->y[last], roots->step, CRND);
    return dg_mp_modulus(roots->step) * dg_mp_modulus(op->delta.c[6]) / dg_mp_modulus(op->delta.c[7]);
}

/* The iteration is of third order, of second order with factor 2^-53 where the double A is felt; Newton for
 * the far root is of second order. */
static void iterate(dg_mp_roots *roots, const dg_mp_operator *op)
{
    const int p = (int)roots->precision, near = roots->count - roots->far;
    const double small = ldexp(1, -1 - (int)fmax(p / 3 + 1, (p - 48) / 2)), far_small = ldexp(1, -p / 2 - 2);
    int moving = roots->count, settled[DG_DEGREE] = {0};
    for (int sweep = 0; sweep < 40 + p / 2 && moving > 0; sweep++)
        for (int i = 0; i < roots->count; i++) {
            if (settled[i])
                continue;
            settled[i] = i < near ? update(roots, op, i) < small : update_far(roots, op) < far_small;
            moving -= settled[i];
        }
}

/* Imaginary parts below the square root of a unit, relative to the distance of the other roots, are rounding,
 * or else the discs will meet or contradict. */
static void put_on_axis(dg_mp_roots *roots)
{
    for (int i = 0; i < roots->count; i++) {
        const int far = roots->far && i == roots->count - 1;
        double nearest = 0;
        if (!far)
            repulsion(roots, i, &nearest);
        const double off = fabs(mpfr_get_d(mpc_imagref(roots->y[i]), RND));
        if (far || off * nearest < ldexp(1, -(int)(roots->precision / 2)))
            mpfr_set_zero(mpc_imagref(roots->y[i]), 1);
    }
}

static void sample(dg_mp_roots *roots, dg_separation *s, const dg_mp_operator *op, int i, int far)
{
    evaluate(roots, op, roots->y[i], far);
    mpc_set(roots->slope[i], roots->derivative, CRND);
    const double modulus = dg_mp_modulus(roots->y[i]), *sizes = op->rounded.size;
    double size = 0, slope_size = 0;
    for (int k = roots->count; k >= 0; k--) {
        slope_size = slope_size * modulus + size;
        size = size * modulus + sizes[far ? roots->count - k : k];
    }
    s->modulus[i] = modulus;
    s->value[i] = dg_mp_units(roots->value, roots->precision) + DG_VALUE_UNITS * size;
    s->slope[i] = dg_mp_modulus(roots->derivative);
    s->slope_error[i] = DG_SLOPE_UNITS * slope_size;
}

static cv_status enclose(dg_mp_roots *roots, const dg_mp_operator *op)
{
    dg_separation s;
    dg_separation_open(&s, roots->count, roots->far, roots->unit);
    const int near = s.count - s.far;
    for (int i = 0; i < s.count; i++) {
        sample(roots, &s, op, i, i >= near);
        for (int k = 0; k < i && i < near; k++)
            dg_separation_set_distance(&s, i, k, cabs(difference(roots, roots->y[i], roots->y[k])));
    }
    return dg_separate(roots->radius, roots->slope_relative, roots->crowding, &s);
}

/* Starting values; those that double could not tell apart are moved apart, for the iteration cannot. Off the
 * axis, too: of real coefficients and real starts it makes nothing but real numbers, never a pair. */
static void set_start(dg_mp_roots *roots, const dg_roots *start)
{
    const int near = start->count - start->far;
    double scale = 0;
    for (int i = 0; i < near; i++)
        scale = fmax(scale, hypot(start->re[i], start->im[i]));
    if (!(scale > 0))
        scale = 1;
    for (int i = 0; i < start->count; i++) {
        double shift = 0;
        for (int k = 0; k < i && i < near; k++)
            if (hypot(start->re[i] - start->re[k], start->im[i] - start->im[k]) < 1e-6 * scale)
                shift += 1e-9 * scale;
        mpc_set_d_d(roots->y[i], start->re[i] + 0.6 * shift, start->im[i] + 0.8 * shift, CRND);
    }
}

cv_status dg_mp_roots_find(dg_mp_roots *roots, const dg_mp_operator *op, const dg_roots *start, int on_axis)
{
    if (start->count != op->rounded.degree)
        return CV_FAILED;
    roots->count = start->count;
    roots->far = start->far;
    set_start(roots, start);
    iterate(roots, op);
    if (on_axis)
        put_on_axis(roots);
    return enclose(roots, op);
}
