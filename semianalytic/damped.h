/* Poles of the damped steady state; used by steady.c only. With l = ip and q = 0 every entry of (7) is a real
 * polynomial in l: s = -alpha l, p^2 = -l^2. */
#ifndef CRITVEL_SEMIANALYTIC_DAMPED_H
#define CRITVEL_SEMIANALYTIC_DAMPED_H

#include "semianalytic/steady.h"

/* Fills the terms of s from the roots of d3. CV_UNDECIDED as sa_steady_solve. */
cv_status sa_damped_terms(sa_steady *s, const cv_params *params, const cv_number *alpha, cv_message *why);

#endif
