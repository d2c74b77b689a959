/* The scalar operators of the D-decomposition method: Delta (19) and R (23) as polynomials in lambda.
 *
 * Convention. All dimensionless. W(xi, qbar) is the Laplace image, kernel exp(-qbar tau); a solution of
 * Delta W = 0 is exp(lambda xi). With s = qbar - alpha lambda and lambda = i y the entries of (17) are, up to
 * the factor 4 of its first row, sums of
 *     A = lambda^4 + 4 eta_N lambda^2 + 4 s^2      D2 = 2 eta_p s + kappa_p     D4 = 2 eta_b s + kappa_b
 *     D3 = mu_s s^2                                F  = mu_b s^2 + 2 eta_f s + 1 - eta_s lambda^2
 * (the print of (17) has "8 alpha s D" for 8 alpha qbar D, and L_{xi,s,23} for L_{xi,qbar,23}).
 *     R     = L22 L33 - L23 L32        = (D2 + D3) C + D4 F,   C = D4 + F                              (23)
 *     Delta = L11 R - L12 L21 L33      = A R + 4 D2 (D3 C + D4 F)                                      (19)
 * The right-hand forms are the left-hand ones after the equal and opposite products have been struck out,
 * so that stiff pads and ballast (kappa 1e4) do not cancel against the soft foundation.
 *
 * Storage: coefficients of powers of y = -i lambda, ascending: Delta(i y) = sum_k c[k] y^k. Hence
 * a_j = c[8-j] / i^(8-j) and r_j likewise. For qbar = i q and no damping every c[k] is real; damping enters
 * the imaginary parts in first order, so that tiny damping keeps all its digits. Re lambda > 0 means Im y <
 * 0.
 */
#ifndef CRITVEL_DGREEN_OPERATOR_H
#define CRITVEL_DGREEN_OPERATOR_H

#include <complex.h>
#include <mpfr.h>

#include "common/params.h"
#include "dgreen/dd.h"

enum { DG_DEGREE = 8, DG_R_DEGREE = 4 };

enum {
    DG_MU_S,
    DG_MU_B,
    DG_KAPPA_P,
    DG_KAPPA_B,
    DG_ETA_P,
    DG_ETA_B,
    DG_ETA_F,
    DG_ETA_S,
    DG_ETA_N,
    DG_PARAMETERS
};

/* The parameters at one precision, indexed by the names above */
typedef struct {
    mpfr_t value[DG_PARAMETERS];
} dg_constants;

/* Precisions (bits) of the escalation above double. One below a multiple of 64 is markedly faster in MPFR. */
enum { DG_LADDER = 3 };
extern const mpfr_prec_t dg_ladder[DG_LADDER]; /* 127, 191, 255 */

/* The parameters of one track: exact, rounded to double, and rounded to the higher precisions. */
typedef struct {
    cv_params exact;
    double mu_s, mu_b, kappa_p, kappa_b, eta_p, eta_b, eta_f, eta_s, eta_N;
    int damped;                   /* at least one damping ratio is positive */
    dg_dd twofold[DG_PARAMETERS]; /* in double-double */
    dg_constants ladder[DG_LADDER];
} dg_track;

/* Copies p; p must have passed cv_params_check. CV_FAILED when out of memory. *out is NULL on failure. */
cv_status dg_track_new(dg_track **out, const cv_params *p, cv_message *why);
void dg_track_free(dg_track *t); /* NULL allowed */

/* The exact parameters rounded to "precision" bits (within one unit in the last place). */
void dg_constants_init(dg_constants *c, const dg_track *t, mpfr_prec_t precision);
void dg_constants_clear(dg_constants *c);

/* Delta and R in double at one (alpha, qbar). Each part of a coefficient differs from the exact one by at
 * most 72 u times its size (u = 2^-53, derivation in dgreen/bounds.h). */
typedef struct {
    double re[DG_DEGREE + 1], im[DG_DEGREE + 1]; /* Delta(i y) */
    double size_re[DG_DEGREE + 1],
        size_im[DG_DEGREE + 1]; /* the same with every term replaced by its modulus */
    double size[DG_DEGREE + 1]; /* size_re + size_im */
    double r_re[DG_R_DEGREE + 1], r_im[DG_R_DEGREE + 1]; /* R(i y) */
    double r_size_re[DG_R_DEGREE + 1], r_size_im[DG_R_DEGREE + 1], r_size[DG_R_DEGREE + 1];
    int degree;         /* 8; at alpha = 0: 6, or 4 where eta_s = 0 */
    double relative_a0; /* (alpha^2 mu_b - eta_s) / (alpha^2 mu_b + eta_s), 0 at the degree drop */
} dg_operator;

/* Any alpha >= 0 and any qbar. */
void dg_operator_set(dg_operator *op, const dg_track *t, double alpha, double complex qbar);

/* 1: as many roots with Re lambda > 0 (right) and < 0 (left) as there must be. Damping or Re qbar > 0 leave
 * no lambda on the imaginary axis below buckling, so the number depends on the sign of a0 alone; the far
 * root's side is that sign. A far root whose side is open is in neither number. */
int dg_operator_count_fits(const dg_operator *op, int right, int left);

#endif
