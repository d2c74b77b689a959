#include "dgreen/transitions_check.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/winding.h"

/* Velocities between two neighbouring transitions of one list */
typedef struct {
    double low, high;
    int seen; /* a curve in it has been counted */
} gap;

typedef struct {
    dg_transition_list *lists;
    size_t count;
    const double *x;
    double x_floor;
    const dg_probe *probe;
    dg_curve curve;
    size_t gap_count;
    gap *gaps; /* narrow ones first: a curve in one lies in wider ones of the other lists as well */
    cv_message *why;
} check;

static int narrower(const void *a, const void *b)
{
    const gap *one = a, *other = b;
    const double x = one->high - one->low, y = other->high - other->low;
    if (x < y || x > y)
        return x < y ? -1 : 1;
    return (one->low > other->low) - (one->low < other->low);
}

static void list_gaps(check *c, const dg_transition_list *list, double alpha_min, double alpha_max)
{
    double low = alpha_min;
    for (size_t i = 0; i <= list->count; i++) {
        const double high = i < list->count ? mpfr_get_d(list->items[i].alpha, MPFR_RNDN) : alpha_max;
        if (high - low > 16 * DBL_EPSILON * high)
            c->gaps[c->gap_count++] = (gap){low, high, 0};
        low = high;
    }
}

/* The number of unstable roots that the list has at alpha */
static int running(const dg_transition_list *list, double alpha)
{
    int count = list->count_at_min;
    for (size_t i = 0; i < list->count && mpfr_cmp_d(list->items[i].alpha, alpha) < 0; i++)
        count = list->items[i].count_above;
    return count;
}

static void compare(dg_transition_list *list, dg_curve *curve, const dg_probe *probe, double x)
{
    cv_message unused;
    int roots;
    if (list->status != CV_OK || dg_curve_separate(curve, probe, x, &unused) != CV_OK)
        return;
    const double alpha = curve->at.alpha;
    list->status = dg_winding(&roots, curve, x, &list->why);
    if (list->status == CV_OK && roots != running(list, alpha))
        list->status = cv_fail(&list->why, CV_UNDECIDED,
                               "the transitions leave %d unstable roots at alpha = %.17g, the winding is %d",
                               running(list, alpha), alpha, roots);
}

static cv_status count_at(check *c, double alpha)
{
    const cv_status status = dg_curve_at(&c->curve, c->probe, alpha, c->x_floor, c->why);
    for (size_t k = 0; k < c->count && status == CV_OK; k++)
        compare(&c->lists[k], &c->curve, c->probe, c->x[k]);
    for (size_t i = 0; i < c->gap_count; i++)
        c->gaps[i].seen |= alpha > c->gaps[i].low && alpha < c->gaps[i].high;
    if (status != CV_UNDECIDED)
        return status;
    c->why->text[0] = '\0';
    return CV_OK;
}

cv_status dg_check_lists(dg_transition_list *lists, size_t count, const double *x, double x_floor,
                         const dg_probe *probe, double alpha_min, double alpha_max, cv_message *why)
{
    check c = {.lists = lists, .count = count, .x = x, .x_floor = x_floor, .probe = probe, .why = why};
    size_t most = count;
    for (size_t k = 0; k < count; k++)
        most += lists[k].count;
    c.gaps = malloc(most * sizeof *c.gaps);
    if (c.gaps == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t k = 0; k < count; k++)
        if (lists[k].status == CV_OK)
            list_gaps(&c, &lists[k], alpha_min, alpha_max);
    qsort(c.gaps, c.gap_count, sizeof *c.gaps, narrower);
    cv_status status = CV_OK;
    for (size_t i = 0; i < c.gap_count && status == CV_OK; i++)
        if (!c.gaps[i].seen)
            status = count_at(&c, c.gaps[i].low + (c.gaps[i].high - c.gaps[i].low) / 2);
    dg_curve_clear(&c.curve);
    free(c.gaps);
    return status;
}
