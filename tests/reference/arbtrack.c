#include "arbtrack.h"

#include <stdlib.h>
#include <string.h>

const char *const ref_param_names[REF_PARAMS] = {"mu_s",  "mu_b",  "kappa_p", "kappa_b", "eta_s",
                                                 "eta_N", "eta_p", "eta_b",   "eta_f"};

void ref_track_init(ref_track *t)
{
    for (int i = 0; i < REF_PARAMS; i++)
        fmpq_init(&t->value[i]);
}

void ref_track_clear(ref_track *t)
{
    for (int i = 0; i < REF_PARAMS; i++)
        fmpq_clear(&t->value[i]);
}

int ref_track_undamped(const ref_track *t)
{
    return fmpq_is_zero(&t->value[REF_ETA_P]) && fmpq_is_zero(&t->value[REF_ETA_B]) &&
           fmpq_is_zero(&t->value[REF_ETA_F]);
}

int ref_decimal(fmpq_t out, const char *text)
{
    char digits[1024];
    size_t n = 0;
    long exponent = 0;
    const char *c = text;
    int point = 0;
    if (strlen(text) >= sizeof digits)
        return -1;
    if (*c == '-')
        digits[n++] = *c++;
    for (; (*c >= '0' && *c <= '9') || (*c == '.' && !point); c++) {
        if (*c == '.')
            point = 1;
        else
            digits[n++] = *c;
        exponent -= point && *c != '.';
    }
    digits[n] = '\0';
    if (*c == 'e') {
        char *end;
        exponent += strtol(c + 1, &end, 10);
        c = end;
    }
    if (*c != '\0' || labs(exponent) > 1000 || fmpz_set_str(fmpq_numref(out), digits, 10) != 0)
        return -1;
    fmpz_t ten;
    fmpz_init_set_ui(ten, 10);
    fmpz_pow_ui(ten, ten, (ulong)labs(exponent));
    fmpz_one(fmpq_denref(out));
    if (exponent < 0)
        fmpz_set(fmpq_denref(out), ten);
    else
        fmpz_mul(fmpq_numref(out), fmpq_numref(out), ten);
    fmpq_canonicalise(out);
    fmpz_clear(ten);
    return 0;
}

/* s = i q - i alpha p */
static void jet_s(ref_jet *s, const arb_t alpha, const arb_t q)
{
    acb_t c;
    acb_init(c);
    arb_set(acb_imagref(c), q);
    acb_poly_set_coeff_acb(s->v, 0, c);
    arb_neg(acb_imagref(c), alpha);
    acb_poly_set_coeff_acb(s->v, 1, c);
    acb_set_si_si(c, 0, -1);
    acb_poly_set_coeff_acb(s->a, 1, c);
    acb_onei(c);
    acb_poly_set_coeff_acb(s->q, 0, c);
    acb_clear(c);
}

static void param(arb_t out, const ref_track *t, int which, slong prec)
{
    arb_set_fmpq(out, &t->value[which], prec);
}

/* stiffness + 2 damping s */
static void jet_spring(ref_jet *out, const ref_track *t, const ref_jet *s, int damping, int stiffness,
                       slong prec)
{
    arb_t c;
    arb_init(c);
    param(c, t, damping, prec);
    arb_mul_2exp_si(c, c, 1);
    acb_poly_set(out->v, s->v);
    acb_poly_set(out->a, s->a);
    acb_poly_set(out->q, s->q);
    ref_jet_scale(out, c, prec);
    if (stiffness >= 0)
        param(c, t, stiffness, prec);
    else
        arb_one(c);
    ref_jet_add_coeff(out, 0, c, prec);
    arb_clear(c);
}

/* The five different entries of the symmetric tridiagonal matrix (7): e[0], e[1], e[2] on the diagonal,
 * e[3] = D2, e[4] = D4 (their signs do not matter in the determinant). */
static void entries(ref_jet e[5], const ref_track *t, const ref_jet *s, int degree_drops, slong prec)
{
    arb_t c;
    ref_jet s2, f;
    arb_init(c);
    ref_jet_init(&s2);
    ref_jet_init(&f);
    ref_jet_mul(&s2, s, s, prec);
    jet_spring(&e[3], t, s, REF_ETA_P, REF_KAPPA_P, prec);
    jet_spring(&e[4], t, s, REF_ETA_B, REF_KAPPA_B, prec);
    jet_spring(&f, t, s, REF_ETA_F, -1, prec);

    ref_jet_add(&e[0], &s2, &e[3], prec);
    arb_set_d(c, 0.25);
    ref_jet_add_coeff(&e[0], 4, c, prec);
    param(c, t, REF_ETA_N, prec);
    arb_neg(c, c);
    ref_jet_add_coeff(&e[0], 2, c, prec);

    ref_jet_add(&e[1], &e[1], &s2, prec);
    param(c, t, REF_MU_S, prec);
    ref_jet_scale(&e[1], c, prec);
    ref_jet_add(&e[1], &e[1], &e[3], prec);
    ref_jet_add(&e[1], &e[1], &e[4], prec);

    ref_jet_add(&e[2], &e[2], &s2, prec);
    param(c, t, REF_MU_B, prec);
    ref_jet_scale(&e[2], c, prec);
    ref_jet_add(&e[2], &e[2], &e[4], prec);
    ref_jet_add(&e[2], &e[2], &f, prec);
    param(c, t, REF_ETA_S, prec);
    ref_jet_add_coeff(&e[2], 2, c, prec);
    if (degree_drops)
        acb_poly_set_coeff_si(e[2].v, 2, 0);
    ref_jet_clear(&s2);
    ref_jet_clear(&f);
    arb_clear(c);
}

/* d2 = e1 e2 - D4^2, d3 = e0 d2 - D2^2 e2, from the entries of matrix (7) */
void ref_determinants(ref_jet *d2, ref_jet *d3, const ref_track *t, const arb_t alpha, const arb_t q,
                      int degree_drops, slong prec)
{
    ref_jet s, e[5];
    ref_jet_init(&s);
    for (int i = 0; i < 5; i++)
        ref_jet_init(&e[i]);
    jet_s(&s, alpha, q);
    entries(e, t, &s, degree_drops, prec);
    ref_jet_mul(d2, &e[1], &e[2], prec);
    ref_jet_mul(&e[4], &e[4], &e[4], prec);
    ref_jet_sub(d2, d2, &e[4], prec);
    ref_jet_mul(d3, &e[0], d2, prec);
    ref_jet_mul(&e[3], &e[3], &e[3], prec);
    ref_jet_mul(&e[3], &e[3], &e[2], prec);
    ref_jet_sub(d3, d3, &e[3], prec);
    for (int i = 0; i < 5; i++)
        ref_jet_clear(&e[i]);
    ref_jet_clear(&s);
}
