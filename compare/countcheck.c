#include "compare/countcheck.h"

#include <stdint.h>
#include <stdlib.h>

/* Positions inside an interval, tried in this order. */
static const double PLACES[] = {0.5, 0.3, 0.75, 0.1};

typedef struct {
    cmp_verdict *verdict;
    cmp_counts *out;
    const cmp_list *const *lists;
    const cmp_method *const *methods;
    void *const *handles;
    const cv_number *mass_ratio;
    cv_message *why;
} check;

/* Unstable roots at alpha as a list has them; -1 for an empty list, which says nothing about the number. */
static int running(const cmp_list *list, double alpha)
{
    if (list->count == 0)
        return -1;
    size_t i = 0;
    while (i < list->count && mpfr_cmp_d(list->items[i].alpha, alpha) < 0)
        i++;
    return i == 0 ? list->items[0].below : list->items[i - 1].above;
}

void cmp_judge_counts(cmp_verdict *v, cmp_counts *out, const cmp_list *const lists[CMP_METHODS],
                      const char *const names[CMP_METHODS], double alpha, const int counted[CMP_METHODS])
{
    if (counted[0] != counted[1])
        cmp_verdict_incomplete(v, CMP_DISAGREE, "at alpha = %.15g %s counts %d unstable roots, %s %d", alpha,
                               names[0], counted[0], names[1], counted[1]);
    for (int m = 0; m < CMP_METHODS; m++) {
        const int listed = running(lists[m], alpha);
        if (lists[m]->status == CV_OK && listed >= 0 && listed != counted[m])
            cmp_verdict_incomplete(
                v, CMP_DISAGREE,
                "at alpha = %.15g the transitions of %s leave %d unstable roots, its count is %d", alpha,
                names[m], listed, counted[m]);
    }
    if (out->start < 0)
        out->start = counted[0];
    for (int m = 0; m < CMP_METHODS; m++)
        if (lists[m]->status == CV_OK && lists[m]->count == 0 && counted[m] != out->start)
            cmp_verdict_incomplete(
                v, CMP_DISAGREE,
                "%s has no transition, but %d unstable roots at the lowest velocity and %d at %.15g",
                names[m], out->start, counted[m], alpha);
    out->samples++;
}

/* Counts at alpha by both; CV_UNDECIDED with nothing judged when one of them cannot. */
static cv_status sample(const check *c, double alpha)
{
    int counted[CMP_METHODS];
    for (int m = 0; m < CMP_METHODS; m++) {
        cv_status status = c->methods[m]->count(c->handles[m], &counted[m], alpha, 1, c->mass_ratio, c->why);
        if (status != CV_OK)
            return status;
    }
    cmp_judge_counts(c->verdict, c->out, c->lists,
                     (const char *const[]){c->methods[0]->name, c->methods[1]->name}, alpha, counted);
    return CV_OK;
}

/* Strictly between low and high; a double, so that both methods count at the same velocity. */
static cv_status sample_between(const check *c, mpfr_srcptr low, mpfr_srcptr high)
{
    const double width = mpfr_get_d(high, MPFR_RNDN) - mpfr_get_d(low, MPFR_RNDN);
    cv_status status = CV_UNDECIDED;
    (void)cv_fail(c->why, CV_UNDECIDED, "no double between two transitions");
    for (size_t i = 0; status == CV_UNDECIDED && i < sizeof PLACES / sizeof *PLACES; i++) {
        const double alpha = mpfr_get_d(low, MPFR_RNDN) + PLACES[i] * width;
        if (mpfr_cmp_d(low, alpha) < 0 && mpfr_cmp_d(high, alpha) > 0)
            status = sample(c, alpha);
    }
    if (status != CV_UNDECIDED)
        return status;
    cmp_verdict_worsen(c->verdict, CMP_UNDECIDED,
                       "the unstable roots near alpha = %.17g could not be counted: %.300s",
                       mpfr_get_d(low, MPFR_RNDN), c->why->text);
    c->why->text[0] = '\0';
    return CV_OK;
}

/* A transition at that end: the methods may differ about whether it is in the range. */
static int transition_at(const check *c, const cv_number *end)
{
    for (int m = 0; m < CMP_METHODS; m++)
        for (size_t i = 0; i < c->lists[m]->count; i++)
            if (cmp_transition_at(&c->lists[m]->items[i], end))
                return 1;
    return 0;
}

/* An end of the range, which cannot be moved. */
static cv_status sample_end(const check *c, const cv_number *end)
{
    const double alpha = cv_number_get_double(end);
    cv_status status =
        transition_at(c, end) ? cv_fail(c->why, CV_UNDECIDED, "a transition lies there") : sample(c, alpha);
    if (status != CV_UNDECIDED)
        return status;
    cmp_verdict_worsen(c->verdict, CMP_UNDECIDED,
                       "the unstable roots at alpha = %.15g could not be counted: %.300s", alpha,
                       c->why->text);
    c->why->text[0] = '\0';
    return CV_OK;
}

/* Velocities between which to count: both ends of the range and every finite transition, pairs once,
 * ascending. */
typedef struct {
    mpfr_t *at;
    size_t count;
} marks;

static int ascending(const void *a, const void *b)
{
    return mpfr_cmp(*(const mpfr_t *)a, *(const mpfr_t *)b);
}

static mpfr_prec_t widest(const cmp_list *const lists[CMP_METHODS])
{
    mpfr_prec_t bits = 64;
    for (int m = 0; m < CMP_METHODS; m++)
        for (size_t i = 0; i < lists[m]->count; i++)
            if (mpfr_get_prec(lists[m]->items[i].alpha) > bits)
                bits = mpfr_get_prec(lists[m]->items[i].alpha);
    return bits;
}

static cv_status marks_set(marks *out, const check *c, const cmp_pairing *pairing, const cv_number *alpha_min,
                           const cv_number *alpha_max)
{
    const cv_number *const ends[] = {alpha_min, alpha_max};
    const mpfr_prec_t bits = widest(c->lists);
    out->count = 0;
    out->at = malloc((c->lists[0]->count + c->lists[1]->count + 2) * sizeof *out->at);
    if (out->at == NULL)
        return cv_fail(c->why, CV_FAILED, "out of memory");
    for (int e = 0; e < 2; e++) {
        mpfr_init2(out->at[out->count], bits);
        cv_number_get_mpfr(out->at[out->count++], ends[e]);
    }
    for (int m = 0; m < CMP_METHODS; m++)
        for (size_t i = 0; i < c->lists[m]->count; i++) {
            if ((m > 0 && pairing->partner[m][i] != SIZE_MAX) || !mpfr_number_p(c->lists[m]->items[i].alpha))
                continue;
            mpfr_init2(out->at[out->count], bits);
            mpfr_set(out->at[out->count++], c->lists[m]->items[i].alpha, MPFR_RNDN);
        }
    qsort(out->at, out->count, sizeof *out->at, ascending);
    return CV_OK;
}

static void marks_clear(marks *m)
{
    for (size_t i = 0; i < m->count; i++)
        mpfr_clear(m->at[i]);
    free(m->at);
}

cv_status cmp_check_counts(cmp_verdict *v, cmp_counts *out, const cmp_list *const lists[CMP_METHODS],
                           const cmp_pairing *pairing, const cmp_method *const methods[CMP_METHODS],
                           void *const handles[CMP_METHODS], const cv_number *alpha_min,
                           const cv_number *alpha_max, const cv_number *mass_ratio, cv_message *why)
{
    const check c = {v, out, lists, methods, handles, mass_ratio, why};
    marks m;
    out->start = -1;
    out->samples = 0;
    cv_status status = marks_set(&m, &c, pairing, alpha_min, alpha_max);
    if (status != CV_OK)
        return status;
    status = sample_end(&c, alpha_min);
    for (size_t i = 1; status == CV_OK && i < m.count; i++)
        if (mpfr_less_p(m.at[i - 1], m.at[i]))
            status = sample_between(&c, m.at[i - 1], m.at[i]);
    if (status == CV_OK)
        status = sample_end(&c, alpha_max);
    marks_clear(&m);
    return status;
}
