/* Resonance velocities of the moving force: the stationary points over p > 0 of the phase velocity omega_k(p)
 * / p of the undamped track (dispersion.h). There a wave whose phase stands still under the force does not
 * leave it, and the undamped steady state is infinite. A minimum is a true critical velocity, a maximum a
 * false one (section 5 of the paper). All quantities are dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_RESONANCES_H
#define CRITVEL_SEMIANALYTIC_RESONANCES_H

#include <stddef.h>

#include "common/params.h"

typedef enum {
    SA_RESONANCE_TRUE,   /* minimum of the phase velocity */
    SA_RESONANCE_FALSE,  /* maximum */
    SA_RESONANCE_MERGING /* a minimum and a maximum so close together that the largest precision allowed
                          * cannot tell two from one (an inflection) or from none; stands for both */
} sa_resonance_kind;

typedef struct {
    mpfr_t alpha, p;
    long bits; /* |error| <= 2^-bits |value| of alpha and p, proved; for SA_RESONANCE_MERGING both lie that
                  near */
    int k;     /* branch */
    sa_resonance_kind kind;
} sa_resonance;

typedef struct {
    size_t count;
    sa_resonance *item; /* alpha ascending */
} sa_resonance_list;

/* All resonance velocities over the whole range alpha > 0, to at least that many significant digits. The list
 * is complete, by proof: p^2 runs over the positive roots of a polynomial of degree 10 (eta_s = 0) or 12, the
 * resultant of the dispersion relation F(x, L) = det(K - L M) and of x F_x + L F_L (x = p^2, L = omega^2),
 * and these are isolated with interval coefficients. params must have passed cv_params_check; dampings are
 * ignored. CV_FAILED: out of memory, or a track whose polynomial the largest precision cannot resolve. */
cv_status sa_resonances(sa_resonance_list *out, const cv_params *params, int digits, cv_message *why);
void sa_resonances_clear(sa_resonance_list *list);

/* "true", "false", "merging" */
const char *sa_resonance_kind_text(sa_resonance_kind kind);

#endif
