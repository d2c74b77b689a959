#include "compare/putback.h"

#include <math.h>

enum {
    GUARD_BITS = 50,   /* 15 digits beyond the bound */
    MARGIN_BITS = 16,  /* an evaluation bound this far below the allowance decides */
    MAX_WIDENINGS = 4, /* of the precision, each doubling it */
};

/* Values at the claimed point and at its neighbours one bound away, all at one precision. */
typedef struct {
    mpfr_t eta_M, alpha, q;
    mpc_t center, moved;
    mpfr_t re_error, im_error;
    mpfr_t residual, evaluation, allowance, scratch;
} workspace;

static void workspace_init(workspace *w, mpfr_prec_t bits)
{
    mpfr_inits2(bits, w->eta_M, w->alpha, w->q, w->residual, w->evaluation, w->allowance, w->scratch,
                (mpfr_ptr)0);
    mpfr_inits2(53, w->re_error, w->im_error, (mpfr_ptr)0);
    mpc_init2(w->center, bits);
    mpc_init2(w->moved, bits);
}

static void workspace_clear(workspace *w)
{
    mpfr_clears(w->eta_M, w->alpha, w->q, w->residual, w->evaluation, w->allowance, w->scratch, (mpfr_ptr)0);
    mpfr_clears(w->re_error, w->im_error, (mpfr_ptr)0);
    mpc_clear(w->center);
    mpc_clear(w->moved);
}

/* out = |eta_M (x - center)|, or |eta_M x - 1| where x is the center itself */
static void distance(mpfr_ptr out, workspace *w, mpc_srcptr x, int from_one)
{
    mpc_t d;
    mpc_init2(d, mpfr_get_prec(out));
    if (!from_one)
        mpc_sub(d, x, w->center, MPC_RNDNN);
    mpc_mul_fr(d, from_one ? x : d, w->eta_M, MPC_RNDNN);
    if (from_one)
        mpc_sub_ui(d, d, 1, MPC_RNDNN);
    mpc_abs(out, d, MPFR_RNDU);
    mpc_clear(d);
}

/* zeta at the working point into out; its bound, times eta_M, is added to w->evaluation. */
static cv_status evaluate(mpc_ptr out, workspace *w, const cmp_method *method, void *handle, mpfr_prec_t bits,
                          cv_message *why)
{
    cv_status status = method->zeta(handle, out, w->re_error, w->im_error, w->alpha, w->q, bits, why);
    if (status != CV_OK)
        return status;
    mpfr_add(w->scratch, w->re_error, w->im_error, MPFR_RNDU);
    mpfr_mul(w->scratch, w->scratch, w->eta_M, MPFR_RNDU);
    mpfr_add(w->evaluation, w->evaluation, w->scratch, MPFR_RNDU);
    return CV_OK;
}

/* Adds |eta_M (zeta at the moved point - zeta at the center)| to the allowance. */
static cv_status add_slope(workspace *w, const cmp_method *method, void *handle, mpfr_prec_t bits,
                           cv_message *why)
{
    cv_status status = evaluate(w->moved, w, method, handle, bits, why);
    if (status != CV_OK)
        return status;
    distance(w->scratch, w, w->moved, 0);
    mpfr_add(w->allowance, w->allowance, w->scratch, MPFR_RNDU);
    return CV_OK;
}

/* Residual and allowance of one transition at one precision. */
static cv_status measure(workspace *w, const cmp_transition *t, const cmp_method *method, void *handle,
                         const cv_number *mass_ratio, mpfr_prec_t bits, cv_message *why)
{
    cv_number_get_mpfr(w->eta_M, mass_ratio);
    mpfr_set_zero(w->evaluation, 1);
    mpfr_set_zero(w->allowance, 1);
    mpfr_set(w->alpha, t->alpha, MPFR_RNDN);
    mpfr_set(w->q, t->q, MPFR_RNDN);
    cv_status status = evaluate(w->center, w, method, handle, bits, why);
    if (status != CV_OK)
        return status;
    distance(w->residual, w, w->center, 1);
    mpfr_add(w->alpha, t->alpha, t->alpha_error, MPFR_RNDN);
    status = add_slope(w, method, handle, bits, why);
    if (status != CV_OK)
        return status;
    mpfr_set(w->alpha, t->alpha, MPFR_RNDN);
    mpfr_add(w->q, t->q, t->q_error, MPFR_RNDN);
    status = add_slope(w, method, handle, bits, why);
    mpfr_mul_ui(w->allowance, w->allowance, 9, MPFR_RNDU);
    mpfr_div_2ui(w->allowance, w->allowance, 3, MPFR_RNDU);
    return status;
}

static mpfr_prec_t bits_for(mpfr_srcptr x, mpfr_srcptr error)
{
    mpfr_exp_t claimed = mpfr_get_exp(x) - mpfr_get_exp(error) + 1;
    mpfr_prec_t wanted = (claimed > 0 ? claimed : 0) + GUARD_BITS;
    return wanted > mpfr_get_prec(x) ? wanted : mpfr_get_prec(x);
}

static int measurable(const cmp_transition *t)
{
    return mpfr_regular_p(t->alpha) && mpfr_regular_p(t->q) && mpfr_regular_p(t->alpha_error) &&
           mpfr_regular_p(t->q_error);
}

static void judge_residual(cmp_verdict *v, workspace *w, const cmp_transition *t, const char *claimant,
                           const cmp_method *method)
{
    mpfr_add(w->allowance, w->allowance, w->evaluation, MPFR_RNDU);
    if (!mpfr_lessequal_p(w->residual, w->allowance))
        cmp_verdict_worsen(
            v, CMP_DISAGREE,
            "alpha = %.15g of %s does not satisfy z = 1 of %s: |z - 1| = 1e%.1f, allowed 1e%.1f",
            mpfr_get_d(t->alpha, MPFR_RNDN), claimant, method->name, cmp_log10(w->residual),
            cmp_log10(w->allowance));
}

static void keep_worst(cmp_residual *worst, workspace *w)
{
    mpfr_max(worst->residual, worst->residual, w->residual, MPFR_RNDU);
    mpfr_div(w->scratch, w->residual, w->allowance, MPFR_RNDU);
    worst->used = fmax(worst->used, mpfr_get_d(w->scratch, MPFR_RNDU));
}

/* The evaluation's bound is far below what the claimed bounds allow (or both are NaN, which then fails). */
static int sharp(workspace *w)
{
    mpfr_mul_2ui(w->scratch, w->evaluation, MARGIN_BITS, MPFR_RNDU);
    return !mpfr_greater_p(w->scratch, w->allowance);
}

static cv_status put_back_one(cmp_verdict *v, cmp_residual *worst, const cmp_transition *t,
                              const char *claimant, const cmp_method *method, void *handle,
                              const cv_number *mass_ratio, cv_message *why)
{
    mpfr_prec_t bits = bits_for(t->alpha, t->alpha_error);
    if (bits_for(t->q, t->q_error) > bits)
        bits = bits_for(t->q, t->q_error);
    for (int widening = 0; widening <= MAX_WIDENINGS; widening++, bits *= 2) {
        workspace w;
        workspace_init(&w, bits);
        cv_status status = measure(&w, t, method, handle, mass_ratio, bits, why);
        const int done = status == CV_OK && sharp(&w);
        if (done) {
            judge_residual(v, &w, t, claimant, method);
            keep_worst(worst, &w);
        }
        workspace_clear(&w);
        if (done || (status != CV_OK && status != CV_UNDECIDED))
            return status;
    }
    why->text[0] = '\0';
    cmp_verdict_worsen(v, CMP_UNDECIDED, "%s cannot evaluate z sharply enough at alpha = %.15g", method->name,
                       mpfr_get_d(t->alpha, MPFR_RNDN));
    return CV_OK;
}

cv_status cmp_put_back(cmp_verdict *v, cmp_residual *worst, const cmp_list *list, const char *claimant,
                       const cmp_method *method, void *handle, const cv_number *mass_ratio, cv_message *why)
{
    for (size_t i = 0; i < list->count; i++) {
        if (!measurable(&list->items[i]))
            continue;
        cv_status status = put_back_one(v, worst, &list->items[i], claimant, method, handle, mass_ratio, why);
        if (status != CV_OK)
            return status;
    }
    return CV_OK;
}
