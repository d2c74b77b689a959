#include "compare/judge.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* Two transitions this far apart, relatively, are not one transition computed twice. */
static const double PAIR_DISTANCE = 1e-3;

/* |x - y| / |x|, in double: differences are exact before they are rounded. */
static double relative_distance(mpfr_srcptr x, mpfr_srcptr y)
{
    mpfr_t d;
    mpfr_init2(d, 64);
    mpfr_sub(d, x, y, MPFR_RNDA);
    mpfr_div(d, d, x, MPFR_RNDA);
    mpfr_abs(d, d, MPFR_RNDN);
    double distance = mpfr_get_d(d, MPFR_RNDN);
    mpfr_clear(d);
    return distance;
}

static int direction(const cmp_transition *t)
{
    return (t->above > t->below) - (t->above < t->below);
}

static double distance(const cmp_transition *a, const cmp_transition *b)
{
    const double in_alpha = relative_distance(a->alpha, b->alpha),
                 in_q = a->at_resonance ? 0 : relative_distance(a->q, b->q);
    if (a->at_resonance != b->at_resonance)
        return HUGE_VAL;
    if (direction(a) != direction(b) || !(in_alpha <= PAIR_DISTANCE) || !(in_q <= PAIR_DISTANCE))
        return HUGE_VAL;
    return fmax(in_alpha, in_q);
}

/* The item of the list nearest to t: SIZE_MAX where nothing is near. */
static size_t nearest(const cmp_transition *t, const cmp_list *list)
{
    size_t best = SIZE_MAX;
    double best_distance = HUGE_VAL;
    for (size_t i = 0; i < list->count; i++) {
        double d = distance(t, &list->items[i]);
        if (d < best_distance) {
            best = i;
            best_distance = d;
        }
    }
    return best;
}

cv_status cmp_pair(cmp_pairing *out, const cmp_list *first, const cmp_list *second, cv_message *why)
{
    const cmp_list *lists[CMP_METHODS] = {first, second};
    for (int m = 0; m < CMP_METHODS; m++)
        out->partner[m] = malloc((lists[m]->count + 1) * sizeof *out->partner[m]);
    if (out->partner[0] == NULL || out->partner[1] == NULL) {
        cmp_pairing_clear(out);
        return cv_fail(why, CV_FAILED, "out of memory");
    }
    for (int m = 0; m < CMP_METHODS; m++)
        for (size_t i = 0; i < lists[m]->count; i++)
            out->partner[m][i] = SIZE_MAX;
    for (size_t i = 0; i < first->count; i++) {
        size_t j = nearest(&first->items[i], second);
        if (j != SIZE_MAX && nearest(&second->items[j], first) == i) {
            out->partner[0][i] = j;
            out->partner[1][j] = i;
        }
    }
    return CV_OK;
}

void cmp_pairing_clear(cmp_pairing *p)
{
    for (int m = 0; m < CMP_METHODS; m++) {
        free(p->partner[m]);
        p->partner[m] = NULL;
    }
}
