#include "semianalytic/crossings.h"
#include "semianalytic/transitions_parts.h"

/* The number of unstable roots that a list claims at alpha */
static int claimed(const sa_transitions *list, double alpha)
{
    size_t i = 0;
    while (i < list->count && mpfr_cmp_d(list->items[i].alpha, alpha) < 0)
        ++i;
    return i > 0 ? list->items[i - 1].above : list->roots_at_start;
}

/* Every list against the crossings at alpha; those that have a transition there say nothing. */
static void compare_all(const sa_verification *v, const sa_crossings *crossings, double alpha)
{
    for (size_t i = 0; i < v->count; ++i) {
        sa_transitions *list = &v->lists[v->index[i]];
        int roots;
        if (sa_crossings_count(&roots, crossings, v->level[i]) == CV_OK && roots != claimed(list, alpha))
            sa_transitions_doubt(list,
                                 "%d unstable roots at alpha = %.15g by crossings, %d by the transitions",
                                 roots, alpha, claimed(list, alpha));
    }
}

/* The crossings at alpha must tell the roots of list i: CV_UNDECIDED when they do not. */
static cv_status visit(const sa_verification *v, double alpha, size_t i)
{
    sa_crossings crossings;
    int roots;
    cv_status status =
        sa_crossings_find_finer(&crossings, v->map, v->field, alpha, v->re_low, v->refinement, NULL);
    if (status == CV_OK)
        compare_all(v, &crossings, alpha);
    if (status == CV_OK)
        status = sa_crossings_count(&roots, &crossings, v->level[i]);
    sa_crossings_clear(&crossings);
    return status;
}

/* At a velocity between low and high; at another one when the first is too near a transition. */
static cv_status visit_between(const sa_verification *v, double low, double high, size_t i)
{
    static const double fractions[] = {0.5, 0.4375, 0.59375, 0.3125, 0.71875};
    cv_status status = CV_UNDECIDED;
    for (int k = 0; k < 5 && status == CV_UNDECIDED; ++k)
        status = visit(v, low + fractions[k] * (high - low), i);
    if (status == CV_UNDECIDED)
        sa_transitions_doubt(&v->lists[v->index[i]],
                             "unstable roots could not be counted between alpha = %.15g and %.15g", low,
                             high);
    return status == CV_UNDECIDED ? CV_OK : status;
}

static cv_status verify_list(const sa_verification *v, size_t i)
{
    sa_transitions *list = &v->lists[v->index[i]];
    cv_status status = CV_OK;
    for (size_t k = 0; k <= list->count && status == CV_OK && list->decided == CV_OK; ++k) {
        double low = k > 0 ? mpfr_get_d(list->items[k - 1].alpha, MPFR_RNDU) : v->map->curves.alpha_min;
        double high =
            k < list->count ? mpfr_get_d(list->items[k].alpha, MPFR_RNDD) : v->map->curves.alpha_max;
        if (high - low > 8e-16 * high)
            status = visit_between(v, low, high, i);
    }
    return status;
}

cv_status sa_transitions_verify(const sa_verification *v)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < v->count && status == CV_OK; ++i)
        status = verify_list(v, i);
    for (size_t i = 0; i < v->count && status == CV_OK; ++i) {
        sa_transitions *list = &v->lists[v->index[i]];
        if (list->decided == CV_OK)
            status = visit(v, v->map->curves.alpha_max, i);
        if (status == CV_UNDECIDED) {
            sa_transitions_doubt(list, "unstable roots could not be counted at the highest velocity");
            status = CV_OK;
        }
    }
    return status;
}
