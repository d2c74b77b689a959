/* zeta(alpha, qbar) (dgreen/z.h) in double-double: the step between double and MPFR, some ten times as fast
 * as the latter. */
#ifndef CRITVEL_DGREEN_Z_DD_H
#define CRITVEL_DGREEN_Z_DD_H

#include "dgreen/roots.h"
#include "dgreen/z.h"

/* alpha >= 0, Re qbar >= 0; damping or Re qbar > 0. *roots: where to start, in double; CV_OK: the roots
 * found. CV_UNDECIDED: not enough bits to separate two roots or to decide the half-plane of one, or numbers
 * beyond the range of double-double. CV_FAILED: a theorem is violated, as for dg_zeta_double. */
cv_status dg_dd_zeta(dg_value *value, dg_roots *roots, const dg_track *track, double alpha,
                     double complex qbar);

#endif
