/* dgreen/ as compare sees it. */
#include <stdlib.h>

#include "compare/method.h"
#include "dgreen/count.h"
#include "dgreen/transitions.h"
#include "dgreen/z_mp.h"

typedef struct {
    cv_params params;
    cv_number alpha_min, alpha_max;
    dg_track *track;
    dg_counter *counter; /* made when the first count asks for it */
} handle;

static void close_handle(void *opaque)
{
    handle *h = opaque;
    dg_counter_free(h->counter);
    dg_track_free(h->track);
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
    cv_status status = dg_track_new(&h->track, params, why);
    if (status == CV_OK)
        *out = h;
    else
        close_handle(h);
    return status;
}

static cv_status copy_list(cmp_list *to, const dg_transition_list *from, int undamped, cv_message *why)
{
    cv_status status = CV_OK;
    to->status = from->status;
    to->why = from->why;
    for (size_t i = 0; status == CV_OK && i < from->count; i++) {
        const dg_transition *t = &from->items[i];
        status = cmp_list_append(to, t->alpha, t->frequency, t->alpha_error, t->frequency_error,
                                 t->count_below, t->count_above, t->decided, why);
        if (status == CV_OK && undamped && mpfr_zero_p(t->frequency))
            to->items[to->count - 1].at_resonance = 1;
    }
    return status;
}

static cv_status find(void *opaque, cmp_list *lists, cmp_effort *effort, size_t mass_count,
                      const cv_number *mass_ratios, int digits, int level, cv_message *why)
{
    handle *h = opaque;
    dg_effort cost = {0, 0, 0};
    dg_transition_list *found = calloc(mass_count, sizeof *found);
    if (found == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = dg_find_transitions(found, &cost, &h->params, &h->alpha_min, &h->alpha_max, mass_count,
                                           mass_ratios, digits, level, why);
    for (size_t i = 0; status == CV_OK && i < mass_count; i++)
        status = copy_list(&lists[i], &found[i], cv_params_undamped(&h->params), why);
    for (size_t i = 0; i < mass_count; i++)
        dg_transition_list_clear(&found[i]);
    free(found);
    *effort = (cmp_effort){cost.evaluations, cost.above_double, (unsigned long)cost.largest_precision, 0.0};
    return status;
}

static cv_status count(void *opaque, int *roots, double alpha, size_t mass_count,
                       const cv_number *mass_ratios, cv_message *why)
{
    handle *h = opaque;
    size_t failed;
    cv_status status = CV_OK;
    if (h->counter == NULL)
        status = dg_counter_new(&h->counter, &h->params, cv_number_get_double(&h->alpha_min),
                                cv_number_get_double(&h->alpha_max), why);
    return status == CV_OK
               ? dg_count_unstable(roots, &failed, h->counter, alpha, mass_count, mass_ratios, why)
               : status;
}

static cv_status zeta(void *opaque, mpc_ptr out, mpfr_ptr re_error, mpfr_ptr im_error, mpfr_srcptr alpha,
                      mpfr_srcptr q, mpfr_prec_t bits, cv_message *why)
{
    handle *h = opaque;
    cv_status status = dg_zeta_mp(out, re_error, im_error, h->track, alpha, q, bits);
    if (status != CV_OK)
        return cv_fail(why, status, "zeta at alpha = %.15g, q = %.15g with %ld bits",
                       mpfr_get_d(alpha, MPFR_RNDN), mpfr_get_d(q, MPFR_RNDN), (long)bits);
    return CV_OK;
}

const cmp_method cmp_method_dgreen = {"dgreen", open_handle, close_handle, find, count, zeta};
