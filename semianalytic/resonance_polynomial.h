/* The polynomials of resonances.h; used there only. x = p^2, L = omega^2. */
#ifndef CRITVEL_SEMIANALYTIC_RESONANCE_POLYNOMIAL_H
#define CRITVEL_SEMIANALYTIC_RESONANCE_POLYNOMIAL_H

#include "common/params.h"
#include "semianalytic/interval.h"

/* F = sum f[a](x) L^a = det(K - L M) for the undamped track. */
typedef struct {
    sa_polynomial f[4];
} sa_characteristic;

void sa_characteristic_init(sa_characteristic *c, const cv_params *params, mpfr_prec_t precision);
void sa_characteristic_clear(sa_characteristic *c);

/* resultant(x) = f[3] Res_L(F, H), H = x F_x + L F_L - 3 F: up to sign, constants and the discriminant of F
 * in L (positive for real x), the product of L_k - x dL_k/dx over the three branches. */
void sa_characteristic_resultant(sa_polynomial *resultant, const sa_characteristic *c);

/* F as a polynomial in L, for x anywhere in the interval */
void sa_characteristic_cubic(sa_polynomial *cubic, const sa_characteristic *c, const sa_interval *x);

/* x F_x + L F_L over x and L */
void sa_characteristic_euler(sa_interval *value, const sa_characteristic *c, const sa_interval *x,
                             const sa_interval *L);

#endif
