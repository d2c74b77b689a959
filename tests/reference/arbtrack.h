/* The referee's own model: zeta(alpha, q) of the dimensionless track as a rigorous ball, with its first
 * derivatives, from the determinant of matrix (7) as polynomials in p (Arb). Slow; shares no code with the
 * solver trees. Conventions: s = i(q - alpha p), zeta = q^2 K(0,q)/(2 pi) = i q^2 sum_{Im p > 0} d2/(d
 * d3/dp), and q -> q - i0 for the undamped track. All quantities are dimensionless. */
#ifndef CRITVEL_REFERENCE_ARBTRACK_H
#define CRITVEL_REFERENCE_ARBTRACK_H

#include <acb.h>
#include <flint/fmpq.h>

#include "jet.h"

enum { REF_MU_S, REF_MU_B, REF_KAPPA_P, REF_KAPPA_B, REF_ETA_S, REF_ETA_N, REF_ETA_P, REF_ETA_B, REF_ETA_F };
enum { REF_PARAMS = 9 };

/* Names of the parameters in the order of the enum above, as they stand in the data files. */
extern const char *const ref_param_names[REF_PARAMS];

typedef struct {
    fmpq value[REF_PARAMS]; /* exact, in the order of the enum above */
} ref_track;

typedef struct {
    acb_t zeta;    /* zeta(alpha, q) */
    acb_t d_alpha; /* its partial derivatives */
    acb_t d_q;
    int upper; /* number of roots p counted as upper */
    int real;  /* number of real roots (undamped track only) */
} ref_zeta;

void ref_track_init(ref_track *t);
void ref_track_clear(ref_track *t);
int ref_track_undamped(const ref_track *t);

/* Reads a plain decimal with optional exponent exactly. Returns 0, or -1 for anything else. */
int ref_decimal(fmpq_t out, const char *text);

/* d2 and d3 with their derivatives, from the 3x3 determinant. degree_drops != 0: alpha^2 mu_b = eta_s exactly
 * (values only; the derivatives by alpha are those of the full polynomials). */
void ref_determinants(ref_jet *d2, ref_jet *d3, const ref_track *t, const arb_t alpha, const arb_t q,
                      int degree_drops, slong prec);

void ref_zeta_init(ref_zeta *z);
void ref_zeta_clear(ref_zeta *z);

/* zeta for all alpha, q in the balls at "prec" bits. degree_drops != 0: the caller knows that
 * alpha^2 mu_b = eta_s exactly. Returns 0, or -1 when the roots or their half-planes cannot be told apart at
 * this precision and width. */
int ref_zeta_ball(ref_zeta *out, const ref_track *t, const arb_t alpha, const arb_t q, int degree_drops,
                  slong prec);

/* zeta at an exact point, to a relative accuracy of "bits" in each part that is not exactly zero. Returns 0,
 * or -1 when that needs more than the largest precision tried. */
int ref_zeta_point(ref_zeta *out, const ref_track *t, const fmpq_t alpha, const fmpq_t q, slong bits);

#endif
