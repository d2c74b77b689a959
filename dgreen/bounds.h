/* Inclusion discs and error bounds, the same for every precision. Errors and radii are in units u =
 * 2^-precision, so that thousands of bits do not underflow a double; only products of two of them need u
 * itself, and there a u that underflows to 0 is smaller than the slack of the formulas.
 *
 * Method. f of degree at most n has a root within n |f(y)/f'(y)| of y. When all n discs are disjoint each
 * holds exactly one root. (The far root, kept as u = 1/y, has its disc around infinity.) Then f'/f = 1/(y -
 * y*) + E with |E| <= sum of 1/(distance to the other discs), so |y - y*| <= N/(1 - N sum), N = |f/f'|, and
 * f'(y*)/f'(y), a product of differences, differs from 1 by at most 2.5 |y - y*| sum while |y - y*| sum <=
 * 0.05. */
#ifndef CRITVEL_DGREEN_BOUNDS_H
#define CRITVEL_DGREEN_BOUNDS_H

#include <float.h>

#include "common/status.h"
#include "dgreen/operator.h"

typedef struct {
    int count, far;
    double unit;                   /* u */
    double value[DG_DEGREE];       /* |f| with its rounding error, units */
    double slope[DG_DEGREE];       /* |f'| as computed */
    double slope_error[DG_DEGREE]; /* rounding error of f', units */
    double modulus[DG_DEGREE];     /* of the approximations; of u for the far root */
    /* [k][i]: between near approximations i and i + k (modulo DG_DEGREE), k > 0; infinite where one of them
     * is not there */
    double distance[DG_DEGREE][DG_DEGREE];
} dg_separation;

/* No root is there yet: all distances infinite. */
void dg_separation_open(dg_separation *s, int count, int far, double unit);
void dg_separation_set_distance(dg_separation *s, int i, int k, double distance);

/* crowding[i]: the sum above for root i. radius[i] (units): the disc around approximation i holds exactly one
 * root of f; in the u plane for the far root. slope_relative[i] (units): relative error of the computed f' as
 * value of f' at the exact root. CV_UNDECIDED when discs meet, or when f' is lost in rounding (relative error
 * above 0.1). The arrays have DG_DEGREE elements; those from s->count on are lost. */
cv_status dg_separate(double *radius, double *slope_relative, double *crowding, const dg_separation *s);

/* Rounding, in units times the size polynomial at |y|. Parameters, alpha and qbar are within 2 units of the
 * exact ones; then the entries of (17) are within 19 units of their sizes, a product of two of them within
 * 42, their sums and R within 46, Delta within 72. Horner's rule adds, where a complex product costs sqrt(5)
 * and a sum 1, 26 for eight steps, 13 for four; its derivative carries the value's rounding along: twice
 * that. */
#define DG_VALUE_UNITS 104.0
#define DG_SLOPE_UNITS 130.0
#define DG_R_UNITS 64.0

/* Bound (units) of |R(y) as computed - R(y*)|, |y - y*| <= radius (units). size: size polynomial of R at
 * reach = |y| + |y - y*|; slope: |R'(y)|. The second derivative is at most 12 size/reach^2, the rounding of
 * the slope at most 8 DG_R_UNITS size/reach. */
static inline double dg_numerator_error(double size, double slope, double reach, double radius, double unit)
{
    const double inverse = 1 / (reach + DBL_MIN); /* at reach = 0, with a unit that underflows, all is 0 */
    const double relative = radius * unit * inverse, second = 6 * size * (relative * radius) * inverse;
    return DG_R_UNITS * size * (1 + 8 * relative) + radius * slope + second;
}

/* The size polynomial of R at distance reach from 0, and a bound of |R'| at x + i y, both in double; of u^4
 * R(i/u) when far. */
typedef struct {
    double size, slope;
} dg_r_size;
dg_r_size dg_r_size_at(const dg_operator *op, int far, double x, double y, double reach);

/* Bound (units) of the error of top/bottom: |top| with error top_error (units), |bottom| with the relative
 * error given (units, times u below 1/2). */
static inline double dg_quotient_error(double top, double top_error, double bottom, double relative,
                                       double unit)
{
    const double modulus = top / bottom;
    return (top_error / bottom + modulus * relative) / (1 - relative * unit) + 16 * modulus;
}

#endif
