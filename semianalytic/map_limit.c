/* The map of an undamped track: surroundings of special velocities are closed. */
#include <math.h>
#include <stdlib.h>

#include "semianalytic/map_build.h"

typedef struct {
    double low, high;    /* velocities */
    double below, above; /* distances from the ends to the outermost special velocities inside */
    int special;         /* as in sa_column */
} closure;

/* All curves at this distance on either side of alpha stand clear of one another; outside the range there is
 * nothing to be clear of. */
static cv_status clear_at(int *clear, const sa_map *map, double alpha, double distance)
{
    const double least = 2e-11;
    *clear = 1;
    for (int side = -1; side <= 1 && *clear; side += 2) {
        double width = INFINITY, there = alpha + side * distance;
        if (there > map->curves.alpha_min && there < map->curves.alpha_max &&
            sa_map_narrowest(&width, map, there) != CV_OK)
            return CV_FAILED;
        *clear = width > least;
    }
    return CV_OK;
}

static cv_status close_around(closure *out, const sa_map *map, double alpha)
{
    const double first = 1e-11, last = 1e-3, factor = 4;
    double reach = first * alpha;
    int clear = 0;
    cv_status status = clear_at(&clear, map, alpha, reach);
    while (status == CV_OK && !clear && reach < last * alpha) {
        reach *= factor;
        status = clear_at(&clear, map, alpha, reach);
    }
    *out = (closure){alpha - reach, alpha + reach, reach, reach, SA_COLUMN_PLAIN};
    for (size_t i = 0; i < map->curves.special_count; ++i)
        if (map->curves.special[i].alpha == alpha)
            out->special = (int)i;
    return status;
}

static int joined(int a, int b)
{
    return a == b || b == SA_COLUMN_PLAIN ? a : a == SA_COLUMN_PLAIN ? b : SA_COLUMN_SEVERAL;
}

/* Appends, or widens the last one where they meet. */
static void append(closure *list, size_t *count, const closure *item)
{
    closure *last = *count > 0 ? &list[*count - 1] : NULL;
    if (last == NULL || item->low > last->high) {
        list[(*count)++] = *item;
        return;
    }
    last->special = joined(last->special, item->special);
    if (item->low < last->low) {
        last->low = item->low;
        last->below = item->below;
    }
    if (item->high > last->high) {
        last->high = item->high;
        last->above = item->above;
    }
}

static cv_status find_closures(closure *list, size_t *count, const sa_map *map, const sa_map_cuts *cuts)
{
    *count = 0;
    for (size_t i = 0; i < cuts->count; ++i) {
        closure c;
        if (!cuts->cut[i].graded)
            continue;
        if (close_around(&c, map, cuts->cut[i].alpha) != CV_OK)
            return CV_FAILED;
        append(list, count, &c);
    }
    return CV_OK;
}

static int inside(const closure *list, size_t count, double alpha)
{
    for (size_t i = 0; i < count; ++i)
        if (alpha >= list[i].low && alpha <= list[i].high)
            return 1;
    return 0;
}

static cv_status replace(sa_map_cuts *cuts, const closure *list, size_t count, const sa_map *map)
{
    double range[2] = {map->curves.alpha_min, map->curves.alpha_max};
    sa_map_cuts out = {0};
    cv_status status = CV_OK;
    for (size_t i = 0; i < cuts->count && status == CV_OK; ++i)
        if (!inside(list, count, cuts->cut[i].alpha))
            status = sa_map_cuts_add(&out, cuts->cut[i].alpha, 0);
    for (size_t i = 0; i < count && status == CV_OK; ++i) {
        double ends[2] = {fmax(list[i].low, range[0]), fmin(list[i].high, range[1])};
        for (int j = 0; j < 2 && status == CV_OK; ++j) {
            status = sa_map_cuts_add(&out, ends[j], 1);
            if (status == CV_OK)
                out.cut[out.count - 1].length = j ? list[i].above : list[i].below;
        }
        if (status == CV_OK) {
            out.cut[out.count - 2].closes = 1;
            out.cut[out.count - 2].special = list[i].special;
        }
    }
    free(cuts->cut);
    *cuts = out;
    return status;
}

cv_status sa_map_close(const sa_map *map, sa_map_cuts *cuts)
{
    size_t count;
    closure *list = calloc(cuts->count + 1, sizeof *list);
    cv_status status = list == NULL ? CV_FAILED : find_closures(list, &count, map, cuts);
    if (status == CV_OK)
        status = replace(cuts, list, count, map);
    free(list);
    return status;
}
