/* semianalytic/ as compare sees it. */
#include <stdlib.h>

#include "compare/method.h"
#include "semianalytic/transitions.h"

typedef struct {
    cv_params params;
    cv_number alpha_min, alpha_max;
    sa_track *track;
    sa_sweep *sweep;
    sa_boundary
        *boundary; /* made when the first search or count asks for it: it needs damping, zeta does not */
} handle;

static void close_handle(void *opaque)
{
    handle *h = opaque;
    sa_boundary_free(h->boundary);
    sa_sweep_free(h->sweep);
    sa_track_free(h->track);
    cv_number_clear(&h->alpha_min);
    cv_number_clear(&h->alpha_max);
    cv_params_clear(&h->params);
    free(h);
}

static cv_status open_handle(void **out, const cv_params *params, const cv_number *alpha_min,
                             const cv_number *alpha_max, cv_message *why)
{
    handle *h = calloc(1, sizeof *h);
    if (h == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_params_init(&h->params);
    cv_params_set(&h->params, params);
    cv_number_init(&h->alpha_min);
    cv_number_set(&h->alpha_min, alpha_min);
    cv_number_init(&h->alpha_max);
    cv_number_set(&h->alpha_max, alpha_max);
    h->sweep = sa_sweep_new();
    cv_status status =
        h->sweep != NULL ? sa_track_new(&h->track, params, why) : cv_fail(why, CV_FAILED, "out of memory");
    if (status == CV_OK)
        *out = h;
    else
        close_handle(h);
    return status;
}

static cv_status need_boundary(handle *h, cv_message *why)
{
    if (h->boundary != NULL)
        return CV_OK;
    return sa_boundary_new(&h->boundary, &h->params, &h->alpha_min, &h->alpha_max, why);
}

static cv_status copy_list(cmp_list *to, const sa_transitions *from, int undamped, cv_message *why)
{
    cv_status status = CV_OK;
    to->status = from->decided;
    to->why = from->reason;
    for (size_t i = 0; status == CV_OK && i < from->count; i++) {
        const sa_transition *t = &from->items[i];
        status = cmp_list_append(to, t->alpha, t->q, t->alpha_error, t->q_error, t->below, t->above,
                                 t->decided, why);
        if (status == CV_OK && undamped && mpfr_zero_p(t->q))
            to->items[to->count - 1].at_resonance = 1;
    }
    return status;
}

static cv_status find(void *opaque, cmp_list *lists, cmp_effort *effort, size_t mass_count,
                      const cv_number *mass_ratios, int digits, int level, cv_message *why)
{
    handle *h = opaque;
    sa_transitions *found = calloc(mass_count, sizeof *found);
    if (found == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = need_boundary(h, why);
    if (status == CV_OK)
        status = sa_boundary_transitions(found, h->boundary, mass_count, mass_ratios, digits, level, why);
    for (size_t i = 0; status == CV_OK && i < mass_count; i++)
        status = copy_list(&lists[i], &found[i], cv_params_undamped(&h->params), why);
    if (h->boundary != NULL) {
        const sa_counts cost = sa_boundary_counts(h->boundary);
        *effort =
            (cmp_effort){cost.evaluations, cost.beyond_double, (unsigned long)cost.largest_precision, 0.0};
    }
    for (size_t i = 0; i < mass_count; i++)
        sa_transitions_clear(&found[i]);
    free(found);
    return status;
}

static cv_status count(void *opaque, int *roots, double alpha, size_t mass_count,
                       const cv_number *mass_ratios, cv_message *why)
{
    handle *h = opaque;
    cv_status status = need_boundary(h, why);
    return status == CV_OK
               ? sa_boundary_unstable_roots(roots, h->boundary, alpha, mass_count, mass_ratios, why)
               : status;
}

static cv_status zeta(void *opaque, mpc_ptr out, mpfr_ptr re_error, mpfr_ptr im_error, mpfr_srcptr alpha,
                      mpfr_srcptr q, mpfr_prec_t bits, cv_message *why)
{
    handle *h = opaque;
    mpc_set_prec(out, bits);
    cv_status status = sa_zeta_mp(out, re_error, im_error, h->sweep, h->track, alpha, q);
    if (status != CV_OK)
        return cv_fail(why, status, "zeta at alpha = %.15g, q = %.15g with %ld bits",
                       mpfr_get_d(alpha, MPFR_RNDN), mpfr_get_d(q, MPFR_RNDN), (long)bits);
    return CV_OK;
}

const cmp_method cmp_method_semianalytic = {"semianalytic", open_handle, close_handle, find, count, zeta};
