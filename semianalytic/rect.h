/* Rectangles in the complex plane with double midpoints: every operation encloses the exact result for all
 * points of its operands, real and imaginary parts separately, so that a part of 1e-20 beside a part of 1
 * keeps its own relative accuracy.
 *
 * The rounding error of a midpoint operation is at most SA_U times the magnitude of its rounded result and is
 * added to the radius. Radii are sums of products of non-negative doubles and are rounded to nearest
 * themselves: a radius reached through n operations is short by less than (1 - SA_U)^n. SA_INFLATE, applied
 * where a radius is used for a decision or handed out, covers n = 4500; the longest chain here has a few
 * hundred. Underflow is not covered: callers keep magnitudes between 1e-60 and 1e60 (sa_track.double_range).
 */
#ifndef CRITVEL_SEMIANALYTIC_RECT_H
#define CRITVEL_SEMIANALYTIC_RECT_H

#include <complex.h>
#include <math.h>

#define SA_U 0x1p-53
#define SA_INFLATE (1 + 0x1p-40)

/* the reals within r of m */
typedef struct {
    double m, r;
} sa_real;

/* |Re z - re| <= re_rad and |Im z - im| <= im_rad */
typedef struct {
    double re, im, re_rad, im_rad;
} sa_rect;

static inline sa_real sa_real_add(sa_real a, sa_real b)
{
    double m = a.m + b.m;
    return (sa_real){m, a.r + b.r + SA_U * fabs(m)};
}

static inline sa_real sa_real_mul(sa_real a, sa_real b)
{
    double m = a.m * b.m;
    return (sa_real){m, fabs(a.m) * b.r + a.r * (fabs(b.m) + b.r) + SA_U * fabs(m)};
}

static inline sa_rect sa_rect_exact(double complex z)
{
    return (sa_rect){creal(z), cimag(z), 0, 0};
}

static inline double complex sa_rect_mid(sa_rect a)
{
    return CMPLX(a.re, a.im);
}

static inline sa_rect sa_rect_add(sa_rect a, sa_rect b)
{
    double re = a.re + b.re, im = a.im + b.im;
    return (sa_rect){re, im, a.re_rad + b.re_rad + SA_U * fabs(re), a.im_rad + b.im_rad + SA_U * fabs(im)};
}

static inline sa_rect sa_rect_add_real(sa_rect a, sa_real b)
{
    double re = a.re + b.m;
    return (sa_rect){re, a.im, a.re_rad + b.r + SA_U * fabs(re), a.im_rad};
}

/* by a power of two, or by -1: exact */
static inline sa_rect sa_rect_shift(sa_rect a, double power)
{
    double size = fabs(power);
    return (sa_rect){a.re * power, a.im * power, a.re_rad * size, a.im_rad * size};
}

static inline sa_rect sa_rect_scale(sa_rect a, sa_real b)
{
    double re = a.re * b.m, im = a.im * b.m, size = fabs(b.m) + b.r;
    return (sa_rect){re, im, a.re_rad * size + fabs(a.re) * b.r + SA_U * fabs(re),
                     a.im_rad * size + fabs(a.im) * b.r + SA_U * fabs(im)};
}

static inline sa_rect sa_rect_times_i(sa_rect a)
{
    return (sa_rect){-a.im, a.re, a.im_rad, a.re_rad};
}

static inline sa_rect sa_rect_conj(sa_rect a)
{
    return (sa_rect){a.re, -a.im, a.re_rad, a.im_rad};
}

static inline sa_rect sa_rect_mul(sa_rect a, sa_rect b)
{
    double rr = a.re * b.re, ii = a.im * b.im, ri = a.re * b.im, ir = a.im * b.re;
    double re = rr - ii, im = ri + ir;
    double b_re = fabs(b.re) + b.re_rad, b_im = fabs(b.im) + b.im_rad;
    double a_re = fabs(a.re), a_im = fabs(a.im);
    return (sa_rect){re, im,
                     a_re * b.re_rad + a.re_rad * b_re + a_im * b.im_rad + a.im_rad * b_im +
                         SA_U * (fabs(rr) + fabs(ii) + fabs(re)),
                     a_re * b.im_rad + a.re_rad * b_im + a_im * b.re_rad + a.im_rad * b_re +
                         SA_U * (fabs(ri) + fabs(ir) + fabs(im))};
}

static inline sa_rect sa_rect_sqr(sa_rect a)
{
    double rr = a.re * a.re, ii = a.im * a.im, re = rr - ii, im = 2 * a.re * a.im;
    double a_re = fabs(a.re), a_im = fabs(a.im);
    return (sa_rect){re, im,
                     a.re_rad * (2 * a_re + a.re_rad) + a.im_rad * (2 * a_im + a.im_rad) +
                         SA_U * (rr + ii + fabs(re)),
                     2 * (a_re * a.im_rad + a.re_rad * (a_im + a.im_rad)) + SA_U * fabs(im)};
}

/* a / b. Where b may be zero the radii are infinite. */
static inline sa_rect sa_rect_div(sa_rect a, sa_rect b)
{
    sa_rect top = sa_rect_mul(a, sa_rect_conj(b));
    double rr = b.re * b.re, ii = b.im * b.im, size = rr + ii;
    double size_rad = b.re_rad * (2 * fabs(b.re) + b.re_rad) + b.im_rad * (2 * fabs(b.im) + b.im_rad) +
                      SA_U * (rr + ii + size);
    double least = size - size_rad * SA_INFLATE;
    if (!(least > 0))
        return (sa_rect){0, 0, INFINITY, INFINITY};
    least *= 1 - 4 * SA_U;
    double re = top.re / size, im = top.im / size;
    return (sa_rect){re, im, (top.re_rad + fabs(re) * size_rad) / least + 2 * SA_U * fabs(re),
                     (top.im_rad + fabs(im) * size_rad) / least + 2 * SA_U * fabs(im)};
}

/* 1 when the rectangles have no point in common */
static inline int sa_rect_disjoint(sa_rect a, sa_rect b)
{
    return fabs(a.re - b.re) * (1 - 4 * SA_U) > (a.re_rad + b.re_rad) * SA_INFLATE ||
           fabs(a.im - b.im) * (1 - 4 * SA_U) > (a.im_rad + b.im_rad) * SA_INFLATE;
}

/* sum of the radii relative to the magnitude of the midpoint */
static inline double sa_rect_spread(sa_rect a)
{
    return (a.re_rad + a.im_rad) / (fabs(a.re) + fabs(a.im));
}

#endif
