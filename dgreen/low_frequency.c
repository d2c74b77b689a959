/* S0 and S1 of dgreen/asymptotes.h. */
#include <math.h>

#include "dgreen/asymptotes.h"
#include "dgreen/roots_mp.h"

#define RND MPFR_RNDN
#define CRND MPC_RNDNN

/* A real polynomial in lambda, ascending, and its derivative by qbar, both at qbar = 0 */
typedef struct {
    int degree;
    mpfr_t at[DG_DEGREE + 1], rate[DG_DEGREE + 1];
} expansion;

static void expansion_init(expansion *e, mpfr_prec_t bits)
{
    e->degree = 0;
    for (int i = 0; i <= DG_DEGREE; i++) {
        mpfr_inits2(bits, e->at[i], e->rate[i], (mpfr_ptr)NULL);
        mpfr_set_zero(e->at[i], 1);
        mpfr_set_zero(e->rate[i], 1);
    }
}

static void expansion_clear(expansion *e)
{
    for (int i = 0; i <= DG_DEGREE; i++)
        mpfr_clears(e->at[i], e->rate[i], (mpfr_ptr)NULL);
}

/* to += x */
static void add(expansion *to, const expansion *x)
{
    to->degree = to->degree > x->degree ? to->degree : x->degree;
    for (int i = 0; i <= x->degree; i++) {
        mpfr_add(to->at[i], to->at[i], x->at[i], RND);
        mpfr_add(to->rate[i], to->rate[i], x->rate[i], RND);
    }
}

/* to += factor x y */
static void add_product(expansion *to, unsigned long factor, const expansion *x, const expansion *y)
{
    mpfr_t t;
    mpfr_init2(t, mpfr_get_prec(to->at[0]));
    to->degree = to->degree > x->degree + y->degree ? to->degree : x->degree + y->degree;
    for (int i = 0; i <= x->degree; i++)
        for (int k = 0; k <= y->degree; k++) {
            mpfr_mul(t, x->at[i], y->at[k], RND);
            mpfr_mul_ui(t, t, factor, RND);
            mpfr_add(to->at[i + k], to->at[i + k], t, RND);
            mpfr_fmma(t, x->at[i], y->rate[k], x->rate[i], y->at[k], RND);
            mpfr_mul_ui(t, t, factor, RND);
            mpfr_add(to->rate[i + k], to->rate[i + k], t, RND);
        }
    mpfr_clear(t);
}

/* e = c0 + c1 s + c2 s^2 with s = qbar - alpha lambda; NULL for a coefficient that is zero */
static void set_layer(expansion *e, mpfr_srcptr alpha, mpfr_srcptr c0, mpfr_srcptr c1, mpfr_srcptr c2)
{
    e->degree = 2;
    if (c0 != NULL)
        mpfr_set(e->at[0], c0, RND);
    if (c1 != NULL) {
        mpfr_set(e->rate[0], c1, RND);
        mpfr_mul(e->at[1], c1, alpha, RND);
        mpfr_neg(e->at[1], e->at[1], RND);
    }
    if (c2 != NULL) {
        mpfr_mul(e->rate[1], c2, alpha, RND);
        mpfr_mul(e->at[2], e->rate[1], alpha, RND);
        mpfr_mul_si(e->rate[1], e->rate[1], -2, RND);
    }
}

enum { BEAM, PAD, SLEEPER, BALLAST, FOUNDATION, BOTH, INNER, R, DELTA, EXPANSIONS };

/* The entries of (17) in the notation of dgreen/operator.h: A, D2, D3, D4, F */
static void set_layers(expansion *e, const dg_constants *constants, mpfr_srcptr alpha)
{
    const mpfr_t *v = constants->value;
    mpfr_t c1, one;
    mpfr_init2(c1, mpfr_get_prec(alpha));
    mpfr_init2(one, mpfr_get_prec(alpha));
    mpfr_set_ui(one, 1, RND);
    mpfr_mul_2ui(c1, one, 2, RND);
    set_layer(&e[BEAM], alpha, NULL, NULL, c1);
    e[BEAM].degree = 4;
    mpfr_set_ui(e[BEAM].at[4], 1, RND);
    mpfr_mul_2ui(c1, v[DG_ETA_N], 2, RND);
    mpfr_add(e[BEAM].at[2], e[BEAM].at[2], c1, RND);
    mpfr_mul_2ui(c1, v[DG_ETA_P], 1, RND);
    set_layer(&e[PAD], alpha, v[DG_KAPPA_P], c1, NULL);
    set_layer(&e[SLEEPER], alpha, NULL, NULL, v[DG_MU_S]);
    mpfr_mul_2ui(c1, v[DG_ETA_B], 1, RND);
    set_layer(&e[BALLAST], alpha, v[DG_KAPPA_B], c1, NULL);
    mpfr_mul_2ui(c1, v[DG_ETA_F], 1, RND);
    set_layer(&e[FOUNDATION], alpha, one, c1, v[DG_MU_B]);
    mpfr_sub(e[FOUNDATION].at[2], e[FOUNDATION].at[2], v[DG_ETA_S], RND);
    mpfr_clear(c1);
    mpfr_clear(one);
}

/* R = (D2 + D3) C + D4 F with C = D4 + F, and Delta = A R + 4 D2 (D3 C + D4 F) */
static void set_expansions(expansion *e, const dg_constants *constants, mpfr_srcptr alpha)
{
    set_layers(e, constants, alpha);
    add(&e[BOTH], &e[BALLAST]);
    add(&e[BOTH], &e[FOUNDATION]);
    add_product(&e[INNER], 1, &e[SLEEPER], &e[BOTH]);
    add_product(&e[INNER], 1, &e[BALLAST], &e[FOUNDATION]);
    add(&e[R], &e[INNER]);
    add_product(&e[R], 1, &e[PAD], &e[BOTH]);
    add_product(&e[DELTA], 1, &e[BEAM], &e[R]);
    add_product(&e[DELTA], 4, &e[PAD], &e[INNER]);
}

/* The polynomial c at lambda and its first two derivatives */
static void horner(mpc_t value[3], const mpfr_t *c, int degree, mpc_srcptr lambda)
{
    for (int k = 0; k < 3; k++)
        mpc_set_ui(value[k], 0, CRND);
    for (int i = degree; i >= 0; i--)
        for (int k = 2; k >= 0; k--) {
            mpc_mul(value[k], value[k], lambda, CRND);
            if (k > 0)
                mpc_add(value[k], value[k], value[k - 1], CRND);
            else
                mpc_add_fr(value[0], value[0], c[i], CRND);
        }
    mpc_mul_2ui(value[2], value[2], 1, CRND); /* the scheme gives half of it */
}

typedef struct {
    mpc_t lambda, slope, part, r[3], r_rate[3], delta[3], delta_rate[3];
} scratch;

static void scratch_each(scratch *w, mpfr_prec_t bits)
{
    mpc_t *all[] = {&w->lambda, &w->slope, &w->part};
    mpc_t *sets[] = {w->r, w->r_rate, w->delta, w->delta_rate};
    for (int i = 0; i < 3; i++) {
        if (bits)
            mpc_init2(*all[i], bits);
        else
            mpc_clear(*all[i]);
        for (int k = 0; k < 4; k++) {
            if (bits)
                mpc_init2(sets[k][i], bits);
            else
                mpc_clear(sets[k][i]);
        }
    }
}

/* Adds the root w->lambda to S0 and S1: their real parts, the imaginary ones cancel with the conjugate root.
 */
static void add_root(mpfr_ptr s0, mpfr_ptr s1, scratch *w, const expansion *e)
{
    horner(w->r, e[R].at, e[R].degree, w->lambda);
    horner(w->r_rate, e[R].rate, e[R].degree, w->lambda);
    horner(w->delta, e[DELTA].at, e[DELTA].degree, w->lambda);
    horner(w->delta_rate, e[DELTA].rate, e[DELTA].degree, w->lambda);
    mpc_div(w->slope, w->delta_rate[0], w->delta[1], CRND);
    mpc_neg(w->slope, w->slope, CRND);
    mpc_div(w->part, w->r[0], w->delta[1], CRND); /* R/Delta' */
    mpfr_add(s0, s0, mpc_realref(w->part), RND);
    mpc_mul(w->delta[2], w->delta[2], w->slope, CRND);
    mpc_add(w->delta[2], w->delta[2], w->delta_rate[1], CRND);
    mpc_mul(w->part, w->part, w->delta[2], CRND);
    mpc_mul(w->r[1], w->r[1], w->slope, CRND);
    mpc_add(w->r[1], w->r[1], w->r_rate[0], CRND);
    mpc_sub(w->part, w->r[1], w->part, CRND);
    mpc_div(w->part, w->part, w->delta[1], CRND);
    mpfr_add(s1, s1, mpc_realref(w->part), RND);
}

/* Sums over the roots with Re lambda > 0. */
static cv_status sum(mpfr_ptr s0, mpfr_ptr s1, const dg_mp_roots *roots, const expansion *e, mpfr_prec_t bits)
{
    scratch w;
    scratch_each(&w, bits);
    mpfr_set_zero(s0, 1);
    mpfr_set_zero(s1, 1);
    cv_status status = CV_OK;
    for (int i = 0; i < roots->count && status == CV_OK; i++) {
        mpc_set(w.lambda, roots->y[i], CRND);
        const int far = roots->far && i + 1 == roots->count;
        if (far && mpfr_zero_p(mpc_realref(w.lambda)) && mpfr_zero_p(mpc_imagref(w.lambda)))
            continue; /* at infinity: no residue */
        if (far)
            mpc_ui_div(w.lambda, 1, w.lambda, CRND);
        else if (!(fabs(mpfr_get_d(mpc_imagref(w.lambda), RND)) > roots->radius[i] * roots->unit))
            status = CV_UNDECIDED;
        mpc_mul_i(w.lambda, w.lambda, 1, CRND);
        if (mpfr_sgn(mpc_realref(w.lambda)) > 0)
            add_root(s0, s1, &w, e);
    }
    scratch_each(&w, 0);
    return status;
}

static cv_status find_roots(dg_mp_roots *roots, const dg_mp_operator *op)
{
    dg_roots start, polished;
    cv_status status = dg_roots_cold(&start, &op->rounded);
    if (status != CV_OK)
        return status;
    polished = start;
    if (dg_roots_polish_cold(&polished, &op->rounded) == CV_OK)
        start = polished;
    return dg_mp_roots_find(roots, op, &start, 0);
}

cv_status dg_low_frequency(mpfr_ptr s0, mpfr_ptr s1, const dg_track *track, mpfr_srcptr alpha,
                           mpfr_prec_t bits)
{
    dg_constants constants;
    dg_mp_operator op;
    dg_mp_roots roots;
    expansion e[EXPANSIONS];
    mpfr_t rounded;
    mpc_t zero;
    mpc_init2(zero, bits);
    mpc_set_ui(zero, 0, CRND);
    mpfr_init2(rounded, bits);
    mpfr_set(rounded, alpha, RND);
    dg_constants_init(&constants, track, bits);
    dg_mp_operator_init(&op, bits);
    dg_mp_roots_init(&roots, bits);
    for (int i = 0; i < EXPANSIONS; i++)
        expansion_init(&e[i], bits);
    dg_mp_operator_set(&op, track, &constants, rounded, zero);
    mpfr_set_prec(s0, bits);
    mpfr_set_prec(s1, bits);
    cv_status status = find_roots(&roots, &op);
    if (status == CV_OK) {
        set_expansions(e, &constants, rounded);
        status = sum(s0, s1, &roots, e, bits);
    }
    for (int i = 0; i < EXPANSIONS; i++)
        expansion_clear(&e[i]);
    dg_mp_roots_clear(&roots);
    dg_mp_operator_clear(&op);
    dg_constants_clear(&constants);
    mpfr_clear(rounded);
    mpc_clear(zero);
    return status;
}
