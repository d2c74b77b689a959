#include "compare/roots_putback.h"

#include <math.h>

enum {
    GUARD_BITS = 50,   /* 15 digits beyond the bound */
    MARGIN_BITS = 16,  /* an evaluation bound this far below the allowance decides */
    MAX_WIDENINGS = 3, /* of the precision, each doubling it */
};

typedef struct {
    const cmp_root_method *method;
    void *handle;
    mpfr_prec_t bits;
    mpfr_t eta_M, error, residual, evaluation, allowance;
    mpc_t qbar, center, moved;
} trial;

static void trial_init(trial *t, const cmp_root_method *method, void *handle, mpfr_prec_t bits,
                       const cv_number *mass_ratio)
{
    t->method = method;
    t->handle = handle;
    t->bits = bits;
    mpfr_init2(t->eta_M, bits);
    mpfr_inits2(64, t->error, t->residual, t->evaluation, t->allowance, (mpfr_ptr)0);
    mpc_init2(t->qbar, bits);
    mpc_init2(t->center, bits);
    mpc_init2(t->moved, bits);
    cv_number_get_mpfr(t->eta_M, mass_ratio);
}

static void trial_clear(trial *t)
{
    mpfr_clears(t->eta_M, t->error, t->residual, t->evaluation, t->allowance, (mpfr_ptr)0);
    mpc_clear(t->qbar);
    mpc_clear(t->center);
    mpc_clear(t->moved);
}

/* z at the trial's qbar into out; its bound is added to t->evaluation. */
static cv_status evaluate(mpc_ptr out, trial *t, cv_message *why)
{
    cv_status status = t->method->zeta(t->handle, out, t->error, t->qbar, t->bits, why);
    if (status != CV_OK)
        return status;
    mpc_mul_fr(out, out, t->eta_M, MPC_RNDNN);
    mpfr_mul(t->error, t->error, t->eta_M, MPFR_RNDU);
    mpfr_add(t->evaluation, t->evaluation, t->error, MPFR_RNDU);
    return CV_OK;
}

static cv_status measure(trial *t, const cmp_root *r, cv_message *why)
{
    mpfr_set_zero(t->evaluation, 1);
    mpc_set_fr_fr(t->qbar, r->re, r->im, MPC_RNDNN);
    cv_status status = evaluate(t->center, t, why);
    if (status != CV_OK)
        return status;
    mpc_add_fr(t->qbar, t->qbar, r->error, MPC_RNDNN);
    status = evaluate(t->moved, t, why);
    if (status != CV_OK)
        return status;
    mpc_sub(t->moved, t->moved, t->center, MPC_RNDNN);
    mpc_abs(t->allowance, t->moved, MPFR_RNDU);
    mpfr_mul_ui(t->allowance, t->allowance, 9, MPFR_RNDU);
    mpfr_div_2ui(t->allowance, t->allowance, 2, MPFR_RNDU);
    mpc_sub_ui(t->center, t->center, 1, MPC_RNDNN);
    mpc_abs(t->residual, t->center, MPFR_RNDU);
    return CV_OK;
}

/* The evaluation's bound is far below what the claimed bounds allow (or one is NaN, which then fails). */
static int sharp(trial *t)
{
    mpfr_mul_2ui(t->error, t->evaluation, MARGIN_BITS, MPFR_RNDU);
    return !mpfr_greater_p(t->error, t->allowance);
}

static void judge(cmp_root_row *row, trial *t, const cmp_root *r, const char *claimant)
{
    mpfr_add(t->allowance, t->allowance, t->evaluation, MPFR_RNDU);
    if (!mpfr_lessequal_p(t->residual, t->allowance))
        cmp_verdict_worsen(
            &row->verdict, CMP_DISAGREE,
            "qbar = %.10g + %.10gi of %s does not satisfy z = 1 of %s: |z - 1| = 1e%.1f, allowed "
            "1e%.1f",
            mpfr_get_d(r->re, MPFR_RNDN), mpfr_get_d(r->im, MPFR_RNDN), claimant, t->method->name,
            cmp_log10(t->residual), cmp_log10(t->allowance));
    mpfr_max(row->residual, row->residual, t->residual, MPFR_RNDU);
    mpfr_div(t->error, t->residual, t->allowance, MPFR_RNDU);
    row->used = fmax(row->used, mpfr_get_d(t->error, MPFR_RNDU));
}

static mpfr_prec_t bits_for(const cmp_root *r)
{
    /* Im qbar = 0 for real roots */
    const mpfr_exp_t size = mpfr_zero_p(r->im) || mpfr_get_exp(r->re) > mpfr_get_exp(r->im)
                                ? mpfr_get_exp(r->re)
                                : mpfr_get_exp(r->im);
    const mpfr_exp_t claimed = size - mpfr_get_exp(r->error) + 1;
    const mpfr_prec_t wanted = (claimed > 0 ? claimed : 0) + GUARD_BITS;
    mpfr_prec_t held = mpfr_get_prec(r->re);
    held = mpfr_get_prec(r->im) > held ? mpfr_get_prec(r->im) : held;
    return wanted > held ? wanted : held;
}

static int measurable(const cmp_root *r)
{
    return mpfr_regular_p(r->re) && mpfr_number_p(r->im) && mpfr_regular_p(r->error);
}

static cv_status put_back(cmp_root_row *row, const cmp_root *r, const char *claimant,
                          const cmp_root_method *method, void *handle, const cv_number *mass_ratio,
                          cv_message *why)
{
    mpfr_prec_t bits = bits_for(r);
    for (int widening = 0; widening <= MAX_WIDENINGS; widening++, bits *= 2) {
        trial t;
        trial_init(&t, method, handle, bits, mass_ratio);
        cv_status status = measure(&t, r, why);
        const int done = status == CV_OK && sharp(&t);
        if (done)
            judge(row, &t, r, claimant);
        trial_clear(&t);
        if (done || (status != CV_OK && status != CV_UNDECIDED))
            return status;
    }
    why->text[0] = '\0';
    cmp_verdict_worsen(&row->verdict, CMP_UNDECIDED, "%s cannot evaluate z sharply enough at %.10g + %.10gi",
                       method->name, mpfr_get_d(r->re, MPFR_RNDN), mpfr_get_d(r->im, MPFR_RNDN));
    return CV_OK;
}

cv_status cmp_roots_put_back(cmp_root_row *row, const cmp_root_method *const methods[CMP_METHODS],
                             void *const handles[CMP_METHODS], const cv_number *mass_ratio, cv_message *why)
{
    cv_status status = CV_OK;
    for (int claimant = 0; claimant < CMP_METHODS; claimant++)
        for (int m = 0; status == CV_OK && m < CMP_METHODS; m++)
            if (row->by[claimant] != NULL && measurable(row->by[claimant]))
                status = put_back(row, row->by[claimant], methods[claimant]->name, methods[m], handles[m],
                                  mass_ratio, why);
    return status;
}
