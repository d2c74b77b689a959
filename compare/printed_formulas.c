#include "compare/printed_formulas.h"

#include <complex.h>
#include <math.h>
#include <string.h>

enum { NODES = 9, BITS = 128 };

/* zeta at a real point, in double. */
static cv_status zeta_at(double complex *out, const cmp_method *method, void *handle, double alpha, double q,
                         cv_message *why)
{
    mpfr_t a, f, re_error, im_error;
    mpc_t zeta;
    mpfr_inits2(BITS, a, f, re_error, im_error, (mpfr_ptr)0);
    mpc_init2(zeta, BITS);
    mpfr_set_d(a, alpha, MPFR_RNDN);
    mpfr_set_d(f, q, MPFR_RNDN);
    cv_status status = method->zeta(handle, zeta, re_error, im_error, a, f, BITS, why);
    *out = CMPLX(mpfr_get_d(mpc_realref(zeta), MPFR_RNDN), mpfr_get_d(mpc_imagref(zeta), MPFR_RNDN));
    mpc_clear(zeta);
    mpfr_clears(a, f, re_error, im_error, (mpfr_ptr)0);
    return status;
}

/* zeta at a complex frequency a little off the real axis, where the image has to be continued: by the
 * polynomial through NODES points on the axis around Re q (the nearest singularity is several node distances
 * away). */
static cv_status continued_zeta(double complex *out, const cmp_method *method, void *handle, double alpha,
                                double complex q, double step, cv_message *why)
{
    double complex value[NODES];
    for (int j = 0; j < NODES; j++) {
        cv_status status =
            zeta_at(&value[j], method, handle, alpha, creal(q) + step * (double)(j - NODES / 2), why);
        if (status != CV_OK)
            return status;
    }
    *out = 0.0;
    for (int j = 0; j < NODES; j++) {
        double complex weight = 1.0;
        for (int k = 0; k < NODES; k++)
            if (k != j)
                weight *= (q - creal(q) - step * (double)(k - NODES / 2)) / (step * (double)(j - k));
        *out += weight * value[j];
    }
    return CV_OK;
}

/* K(0, q)/pi = 2 zeta/q^2 as q -> 0; terms of order q^2, alpha^2 and 1/kappa are below 1e-8. */
static cv_status static_deflection(cmp_formula_values *out, const cmp_method *method, cv_params *p,
                                   cv_message *why)
{
    const double q = 1e-4;
    double complex zeta = 0.0;
    void *handle;
    cv_status status = cv_number_parse(&p->kappa_p, "1e9", why);
    if (status == CV_OK)
        status = cv_number_parse(&p->kappa_b, "1e9", why);
    if (status == CV_OK)
        status = method->open(&handle, p, why);
    if (status != CV_OK)
        return status;
    status = zeta_at(&zeta, method, handle, 1e-4, q, why);
    method->close(handle);
    out->derived = 2.0 * creal(zeta) / (q * q);
    out->as_printed = 4.0 * out->derived;
    return status;
}

/* The eigenvalue qbar = i q is that of tests/ and of DESIGN section 3: case 1, damping 0.05, eta_M 100, alpha
 * 0.5. */
static cv_status eigenvalue(cmp_formula_values *out, const cmp_method *method, cv_params *p, cv_message *why)
{
    const double complex qbar = CMPLX(-0.002726, 0.209815);
    double complex zeta = 0.0;
    void *handle;
    cv_status status = cv_number_parse(&p->eta_p, "0.05", why);
    cv_number_set(&p->eta_b, &p->eta_p);
    cv_number_set(&p->eta_f, &p->eta_p);
    if (status == CV_OK)
        status = method->open(&handle, p, why);
    if (status != CV_OK)
        return status;
    status = continued_zeta(&zeta, method, handle, 0.5, CMPLX(cimag(qbar), -creal(qbar)), 0.004, why);
    method->close(handle);
    out->derived = 100.0 * creal(zeta);
    out->as_printed = 4.0 * out->derived;
    return status;
}

static void first_entry(cmp_formula_values *out)
{
    const double alpha = 0.5, q = 0.2, p = 1.0, kappa_p = 0.03;
    const double complex qbar = CMPLX(0.0, q), s = CMPLX(0.0, q - alpha * p), D = CMPLX(0.0, p);
    const double complex rest =
        D * D * D * D + 4.0 * alpha * alpha * D * D + 4.0 * qbar * qbar + 4.0 * kappa_p;
    out->as_printed = creal(rest - 8.0 * alpha * s * D);
    out->derived = creal(4.0 * (p * p * p * p / 4.0 + s * s + kappa_p));
}

cv_status cmp_formula(cmp_formula_values *out, const char *key, const cmp_method *method,
                      const cmp_printed_file *file, cv_message *why)
{
    cv_params p;
    cv_params_init(&p);
    cv_status status = cmp_printed_case(&p, file, "1", why);
    if (status == CV_OK && strcmp(key, "static") == 0)
        status = static_deflection(out, method, &p, why);
    else if (status == CV_OK && strcmp(key, "eigenvalue") == 0)
        status = eigenvalue(out, method, &p, why);
    else if (status == CV_OK && strcmp(key, "L11") == 0)
        first_entry(out);
    else if (status == CV_OK)
        status = cv_fail(why, CV_FAILED, "data/printed.ini as compiled in: no formula %s", key);
    cv_params_clear(&p);
    return status;
}
