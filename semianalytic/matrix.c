#include "semianalytic/matrix.h"

#include <stdlib.h>

/* The double nearest to x and how far it may be off: correctly rounded if rational, else within one unit in
 * the last place. */
static sa_real real_of(const cv_number *x)
{
    double m = cv_number_get_double(x);
    mpq_t nearest;
    mpq_init(nearest);
    mpq_set_d(nearest, m);
    int exact = cv_number_is_rational(x) && mpq_equal(nearest, x->factor);
    mpq_clear(nearest);
    return (sa_real){m, exact ? 0 : 2 * SA_U * fabs(m)};
}

static int in_double_range(sa_real x)
{
    return x.m == 0 || (fabs(x.m) >= 1e-20 && fabs(x.m) <= 1e20);
}

static void round_parameters(sa_track *t)
{
    struct {
        sa_real *to;
        const cv_number *from;
    } all[] = {
        {&t->mu_s, &t->exact.mu_s},       {&t->mu_b, &t->exact.mu_b},    {&t->kappa_p, &t->exact.kappa_p},
        {&t->kappa_b, &t->exact.kappa_b}, {&t->eta_s, &t->exact.eta_s},  {&t->eta_N, &t->exact.eta_N},
        {&t->loss_p, &t->exact.eta_p},    {&t->loss_b, &t->exact.eta_b}, {&t->loss_f, &t->exact.eta_f},
    };
    t->double_range = 1;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        *all[i].to = real_of(all[i].from);
        t->double_range &= in_double_range(*all[i].to);
    }
    sa_real *losses[] = {&t->loss_p, &t->loss_b, &t->loss_f};
    for (size_t i = 0; i < 3; i++)
        *losses[i] = (sa_real){2 * losses[i]->m, 2 * losses[i]->r};
}

cv_status sa_track_new(sa_track **out, const cv_params *p, cv_message *why)
{
    cv_status status = cv_params_check(p, why);
    if (status != CV_OK)
        return status;
    sa_track *t = calloc(1, sizeof *t);
    if (t == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_params_init(&t->exact);
    cv_params_set(&t->exact, p);
    t->undamped = cv_params_undamped(p);
    round_parameters(t);
    *out = t;
    return CV_OK;
}

void sa_track_free(sa_track *t)
{
    if (t == NULL)
        return;
    cv_params_clear(&t->exact);
    free(t);
}

int sa_matrix_upper_count(int *degree, const sa_track *t, const cv_number *alpha)
{
    cv_number ballast;
    cv_number_init(&ballast);
    cv_number_mul(&ballast, alpha, alpha);
    cv_number_mul(&ballast, &ballast, &t->exact.mu_b);
    int order = cv_number_compare(&ballast, &t->exact.eta_s);
    cv_number_clear(&ballast);
    if (degree != NULL && cv_number_sign(alpha) == 0)
        *degree = order < 0 ? 6 : 4;
    else if (degree != NULL)
        *degree = order == 0 ? 7 : 8;
    return order < 0 ? 3 : 2;
}

int sa_matrix_upper_count_double(const sa_track *t, double alpha)
{
    double gap = alpha * alpha * t->mu_b.m - t->eta_s.m;
    if (fabs(gap) > 16 * SA_U * t->eta_s.m)
        return gap < 0 ? 3 : 2;
    cv_number exact;
    cv_number_init(&exact);
    mpq_set_d(exact.factor, alpha);
    int count = sa_matrix_upper_count(NULL, t, &exact);
    cv_number_clear(&exact);
    return count;
}

static void elements(sa_point *m, const sa_track *t, double alpha)
{
    double complex s = m->s, p = m->p, s2 = s * s, p2 = p * p, s_p = CMPLX(0, -alpha), ss_p = 2 * s * s_p;
    m->d[SA_RAIL] = p2 * p2 / 4 + s2 - t->eta_N.m * p2;
    m->d[SA_PAD] = t->loss_p.m * s + t->kappa_p.m;
    m->d[SA_SLEEPER] = t->mu_s.m * s2;
    m->d[SA_BALLAST] = t->loss_b.m * s + t->kappa_b.m;
    m->d[SA_FOUNDATION] = t->mu_b.m * s2 + t->loss_f.m * s + 1 + t->eta_s.m * p2;
    m->d_p[SA_RAIL] = p2 * p + ss_p - 2 * t->eta_N.m * p;
    m->d_p[SA_PAD] = t->loss_p.m * s_p;
    m->d_p[SA_SLEEPER] = t->mu_s.m * ss_p;
    m->d_p[SA_BALLAST] = t->loss_b.m * s_p;
    m->d_p[SA_FOUNDATION] = t->mu_b.m * ss_p + t->loss_f.m * s_p + 2 * t->eta_s.m * p;
}

void sa_matrix_point(sa_point *m, const sa_track *t, double alpha, double complex q, double complex p)
{
    m->p = p;
    m->s = CMPLX(alpha * cimag(p) - cimag(q), creal(q) - alpha * creal(p));
    elements(m, t, alpha);
    const double complex *d = m->d;
    double complex c = d[SA_BALLAST] + d[SA_FOUNDATION];
    double complex force = d[SA_SLEEPER] * c + d[SA_BALLAST] * d[SA_FOUNDATION];
    double complex rail_c = d[SA_RAIL] * c, pad_c = d[SA_PAD] * c;
    double complex outer = d[SA_RAIL] * (d[SA_PAD] + d[SA_SLEEPER]) + d[SA_PAD] * d[SA_SLEEPER];
    m->c = c;
    m->w[SA_RAIL] = pad_c + force;
    m->w[SA_PAD] = rail_c + force;
    m->w[SA_SLEEPER] = rail_c + pad_c;
    m->w[SA_BALLAST] = (d[SA_RAIL] + d[SA_PAD]) * d[SA_FOUNDATION] + outer;
    m->w[SA_FOUNDATION] = outer + (d[SA_RAIL] + d[SA_PAD]) * d[SA_BALLAST];
    m->det = d[SA_RAIL] * m->w[SA_RAIL] + d[SA_PAD] * force;
    m->det_p = 0;
    for (int k = 0; k < SA_ELEMENTS; k++)
        m->det_p += m->d_p[k] * m->w[k];
}

/* sum over j of (second derivative of d3 in elements j and k) * change[j], for all k: the change of the
 * weights */
static void weight_change(double complex out[SA_ELEMENTS], const sa_point *m,
                          const double complex change[SA_ELEMENTS])
{
    const double complex *d = m->d, *x = change;
    double complex rail_pad = d[SA_RAIL] + d[SA_PAD], c = m->c;
    double complex rail_ballast = d[SA_PAD] + d[SA_SLEEPER] + d[SA_FOUNDATION];
    double complex rail_foundation = d[SA_PAD] + d[SA_SLEEPER] + d[SA_BALLAST];
    double complex pad_ballast = d[SA_RAIL] + d[SA_SLEEPER] + d[SA_FOUNDATION];
    double complex pad_foundation = d[SA_RAIL] + d[SA_SLEEPER] + d[SA_BALLAST];
    out[SA_RAIL] =
        c * (x[SA_PAD] + x[SA_SLEEPER]) + rail_ballast * x[SA_BALLAST] + rail_foundation * x[SA_FOUNDATION];
    out[SA_PAD] =
        c * (x[SA_RAIL] + x[SA_SLEEPER]) + pad_ballast * x[SA_BALLAST] + pad_foundation * x[SA_FOUNDATION];
    out[SA_SLEEPER] = c * (x[SA_RAIL] + x[SA_PAD]) + rail_pad * (x[SA_BALLAST] + x[SA_FOUNDATION]);
    out[SA_BALLAST] =
        rail_ballast * x[SA_RAIL] + pad_ballast * x[SA_PAD] + rail_pad * (x[SA_SLEEPER] + x[SA_FOUNDATION]);
    out[SA_FOUNDATION] = rail_foundation * x[SA_RAIL] + pad_foundation * x[SA_PAD] +
                         rail_pad * (x[SA_SLEEPER] + x[SA_BALLAST]);
}

/* Changes of the elements, and of their p-derivatives, when s, p and ds/dp = -i alpha change by ds, dp, ds_p.
 */
static void element_change(double complex change[SA_ELEMENTS], double complex change_p[SA_ELEMENTS],
                           const sa_point *m, const sa_track *t, double alpha, double complex ds,
                           double complex dp, double complex ds_p)
{
    double complex s = m->s, p = m->p, s_p = CMPLX(0, -alpha), ss = 2 * s * ds,
                   ss_p = 2 * (ds * s_p + s * ds_p);
    change[SA_RAIL] = ss + (p * p * p - 2 * t->eta_N.m * p) * dp;
    change[SA_PAD] = t->loss_p.m * ds;
    change[SA_SLEEPER] = t->mu_s.m * ss;
    change[SA_BALLAST] = t->loss_b.m * ds;
    change[SA_FOUNDATION] = t->mu_b.m * ss + t->loss_f.m * ds + 2 * t->eta_s.m * p * dp;
    change_p[SA_RAIL] = (3 * p * p - 2 * t->eta_N.m) * dp + ss_p;
    change_p[SA_PAD] = t->loss_p.m * ds_p;
    change_p[SA_SLEEPER] = t->mu_s.m * ss_p;
    change_p[SA_BALLAST] = t->loss_b.m * ds_p;
    change_p[SA_FOUNDATION] = t->mu_b.m * ss_p + t->loss_f.m * ds_p + 2 * t->eta_s.m * dp;
}

/* The pole's and its residue's derivative along the direction in which s changes by s_t at fixed p and ds/dp
 * by s_pt: dp/dt = -(d d3/dt)/d3', then the quotient rule on d2/d3' with p following. slope: the sum of
 * (d D[k]/ds) w[k], the derivative of d3 in s. */
static void slope_along(double complex *p_t, double complex *residue_t, const sa_point *m, const sa_track *t,
                        double alpha, double complex slope, double complex s_t, double complex s_pt)
{
    double complex change[SA_ELEMENTS], change_p[SA_ELEMENTS], dw[SA_ELEMENTS];
    double complex dp = -slope * s_t / m->det_p, ds = s_t + CMPLX(0, -alpha) * dp, ddet_p = 0;
    element_change(change, change_p, m, t, alpha, ds, dp, s_pt);
    weight_change(dw, m, change);
    for (int k = 0; k < SA_ELEMENTS; k++)
        ddet_p += change_p[k] * m->w[k] + m->d_p[k] * dw[k];
    *p_t = dp;
    *residue_t = (dw[SA_RAIL] - m->w[SA_RAIL] / m->det_p * ddet_p) / m->det_p;
}

/* A pole runs to infinity next to the shear speed. By the time its slopes overflow, at |p| ~ 1e20, its
 * residue, a sum of terms below p^-7, has no share in zeta or in the slopes of zeta. */
static double complex unless_overflown(double complex slope)
{
    return isfinite(creal(slope)) && isfinite(cimag(slope)) ? slope : 0;
}

void sa_matrix_slopes(sa_slopes *out, const sa_point *m, const sa_track *t, double alpha)
{
    const double complex *w = m->w;
    double complex slope =
        2 * m->s * (w[SA_RAIL] + t->mu_s.m * w[SA_SLEEPER] + t->mu_b.m * w[SA_FOUNDATION]) +
        t->loss_p.m * w[SA_PAD] + t->loss_b.m * w[SA_BALLAST] + t->loss_f.m * w[SA_FOUNDATION];
    out->residue = w[SA_RAIL] / m->det_p;
    slope_along(&out->p_q, &out->residue_q, m, t, alpha, slope, CMPLX(0, 1), 0);
    slope_along(&out->p_alpha, &out->residue_alpha, m, t, alpha, slope, CMPLX(cimag(m->p), -creal(m->p)),
                CMPLX(0, -1));
    out->residue = unless_overflown(out->residue);
    out->residue_q = unless_overflown(out->residue_q);
    out->residue_alpha = unless_overflown(out->residue_alpha);
}

/* s = i (q - alpha p), alpha and q exact */
static sa_rect enclose_s(double alpha, double complex q, sa_rect p)
{
    sa_real exact = {alpha, 0};
    sa_rect p_alpha = sa_rect_scale(p, exact);
    return sa_rect_times_i(sa_rect_add(sa_rect_exact(q), sa_rect_shift(p_alpha, -1)));
}

void sa_matrix_enclose(sa_enclosure *m, const sa_track *t, double alpha, double complex q, sa_rect p)
{
    sa_real minus_N = {-t->eta_N.m, t->eta_N.r};
    m->p = p;
    m->s = enclose_s(alpha, q, p);
    m->s2 = sa_rect_sqr(m->s);
    m->p2 = sa_rect_sqr(p);
    sa_rect *d = m->d, beam = sa_rect_add(sa_rect_shift(sa_rect_sqr(m->p2), 0.25), m->s2);
    d[SA_RAIL] = t->eta_N.m == 0 ? beam : sa_rect_add(beam, sa_rect_scale(m->p2, minus_N));
    d[SA_PAD] = sa_rect_add_real(sa_rect_scale(m->s, t->loss_p), t->kappa_p);
    d[SA_SLEEPER] = sa_rect_scale(m->s2, t->mu_s);
    d[SA_BALLAST] = sa_rect_add_real(sa_rect_scale(m->s, t->loss_b), t->kappa_b);
    d[SA_FOUNDATION] = sa_rect_add_real(
        sa_rect_add(sa_rect_scale(m->s2, t->mu_b), sa_rect_scale(m->s, t->loss_f)), (sa_real){1, 0});
    if (t->eta_s.m != 0)
        d[SA_FOUNDATION] = sa_rect_add(d[SA_FOUNDATION], sa_rect_scale(m->p2, t->eta_s));
    m->c = sa_rect_add(d[SA_BALLAST], d[SA_FOUNDATION]);
    m->force = sa_rect_add(sa_rect_mul(d[SA_SLEEPER], m->c), sa_rect_mul(d[SA_BALLAST], d[SA_FOUNDATION]));
    m->w[SA_RAIL] = sa_rect_add(sa_rect_mul(d[SA_PAD], m->c), m->force);
    m->det = sa_rect_add(sa_rect_mul(d[SA_RAIL], m->w[SA_RAIL]), sa_rect_mul(d[SA_PAD], m->force));
}

static void enclose_weights(sa_enclosure *m)
{
    const sa_rect *d = m->d;
    sa_rect rail_c = sa_rect_mul(d[SA_RAIL], m->c), rail_pad = sa_rect_add(d[SA_RAIL], d[SA_PAD]);
    sa_rect outer = sa_rect_add(sa_rect_mul(d[SA_RAIL], sa_rect_add(d[SA_PAD], d[SA_SLEEPER])),
                                sa_rect_mul(d[SA_PAD], d[SA_SLEEPER]));
    m->w[SA_PAD] = sa_rect_add(rail_c, m->force);
    m->w[SA_SLEEPER] = sa_rect_mul(rail_pad, m->c);
    m->w[SA_BALLAST] = sa_rect_add(sa_rect_mul(rail_pad, d[SA_FOUNDATION]), outer);
    m->w[SA_FOUNDATION] = sa_rect_add(outer, sa_rect_mul(rail_pad, d[SA_BALLAST]));
}

void sa_matrix_enclose_slope(sa_enclosure *m, const sa_track *t, double alpha)
{
    enclose_weights(m);
    sa_real minus_2_alpha = {-2 * alpha, 0}, minus_alpha = {-alpha, 0};
    sa_rect ss_p = sa_rect_times_i(sa_rect_scale(m->s, minus_2_alpha)); /* d(s^2)/dp */
    sa_rect rail = sa_rect_add(sa_rect_mul(m->p2, m->p), ss_p);
    if (t->eta_N.m != 0)
        rail = sa_rect_add(rail, sa_rect_scale(m->p, (sa_real){-2 * t->eta_N.m, 2 * t->eta_N.r}));
    sa_rect sum = sa_rect_mul(rail, m->w[SA_RAIL]);
    sa_rect inertia =
        sa_rect_add(sa_rect_scale(m->w[SA_SLEEPER], t->mu_s), sa_rect_scale(m->w[SA_FOUNDATION], t->mu_b));
    sum = sa_rect_add(sum, sa_rect_mul(ss_p, inertia));
    sa_rect loss = sa_rect_add(
        sa_rect_add(sa_rect_scale(m->w[SA_PAD], t->loss_p), sa_rect_scale(m->w[SA_BALLAST], t->loss_b)),
        sa_rect_scale(m->w[SA_FOUNDATION], t->loss_f));
    sum = sa_rect_add(sum, sa_rect_times_i(sa_rect_scale(loss, minus_alpha)));
    if (t->eta_s.m != 0) {
        sa_rect shear = sa_rect_scale(m->p, (sa_real){2 * t->eta_s.m, 2 * t->eta_s.r});
        sum = sa_rect_add(sum, sa_rect_mul(shear, m->w[SA_FOUNDATION]));
    }
    m->det_p = sum;
}

/* The second and third column matter where d2 nearly vanishes: waves that run in the sleepers and the ballast
 * and hardly move the rail. There d2 is a difference, D2^2 C / (D1 + D2) is not. */
sa_rect sa_matrix_enclose_residue(const sa_enclosure *m)
{
    const sa_rect *d = m->d;
    sa_rect best = m->w[SA_RAIL];
    if (!(sa_rect_spread(best) <= 0x1p-43)) {
        sa_rect pad2 = sa_rect_sqr(d[SA_PAD]);
        sa_rect second = sa_rect_div(sa_rect_mul(pad2, m->c), sa_rect_add(d[SA_RAIL], d[SA_PAD]));
        sa_rect third = sa_rect_div(sa_rect_mul(pad2, sa_rect_sqr(d[SA_BALLAST])), m->w[SA_FOUNDATION]);
        if (!(sa_rect_spread(best) <= sa_rect_spread(second)))
            best = second;
        if (!(sa_rect_spread(best) <= sa_rect_spread(third)))
            best = third;
    }
    return sa_rect_div(best, m->det_p);
}
