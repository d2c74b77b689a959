#include "compare/curve_pick.h"

#include <math.h>
#include <stdlib.h>

#include "dgreen/sampler.h"

static const double APART = 1.5, AWAY = 1.2, BEYOND = 10;
enum { VELOCITIES = 400 }; /* at most, from the lowest on */

/* A crossing by its mass ratio, with the unstable roots of a little lighter and a little heavier masses. */
typedef struct {
    double eta_M;
    int direction, lighter, heavier;
} turn;

typedef struct {
    size_t count;
    turn *turns;
} turns;

static int by_mass(const void *a, const void *b)
{
    const turn *x = a, *y = b;
    return (x->eta_M > y->eta_M) - (x->eta_M < y->eta_M);
}

/* A mass without inertia is stable: the roots are counted from there. */
static cv_status find_turns(turns *t, const dg_curve *curve, cv_message *why)
{
    turn *more = realloc(t->turns, (curve->crossing_count + 1) * sizeof *more);
    if (more == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    t->turns = more;
    t->count = 0;
    for (size_t i = 0; i < curve->crossing_count; i++)
        if (isfinite(curve->crossings[i].x))
            t->turns[t->count++] =
                (turn){.eta_M = 1 / curve->crossings[i].x, .direction = curve->crossings[i].direction};
    qsort(t->turns, t->count, sizeof *t->turns, by_mass);
    int roots = 0;
    for (size_t i = 0; i < t->count; i++) {
        t->turns[i].lighter = roots;
        roots += 2 * t->turns[i].direction;
        t->turns[i].heavier = roots;
    }
    return CV_OK;
}

/* The factor to the next crossing on either side; the curve was sampled up to the mass ratio "heaviest". */
static double distance(const turns *t, size_t i, double heaviest)
{
    const double eta_M = t->turns[i].eta_M;
    const double below = i > 0 ? eta_M / t->turns[i - 1].eta_M : HUGE_VAL;
    const double above = (i + 1 < t->count ? t->turns[i + 1].eta_M : heaviest) / eta_M;
    return fmin(below, above);
}

/* To two digits, unless that goes astray. */
static double rounded(double x, double low, double high)
{
    const double unit = pow(10, floor(log10(x)) - 1), round = floor(x / unit + 0.5) * unit;
    return round > low && round < high ? round : x;
}

static void take(cmp_curve_pick *out, double alpha, double eta_M, double apart)
{
    const double away = fmin(AWAY, sqrt(apart));
    out->alpha = alpha;
    out->eta_M = eta_M;
    out->lighter = rounded(eta_M / away, eta_M / apart, eta_M);
    out->heavier = rounded(eta_M * away, eta_M, eta_M * apart);
}

typedef struct {
    double lightest, heaviest; /* mass ratios allowed */
    double fineness;           /* velocities to the unit */
    cmp_stable_side side;
    turns turns;
    double apart; /* of the best so far; 0: nothing found */
} search;

/* 1 when a crossing far from others has been found. */
static int look(cmp_curve_pick *out, search *s, double alpha)
{
    for (size_t i = 0; i < s->turns.count; i++) {
        const turn *t = &s->turns.turns[i];
        const int stable = s->side == CMP_STABLE_RIGHT ? t->lighter : t->heavier;
        const double apart = distance(&s->turns, i, BEYOND * s->heaviest);
        if (stable != 0 || t->lighter == t->heavier || t->eta_M < s->lightest || t->eta_M > s->heaviest)
            continue;
        if (s->apart == 0 || apart >= APART) {
            take(out, alpha, t->eta_M, apart);
            s->apart = apart;
        }
        if (s->apart >= APART)
            return 1;
    }
    return 0;
}

static cv_status look_at(cmp_curve_pick *out, search *s, dg_sampler *sampler, double alpha, cv_message *why)
{
    cv_status status = dg_sampler_curve(sampler, alpha, 1 / (BEYOND * s->heaviest), why);
    if (status == CV_UNDECIDED) /* another velocity will do */
        return CV_OK;
    if (status == CV_OK)
        status = find_turns(&s->turns, &sampler->curve, why);
    if (status == CV_OK)
        look(out, s, alpha);
    return status;
}

static cv_status look_through(cmp_curve_pick *out, search *s, const cv_casefile *file, double alpha,
                              cv_message *why)
{
    const double low = alpha > 0 ? alpha : cv_number_get_double(&file->alpha_min);
    const double high = alpha > 0 ? alpha : cv_number_get_double(&file->alpha_max);
    dg_sampler sampler;
    cv_status status = dg_sampler_init(&sampler, &out->params, low, high, why);
    if (status != CV_OK)
        return status;
    if (alpha > 0)
        status = look_at(out, s, &sampler, alpha, why);
    double k = ceil(low * s->fineness); /* k / 20, not k * 0.05: the double nearest to the decimal */
    for (int i = 0;
         alpha <= 0 && i < VELOCITIES && k / s->fineness <= high && s->apart < APART && status == CV_OK; i++)
        status = look_at(out, s, &sampler, k++ / s->fineness, why);
    dg_sampler_clear(&sampler);
    return status;
}

static void set_damping(cv_params *p, const cv_number *damping)
{
    cv_number_set(&p->eta_p, damping);
    cv_number_set(&p->eta_b, damping);
    cv_number_set(&p->eta_f, damping);
}

/* At every damping level until a crossing far from others is found. */
static cv_status look_at_levels(cmp_curve_pick *out, search *s, const cv_casefile *file, const cv_case *c,
                                const cv_number *damping, double alpha, cv_message *why)
{
    cv_status status = CV_OK;
    cv_params best;
    cv_params_init(&best);
    for (size_t l = 0; l < (damping != NULL ? 1 : c->level_count); l++) {
        const double before = s->apart;
        cv_case_params(&out->params, c, l);
        if (damping != NULL)
            set_damping(&out->params, damping);
        status = look_through(out, s, file, alpha, why);
        if (s->apart != before)
            cv_params_set(&best, &out->params);
        if (status != CV_OK || s->apart >= APART)
            break;
    }
    cv_params_set(&out->params, &best);
    cv_params_clear(&best);
    return status;
}

cv_status cmp_curve_pick_find(cmp_curve_pick *out, const cv_casefile *file, const cv_case *c,
                              const cv_number *damping, double alpha, cmp_stable_side side, cv_message *why)
{
    static const double finenesses[] = {20, 100};
    search s = {.lightest = HUGE_VAL, .side = side};
    cv_status status = CV_OK;
    for (size_t i = 0; i < c->mass_count; i++) {
        s.lightest = fmin(s.lightest, cv_number_get_double(&c->mass_ratios[i]));
        s.heaviest = fmax(s.heaviest, BEYOND * cv_number_get_double(&c->mass_ratios[i]));
    }
    for (int i = 0; i < 2 && status == CV_OK && s.apart == 0; i++) {
        s.fineness = finenesses[i];
        status = look_at_levels(out, &s, file, c, damping, alpha, why);
    }
    free(s.turns.turns);
    return status == CV_OK && s.apart == 0
               ? cv_fail(why, CV_UNDECIDED, "no crossing has its stable part to the %s",
                         side == CMP_STABLE_RIGHT ? "right" : "left")
               : status;
}
