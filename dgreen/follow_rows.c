/* Where continuation starts when a sweep along q jumps, above all to the beginning of the next row: the roots
 * change little from one velocity to the next, much from the last frequency to the first. */
#include <math.h>
#include <stdlib.h>

#include "dgreen/follow.h"

/* A jump is a change of q by more than this factor. */
static const double FAR = 1.2;
/* A row of fewer points is no sweep. */
enum { LONG_ROW = 16 };

void dg_follow_row_clear(dg_follow_row *row)
{
    free(row->q);
    free(row->roots);
    *row = (dg_follow_row){0};
}

/* How different the points are: logarithms of the ratios */
static double distance(double alpha, double q, double other_alpha, double other_q)
{
    return fabs(log(q / other_q)) + fabs(log(alpha / other_alpha));
}

/* The point of the row next to q; count > 0 */
static size_t nearest(const dg_follow_row *row, double q)
{
    size_t low = 0, high = row->count - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(row->q[middle] < q ? &low : &high) = middle;
    }
    return q * q < row->q[low] * row->q[high] ? low : high;
}

void dg_follow_jump(dg_follow *f, double alpha, double q)
{
    if (f->warm && q < FAR * f->q && f->q < FAR * q)
        return;
    double least = f->warm ? distance(alpha, q, f->here.alpha, f->q) : HUGE_VAL;
    const dg_follow_row *rows[2] = {&f->here, &f->before};
    for (int i = 0; i < 2; i++) {
        if (rows[i]->count == 0)
            continue;
        const size_t k = nearest(rows[i], q);
        const double d = distance(alpha, q, rows[i]->alpha, rows[i]->q[k]);
        if (!(d < least))
            continue;
        least = d;
        f->roots = rows[i]->roots[k];
        f->warm = 1;
    }
}

static int reserve(dg_follow_row *row)
{
    if (row->count < row->room)
        return 1;
    const size_t room = row->room ? 2 * row->room : 256;
    double *q = realloc(row->q, room * sizeof *q);
    if (q != NULL)
        row->q = q;
    dg_roots *roots = q ? realloc(row->roots, room * sizeof *roots) : NULL;
    if (roots == NULL)
        return 0;
    row->roots = roots;
    row->room = room;
    return 1;
}

void dg_follow_note(dg_follow *f, double alpha, double q)
{
    f->q = q;
    if (alpha != f->here.alpha) {
        if (f->here.count >= LONG_ROW) {
            const dg_follow_row old = f->before;
            f->before = f->here;
            f->here = old;
        }
        f->here.count = 0;
        f->here.alpha = alpha;
    }
    dg_follow_row *row = &f->here;
    if (row->count > 0 && q <= row->q[row->count - 1]) {
        if (row->count >= LONG_ROW)
            return;
        row->count = 0; /* that was no sweep: one may begin here */
    }
    if (!reserve(row))
        return;
    row->q[row->count] = q;
    row->roots[row->count++] = f->roots;
}
