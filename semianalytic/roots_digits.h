/* One root to many digits. */
#ifndef CRITVEL_SEMIANALYTIC_ROOTS_DIGITS_H
#define CRITVEL_SEMIANALYTIC_ROOTS_DIGITS_H

#include "semianalytic/roots.h"
#include "semianalytic/roots_search.h"

/* Newton's iteration in MPFR from the rough root, with the slope of the latter: zeta is enclosed by a box for
 * each pole (poles_box.h), the same poles as at the rough root. out->re and out->im are initialised here, by
 * 10^-(digits + 1) of each part; a root with Re q = 0 keeps Im qbar = 0. out->decided says whether that was
 * reached. CV_FAILED: out of memory; nothing is then allocated. */
cv_status sa_root_polish(sa_root *out, const sa_rough_root *rough, const sa_track *t, const cv_number *alpha,
                         const cv_number *mass_ratio, int digits);
void sa_root_clear(sa_root *root);

#endif
