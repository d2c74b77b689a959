#include "compare/roots.h"

#include <stdlib.h>

void cmp_root_list_init(cmp_root_list *list)
{
    *list = (cmp_root_list){.unstable = -1, .status = CV_OK};
}

void cmp_root_list_clear(cmp_root_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        mpfr_clears(list->items[i].re, list->items[i].im, list->items[i].error, (mpfr_ptr)0);
    free(list->items);
    cmp_root_list_init(list);
}

cv_status cmp_root_list_append(cmp_root_list *list, mpfr_srcptr re, mpfr_srcptr im, mpfr_srcptr error,
                               cv_status decided, cv_message *why)
{
    cmp_root *items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (items == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    list->items = items;
    cmp_root *r = &items[list->count++];
    mpfr_init2(r->re, mpfr_get_prec(re));
    mpfr_init2(r->im, mpfr_get_prec(im));
    mpfr_init2(r->error, 53);
    mpfr_set(r->re, re, MPFR_RNDN);
    mpfr_set(r->im, im, MPFR_RNDN);
    mpfr_set(r->error, error, MPFR_RNDU);
    r->decided = decided;
    return CV_OK;
}
