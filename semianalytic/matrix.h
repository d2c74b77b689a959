/* The matrix (7) at one (alpha, q, p) through the dynamic stiffnesses of its five springs and masses:
 *
 *     D1 rail, D2 pad, D3 sleeper, D4 ballast, E = D5 + D6 + D7 foundation, with s = i (q - alpha p)
 *     [D1+D2  -D2        0   ]
 *     [-D2    D2+D3+D4   -D4 ]       d2 = lower right minor, d3 = determinant
 *     [0      -D4        D4+E]
 *
 * d3 is affine in each of the five. Its slope in element k, the weight w[k], is an entry of the adjugate in
 * the direction of that element's elongation (W, W - V, V, V - U, U), hence d3' = sum of w[k] D'[k] along any
 * direction (Jacobi's formula). None of the weights contains a difference of products: in terms of s all
 * coefficients are real and non-negative, so small real and imaginary parts survive in their own relative
 * accuracy. The determinant is never expanded in powers of p. */
#ifndef CRITVEL_SEMIANALYTIC_MATRIX_H
#define CRITVEL_SEMIANALYTIC_MATRIX_H

#include <complex.h>

#include "common/params.h"
#include "semianalytic/rect.h"
#include "semianalytic/zeta.h"

enum { SA_RAIL, SA_PAD, SA_SLEEPER, SA_BALLAST, SA_FOUNDATION, SA_ELEMENTS };

struct sa_track {
    cv_params exact;
    sa_real mu_s, mu_b, kappa_p, kappa_b, eta_s, eta_N;
    sa_real loss_p, loss_b, loss_f; /* 2 eta_p, 2 eta_b, 2 eta_f */
    int undamped;                   /* eta_p = eta_b = eta_f = 0 */
    int double_range;               /* nonzero parameters within 1e-20 .. 1e20: rect.h cannot underflow */
};

/* Number of poles with Im p > 0 for Re qbar >= 0 (limit from Re qbar > 0): 3 when alpha^2 mu_b < eta_s,
 * else 2. No pole is real for Re qbar > 0 while the resting track does not buckle, so the number changes only
 * where a pole goes through infinity. *degree (may be NULL): number of all poles. Exact comparison. */
int sa_matrix_upper_count(int *degree, const sa_track *t, const cv_number *alpha);
int sa_matrix_upper_count_double(const sa_track *t, double alpha);

/* Plain double complex. */
typedef struct {
    double complex s, p;
    double complex d[SA_ELEMENTS];   /* dynamic stiffnesses */
    double complex d_p[SA_ELEMENTS]; /* their derivatives in p */
    double complex c, w[SA_ELEMENTS];
    double complex det, det_p; /* d3, its derivative in p; d2 is w[SA_RAIL] */
} sa_point;

void sa_matrix_point(sa_point *m, const sa_track *t, double alpha, double complex q, double complex p);

/* First order of a pole p(alpha, q) and of its residue d2/d3' along q and along alpha; m is the matrix at the
 * pole. Of a pole so far out that they overflow (|p| ~ 1e20), those of the residue are 0. */
typedef struct {
    double complex residue, p_q, p_alpha, residue_q, residue_alpha;
} sa_slopes;

void sa_matrix_slopes(sa_slopes *out, const sa_point *m, const sa_track *t, double alpha);

/* Enclosures over a rectangle of p (of zero size for a point). det_p is filled by sa_matrix_enclose_slope. */
typedef struct {
    sa_rect s, p, p2, s2;
    sa_rect d[SA_ELEMENTS], c, w[SA_ELEMENTS];
    sa_rect force; /* D3 C + D4 E, so that d2 = D2 C + force and d3 = D1 d2 + D2 force */
    sa_rect det, det_p;
} sa_enclosure;

void sa_matrix_enclose(sa_enclosure *m, const sa_track *t, double alpha, double complex q, sa_rect p);
void sa_matrix_enclose_slope(sa_enclosure *m, const sa_track *t, double alpha);

/* The residue of d2/d3 at the zero of d3 inside the rectangle: adj(M) = r r^T there, so it is adj_1k^2 /
 * adj_kk over d3' for each column k; the column with the narrowest result is taken. */
sa_rect sa_matrix_enclose_residue(const sa_enclosure *m);

#endif
