/* Mass-induced roots of semianalytic/ as compare sees them. */
#include <stdlib.h>

#include "compare/roots.h"
#include "semianalytic/laplace_digits.h"
#include "semianalytic/roots.h"

typedef struct {
    sa_track *track;
    cv_number alpha, mass_ratio;
} handle;

static void close_handle(void *opaque)
{
    handle *h = opaque;
    sa_track_free(h->track);
    cv_number_clear(&h->alpha);
    cv_number_clear(&h->mass_ratio);
    free(h);
}

static cv_status open_handle(void **out, const cv_params *track, const cv_number *alpha,
                             const cv_number *mass_ratio, cv_message *why)
{
    handle *h = calloc(1, sizeof *h);
    if (h == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = sa_track_new(&h->track, track, why);
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

static cv_status copy_list(cmp_root_list *to, const sa_root_list *from, cv_message *why)
{
    cv_status status = CV_OK;
    mpfr_t error;
    mpfr_init2(error, 53);
    to->unstable = from->unstable_roots;
    to->status = from->decided;
    to->why = from->reason;
    for (size_t i = 0; status == CV_OK && i < from->count; i++) {
        const sa_root *r = &from->items[i];
        mpfr_set_d(error, r->error, MPFR_RNDU);
        status = cmp_root_list_append(to, r->re, r->im, error, r->decided, why);
    }
    mpfr_clear(error);
    return status;
}

static cv_status find(void *opaque, cmp_root_list *out, double depth, int digits, cv_message *why)
{
    handle *h = opaque;
    sa_root_list roots;
    cv_status status = sa_roots_find(&roots, h->track, &h->alpha, &h->mass_ratio, depth, digits, why);
    if (status == CV_UNDECIDED) {
        out->status = CV_UNDECIDED;
        out->why = *why;
        why->text[0] = '\0';
        return CV_OK;
    }
    if (status != CV_OK)
        return status;
    status = copy_list(out, &roots, why);
    sa_roots_clear(&roots);
    return status;
}

static cv_status zeta(void *opaque, mpc_ptr out, mpfr_ptr error, mpc_srcptr qbar, mpfr_prec_t bits,
                      cv_message *why)
{
    handle *h = opaque;
    mpfr_t im_error;
    mpfr_init2(im_error, 53);
    mpc_set_prec(out, bits);
    cv_status status = sa_zeta_continued(out, error, im_error, h->track, &h->alpha, qbar);
    if (status == CV_OK)
        mpfr_add(error, error, im_error, MPFR_RNDU);
    else
        cv_fail(why, status, "zeta at qbar = %.10g + %.10gi with %ld bits",
                mpfr_get_d(mpc_realref(qbar), MPFR_RNDN), mpfr_get_d(mpc_imagref(qbar), MPFR_RNDN),
                (long)bits);
    mpfr_clear(im_error);
    return status;
}

const cmp_root_method cmp_roots_semianalytic = {"semianalytic", open_handle, close_handle, find, zeta};
