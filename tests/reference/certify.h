/* Rigorous transitions: (alpha, q) with eta_M zeta(alpha, q) = 1, proved to exist and to be the only one
 * nearby by the interval Newton operator on (Re zeta - 1/eta_M, Im zeta). */
#ifndef CRITVEL_REFERENCE_CERTIFY_H
#define CRITVEL_REFERENCE_CERTIFY_H

#include "arbtrack.h"

typedef struct {
    arb_t alpha, q;       /* the transition, as balls far smaller than 1e-45 */
    double unique_radius; /* it is the only one with |alpha - alpha'|, |q - q'| <= this */
    int jump;             /* change of the number of unstable roots as alpha grows: +2 or -2 */
} ref_transition;

void ref_transition_init(ref_transition *x);
void ref_transition_clear(ref_transition *x);

/* Newton from (alpha0, q0), then the proof. 0, or -1 when Newton leaves [alpha0 +- reach] or does not
 * converge, or when the proof fails. */
int ref_certify(ref_transition *out, const ref_track *t, const fmpq_t eta_M, double alpha0, double q0,
                double reach);

#endif
