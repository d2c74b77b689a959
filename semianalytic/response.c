#include "semianalytic/response.h"

#include <math.h>
#include <stdlib.h>

#include "semianalytic/response_panels.h"
#include "semianalytic/roots_search.h"

static const double pi = 3.14159265358979323846;

struct sa_response {
    sa_image image;
    sa_panels panels;
    int term_count, root_count;
    struct {
        double complex q, amplitude; /* adds Re(amplitude e^{i q tau}) */
    } term[SA_ROOTS_MAX];
};

/* Residues at q and -conj q together, or at q alone on the imaginary axis. */
static cv_status set_terms(sa_response *r, const sa_rough_roots *roots)
{
    const sa_image *image = &r->image;
    for (int i = 0; i < roots->count; i++) {
        const sa_rough_root *root = &roots->root[i];
        sa_sheet sheet;
        cv_status status = sa_sheet_start(&sheet, image->track, image->alpha, root->q);
        if (status != CV_OK)
            return status;
        double complex amplitude = sa_sheet_kernel(&sheet, image->xi) / (pi * root->q * root->f_q);
        r->term[i].q = root->q;
        r->term[i].amplitude = creal(root->q) > 0 ? 2 * amplitude : amplitude;
    }
    r->term_count = roots->count;
    return CV_OK;
}

/* A root next to the line makes the integrand peak. */
static int too_near(const sa_rough_roots *roots, double height)
{
    const double gap = 0.2;
    for (int i = 0; i < roots->count; i++)
        if (fabs(cimag(roots->root[i].q) + height) < gap * height)
            return 1;
    return 0;
}

/* All roots below the line; *near: one lies close to it, on either side. */
static cv_status find_roots(sa_rough_roots *roots, int *count, int *near, const sa_image *image,
                            cv_message *why)
{
    sa_contour contour;
    roots->count = *count = *near = 0;
    if (image->mass == 0)
        return CV_OK;
    cv_status status =
        sa_contour_build(&contour, image->track, image->alpha, image->mass, image->height, why);
    if (status != CV_OK)
        return status;
    sa_roots_search(roots, &contour, image->track, image->alpha, image->mass, -image->height / 2);
    *count = contour.roots;
    sa_contour_clear(&contour);
    *near = too_near(roots, image->height);
    int kept = 0;
    for (int i = 0; i < roots->count; i++)
        if (cimag(roots->root[i].q) < -image->height)
            roots->root[kept++] = roots->root[i];
    roots->count = kept;
    if (sa_roots_below(roots, image->height) != *count)
        return cv_fail(why, CV_UNDECIDED, "%d roots below the line, %d found", *count,
                       sa_roots_below(roots, image->height));
    return CV_OK;
}

static cv_status choose_height(sa_response *r, const sa_motion *motion, sa_rough_roots *roots,
                               cv_message *why)
{
    enum { ATTEMPTS = 6 };
    const double growth = 3, lowest = 1e-6, highest = 0.3;
    int near = 1;
    cv_status status = CV_OK;
    r->image.height =
        motion->height > 0 ? motion->height : fmin(fmax(growth / motion->tau_max, lowest), highest);
    for (int i = 0; i < ATTEMPTS && near && status == CV_OK; i++) {
        if (i > 0)
            r->image.height *= 0.6;
        status = find_roots(roots, &r->root_count, &near, &r->image, why);
        if (motion->height > 0)
            break;
    }
    return status;
}

static int valid(const sa_motion *m)
{
    return m->alpha >= 0 && m->mass_ratio >= 0 && m->tau_max > 0 && m->height >= 0 && isfinite(m->alpha) &&
           isfinite(m->mass_ratio) && isfinite(m->tau_max) && isfinite(m->height) && isfinite(m->xi);
}

cv_status sa_response_new(sa_response **out, const sa_track *t, const sa_motion *motion, cv_message *why)
{
    sa_rough_roots roots;
    if (!valid(motion))
        return cv_fail(why, CV_BAD_INPUT, "alpha, eta_M, tau and the height must be finite and not negative");
    sa_response *r = calloc(1, sizeof *r);
    if (r == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    r->image = (sa_image){t, motion->alpha, motion->mass_ratio, motion->xi, 0};
    cv_status status = choose_height(r, motion, &roots, why);
    if (status == CV_OK)
        status = set_terms(r, &roots);
    if (status == CV_OK)
        status = sa_panels_build(&r->panels, &r->image, why);
    if (status == CV_OK)
        *out = r;
    else
        sa_response_free(r);
    return status;
}

void sa_response_free(sa_response *r)
{
    if (r != NULL)
        sa_panels_clear(&r->panels);
    free(r);
}

/* The roots are right to 1e-15 |q| or so, their residues to 1e-13. */
cv_status sa_response_at(double *w, double *error, const sa_response *r, double tau)
{
    const double root_error = 1e-14, residue_error = 1e-12;
    double complex integral;
    if (!(tau >= 0) || !isfinite(tau))
        return CV_BAD_INPUT;
    double growth = exp(r->image.height * tau);
    cv_status status = sa_panels_integrate(&integral, error, &r->panels, tau);
    if (status != CV_OK)
        return status;
    *w = growth / pi * creal(integral);
    *error *= growth / pi;
    for (int i = 0; i < r->term_count; i++) {
        double complex term = r->term[i].amplitude * cexp(CMPLX(0, 1) * r->term[i].q * tau);
        *w += creal(term);
        *error += cabs(term) * (residue_error + root_error * cabs(r->term[i].q) * tau);
    }
    return isfinite(*w) ? CV_OK : CV_UNDECIDED;
}

double sa_response_height(const sa_response *r)
{
    return r->image.height;
}

int sa_response_roots(const sa_response *r)
{
    return r->root_count;
}
