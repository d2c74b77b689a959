/* K(xi, q) of (13) and zeta(alpha, q) = q^2 K(0, q) / (2 pi) to any number of digits, by residues:
 *
 *     K(xi, q) = integral over real p of (d2/d3) e^{i p xi}
 *              = 2 pi i (sum over upper poles of residue e^{i p xi}),  xi >= 0
 *              = - 2 pi i (the same over lower poles),                 xi < 0
 *
 * Signs as in zeta.h; dimensionless. Undamped tracks: the limit q - i0, where a real pole p counts as upper
 * when (d d3/dq)/(d d3/dp) > 0. There the residues at real poles are real, those at the others come in
 * conjugate pairs and all add up to zero, so that Re zeta = - q^2 (sum over Im p > 0 of Im residue) Im zeta =
 * q^2/2 (sum over real upper poles - sum over real lower poles of the residue). */
#ifndef CRITVEL_SEMIANALYTIC_KERNEL_H
#define CRITVEL_SEMIANALYTIC_KERNEL_H

#include <mpc.h>

#include "semianalytic/zeta.h"

/* zeta and K(xi, q), each part separately right: |error| <= 10^-(digits + 1) |part|, proven. A part that is
 * exactly zero is exactly 0. xi NULL: xi = 0. q of either sign; q = 0 gives zeta = 0 and K where it exists.
 * The outputs must be initialised; their precision is set here.
 * CV_BAD_INPUT: alpha < 0, digits outside 1 .. CV_DIGITS_MAX. CV_UNDECIDED: the precision needed exceeds 4096
 * bits beyond that of the digits, as at a branch point of an undamped track (a double real pole, where K does
 * not exist); the message says so. */
cv_status sa_kernel_digits(mpc_t zeta, mpc_t kernel, const sa_track *t, const cv_number *alpha,
                           const cv_number *q, const cv_number *xi, int digits, cv_message *why);

/* zeta alone. */
cv_status sa_zeta_digits(mpc_t zeta, const sa_track *t, const cv_number *alpha, const cv_number *q,
                         int digits, cv_message *why);

#endif
