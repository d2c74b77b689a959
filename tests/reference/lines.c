#include "lines.h"

#include <stdio.h>
#include <stdlib.h>
#include <tgmath.h>

enum { SPECIAL_MAX = 400 };
static const double log_jump = 0.15;
static const ref_real closest_columns = sizeof(ref_real) > sizeof(double) ? (ref_real)2e-18L
                                                                          : (ref_real)2e-15L;

typedef struct {
    const ref_dtrack *t;
    const ref_search *s;
    ref_candidates *out;
    double re_min;
    int failed;
} search;

static int compare(const void *x, const void *y)
{
    ref_real a = *(const ref_real *)x, b = *(const ref_real *)y;
    return (a > b) - (a < b);
}

/* The velocities of the base grid, ascending; returns how many. */
static size_t base_grid(ref_real **out, const ref_dtrack *t, const ref_search *s)
{
    double special[SPECIAL_MAX];
    size_t m = ref_special_velocities(special, SPECIAL_MAX, t, 0.5 * s->alpha_min, 1.2 * s->alpha_max);
    size_t each = (size_t)(s->per_decade * (log10(0.3) - log10(s->closest))) + 1, n = 0, kept = 0;
    ref_real *a = malloc((s->uniform + 1 + 2 * m * each) * sizeof *a);
    *out = a;
    if (a == NULL)
        return 0;
    for (size_t i = 0; i <= s->uniform; i++)
        a[n++] = s->alpha_min + (s->alpha_max - s->alpha_min) * (ref_real)i / (ref_real)s->uniform;
    for (size_t k = 0; k < m; k++) {
        for (size_t i = 0; i < each; i++) {
            ref_real d = 0.3 * pow(10, -(ref_real)i / s->per_decade);
            if (special[k] + d < s->alpha_max && special[k] + d > s->alpha_min)
                a[n++] = special[k] + d;
            if (special[k] - d > s->alpha_min && special[k] - d < s->alpha_max)
                a[n++] = special[k] - d;
        }
    }
    qsort(a, n, sizeof *a, compare);
    for (size_t i = 0; i < n; i++)
        if (kept == 0 || a[i] - a[kept - 1] > closest_columns * a[i])
            a[kept++] = a[i];
    return kept;
}

static void column(ref_column *out, search *x, ref_real alpha)
{
    /* a lost root is mostly a matter of the exact place: try a few ulps beside it */
    ref_real shift = closest_columns;
    for (int i = 0; i < 12; i++, shift *= -3)
        if (ref_scan(out, x->t, alpha * (1 + (i == 0 ? 0 : shift)), x->re_min) == 0)
            break;
        else if (i == 11)
            x->failed = 1;
    x->out->columns++;
    if (x->failed)
        fprintf(stderr, "lost column at alpha = %.20Lg\n", (long double)alpha);
}

static int corresponds(const ref_column *a, const ref_column *b)
{
    if (a->count != b->count)
        return 0;
    for (int k = 0; k < a->count; k++)
        if (a->zero[k].fall != b->zero[k].fall || !(fabs(log(a->zero[k].re / b->zero[k].re)) < log_jump) ||
            !(fabs(log(a->zero[k].q / b->zero[k].q)) < log_jump))
            return 0;
    return 1;
}

static void push(search *x, const ref_candidate *c)
{
    ref_candidates *l = x->out;
    if (l->count == l->allocated) {
        size_t n = 2 * l->allocated + 64;
        ref_candidate *grown = realloc(l->candidate, n * sizeof *grown);
        if (grown == NULL) {
            x->failed = 1;
            return;
        }
        l->candidate = grown;
        l->allocated = n;
    }
    l->candidate[l->count++] = *c;
}

/* Neighbours that correspond: every zero that passes some 1/eta_M is a candidate. */
static void emit(search *x, const ref_column *a, const ref_column *b)
{
    for (size_t m = 0; m < x->s->mass_count; m++) {
        ref_real target = 1 / x->s->mass[m];
        for (int k = 0; k < a->count; k++) {
            ref_real ya = a->zero[k].re - target, yb = b->zero[k].re - target;
            if ((ya > 0) == (yb > 0))
                continue;
            ref_candidate c = {
                m, a->zero[k].fall, {a->alpha, b->alpha}, {a->zero[k].q, b->zero[k].q}, {ya, yb}};
            push(x, &c);
        }
    }
}

/* Neighbours as close as columns get that still do not correspond: harmless when zeros are born or die in
 * pairs, or on the threshold, both away from every 1/eta_M; anything else is told. */
static void unresolved(search *x, const ref_column *a, const ref_column *b)
{
    int harmless = 1;
    for (size_t m = 0; m < x->s->mass_count; m++)
        if (ref_scan_unstable(a, x->s->mass[m]) != ref_scan_unstable(b, x->s->mass[m]))
            harmless = 0;
    if (harmless)
        return;
    x->out->unresolved++;
    fprintf(stderr, "unresolved at alpha = %.20Lg\n", (long double)a->alpha);
    for (int side = 0; side < 2; side++) {
        const ref_column *c = side ? b : a;
        for (int k = 0; k < c->count; k++)
            fprintf(stderr, "   %d: q %.18Lg eta_M %.12Lg fall %d\n", side, (long double)c->zero[k].q,
                    (long double)(1 / c->zero[k].re), c->zero[k].fall);
    }
}

static void process(search *x, const ref_column *a, const ref_column *b, int depth)
{
    if (corresponds(a, b)) {
        emit(x, a, b);
        return;
    }
    if (depth == 60 || b->alpha - a->alpha < closest_columns * a->alpha) {
        unresolved(x, a, b);
        return;
    }
    ref_column *m = malloc(sizeof *m);
    if (m == NULL) {
        x->failed = 1;
        return;
    }
    column(m, x, 0.5 * (a->alpha + b->alpha));
    if (m->alpha > a->alpha && m->alpha < b->alpha) {
        process(x, a, m, depth + 1);
        process(x, m, b, depth + 1);
    } else {
        unresolved(x, a, b);
    }
    free(m);
}

/* Three columns that correspond, with a zero whose Re zeta comes nearest to some 1/eta_M in the middle one
 * without reaching it, but whose parabola might. */
static int near_miss(const search *x, const ref_column *a, const ref_column *m, const ref_column *b)
{
    if (!corresponds(a, m) || !corresponds(m, b))
        return 0;
    for (size_t i = 0; i < x->s->mass_count; i++) {
        for (int k = 0; k < m->count; k++) {
            ref_real ya = a->zero[k].re * x->s->mass[i] - 1, y = m->zero[k].re * x->s->mass[i] - 1;
            ref_real yb = b->zero[k].re * x->s->mass[i] - 1;
            if (!(ya * y > 0 && y * yb > 0 && fabs(y) < fabs(ya) && fabs(y) <= fabs(yb)))
                continue;
            ref_real da = (y - ya) / (m->alpha - a->alpha), db = (yb - y) / (b->alpha - m->alpha);
            ref_real curve = (db - da) / (b->alpha - a->alpha), slope = da + curve * (m->alpha - a->alpha);
            if ((y - 0.25 * slope * slope / curve) / y < 0.5)
                return 1;
        }
    }
    return 0;
}

/* Halves the intervals around near misses until they are decided. */
static void near_misses(search *x, const ref_column *a, const ref_column *m, const ref_column *b, int depth)
{
    if (depth == 45 || !near_miss(x, a, m, b)) {
        process(x, a, m, 0);
        process(x, m, b, 0);
        return;
    }
    ref_column *am = malloc(2 * sizeof *am), *mb = am + 1;
    if (am == NULL) {
        x->failed = 1;
        return;
    }
    column(am, x, 0.5 * (a->alpha + m->alpha));
    column(mb, x, 0.5 * (m->alpha + b->alpha));
    if (near_miss(x, am, m, mb)) {
        process(x, a, am, 0);
        near_misses(x, am, m, mb, depth + 1);
        process(x, mb, b, 0);
    } else {
        near_misses(x, a, am, m, depth + 1);
        near_misses(x, m, mb, b, depth + 1);
    }
    free(am);
}

int ref_search_lines(ref_candidates *out, const ref_dtrack *t, const ref_search *s)
{
    ref_real *alpha = NULL;
    double mass_max = 0;
    *out = (ref_candidates){0};
    for (size_t i = 0; i < s->mass_count; i++)
        mass_max = fmax(mass_max, s->mass[i]);
    search x = {t, s, out, 0.3 / mass_max, 0};
    size_t n = base_grid(&alpha, t, s);
    ref_column *c = malloc(3 * sizeof *c);
    if (n < 3 || c == NULL) {
        free(alpha);
        free(c);
        return -1;
    }
    column(&c[0], &x, alpha[0]);
    column(&c[1], &x, alpha[1]);
    size_t i = 2;
    for (; i < n && !x.failed; i++) {
        column(&c[i % 3], &x, alpha[i]);
        const ref_column *a = &c[(i + 1) % 3], *m = &c[(i + 2) % 3], *b = &c[i % 3];
        if (near_miss(&x, a, m, b)) {
            near_misses(&x, a, m, b, 0);
            /* both intervals are done: start afresh at b */
            if (++i < n)
                column(&c[i % 3], &x, alpha[i]);
            continue;
        }
        process(&x, a, m, 0);
    }
    if (!x.failed && i == n)
        process(&x, &c[(n - 2) % 3], &c[(n - 1) % 3], 0);
    free(alpha);
    free(c);
    return x.failed ? -1 : 0;
}

void ref_candidate_guess(ref_real *alpha, ref_real *q, const ref_candidate *c)
{
    ref_real w = c->excess[0] / (c->excess[0] - c->excess[1]);
    *alpha = c->alpha[0] + w * (c->alpha[1] - c->alpha[0]);
    *q = c->q[0] + w * (c->q[1] - c->q[0]);
}

int ref_candidate_halve(ref_candidate *c, const ref_dtrack *t, double mass)
{
    ref_column column;
    const ref_zero *best = NULL;
    ref_real alpha = 0.5 * (c->alpha[0] + c->alpha[1]), q = 0.5 * (c->q[0] + c->q[1]);
    if (!(alpha > c->alpha[0] && alpha < c->alpha[1]) || ref_scan(&column, t, alpha, 0.3 / mass) != 0)
        return -1;
    for (int k = 0; k < column.count; k++)
        if (column.zero[k].fall == c->fall &&
            (best == NULL || fabs(column.zero[k].q - q) < fabs(best->q - q)))
            best = &column.zero[k];
    if (best == NULL)
        return -1;
    ref_real excess = best->re - 1 / mass;
    int side = (excess > 0) == (c->excess[0] > 0) ? 0 : 1;
    c->alpha[side] = alpha;
    c->q[side] = best->q;
    c->excess[side] = excess;
    return 0;
}

void ref_candidates_clear(ref_candidates *c)
{
    free(c->candidate);
    *c = (ref_candidates){0};
}
