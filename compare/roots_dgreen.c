/* Mass-induced roots of dgreen/ as compare sees them. */
#include <stdlib.h>

#include "compare/roots.h"
#include "dgreen/continued_mp.h"
#include "dgreen/mass_roots.h"

typedef struct {
    dg_sampler sampler;
    cv_number alpha, mass_ratio;
    int has_curve; /* the sampler's curve is that at alpha */
} handle;

/* The curve is listed down to this part of 1/eta_M. */
static const double FLOOR = 0.1;
/* Paths to the left begin this far to the right of the axis, in units of the distance over which zeta
 * changes. */
static const double ASIDE = 1e-3;

static void close_handle(void *opaque)
{
    handle *h = opaque;
    dg_sampler_clear(&h->sampler);
    cv_number_clear(&h->alpha);
    cv_number_clear(&h->mass_ratio);
    free(h);
}

static cv_status open_handle(void **out, const cv_params *track, const cv_number *alpha,
                             const cv_number *mass_ratio, cv_message *why)
{
    const double velocity = cv_number_get_double(alpha);
    handle *h = calloc(1, sizeof *h);
    if (h == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = dg_sampler_init(&h->sampler, track, velocity, velocity, why);
    if (status != CV_OK) {
        free(h);
        return status;
    }
    cv_number_init(&h->alpha);
    cv_number_set(&h->alpha, alpha);
    cv_number_init(&h->mass_ratio);
    cv_number_set(&h->mass_ratio, mass_ratio);
    *out = h;
    return CV_OK;
}

static cv_status copy_list(cmp_root_list *to, const dg_mass_roots *from, cv_message *why)
{
    cv_status status = CV_OK;
    mpfr_t error;
    mpfr_init2(error, 53);
    to->unstable = from->unstable_count;
    for (size_t i = 0; status == CV_OK && i < from->count; i++) {
        const dg_mass_root *r = &from->items[i];
        mpfr_set_d(error, r->log_error, MPFR_RNDU);
        mpfr_exp10(error, error, MPFR_RNDU);
        status = cmp_root_list_append(to, r->re, r->im, error, CV_OK, why);
    }
    mpfr_clear(error);
    return status;
}

/* The depth is dgreen's own affair: it lists the stable roots nearest to the curve. */
static cv_status find(void *opaque, cmp_root_list *out, double depth, int digits, cv_message *why)
{
    handle *h = opaque;
    dg_mass_roots roots;
    (void)depth;
    h->has_curve = 0;
    cv_status status = dg_find_mass_roots(&roots, &h->sampler, &h->alpha, &h->mass_ratio, digits, why);
    if (status == CV_UNDECIDED) {
        out->status = CV_UNDECIDED;
        out->why = *why;
        why->text[0] = '\0';
        return CV_OK;
    }
    if (status != CV_OK)
        return status;
    status = copy_list(out, &roots, why);
    dg_mass_roots_clear(&roots);
    return status;
}

/* The roots lambda of the sum at qbar, in double. */
static cv_status follow_to(dg_continued *at, handle *h, double complex qbar, cv_message *why)
{
    const double alpha = cv_number_get_double(&h->alpha), q = cimag(qbar);
    cv_status status = CV_OK;
    if (!h->has_curve)
        status = dg_sampler_curve(&h->sampler, alpha, FLOOR / cv_number_get_double(&h->mass_ratio), why);
    h->has_curve = status == CV_OK;
    if (status == CV_OK)
        status = dg_continued_start(at, h->sampler.follow, h->sampler.track, alpha, q,
                                    ASIDE * dg_station_scale(&h->sampler.curve.at, q));
    return status == CV_OK ? dg_continued_move(at, qbar) : status;
}

static cv_status zeta(void *opaque, mpc_ptr out, mpfr_ptr error, mpc_srcptr qbar, mpfr_prec_t bits,
                      cv_message *why)
{
    handle *h = opaque;
    dg_continued near;
    dg_continued_mp *w;
    int physical = 0;
    const double complex rounded =
        CMPLX(mpfr_get_d(mpc_realref(qbar), MPFR_RNDN), mpfr_get_d(mpc_imagref(qbar), MPFR_RNDN));
    cv_status status = follow_to(&near, h, rounded, why);
    if (status == CV_OK)
        status = dg_continued_mp_new(&w, h->sampler.track, &h->alpha, bits, why);
    if (status == CV_OK) {
        mpc_set_prec(out, bits);
        status = dg_continued_mp_zeta(out, error, &physical, w, &near, qbar);
        dg_continued_mp_free(w);
    }
    if (status == CV_OK && mpfr_sgn(mpc_realref(qbar)) > 0 && !physical)
        status = CV_UNDECIDED;
    return status == CV_OK ? CV_OK
                           : cv_fail(why, status, "zeta at qbar = %.10g + %.10gi with %ld bits",
                                     creal(rounded), cimag(rounded), (long)bits);
}

const cmp_root_method cmp_roots_dgreen = {"dgreen", open_handle, close_handle, find, zeta};
