/* zeta(alpha, qbar) (dgreen/z.h) at any precision. Each part has its own bound: a real part of 1e-9 beside an
 * imaginary part of 1 gets the same number of correct digits. */
#ifndef CRITVEL_DGREEN_Z_MP_H
#define CRITVEL_DGREEN_Z_MP_H

#include <mpc.h>

#include "dgreen/operator.h"
#include "dgreen/roots.h"

/* zeta at qbar = sigma + i q, sigma >= 0 (NULL: 0), any q, alpha >= 0, with both parts right to "digits"
 * significant digits (relative error below 10^-(digits + 2)). The precision of zeta becomes whatever was
 * needed.
 *
 * Without damping and with sigma = 0 it is the limit qbar -> i q + 0; there a part can be exactly zero (no
 * real root: no radiation; no other root: Re zeta), and it is returned as exact 0. At q = 0 zeta is real, and
 * 0 for sigma = 0. CV_UNDECIDED: the largest precision (4096 bits beyond the digits) could not separate two
 * roots or decide their half-planes: an undamped track at a branch point, where zeta is infinite, or numbers
 * beyond the range of a double. CV_BAD_INPUT: alpha < 0, sigma < 0. */
cv_status dg_zeta_digits(mpc_ptr zeta, const dg_track *track, const cv_number *alpha, const cv_number *sigma,
                         const cv_number *q, int digits, cv_message *why);

/* zeta at qbar = i q for exactly these alpha, q, computed once with "bits" bits (the precision zeta gets);
 * |part - exact| <= error of that part. Statuses as dg_zeta_digits. */
cv_status dg_zeta_mp(mpc_ptr zeta, mpfr_ptr re_error, mpfr_ptr im_error, const dg_track *track,
                     mpfr_srcptr alpha, mpfr_srcptr q, mpfr_prec_t bits);

/* Workspace of one precision, for callers that evaluate many points. */
typedef struct dg_mp dg_mp;
cv_status dg_mp_new(dg_mp **out, mpfr_prec_t precision, cv_message *why);
void dg_mp_free(dg_mp *w); /* NULL allowed */

typedef struct {
    mpfr_srcptr re, im, re_error, im_error; /* inside the workspace, until its next use */
    int right_count;                        /* as in dg_value */
} dg_mp_value;

/* zeta at (alpha, qbar). start: roots in double near the right ones, or NULL. constants: of the workspace's
 * precision. */
cv_status dg_mp_zeta(dg_mp_value *value, dg_mp *w, const dg_track *track, const dg_constants *constants,
                     mpfr_srcptr alpha, mpc_srcptr qbar, const dg_roots *start);

#endif
