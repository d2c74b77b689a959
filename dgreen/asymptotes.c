#include "dgreen/asymptotes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/curve_station.h"
#include "dgreen/transitions_bracket.h"
#include "dgreen/velocities.h"
#include "dgreen/z.h"

#define RND MPFR_RNDN

enum { MORE_BITS = 64, MAX_EXTRA_BITS = 2048, GUARD_DIGITS = 8, MIN_STEPS = 60 };
/* A minimum of |S1| is looked at when the parabola through three values goes below this part of the middle
 * one, or when that falls short of the power law through its neighbours by this factor. */
static const double CLEARANCE = 0.85, KINK = 3;
/* The first look takes S1 from Im zeta = -4 q^3 (S1 + O(q^2)) at this part of the distance over which zeta
 * changes, to this accuracy. */
static const double LOW = 1e-5, LOOK_TOLERANCE = 1e-3;

void dg_asymptote_list_clear(dg_asymptote_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        mpfr_clear(list->items[i].alpha);
    free(list->items);
    memset(list, 0, sizeof *list);
}

typedef struct {
    const dg_track *track;
    const dg_branch_curves *branches; /* of the first look, and what follows */
    dg_follow *follow;
    dg_station station;
    dg_asymptote_list *list;
    int digits;
    mpfr_prec_t bits, limit; /* of the refinement */
    mpfr_t s0, s1, more;     /* scratch */
    cv_message *why;
} finder;

typedef struct {
    double alpha, value; /* S1 */
} sample;

static void doubt(finder *f, double alpha)
{
    if (f->list->status == CV_OK)
        f->list->status =
            cv_fail(&f->list->why, CV_UNDECIDED, "low-frequency limit not decided near alpha = %.17g", alpha);
}

/* Im zeta at a frequency far below the lowest branch point, with a certain sign */
static cv_status look(sample *s, finder *f)
{
    cv_status status = dg_station_set(&f->station, f->branches, s->alpha, f->why);
    if (status != CV_OK)
        return status;
    double scale = 1;
    for (size_t i = 0; i < f->station.count; i++)
        scale = fmin(scale, hypot(f->station.points[i].q, f->station.points[i].width));
    const double q = LOW * scale;
    dg_value zeta;
    status = dg_zeta_adaptive(&zeta, f->follow, f->track, s->alpha, CMPLX(0, q), HUGE_VAL, LOOK_TOLERANCE);
    s->value = -zeta.im / (4 * q * q * q);
    if (status == CV_UNDECIDED) {
        doubt(f, s->alpha);
        s->value = NAN;
    }
    return status == CV_UNDECIDED ? CV_OK : status;
}

/* For the bracket: S1 at e->at with a sign that 64 bits more confirm. */
static cv_status certain(dg_end *e, void *context)
{
    finder *f = context;
    for (; f->bits <= f->limit; f->bits += MORE_BITS) {
        cv_status status = dg_low_frequency(f->s0, f->s1, f->track, e->at, f->bits);
        if (status == CV_OK)
            status = dg_low_frequency(f->s0, f->more, f->track, e->at, f->bits + MORE_BITS);
        if (status == CV_FAILED)
            return status;
        mpfr_sub(f->s1, f->s1, f->more, RND);
        mpfr_mul_2ui(f->s1, f->s1, 2, RND);
        if (status == CV_OK && mpfr_cmpabs(f->s1, f->more) < 0) {
            mpfr_set(e->value, f->more, RND);
            e->sign = mpfr_sgn(e->value) > 0 ? 1 : -1;
            return CV_OK;
        }
    }
    return CV_UNDECIDED;
}

/* Room for one more, which is not yet counted; NULL: out of memory */
static dg_asymptote *next_item(finder *f)
{
    dg_asymptote_list *list = f->list;
    dg_asymptote *grown = realloc(list->items, (list->count + 1) * sizeof *grown);
    if (grown == NULL)
        return NULL;
    list->items = grown;
    return &grown[list->count];
}

/* The middle of the bracket, however narrow it became, and whether a line runs there */
static cv_status report(finder *f, dg_bracket *b)
{
    dg_asymptote *item = next_item(f);
    if (item == NULL)
        return cv_fail(f->why, CV_FAILED, "out of memory");
    f->list->count++;
    mpfr_init2(item->alpha, mpfr_get_prec(b->low.at));
    mpfr_add(item->alpha, b->low.at, b->high.at, RND);
    mpfr_div_2ui(item->alpha, item->alpha, 1, RND);
    mpfr_sub(b->width, b->high.at, b->low.at, MPFR_RNDU);
    item->error = 0.51 * mpfr_get_d(b->width, MPFR_RNDU);
    const cv_status status = dg_low_frequency(f->s0, f->s1, f->track, item->alpha, f->bits);
    item->positive = status == CV_OK && mpfr_sgn(f->s0) < 0;
    if (status == CV_UNDECIDED)
        doubt(f, mpfr_get_d(item->alpha, RND));
    return status == CV_FAILED ? status : CV_OK;
}

/* The zero between two velocities to f->digits, scale the distance over which S1 changes */
static cv_status refine_between(finder *f, mpfr_srcptr low, mpfr_srcptr high, double scale)
{
    dg_bracket b;
    f->bits = 64 * ((mpfr_prec_t)((f->digits + 2 * GUARD_DIGITS) * 3.33) / 64 + 1) - 1;
    f->limit = f->bits + MAX_EXTRA_BITS;
    dg_bracket_init(&b, f->bits, certain, f);
    b.scale = scale;
    mpfr_set_si(b.tolerance, 10, RND);
    mpfr_pow_si(b.tolerance, b.tolerance, -f->digits, MPFR_RNDD);
    mpfr_mul(b.tolerance, b.tolerance, low, MPFR_RNDD);
    mpfr_set(b.low.at, low, RND);
    mpfr_set(b.high.at, high, RND);
    cv_status status = certain(&b.low, f);
    if (status == CV_OK)
        status = certain(&b.high, f);
    if (status == CV_OK)
        status = b.low.sign != b.high.sign ? dg_bracket_close(&b) : CV_UNDECIDED;
    if (status == CV_UNDECIDED)
        doubt(f, mpfr_get_d(low, RND));
    if (status != CV_FAILED)
        status = report(f, &b);
    dg_bracket_clear(&b);
    return status;
}

static cv_status refine(finder *f, const sample *low, const sample *high)
{
    mpfr_t ends[2];
    mpfr_inits2(53, ends[0], ends[1], (mpfr_ptr)NULL);
    mpfr_set_d(ends[0], low->alpha, RND);
    mpfr_set_d(ends[1], high->alpha, RND);
    const cv_status status = refine_between(f, ends[0], ends[1], high->alpha - low->alpha);
    mpfr_clears(ends[0], ends[1], (mpfr_ptr)NULL);
    return status;
}

static int opposite(const sample *a, const sample *b)
{
    return a->value * b->value < 0;
}

/* As for the minima of |Im zeta| along a curve: they may hide two zeros. */
static int may_hide(const sample *a, const sample *b, const sample *c)
{
    const double fa = fabs(a->value), fb = fabs(b->value), fc = fabs(c->value);
    if (opposite(a, b) || opposite(b, c))
        return 0;
    if (!(fb <= fa && fb <= fc))
        return fa * fc > KINK * fb * fb;
    const double h = b->alpha - a->alpha, k = c->alpha - b->alpha, left = (fb - fa) / h,
                 right = (fc - fb) / k;
    const double slope = (left * k + right * h) / (h + k), curvature = (right - left) / (h + k);
    const double least = curvature > 0 ? fb - slope * slope / (4 * curvature) : fb;
    return least < CLEARANCE * fb || fa * fc > KINK * fb * fb;
}

/* The minimum of |S1| between low and high, golden section; ends at a change of sign. */
static cv_status search_minimum(sample *found, finder *f, sample low, sample high)
{
    static const double GOLDEN = 0.381966011250105;
    sample at[2] = {{low.alpha + GOLDEN * (high.alpha - low.alpha), 0},
                    {high.alpha - GOLDEN * (high.alpha - low.alpha), 0}};
    cv_status status = look(&at[0], f);
    if (status == CV_OK)
        status = look(&at[1], f);
    for (int i = 0; i < MIN_STEPS && status == CV_OK; i++) {
        const int k = fabs(at[0].value) < fabs(at[1].value) ? 0 : 1;
        *found = at[k];
        if (opposite(&low, found) || !(high.alpha - low.alpha > 1e-8 * (found->alpha)))
            return CV_OK;
        if (k == 0) {
            high = at[1];
            at[1] = at[0];
            at[0].alpha = low.alpha + GOLDEN * (high.alpha - low.alpha);
            status = look(&at[0], f);
        } else {
            low = at[0];
            at[0] = at[1];
            at[1].alpha = high.alpha - GOLDEN * (high.alpha - low.alpha);
            status = look(&at[1], f);
        }
    }
    return status;
}

/* The zeros between sample b and the one before; the minimum at b when there is one */
static cv_status search(finder *f, const sample *samples, size_t count)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i + 1 < count && status == CV_OK; i++) {
        const sample *b = &samples[i];
        if (opposite(b, b + 1))
            status = refine(f, b, b + 1);
        else if (i > 0 && may_hide(b - 1, b, b + 1)) {
            sample least = *b;
            status = search_minimum(&least, f, b[-1], b[1]);
            if (status == CV_OK && opposite(&least, b)) {
                const sample *low = least.alpha > b->alpha ? b : b - 1, *high = low + 1;
                status = refine(f, low, &least);
                if (status == CV_OK)
                    status = refine(f, &least, high);
            }
        }
    }
    return status;
}

static cv_status scan(finder *f, const dg_velocities *v)
{
    sample *samples = malloc(v->count * sizeof *samples);
    size_t count = 0;
    cv_status status = samples ? CV_OK : cv_fail(f->why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < v->count && status == CV_OK; i++) {
        samples[count].alpha = v->at[i];
        status = look(&samples[count], f);
        count += isnan(samples[count].value) ? 0 : 1;
    }
    if (status == CV_OK)
        status = search(f, samples, count);
    free(samples);
    return status;
}

static int ascending(const void *a, const void *b)
{
    return mpfr_cmp(((const dg_asymptote *)a)->alpha, ((const dg_asymptote *)b)->alpha);
}

static void finder_init(finder *f)
{
    mpfr_inits2(53, f->s0, f->s1, f->more, (mpfr_ptr)NULL);
    memset(f->list, 0, sizeof *f->list);
}

static void finder_clear(finder *f)
{
    dg_station_clear(&f->station);
    mpfr_clears(f->s0, f->s1, f->more, (mpfr_ptr)NULL);
}

cv_status dg_asymptotes_find(dg_asymptote_list *list, const dg_track *track, const dg_branch_curves *branches,
                             double alpha_min, double alpha_max, int digits, cv_message *why)
{
    finder f = {.track = track, .branches = branches, .list = list, .digits = digits, .why = why};
    dg_velocities v = {0};
    finder_init(&f);
    cv_status status = dg_follow_new(&f.follow, why);
    if (status == CV_OK)
        status = dg_velocities_choose(&v, branches, alpha_min, alpha_max, 0, why);
    if (status == CV_OK)
        status = scan(&f, &v);
    if (list->count > 0)
        qsort(list->items, list->count, sizeof *list->items, ascending);
    if (status != CV_OK)
        dg_asymptote_list_clear(list);
    finder_clear(&f);
    dg_follow_free(f.follow);
    free(v.at);
    return status;
}

/* Copies a velocity that is good enough already. 0: it is not; -1: out of memory */
static int keep(finder *f, const dg_asymptote *rough)
{
    if (!(rough->error <= pow(10, -f->digits) * mpfr_get_d(rough->alpha, MPFR_RNDD)))
        return 0;
    dg_asymptote *item = next_item(f);
    if (item == NULL)
        return -1;
    *item = *rough;
    mpfr_init2(item->alpha, mpfr_get_prec(rough->alpha));
    mpfr_set(item->alpha, rough->alpha, RND);
    f->list->count++;
    return 1;
}

static cv_status sharpen(finder *f, const dg_asymptote *rough)
{
    const int kept = keep(f, rough);
    if (kept != 0)
        return kept > 0 ? CV_OK : cv_fail(f->why, CV_FAILED, "out of memory");
    mpfr_t ends[2];
    mpfr_inits2(mpfr_get_prec(rough->alpha), ends[0], ends[1], (mpfr_ptr)NULL);
    mpfr_sub_d(ends[0], rough->alpha, 2 * rough->error, MPFR_RNDD);
    mpfr_add_d(ends[1], rough->alpha, 2 * rough->error, MPFR_RNDU);
    const cv_status status = refine_between(f, ends[0], ends[1], rough->error);
    mpfr_clears(ends[0], ends[1], (mpfr_ptr)NULL);
    return status;
}

cv_status dg_asymptotes_sharpen(dg_asymptote_list *list, const dg_asymptote_list *from, const dg_track *track,
                                int digits, cv_message *why)
{
    finder f = {.track = track, .list = list, .digits = digits, .why = why};
    cv_status status = CV_OK;
    finder_init(&f);
    for (size_t i = 0; i < from->count && status == CV_OK; i++)
        status = sharpen(&f, &from->items[i]);
    if (from->status != CV_OK) {
        list->status = from->status;
        list->why = from->why;
    }
    if (status != CV_OK)
        dg_asymptote_list_clear(list);
    finder_clear(&f);
    return status;
}
