#include "dgreen/count.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/sampler.h"

struct dg_counter {
    dg_sampler sampler;
};

/* The curve is listed down to this part of the smallest 1/eta_M. */
static const double FLOOR = 0.3;

cv_status dg_counter_new(dg_counter **out, const cv_params *params, double alpha_min, double alpha_max,
                         cv_message *why)
{
    *out = NULL;
    dg_counter *c = calloc(1, sizeof *c);
    if (c == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    const cv_status status = dg_sampler_init(&c->sampler, params, alpha_min, alpha_max, why);
    if (status == CV_OK)
        *out = c;
    else
        free(c);
    return status;
}

void dg_counter_free(dg_counter *c)
{
    if (c == NULL)
        return;
    dg_sampler_clear(&c->sampler);
    free(c);
}

cv_status dg_count_unstable(int *roots, size_t *failed, dg_counter *c, double alpha, size_t mass_count,
                            const cv_number *mass_ratios, cv_message *why)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < mass_count; i++)
        least = fmin(least, 1 / cv_number_get_double(&mass_ratios[i]));
    *failed = 0;
    cv_status status = dg_sampler_curve(&c->sampler, alpha, FLOOR * least, why);
    for (size_t i = 0; i < mass_count && status == CV_OK; i++) {
        *failed = i;
        status = dg_sampler_count(&roots[i], &c->sampler, 1 / cv_number_get_double(&mass_ratios[i]), why);
    }
    return status;
}
