#include "compare/printed_formulas.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

enum { BITS = 128 };

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

/* d2/d3 of the matrix (7) at damping eta for all three layers, written down as printed: no solver's code. */
typedef struct {
    double mu_s, mu_b, kappa_p, kappa_b, eta, alpha;
    double complex q;
    int imaginary; /* which part the quadrature sees */
} transform;

static double transform_part(double p, void *parameters)
{
    const transform *t = parameters;
    const double complex shift = t->q - t->alpha * p, square = shift * shift,
                         i_shift = CMPLX(-cimag(shift), creal(shift));
    const double complex D1 = p * p * p * p / 4.0 - square, D2 = 2.0 * t->eta * i_shift + t->kappa_p;
    const double complex D3 = -t->mu_s * square, D4 = 2.0 * t->eta * i_shift + t->kappa_b;
    const double complex D56 = -t->mu_b * square + 2.0 * t->eta * i_shift + 1.0;
    const double complex d2 = (D2 + D3 + D4) * (D4 + D56) - D4 * D4;
    const double complex value = d2 / ((D1 + D2) * d2 - D2 * D2 * (D4 + D56));
    return t->imaginary ? cimag(value) : creal(value);
}

/* One part of K(0, q) of (13), the integral over all real p; the tails beyond 60 behave as 4/p^4. */
static cv_status integrate(double *out, transform *t, cv_message *why)
{
    enum { REACH = 60, PIECES = 2 * REACH, LIMIT = 2000 };
    gsl_function f = {transform_part, t};
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(LIMIT);
    double part, error;
    if (w == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    int code = gsl_integration_qagiu(&f, REACH, 1e-9, 1e-9, LIMIT, w, &part, &error);
    *out = part;
    if (code == GSL_SUCCESS)
        code = gsl_integration_qagil(&f, -REACH, 1e-9, 1e-9, LIMIT, w, &part, &error);
    *out += part;
    for (int i = 0; code == GSL_SUCCESS && i < PIECES; i++) {
        code = gsl_integration_qag(&f, i - REACH, i + 1 - REACH, 1e-9, 1e-9, LIMIT, GSL_INTEG_GAUSS31, w,
                                   &part, &error);
        *out += part;
    }
    gsl_integration_workspace_free(w);
    return code == GSL_SUCCESS ? CV_OK : cv_fail(why, CV_FAILED, "quadrature of K: %s", gsl_strerror(code));
}

/* K(0, q)/pi = 2 zeta/q^2 as q -> 0; terms of order q^2, alpha^2 and 1/kappa are below 1e-8. */
static cv_status static_deflection(cmp_formula_values *out, const cmp_method *method, cv_params *p,
                                   const cv_number *alpha_min, const cv_number *alpha_max, cv_message *why)
{
    const double q = 1e-4;
    double complex zeta = 0.0;
    void *handle;
    cv_status status = cv_number_parse(&p->kappa_p, "1e9", why);
    if (status == CV_OK)
        status = cv_number_parse(&p->kappa_b, "1e9", why);
    if (status == CV_OK)
        status = method->open(&handle, p, alpha_min, alpha_max, why);
    if (status != CV_OK)
        return status;
    status = zeta_at(&zeta, method, handle, 1e-4, q, why);
    method->close(handle);
    out->derived = 2.0 * creal(zeta) / (q * q);
    out->as_printed = 4.0 * out->derived;
    return status;
}

/* The eigenvalue qbar = i q of DESIGN section 3, with a mode that decays on both sides: case 1, damping 0.05,
 * eta_M 100, alpha 0.5. Its real part is negative, where K by its definition (13), which is what a mode
 * needs, and the continuation of K from positive real parts differ: hence quadrature, and neither solver. */
static cv_status eigenvalue(cmp_formula_values *out, const cv_params *p, cv_message *why)
{
    const double eta_M = 100.0;
    transform t = {cv_number_get_double(&p->mu_s),
                   cv_number_get_double(&p->mu_b),
                   cv_number_get_double(&p->kappa_p),
                   cv_number_get_double(&p->kappa_b),
                   0.05,
                   0.5,
                   CMPLX(0.209815, 0.002726),
                   0};
    double re = 0.0, im = 0.0;
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    cv_status status = integrate(&re, &t, why);
    t.imaginary = 1;
    if (status == CV_OK)
        status = integrate(&im, &t, why);
    gsl_set_error_handler(handler);
    out->derived = creal(eta_M * t.q * t.q * CMPLX(re, im)) / (2.0 * M_PI);
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
                      const cv_number *alpha_min, const cv_number *alpha_max, const cmp_printed_file *file,
                      cv_message *why)
{
    cv_params p;
    cv_params_init(&p);
    cv_status status = cmp_printed_case(&p, file, "1", why);
    if (status == CV_OK && strcmp(key, "static") == 0)
        status = static_deflection(out, method, &p, alpha_min, alpha_max, why);
    else if (status == CV_OK && strcmp(key, "eigenvalue") == 0)
        status = eigenvalue(out, &p, why);
    else if (status == CV_OK && strcmp(key, "L11") == 0)
        first_entry(out);
    else if (status == CV_OK)
        status = cv_fail(why, CV_FAILED, "data/printed.ini as compiled in: no formula %s", key);
    cv_params_clear(&p);
    return status;
}
