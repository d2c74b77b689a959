/* Residues R/Delta' and their sum over Re lambda > 0, at any precision. */
#ifndef CRITVEL_DGREEN_RESIDUES_MP_H
#define CRITVEL_DGREEN_RESIDUES_MP_H

#include "dgreen/roots_mp.h"

typedef struct {
    mpc_t right;                 /* sum over Re lambda > 0 of R(i y)/(d Delta(i y)/dy) */
    double re_error, im_error;   /* units of 2^-precision, absolute; 0 for a part that is exactly 0 */
    int right_count, left_count; /* without a far root whose side is undecided */
    /* scratch */
    mpc_t left, residue, top;
    mpfr_t t[4];
} dg_mp_residues;

void dg_mp_residues_init(dg_mp_residues *r, mpfr_prec_t precision);
void dg_mp_residues_clear(dg_mp_residues *r);

/* Damping or Re qbar > 0. CV_UNDECIDED and CV_FAILED as dg_residues_sum. */
cv_status dg_mp_residues_sum(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots);

/* The same with the roots i whose bit i of "chosen" is set in place of those with Re lambda > 0 (for a sum
 * continued beyond the half-plane of convergence). Never CV_UNDECIDED. */
cv_status dg_mp_residues_sum_chosen(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots,
                                    unsigned chosen);

/* No damping, qbar = i q + 0, q > 0; roots found with on_axis.
 *
 * Coefficients are real, so roots y are real or come in conjugate pairs. At a real root the symmetric matrix
 * of (7), M(y) = K(y) - t^2 diag(1, mu_s, mu_b) with t = q - alpha y, is singular with null vector v,
 * adjugate c v v^T, so R = 4 c v_1^2 and dDelta/dq = -8 t c (v_1^2 + mu_s v_2^2 + mu_b v_3^2) have the sign
 * of c and of -t c. As qbar leaves the axis by sigma > 0, y moves by i sigma (dDelta/dq)/(dDelta/dy): Re
 * lambda > 0 if and only if t R/Delta' > 0. (Normal Doppler waves, t > 0, take energy from the mass;
 * anomalous ones, t < 0, give it.) Since the sum of all residues is 0, Re(right) = 1/2 sum over real roots of
 * sign(t) |R/Delta'|,  Im(right) = sum over pairs of Im at Im y < 0, each part with an error bound of its
 * own, and exactly 0 when there is no root of its kind. */
cv_status dg_mp_residues_sum_undamped(dg_mp_residues *r, const dg_mp_operator *op, const dg_mp_roots *roots,
                                      mpfr_srcptr alpha);

#endif
