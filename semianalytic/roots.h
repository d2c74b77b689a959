/* The roots qbar of the characteristic equation z = eta_M zeta(alpha, q) = 1, qbar = i q: the mass-induced
 * frequencies Im qbar and growth rates Re qbar of a mass moving at alpha, (29) and the poles of (14) with its
 * factor 4 corrected. Dimensionless.
 *
 * Those with Re qbar > 0 are all there: they are counted by the argument principle (roots_contour.h), and the
 * list is undecided unless as many are found. Those with Re qbar <= 0 are zeros of the continuation of zeta
 * across the imaginary axis that laplace.h describes, with the cuts made there, hence poles of the integrand
 * of (14) in the sense of a contour that is pushed into Im q > 0 and hangs on those cuts. They are found by
 * Newton's iteration from many starts; how many there are is not proved.
 *
 * Roots come in conjugate pairs; the list has the one with Im qbar >= 0. */
#ifndef CRITVEL_SEMIANALYTIC_ROOTS_H
#define CRITVEL_SEMIANALYTIC_ROOTS_H

#include <stddef.h>

#include "semianalytic/zeta.h"

typedef struct {
    mpfr_t re, im; /* qbar */
    double error;  /* bound on the error of each part: zeta enclosed at (re, im), over its slope */
    double complex qbar, slope; /* rounded; d(1 - z)/dq, q = -i qbar, to about 1e-10 */
    cv_status decided;          /* CV_UNDECIDED: the digits asked for, in each part, were not reached */
} sa_root;

typedef struct {
    size_t count;
    sa_root *items;     /* Re qbar descending */
    int unstable_roots; /* roots with Re qbar > 0, by the contour; conjugates counted */
    cv_status decided;  /* CV_UNDECIDED: others were found, or the axis and a root cannot be told apart */
    cv_message reason;
} sa_root_list;

/* mass_ratio > 0. Stable roots are listed down to Re qbar >= -depth, depth >= 0. CV_BAD_INPUT: an undamped
 * track, whose branch points lie on the imaginary axis. CV_UNDECIDED: no contour. On any status but CV_OK the
 * list is empty. */
cv_status sa_roots_find(sa_root_list *out, const sa_track *t, const cv_number *alpha,
                        const cv_number *mass_ratio, double depth, int digits, cv_message *why);
void sa_roots_clear(sa_root_list *list);

#endif
