#include "semianalytic/map_build.h"

#include <math.h>
#include <stdlib.h>

cv_status sa_map_cuts_add(sa_map_cuts *cuts, double alpha, int graded)
{
    if (cuts->count == cuts->room) {
        size_t room = 2 * cuts->room + 16;
        sa_map_cut *more = realloc(cuts->cut, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        cuts->cut = more;
        cuts->room = room;
    }
    cuts->cut[cuts->count++] = (sa_map_cut){.alpha = alpha, .graded = graded};
    return CV_OK;
}

static int by_alpha(const void *left, const void *right)
{
    const sa_map_cut *a = left, *b = right;
    return (a->alpha > b->alpha) - (a->alpha < b->alpha);
}

void sa_map_cuts_sort(sa_map_cuts *cuts)
{
    size_t kept = 0;
    qsort(cuts->cut, cuts->count, sizeof *cuts->cut, by_alpha);
    for (size_t i = 0; i < cuts->count; ++i) {
        sa_map_cut *last = kept > 0 ? &cuts->cut[kept - 1] : NULL;
        if (last != NULL && cuts->cut[i].alpha - last->alpha < 4e-16 * cuts->cut[i].alpha)
            last->graded |= cuts->cut[i].graded;
        else
            cuts->cut[kept++] = cuts->cut[i];
    }
    cuts->count = kept;
}

/* Where an arc that runs to p = infinity at the shear speed becomes negligible, it ends. */
static cv_status cut_infinite_arcs(sa_map_cuts *cuts, const sa_map *map)
{
    const sa_branch_curves *curves = &map->curves;
    for (size_t i = 0; i < curves->arc_count; ++i) {
        const sa_branch_arc *a = &curves->arc[i];
        long double low = a->alpha_low, shear = a->alpha_high, step = shear - low;
        if (!isinf(a->p_high))
            continue;
        for (int j = 0; j < 60; ++j) { /* alpha = shear - step */
            sa_wave wave;
            long double q;
            step /= 2;
            if (sa_branch_arc_at(&wave, &q, curves, i, shear - step) != CV_OK)
                return CV_FAILED;
            if (sa_map_negligible(map, &wave, (double)fabsl(q)))
                break;
        }
        double cut = (double)(shear - step);
        if (cut > curves->alpha_min && cut < curves->alpha_max && sa_map_cuts_add(cuts, cut, 0) != CV_OK)
            return CV_FAILED;
    }
    return CV_OK;
}

static cv_status collect_cuts(sa_map_cuts *cuts, sa_map *map)
{
    const sa_branch_curves *curves = &map->curves;
    if (sa_map_cuts_add(cuts, curves->alpha_min, 0) != CV_OK ||
        sa_map_cuts_add(cuts, curves->alpha_max, 0) != CV_OK)
        return CV_FAILED;
    for (size_t i = 0; i < curves->special_count; ++i)
        /* without damping zeta is smooth at the shear speed, whose arcs are cut below */
        if (!(map->undamped && curves->special[i].kind == SA_SPECIAL_SHEAR) &&
            sa_map_cuts_add(cuts, curves->special[i].alpha, 1) != CV_OK)
            return CV_FAILED;
    if (sa_map_ghosts(map, cuts) != CV_OK || cut_infinite_arcs(cuts, map) != CV_OK ||
        sa_map_dips(map, cuts) != CV_OK)
        return CV_FAILED;
    sa_map_cuts_sort(cuts);
    if (!map->undamped)
        return CV_OK;
    cv_status status = sa_map_close(map, cuts);
    sa_map_cuts_sort(cuts);
    return status;
}

static cv_status make_columns(sa_map *map, const sa_map_cuts *cuts)
{
    map->column = calloc(cuts->count, sizeof *map->column);
    if (map->column == NULL)
        return CV_FAILED;
    for (size_t i = 0; i + 1 < cuts->count; ++i) {
        sa_column *c = &map->column[map->count++];
        c->alpha_low = cuts->cut[i].alpha;
        c->alpha_high = cuts->cut[i + 1].alpha;
        c->closed = cuts->cut[i].closes;
        c->special = cuts->cut[i].special;
        if (sa_map_column_fill(c, map, cuts->cut[i].graded, cuts->cut[i + 1].graded) != CV_OK)
            return CV_FAILED;
        if (cuts->cut[i].length > 0)
            c->length_low = cuts->cut[i].length;
        if (cuts->cut[i + 1].length > 0)
            c->length_high = cuts->cut[i + 1].length;
    }
    return CV_OK;
}

cv_status sa_map_build(sa_map *out, const cv_params *params, double alpha_min, double alpha_max,
                       cv_message *why)
{
    sa_map_cuts cuts = {0};
    *out = (sa_map){0};
    cv_status status = sa_branch_curves_build(&out->curves, params, alpha_min, alpha_max, why);
    if (status != CV_OK)
        return status;
    out->eta_p = cv_number_get_double(&params->eta_p);
    out->eta_b = cv_number_get_double(&params->eta_b);
    out->eta_f = cv_number_get_double(&params->eta_f);
    out->undamped = cv_params_undamped(params);
    status = collect_cuts(&cuts, out);
    if (status == CV_OK)
        status = make_columns(out, &cuts);
    free(cuts.cut);
    if (status != CV_OK) {
        sa_map_clear(out);
        return cv_fail(why, status, "the branch curves of the track could not be arranged in columns");
    }
    return CV_OK;
}
