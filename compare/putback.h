/* Claimed transitions put back into a method's own zeta, at higher precision. */
#ifndef CRITVEL_COMPARE_PUTBACK_H
#define CRITVEL_COMPARE_PUTBACK_H

#include "compare/judge.h"

typedef struct {
    mpfr_t residual; /* |eta_M zeta - 1|; 0: nothing was put back */
    double used;     /* the largest ratio of a residual to what was allowed; at most 1 where all are kept */
} cmp_residual;

/* For each transition of the list: |eta_M zeta(alpha, q) - 1|, zeta by "method" with at least 15 digits more
 * than the bounds claim, must not exceed 9/8 (|eta_M dzeta/dalpha| alpha_error + |eta_M dzeta/dq| q_error) +
 * bound of the evaluation, the derivatives being differences over the bounds themselves (9/8 covers the
 * second order, which is smaller than the first by a factor of the relative bound times the curvature).
 * Otherwise v becomes CMP_DISAGREE, "claimant" being the name of the method that made the list. CMP_UNDECIDED
 * where the evaluation's own bound is too wide to tell. *largest becomes the largest residual if that is
 * larger. Non-finite transitions are left to cmp_judge. handle: of method, for the track of the list. */
cv_status cmp_put_back(cmp_verdict *v, cmp_residual *worst, const cmp_list *list, const char *claimant,
                       const cmp_method *method, void *handle, const cv_number *mass_ratio, cv_message *why);

#endif
