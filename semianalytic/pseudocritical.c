#include "semianalytic/pseudocritical.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "semianalytic/resonances.h"

/* Fraction of the reach, and of alpha, that one step over the velocities takes; relative distance kept from
 * resonances; steps in which a summit is followed from one velocity to the next; how often an interval is
 * halved. */
static const long double STEP = 0.1L, MARGIN = 1e-6L;
enum { FOLLOW_STEPS = 4, FEW_HALVINGS = 2, MOST_HALVINGS = 30 };

typedef struct {
    sa_dispersion track;
    sa_pseudocritical_list *list;
} search;

/* The three curves at one velocity. */
typedef struct {
    long double alpha, reach;
    sa_summit summit[SA_CURVES];
} sample;

void sa_curve_at(sa_summit *out, const sa_undamped *s, sa_curve of)
{
    if (of == SA_CURVE_ACTIVE_POINT) {
        long double v[4];
        sa_undamped_at(v, s, 0, 1, 0);
        int sign = v[0] < 0 ? -1 : 1;
        *out = (sa_summit){sign * v[0], sign * v[3], 1, 0};
    } else {
        sa_summit_find(out, s, of == SA_CURVE_MAX ? 1 : -1);
    }
}

static cv_status sample_at(sample *out, const search *t, long double alpha)
{
    sa_undamped s;
    cv_status status = sa_undamped_solve(&s, &t->track, alpha, NULL);

    out->alpha = alpha;
    out->reach = s.reach;
    for (int of = 0; of < SA_CURVES && status == CV_OK; of++) {
        sa_curve_at(&out->summit[of], &s, (sa_curve)of);
    }
    return status;
}

/* The next velocity that can be computed, at or a little beyond alpha: two roots in the complex plane may
 * meet right there. */
static cv_status sample_near(sample *out, const search *t, long double alpha)
{
    cv_status status = CV_UNDECIDED;

    for (long double skip = 0; status == CV_UNDECIDED && skip<1e-4L; skip = skip> 0 ? 4 * skip : 1e-9L) {
        status = sample_at(out, t, alpha * (1 + skip));
    }
    return status;
}

/* The same local maximum along the rail at another velocity. */
static cv_status follow(sa_summit *out, const search *t, sa_curve of, const sa_summit *from,
                        long double alpha)
{
    sa_undamped s;
    cv_status status = sa_undamped_solve(&s, &t->track, alpha, NULL);

    if (status == CV_OK && of == SA_CURVE_ACTIVE_POINT) {
        sa_curve_at(out, &s, of);
    } else if (status == CV_OK && !sa_summit_follow(out, from, &s, of == SA_CURVE_MAX ? 1 : -1)) {
        status = CV_UNDECIDED;
    }
    return status;
}

static cv_status keep(const search *t, sa_curve of, const sa_summit *at, long double alpha, long double error)
{
    sa_pseudocritical_list *list = t->list;
    sa_pseudocritical *larger = realloc(list->item, (list->count + 1) * sizeof *larger);
    sa_undamped s;
    long double v[4] = {0};

    if (!larger) {
        return CV_FAILED;
    }
    list->item = larger;
    double deflection = (double)(of == SA_CURVE_MIN ? -at->value : at->value);
    if (of == SA_CURVE_ACTIVE_POINT && sa_undamped_solve(&s, &t->track, alpha, NULL) == CV_OK) {
        sa_undamped_at(v, &s, 0, 1, 0);
        deflection = (double)v[0];
    }
    larger[list->count++] =
        (sa_pseudocritical){of, alpha, (double)error, deflection, at->ahead, (double)at->distance};
    return CV_OK;
}

/* The slope changes from + to - at alpha: the smallest distance, from a rounding error of alpha up, at which
 * both sides show it by more than the difference that doubling the distance halves. */
static long double verified_error(const search *t, sa_curve of, const sa_summit *at, long double alpha)
{
    for (long double error = 64 * LDBL_EPSILON * alpha; error < 1e-6L * alpha; error *= 2) {
        sa_summit below[2], above[2];
        int done = 1;
        for (int i = 0; i < 2 && done; i++) {
            done = follow(&below[i], t, of, at, alpha - (i + 1) * error) == CV_OK &&
                   follow(&above[i], t, of, at, alpha + (i + 1) * error) == CV_OK;
        }
        /* linear on both sides: rounding errors are small against the slopes */
        if (done && below[0].slope > 0 && above[0].slope < 0 &&
            fabsl(below[1].slope / below[0].slope - 2) < 0.5L &&
            fabsl(above[1].slope / above[0].slope - 2) < 0.5L) {
            return error;
        }
    }
    return INFINITY;
}

/* One that is below the supremum is no extremum of the curve; one that is listed already was reached from the
 * other side. */
static int is_new(const search *t, sa_curve of, const sa_summit *at, long double alpha)
{
    sa_undamped s;
    sa_summit highest;

    for (size_t i = 0; i < t->list->count; i++) {
        const sa_pseudocritical *known = &t->list->item[i];
        if (known->of == of && fabsl(known->alpha - alpha) <= 1e-9L * alpha) {
            return 0;
        }
    }
    if (sa_undamped_solve(&s, &t->track, alpha, NULL) != CV_OK) {
        return 0;
    }
    sa_curve_at(&highest, &s, of);
    return at->value >= highest.value * (1 - 1e-10L);
}

/* A summit whose slope is > 0 at low and < 0 at high: secant steps and bisection. */
static cv_status refine(const search *t, sa_curve of, sa_summit a, long double low, sa_summit b,
                        long double high)
{
    sa_summit mid = a;
    long double at = low;

    for (int i = 0; i < 200 && high - low > 2 * LDBL_EPSILON * high; i++) {
        long double secant = low + (high - low) * a.slope / (a.slope - b.slope);
        long double next = i % 3 == 2 ? low + (high - low) / 2 : secant;
        if (!(next > low && next < high)) {
            break;
        }
        cv_status status = follow(&mid, t, of, high - next < next - low ? &b : &a, next);
        if (status != CV_OK) {
            return status == CV_UNDECIDED ? CV_OK : status;
        }
        at = next;
        if (mid.slope > 0) {
            a = mid;
            low = at;
        } else {
            b = mid;
            high = at;
        }
    }
    if (fabsl(a.slope) < fabsl(mid.slope) || fabsl(b.slope) < fabsl(mid.slope)) {
        int low_is_nearer = fabsl(a.slope) < fabsl(b.slope);
        mid = low_is_nearer ? a : b;
        at = low_is_nearer ? low : high;
    }
    if (!is_new(t, of, &mid, at)) {
        return CV_OK;
    }
    long double error = verified_error(t, of, &mid, at);
    return isinf(error) ? CV_OK : keep(t, of, &mid, at, error);
}

/* Follows the summit at a to the velocity of b and looks at the maximum it may pass on the way. *same: it
 * arrives at the summit at b. */
static cv_status along(const search *t, sa_curve of, const sample *a, const sample *b, int *same)
{
    sa_summit here = a->summit[of], next;
    long double alpha = a->alpha;

    *same = 0;
    for (int i = 1; i <= FOLLOW_STEPS; i++) {
        long double to = a->alpha + (b->alpha - a->alpha) * i / FOLLOW_STEPS;
        cv_status status = follow(&next, t, of, &here, to);
        if (status != CV_OK) {
            return status == CV_UNDECIDED ? CV_OK : status;
        }
        if (to > alpha && here.slope > 0 && next.slope < 0) {
            status = refine(t, of, here, alpha, next, to);
        } else if (to < alpha && here.slope < 0 && next.slope > 0) {
            status = refine(t, of, next, to, here, alpha);
        }
        if (status != CV_OK) {
            return status;
        }
        here = next;
        alpha = to;
    }
    *same = fabsl(here.value - b->summit[of].value) <= 1e-10L * here.value;
    return CV_OK;
}

/* Local maxima between two neighbouring samples. Where the summit jumps from one place of the rail to another
 * the curve has a kink upwards, which is no maximum, but the summits on both sides of the jump may have had
 * theirs, and so may others between them: such an interval is halved a few times, and for as long as the
 * slopes promise a maximum that is not found. */
static cv_status between(const search *t, sa_curve of, const sample *a, const sample *b, int halvings)
{
    size_t before = t->list->count;
    int same;
    cv_status status = along(t, of, a, b, &same);

    if (status == CV_OK && !same) {
        status = along(t, of, b, a, &same);
    }
    int promised = a->summit[of].slope > 0 && b->summit[of].slope < 0 && t->list->count == before;
    if (status != CV_OK || (same && !promised) || halvings >= (promised ? MOST_HALVINGS : FEW_HALVINGS)) {
        return status;
    }
    sample mid;
    status = sample_near(&mid, t, a->alpha + (b->alpha - a->alpha) / 2);
    if (status == CV_OK) {
        status = between(t, of, a, &mid, halvings + 1);
    }
    return status == CV_OK ? between(t, of, &mid, b, halvings + 1) : status;
}

/* A range whose ends keep their distance from resonance velocities. */
static cv_status scan(const search *t, long double low, long double high)
{
    sample here, next;
    cv_status status = sample_near(&here, t, low);

    while (status == CV_OK && here.alpha < high) {
        long double step = STEP * fminl(here.reach, here.alpha);
        long double alpha = here.alpha + fmaxl(step, MARGIN * here.alpha);
        status = sample_near(&next, t, alpha < high ? alpha : high);
        /* approaching a resonance the reach shrinks faster than this step knows */
        if (status == CV_OK && next.reach < here.reach / 2 && step > MARGIN * here.alpha) {
            status = sample_near(&next, t, here.alpha + (next.alpha - here.alpha) / 4);
        }
        for (int of = 0; of < SA_CURVES && status == CV_OK; of++) {
            status = between(t, (sa_curve)of, &here, &next, 0);
        }
        here = next;
    }
    return status;
}

static int ascending(const void *left, const void *right)
{
    const long double *a = left, *b = right;

    return (*a > *b) - (*a < *b);
}

/* Velocities that divide the range: resonances, and the shear speed, at which a root p goes through infinity.
 * Returns how many; at most count + 1. */
static size_t dividing(long double *out, const sa_resonance_list *resonances, const sa_dispersion *track)
{
    size_t count = 0;

    for (size_t i = 0; i < resonances->count; i++) {
        out[count++] = mpfr_get_ld(resonances->item[i].alpha, MPFR_RNDN);
    }
    out[count++] = sa_dispersion_shear_speed(track);
    qsort(out, count, sizeof *out, ascending);
    return count;
}

static cv_status scan_all(const search *t, const sa_resonance_list *resonances, double alpha_min,
                          double alpha_max)
{
    long double *divide = malloc((resonances->count + 1) * sizeof *divide), low = alpha_min;
    cv_status status = divide ? CV_OK : CV_FAILED;
    size_t count = divide ? dividing(divide, resonances, &t->track) : 0;

    for (size_t i = 0; i <= count && status == CV_OK && low < alpha_max; i++) {
        long double at = i < count ? divide[i] : INFINITY;
        long double high = at <= alpha_max ? at * (1 - MARGIN) : alpha_max;
        if (high > low) {
            status = scan(t, low, high);
        }
        low = fmaxl(low, at * (1 + MARGIN));
    }
    free(divide);
    return status;
}

static int by_curve_and_alpha(const void *left, const void *right)
{
    const sa_pseudocritical *a = left, *b = right;

    return a->of != b->of ? (a->of > b->of) - (a->of < b->of) : (a->alpha > b->alpha) - (a->alpha < b->alpha);
}

cv_status sa_pseudocritical_find(sa_pseudocritical_list *out, const cv_params *params, double alpha_min,
                                 double alpha_max, cv_message *why)
{
    search t = {.list = out};
    sa_resonance_list resonances;

    *out = (sa_pseudocritical_list){.count = 0};
    sa_dispersion_set(&t.track, params);
    cv_status status = sa_resonances(&resonances, params, 18, why);
    if (status != CV_OK) {
        return status;
    }
    status = scan_all(&t, &resonances, alpha_min, alpha_max);
    sa_resonances_clear(&resonances);
    if (status != CV_OK) {
        sa_pseudocritical_clear(out);
        return cv_fail(why, status, "the steady deflection cannot be computed");
    }
    if (out->count > 1) {
        qsort(out->item, out->count, sizeof *out->item, by_curve_and_alpha);
    }
    return CV_OK;
}

void sa_pseudocritical_clear(sa_pseudocritical_list *list)
{
    free(list->item);
    *list = (sa_pseudocritical_list){.count = 0};
}

const char *sa_curve_text(sa_curve of)
{
    static const char *const text[] = {"max", "min", "active point"};

    return text[of];
}
