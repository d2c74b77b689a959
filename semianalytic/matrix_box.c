#include "semianalytic/matrix_box.h"

#include <math.h>

void sa_place_init(sa_place *x, const sa_track *t, mpfr_prec_t precision)
{
    struct {
        sa_span *to;
        const cv_number *from;
    } all[] = {
        {&x->mu_s, &t->exact.mu_s},       {&x->mu_b, &t->exact.mu_b},    {&x->kappa_p, &t->exact.kappa_p},
        {&x->kappa_b, &t->exact.kappa_b}, {&x->eta_s, &t->exact.eta_s},  {&x->eta_N, &t->exact.eta_N},
        {&x->loss_p, &t->exact.eta_p},    {&x->loss_b, &t->exact.eta_b}, {&x->loss_f, &t->exact.eta_f},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        sa_span_init(all[i].to, precision);
        sa_span_set_number(all[i].to, all[i].from);
    }
    sa_span *losses[] = {&x->loss_p, &x->loss_b, &x->loss_f};
    for (size_t i = 0; i < 3; i++) {
        mpfr_mul_2ui(losses[i]->m, losses[i]->m, 1, MPFR_RNDN);
        losses[i]->r *= 2;
    }
    sa_span_init(&x->alpha, precision);
    sa_span_init(&x->q, precision);
    sa_span_init(&x->q_im, precision);
    sa_span_init(&x->one, precision);
    mpfr_set_ui(x->one.m, 1, MPFR_RNDN);
    x->precision = precision;
    x->undamped = t->undamped;
}

void sa_place_clear(sa_place *x)
{
    sa_span *all[] = {&x->mu_s,   &x->mu_b,   &x->kappa_p, &x->kappa_b, &x->eta_s, &x->eta_N, &x->loss_p,
                      &x->loss_b, &x->loss_f, &x->alpha,   &x->q,       &x->q_im,  &x->one};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        sa_span_clear(all[i]);
}

void sa_place_set(sa_place *x, const sa_track *t, const cv_number *alpha, const cv_number *q)
{
    sa_span_set_number(&x->alpha, alpha);
    sa_span_set_number(&x->q, q);
    mpfr_set_zero(x->q_im.m, 1);
    x->q_im.r = 0;
    x->upper_count = sa_matrix_upper_count(&x->degree, t, alpha);
}

void sa_box_matrix_init(sa_box_matrix *m, mpfr_prec_t precision)
{
    for (int i = 0; i < SA_MATRIX_BOXES; i++)
        sa_box_init(&m->all[i], precision);
}

void sa_box_matrix_clear(sa_box_matrix *m)
{
    for (int i = 0; i < SA_MATRIX_BOXES; i++)
        sa_box_clear(&m->all[i]);
}

/* to += factor * a, with a temporary */
static void add_scaled(sa_box *to, const sa_box *a, const sa_span *factor, sa_box *temporary)
{
    if (mpfr_zero_p(factor->m))
        return;
    sa_box_scale(temporary, a, factor);
    sa_box_add(to, to, temporary);
}

/* to = a b + c d */
static void products(sa_box *to, const sa_box *a, const sa_box *b, const sa_box *c, const sa_box *d,
                     sa_box *temporary)
{
    sa_box_mul(temporary, c, d);
    sa_box_mul(to, a, b);
    sa_box_add(to, to, temporary);
}

static void set_elements(sa_box_matrix *m, const sa_place *x)
{
    sa_box *d = m->d, *temporary = &m->temporary[0];
    sa_box_sqr(&d[SA_RAIL], &m->p2);
    sa_box_shift(&d[SA_RAIL], &d[SA_RAIL], -2);
    sa_box_add(&d[SA_RAIL], &d[SA_RAIL], &m->s2);
    sa_box_neg(&m->temporary[1], &m->p2);
    add_scaled(&d[SA_RAIL], &m->temporary[1], &x->eta_N, temporary);
    sa_box_set_real(&d[SA_PAD], &x->kappa_p);
    add_scaled(&d[SA_PAD], &m->s, &x->loss_p, temporary);
    sa_box_scale(&d[SA_SLEEPER], &m->s2, &x->mu_s);
    sa_box_set_real(&d[SA_BALLAST], &x->kappa_b);
    add_scaled(&d[SA_BALLAST], &m->s, &x->loss_b, temporary);
    sa_box_scale(&d[SA_FOUNDATION], &m->s2, &x->mu_b);
    sa_box_add_real(&d[SA_FOUNDATION], &d[SA_FOUNDATION], &x->one);
    add_scaled(&d[SA_FOUNDATION], &m->s, &x->loss_f, temporary);
    add_scaled(&d[SA_FOUNDATION], &m->p2, &x->eta_s, temporary);
}

void sa_box_matrix_set(sa_box_matrix *m, const sa_place *x)
{
    sa_box *d = m->d, *temporary = &m->temporary[0];
    sa_box_scale(&m->s, &m->p, &x->alpha);
    sa_box_neg(&m->s, &m->s);
    sa_box_add_real(&m->s, &m->s, &x->q);
    sa_box_times_i(&m->s, &m->s);
    if (!mpfr_zero_p(x->q_im.m)) {
        sa_box_neg(&m->s, &m->s);
        sa_box_add_real(&m->s, &m->s, &x->q_im);
        sa_box_neg(&m->s, &m->s);
    }
    sa_box_sqr(&m->s2, &m->s);
    sa_box_sqr(&m->p2, &m->p);
    set_elements(m, x);
    sa_box_add(&m->c, &d[SA_BALLAST], &d[SA_FOUNDATION]);
    products(&m->force, &d[SA_SLEEPER], &m->c, &d[SA_BALLAST], &d[SA_FOUNDATION], temporary);
    sa_box_mul(&m->w[SA_RAIL], &d[SA_PAD], &m->c);
    sa_box_add(&m->w[SA_RAIL], &m->w[SA_RAIL], &m->force);
    products(&m->det, &d[SA_RAIL], &m->w[SA_RAIL], &d[SA_PAD], &m->force, temporary);
}

static void set_weights(sa_box_matrix *m)
{
    sa_box *d = m->d, *w = m->w, *rail_pad = &m->temporary[1], *outer = &m->temporary[2];
    sa_box_add(&w[SA_FOUNDATION], &d[SA_PAD], &d[SA_SLEEPER]);
    products(outer, &d[SA_RAIL], &w[SA_FOUNDATION], &d[SA_PAD], &d[SA_SLEEPER], &m->temporary[0]);
    sa_box_add(rail_pad, &d[SA_RAIL], &d[SA_PAD]);
    sa_box_mul(&w[SA_SLEEPER], rail_pad, &m->c);
    sa_box_mul(&w[SA_BALLAST], rail_pad, &d[SA_FOUNDATION]);
    sa_box_add(&w[SA_BALLAST], &w[SA_BALLAST], outer);
    sa_box_mul(&w[SA_FOUNDATION], rail_pad, &d[SA_BALLAST]);
    sa_box_add(&w[SA_FOUNDATION], &w[SA_FOUNDATION], outer);
    sa_box_mul(&w[SA_PAD], &d[SA_RAIL], &m->c);
    sa_box_add(&w[SA_PAD], &w[SA_PAD], &m->force);
}

/* The derivative of d3 in s at fixed p, by elements: masses 2 s, dashpots 1. */
static void slope_in_s(sa_box *to, sa_box_matrix *m, const sa_place *x)
{
    sa_box *w = m->w, *temporary = &m->temporary[0];
    sa_box_set(to, &w[SA_RAIL]);
    add_scaled(to, &w[SA_SLEEPER], &x->mu_s, temporary);
    add_scaled(to, &w[SA_FOUNDATION], &x->mu_b, temporary);
    sa_box_mul(to, to, &m->s);
    sa_box_shift(to, to, 1);
    add_scaled(to, &w[SA_PAD], &x->loss_p, temporary);
    add_scaled(to, &w[SA_BALLAST], &x->loss_b, temporary);
    add_scaled(to, &w[SA_FOUNDATION], &x->loss_f, temporary);
}

/* det_p = -i alpha (d d3/ds) + p ((p^2 - 2 eta_N) d2 + 2 eta_s w[SA_FOUNDATION]) */
void sa_box_matrix_slope(sa_box_matrix *m, const sa_place *x)
{
    sa_box *direct = &m->temporary[1], *through_s = &m->temporary[2], *twice = &m->temporary[3];
    set_weights(m);
    sa_box_neg(twice, &m->w[SA_RAIL]);
    sa_box_shift(twice, twice, 1);
    sa_box_mul(direct, &m->p2, &m->w[SA_RAIL]);
    add_scaled(direct, twice, &x->eta_N, &m->temporary[0]);
    sa_box_shift(twice, &m->w[SA_FOUNDATION], 1);
    add_scaled(direct, twice, &x->eta_s, &m->temporary[0]);
    sa_box_mul(direct, direct, &m->p);
    slope_in_s(through_s, m, x);
    sa_box_scale(through_s, through_s, &x->alpha);
    sa_box_times_i(through_s, through_s);
    sa_box_sub(&m->det_p, direct, through_s);
}

/* See sa_matrix_enclose_residue: adj_1k^2 / adj_kk for k = 1, 2, 3, where d2 alone is not accurate enough. */
int sa_box_matrix_residue(sa_box *residue, sa_box_matrix *m)
{
    sa_box *pad2 = &m->temporary[0], *other = &m->temporary[1], *below = &m->temporary[2];
    long double enough = ldexpl(1, 20 - (int)mpc_get_prec(m->p.m));
    sa_box_set(residue, &m->w[SA_RAIL]);
    if (!(sa_box_spread(residue) <= enough)) {
        sa_box_sqr(pad2, &m->d[SA_PAD]);
        sa_box_mul(other, pad2, &m->c);
        sa_box_add(below, &m->d[SA_RAIL], &m->d[SA_PAD]);
        if (sa_box_div(other, other, below) && !(sa_box_spread(residue) <= sa_box_spread(other)))
            sa_box_set(residue, other);
        sa_box_sqr(other, &m->d[SA_BALLAST]);
        sa_box_mul(other, other, pad2);
        if (sa_box_div(other, other, &m->w[SA_FOUNDATION]) &&
            !(sa_box_spread(residue) <= sa_box_spread(other)))
            sa_box_set(residue, other);
    }
    return sa_box_div(residue, residue, &m->det_p);
}

int sa_box_matrix_side(sa_box_matrix *m, const sa_place *x)
{
    sa_box *slope_q = &m->temporary[1];
    slope_in_s(slope_q, m, x);
    sa_box_times_i(slope_q, slope_q);
    int sign = mpfr_sgn(mpc_realref(slope_q->m)) * mpfr_sgn(mpc_realref(m->det_p.m));
    if (!(sa_magnitude(mpc_realref(slope_q->m)) / 2 > slope_q->re_rad * SA_BOX_INFLATE) ||
        !(sa_magnitude(mpc_realref(m->det_p.m)) / 2 > m->det_p.re_rad * SA_BOX_INFLATE))
        return 0;
    return sign;
}
