#include "compare/convergence.h"

#include <math.h>

static double distance(const cmp_transition *a, const cmp_transition *b)
{
    mpfr_t x;
    mpfr_init2(x, 64);
    mpfr_sub(x, a->alpha, b->alpha, MPFR_RNDN);
    const double result = fabs(mpfr_get_d(x, MPFR_RNDN));
    mpfr_clear(x);
    return result;
}

static const cmp_transition *stability_limit(const cmp_list *list)
{
    const size_t i = cmp_list_limit(list);
    return i < list->count ? &list->items[i] : NULL;
}

static const cmp_transition *nearest(const cmp_list *list, const cmp_transition *to)
{
    const cmp_transition *best = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const cmp_transition *t = &list->items[i];
        const int same = (t->above > t->below) == (to->above > to->below);
        if (same && (best == NULL || distance(t, to) < distance(best, to)))
            best = t;
    }
    return best;
}

static int same_branch(const cmp_list *before, const cmp_transition *a, const cmp_list *after,
                       const cmp_transition *b)
{
    return a != NULL && b != NULL && nearest(after, a) == b && nearest(before, b) == a;
}

static void fill_row(cmp_convergence_row *row, const cmp_list *const *lists, const double *damping,
                     int *branches)
{
    const cmp_convergence_row *before = row - 1;
    if (row->limit == NULL)
        return;
    row->branch = *branches + 1;
    if (same_branch(lists[-1], before->limit, lists[0], row->limit)) {
        row->branch = before->branch;
        row->step = distance(before->limit, row->limit);
        row->order = log(before->step / row->step) / log(damping[-1] / damping[0]);
    } else {
        ++*branches;
    }
}

void cmp_convergence_study(cmp_convergence *out, cmp_convergence_row *rows, size_t count,
                           const cmp_list *const *lists, const double *damping, const cmp_list *undamped)
{
    int branches = 0;
    *out = (cmp_convergence){CMP_NONE, stability_limit(undamped), 0, NAN};
    for (size_t i = 0; i < count; i++) {
        cmp_convergence_row *row = &rows[i];
        *row = (cmp_convergence_row){stability_limit(lists[i]), 0, NAN, NAN, NAN};
        if (i > 0)
            fill_row(row, lists + i, damping + i, &branches);
        else if (row->limit != NULL)
            row->branch = branches = 1;
        if (i > 0 && row->branch != rows[i - 1].branch)
            out->jumps++;
        if (row->limit != NULL && out->limit != NULL)
            row->to_limit = distance(row->limit, out->limit);
    }
    const cmp_convergence_row *last = &rows[count - 1];
    if (last->limit == NULL || out->limit == NULL)
        return;
    out->kind = same_branch(lists[count - 1], last->limit, undamped, out->limit) ? CMP_TENDS : CMP_ELSEWHERE;
    out->order = last->order;
}
