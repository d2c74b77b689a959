/* Exact real numbers: decimals as they are typed, and the fourth roots of rationals that
 * nondimensionalisation (3)-(6), (11) makes of them. 0.03 stays 0.03 at every precision; rounding happens
 * once, at the precision of the caller. */
#ifndef CRITVEL_COMMON_NUMBER_H
#define CRITVEL_COMMON_NUMBER_H

#include <gmp.h>
#include <mpfr.h>

#include "common/status.h"

/* value = factor * radicand^(1/4), radicand > 0 (1 for a plain rational) */
typedef struct {
    mpq_t factor;
    mpq_t radicand;
} cv_number;

void cv_number_init(cv_number *x); /* sets 0 */
void cv_number_clear(cv_number *x);
void cv_number_set(cv_number *to, const cv_number *from);

/* Reads a decimal: optional sign, digits with at most one point, optional exponent e+-digits; nothing else,
 * no blanks. CV_BAD_INPUT with a message for anything else (nan, inf, "1,5", "1x", empty) and for nonzero
 * magnitudes outside 1e-300 .. 1e300, which no track has and no double holds; to is then unchanged. */
cv_status cv_number_parse(cv_number *to, const char *text, cv_message *why);

/* to = (n / d)^(1/4), n, d > 0 rationals; a root that is rational is stored as a plain rational. */
void cv_number_set_root(cv_number *to, const mpq_t n, const mpq_t d);
/* Exact. y != 0 for the quotient. to may be x or y. */
void cv_number_mul(cv_number *to, const cv_number *x, const cv_number *y);
void cv_number_div(cv_number *to, const cv_number *x, const cv_number *y);

/* 1 when x is a plain rational, 0 when a fourth root remains */
int cv_number_is_rational(const cv_number *x);
int cv_number_sign(const cv_number *x); /* -1, 0, 1 */
/* -1, 0, 1 as x <, =, > y; exact */
int cv_number_compare(const cv_number *x, const cv_number *y);

/* out = x rounded at the precision of out (faithful: error below one unit in the last place; correctly
 * rounded for rationals). */
void cv_number_get_mpfr(mpfr_t out, const cv_number *x);
double cv_number_get_double(const cv_number *x); /* the same at 53 bits */
/* 1 when x is zero or of magnitude 1e-300 .. 1e300: what every program step may hold in a double */
int cv_number_fits_double(const cv_number *x);

/* Shortest exact decimal of a rational that has one (any number that was read by cv_number_parse), else
 * "digits" significant digits. Plain notation, or d.ddde-XX where the exponent is below -5 or above 20.
 * Caller frees; NULL when out of memory. */
char *cv_number_text(const cv_number *x, int digits);

#endif
