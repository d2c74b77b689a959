/* zeta beyond double precision: sa_zeta_mp and sa_zeta_adaptive of zeta.h. */
#include <math.h>

#include "semianalytic/kernel_box.h"
#include "semianalytic/sweep.h"

enum { FIRST_PRECISION = 127 };

/* All poles of an undamped track next to those of the double evaluation. */
static int find_warm_limit(sa_pole_set *set, sa_sweep *state, const sa_track *t, double alpha, double q)
{
    const sa_limit_poles *known = &state->limit;
    double complex start[2 * SA_POLES_MAX];
    sa_value ignored;
    int n = 0;
    if (known->count == 0 || known->alpha != alpha || known->q != q)
        sa_zeta_double(&ignored, state, t, alpha, q);
    if (known->count == 0 || known->alpha != alpha || known->q != q)
        return 0;
    for (int i = 0; i < known->count; i++) {
        start[n++] = known->p[i];
        if (cimag(known->p[i]) != 0)
            start[n++] = conj(known->p[i]);
    }
    return sa_pole_set_find(set, start, n, 0, 1);
}

/* The upper poles next to those of the double evaluation at the rounded point, which also warms the sweep.
 * What it left undecided is a good start all the same. */
static int find_warm(sa_pole_set *set, sa_sweep *state, const sa_track *t)
{
    sa_value ignored;
    double alpha = mpfr_get_d(set->place.alpha.m, MPFR_RNDN), q = mpfr_get_d(set->place.q.m, MPFR_RNDN);
    if (t->undamped)
        return find_warm_limit(set, state, t, alpha, q);
    if (state->count == 0 || state->alpha != alpha || state->q != q)
        sa_zeta_double(&ignored, state, t, alpha, q);
    return state->count == set->place.upper_count && state->alpha == alpha && state->q == q &&
           sa_pole_set_find(set, state->p, state->count, 0, 0);
}

static cv_status find_cold(sa_pole_set *set, sa_sweep *state, const sa_track *t, const cv_number *alpha,
                           const cv_number *q)
{
    double complex start[SA_STARTS_MAX];
    int n;
    state->counts.cold_starts++;
    cv_status status = sa_kernel_starts(start, &n, t, alpha, q);
    if (status != CV_OK)
        return status;
    return sa_pole_set_find(set, start, n, 1, t->undamped) ? CV_OK : CV_UNDECIDED;
}

/* Certified poles at (alpha, q) in set, whose precision is given. */
static cv_status solve(sa_pole_set *set, sa_sweep *state, const sa_track *t, const mpfr_t alpha,
                       const mpfr_t q)
{
    cv_number exact_alpha, exact_q;
    cv_status status = CV_OK;
    cv_number_init(&exact_alpha);
    cv_number_init(&exact_q);
    mpfr_get_q(exact_alpha.factor, alpha);
    mpfr_get_q(exact_q.factor, q);
    sa_place_set(&set->place, t, &exact_alpha, &exact_q);
    if (set->place.precision > state->counts.largest_precision)
        state->counts.largest_precision = set->place.precision;
    if (!find_warm(set, state, t))
        status = find_cold(set, state, t, &exact_alpha, &exact_q);
    cv_number_clear(&exact_alpha);
    cv_number_clear(&exact_q);
    return status;
}

static int usable(const mpfr_t alpha, const mpfr_t q)
{
    return mpfr_number_p(alpha) && mpfr_sgn(alpha) >= 0 && mpfr_number_p(q);
}

cv_status sa_zeta_mp(mpc_t zeta, mpfr_t re_error, mpfr_t im_error, sa_sweep *state, const sa_track *t,
                     const mpfr_t alpha, const mpfr_t q)
{
    if (!usable(alpha, q))
        return CV_BAD_INPUT;
    sa_pole_set set;
    sa_box value;
    mpfr_prec_t precision = mpc_get_prec(zeta);
    sa_pole_set_init(&set, t, precision);
    sa_box_init(&value, precision);
    state->counts.beyond_double++;
    cv_status status = solve(&set, state, t, alpha, q);
    if (status == CV_OK) {
        sa_zeta_box(&value, &set);
        mpc_set(zeta, value.m, MPC_RNDNN);
        mpfr_set_ld(re_error, value.re_rad * SA_BOX_INFLATE, MPFR_RNDU);
        mpfr_set_ld(im_error, value.im_rad * SA_BOX_INFLATE, MPFR_RNDU);
    }
    sa_box_clear(&value);
    sa_pole_set_clear(&set);
    return status;
}

static int satisfied(const sa_value *v, const sa_need *need)
{
    return (v->re_error <= need->re_rel * fabs(v->re) || v->re_error <= need->re_abs) &&
           (v->im_error <= need->im_rel * fabs(v->im) || v->im_error <= need->im_share * hypot(v->re, v->im));
}

/* One part of a box as a double with its bound: the midpoint is rounded once more. */
static void round_part(double *part, double *error, const mpfr_t mid, long double radius)
{
    *part = mpfr_get_d(mid, MPFR_RNDN);
    *error = (double)(radius * SA_BOX_INFLATE) * (1 + 4 * SA_U) + 2 * SA_U * fabs(*part);
    if (mpfr_zero_p(mid) && radius == 0)
        *error = 0;
}

/* The part of a residue, or of its slope, that counts in i (sum), see kernel.h: all of it with damping, else
 * what the sum over both half-planes leaves. */
static double complex share(const sa_box_pole *pole, int undamped, double complex residue)
{
    if (!undamped)
        return pole->side > 0 ? residue : 0;
    if (pole->is_real)
        return pole->side * creal(residue) / 2;
    return pole->side > 0 ? CMPLX(0, cimag(residue)) : 0;
}

/* Analytic slopes from the poles in double. */
static void slopes(sa_value *out, const sa_pole_set *set, const sa_track *t, double alpha, double q)
{
    double complex total = 0, along_q = 0, along_alpha = 0;
    for (int i = 0; i < set->count; i++) {
        sa_point m;
        sa_slopes at;
        const sa_box_pole *pole = &set->poles[i];
        const mpc_ptr p = (const mpc_ptr)pole->p.m;
        sa_matrix_point(&m, t, alpha, q,
                        CMPLX(mpfr_get_d(mpc_realref(p), MPFR_RNDN), mpfr_get_d(mpc_imagref(p), MPFR_RNDN)));
        sa_matrix_slopes(&at, &m, t, alpha);
        total += share(pole, t->undamped, at.residue);
        along_q += share(pole, t->undamped, at.residue_q);
        along_alpha += share(pole, t->undamped, at.residue_alpha);
    }
    out->d_alpha = CMPLX(0, q * q) * along_alpha;
    out->d_q = CMPLX(0, 1) * (2 * q * total + q * q * along_q);
    out->upper_count = set->place.upper_count;
}

/* One precision of the adaptive evaluation; CV_OK also when the bounds are still too wide. */
static cv_status evaluate_at(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q,
                             mpfr_prec_t precision)
{
    sa_pole_set set;
    sa_box value;
    mpfr_t exact_alpha, exact_q;
    sa_pole_set_init(&set, t, precision);
    sa_box_init(&value, precision);
    mpfr_init_set_d(exact_alpha, alpha, MPFR_RNDN);
    mpfr_init_set_d(exact_q, q, MPFR_RNDN);
    cv_status status = solve(&set, state, t, exact_alpha, exact_q);
    if (status == CV_OK) {
        sa_zeta_box(&value, &set);
        round_part(&out->re, &out->re_error, mpc_realref(value.m), value.re_rad);
        round_part(&out->im, &out->im_error, mpc_imagref(value.m), value.im_rad);
        slopes(out, &set, t, alpha, q);
    }
    mpfr_clear(exact_alpha);
    mpfr_clear(exact_q);
    sa_box_clear(&value);
    sa_pole_set_clear(&set);
    return status;
}

cv_status sa_zeta_needed(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q,
                         const sa_need *need)
{
    cv_status status = sa_zeta_double(out, state, t, alpha, q);
    if ((status == CV_OK && satisfied(out, need)) || status == CV_BAD_INPUT)
        return status;
    state->counts.beyond_double++;
    for (mpfr_prec_t bits = FIRST_PRECISION; bits <= SA_PRECISION_MAX; bits = 3 * (bits + 1) / 2 - 1) {
        status = evaluate_at(out, state, t, alpha, q, bits);
        if (status == CV_FAILED || (status == CV_OK && satisfied(out, need)))
            return status;
    }
    return CV_UNDECIDED;
}

cv_status sa_zeta_adaptive(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q,
                           double rel_tol)
{
    const sa_need need = {.re_rel = rel_tol, .im_rel = rel_tol};
    return sa_zeta_needed(out, state, t, alpha, q, &need);
}
