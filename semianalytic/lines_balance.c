#include <math.h>

#include "semianalytic/lines_parts.h"

/* Where a line passes alpha between two samples. */
typedef struct {
    const sa_line_sample *a, *b;
    double alpha;
    int rises;       /* whether Im zeta grows with q there (1) or falls (-1) */
    int beside_turn; /* a turning point is so near that its other arm is, too */
} passage;

/* What is known of Re zeta against the level */
typedef enum { ABOVE_LINE, BELOW_LINE, UNCLEAR } side;

static const double CLEAR = 3;

/* alpha of the sample, subtracted: exact in double where it matters, next to a turning point */
static double from_sample(double alpha, const sa_line_sample *s)
{
    return (alpha - s->alpha) - s->alpha_rest;
}

/* Part of the way from a to b; next to a turning point as along a parabola. */
static double part_of_way(const passage *p)
{
    const double a = from_sample(p->alpha, p->a), b = -from_sample(p->alpha, p->b), x = a / (a + b);
    if (p->a->turn == SA_TURN_SETTLED)
        return sqrt(x);
    return p->b->turn == SA_TURN_SETTLED ? 1 - sqrt(1 - x) : x;
}

/* Distance from a curve as the map grades it: its logarithm, down to the length */
static double graded(double distance, double length)
{
    return copysign(log1p(fabs(distance) / length), distance);
}

/* Where to look for the line: the graded distance to the nearest curve of the map is interpolated, since a
 * line may follow one much nearer than the chord. */
static double first_q(const passage *p, const sa_line_store *store)
{
    const double x = part_of_way(p), chord = p->a->q + x * (p->b->q - p->a->q);
    sa_map_node a, b, m;
    int i = 0;
    if (sa_map_node_of(&a, &store->map, p->a->alpha) != CV_OK ||
        sa_map_node_of(&b, &store->map, p->b->alpha) != CV_OK ||
        sa_map_node_of(&m, &store->map, p->alpha) != CV_OK || a.count != b.count || a.count != m.count)
        return chord;
    for (int k = 1; k < a.count; ++k)
        i = fabs(p->a->q - a.q[k]) < fabs(p->a->q - a.q[i]) ? k : i;
    const double length = m.length[i], from = graded(p->a->q - a.q[i], length),
                 to = graded(p->b->q - b.q[i], length), t = from + x * (to - from),
                 q = m.q[i] + copysign(length * expm1(fabs(t)), t);
    return isfinite(q) && q > 0 ? q : chord;
}

/* Between the samples with some room; which arm of the line it is next to a turning point, "rises" tells. */
static int within(const passage *p, double q)
{
    const double slack = fabs(p->b->q - p->a->q) + 1e-12 * q;
    return q > fmin(p->a->q, p->b->q) - slack && q < fmax(p->a->q, p->b->q) + slack;
}

static int plausible(const passage *p, double re)
{
    return re > fmin(p->a->re, p->b->re) / CLEAR && re < CLEAR * fmax(p->a->re, p->b->re);
}

/* Re zeta there in double: Newton in q from *q, which is left as near as it came. */
static cv_status re_at(double *re, double *error, double *q, const passage *p, const sa_line_store *store)
{
    const double resolved = 1e-6;
    for (int i = 0; i < 40; ++i) {
        sa_value v;
        cv_status status = sa_zeta_adaptive(&v, store->sweep, store->track, p->alpha, *q, 0.1);
        if (status != CV_OK)
            return status;
        double step = -v.im / cimag(v.d_q);
        *re = v.re;
        *error = v.re_error + fabs(creal(v.d_q) * step) + fabs(creal(v.d_q)) * 1e-15 * *q;
        if (fabs(step) < 1e-14 * *q || fabs(creal(v.d_q) * step) < 1e-12 * fabs(v.re)) {
            const double slope = cimag(v.d_q) * p->rises;
            return !p->beside_turn || slope > resolved * fabs(creal(v.d_q)) ? CV_OK : CV_UNDECIDED;
        }
        if (!within(p, *q + step))
            return CV_UNDECIDED;
        *q += step;
    }
    return CV_UNDECIDED;
}

/* The same to many digits, with a proven bound. */
static side exact_side(const passage *p, const sa_line_store *store, double start, double eta_M)
{
    enum { DIGITS = 20 };
    sa_line_vertex v;
    mpfr_t alpha;
    int rises;
    side found = UNCLEAR;
    mpfr_init_set_d(alpha, p->alpha, MPFR_RNDN);
    cv_status status =
        sa_line_point(&v, &rises, store->sweep, store->track, SA_GIVEN_ALPHA, alpha, start, DIGITS);
    if (status == CV_OK && v.decided == CV_OK && rises == p->rises && within(p, mpfr_get_d(v.q, MPFR_RNDN)) &&
        plausible(p, 1 / mpfr_get_d(v.eta_M, MPFR_RNDN))) {
        mpfr_sub_d(v.eta_M, v.eta_M, eta_M, MPFR_RNDN);
        const double excess = mpfr_get_d(v.eta_M, MPFR_RNDN);
        if (fabs(excess) > 2 * v.eta_M_error)
            found = excess > 0 ? BELOW_LINE : ABOVE_LINE;
    }
    sa_line_vertex_clear(&v);
    mpfr_clear(alpha);
    return found;
}

/* On which side of the line the point is */
static side side_of(const passage *p, const sa_line_store *store, double eta_M)
{
    const double level = 1 / eta_M, low = fmin(p->a->re, p->b->re), high = fmax(p->a->re, p->b->re);
    double re, error, q = first_q(p, store);
    if (low > CLEAR * level)
        return ABOVE_LINE;
    if (high < level / CLEAR)
        return BELOW_LINE;
    if (re_at(&re, &error, &q, p, store) == CV_OK && fabs(re - level) > 2 * error && plausible(p, re))
        return re > level ? ABOVE_LINE : BELOW_LINE;
    side found = exact_side(p, store, q, eta_M);
    return found == UNCLEAR ? exact_side(p, store, first_q(p, store), eta_M) : found;
}

/* Whether the line may turn beyond sample b, whose alpha is the extreme one of three, so far that it passes
 * alpha twice there, on different sides of the level. Room for samples at uneven distances along the line;
 * none is needed next to a settled turning point. */
static int fold_may_pass(const sa_line_sample *a, const sa_line_sample *b, const sa_line_sample *c,
                         double alpha, double level)
{
    const double room = 4;
    double before = b->alpha - a->alpha, after = c->alpha - b->alpha;
    double reach = room * fmax(fabs(before), fabs(after)) + 1e-15 * alpha;
    double low = fmin(a->re, fmin(b->re, c->re)), high = fmax(a->re, fmax(b->re, c->re));
    if (b->turn == SA_TURN_SETTLED)
        reach = b->alpha_error;
    if (sa_line_in_limit(a) || sa_line_in_limit(b) || sa_line_in_limit(c)) /* known where they turn */
        return 0;
    return before * after <= 0 && !(fabs(from_sample(alpha, b)) > reach) && !(low > CLEAR * level) &&
           !(high < level / CLEAR);
}

/* First sample of the line with two neighbours, from k on, where that is so; count: none. */
static size_t next_fold(const sa_line *line, const sa_line_sample *s, size_t k, double alpha, double level)
{
    const size_t n = line->count, margin = line->closed ? 0 : 1;
    for (k = k < margin ? margin : k; n > 2 && k + margin < n; ++k)
        if (fold_may_pass(&s[(k + n - 1) % n], &s[k], &s[(k + 1) % n], alpha, level))
            return k;
    return n;
}

/* Settles every turning point that matters. CV_UNDECIDED: one cannot be. */
static cv_status settle_folds(const sa_line_store *store, sa_line *line, double alpha, double level)
{
    const sa_line_sample *s = &store->samples.item[line->first];
    cv_status status = CV_OK;
    for (size_t k = next_fold(line, s, 0, alpha, level); k < line->count && status == CV_OK;
         k = next_fold(line, s, 0, alpha, level))
        status = s[k].turn == SA_TURN_UNTRIED ? sa_line_settle_turn(store, line, k) : CV_UNDECIDED;
    return status;
}

static int turns_at(const sa_line *line, const sa_line_sample *s, size_t k)
{
    const size_t n = line->count;
    if (s[k].turn == SA_TURN_SETTLED)
        return 1;
    return (line->closed || (k > 0 && k + 1 < n)) &&
           (s[k].alpha - s[(k + n - 1) % n].alpha) * (s[(k + 1) % n].alpha - s[k].alpha) <= 0;
}

/* A turning point is one of the samples from k - 1 to k + 2. */
static int beside_turn(const sa_line *line, const sa_line_sample *s, size_t k)
{
    const size_t n = line->count;
    for (size_t i = k + n - 1; i <= k + n + 2; ++i)
        if (turns_at(line, s, i % n))
            return 1;
    return 0;
}

/* What one line contributes to N. */
static cv_status balance(int *sum, const sa_line_store *store, sa_line *line, double alpha, double eta_M)
{
    const sa_line_sample *s = &store->samples.item[line->first];
    cv_status status = settle_folds(store, line, alpha, 1 / eta_M);
    for (size_t k = 0; status == CV_OK && k + 1 < line->count + (size_t)line->closed; ++k) {
        passage p = {&s[k], &s[(k + 1) % line->count], alpha, 0, 0};
        const int from = from_sample(alpha, p.a) >= 0, to = from_sample(alpha, p.b) >= 0;
        if (from == to)
            continue;
        p.rises = from ? -1 : 1;
        p.beside_turn = beside_turn(line, s, k);
        const side found = side_of(&p, store, eta_M);
        if (found == UNCLEAR)
            status = CV_UNDECIDED;
        else if (found == ABOVE_LINE)
            *sum += from ? 2 : -2;
    }
    return status;
}

cv_status sa_lines_count(int *roots, sa_lines *lines, double alpha, double eta_M, cv_message *why)
{
    sa_line_store *store = lines->store;
    cv_status status = CV_OK;
    int sum = 0;
    if (!(alpha >= store->map.curves.alpha_min && alpha <= store->map.curves.alpha_max))
        return cv_fail(why, CV_BAD_INPUT, "alpha = %.15g is outside the range of the lines", alpha);
    if (!(eta_M > 0 && eta_M <= SA_LINES_MASS_MAX))
        return cv_fail(why, CV_BAD_INPUT, "eta_M must be above 0 and at most %g", SA_LINES_MASS_MAX);
    if (1 / eta_M < store->re_floor)
        return cv_fail(why, CV_UNDECIDED, "lines were not followed up to eta_M = %.15g", eta_M);
    /* lines that end at the upper end of the range pass below it */
    alpha = fmin(alpha, nextafter(store->map.curves.alpha_max, 0));
    for (size_t i = 0; i < lines->line_count && status == CV_OK; ++i)
        status = balance(&sum, store, &store->line[i], alpha, eta_M);
    if (status != CV_OK)
        return cv_fail(why, status, "alpha = %.15g, eta_M = %.15g is on a line, or where one turns", alpha,
                       eta_M);
    *roots = sum;
    return lines->decided;
}
