#include "compare/roots.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "compare/roots_putback.h"

/* Roots this far apart, relative to |qbar|, are not one root computed twice. */
static const double PAIR_DISTANCE = 1e-3;
/* Stable roots are looked for at least down to -DEPTH, and this much deeper than the other method's. */
static const double DEPTH = 1, DEEPER = 1.01;

/* |a - b| / |a|, in double: differences are exact before they are rounded. */
static double distance(const cmp_root *a, const cmp_root *b)
{
    mpfr_t re, im;
    mpfr_inits2(64, re, im, (mpfr_ptr)0);
    mpfr_sub(re, a->re, b->re, MPFR_RNDN);
    mpfr_sub(im, a->im, b->im, MPFR_RNDN);
    mpfr_hypot(re, re, im, MPFR_RNDN);
    mpfr_hypot(im, a->re, a->im, MPFR_RNDN);
    mpfr_div(re, re, im, MPFR_RNDN);
    const double d = mpfr_get_d(re, MPFR_RNDN);
    mpfr_clears(re, im, (mpfr_ptr)0);
    return d;
}

/* The item of the list nearest to r: NULL where nothing is near. */
static const cmp_root *nearest(const cmp_root *r, const cmp_root_list *list)
{
    const cmp_root *best = NULL;
    double best_distance = PAIR_DISTANCE;
    for (size_t i = 0; i < list->count; i++) {
        const double d = distance(r, &list->items[i]);
        if (d <= best_distance) {
            best = &list->items[i];
            best_distance = d;
        }
    }
    return best;
}

static const cmp_root *partner(const cmp_root *r, const cmp_root_list *own, const cmp_root_list *other)
{
    const cmp_root *near = nearest(r, other);
    return near != NULL && nearest(near, own) == r ? near : NULL;
}

static const cmp_root *any(const cmp_root_row *row)
{
    return row->by[0] != NULL ? row->by[0] : row->by[1];
}

static void row_init(cmp_root_row *row, const cmp_root *first, const cmp_root *second)
{
    row->by[0] = first;
    row->by[1] = second;
    row->unstable = mpfr_sgn(any(row)->re) > 0;
    cmp_verdict_init(&row->verdict);
    mpfr_init2(row->residual, 53);
    mpfr_set_zero(row->residual, 1);
    row->used = 0.0;
}

static int descending(const void *x, const void *y)
{
    const cmp_root *a = any(x), *b = any(y);
    const int order = mpfr_cmp(b->re, a->re);
    return order != 0 ? order : mpfr_cmp(a->im, b->im);
}

static cv_status make_rows(cmp_roots *r, cv_message *why)
{
    const cmp_root_list *a = &r->lists[0], *b = &r->lists[1];
    r->rows = malloc((a->count + b->count + 1) * sizeof *r->rows);
    if (r->rows == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < a->count; i++)
        row_init(&r->rows[r->count++], &a->items[i], partner(&a->items[i], a, b));
    for (size_t i = 0; i < b->count; i++)
        if (partner(&b->items[i], b, a) == NULL)
            row_init(&r->rows[r->count++], NULL, &b->items[i]);
    qsort(r->rows, r->count, sizeof *r->rows, descending);
    return CV_OK;
}

static int usable(const cmp_root *r)
{
    return mpfr_number_p(r->re) && mpfr_number_p(r->im) && mpfr_sgn(r->im) >= 0 && mpfr_number_p(r->error) &&
           mpfr_sgn(r->error) > 0;
}

/* The bound of a part that is not zero leaves the digits asked for. */
static int sharp(mpfr_srcptr part, mpfr_srcptr error, int digits)
{
    return mpfr_zero_p(part) || cmp_log10(error) - cmp_log10(part) <= -digits;
}

static void judge_claim(cmp_verdict *v, const cmp_root *r, const char *name, int digits)
{
    const double re = mpfr_get_d(r->re, MPFR_RNDN), im = mpfr_get_d(r->im, MPFR_RNDN);
    if (!usable(r))
        cmp_verdict_worsen(v, CMP_DISAGREE, "%s gives qbar = %.10g + %.10gi, not a number with a bound", name,
                           re, im);
    else if (r->decided != CV_OK || !sharp(r->re, r->error, digits) || !sharp(r->im, r->error, digits))
        cmp_verdict_worsen(v, CMP_UNDECIDED,
                           "the bounds of %s at qbar = %.10g + %.10gi do not give %d digits", name, re, im,
                           digits);
    else if (!(mpfr_cmpabs(r->re, r->error) > 0))
        cmp_verdict_worsen(v, CMP_UNDECIDED, "%s does not tell whether qbar = %.10g + %.10gi is stable", name,
                           re, im);
}

static void judge_row(cmp_root_row *row, const cmp_roots *r, const cmp_root_method *const methods[],
                      int digits)
{
    const cmp_root *a = row->by[0], *b = row->by[1];
    for (int m = 0; m < CMP_METHODS; m++)
        if (row->by[m] != NULL)
            judge_claim(&row->verdict, row->by[m], methods[m]->name, digits);
    if (a != NULL && b != NULL) {
        const mpfr_srcptr errors[] = {a->error, b->error};
        cmp_judge_coordinate(&row->verdict, "Re qbar", (const mpfr_srcptr[]){a->re, b->re}, errors, digits);
        cmp_judge_coordinate(&row->verdict, "Im qbar", (const mpfr_srcptr[]){a->im, b->im}, errors, digits);
    } else if (row->unstable && r->lists[0].status == CV_OK && r->lists[1].status == CV_OK) {
        cmp_verdict_worsen(&row->verdict, CMP_DISAGREE, "only %s has the unstable root %.10g + %.10gi",
                           methods[a == NULL]->name, mpfr_get_d(any(row)->re, MPFR_RNDN),
                           mpfr_get_d(any(row)->im, MPFR_RNDN));
    }
}

static int listed_unstable(const cmp_root_list *list)
{
    int n = 0;
    for (size_t i = 0; i < list->count; i++)
        if (mpfr_sgn(list->items[i].re) > 0)
            n += mpfr_zero_p(list->items[i].im) ? 1 : 2;
    return n;
}

static void judge_counts(cmp_roots *r, const cmp_root_method *const methods[])
{
    const cmp_root_list *lists = r->lists;
    for (int m = 0; m < CMP_METHODS; m++) {
        if (lists[m].status != CV_OK)
            cmp_verdict_worsen(&r->verdict, CMP_UNDECIDED, "%s could not decide: %.400s", methods[m]->name,
                               lists[m].why.text);
        else if (lists[m].unstable != listed_unstable(&lists[m]))
            cmp_verdict_worsen(&r->verdict, CMP_DISAGREE, "%s counts %d unstable roots but lists %d",
                               methods[m]->name, lists[m].unstable, listed_unstable(&lists[m]));
    }
    if (lists[0].unstable >= 0 && lists[1].unstable >= 0 && lists[0].unstable != lists[1].unstable)
        cmp_verdict_worsen(&r->verdict, CMP_DISAGREE, "%s counts %d unstable roots, %s %d", methods[0]->name,
                           lists[0].unstable, methods[1]->name, lists[1].unstable);
}

static void gather(cmp_roots *r, int digits)
{
    for (size_t i = 0; i < r->count; i++) {
        const cmp_verdict *v = &r->rows[i].verdict;
        if (v->kind != CMP_AGREE)
            cmp_verdict_worsen(&r->verdict, v->kind, "%s", v->reason.text);
        r->verdict.digits = fmin(r->verdict.digits, v->digits);
    }
    if (isinf(r->verdict.digits))
        r->verdict.digits = digits;
}

static double depth_of(const cmp_root_list *list)
{
    double depth = DEPTH;
    for (size_t i = 0; i < list->count; i++)
        depth = fmax(depth, -DEEPER * mpfr_get_d(list->items[i].re, MPFR_RNDN));
    return depth;
}

static cv_status find_and_judge(cmp_roots *r, const cmp_root_method *const methods[], void *const handles[],
                                const cv_number *mass_ratio, int digits, cv_message *why)
{
    cv_status status = methods[1]->find(handles[1], &r->lists[1], DEPTH, digits, why);
    if (status == CV_OK)
        status = methods[0]->find(handles[0], &r->lists[0], depth_of(&r->lists[1]), digits, why);
    if (status == CV_OK)
        status = make_rows(r, why);
    if (status != CV_OK)
        return status;
    judge_counts(r, methods);
    for (size_t i = 0; status == CV_OK && i < r->count; i++) {
        judge_row(&r->rows[i], r, methods, digits);
        status = cmp_roots_put_back(&r->rows[i], methods, handles, mass_ratio, why);
    }
    gather(r, digits);
    return status;
}

cv_status cmp_roots_compare(cmp_roots *out, const cmp_root_method *const methods[CMP_METHODS],
                            const cv_params *track, const cv_number *alpha, const cv_number *mass_ratio,
                            int digits, cv_message *why)
{
    void *handles[CMP_METHODS];
    int opened = 0;
    cv_status status = CV_OK;
    out->count = 0;
    out->rows = NULL;
    cmp_verdict_init(&out->verdict);
    for (int m = 0; m < CMP_METHODS; m++)
        cmp_root_list_init(&out->lists[m]);
    for (; status == CV_OK && opened < CMP_METHODS; opened += status == CV_OK)
        status = methods[opened]->open(&handles[opened], track, alpha, mass_ratio, why);
    if (status == CV_OK)
        status = find_and_judge(out, methods, handles, mass_ratio, digits, why);
    while (opened-- > 0)
        methods[opened]->close(handles[opened]);
    if (status != CV_OK)
        cmp_roots_clear(out);
    return status;
}

void cmp_roots_clear(cmp_roots *r)
{
    for (size_t i = 0; i < r->count; i++)
        mpfr_clear(r->rows[i].residual);
    free(r->rows);
    r->rows = NULL;
    r->count = 0;
    for (int m = 0; m < CMP_METHODS; m++)
        cmp_root_list_clear(&r->lists[m]);
}
