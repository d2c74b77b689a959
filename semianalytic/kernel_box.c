#include "semianalytic/kernel_box.h"

#include <math.h>

/* Next to alpha^2 mu_b = eta_s one pole is huge: D4 + E = (eta_s - alpha^2 mu_b) p^2 + 2 alpha (mu_b q - i
 * (eta_b + eta_f)) p + ... = 0. The gap is a difference of nearly equal numbers. */
static double complex huge_pole(const sa_track *t, const cv_number *alpha, double q)
{
    enum { GAP_BITS = 1024 };
    mpfr_t a, mu_b, gap;
    mpfr_inits2(GAP_BITS, a, mu_b, gap, (mpfr_ptr)0);
    cv_number_get_mpfr(a, alpha);
    cv_number_get_mpfr(mu_b, &t->exact.mu_b);
    cv_number_get_mpfr(gap, &t->exact.eta_s);
    double velocity = mpfr_get_d(a, MPFR_RNDN);
    mpfr_sqr(a, a, MPFR_RNDN);
    mpfr_mul(a, a, mu_b, MPFR_RNDN);
    mpfr_sub(gap, a, gap, MPFR_RNDN);
    double difference = mpfr_get_d(gap, MPFR_RNDN);
    mpfr_clears(a, mu_b, gap, (mpfr_ptr)0);
    return velocity * CMPLX(2 * t->mu_b.m * q, -t->loss_b.m - t->loss_f.m) / difference;
}

cv_status sa_kernel_starts(double complex start[SA_STARTS_MAX], int *n, const sa_track *t,
                           const cv_number *alpha, const cv_number *q)
{
    enum { HUGE_FROM = 1000000 }; /* below, the eigenvalue solver finds it well enough */
    double q_double = cv_number_get_double(q);
    cv_status status = sa_poles_cold(start, n, t, cv_number_get_double(alpha), q_double);
    if (status != CV_OK)
        return status;
    double complex extra = huge_pole(t, alpha, q_double);
    if (isfinite(creal(extra)) && isfinite(cimag(extra)) && cabs(extra) > HUGE_FROM)
        start[(*n)++] = extra;
    return CV_OK;
}

static void add_pole(sa_box *sum, const sa_box_pole *pole, const sa_span *xi, sa_box *term)
{
    sa_box_set(term, &pole->residue);
    if (!mpfr_zero_p(xi->m)) {
        sa_box_scale(term, &pole->p, xi);
        sa_box_times_i(term, term);
        sa_box_exp(term, term);
        sa_box_mul(term, term, &pole->residue);
    }
    sa_box_add(sum, sum, term);
}

/* i (sum over the poles on the side of xi), with the sign of the side */
static void sum_of_side(sa_box *out, const sa_pole_set *set, const sa_span *xi, sa_box *term)
{
    int side = mpfr_sgn(xi->m) >= 0 ? 1 : -1;
    sa_box_zero(out);
    for (int i = 0; i < set->count; i++)
        if (set->poles[i].side == side)
            add_pole(out, &set->poles[i], xi, term);
    sa_box_times_i(out, out);
    if (side < 0)
        sa_box_neg(out, out);
}

/* i (sum over complex upper poles of the residue's imaginary part, times i) + i/2 (sum over real poles of
 * side * residue): see kernel.h */
static void undamped_sum(sa_box *out, const sa_pole_set *set, sa_box *term)
{
    sa_box_zero(out);
    for (int i = 0; i < set->count; i++) {
        const sa_box_pole *pole = &set->poles[i];
        sa_box_set(term, &pole->residue);
        if (pole->is_real) {
            sa_box_shift(term, term, -1);
        } else {
            mpfr_set_zero(mpc_realref(term->m), 1);
            term->re_rad = 0;
        }
        if (pole->side < 0)
            sa_box_neg(term, term);
        if (pole->is_real || pole->side > 0)
            sa_box_add(out, out, term);
    }
    sa_box_times_i(out, out);
}

/* K is real at q = 0, and where an undamped track has no real pole at rest */
static int is_real(const sa_pole_set *set)
{
    if (mpfr_zero_p(set->place.q.m))
        return 1;
    int real_poles = 0;
    for (int i = 0; i < set->count; i++)
        real_poles += set->poles[i].is_real;
    return set->place.undamped && mpfr_zero_p(set->place.alpha.m) && real_poles == 0;
}

void sa_kernel_box(sa_box *out, const sa_pole_set *set, const sa_span *xi)
{
    sa_box term;
    sa_box_init(&term, set->place.precision);
    if (set->place.undamped && mpfr_zero_p(xi->m))
        undamped_sum(out, set, &term);
    else
        sum_of_side(out, set, xi, &term);
    if (is_real(set)) {
        mpfr_set_zero(mpc_imagref(out->m), 1);
        out->im_rad = 0;
    }
    sa_box_clear(&term);
}

void sa_zeta_box(sa_box *out, const sa_pole_set *set)
{
    sa_span zero;
    sa_span_init(&zero, set->place.precision);
    sa_kernel_box(out, set, &zero);
    sa_box_scale(out, out, &set->place.q);
    sa_box_scale(out, out, &set->place.q);
    sa_span_clear(&zero);
}
