#include "compare/countsweep.h"

#include <math.h>
#include <stdlib.h>

/* Velocities tried for one sample. */
enum { TRIES = 3 };

/* Places 0 < x < 1 that never come back: multiples of the golden ratio, whose fractional parts fill the
 * interval evenly and are in step with no grid a method may search on. */
static double place(size_t k)
{
    const double golden = 0.61803398874989485;
    const double x = ((double)k + 0.5) * golden;
    return x - floor(x);
}

/* Velocity in the k-th of CMP_SWEEP equal parts of the logarithmic range. */
static double velocity(double low, double high, size_t k, size_t try)
{
    const double part = ((double)k + place(k + CMP_SWEEP * try)) / CMP_SWEEP;
    return low * exp(part * log(high / low));
}

static cv_status count(cmp_sweep_sample *s, const cmp_method *const methods[], void *const handles[],
                       size_t mass_count, const cv_number *mass_ratios)
{
    cv_status status = CV_OK;
    for (int m = 0; status == CV_OK && m < CMP_METHODS; m++)
        status = methods[m]->count(handles[m], s->roots[m], s->alpha, mass_count, mass_ratios, &s->why);
    return status;
}

void cmp_sweep_clear(cmp_sweep *sweep)
{
    for (size_t k = 0; k < CMP_SWEEP; k++)
        for (int m = 0; m < CMP_METHODS; m++) {
            free(sweep->samples[k].roots[m]);
            sweep->samples[k].roots[m] = NULL;
        }
}

static int allocate(cmp_sweep *out, size_t mass_count)
{
    int done = 1;
    for (size_t k = 0; k < CMP_SWEEP; k++)
        for (int m = 0; m < CMP_METHODS; m++) {
            out->samples[k].roots[m] = calloc(mass_count + 1, sizeof *out->samples[k].roots[m]);
            done = done && out->samples[k].roots[m] != NULL;
        }
    return done;
}

cv_status cmp_sweep_counts(cmp_sweep *out, const cmp_method *const methods[CMP_METHODS],
                           void *const handles[CMP_METHODS], const cv_number *alpha_min,
                           const cv_number *alpha_max, size_t mass_count, const cv_number *mass_ratios,
                           cv_message *why)
{
    const double low = cv_number_get_double(alpha_min), high = cv_number_get_double(alpha_max);
    cv_status status = allocate(out, mass_count) ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
    for (size_t k = 0; status == CV_OK && k < CMP_SWEEP; k++) {
        cmp_sweep_sample *s = &out->samples[k];
        s->status = CV_UNDECIDED;
        s->why.text[0] = '\0';
        for (size_t try = 0; s->status == CV_UNDECIDED && try < TRIES; try++) {
            s->alpha = velocity(low, high, k, try);
            s->status = count(s, methods, handles, mass_count, mass_ratios);
        }
        if (s->status != CV_OK && s->status != CV_UNDECIDED)
            status = cv_fail(why, s->status, "%s", s->why.text);
    }
    if (status != CV_OK)
        cmp_sweep_clear(out);
    return status;
}
