/* The matrix (7) at any precision: the elements, weights and residues of matrix.h as boxes of box.h. */
#ifndef CRITVEL_SEMIANALYTIC_MATRIX_BOX_H
#define CRITVEL_SEMIANALYTIC_MATRIX_BOX_H

#include "semianalytic/box.h"
#include "semianalytic/matrix.h"

/* A track and a point (alpha, q) rounded at one precision. sa_place_set sets a real q; whoever wants a
 * complex one sets q_im afterwards. */
typedef struct {
    mpfr_prec_t precision;
    sa_span mu_s, mu_b, kappa_p, kappa_b, eta_s, eta_N, loss_p, loss_b, loss_f;
    sa_span alpha, q, q_im, one;
    int upper_count, degree; /* sa_matrix_upper_count, exact */
    int undamped;
} sa_place;

void sa_place_init(sa_place *x, const sa_track *t, mpfr_prec_t precision);
void sa_place_clear(sa_place *x);
void sa_place_set(sa_place *x, const sa_track *t, const cv_number *alpha, const cv_number *q);

enum { SA_MATRIX_BOXES = 22 };

/* Everything at one box of p; the names are those of sa_enclosure. */
typedef union {
    struct {
        sa_box s, p, p2, s2, d[SA_ELEMENTS], c, w[SA_ELEMENTS], force, det, det_p;
        sa_box temporary[4];
    };
    sa_box all[SA_MATRIX_BOXES];
} sa_box_matrix;

void sa_box_matrix_init(sa_box_matrix *m, mpfr_prec_t precision);
void sa_box_matrix_clear(sa_box_matrix *m);

/* From m->p: the elements, d2 = w[SA_RAIL] and d3 = det. */
void sa_box_matrix_set(sa_box_matrix *m, const sa_place *x);

/* After sa_box_matrix_set: the other weights and det_p. */
void sa_box_matrix_slope(sa_box_matrix *m, const sa_place *x);

/* After sa_box_matrix_slope, with p a box that holds one zero of d3: the residue of d2/d3 there. 0 where it
 * cannot be bounded. */
int sa_box_matrix_residue(sa_box *residue, sa_box_matrix *m);

/* After sa_box_matrix_slope, undamped track, p real: the sign of (d d3/dq)/(d d3/dp), 1 for a pole that lies
 * in Im p > 0 in the limit q - i0, -1 for Im p < 0, 0 when undecided. */
int sa_box_matrix_side(sa_box_matrix *m, const sa_place *x);

#endif
