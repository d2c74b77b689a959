/* zeta continued across the stability boundary (dgreen/continued.h) at any precision, with a bound. */
#ifndef CRITVEL_DGREEN_CONTINUED_MP_H
#define CRITVEL_DGREEN_CONTINUED_MP_H

#include <mpc.h>

#include "dgreen/continued.h"

typedef struct dg_continued_mp dg_continued_mp; /* workspace of one precision for one velocity */

cv_status dg_continued_mp_new(dg_continued_mp **out, const dg_track *track, const cv_number *alpha,
                              mpfr_prec_t precision, cv_message *why);
void dg_continued_mp_free(dg_continued_mp *w); /* NULL allowed */

/* zeta at qbar, over the roots that near->chosen names; near->qbar must be so close that its roots lead to
 * those at qbar. |zeta - exact| <= error. physical: 1 when the chosen roots are those with Re lambda > 0.
 * CV_UNDECIDED: discs of roots meet. */
cv_status dg_continued_mp_zeta(mpc_ptr zeta, mpfr_ptr error, int *physical, dg_continued_mp *w,
                               const dg_continued *near, mpc_srcptr qbar);

#endif
