#include "compare/printed_velocities.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "semianalytic/resonances.h"

enum { DIGITS = 20, EXTRA_DECIMALS = 3 };

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

static const sa_resonance *nearest(const sa_resonance_list *list, double alpha)
{
    const sa_resonance *best = NULL;
    for (size_t i = 0; i < list->count; i++)
        if (best == NULL || fabs(mpfr_get_d(list->item[i].alpha, MPFR_RNDN) - alpha) <
                                fabs(mpfr_get_d(best->alpha, MPFR_RNDN) - alpha))
            best = &list->item[i];
    return best;
}

static void fill(cmp_printed_row *row, const cmp_printed_entry *entry, const char *velocity, const char *kind,
                 const sa_resonance *found)
{
    snprintf(row->item, sizeof row->item, "%s", entry->item);
    snprintf(row->where, sizeof row->where, "%s", entry->where);
    snprintf(row->printed, sizeof row->printed, "%s (%s)", velocity, kind);
    snprintf(row->computed, sizeof row->computed, "none");
    row->agrees = 0;
    if (found == NULL)
        return;
    const double alpha = mpfr_get_d(found->alpha, MPFR_RNDN);
    const char *computed_kind = sa_resonance_kind_text(found->kind);
    snprintf(row->computed, sizeof row->computed, "%.*f (%s)", decimals(velocity) + EXTRA_DECIMALS, alpha,
             computed_kind);
    row->agrees = rounds_to(alpha, velocity) && strcmp(kind, computed_kind) == 0;
}

cv_status cmp_printed_resonances(cmp_printed *out, size_t room, const cmp_printed_entry *entry,
                                 const cv_params *track, cv_message *why)
{
    sa_resonance_list list;
    char text[CMP_PRINTED_TEXT], *rest = NULL;
    cv_status status = sa_resonances(&list, track, DIGITS, why);
    if (status != CV_OK)
        return status;
    memcpy(text, entry->printed, sizeof text);
    for (char *velocity = strtok_r(text, " ", &rest); velocity != NULL;
         velocity = strtok_r(NULL, " ", &rest)) {
        const char *kind = strtok_r(NULL, " ", &rest);
        if (kind == NULL || out->count == room) {
            status =
                cv_fail(why, CV_FAILED, "data/printed.ini as compiled in: [%s %s]", entry->kind, entry->key);
            break;
        }
        fill(&out->rows[out->count++], entry, velocity, kind, nearest(&list, strtod(velocity, NULL)));
    }
    sa_resonances_clear(&list);
    return status;
}
