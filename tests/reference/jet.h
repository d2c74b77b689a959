/* Polynomials in p with ball coefficients, together with their partial derivatives by alpha and by q. */
#ifndef CRITVEL_REFERENCE_JET_H
#define CRITVEL_REFERENCE_JET_H

#include <acb_poly.h>

typedef struct {
    acb_poly_t v; /* value */
    acb_poly_t a; /* its derivative by alpha */
    acb_poly_t q; /* its derivative by q */
} ref_jet;

void ref_jet_init(ref_jet *x); /* sets 0 */
void ref_jet_clear(ref_jet *x);

/* out may be x or y everywhere; prec in bits */
void ref_jet_add(ref_jet *out, const ref_jet *x, const ref_jet *y, slong prec);
void ref_jet_sub(ref_jet *out, const ref_jet *x, const ref_jet *y, slong prec);
void ref_jet_mul(ref_jet *out, const ref_jet *x, const ref_jet *y, slong prec);

/* x times a factor that depends neither on alpha nor on q */
void ref_jet_scale(ref_jet *x, const arb_t factor, slong prec);

/* x + c p^power with c independent of alpha and q */
void ref_jet_add_coeff(ref_jet *x, slong power, const arb_t c, slong prec);

#endif
