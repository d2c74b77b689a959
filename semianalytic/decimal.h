/* Decimal text of many-digit results. */
#ifndef CRITVEL_SEMIANALYTIC_DECIMAL_H
#define CRITVEL_SEMIANALYTIC_DECIMAL_H

#include <mpfr.h>

/* x rounded to nearest with exactly that many significant digits: plain notation for 1e-5 <= |x| < 1e20
 * where all digits before the point are significant, else d.ddde-XX; "0" for zero. Caller frees; NULL when
 * out of memory or not a number. */
char *sa_decimal_text(const mpfr_t x, int digits);

#endif
