/* Numbers as the reports write them. Each function fills and returns the caller's buffer. */
#ifndef CRITVEL_COMPARE_FORMAT_H
#define CRITVEL_COMPARE_FORMAT_H

#include "compare/run.h"

enum { CMP_NUMBER_SIZE = CV_DIGITS_MAX + 64 };

typedef struct {
    char text[CMP_NUMBER_SIZE];
} cmp_number_text;

/* x rounded to significant digits, zeros kept: "0.2000", "1.50e-07"; "nan" or "inf" where it is not a number.
 */
const char *cmp_format_mpfr(cmp_number_text *out, mpfr_srcptr x, int digits);

/* x with the digits its bound supports, at least "digits" and at most two more, so that rounding to decimal
 * does not spoil the digits asked for. */
const char *cmp_format_claimed(cmp_number_text *out, mpfr_srcptr x, mpfr_srcptr error, int digits);

/* An exact number, as it was typed where it is a decimal, else to "digits" digits. */
const char *cmp_format_exact(cmp_number_text *out, const cv_number *x, int digits);

typedef struct {
    char text[3 * CMP_NUMBER_SIZE];
} cmp_damping_text;

/* "1e-10", or "eta_p/eta_b/eta_f" where they are not equal. */
const char *cmp_format_damping(cmp_damping_text *out, const cv_params *p, int digits);

/* Digits of agreement, rounded down to one decimal place. */
const char *cmp_format_digits(cmp_number_text *out, double digits);
double cmp_floor_tenth(double digits);

/* out = alpha v_ref of (4), m/s, or km/h; mass of the ratio eta_M by (11), kg. At the precision of out. */
void cmp_velocity(mpfr_ptr out, mpfr_srcptr alpha, const cv_track *track, int km_h);
void cmp_mass(mpfr_ptr out, const cv_number *eta_M, const cv_track *track);

#endif
