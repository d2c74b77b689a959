/* One root of eta_M zeta = 1 to many digits. For mass_roots.c only. */
#ifndef CRITVEL_DGREEN_MASS_ROOTS_REFINE_H
#define CRITVEL_DGREEN_MASS_ROOTS_REFINE_H

#include "dgreen/continued_mp.h"
#include "dgreen/mass_roots.h"

/* root is initialised here, also on failure. near: at the root to double precision; slope: d zeta/d qbar
 * there. CV_UNDECIDED: not enclosed with the largest precision, or a root with Re qbar > 0 of a sum that is
 * not (30). */
cv_status dg_mass_root_refine(dg_mass_root *root, const dg_continued *near, double complex slope,
                              const cv_number *alpha, const cv_number *mass_ratio, int digits,
                              cv_message *why);

#endif
