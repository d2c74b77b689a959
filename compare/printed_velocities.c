#include "compare/printed_velocities.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "semianalytic/pseudocritical.h"
#include "semianalytic/resonances.h"

enum { DIGITS = 20, EXTRA_DECIMALS = 3 };

/* Where pseudocritical velocities are looked for: around those printed. */
static const double SEARCHED[] = {0.2, 0.6};

/* "0.449" has three decimals. */
static int decimals(const char *printed)
{
    const char *point = strchr(printed, '.');
    return point == NULL ? 0 : (int)strlen(point + 1);
}

/* Whether x rounds to what is printed. */
static int rounds_to(double x, const char *printed)
{
    char text[CMP_PRINTED_SIZE];
    snprintf(text, sizeof text, "%.*f", decimals(printed), x);
    return strcmp(text, printed) == 0;
}

/* A computed velocity and what it is. */
typedef struct {
    double alpha;
    const char *kind;
} velocity;

/* The candidate nearest to alpha; of that kind, unless any will do or there is none of the kind. */
static const velocity *nearest(const velocity *candidates, size_t count, double alpha, const char *kind)
{
    const velocity *best = NULL;
    int best_kind = 0;
    for (size_t i = 0; i < count; i++) {
        const velocity *v = &candidates[i];
        const int same = strcmp(kind, "any") == 0 || strcmp(kind, v->kind) == 0;
        if (same < best_kind ||
            (best != NULL && same == best_kind && !(fabs(v->alpha - alpha) < fabs(best->alpha - alpha))))
            continue;
        best = v;
        best_kind = same;
    }
    return best;
}

static void fill(cmp_printed_row *row, const cmp_printed_entry *entry, const char *printed, const char *kind,
                 const velocity *found)
{
    const int any = strcmp(kind, "any") == 0;
    snprintf(row->item, sizeof row->item, "%s", entry->item);
    snprintf(row->where, sizeof row->where, "%s", entry->where);
    if (any)
        snprintf(row->printed, sizeof row->printed, "%s", printed);
    else
        snprintf(row->printed, sizeof row->printed, "%s (%s)", printed, kind);
    snprintf(row->computed, sizeof row->computed, "none");
    row->agrees = 0;
    if (found == NULL)
        return;
    snprintf(row->computed, sizeof row->computed, "%.*f (%s)", decimals(printed) + EXTRA_DECIMALS,
             found->alpha, found->kind);
    row->agrees = rounds_to(found->alpha, printed) && (any || strcmp(kind, found->kind) == 0);
}

static cv_status add_rows(cmp_printed *out, size_t room, const cmp_printed_entry *entry,
                          const velocity *candidates, size_t count, cv_message *why)
{
    char text[CMP_PRINTED_TEXT], *rest = NULL;
    memcpy(text, entry->printed, sizeof text);
    for (char *printed = strtok_r(text, " ", &rest); printed != NULL; printed = strtok_r(NULL, " ", &rest)) {
        const char *kind = strtok_r(NULL, " ", &rest);
        if (kind == NULL || out->count == room)
            return cv_fail(why, CV_FAILED, "data/printed.ini as compiled in: [%s %s]", entry->kind,
                           entry->key);
        fill(&out->rows[out->count++], entry, printed, kind,
             nearest(candidates, count, strtod(printed, NULL), kind));
    }
    return CV_OK;
}

cv_status cmp_printed_resonances(cmp_printed *out, size_t room, const cmp_printed_entry *entry,
                                 const cv_params *track, cv_message *why)
{
    sa_resonance_list list;
    cv_status status = sa_resonances(&list, track, DIGITS, why);
    if (status != CV_OK)
        return status;
    velocity *candidates = calloc(list.count + 1, sizeof *candidates);
    for (size_t i = 0; candidates != NULL && i < list.count; i++)
        candidates[i] =
            (velocity){mpfr_get_d(list.item[i].alpha, MPFR_RNDN), sa_resonance_kind_text(list.item[i].kind)};
    status = candidates != NULL ? add_rows(out, room, entry, candidates, list.count, why)
                                : cv_fail(why, CV_FAILED, "out of memory");
    free(candidates);
    sa_resonances_clear(&list);
    return status;
}

cv_status cmp_printed_pseudocritical(cmp_printed *out, size_t room, const cmp_printed_entry *entry,
                                     const cv_params *track, cv_message *why)
{
    static const char *const kinds[SA_CURVES] = {
        [SA_CURVE_MAX] = "max", [SA_CURVE_MIN] = "min", [SA_CURVE_ACTIVE_POINT] = "active_point"};
    sa_pseudocritical_list list;
    cv_status status = sa_pseudocritical_find(&list, track, SEARCHED[0], SEARCHED[1], why);
    if (status != CV_OK)
        return status;
    velocity *candidates = calloc(list.count + 1, sizeof *candidates);
    for (size_t i = 0; candidates != NULL && i < list.count; i++)
        candidates[i] = (velocity){(double)list.item[i].alpha, kinds[list.item[i].of]};
    status = candidates != NULL ? add_rows(out, room, entry, candidates, list.count, why)
                                : cv_fail(why, CV_FAILED, "out of memory");
    free(candidates);
    sa_pseudocritical_clear(&list);
    return status;
}
