/* Poles of K's integrand d2/d3 in p, (13): the zeros of the determinant of (7), in double precision. */
#ifndef CRITVEL_SEMIANALYTIC_POLES_H
#define CRITVEL_SEMIANALYTIC_POLES_H

#include "semianalytic/matrix.h"

enum { SA_POLES_MAX = 8, SA_UPPER_MAX = 3 };

/* All poles, without a bound: generalised eigenvalues of the linearised matrix (7) (LAPACK zggev, infinite
 * ones left out), each improved by Newton steps on d3 that keep away from those already found. In no order.
 * CV_FAILED: LAPACK reports an error. */
cv_status sa_poles_cold(double complex out[SA_POLES_MAX], int *count, const sa_track *t, double alpha,
                        double complex q);

/* Newton's iteration from *p; m is the matrix at the result. 1 when it converged (relative step below 6e-5 in
 * both parts before the last step), without any bound. */
int sa_poles_newton(double complex *p, sa_point *m, const sa_track *t, double alpha, double complex q);

/* A box that holds exactly one zero of d3 (interval Newton), and the residue of d2/d3 there. */
typedef struct {
    sa_rect box, residue;
} sa_pole;

/* Tries boxes around p, where m is the matrix; 1 when a box is certified, 0 when double cannot. */
int sa_poles_enclose(sa_pole *out, const sa_point *m, const sa_track *t, double alpha, double complex q);

/* 1 when the n boxes are pairwise disjoint and lie in Im p > 0: then they hold n different upper poles */
int sa_poles_separate(const sa_pole *poles, int n);

#endif
