/* zeta of an undamped track in double precision: the limit q - i0.
 *
 * A wave with real p and Omega = q - alpha p has |residue| = |d2/d3'|. Since d3 decreases with Omega^2 where
 * d2 > 0 (det(K - Omega^2 M), whose adjugate has rank one at the pole), (d d3/dq)/(d d3/dp) has the sign of
 * -Omega d2/d3', so that with the sum of all residues being zero (kernel.h)
 *
 *     Im zeta = - (q^2/2) (sum over the real poles of sign(Omega) |d2/d3'|),
 *     Re zeta = - q^2 (sum over the poles with Im p > 0 of Im d2/d3').
 *
 * Waves with Omega > 0 carry energy away from the mass, those with Omega < 0 (anomalous Doppler effect) feed
 * it. No term of either kind cancels against Re zeta. */
#include <math.h>

#include "semianalytic/sweep.h"

/* The poles of one evaluation: real ones and one of each conjugate pair. */
typedef struct {
    int count;
    double complex start[SA_POLES_MAX];
    sa_point at[SA_POLES_MAX];
    sa_pole pole[SA_POLES_MAX];
} limit_poles;

static int is_real(double complex p)
{
    return cimag(p) == 0;
}

/* d3 has real coefficients: all of its poles are there, and no pair is there twice. */
static int complete(const limit_poles *x)
{
    enum { DEGREE = 8 };
    int n = 0;
    for (int i = 0; i < x->count; i++) {
        n += is_real(x->start[i]) ? 1 : 2;
        for (int j = 0; j < i; j++)
            if (cabs(x->start[i] - x->start[j]) <= 0x1p-40 * cabs(x->start[i]))
                return 0;
    }
    return n == DEGREE;
}

/* Newton's iteration keeps real starting values real. */
static int improve(limit_poles *x, const sa_track *t, double alpha, double q)
{
    for (int i = 0; i < x->count; i++)
        if (!sa_poles_newton(&x->start[i], &x->at[i], t, alpha, q) || !(cimag(x->start[i]) >= 0))
            return 0;
    return complete(x);
}

static void predict(limit_poles *x, const sa_limit_poles *known, double alpha, double q)
{
    x->count = known->count;
    for (int i = 0; i < known->count; i++)
        x->start[i] = known->p[i] + known->slopes[i].p_alpha * (alpha - known->alpha) +
                      known->slopes[i].p_q * (q - known->q);
}

/* A double real pole is found with half the digits: what is nearer to the axis is taken for real. */
static int find_cold(limit_poles *x, sa_sweep *state, const sa_track *t, double alpha, double q)
{
    const double noise = 0x1p-26;
    double complex all[SA_POLES_MAX];
    int n;
    state->counts.cold_starts++;
    if (sa_poles_cold(all, &n, t, alpha, q) != CV_OK)
        return 0;
    x->count = 0;
    for (int i = 0; i < n; i++) {
        int real = fabs(cimag(all[i])) <= noise * cabs(all[i]);
        if (real || cimag(all[i]) > 0)
            x->start[x->count++] = real ? creal(all[i]) : all[i];
    }
    return improve(x, t, alpha, q);
}

static void remember(sa_limit_poles *known, const limit_poles *x, const sa_track *t, double alpha, double q)
{
    known->count = x->count;
    known->alpha = alpha;
    known->q = q;
    for (int i = 0; i < x->count; i++) {
        known->p[i] = x->start[i];
        sa_matrix_slopes(&known->slopes[i], &x->at[i], t, alpha);
    }
}

/* Disjoint boxes that hold one pole each, in the upper half-plane or flat on the real axis. */
static int enclose(limit_poles *x, const sa_track *t, double alpha, double q)
{
    for (int i = 0; i < x->count; i++) {
        const sa_rect *box = &x->pole[i].box;
        if (!sa_poles_enclose(&x->pole[i], &x->at[i], t, alpha, q))
            return 0;
        if (is_real(x->start[i]) ? box->im_rad != 0 : !(box->im > box->im_rad * SA_INFLATE))
            return 0;
        for (int j = 0; j < i; j++)
            if (!sa_rect_disjoint(*box, x->pole[j].box))
                return 0;
    }
    return 1;
}

/* sign of q - alpha p for all p in the flat box; 0 when it has none */
static int doppler_sign(sa_rect box, double alpha, double q)
{
    double shift = alpha * box.re, omega = q - shift;
    double error = alpha * box.re_rad + 2 * SA_U * (fabs(shift) + fabs(omega));
    return !(fabs(omega) > error * SA_INFLATE) ? 0 : omega > 0 ? 1 : -1;
}

/* i q^2 (residues): what is summed over poles, with its derivatives without the factor */
typedef struct {
    sa_rect re, im; /* real */
    double complex total, along_q, along_alpha;
    int upper;
} sums;

/* 0 when the half-plane of the pole is not certain */
static int add_pole(sums *s, const sa_pole *pole, const sa_slopes *slopes, double alpha, double q)
{
    const sa_rect *r = &pole->residue;
    if (pole->box.im != 0) {
        s->re = sa_rect_add(s->re, (sa_rect){-r->im, 0, r->im_rad, 0});
        s->total += CMPLX(-cimag(slopes->residue), 0);
        s->along_q += CMPLX(-cimag(slopes->residue_q), 0);
        s->along_alpha += CMPLX(-cimag(slopes->residue_alpha), 0);
        s->upper++;
        return 1;
    }
    int omega = doppler_sign(pole->box, alpha, q), side = r->re > 0 ? -omega : omega;
    if (omega == 0 || !(fabs(r->re) > r->re_rad * SA_INFLATE))
        return 0;
    s->im = sa_rect_add(s->im, sa_rect_shift(*r, 0.5 * side));
    s->total += CMPLX(0, side * creal(slopes->residue) / 2);
    s->along_q += CMPLX(0, side * creal(slopes->residue_q) / 2);
    s->along_alpha += CMPLX(0, side * creal(slopes->residue_alpha) / 2);
    s->upper += side > 0;
    return 1;
}

static cv_status assemble(sa_value *out, const limit_poles *x, const sa_limit_poles *known, const sa_track *t,
                          double alpha, double q)
{
    sums s = {{0, 0, 0, 0}, {0, 0, 0, 0}, 0, 0, 0, 0};
    for (int i = 0; i < x->count; i++)
        if (!add_pole(&s, &x->pole[i], &known->slopes[i], alpha, q))
            return CV_UNDECIDED;
    if (s.upper != sa_matrix_upper_count_double(t, alpha))
        return CV_UNDECIDED;
    sa_real q2 = {q * q, SA_U * q * q};
    sa_rect re = sa_rect_scale(s.re, q2), im = sa_rect_scale(s.im, q2);
    *out = (sa_value){.re = re.re,
                      .im = im.re,
                      .re_error = re.re_rad * SA_INFLATE,
                      .im_error = im.re_rad * SA_INFLATE,
                      .d_alpha = q * q * s.along_alpha,
                      .d_q = 2 * q * s.total + q * q * s.along_q,
                      .upper_count = s.upper};
    return isfinite(out->re_error) && isfinite(out->im_error) ? CV_OK : CV_UNDECIDED;
}

cv_status sa_zeta_limit(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q)
{
    limit_poles x;
    state->counts.evaluations++;
    predict(&x, &state->limit, alpha, q);
    int found = x.count > 0 && improve(&x, t, alpha, q) && enclose(&x, t, alpha, q);
    if (!found) {
        state->limit.count = 0;
        if (!find_cold(&x, state, t, alpha, q))
            return CV_UNDECIDED;
        found = enclose(&x, t, alpha, q);
    }
    remember(&state->limit, &x, t, alpha, q);
    return found ? assemble(out, &x, &state->limit, t, alpha, q) : CV_UNDECIDED;
}
