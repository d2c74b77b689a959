#include "arbtrack.h"

#include "jet.h"

enum { MAX_PRECISION = 1 << 16, DEGREE = 8, MAX_PASSES = 12, SPARE_BITS = 40 };

void ref_zeta_init(ref_zeta *z)
{
    acb_init(z->zeta);
    acb_init(z->d_alpha);
    acb_init(z->d_q);
    z->upper = z->real = 0;
}

void ref_zeta_clear(ref_zeta *z)
{
    acb_clear(z->zeta);
    acb_clear(z->d_alpha);
    acb_clear(z->d_q);
}

/* Everything the sum over the roots needs. */
typedef struct {
    ref_jet d2, d3, d3p;              /* d3p = d d3/dp */
    acb_poly_t d2p, d3pp;             /* first and second derivatives by p of d2 and d3 */
    acb_t v2, v3p, v3pp, va, vq, rho; /* values at a root */
    acb_t t;
    acb_struct roots[DEGREE];
    slong degree;
    int undamped;
} workspace;

static void workspace_init(workspace *w)
{
    ref_jet_init(&w->d2);
    ref_jet_init(&w->d3);
    ref_jet_init(&w->d3p);
    acb_poly_init(w->d2p);
    acb_poly_init(w->d3pp);
    acb_struct *all[] = {w->v2, w->v3p, w->v3pp, w->va, w->vq, w->rho, w->t};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        acb_init(all[i]);
    for (int i = 0; i < DEGREE; i++)
        acb_init(&w->roots[i]);
}

static void workspace_clear(workspace *w)
{
    ref_jet_clear(&w->d2);
    ref_jet_clear(&w->d3);
    ref_jet_clear(&w->d3p);
    acb_poly_clear(w->d2p);
    acb_poly_clear(w->d3pp);
    acb_struct *all[] = {w->v2, w->v3p, w->v3pp, w->va, w->vq, w->rho, w->t};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        acb_clear(all[i]);
    for (int i = 0; i < DEGREE; i++)
        acb_clear(&w->roots[i]);
}

/* Bits of the least accurate root. */
static slong roots_accuracy(const workspace *w)
{
    slong bits = ARF_PREC_EXACT;
    for (slong k = 0; k < w->degree; k++)
        bits = FLINT_MIN(bits, acb_rel_accuracy_bits(&w->roots[k]));
    return bits;
}

/* All roots isolated, and the real ones known as real where the coefficients are real. acb_poly_find_roots
 * makes a limited number of iterations: it is called again from its own result while that helps. */
static int isolate(workspace *w, slong prec)
{
    slong bits = 0, found = 0;
    w->degree = acb_poly_degree(w->d3.v);
    if (w->degree < 1 || w->degree > DEGREE)
        return -1;
    for (int pass = 0; pass < MAX_PASSES && bits < prec - SPARE_BITS; pass++) {
        slong before = bits;
        found = acb_poly_find_roots(w->roots, w->d3.v, pass == 0 ? NULL : w->roots, 0, prec);
        bits = found == w->degree ? roots_accuracy(w) : 0;
        if (before > 0 && bits < before + 4)
            break;
    }
    if (found != w->degree)
        return -1;
    if (w->undamped && !acb_poly_validate_real_roots(w->roots, w->d3.v, prec))
        return -1;
    return 0;
}

/* The side of a root: 1 upper, 0 lower, -1 undecided. *real is set to 1 for a real root of the undamped
 * track, whose imaginary part is then made exactly 0 and whose side is that of (d d3/dq)/(d d3/dp). */
static int is_upper(int *real, workspace *w, acb_t p, slong prec)
{
    *real = 0;
    if (arb_is_positive(acb_imagref(p)))
        return 1;
    if (arb_is_negative(acb_imagref(p)))
        return 0;
    if (!w->undamped)
        return -1;
    *real = 1; /* acb_poly_validate_real_roots: a root whose ball meets the real axis is real */
    arb_zero(acb_imagref(p));
    acb_poly_evaluate(w->vq, w->d3.q, p, prec);
    acb_poly_evaluate(w->v3p, w->d3p.v, p, prec);
    acb_mul(w->t, w->vq, w->v3p, prec);
    if (arb_is_positive(acb_realref(w->t)))
        return 1;
    return arb_is_negative(acb_realref(w->t)) ? 0 : -1;
}

/* out = d rho/d x where x is alpha or q: d2x, d3x, d3px are the derivatives of the polynomials by x */
static void rho_derivative(acb_t out, workspace *w, const acb_t p, const acb_poly_t d2x, const acb_poly_t d3x,
                           const acb_poly_t d3px, slong prec)
{
    acb_poly_evaluate(w->va, d3x, p, prec);
    acb_div(w->va, w->va, w->v3p, prec);
    acb_neg(w->va, w->va); /* dp/dx */
    acb_poly_evaluate(w->t, w->d3pp, p, prec);
    acb_mul(w->t, w->t, w->va, prec);
    acb_poly_evaluate(out, d3px, p, prec);
    acb_add(out, out, w->t, prec);
    acb_mul(out, out, w->rho, prec);
    acb_neg(out, out);
    acb_poly_evaluate(w->t, w->d2p, p, prec);
    acb_mul(w->t, w->t, w->va, prec);
    acb_add(out, out, w->t, prec);
    acb_poly_evaluate(w->t, d2x, p, prec);
    acb_add(out, out, w->t, prec);
    acb_div(out, out, w->v3p, prec);
}

/* sum += the contribution of a root. For the undamped track real coefficients give sum over all roots of
 * Re rho = 0, so the complex upper roots together count minus half the real roots: exact zeros stay zero and
 * tiny parts keep their own accuracy. */
static void accumulate(acb_ptr sum, acb_srcptr term, const workspace *w, int upper, int real, slong prec)
{
    acb_t t;
    acb_init(t);
    acb_set(t, term);
    if (real)
        acb_mul_2exp_si(t, t, -1);
    else if (w->undamped)
        arb_zero(acb_realref(t));
    if (upper)
        acb_add(sum, sum, t, prec);
    else if (real)
        acb_sub(sum, sum, t, prec);
    acb_clear(t);
}

static int sum_roots(ref_zeta *out, workspace *w, slong prec)
{
    acb_t d;
    int status = 0;
    acb_init(d);
    acb_zero(out->zeta);
    acb_zero(out->d_alpha);
    acb_zero(out->d_q);
    out->upper = out->real = 0;
    for (slong k = 0; k < w->degree && status == 0; k++) {
        int real, upper = is_upper(&real, w, &w->roots[k], prec);
        status = upper < 0 ? -1 : 0;
        if (status != 0 || (!upper && !real))
            continue;
        const acb_struct *p = &w->roots[k];
        acb_poly_evaluate(w->v2, w->d2.v, p, prec);
        acb_poly_evaluate(w->v3p, w->d3p.v, p, prec);
        acb_div(w->rho, w->v2, w->v3p, prec);
        accumulate(out->zeta, w->rho, w, upper, real, prec);
        rho_derivative(d, w, p, w->d2.a, w->d3.a, w->d3p.a, prec);
        accumulate(out->d_alpha, d, w, upper, real, prec);
        rho_derivative(d, w, p, w->d2.q, w->d3.q, w->d3p.q, prec);
        accumulate(out->d_q, d, w, upper, real, prec);
        out->upper += upper;
        out->real += real;
    }
    acb_clear(d);
    return status;
}

/* From S and its derivatives to zeta = i q^2 S and its own. */
static void finish(ref_zeta *out, const arb_t q, slong prec)
{
    arb_t q2;
    arb_init(q2);
    arb_mul(q2, q, q, prec);
    acb_mul_arb(out->d_q, out->d_q, q2, prec);
    acb_mul_arb(out->d_alpha, out->d_alpha, q2, prec);
    acb_mul_arb(out->zeta, out->zeta, q, prec);
    acb_addmul_si(out->d_q, out->zeta, 2, prec);
    acb_mul_arb(out->zeta, out->zeta, q, prec);
    acb_mul_onei(out->zeta, out->zeta);
    acb_mul_onei(out->d_alpha, out->d_alpha);
    acb_mul_onei(out->d_q, out->d_q);
    arb_clear(q2);
}

int ref_zeta_ball(ref_zeta *out, const ref_track *t, const arb_t alpha, const arb_t q, int degree_drops,
                  slong prec)
{
    workspace w;
    workspace_init(&w);
    w.undamped = ref_track_undamped(t);
    ref_determinants(&w.d2, &w.d3, t, alpha, q, degree_drops, prec);
    acb_poly_derivative(w.d3p.v, w.d3.v, prec);
    acb_poly_derivative(w.d3p.a, w.d3.a, prec);
    acb_poly_derivative(w.d3p.q, w.d3.q, prec);
    acb_poly_derivative(w.d3pp, w.d3p.v, prec);
    acb_poly_derivative(w.d2p, w.d2.v, prec);
    int status = isolate(&w, prec);
    if (status == 0)
        status = sum_roots(out, &w, prec);
    if (status == 0)
        finish(out, q, prec);
    workspace_clear(&w);
    return status;
}

static int accurate(const arb_t x, slong bits)
{
    return arb_is_zero(x) || arb_rel_accuracy_bits(x) >= bits;
}

static int degree_drops_at(const ref_track *t, const fmpq_t alpha)
{
    fmpq_t lead;
    fmpq_init(lead);
    fmpq_mul(lead, alpha, alpha);
    fmpq_mul(lead, lead, &t->value[REF_MU_B]);
    fmpq_sub(lead, lead, &t->value[REF_ETA_S]);
    int drops = fmpq_is_zero(lead);
    fmpq_clear(lead);
    return drops;
}

int ref_zeta_point(ref_zeta *out, const ref_track *t, const fmpq_t alpha, const fmpq_t q, slong bits)
{
    arb_t a, f;
    int status = -1;
    arb_init(a);
    arb_init(f);
    for (slong prec = 2 * bits; status != 0 && prec <= MAX_PRECISION; prec *= 2) {
        arb_set_fmpq(a, alpha, prec);
        arb_set_fmpq(f, q, prec);
        status = ref_zeta_ball(out, t, a, f, degree_drops_at(t, alpha), prec);
        if (status == 0 &&
            !(accurate(acb_realref(out->zeta), bits) && accurate(acb_imagref(out->zeta), bits)))
            status = -1;
    }
    arb_clear(a);
    arb_clear(f);
    return status;
}
