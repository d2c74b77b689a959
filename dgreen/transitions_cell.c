#include "dgreen/transitions_cell.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/transitions_branch.h"
#include "dgreen/velocities.h"

enum { MAX_DEPTH = 70, MAX_ALIGNED = 64, NONE = -1 };
/* Costs of the alignment: a crossing without a partner, and the weight of a difference of position */
static const double SKIP = 3, POSITION_WEIGHT = 0.2;
/* A dip or an unpaired crossing matters for mass ratios with 1/eta_M within this factor */
static const double REACH = 4;
/* A dip may fall this many times as fast as its slope says */
static const double DIP_SAFETY = 4;
/* Part of the range of unpaired crossings by which 1/eta_M must keep away from it */
static const double MARGIN = 0.5;

typedef struct {
    const dg_curve *left, *right;
    int right_of[MAX_ALIGNED]; /* index of the partner on the right, or NONE */
    int left_of[MAX_ALIGNED];
} alignment;

static double match_cost(const dg_crossing *a, const dg_crossing *b, int positions)
{
    if (a->direction != b->direction)
        return INFINITY;
    return fabs(log(a->x / b->x)) + (positions ? POSITION_WEIGHT * fabs(a->position - b->position) : 0);
}

/* Edit distance by dynamic programming; ties prefer pairs. 0 when there are too many crossings. */
static int align(alignment *g)
{
    const size_t n = g->left->crossing_count, m = g->right->crossing_count;
    double cost[MAX_ALIGNED + 1][MAX_ALIGNED + 1];
    if (n > MAX_ALIGNED || m > MAX_ALIGNED)
        return 0;
    const int positions = g->left->at.hard_count == g->right->at.hard_count;
    for (size_t i = 0; i <= n; i++)
        for (size_t j = 0; j <= m; j++) {
            double best = i == 0 && j == 0 ? 0 : INFINITY;
            if (i > 0)
                best = fmin(best, cost[i - 1][j] + SKIP);
            if (j > 0)
                best = fmin(best, cost[i][j - 1] + SKIP);
            if (i > 0 && j > 0)
                best = fmin(best, cost[i - 1][j - 1] + match_cost(&g->left->crossings[i - 1],
                                                                  &g->right->crossings[j - 1], positions));
            cost[i][j] = best;
        }
    size_t i = n, j = m;
    while (i > 0 || j > 0) {
        const double here = cost[i][j];
        if (i > 0 && j > 0 &&
            here == cost[i - 1][j - 1] +
                        match_cost(&g->left->crossings[i - 1], &g->right->crossings[j - 1], positions)) {
            g->right_of[--i] = (int)--j;
            g->left_of[j] = (int)i;
        } else if (i > 0 && here == cost[i - 1][j] + SKIP) {
            g->right_of[--i] = NONE;
        } else {
            g->left_of[--j] = NONE;
        }
    }
    return 1;
}

/* One end of the cell on the way to the other: crossings, and their partners there */
typedef struct {
    const dg_curve *here, *there;
    const int *partner, *partner_there;
    double way; /* from here to there in alpha, signed */
} outlook;

static outlook from_left(const alignment *g)
{
    return (outlook){g->left, g->right, g->right_of, g->left_of, g->right->at.alpha - g->left->at.alpha};
}

static outlook from_right(const alignment *g)
{
    return (outlook){g->right, g->left, g->left_of, g->right_of, g->left->at.alpha - g->right->at.alpha};
}

/* Whether the crossings of one end that have no partner matter for 1/eta_M = x. Two that were born together
 * spread over [least, most] from a common value between; one alone has gone down to the floor. As x moves
 * with the root of the distance from the birth, twice its slope leads back there. x must keep away from that
 * range by a part of its width. */
static int unpaired_matter(const dg_sweep *s, const outlook *o, double x)
{
    size_t n = 0;
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < o->here->crossing_count; i++) {
        const dg_crossing *c = &o->here->crossings[i];
        const double back = c->x + 2 * c->dx * o->way;
        if (o->partner[i] != NONE)
            continue;
        n++;
        least = fmin(least, fmin(c->x, back));
        most = fmax(most, fmax(c->x, back));
    }
    if (n % 2 == 1)
        least = fmin(least, o->here->x_floor);
    const double margin = ldexp(MARGIN, s->probe.look) * (most - least);
    return n > 0 && x > least - margin && x < most + margin;
}

/* Whether a dip may reach zero on the way, by its slope with room for curvature, at an x that matters. */
static int may_reach_zero(const dg_sweep *s, const dg_dip *d, double way)
{
    const double safety = ldexp(DIP_SAFETY, s->probe.look), reach = ldexp(REACH, s->probe.look);
    if (fabs(d->im) > safety * fabs(d->d_im * way))
        return 0;
    for (size_t k = 0; k < s->mass_count; k++)
        if (d->re < reach * s->masses[k].x && d->re > s->masses[k].x / reach)
            return 1;
    return 0;
}

/* How many crossings without partner there are at the other end between the neighbours of this dip, if the
 * first of them leads to the other sign; they are what became of it. */
static int born_of(const outlook *o, const dg_dip *d)
{
    const size_t n = o->here->crossing_count;
    size_t above = 0;
    while (above < n && o->here->crossings[above].q < d->q)
        above++;
    if ((above > 0 && o->partner[above - 1] == NONE) || (above < n && o->partner[above] == NONE))
        return 0;
    const int first = above > 0 ? o->partner[above - 1] + 1 : 0;
    const int end = above < n ? o->partner[above] : (int)o->there->crossing_count;
    return first < end && o->there->crossings[first].direction == (d->im > 0 ? 1 : -1) ? end - first : 0;
}

/* Whether a dip may reach zero unseen: at the other end there are not as many pairs of new crossings as dips.
 */
static int dips_matter(const dg_sweep *s, const outlook *o)
{
    int explained = 0;
    const dg_dip *last = NULL;
    for (size_t i = 0; i < o->here->dip_count; i++) {
        const dg_dip *d = &o->here->dips[i];
        if (!may_reach_zero(s, d, o->way))
            continue;
        for (size_t k = 0; k < o->here->crossing_count && last != NULL; k++)
            if (o->here->crossings[k].q > last->q && o->here->crossings[k].q < d->q)
                explained = 0;
        explained += 2;
        last = d;
        if (explained > born_of(o, d))
            return 1;
    }
    return 0;
}

static cv_status follow_pairs(dg_sweep *s, const alignment *g)
{
    const dg_curve *left = g->left, *right = g->right;
    cv_status status = CV_OK;
    for (size_t i = 0; i < left->crossing_count && status == CV_OK; i++)
        if (g->right_of[i] != NONE)
            status = dg_branch_scan(s, left, &left->crossings[i], right, &right->crossings[g->right_of[i]]);
    return status;
}

/* One attempt without cutting. CV_UNDECIDED: cut. */
static cv_status attempt(dg_sweep *s, const dg_curve *left, const dg_curve *right)
{
    alignment g = {.left = left, .right = right};
    if (!align(&g))
        return CV_UNDECIDED;
    const outlook one = from_left(&g), other = from_right(&g);
    for (size_t k = 0; k < s->mass_count; k++)
        if (unpaired_matter(s, &one, s->masses[k].x) || unpaired_matter(s, &other, s->masses[k].x))
            return CV_UNDECIDED;
    if (dips_matter(s, &one) || dips_matter(s, &other))
        return CV_UNDECIDED;
    return follow_pairs(s, &g);
}

/* Marks the mass ratios whose count changes without an explanation; returns whether there are any. */
static int unexplained(dg_sweep *s, const dg_curve *left, const dg_curve *right, const size_t *before,
                       int doubt)
{
    int any = 0;
    for (size_t k = 0; k < s->mass_count; k++) {
        dg_mass *mass = &s->masses[k];
        int change = dg_crossing_balance(right, mass->x) - dg_crossing_balance(left, mass->x);
        for (size_t i = before[k]; i < mass->count; i++)
            change -= mass->finds[i].change;
        if (change == 0)
            continue;
        any = 1;
        if (doubt)
            dg_sweep_doubt(mass, "unexplained change of the number of unstable roots", left->at.alpha,
                           right->at.alpha);
    }
    return any;
}

static cv_status search(dg_sweep *s, const dg_curve *left, const dg_curve *right, int depth);

static cv_status cut(dg_sweep *s, const dg_curve *left, const dg_curve *right, int depth)
{
    dg_curve middle = {0};
    const double alpha = dg_velocities_middle(s->probe.branches, left->at.alpha, right->at.alpha);
    cv_status status = dg_curve_at(&middle, &s->probe, alpha, s->x_floor, s->why);
    if (status == CV_OK)
        status = search(s, left, &middle, depth - 1);
    if (status == CV_OK)
        status = search(s, &middle, right, depth - 1);
    dg_curve_clear(&middle);
    return status;
}

/* Adds the transitions of all mass ratios with 1/eta_M between two neighbouring crossings of this end that
 * have no partner, nor crossings in their place, at the other: they meet at a fold on the way, and as the way
 * is as short as doubles are apart, one of them passes 1/eta_M once before. */
static cv_status add_folds(dg_sweep *s, const outlook *o)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i + 1 < o->here->crossing_count && status == CV_OK; i++) {
        const dg_crossing *a = &o->here->crossings[i], *b = a + 1, *upper = a->x > b->x ? a : b;
        if (o->partner[i] != NONE || o->partner[i + 1] != NONE || a->direction == b->direction)
            continue;
        const double reach = fmax(dg_special_distance(s->probe.branches, o->here->at.alpha), fabs(o->way));
        for (size_t k = 0; k < s->mass_count && status == CV_OK; k++) {
            const double part = (s->masses[k].x - a->x) / (b->x - a->x);
            const dg_find find = {.alpha = o->here->at.alpha,
                                  .q = a->q + part * (b->q - a->q),
                                  .dq = a->dq,
                                  .dx = a->dx,
                                  .scale = fmin(a->scale, b->scale),
                                  .reach = reach,
                                  .change = (o->way > 0 ? -2 : 2) * upper->direction,
                                  .across = 1};
            if (part > 0 && part < 1)
                status = dg_sweep_add(s, k, &find);
        }
        i++;
    }
    return status;
}

/* Follows one pair between neighbouring doubles; where it cannot be followed, 1/eta_M must be far. */
static cv_status conclude_pair(dg_sweep *s, const alignment *g, size_t i)
{
    static const double NEAR = 0.01;
    const dg_crossing *a = &g->left->crossings[i], *b = &g->right->crossings[g->right_of[i]];
    const cv_status status = dg_branch_scan(s, g->left, a, g->right, b);
    if (status != CV_UNDECIDED)
        return status;
    const double least = fmin(a->x, b->x) * (1 - NEAR), most = fmax(a->x, b->x) * (1 + NEAR);
    for (size_t k = 0; k < s->mass_count; k++)
        if (s->masses[k].x > least && s->masses[k].x < most)
            dg_sweep_doubt(&s->masses[k], "a crossing that cannot be followed", g->left->at.alpha,
                           g->right->at.alpha);
    return CV_OK;
}

/* Between neighbouring doubles: what is paired is followed, what is not has folds; what that does not explain
 * is in doubt. */
static cv_status conclude(dg_sweep *s, const dg_curve *left, const dg_curve *right, const size_t *before)
{
    alignment g = {.left = left, .right = right};
    cv_status status = CV_OK;
    if (align(&g)) {
        const outlook one = from_left(&g), other = from_right(&g);
        for (size_t i = 0; i < left->crossing_count && status == CV_OK; i++)
            if (g.right_of[i] != NONE)
                status = conclude_pair(s, &g, i);
        if (status == CV_OK)
            status = add_folds(s, &one);
        if (status == CV_OK)
            status = add_folds(s, &other);
    }
    unexplained(s, left, right, before, 1);
    return status;
}

static cv_status search(dg_sweep *s, const dg_curve *left, const dg_curve *right, int depth)
{
    const int last = depth == 0 || right->at.alpha - left->at.alpha <= 8 * DBL_EPSILON * right->at.alpha;
    size_t *before = malloc(s->mass_count * sizeof *before);
    if (before == NULL)
        return cv_fail(s->why, CV_FAILED, "out of memory");
    for (size_t k = 0; k < s->mass_count; k++)
        before[k] = s->masses[k].count;
    cv_status status = attempt(s, left, right);
    if (status == CV_OK && unexplained(s, left, right, before, 0))
        status = CV_UNDECIDED;
    if (status == CV_UNDECIDED) {
        dg_sweep_forget(s, before);
        status = last ? conclude(s, left, right, before) : cut(s, left, right, depth);
    }
    free(before);
    return status;
}

cv_status dg_cell_search(dg_sweep *s, const dg_curve *left, const dg_curve *right)
{
    return search(s, left, right, MAX_DEPTH);
}
