/* The roots lambda_i of Delta in double, and discs that contain them.
 *
 * Roots are kept as y = -i lambda (dgreen/operator.h). Near the degree drop alpha^2 mu_b = eta_s one root
 * runs through infinity; there it is kept as its reciprocal u = 1/y, in the last slot, and "far" is set. */
#ifndef CRITVEL_DGREEN_ROOTS_H
#define CRITVEL_DGREEN_ROOTS_H

#include "dgreen/operator.h"

typedef struct {
    int count; /* the degree; includes the far root */
    int far;   /* 1: slot count-1 holds u = 1/y of the root that is, or is close to, infinity */
    double re[DG_DEGREE], im[DG_DEGREE];
} dg_roots;

/* For each root: Delta' and what is known about the exact root. Errors in units of 2^-53 (dgreen/bounds.h).
 * For the far root they belong to the reversed polynomial u^8 Delta(i/u) and to u.
 *
 * "flat" roots lie close to the real axis of y, where small damping leaves them. Their real and imaginary
 * parts have bounds of their own, since the rounding of the large real parts of the coefficients does not
 * reach the small imaginary parts. */
typedef struct {
    double d_re[DG_DEGREE], d_im[DG_DEGREE]; /* d Delta(i y)/dy at the approximation */
    double d_error[DG_DEGREE];               /* relative: of d_re + i d_im as its value at the exact root */
    double radius[DG_DEGREE];    /* the disc around the approximation holds exactly one exact root */
    double radius_im[DG_DEGREE]; /* |Im(y - exact root)|, at most radius */
    double crowding[DG_DEGREE];  /* sum over the others of 1/(least distance) */
    int flat[DG_DEGREE];
    /* flat roots only */
    double rounding_re[DG_DEGREE], rounding_im[DG_DEGREE]; /* of d_re, d_im: rounding only */
    double field_re[DG_DEGREE], field_im[DG_DEGREE];       /* sum over the others of 1/(y_i - y_k) */
    double field_error[DG_DEGREE];                         /* absolute */
} dg_discs;

/* 1: the operator's roots are to be kept with a far root. */
int dg_roots_far_form(const dg_operator *op);

/* Eigenvalues of the balanced companion matrix (LAPACK zhseqr), not polished. CV_UNDECIDED where LAPACK does
 * not converge or the coefficients overflow. */
cv_status dg_roots_cold(dg_roots *roots, const dg_operator *op);

/* Simultaneous iteration (Ehrlich-Aberth, all roots, each update used at once) from the values in roots,
 * which may come from a neighbouring point; converges with third order to simple roots. Changes between near
 * and far representation as op asks for. CV_UNDECIDED when not converged after DG_MAX_SWEEPS; roots are then
 * useless. */
enum { DG_MAX_SWEEPS = 12 };
cv_status dg_roots_polish(dg_roots *roots, const dg_operator *op);

/* The same for the cold start, which may begin far away: more sweeps. */
cv_status dg_roots_polish_cold(dg_roots *roots, const dg_operator *op);

/* Disjoint discs, one exact root in each (method in dgreen/bounds.h); the rounding errors of the coefficients
 * and of the evaluation are included. CV_UNDECIDED when discs meet (clusters closer than the rounding
 * allows). */
cv_status dg_roots_enclose(dg_discs *discs, const dg_roots *roots, const dg_operator *op);

#endif
