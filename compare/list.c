#include "compare/method.h"

#include <math.h>
#include <stdlib.h>

void cmp_list_init(cmp_list *list)
{
    list->count = 0;
    list->items = NULL;
    list->status = CV_OK;
    list->why.text[0] = '\0';
}

void cmp_list_clear(cmp_list *list)
{
    for (size_t i = 0; i < list->count; i++) {
        cmp_transition *t = &list->items[i];
        mpfr_clears(t->alpha, t->q, t->alpha_error, t->q_error, (mpfr_ptr)0);
    }
    free(list->items);
    cmp_list_init(list);
}

/* A bound below the unit in the last place of its value (0, or lost to underflow) says more than the value
 * can hold; NaN stays NaN, for the judge to see. */
static void set_error(mpfr_ptr out, double bound, mpfr_srcptr value)
{
    mpfr_set_d(out, bound, MPFR_RNDU);
    if (!mpfr_regular_p(value) || isnan(bound))
        return;
    mpfr_t unit;
    mpfr_init2(unit, 53);
    mpfr_set_ui_2exp(unit, 1, mpfr_get_exp(value) - (mpfr_exp_t)mpfr_get_prec(value), MPFR_RNDU);
    if (mpfr_less_p(out, unit))
        mpfr_set(out, unit, MPFR_RNDU);
    mpfr_clear(unit);
}

cv_status cmp_list_append(cmp_list *list, mpfr_srcptr alpha, mpfr_srcptr q, double alpha_error,
                          double q_error, int below, int above, cv_status decided, cv_message *why)
{
    cmp_transition *items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (items == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    list->items = items;
    cmp_transition *t = &items[list->count++];
    mpfr_init2(t->alpha, mpfr_get_prec(alpha));
    mpfr_init2(t->q, mpfr_get_prec(q));
    mpfr_inits2(53, t->alpha_error, t->q_error, (mpfr_ptr)0);
    mpfr_set(t->alpha, alpha, MPFR_RNDN);
    mpfr_set(t->q, q, MPFR_RNDN);
    set_error(t->alpha_error, alpha_error, alpha);
    set_error(t->q_error, q_error, q);
    t->below = below;
    t->above = above;
    t->decided = decided;
    t->at_resonance = 0;
    return CV_OK;
}

size_t cmp_list_limit(const cmp_list *list)
{
    size_t i = 0;
    while (i < list->count && !(list->items[i].below == 0 && list->items[i].above > 0))
        i++;
    return i;
}

int cmp_transition_at(const cmp_transition *t, const cv_number *alpha)
{
    mpfr_t distance, unit;
    mpfr_init2(distance, mpfr_get_prec(t->alpha) + 64);
    mpfr_init2(unit, 53);
    cv_number_get_mpfr(distance, alpha);
    mpfr_mul_2si(unit, distance, -52, MPFR_RNDU);
    mpfr_sub(distance, distance, t->alpha, MPFR_RNDN);
    mpfr_abs(distance, distance, MPFR_RNDN);
    const int at = mpfr_lessequal_p(distance, unit) || mpfr_lessequal_p(distance, t->alpha_error);
    mpfr_clears(distance, unit, (mpfr_ptr)0);
    return at;
}
