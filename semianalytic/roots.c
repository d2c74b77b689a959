#include "semianalytic/roots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "semianalytic/matrix.h"
#include "semianalytic/roots_digits.h"

static int descending(const void *a, const void *b)
{
    const sa_root *x = a, *y = b;
    int order = mpfr_cmp(y->re, x->re);
    return order != 0 ? order : mpfr_cmp(y->im, x->im);
}

/* -1 when a part of the plane cannot be told: the roots with Re qbar > 0, conjugates counted */
static int count_unstable(const sa_root_list *list)
{
    int n = 0;
    for (size_t i = 0; i < list->count; i++) {
        const sa_root *r = &list->items[i];
        if (mpfr_cmpabs_ui(r->re, 0) != 0 && !(fabsl(mpfr_get_ld(r->re, MPFR_RNDN)) > (long double)r->error))
            return -1;
        if (mpfr_sgn(r->re) > 0)
            n += mpfr_zero_p(r->im) ? 1 : 2;
    }
    return n;
}

static void judge(sa_root_list *list)
{
    int found = count_unstable(list);
    list->decided = CV_OK;
    if (found < 0)
        list->decided = cv_fail(&list->reason, CV_UNDECIDED, "a root is too near the imaginary axis");
    else if (found != list->unstable_roots)
        list->decided = cv_fail(&list->reason, CV_UNDECIDED, "%d roots with Re qbar > 0 found, %d there",
                                found, list->unstable_roots);
}

static cv_status polish_all(sa_root_list *list, const sa_rough_roots *rough, const sa_track *t,
                            const cv_number *alpha, const cv_number *mass_ratio, int digits)
{
    cv_status status = CV_OK;
    list->items = calloc((size_t)rough->count + 1, sizeof *list->items);
    if (list->items == NULL)
        return CV_FAILED;
    for (int i = 0; i < rough->count && status == CV_OK; i++) {
        status = sa_root_polish(&list->items[i], &rough->root[i], t, alpha, mass_ratio, digits);
        list->count++;
    }
    if (status == CV_OK)
        qsort(list->items, list->count, sizeof *list->items, descending);
    return status;
}

cv_status sa_roots_find(sa_root_list *out, const sa_track *t, const cv_number *alpha,
                        const cv_number *mass_ratio, double depth, int digits, cv_message *why)
{
    sa_contour contour;
    sa_rough_roots rough;
    const double velocity = cv_number_get_double(alpha), mass = cv_number_get_double(mass_ratio);
    memset(out, 0, sizeof *out);
    if (cv_number_sign(alpha) < 0 || cv_number_sign(mass_ratio) <= 0 || !(depth >= 0))
        return cv_fail(why, CV_BAD_INPUT, "alpha >= 0, eta_M > 0 and depth >= 0 are needed");
    if (t->undamped)
        return cv_fail(why, CV_BAD_INPUT,
                       "roots of an undamped track: its branch points lie on the imaginary axis");
    cv_status status = sa_contour_build(&contour, t, velocity, mass, 0, why);
    if (status != CV_OK)
        return status;
    out->unstable_roots = contour.roots;
    sa_roots_search(&rough, &contour, t, velocity, mass, depth);
    sa_contour_clear(&contour);
    status = polish_all(out, &rough, t, alpha, mass_ratio, digits);
    if (status != CV_OK) {
        sa_roots_clear(out);
        return cv_fail(why, status, "out of memory");
    }
    judge(out);
    return CV_OK;
}

void sa_roots_clear(sa_root_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        sa_root_clear(&list->items[i]);
    free(list->items);
    memset(list, 0, sizeof *list);
}
