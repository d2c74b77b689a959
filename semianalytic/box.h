/* Rectangles in the complex plane with MPC midpoints, the counterpart of rect.h at any precision. Midpoint
 * operations are correctly rounded in each part (MPC), so each adds half a unit in the last place of its own
 * result. Radii are long doubles: their exponent range covers more than 16000 bits; where a magnitude enters
 * a radius it is bounded by the next power of two. Radii are rounded to nearest like those of rect.h and
 * SA_BOX_INFLATE makes up for it where a radius is used (fewer than 2^20 operations in a chain).
 *
 * Outputs may be the same object as inputs. All objects of one computation have the same precision, at most
 * SA_BOX_PRECISION_MAX. */
#ifndef CRITVEL_SEMIANALYTIC_BOX_H
#define CRITVEL_SEMIANALYTIC_BOX_H

#include <mpc.h>
#include <mpfr.h>

#include "common/number.h"

#define SA_BOX_INFLATE (1 + 0x1p-40L)
enum { SA_BOX_PRECISION_MAX = 12000 };

/* the reals within r of m */
typedef struct {
    mpfr_t m;
    long double r;
} sa_span;

/* |Re z - Re m| <= re_rad and |Im z - Im m| <= im_rad */
typedef struct {
    mpc_t m;
    long double re_rad, im_rad;
} sa_box;

/* Smallest power of two above |x|; 0 for 0. */
long double sa_magnitude(const mpfr_t x);

void sa_span_init(sa_span *x, mpfr_prec_t precision);
void sa_span_clear(sa_span *x);
void sa_span_set_number(sa_span *to, const cv_number *x); /* exact where the precision allows it */
void sa_span_set(sa_span *to, const mpfr_t x);            /* likewise */

void sa_box_init(sa_box *x, mpfr_prec_t precision);
void sa_box_clear(sa_box *x);
void sa_box_set(sa_box *to, const sa_box *x);
void sa_box_set_real(sa_box *to, const sa_span *x);
void sa_box_zero(sa_box *to);

void sa_box_add(sa_box *to, const sa_box *a, const sa_box *b);
void sa_box_sub(sa_box *to, const sa_box *a, const sa_box *b);
void sa_box_add_real(sa_box *to, const sa_box *a, const sa_span *b);
void sa_box_mul(sa_box *to, const sa_box *a, const sa_box *b);
void sa_box_sqr(sa_box *to, const sa_box *a);
void sa_box_scale(sa_box *to, const sa_box *a, const sa_span *b);
void sa_box_shift(sa_box *to, const sa_box *a, int power); /* times 2^power, exact */
void sa_box_neg(sa_box *to, const sa_box *a);
void sa_box_times_i(sa_box *to, const sa_box *a);
void sa_box_exp(sa_box *to, const sa_box *a);

/* a / b; 0 and "to" undefined where b may be zero, else 1 */
int sa_box_div(sa_box *to, const sa_box *a, const sa_box *b);

/* sum of the radii relative to a lower bound of the midpoint's magnitude; infinite for a zero midpoint that
 * is not exact, 0 for an exact box */
long double sa_box_spread(const sa_box *a);

/* 1 when the boxes have no point in common */
int sa_box_disjoint(const sa_box *a, const sa_box *b);

#endif
