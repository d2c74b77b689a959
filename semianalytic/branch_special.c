/* Special velocities of the branch curves. On an arc the signed q = omega - direction |p| alpha has
 * dq/dalpha = -direction |p|, which makes the lists complete: q vanishes at most once on an arc, and the
 * difference D = q_a - sigma q_b of two arcs is monotone between the velocities at which their |p| are equal
 * (sigma * direction_a * direction_b = 1; otherwise everywhere). */
#include "semianalytic/branch_special.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

typedef struct {
    const sa_branch_curves *curves;
    size_t a, b;
    int sigma;
} arc_pair;

typedef struct {
    long double alpha, value, slope;
    sa_wave wave_a, wave_b;
    long double q;
} pair_point;

/* p at which omega_k' = sign * omega_l', for every k < l */
typedef struct {
    long double *p;
    size_t count;
} equal_speeds;

static cv_status push_special(sa_branch_curves *curves, sa_special special)
{
    if (!(special.alpha >= curves->alpha_min && special.alpha <= curves->alpha_max)) {
        return CV_OK;
    }
    sa_special *larger = realloc(curves->special, (curves->special_count + 1) * sizeof *larger);
    if (!larger) {
        return CV_FAILED;
    }
    curves->special = larger;
    larger[curves->special_count++] = special;
    return CV_OK;
}

static cv_status add_cusps(sa_branch_curves *curves, int k)
{
    sa_branch_function second = {.kind = 1, .k = k, .l = k, .sign = 1};
    long double *p;
    size_t count;
    cv_status status = sa_branch_grid_roots(&p, &count, &curves->grid, &second);

    for (size_t i = 0; i < count && status == CV_OK; i++) {
        sa_wave w;
        status = sa_dispersion_wave(&w, &curves->grid.track, k, p[i], 0);
        if (status == CV_OK) {
            status = push_special(curves, (sa_special){.kind = SA_SPECIAL_CUSP,
                                                       .alpha = (double)fabsl(w.d[1]),
                                                       .q = (double)fabsl(w.intercept),
                                                       .k = k,
                                                       .l = k,
                                                       .p = (double)w.p,
                                                       .p_l = (double)w.p});
        }
    }
    free(p);
    return status;
}

/* omega - p omega' is monotone in p on an arc: Newton with bisection. */
static cv_status add_resonance(sa_branch_curves *curves, const sa_branch_arc *arc)
{
    const sa_dispersion *track = &curves->grid.track;
    long double p[2] = {fminl(arc->p_low, arc->p_high), fmaxl(arc->p_low, arc->p_high)};
    sa_wave w, end;

    cv_status status = sa_dispersion_wave(&end, track, arc->k, p[0], 0);
    w = end;
    for (int i = 0; i < 60 && isinf(p[1]); i++) {
        /* towards the shear speed the intercept tends to 0 from above */
        long double next = ldexpl(p[0], i + 1);
        status = sa_dispersion_wave(&w, track, arc->k, next, 0);
        if (status != CV_OK || w.intercept > 0) {
            p[1] = next;
        }
    }
    if (status == CV_OK) {
        status = sa_dispersion_wave(&w, track, arc->k, p[1], 0);
    }
    if (status != CV_OK || arc->direction < 0 || (end.intercept < 0) == (w.intercept < 0)) {
        return status;
    }
    int rising = end.intercept < 0;
    for (int i = 0; i < 200 && p[1] - p[0] > 2 * LDBL_EPSILON * p[1]; i++) {
        p[(w.intercept < 0) != rising] = w.p;
        long double next = w.p + w.intercept / (w.p * w.d[2]);
        if (fabsl(next - w.p) <= 2 * LDBL_EPSILON * w.p) {
            break;
        }
        if (!(next > p[0] && next < p[1])) {
            next = p[0] + (p[1] - p[0]) / 2;
        }
        status = sa_dispersion_wave(&w, track, arc->k, next, 0);
        if (status != CV_OK) {
            return status;
        }
    }
    return push_special(curves, (sa_special){.kind = SA_SPECIAL_RESONANCE,
                                             .alpha = (double)(w.omega / w.p),
                                             .k = arc->k,
                                             .l = arc->k,
                                             .p = (double)w.p,
                                             .p_l = (double)w.p});
}

static cv_status pair_at(pair_point *out, const arc_pair *pair, long double alpha)
{
    const sa_branch_arc *arc = pair->curves->arc;
    long double qb;
    cv_status status = sa_branch_arc_at(&out->wave_a, &out->q, pair->curves, pair->a, alpha);

    if (status == CV_OK) {
        status = sa_branch_arc_at(&out->wave_b, &qb, pair->curves, pair->b, alpha);
    }
    if (status == CV_OK) {
        out->alpha = alpha;
        out->value = out->q - pair->sigma * qb;
        out->slope =
            -arc[pair->a].direction * out->wave_a.p + pair->sigma * arc[pair->b].direction * out->wave_b.p;
    }
    return status;
}

static cv_status add_crossing(sa_branch_curves *curves, const arc_pair *pair, pair_point low, pair_point high)
{
    int rising = low.value < 0;
    pair_point s = fabsl(low.value) < fabsl(high.value) ? low : high;

    for (int i = 0; i < 200 && high.alpha - low.alpha > 2 * LDBL_EPSILON * high.alpha; i++) {
        /* the slope is infinite at the shear speed */
        long double next = isfinite(s.slope) ? s.alpha - s.value / s.slope : low.alpha;
        if (isfinite(s.slope) && fabsl(next - s.alpha) <= 2 * LDBL_EPSILON * s.alpha) {
            break;
        }
        if (!(next > low.alpha && next < high.alpha)) {
            next = low.alpha + (high.alpha - low.alpha) / 2;
        }
        cv_status status = pair_at(&s, pair, next);
        if (status != CV_OK) {
            return status;
        }
        *((s.value < 0) == rising ? &low : &high) = s;
    }
    return push_special(curves,
                        (sa_special){.kind = pair->sigma > 0 ? SA_SPECIAL_CROSSING : SA_SPECIAL_REFLECTED,
                                     .alpha = (double)s.alpha,
                                     .q = (double)fabsl(s.q),
                                     .k = curves->arc[pair->a].k,
                                     .l = curves->arc[pair->b].k,
                                     .p = (double)s.wave_a.p,
                                     .p_l = (double)s.wave_b.p});
}

static int ascending(const void *left, const void *right)
{
    const long double *a = left, *b = right;

    return (*a > *b) - (*a < *b);
}

/* Ends of the velocity range that two arcs share, and the velocities in it where their |p| agree, ascending.
 */
static cv_status monotone_ranges(long double **out, size_t *count, const arc_pair *pair,
                                 const equal_speeds *equal)
{
    const sa_branch_curves *curves = pair->curves;
    const sa_branch_arc *a = &curves->arc[pair->a], *b = &curves->arc[pair->b];
    long double low = fmaxl(a->alpha_low, b->alpha_low), high = fminl(a->alpha_high, b->alpha_high);
    size_t n = 0;

    *count = 0;
    *out = NULL;
    if (!(low < high)) {
        return CV_OK;
    }
    long double *alpha = malloc((equal->count + 2) * sizeof *alpha);
    if (!alpha) {
        return CV_FAILED;
    }
    alpha[n++] = low;
    for (size_t i = 0; i < equal->count; i++) {
        sa_wave w;
        if (sa_dispersion_wave(&w, &curves->grid.track, a->k, equal->p[i], 0) != CV_OK) {
            free(alpha);
            return CV_FAILED;
        }
        long double at = a->direction * w.d[1];
        if (at > low && at < high) {
            alpha[n++] = at;
        }
    }
    alpha[n++] = high;
    qsort(alpha, n, sizeof *alpha, ascending);
    *out = alpha;
    *count = n;
    return CV_OK;
}

static cv_status add_crossings(sa_branch_curves *curves, const arc_pair *pair, const equal_speeds *equal)
{
    long double *alpha;
    size_t count;
    pair_point low, high;
    cv_status status = monotone_ranges(&alpha, &count, pair, equal);

    if (status == CV_OK && count > 0) {
        status = pair_at(&low, pair, alpha[0]);
    }
    for (size_t i = 1; i < count && status == CV_OK; i++) {
        status = pair_at(&high, pair, alpha[i]);
        if (status == CV_OK && (low.value < 0) != (high.value < 0)) {
            status = add_crossing(curves, pair, low, high);
        }
        low = high;
    }
    free(alpha);
    return status;
}

/* Two arcs that end in the same cusp touch there and nowhere else. */
static int share_cusp(const sa_branch_arc *a, const sa_branch_arc *b)
{
    return a->k == b->k && a->direction == b->direction && (a->p_low == b->p_low || a->p_high == b->p_high);
}

static cv_status add_pairs(sa_branch_curves *curves, int k, int l, int sign)
{
    sa_branch_function difference = {.kind = 2, .k = k, .l = l, .sign = sign};
    equal_speeds equal = {0};
    cv_status status = CV_OK;

    if (k != l) {
        status = sa_branch_grid_roots(&equal.p, &equal.count, &curves->grid, &difference);
    }
    for (size_t a = 0; a < curves->arc_count && status == CV_OK; a++) {
        for (size_t b = 0; b < curves->arc_count && status == CV_OK; b++) {
            const sa_branch_arc *first = &curves->arc[a], *second = &curves->arc[b];
            int relevant = first->k == k && second->k == l && (k != l || a < b);
            for (int sigma = -1; relevant && sigma <= 1 && status == CV_OK; sigma += 2) {
                arc_pair pair = {.curves = curves, .a = a, .b = b, .sigma = sigma};
                if (first->direction * second->direction == sign &&
                    !(sigma > 0 && share_cusp(first, second))) {
                    const equal_speeds none = {0};
                    status = add_crossings(curves, &pair, sigma == sign ? &equal : &none);
                }
            }
        }
    }
    free(equal.p);
    return status;
}

static int by_alpha(const void *left, const void *right)
{
    const sa_special *a = left, *b = right;

    return (a->alpha > b->alpha) - (a->alpha < b->alpha);
}

cv_status sa_branch_special_find(sa_branch_curves *curves)
{
    double shear = (double)sa_dispersion_shear_speed(&curves->grid.track);
    cv_status status = push_special(
        curves,
        (sa_special){
            .kind = SA_SPECIAL_SHEAR, .alpha = shear, .k = -1, .l = -1, .p = INFINITY, .p_l = INFINITY});

    for (int k = 0; k < SA_BRANCHES && status == CV_OK; k++) {
        status = add_cusps(curves, k);
    }
    for (size_t i = 0; i < curves->arc_count && status == CV_OK; i++) {
        status = add_resonance(curves, &curves->arc[i]);
    }
    for (int k = 0; k < SA_BRANCHES && status == CV_OK; k++) {
        for (int l = k; l < SA_BRANCHES && status == CV_OK; l++) {
            status = add_pairs(curves, k, l, 1);
            if (status == CV_OK) {
                status = add_pairs(curves, k, l, -1);
            }
        }
    }
    if (curves->special_count > 1) {
        qsort(curves->special, curves->special_count, sizeof *curves->special, by_alpha);
    }
    return status;
}
