#include "semianalytic/asymptotes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "semianalytic/lines.h"
#include "semianalytic/map.h"
#include "semianalytic/poles.h"

/* c at one velocity of a side of a column, in the coordinate u of map.h. */
typedef struct {
    double u, alpha, c;
} probe;

typedef struct {
    sa_track *track;
    sa_map map;
    sa_sweep *sweep;
    double shortest; /* length over which c changes anywhere, by the damping */
    size_t column;
    int side, digits;
    sa_asymptote_list *out;
} search;

/* Upper poles at q = 0, polished; 0 when they are not as many as there must be. */
static int upper_poles(sa_point at[SA_UPPER_MAX], const sa_track *track, double alpha)
{
    double complex all[SA_POLES_MAX];
    int count, n = sa_matrix_upper_count_double(track, alpha), found = 0;
    if (sa_poles_cold(all, &count, track, alpha, 0) != CV_OK)
        return 0;
    for (int i = 0; i < count; ++i) {
        sa_point m;
        if (!(cimag(all[i]) > -1e-8 * cabs(all[i])) || !sa_poles_newton(&all[i], &m, track, alpha, 0) ||
            !(cimag(all[i]) > 0))
            continue;
        if (found == n)
            return 0;
        at[found++] = m;
    }
    return found == n ? n : 0;
}

/* What a pole adds to c in the limit of no damping: real ones half of their residue's slope, with the sign of
 * their half-plane (zeta_limit.c), the others nothing. */
static double limit_share(const sa_point *m, const sa_slopes *slopes)
{
    if (cimag(m->p) != 0)
        return 0;
    int upper = (cimag(m->s) > 0) != (creal(slopes->residue) > 0);
    return (upper ? 0.5 : -0.5) * creal(slopes->residue_q);
}

/* All poles at q = 0 of an undamped track, those next to the real axis on it; 0 when they are not eight. */
static int limit_poles(sa_point at[SA_POLES_MAX], const sa_track *track, double alpha)
{
    const double noise = 0x1p-26;
    double complex all[SA_POLES_MAX];
    int count;
    if (sa_poles_cold(all, &count, track, alpha, 0) != CV_OK || count != SA_POLES_MAX)
        return 0;
    for (int i = 0; i < count; ++i) {
        if (fabs(cimag(all[i])) <= noise * cabs(all[i]))
            all[i] = creal(all[i]);
        if (!sa_poles_newton(&all[i], &at[i], track, alpha, 0))
            return 0;
    }
    return count;
}

cv_status sa_asymptote_function(double *k, double *c, double *c_error, const sa_track *track, double alpha)
{
    sa_point at[SA_POLES_MAX];
    int n = track->undamped ? limit_poles(at, track, alpha) : upper_poles(at, track, alpha);
    double size = 0, closest = 1;
    *k = *c = 0;
    for (int i = 0; i < n; ++i) {
        sa_slopes slopes;
        sa_matrix_slopes(&slopes, &at[i], track, alpha);
        if (cimag(at[i].p) > 0)
            *k -= cimag(slopes.residue);
        *c += track->undamped ? limit_share(&at[i], &slopes) : creal(slopes.residue_q);
        size += cabs(slopes.residue_q);
        for (int j = 0; j < i; ++j)
            closest = fmin(closest, cabs(at[i].p - at[j].p) / cabs(at[i].p));
    }
    *c_error = 256 * DBL_EPSILON * size / closest;
    return n > 0 && isfinite(*c) && isfinite(*c_error) ? CV_OK : CV_UNDECIDED;
}

/* Where double does not know its sign: from Im zeta at a tiny q. At the shear speed a pole is at infinity:
 * beside it. */
static cv_status evaluate(double *c, const search *s, double alpha)
{
    const double nudge = 1e-13;
    double k, c_error, q = 1e-3 * s->shortest;
    cv_status status = sa_asymptote_function(&k, c, &c_error, s->track, alpha);
    if (status == CV_OK && fabs(*c) > 4 * c_error)
        return CV_OK;
    sa_value v;
    status = sa_zeta_adaptive(&v, s->sweep, s->track, alpha, q, 0.05);
    if (status == CV_UNDECIDED)
        status = sa_zeta_adaptive(&v, s->sweep, s->track, alpha * (1 + nudge), q, 0.05);
    if (status == CV_OK)
        *c = v.im / q / q / q;
    return status;
}

static cv_status set_probe(probe *p, const search *s, double u)
{
    const sa_column *column = &s->map.column[s->column];
    double length = s->side ? column->length_high : column->length_low;
    double half = (column->alpha_high - column->alpha_low) / 2, extent = log1p(half / length);
    double distance = u == 1 ? half : length * expm1(u * extent);
    p->u = u;
    p->alpha = s->side ? column->alpha_high - distance : column->alpha_low + distance;
    return evaluate(&p->c, s, p->alpha);
}

static cv_status add(const search *s, double alpha, int rises);

/* c changes its sign between a and b. */
static cv_status bisect(const search *s, probe a, probe b)
{
    int rises = (b.c > a.c) == (b.alpha > a.alpha) ? 1 : -1;
    probe m = a;
    for (int i = 0; i < 60 && b.u - a.u > 1e-9; ++i) {
        cv_status status = set_probe(&m, s, (a.u + b.u) / 2);
        if (status != CV_OK)
            return status;
        if ((m.c > 0) == (a.c > 0))
            a = m;
        else
            b = m;
    }
    return add(s, m.alpha, rises);
}

/* A parabola through p[0], p[2], p[4] predicts p[1] and p[3]. */
static int parabolic(const double f[5], double tolerance)
{
    return fabs(f[1] - (3 * f[0] + 6 * f[2] - f[4]) / 8) < tolerance &&
           fabs(f[3] - (3 * f[4] + 6 * f[2] - f[0]) / 8) < tolerance;
}

static int one_signed(const probe p[5])
{
    double f[5];
    for (int i = 0; i < 5; ++i) {
        if (!(p[i].c * p[0].c > 0))
            return 0;
        f[i] = log(fabs(p[i].c));
    }
    return parabolic(f, 0.1);
}

/* A parabola, and where it has an extremum not near zero. */
static int simple(const probe p[5])
{
    double f[5], largest = 0;
    for (int i = 0; i < 5; ++i) {
        f[i] = p[i].c;
        largest = fmax(largest, fabs(f[i]));
    }
    double slope = f[4] - f[0], bend = 2 * (f[0] - 2 * f[2] + f[4]); /* f = f2 + slope x + bend x^2 */
    double x = -slope / (2 * bend), extreme = f[2] - slope * slope / (4 * bend);
    return parabolic(f, 0.02 * largest) && (!(fabs(x) < 0.6) || fabs(extreme) > 0.1 * largest);
}

static cv_status scan(const search *s, const probe *a, const probe *m, const probe *b)
{
    const double smallest = 1e-8;
    probe p[5] = {*a, *a, *m, *m, *b};
    for (int i = 1; i < 5; i += 2) {
        cv_status status = set_probe(&p[i], s, (p[i - 1].u + p[i + 1].u) / 2);
        if (status != CV_OK)
            return status;
    }
    if (one_signed(p))
        return CV_OK;
    cv_status status = CV_OK;
    if (!simple(p) && b->u - a->u > smallest) {
        status = scan(s, &p[0], &p[1], &p[2]);
        return status == CV_OK ? scan(s, &p[2], &p[3], &p[4]) : status;
    }
    for (int i = 0; i < 4 && status == CV_OK; ++i)
        if ((p[i].c > 0) != (p[i + 1].c > 0))
            status = bisect(s, p[i], p[i + 1]);
    return status;
}

static cv_status scan_side(const search *s)
{
    const double largest = 2.5;
    const sa_column *column = &s->map.column[s->column];
    int n = 1 + (int)(sa_map_column_extent(column, s->side) / largest);
    probe a, m, b;
    cv_status status = set_probe(&a, s, 0);
    for (int i = 0; i < n && status == CV_OK; ++i) {
        status = set_probe(&m, s, (i + 0.5) / n);
        if (status == CV_OK)
            status = set_probe(&b, s, i + 1 == n ? 1 : (i + 1.0) / n);
        if (status == CV_OK)
            status = scan(s, &a, &m, &b);
        a = b;
    }
    return status;
}

/* alpha of the line Im zeta = 0 at a tiny q. */
static cv_status at_frequency(sa_line_vertex *out, const search *s, const mpfr_t q, double alpha)
{
    int rises;
    return sa_line_point(out, &rises, s->sweep, s->track, SA_GIVEN_Q, q, alpha, s->digits + 2);
}

static void set_asymptote(sa_asymptote *a, const sa_line_vertex *near, const sa_line_vertex *far, int digits)
{
    mpfr_t difference;
    mpfr_init2(difference, 64);
    mpfr_sub(difference, near->alpha, far->alpha, MPFR_RNDA);
    double moved = fabs(mpfr_get_d(difference, MPFR_RNDA));
    mpfr_clear(difference);
    mpfr_init2(a->alpha, mpfr_get_prec(near->alpha));
    mpfr_set(a->alpha, near->alpha, MPFR_RNDN);
    /* the farther q is 8 times as large: what the nearer one adds is 1/63 of the difference */
    a->alpha_error = near->alpha_error + (moved + far->alpha_error + near->alpha_error) / 16;
    a->has_line = mpfr_sgn(near->eta_M) > 0;
    int precise = a->alpha_error < pow(10, -digits) * mpfr_get_d(near->alpha, MPFR_RNDN);
    a->decided = near->decided == CV_OK && far->decided == CV_OK && precise ? CV_OK : CV_UNDECIDED;
}

/* Refines at q so small that its square is below the digits. */
static cv_status refine(sa_asymptote *a, const search *s, double alpha)
{
    sa_line_vertex vertex[2];
    mpfr_t q;
    cv_status status = CV_OK;
    mpfr_init2(q, 64);
    for (int i = 0; i < 2; ++i) {
        mpfr_set_si(q, -(s->digits / 2) - 3, MPFR_RNDN);
        mpfr_exp10(q, q, MPFR_RNDN);
        mpfr_mul_d(q, q, i == 0 ? s->shortest : 8 * s->shortest, MPFR_RNDN);
        cv_status this = at_frequency(&vertex[i], s, q, alpha);
        status = status == CV_OK ? this : status;
    }
    set_asymptote(a, &vertex[0], &vertex[1], s->digits);
    sa_line_vertex_clear(&vertex[0]);
    sa_line_vertex_clear(&vertex[1]);
    mpfr_clear(q);
    return status;
}

static cv_status add(const search *s, double alpha, int rises)
{
    sa_asymptote_list *list = s->out;
    sa_asymptote *more = realloc(list->item, (list->count + 1) * sizeof *more);
    if (more == NULL)
        return CV_FAILED;
    list->item = more;
    sa_asymptote *a = &more[list->count++];
    *a = (sa_asymptote){.rises = rises};
    return refine(a, s, alpha);
}

static int by_alpha(const void *left, const void *right)
{
    const sa_asymptote *a = left, *b = right;
    return mpfr_cmp(a->alpha, b->alpha);
}

static cv_status find(search *s)
{
    cv_status status = CV_OK;
    s->shortest = INFINITY;
    for (size_t i = 0; i < s->map.count; ++i)
        s->shortest = fmin(s->shortest, fmin(s->map.column[i].length_low, s->map.column[i].length_high));
    if (s->map.undamped) /* the nearest branch point is at q = 1e-7 */
        s->shortest = 1e-8;
    for (s->column = 0; s->column < s->map.count; ++s->column)
        for (s->side = 0; s->side < 2 && status == CV_OK && !s->map.column[s->column].closed; ++s->side)
            status = scan_side(s);
    if (s->out->count > 1)
        qsort(s->out->item, s->out->count, sizeof *s->out->item, by_alpha);
    return status;
}

cv_status sa_asymptotes_find(sa_asymptote_list *out, const cv_params *params, const cv_number *alpha_min,
                             const cv_number *alpha_max, int digits, cv_message *why)
{
    search s = {.digits = digits, .out = out};
    *out = (sa_asymptote_list){0};
    cv_status status = sa_track_new(&s.track, params, why);
    if (status != CV_OK)
        return status;
    if (cv_number_sign(alpha_min) <= 0 || cv_number_compare(alpha_min, alpha_max) >= 0)
        status = cv_fail(why, CV_BAD_INPUT, "the range of velocities must have 0 < alpha_min < alpha_max");
    else
        status = sa_map_build(&s.map, params, cv_number_get_double(alpha_min),
                              cv_number_get_double(alpha_max), why);
    if (status == CV_OK) {
        s.sweep = sa_sweep_new();
        status = s.sweep != NULL ? find(&s) : CV_FAILED;
        if (status != CV_OK)
            status = cv_fail(why, status, "the search for asymptotes failed");
        sa_sweep_free(s.sweep);
        sa_map_clear(&s.map);
    }
    sa_track_free(s.track);
    if (status != CV_OK)
        sa_asymptotes_clear(out);
    return status;
}

void sa_asymptotes_clear(sa_asymptote_list *list)
{
    for (size_t i = 0; i < list->count; ++i)
        mpfr_clear(list->item[i].alpha);
    free(list->item);
    *list = (sa_asymptote_list){0};
}
