/* Double-double arithmetic: numbers hi + lo, |lo| at most half a unit in the last place of hi, some 106 bits.
 *
 * Each operation is within DG_DD_UNIT of its exact result, relative (sums 3 u^2, products 7 u^2, quotients 10
 * u^2, u = 2^-53: Joldes, Muller and Popescu, ACM Trans. Math. Softw. 44 (2017) 15), while no intermediate
 * result underflows or overflows. Needs doubles rounded to nearest, without excess precision or contraction.
 */
#ifndef CRITVEL_DGREEN_DD_H
#define CRITVEL_DGREEN_DD_H

#include <math.h>

#define DG_DD_BITS 102
#define DG_DD_UNIT 0x1p-102

typedef struct {
    double hi, lo;
} dg_dd;

typedef struct {
    dg_dd re, im;
} dg_dd_complex;

/* a + b exactly, |a| >= |b| */
static inline dg_dd dg_dd_ordered(double a, double b)
{
    const double sum = a + b;
    return (dg_dd){sum, b - (sum - a)};
}

/* a + b exactly */
static inline dg_dd dg_dd_two(double a, double b)
{
    const double sum = a + b, back = sum - a;
    return (dg_dd){sum, (a - (sum - back)) + (b - back)};
}

static inline dg_dd dg_dd_add(dg_dd a, dg_dd b)
{
    const dg_dd low = dg_dd_two(a.lo, b.lo);
    dg_dd sum = dg_dd_two(a.hi, b.hi);
    sum = dg_dd_ordered(sum.hi, sum.lo + low.hi);
    return dg_dd_ordered(sum.hi, sum.lo + low.lo);
}

static inline dg_dd dg_dd_negative(dg_dd a)
{
    return (dg_dd){-a.hi, -a.lo};
}

static inline dg_dd dg_dd_mul(dg_dd a, dg_dd b)
{
    const double product = a.hi * b.hi;
    const double rest = fma(a.hi, b.hi, -product);
    return dg_dd_ordered(product, rest + (a.hi * b.lo + a.lo * b.hi));
}

static inline dg_dd dg_dd_scale(dg_dd a, double b)
{
    return dg_dd_mul(a, (dg_dd){b, 0});
}

static inline dg_dd dg_dd_div(dg_dd a, dg_dd b)
{
    const double first = a.hi / b.hi;
    const dg_dd rest = dg_dd_add(a, dg_dd_scale(b, -first));
    const double second = rest.hi / b.hi;
    const double third = dg_dd_add(rest, dg_dd_scale(b, -second)).hi / b.hi;
    return dg_dd_add(dg_dd_ordered(first, second), (dg_dd){third, 0});
}

static inline dg_dd_complex dg_dd_complex_add(dg_dd_complex a, dg_dd_complex b)
{
    return (dg_dd_complex){dg_dd_add(a.re, b.re), dg_dd_add(a.im, b.im)};
}

static inline dg_dd_complex dg_dd_complex_mul(dg_dd_complex a, dg_dd_complex b)
{
    return (dg_dd_complex){dg_dd_add(dg_dd_mul(a.re, b.re), dg_dd_negative(dg_dd_mul(a.im, b.im))),
                           dg_dd_add(dg_dd_mul(a.re, b.im), dg_dd_mul(a.im, b.re))};
}

static inline dg_dd_complex dg_dd_complex_scale(dg_dd_complex a, dg_dd b)
{
    return (dg_dd_complex){dg_dd_mul(a.re, b), dg_dd_mul(a.im, b)};
}

static inline dg_dd_complex dg_dd_complex_div(dg_dd_complex a, dg_dd_complex b)
{
    const dg_dd norm = dg_dd_add(dg_dd_mul(b.re, b.re), dg_dd_mul(b.im, b.im));
    const dg_dd_complex top = dg_dd_complex_mul(a, (dg_dd_complex){b.re, dg_dd_negative(b.im)});
    return (dg_dd_complex){dg_dd_div(top.re, norm), dg_dd_div(top.im, norm)};
}

/* |a| to double precision */
static inline double dg_dd_modulus(dg_dd_complex a)
{
    return sqrt(a.re.hi * a.re.hi + a.im.hi * a.im.hi);
}

#endif
