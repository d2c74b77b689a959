/* Poles of d2/d3 at any precision: Newton's iteration on the matrix (7), then a box that provably holds
 * exactly one zero of d3, from interval Newton. The boxes are the error bound; nothing rests on the starting
 * values. */
#ifndef CRITVEL_SEMIANALYTIC_POLES_BOX_H
#define CRITVEL_SEMIANALYTIC_POLES_BOX_H

#include "semianalytic/matrix_box.h"
#include "semianalytic/poles.h"

typedef struct {
    sa_box p, residue;
    int side;    /* 1: Im p > 0, or a real pole that comes from there in the limit q - i0; -1: Im p < 0 */
    int is_real; /* undamped track only; Im p is exactly 0 then, and so is the residue's imaginary part */
} sa_box_pole;

/* The poles at one place. */
typedef struct {
    sa_place place;
    sa_box_matrix matrix;
    sa_box_pole poles[SA_POLES_MAX];
    int count;
} sa_pole_set;

void sa_pole_set_init(sa_pole_set *set, const sa_track *t, mpfr_prec_t precision);
void sa_pole_set_clear(sa_pole_set *set);

/* Interval Newton around the point matrix.p (no radii), with matrix.det_p near its value there: 1 when a box
 * that holds exactly one zero of d3 is found; it is then matrix.p, and the matrix is that over the box.
 * is_real: the box is a piece of the real axis. count < SA_POLES_MAX. */
int sa_pole_set_certify(sa_pole_set *set, int is_real);

/* Certifies the zeros of d3 near n starting values, at set->place: pairwise disjoint boxes with a known side
 * each. Starting values that lead to an undecided box are left out when skip is 1. 1 when count of the set is
 * the number of all upper poles among them (sa_place.upper_count) and, where all is 1, the number of all
 * poles (sa_place.degree). */
int sa_pole_set_find(sa_pole_set *set, const double complex *start, int n, int skip, int all);

#endif
