#include "semianalytic/quadrature.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "semianalytic/matrix.h"

enum { INTERVALS_MAX = 20000, PANELS = 400 };

typedef struct {
    const sa_track *track;
    double alpha, q, xi;
    gsl_integration_workspace *workspace;
} integrand;

static double complex at(double p, const integrand *f)
{
    sa_point m;
    sa_matrix_point(&m, f->track, f->alpha, f->q, p);
    return m.w[SA_RAIL] / m.det;
}

static double real_part(double p, void *f)
{
    const integrand *in = f;
    return creal(at(p, in) * cexp(CMPLX(0, p * in->xi)));
}

static double imaginary_part(double p, void *f)
{
    const integrand *in = f;
    return cimag(at(p, in) * cexp(CMPLX(0, p * in->xi)));
}

/* Beyond this |p| the integrand is 4/p^4 and smooth: all free waves omega_k(p) of the track with omega = |q -
 * alpha p| lie inside, as do the scales of its stiffnesses. */
static double reach(const integrand *f)
{
    const sa_track *t = f->track;
    double support = t->kappa_p.m + t->kappa_b.m + 1;
    double fastest = sqrt((t->kappa_p.m + t->kappa_b.m) / t->mu_s.m) + sqrt((t->kappa_b.m + 1) / t->mu_b.m);
    double waves = f->alpha > 0 ? (fabs(f->q) + fastest) / f->alpha : 0;
    double rail = 2 * f->alpha + 2 * sqrt(fabs(f->q)) + 2 * pow(support, 0.25) + 2 * sqrt(fabs(t->eta_N.m));
    return 2 * fmax(waves, rail);
}

/* GSL stops short of the tolerance where rounding dominates; the error estimate then says how short. */
static int usable(int status)
{
    return status == GSL_SUCCESS || status == GSL_EROUND;
}

/* Both ends of the axis, |p| > *end. An oscillating tail is cut off where 8/p^4, a bound of the integrand,
 * adds up to less than the tolerance. */
static int integrate_tails(double *value, double *error, double *end, integrand *f, gsl_function *function,
                           double tolerance)
{
    double other, other_error;
    if (f->xi != 0) {
        *end = fmax(*end, cbrt(16 / tolerance));
        *value = 0;
        *error = 16 / (3 * *end * *end * *end);
        return GSL_SUCCESS;
    }
    int status = gsl_integration_qagiu(function, *end, tolerance, tolerance, INTERVALS_MAX, f->workspace,
                                       value, error);
    status |= gsl_integration_qagil(function, -*end, tolerance, tolerance, INTERVALS_MAX, f->workspace,
                                    &other, &other_error);
    *value += other;
    *error += other_error;
    return status;
}

/* One part of K over the whole axis. */
static int integrate(double *value, double *error, integrand *f, double (*part)(double, void *),
                     double tolerance)
{
    gsl_function function = {part, f};
    double end = reach(f), piece, piece_error;
    int status = integrate_tails(value, error, &end, f, &function, tolerance);
    double step = 2 * end / PANELS;
    for (int i = 0; i < PANELS && usable(status); i++) {
        double from = -end + i * step;
        status = gsl_integration_qag(&function, from, from + step, tolerance / PANELS, tolerance,
                                     INTERVALS_MAX, GSL_INTEG_GAUSS61, f->workspace, &piece, &piece_error);
        *value += piece;
        *error += piece_error;
    }
    return status;
}

/* Size of K, which the absolute tolerances are relative to: a static estimate is enough. */
static double size_of(const integrand *f)
{
    const sa_track *t = f->track;
    double support = 1 / (1 / t->kappa_p.m + 1 / t->kappa_b.m + 1);
    return pow(support, -0.75);
}

cv_status sa_quadrature_kernel(double complex *kernel, double *error, const sa_track *t, double alpha,
                               double q, double xi, double tolerance, cv_message *why)
{
    if (t->undamped)
        return cv_fail(why, CV_BAD_INPUT,
                       "quadrature needs damping: the poles of an undamped track are real");
    if (!isfinite(alpha) || !(alpha >= 0) || !isfinite(q) || !isfinite(xi) ||
        !(tolerance >= 1e-13 && tolerance <= 1e-2))
        return cv_fail(why, CV_BAD_INPUT, "quadrature: argument out of range");
    integrand f = {t, alpha, q, xi, gsl_integration_workspace_alloc(INTERVALS_MAX)};
    if (f.workspace == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    double re, im, re_error, im_error, scaled = tolerance * fmin(size_of(&f), 1);
    int status = integrate(&re, &re_error, &f, real_part, scaled);
    if (usable(status))
        status = integrate(&im, &im_error, &f, imaginary_part, scaled);
    gsl_integration_workspace_free(f.workspace);
    if (!usable(status))
        return cv_fail(why, CV_FAILED, "quadrature: %s", gsl_strerror(status));
    if (!(re_error + im_error <= 4 * tolerance * (size_of(&f) + hypot(re, im))))
        return cv_fail(why, CV_UNDECIDED, "quadrature reaches an error of %.1e only", re_error + im_error);
    *kernel = CMPLX(re, im);
    *error = re_error + im_error;
    return CV_OK;
}
