#include "jet.h"

void ref_jet_init(ref_jet *x)
{
    acb_poly_init(x->v);
    acb_poly_init(x->a);
    acb_poly_init(x->q);
}

void ref_jet_clear(ref_jet *x)
{
    acb_poly_clear(x->v);
    acb_poly_clear(x->a);
    acb_poly_clear(x->q);
}

void ref_jet_add(ref_jet *out, const ref_jet *x, const ref_jet *y, slong prec)
{
    acb_poly_add(out->v, x->v, y->v, prec);
    acb_poly_add(out->a, x->a, y->a, prec);
    acb_poly_add(out->q, x->q, y->q, prec);
}

void ref_jet_sub(ref_jet *out, const ref_jet *x, const ref_jet *y, slong prec)
{
    acb_poly_sub(out->v, x->v, y->v, prec);
    acb_poly_sub(out->a, x->a, y->a, prec);
    acb_poly_sub(out->q, x->q, y->q, prec);
}

/* out = x y by the product rule; out may be x or y */
void ref_jet_mul(ref_jet *out, const ref_jet *x, const ref_jet *y, slong prec)
{
    acb_poly_t t, a, q;
    acb_poly_init(t);
    acb_poly_init(a);
    acb_poly_init(q);
    acb_poly_mul(a, x->a, y->v, prec);
    acb_poly_mul(t, x->v, y->a, prec);
    acb_poly_add(a, a, t, prec);
    acb_poly_mul(q, x->q, y->v, prec);
    acb_poly_mul(t, x->v, y->q, prec);
    acb_poly_add(q, q, t, prec);
    acb_poly_mul(t, x->v, y->v, prec);
    acb_poly_swap(out->v, t);
    acb_poly_swap(out->a, a);
    acb_poly_swap(out->q, q);
    acb_poly_clear(t);
    acb_poly_clear(a);
    acb_poly_clear(q);
}

void ref_jet_scale(ref_jet *x, const arb_t factor, slong prec)
{
    acb_t f;
    acb_init(f);
    acb_set_arb(f, factor);
    acb_poly_scalar_mul(x->v, x->v, f, prec);
    acb_poly_scalar_mul(x->a, x->a, f, prec);
    acb_poly_scalar_mul(x->q, x->q, f, prec);
    acb_clear(f);
}

/* Adds a constant coefficient (not depending on alpha or q) to the value part. */
void ref_jet_add_coeff(ref_jet *x, slong power, const arb_t c, slong prec)
{
    acb_t t;
    acb_init(t);
    acb_poly_get_coeff_acb(t, x->v, power);
    acb_add_arb(t, t, c, prec);
    acb_poly_set_coeff_acb(x->v, power, t);
    acb_clear(t);
}
