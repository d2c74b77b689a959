/* zeta at complex qbar, continued across the imaginary axis as laplace.h says, at any precision. */
#ifndef CRITVEL_SEMIANALYTIC_LAPLACE_DIGITS_H
#define CRITVEL_SEMIANALYTIC_LAPLACE_DIGITS_H

#include "semianalytic/zeta.h"

/* zeta at exactly these alpha and qbar = i q, with the precision of zeta; proven bounds for the two parts.
 * Which poles make K is decided in double (laplace.h), their values and the sum are boxes. CV_UNDECIDED: the
 * way from Re qbar >= 0 to qbar passes a branch point (undamped tracks: always), or that precision cannot
 * separate the poles. */
cv_status sa_zeta_continued(mpc_t zeta, mpfr_t re_error, mpfr_t im_error, const sa_track *t,
                            const cv_number *alpha, const mpc_t qbar);

#endif
