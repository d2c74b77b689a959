/* The kernel K(xi, q) of (13) at complex q, in double precision, and its continuation beyond the half-plane
 * Re qbar >= 0 (Im q <= 0, qbar = i q) where the Laplace image exists. Dimensionless; signs as in zeta.h.
 *
 * In Im q < 0 no pole p of d2/d3 is real: two or three (sa_matrix_upper_count) lie in Im p > 0 and give K.
 * The inversion (14) runs along a line in Im q < 0 and may be deformed only through values that continue the
 * integrand. K is continued by taking the poles along: those that came from Im p > 0 stay "upper", also after
 * they have crossed the real p axis, for crossing it does nothing to an integral whose path in p gives way.
 * Singular are only the q where a pole from above meets one from below: there are the branch points of K, of
 * the kind 1/sqrt(q - q_b). Cuts run from them vertically, towards Im q = +infinity, where e^{i q tau}
 * decays; so the value at q is the one reached from Re q, straight upwards.
 *
 * The literal sum over Im p > 0 on the spot is another function in Im q > 0: it jumps where a pole is real,
 * on the curves q(p), p real, that span all Re q. The path of (14) cannot pass them, so a zero of
 * 1 - eta_M zeta in that sense beyond them (case 1, eta = 0.05, eta_M = 100, alpha = 0.5: qbar = -0.002726 +
 * 0.209815i) is no pole of the integrand, while a zero of the continuation (-0.002128 + 0.209785i) is: it
 * adds a term e^{qbar tau} to the response at every fixed xi, and it is also the eigenvalue of the
 * discretised beam (tests/test_outside_beam.c). */
#ifndef CRITVEL_SEMIANALYTIC_LAPLACE_H
#define CRITVEL_SEMIANALYTIC_LAPLACE_H

#include "semianalytic/poles.h"

typedef struct {
    const sa_track *track;
    double alpha;
    double complex q;
    int count; /* poles */
    double complex p[SA_POLES_MAX];
    sa_slopes slopes[SA_POLES_MAX];
    int upper[SA_POLES_MAX]; /* 1: continued from Im p > 0 */
} sa_sheet;

/* All poles at Im q <= 0 by eigenvalues; the upper ones are those with the largest Im p. CV_UNDECIDED: not as
 * many different poles or not as many with Im p > 0 as there must be (always for real q and an undamped
 * track). CV_FAILED: LAPACK. */
cv_status sa_sheet_start(sa_sheet *s, const sa_track *t, double alpha, double complex q);

/* For large |q|, Im q < 0: the four poles of the beam alone, from p^2 = +-2 (q - alpha p). Those left out, p
 * about q/alpha on sleepers and ballast, have residues smaller by a factor of order kappa_p^(3/2) (alpha/q)^8
 * q^(3/2), and eigenvalue solvers lose the four beside them. CV_UNDECIDED: Newton's iteration fails. */
cv_status sa_sheet_far(sa_sheet *s, const sa_track *t, double alpha, double complex q);

/* Follows all poles along the straight line from s->q to q. CV_UNDECIDED: two come too close to be told
 * apart, that is the line passes a branch point. */
cv_status sa_sheet_move(sa_sheet *s, double complex q);

/* The continuation at any q with the cuts described above: start at min(Im q, 0), then move. */
cv_status sa_sheet_at(sa_sheet *s, const sa_track *t, double alpha, double complex q);

/* zeta = q^2 K(0, q) / (2 pi) and its derivative in q (may be NULL) */
double complex sa_sheet_zeta(double complex *zeta_q, const sa_sheet *s);

/* K(xi, q): the upper poles for xi >= 0, the others for xi < 0 */
double complex sa_sheet_kernel(const sa_sheet *s, double xi);

#endif
