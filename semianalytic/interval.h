/* Real intervals with MPFR ends, rounded outwards, and polynomials with such coefficients. Every operation
 * encloses the exact result for all points of its operands. Outputs may be the same object as inputs. */
#ifndef CRITVEL_SEMIANALYTIC_INTERVAL_H
#define CRITVEL_SEMIANALYTIC_INTERVAL_H

#include <stddef.h>

#include "common/number.h"

typedef struct {
    mpfr_t low, high;
} sa_interval;

void sa_interval_init(sa_interval *x, mpfr_prec_t precision); /* sets 0 */
void sa_interval_clear(sa_interval *x);
void sa_interval_set(sa_interval *to, const sa_interval *x);
void sa_interval_set_si(sa_interval *to, long x);
void sa_interval_set_mpfr(sa_interval *to, const mpfr_t x);
void sa_interval_set_number(sa_interval *to, const cv_number *x);

void sa_interval_add(sa_interval *to, const sa_interval *a, const sa_interval *b);
void sa_interval_sub(sa_interval *to, const sa_interval *a, const sa_interval *b);
void sa_interval_mul(sa_interval *to, const sa_interval *a, const sa_interval *b);
void sa_interval_mul_si(sa_interval *to, const sa_interval *a, long b);
void sa_interval_shift(sa_interval *to, const sa_interval *a, long power); /* times 2^power */

/* -1, 0, 1: all points negative, the one point 0, all positive; 2: cannot be told */
int sa_interval_sign(const sa_interval *x);

/* coefficient[i] belongs to x^i; degree >= 0 */
enum { SA_POLYNOMIAL_DEGREE = 16 };
typedef struct {
    int degree;
    sa_interval coefficient[SA_POLYNOMIAL_DEGREE + 1];
} sa_polynomial;

void sa_polynomial_init(sa_polynomial *p, mpfr_prec_t precision); /* the polynomial 0 of degree 0 */
void sa_polynomial_clear(sa_polynomial *p);
void sa_polynomial_set(sa_polynomial *to, const sa_polynomial *p);
/* The degree of the result is the formal one; at most SA_POLYNOMIAL_DEGREE, the caller's business. */
void sa_polynomial_add(sa_polynomial *to, const sa_polynomial *a, const sa_polynomial *b);
void sa_polynomial_sub(sa_polynomial *to, const sa_polynomial *a, const sa_polynomial *b);
void sa_polynomial_mul(sa_polynomial *to, const sa_polynomial *a, const sa_polynomial *b);
/* Drops leading coefficients that are exactly zero. */
void sa_polynomial_trim(sa_polynomial *p);
/* value of p over x */
void sa_polynomial_at(sa_interval *value, const sa_polynomial *p, const sa_interval *x);

/* Number of sign changes of the coefficients (Descartes): between *least and *most, as far as their signs can
 * be told. */
void sa_polynomial_variations(int *least, int *most, const sa_polynomial *p);

/* to(t) = (1 + t)^degree p((high + low t) / (1 + t)), low >= 0: the positive roots t are the roots of p in
 * (low, high), in reverse order. */
void sa_polynomial_restrict(sa_polynomial *to, const sa_polynomial *p, const mpfr_t low, const mpfr_t high);

/* Certain roots and undecided places, ascending; array ends follow each other or touch. */
typedef struct {
    mpfr_t low, high;
    int least, most; /* bounds on the sign changes inside: 1, 1 is exactly one simple root; anything else
                      * means that the precision could not tell */
} sa_root_place;

/* Isolates all positive roots of p (Vincent, Collins and Akritas: bisection with Descartes' rule, Proc.
 * SYMSAC 1976, p. 272-275; here with interval coefficients, so that every place and every gap is proved). The
 * leading coefficient must be nonzero. Places that stay undecided down to a relative width of
 * 2^(-precision/4) are given as such, touching ones as one. CV_FAILED: out of memory, or the leading
 * coefficient may be zero. */
cv_status sa_polynomial_positive_roots(sa_root_place **out, size_t *count, const sa_polynomial *p);
void sa_root_places_free(sa_root_place *place, size_t count);

/* Encloses the one root in (low, high) as x to a relative width of 2^(1-bits). 0 when the precision of p does
 * not allow it. */
int sa_polynomial_refine(sa_interval *x, const sa_polynomial *p, const sa_root_place *place, long bits);

#endif
