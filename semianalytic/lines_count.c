#include <math.h>

#include "semianalytic/crossings.h"
#include "semianalytic/lines_parts.h"

/* N on both sides of the crossing at eta_M, q; 0 when it cannot be told from the others. */
static int count_at(sa_branch *b, const sa_crossings *list, double eta_M, double q)
{
    const double near = 1e-3, same_mass = 0.02;
    const sa_crossing *own = NULL;
    int below = 0;
    for (size_t i = 0; i < list->count; ++i) {
        const sa_crossing *c = &list->items[i];
        double excess = c->re * eta_M - 1;
        if (fabs(c->q - q) < near * q && fabs(excess) < same_mass) {
            if (own != NULL)
                return 0;
            own = c;
        } else if (!(fabs(excess) > near + 2 * c->re_error * eta_M)) {
            return 0;
        } else if (excess > 0) {
            below += 2 * c->direction;
        }
    }
    if (own == NULL)
        return 0;
    b->roots_left = own->direction > 0 ? below + 2 : below;
    b->roots_right = own->direction > 0 ? below : below - 2;
    return b->roots_right >= 0;
}

static cv_status try_vertex(sa_branch *b, const sa_line_store *store, size_t i)
{
    const sa_line_vertex *v = &b->vertex[i];
    double alpha = mpfr_get_d(v->alpha, MPFR_RNDN), q = mpfr_get_d(v->q, MPFR_RNDN),
           eta_M = mpfr_get_d(v->eta_M, MPFR_RNDN);
    sa_crossings list;
    if (v->decided != CV_OK || (v->marks & SA_MARK_TURN))
        return CV_OK;
    cv_status status = sa_crossings_find(&list, &store->map, store->field, alpha, 0.5 / eta_M, NULL);
    if (status == CV_OK && count_at(b, &list, eta_M, q)) {
        b->counted = CV_OK;
        b->counted_at = i;
    }
    sa_crossings_clear(&list);
    return status == CV_FAILED ? status : CV_OK;
}

/* From the middle of the branch outwards. */
cv_status sa_branch_count(sa_branch *branch, const sa_line_store *store)
{
    enum { TRIES = 16 };
    cv_status status = CV_OK;
    size_t middle = branch->count / 2;
    branch->counted = CV_UNDECIDED;
    for (size_t k = 0; k < TRIES && status == CV_OK && branch->counted != CV_OK; ++k) {
        size_t step = (k + 1) / 2, i = k % 2 ? middle + step : middle - step;
        if (i < branch->count)
            status = try_vertex(branch, store, i);
    }
    return status;
}

/* Where a line passes alpha between two samples. */
typedef struct {
    const sa_line_sample *a, *b;
    double alpha;
} passage;

/* Re zeta there: Newton in q from the chord, kept between the samples with some room. */
static cv_status re_at(double *re, double *error, const passage *p, sa_line_store *store)
{
    double x = (p->alpha - p->a->alpha) / (p->b->alpha - p->a->alpha);
    double q = p->a->q + x * (p->b->q - p->a->q), slack = fabs(p->b->q - p->a->q) + 1e-12 * q;
    double low = fmin(p->a->q, p->b->q) - slack, high = fmax(p->a->q, p->b->q) + slack;
    for (int i = 0; i < 40; ++i) {
        sa_value v;
        cv_status status = sa_zeta_adaptive(&v, store->sweep, store->track, p->alpha, q, 0.1);
        if (status != CV_OK)
            return status;
        double step = -v.im / cimag(v.d_q);
        *re = v.re;
        *error = v.re_error + fabs(creal(v.d_q) * step) + fabs(creal(v.d_q)) * 1e-15 * q;
        if (fabs(step) < 1e-14 * q || fabs(creal(v.d_q) * step) < 1e-12 * fabs(v.re))
            return CV_OK;
        if (!(q + step > low && q + step < high))
            return CV_UNDECIDED;
        q += step;
    }
    return CV_UNDECIDED;
}

/* 1: the line passes below eta_M = 1 / level, 0: above, -1: undecided. */
static int passes_below(const passage *p, sa_line_store *store, double level)
{
    const double clear = 3;
    double low = fmin(p->a->re, p->b->re), high = fmax(p->a->re, p->b->re), re, error;
    if (low > clear * level)
        return 1;
    if (high < level / clear)
        return 0;
    if (re_at(&re, &error, p, store) != CV_OK || !(fabs(re - level) > 2 * error))
        return -1;
    if (!(re > low / clear && re < clear * high))
        return -1; /* Newton went to another zero */
    return re > level;
}

/* Whether the line may turn beyond sample b, whose alpha is the extreme one of three, so far that it passes
 * alpha twice there, on different sides of the level. Room for samples at uneven distances along the line. */
static int fold_may_pass(const sa_line_sample *a, const sa_line_sample *b, const sa_line_sample *c,
                         double alpha, double level)
{
    const double clear = 3, room = 4;
    double before = b->alpha - a->alpha, after = c->alpha - b->alpha;
    double reach = room * fmax(fabs(before), fabs(after)) + 1e-15 * alpha;
    double low = fmin(a->re, fmin(b->re, c->re)), high = fmax(a->re, fmax(b->re, c->re));
    return before * after <= 0 && !(fabs(alpha - b->alpha) > reach) && !(low > clear * level) &&
           !(high < level / clear);
}

/* The same for every sample of a line with two neighbours. */
static int folds_may_pass(const sa_line *line, const sa_line_sample *s, double alpha, double level)
{
    size_t n = line->count;
    for (size_t k = line->closed ? 0 : 1; n > 2 && k + (line->closed ? 0 : 1) < n; ++k)
        if (fold_may_pass(&s[(k + n - 1) % n], &s[k], &s[(k + 1) % n], alpha, level))
            return 1;
    return 0;
}

cv_status sa_lines_count(int *roots, sa_lines *lines, double alpha, double eta_M, cv_message *why)
{
    sa_line_store *store = lines->store;
    int sum = 0;
    if (!(alpha >= store->map.curves.alpha_min && alpha <= store->map.curves.alpha_max))
        return cv_fail(why, CV_BAD_INPUT, "alpha = %.15g is outside the range of the lines", alpha);
    if (!(eta_M > 0 && eta_M <= SA_LINES_MASS_MAX))
        return cv_fail(why, CV_BAD_INPUT, "eta_M must be above 0 and at most %g", SA_LINES_MASS_MAX);
    /* lines that end at the upper end of the range pass below it */
    alpha = fmin(alpha, nextafter(store->map.curves.alpha_max, 0));
    for (size_t i = 0; i < lines->line_count; ++i) {
        const sa_line *line = &store->line[i];
        const sa_line_sample *s = &store->samples.item[line->first];
        if (folds_may_pass(line, s, alpha, 1 / eta_M))
            return cv_fail(why, CV_UNDECIDED, "a line turns at alpha = %.15g near eta_M = %.15g", alpha,
                           eta_M);
        for (size_t k = 0; k + 1 < line->count + (size_t)line->closed; ++k) {
            const passage p = {&s[k], &s[(k + 1) % line->count], alpha};
            if ((p.a->alpha <= alpha) == (p.b->alpha <= alpha))
                continue;
            int below = passes_below(&p, store, 1 / eta_M);
            if (below < 0)
                return cv_fail(why, CV_UNDECIDED, "alpha = %.15g, eta_M = %.15g is on a line", alpha, eta_M);
            sum += p.a->alpha <= alpha ? 2 * below : -2 * below;
        }
    }
    *roots = sum;
    return lines->decided;
}
