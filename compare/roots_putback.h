/* Roots put back into z = 1 of either method, at higher precision. */
#ifndef CRITVEL_COMPARE_ROOTS_PUTBACK_H
#define CRITVEL_COMPARE_ROOTS_PUTBACK_H

#include "compare/roots.h"

/* For each method that lists the row's root and each method's zeta: |eta_M zeta(qbar) - 1| must not exceed
 * 9/4 |eta_M (zeta(qbar + error) - zeta(qbar))| + bound of the evaluation (9/4: both parts of qbar, and the
 * second order). Otherwise the row's verdict becomes CMP_DISAGREE. CMP_UNDECIDED where a method cannot
 * evaluate zeta there, or not sharply enough. Residual and used of the row are raised to the largest. */
cv_status cmp_roots_put_back(cmp_root_row *row, const cmp_root_method *const methods[CMP_METHODS],
                             void *const handles[CMP_METHODS], const cv_number *mass_ratio, cv_message *why);

#endif
