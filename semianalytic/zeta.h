/* zeta(alpha, q) = q^2 K(0, q) / (2 pi), K of (13): what the mass sees of the track. With eta_M of (11) the
 * characteristic equation is eta_M zeta = 1 (DESIGN.md section 3 on the factor 4 in the printed (13)).
 *
 * Everything is dimensionless, (3)-(6) of Dimitrovova & Mazilu, J. Phys.: Conf. Ser. 2647 (2024) 252017.
 * Signs: e^{+ i q tau}, e^{+ i p xi}, s = i (q - alpha p), qbar = i q. Re qbar >= 0, that is Im q <= 0, is
 * the half-plane where the Laplace image exists; real q is its boundary and q may have either sign, zeta(-q)
 * = conj zeta(q). K(0, q) = 2 pi i (sum over the poles with Im p > 0 of the residues of d2/d3).
 *
 * No function here prints, aborts or keeps hidden state; a sweep must not be used by two threads at once, a
 * track may. */
#ifndef CRITVEL_SEMIANALYTIC_ZETA_H
#define CRITVEL_SEMIANALYTIC_ZETA_H

#include <complex.h>
#include <mpc.h>
#include <mpfr.h>

#include "common/params.h"

/* A track prepared for evaluation: the exact parameters and their doubles. Not modified after it is made. */
typedef struct sa_track sa_track;

/* CV_BAD_INPUT: cv_params_check refuses the parameters. The parameters are copied. */
cv_status sa_track_new(sa_track **out, const cv_params *p, cv_message *why);
void sa_track_free(sa_track *t); /* NULL allowed */

/* What a sequence of evaluations has cost. */
typedef struct {
    unsigned long evaluations;   /* in double precision */
    unsigned long cold_starts;   /* calls of the eigenvalue solver */
    unsigned long beyond_double; /* calls of _mp, and of _adaptive where double was not enough */
    long largest_precision;      /* bits; 53 when double was enough */
} sa_counts;

/* Warm start: the poles of the previous point and how they move. Any sweep may be used for any track and any
 * point; it only makes neighbours cheap. The result never depends on it by more than the stated error. */
typedef struct sa_sweep sa_sweep;

sa_sweep *sa_sweep_new(void); /* NULL when out of memory */
void sa_sweep_free(sa_sweep *s);
sa_counts sa_sweep_counts(const sa_sweep *s);

/* |true Re zeta - re| <= re_error and |true Im zeta - im| <= im_error, proven (rectangular interval
 * arithmetic, each pole in its own box with a unique zero of d3, as many boxes above the real axis as there
 * are poles). d_alpha, d_q: analytic partial derivatives d zeta / d alpha and d zeta / d q (q real or
 * complex), in double without a bound. */
typedef struct {
    double re, im, re_error, im_error;
    double complex d_alpha, d_q;
    int upper_count; /* poles with Im p > 0: 2 when alpha^2 mu_b >= eta_s, 3 when < */
} sa_value;

/* Double precision, about 2 microseconds where the sweep is warm. alpha >= 0 and q are taken as exact; the
 * parameters of the track as exact numbers. q = 0 gives zeta = 0.
 * Undamped tracks: the limit q - i0.
 * CV_UNDECIDED: double cannot separate or bound the poles here (out is then not set). CV_BAD_INPUT: alpha or q
 * not finite, alpha < 0. */
cv_status sa_zeta_double(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q);

/* The same for complex q with Im q <= 0 (Re qbar >= 0); CV_BAD_INPUT for Im q > 0. */
cv_status sa_zeta_complex(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double complex q);

/* Double where it is enough, then MPFR with growing precision, until re_error <= rel_tol |re| and im_error <=
 * rel_tol |im| (an exactly zero part counts as known); rel_tol >= 1e-15. CV_UNDECIDED: SA_PRECISION_MAX bits
 * were not enough, which happens at the branch points of an undamped track. */
cv_status sa_zeta_adaptive(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q,
                           double rel_tol);

/* What is asked of the two parts: re_error <= re_rel |re| or <= re_abs, im_error <= im_rel |im| or <=
 * im_share |zeta|. */
typedef struct {
    double re_rel, re_abs, im_rel, im_share;
} sa_need;

/* sa_zeta_adaptive with that in the place of rel_tol, of which re_rel and im_rel must be at least 1e-15 each.
 */
cv_status sa_zeta_needed(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q,
                         const sa_need *need);

enum { SA_PRECISION_MAX = 4096 };

/* zeta at the exact point (alpha, q), computed with the precision of mpc_get_prec(zeta), and proven bounds
 * for the two parts. Undamped tracks: the limit q - i0; a part that is exactly zero is 0 with bound 0.
 * CV_UNDECIDED: that precision cannot separate the poles or decide their half-plane. */
cv_status sa_zeta_mp(mpc_t zeta, mpfr_t re_error, mpfr_t im_error, sa_sweep *state, const sa_track *t,
                     const mpfr_t alpha, const mpfr_t q);

#endif
