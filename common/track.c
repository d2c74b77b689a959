#include "common/track.h"

#include <stddef.h>

/* A member of a structure of numbers with its name and the sign it must have. */
typedef struct {
    const char *name;
    size_t offset;
    int least_sign; /* 1: > 0, 0: >= 0 */
} rule;

#define RULE(member, sign)                                                                                   \
    {                                                                                                        \
#member, offsetof(cv_track, member), sign                                                            \
    }

/* In the order of offset, so that initialising and clearing can walk it; N may have either sign. */
static const rule rules[] = {RULE(EI, 1),  RULE(m, 1),   RULE(k_p, 1), RULE(c_p, 0), RULE(m_s, 1),
                             RULE(k_b, 1), RULE(c_b, 0), RULE(m_b, 1), RULE(k_s, 0), RULE(k_f, 1),
                             RULE(c_f, 0), RULE(N, -1),  RULE(M, 0),   RULE(P, 0)};

enum { RULES = sizeof rules / sizeof rules[0] };

static cv_number *member(cv_track *t, const rule *r)
{
    return (cv_number *)(void *)((char *)t + r->offset);
}

static const cv_number *const_member(const cv_track *t, const rule *r)
{
    return (const cv_number *)(const void *)((const char *)t + r->offset);
}

void cv_track_init(cv_track *t)
{
    for (size_t i = 0; i < RULES; ++i)
        cv_number_init(member(t, &rules[i]));
}

void cv_track_clear(cv_track *t)
{
    for (size_t i = 0; i < RULES; ++i)
        cv_number_clear(member(t, &rules[i]));
}

static cv_status check(const cv_track *t, cv_message *why)
{
    for (size_t i = 0; i < RULES; ++i)
        if (cv_number_sign(const_member(t, &rules[i])) < rules[i].least_sign)
            return cv_fail(why, CV_BAD_INPUT, "%s must be %s 0", rules[i].name,
                           rules[i].least_sign > 0 ? ">" : ">=");
    if (!cv_number_is_rational(&t->EI) || !cv_number_is_rational(&t->m) || !cv_number_is_rational(&t->k_f))
        return cv_fail(why, CV_BAD_INPUT, "EI, m and k_f must be rational");
    return CV_OK;
}

/* to = sqrt(a b) = ((a b)^2)^(1/4), a and b rational */
static void root_of_product(cv_number *to, const cv_number *a, const cv_number *b)
{
    mpq_t square, one;
    mpq_inits(square, one, NULL);
    mpq_mul(square, a->factor, b->factor);
    mpq_mul(square, square, square);
    mpq_set_ui(one, 1, 1);
    cv_number_set_root(to, square, one);
    mpq_clears(square, one, NULL);
}

/* to = 2 sqrt(a b), the denominators of (6) */
static void twice_root(cv_number *to, const cv_number *a, const cv_number *b)
{
    root_of_product(to, a, b);
    mpq_mul_2exp(to->factor, to->factor, 1);
}

/* chi of (3) */
static void chi_exact(cv_number *to, const cv_track *t)
{
    mpq_t four_EI;
    mpq_init(four_EI);
    mpq_mul_2exp(four_EI, t->EI.factor, 2);
    cv_number_set_root(to, t->k_f.factor, four_EI);
    mpq_clear(four_EI);
}

cv_status cv_track_to_params(cv_params *out, const cv_track *t, cv_message *why)
{
    const cv_status status = check(t, why);
    if (status != CV_OK)
        return status;
    cv_number_div(&out->mu_s, &t->m_s, &t->m);
    cv_number_div(&out->mu_b, &t->m_b, &t->m);
    cv_number_div(&out->kappa_p, &t->k_p, &t->k_f);
    cv_number_div(&out->kappa_b, &t->k_b, &t->k_f);
    cv_number scale;
    cv_number_init(&scale);
    twice_root(&scale, &t->m, &t->k_f);
    cv_number_div(&out->eta_p, &t->c_p, &scale);
    cv_number_div(&out->eta_b, &t->c_b, &scale);
    cv_number_div(&out->eta_f, &t->c_f, &scale);
    twice_root(&scale, &t->k_f, &t->EI);
    cv_number_div(&out->eta_N, &t->N, &scale);
    cv_number_div(&out->eta_s, &t->k_s, &scale);
    cv_number_clear(&scale);
    return CV_OK;
}

cv_status cv_track_mass_ratio(cv_number *eta_M, const cv_track *t, cv_message *why)
{
    const cv_status status = check(t, why);
    if (status != CV_OK)
        return status;
    cv_number ratio;
    cv_number_init(&ratio);
    cv_number_div(&ratio, &t->M, &t->m);
    chi_exact(eta_M, t);
    cv_number_mul(eta_M, eta_M, &ratio);
    cv_number_clear(&ratio);
    return CV_OK;
}

void cv_track_chi(mpfr_t chi, const cv_track *t)
{
    cv_number x;
    cv_number_init(&x);
    chi_exact(&x, t);
    cv_number_get_mpfr(chi, &x);
    cv_number_clear(&x);
}

/* (4 k_f EI / m^2)^(1/4) */
void cv_track_reference_velocity(mpfr_t v_ref, const cv_track *t)
{
    cv_number v;
    cv_number_init(&v);
    mpq_t n, d;
    mpq_inits(n, d, NULL);
    mpq_mul(n, t->k_f.factor, t->EI.factor);
    mpq_mul_2exp(n, n, 2);
    mpq_mul(d, t->m.factor, t->m.factor);
    cv_number_set_root(&v, n, d);
    cv_number_get_mpfr(v_ref, &v);
    mpq_clears(n, d, NULL);
    cv_number_clear(&v);
}

/* P chi / (2 k_f) */
void cv_track_static_deflection(mpfr_t w_st, const cv_track *t)
{
    cv_number w;
    cv_number_init(&w);
    chi_exact(&w, t);
    cv_number_mul(&w, &w, &t->P);
    cv_number_div(&w, &w, &t->k_f);
    mpq_div_2exp(w.factor, w.factor, 1);
    cv_number_get_mpfr(w_st, &w);
    cv_number_clear(&w);
}

/* (5) and (6) solved for the physical values; out has EI, m and k_f already. */
static void scale_params(cv_track *out, const cv_params *p)
{
    cv_number_mul(&out->m_s, &p->mu_s, &out->m);
    cv_number_mul(&out->m_b, &p->mu_b, &out->m);
    cv_number_mul(&out->k_p, &p->kappa_p, &out->k_f);
    cv_number_mul(&out->k_b, &p->kappa_b, &out->k_f);
    cv_number scale;
    cv_number_init(&scale);
    twice_root(&scale, &out->m, &out->k_f);
    cv_number_mul(&out->c_p, &p->eta_p, &scale);
    cv_number_mul(&out->c_b, &p->eta_b, &scale);
    cv_number_mul(&out->c_f, &p->eta_f, &scale);
    twice_root(&scale, &out->k_f, &out->EI);
    cv_number_mul(&out->N, &p->eta_N, &scale);
    cv_number_mul(&out->k_s, &p->eta_s, &scale);
    cv_number_clear(&scale);
}

static void set_mass(cv_track *out, const cv_number *eta_M)
{
    cv_number chi;
    cv_number_init(&chi);
    chi_exact(&chi, out);
    cv_number_mul(&out->M, eta_M, &out->m);
    cv_number_div(&out->M, &out->M, &chi);
    cv_number_clear(&chi);
}

cv_status cv_track_from_params(cv_track *out, const cv_params *p, const cv_number *eta_M, const cv_number *EI,
                               const cv_number *m, const cv_number *k_f, cv_message *why)
{
    if (cv_number_sign(EI) <= 0 || cv_number_sign(m) <= 0 || cv_number_sign(k_f) <= 0)
        return cv_fail(why, CV_BAD_INPUT, "EI, m and k_f must be > 0");
    if (!cv_number_is_rational(EI) || !cv_number_is_rational(m) || !cv_number_is_rational(k_f))
        return cv_fail(why, CV_BAD_INPUT, "EI, m and k_f must be rational");
    cv_number_set(&out->EI, EI);
    cv_number_set(&out->m, m);
    cv_number_set(&out->k_f, k_f);
    scale_params(out, p);
    mpq_set_ui(out->P.factor, 0, 1);
    mpq_set_ui(out->P.radicand, 1, 1);
    mpq_set_ui(out->M.factor, 0, 1);
    mpq_set_ui(out->M.radicand, 1, 1);
    if (eta_M != NULL)
        set_mass(out, eta_M);
    return check(out, why);
}
