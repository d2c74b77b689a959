#include <math.h>

#include "semianalytic/crossings.h"
#include "semianalytic/lines_parts.h"

/* N on both sides of the crossing at eta_M, q; 0 when it cannot be told from the others. */
static int count_at(sa_branch *b, const sa_crossings *list, double eta_M, double q)
{
    const double near = 1e-3, same_mass = 0.02;
    const sa_crossing *own = NULL;
    int below = 0;
    for (size_t i = 0; i < list->count; ++i) {
        const sa_crossing *c = &list->items[i];
        double excess = c->re * eta_M - 1;
        if (fabs(c->q - q) < near * q && fabs(excess) < same_mass) {
            if (own != NULL)
                return 0;
            own = c;
        } else if (!(fabs(excess) > near + 2 * c->re_error * eta_M)) {
            return 0;
        } else if (excess > 0) {
            below += 2 * c->direction;
        }
    }
    if (own == NULL)
        return 0;
    b->roots_left = own->direction > 0 ? below + 2 : below;
    b->roots_right = own->direction > 0 ? below : below - 2;
    return b->roots_right >= 0;
}

static cv_status try_vertex(sa_branch *b, const sa_line_store *store, size_t i)
{
    const sa_line_vertex *v = &b->vertex[i];
    double alpha = mpfr_get_d(v->alpha, MPFR_RNDN), q = mpfr_get_d(v->q, MPFR_RNDN),
           eta_M = mpfr_get_d(v->eta_M, MPFR_RNDN);
    sa_crossings list;
    if (v->decided != CV_OK || (v->marks & (SA_MARK_TURN | SA_MARK_VERTICAL | SA_MARK_CURVE)))
        return CV_OK;
    cv_status status = sa_crossings_find(&list, &store->map, store->field, alpha, 0.5 / eta_M, NULL);
    if (status == CV_OK && count_at(b, &list, eta_M, q)) {
        b->counted = CV_OK;
        b->counted_at = i;
    }
    sa_crossings_clear(&list);
    return status == CV_FAILED ? status : CV_OK;
}

/* N beside a closed column. */
static cv_status beside(int *roots, const sa_line_store *store, double alpha, double eta_M)
{
    sa_crossings list;
    cv_status status = sa_crossings_find(&list, &store->map, store->field, alpha, 0.5 / eta_M, NULL);
    if (status == CV_OK)
        status = sa_crossings_count(roots, &list, 1 / eta_M);
    sa_crossings_clear(&list);
    return status;
}

/* A vertical branch between its ends. Where it is not the only one at its velocity, it is next to one side.
 */
static cv_status count_vertical(sa_branch *b, const sa_line_store *store)
{
    const sa_map *map = &store->map;
    const sa_line_vertex *from = &b->vertex[0], *to = &b->vertex[b->count - 1];
    double alpha = mpfr_get_d(from->alpha, MPFR_RNDN), low = mpfr_get_d(from->eta_M, MPFR_RNDN),
           high = mpfr_get_d(to->eta_M, MPFR_RNDN);
    int upwards = low < high, roots[2];
    size_t i = 0;
    while (i < map->count && !(map->column[i].closed && map->column[i].alpha_high > alpha))
        ++i;
    if (i == 0 || i + 1 >= map->count)
        return CV_OK;
    const sa_column *c = &map->column[i];
    double mass = sqrt(low * high),
           at[2] = {c->alpha_low - c[-1].length_high / 10, c->alpha_high + c[1].length_low / 10};
    for (int k = 0; k < 2; ++k) {
        cv_status status = beside(&roots[k], store, at[k], mass);
        if (status != CV_OK)
            return status == CV_UNDECIDED ? CV_OK : status;
    }
    int right = b->vertex[0].marks & SA_MARK_BELOW   ? !upwards
                : b->vertex[0].marks & SA_MARK_ABOVE ? upwards
                                                     : 0;
    int low_side = b->vertex[0].marks & (SA_MARK_BELOW | SA_MARK_ABOVE)
                       ? !(b->vertex[0].marks & SA_MARK_BELOW)
                       : !upwards;
    b->roots_left = roots[low_side] + (right ? 2 : 0);
    b->roots_right = b->roots_left - 2;
    b->counted = CV_OK;
    return CV_OK;
}

/* From the middle of the branch outwards. */
cv_status sa_branch_count(sa_branch *branch, const sa_line_store *store)
{
    enum { TRIES = 16 };
    cv_status status = CV_OK;
    size_t middle = branch->count / 2;
    branch->counted = CV_UNDECIDED;
    if ((branch->vertex[0].marks & SA_MARK_VERTICAL) &&
        (branch->vertex[branch->count - 1].marks & SA_MARK_VERTICAL))
        return count_vertical(branch, store);
    for (size_t k = 0; k < TRIES && status == CV_OK && branch->counted != CV_OK; ++k) {
        size_t step = (k + 1) / 2, i = k % 2 ? middle + step : middle - step;
        if (i < branch->count)
            status = try_vertex(branch, store, i);
    }
    return status;
}
