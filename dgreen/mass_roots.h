/* The roots qbar of the characteristic equation eta_M zeta(alpha, qbar) = 1: the mass-induced frequencies Im
 * qbar and growth rates Re qbar. Conjugate pairs; the one with Im qbar > 0 stands for both.
 *
 * Method: the D-decomposition curve at alpha gives N, the number of roots with Re qbar > 0, by its winding,
 * and its crossings with the real axis, where roots enter and leave that half-plane as the mass grows; each
 * is followed from there to eta_M (dgreen/path.h). Stable ones, which need not cross anywhere, are followed
 * from the points of the curve nearest to the root. Each is then refined in MPFR by the secant method and
 * enclosed: on a circle around it zeta - 1/eta_M goes around zero once. Roots found and N must agree. */
#ifndef CRITVEL_DGREEN_MASS_ROOTS_H
#define CRITVEL_DGREEN_MASS_ROOTS_H

#include <mpfr.h>
#include <stddef.h>

#include "dgreen/sampler.h"

typedef struct {
    mpfr_t re, im;    /* qbar, dimensionless; im > 0 */
    double log_error; /* log10 of the bound of |qbar - exact| */
} dg_mass_root;

typedef struct {
    int unstable_count; /* N, by the argument principle; twice the number of items with re > 0 */
    size_t count;
    dg_mass_root *items; /* descending in re: the unstable ones first, then the nearest stable ones */
} dg_mass_roots;

/* All unstable roots, and the stable ones nearest to the axis, each part right to "digits" digits; alpha > 0
 * in the sampler's range, mass_ratio > 0. Stable roots are those of zeta continued from the axis along a
 * straight line of constant Im qbar (dgreen/continued.h); their list is not proved complete.
 * CV_UNDECIDED: the number of roots found and N differ, or a root could not be enclosed. */
cv_status dg_find_mass_roots(dg_mass_roots *out, dg_sampler *s, const cv_number *alpha,
                             const cv_number *mass_ratio, int digits, cv_message *why);
void dg_mass_roots_clear(dg_mass_roots *roots);

#endif
