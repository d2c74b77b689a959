#include "compare/lines_sample.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { MASSES = 20, LINES_MAX = 256 };

/* 64 bits with a full period, good in every bit (Steele, Lea & Flood 2014). */
static uint64_t next_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* 0 <= u < 1 */
static double uniform(uint64_t *state)
{
    return (double)(next_random(state) >> 11) * 0x1p-53;
}

static size_t below(uint64_t *state, size_t count)
{
    return (size_t)(uniform(state) * (double)count);
}

/* +-10^-1 .. 10^-10 */
static double offset(uint64_t *state)
{
    const double size = pow(10, -1 - 9 * uniform(state));
    return next_random(state) & 1u ? size : -size;
}

typedef struct {
    const cmp_branches *lists;
    const cmp_line_method *const *methods;
    void *const *handles;
    uint64_t state;
    double alpha;
    size_t count; /* of the mass ratios of one velocity */
    double mass[MASSES];
    int roots[CMP_METHODS][MASSES];
    cv_status decided[CMP_METHODS][MASSES];
    cmp_line_samples *out;
} sampler;

static double value(mpfr_srcptr x)
{
    return mpfr_get_d(x, MPFR_RNDN);
}

static double random_mass(sampler *s)
{
    const cmp_branches *in = &s->lists[0];
    return in->mass_min * pow(in->mass_max / in->mass_min, uniform(&s->state));
}

/* A velocity on, between or next to vertices of one of the branches of both methods. */
static double velocity_near(sampler *s)
{
    const cmp_branches *in = s->lists;
    const size_t n = below(&s->state, in[0].count + in[1].count);
    const cmp_branch *b = n < in[0].count ? &in[0].branches[n] : &in[1].branches[n - in[0].count];
    if (b->count < 2)
        return in->alpha_min + uniform(&s->state) * (in->alpha_max - in->alpha_min);
    const size_t i = below(&s->state, b->count - 1);
    const double first = value(b->vertices[i].alpha), second = value(b->vertices[i + 1].alpha);
    switch (below(&s->state, 3)) {
    case 0:
        return first;
    case 1:
        return first + uniform(&s->state) * (second - first);
    default:
        return first * (1 + offset(&s->state));
    }
}

/* Mass ratios at which the polylines of a list pass the velocity; returns how many. */
static size_t passages(double *mass, const cmp_branches *list, double alpha)
{
    size_t n = 0;
    for (size_t i = 0; i < list->count; i++)
        for (size_t k = 0; k + 1 < list->branches[i].count && n < LINES_MAX; k++) {
            const cmp_line_point *v = &list->branches[i].vertices[k];
            const double a = value(v[0].alpha), b = value(v[1].alpha);
            if ((a <= alpha) == (b <= alpha))
                continue;
            const double part = (alpha - a) / (b - a);
            mass[n] = value(v[0].eta_M) * pow(value(v[1].eta_M) / value(v[0].eta_M), part);
            n += isfinite(mass[n]) != 0; /* an undecided vertex may have no mass */
        }
    return n;
}

static int ascending(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

/* Off the line at "mass", inside the range. */
static double beside(sampler *s, double mass)
{
    const cmp_branches *in = &s->lists[0];
    const double by = offset(&s->state), there = mass * (1 + by);
    return there >= in->mass_min && there <= in->mass_max ? there : mass * (1 - by);
}

static void draw_masses_near(sampler *s)
{
    double mass[LINES_MAX];
    const size_t n = passages(mass, &s->lists[next_random(&s->state) & 1u], s->alpha);
    qsort(mass, n, sizeof *mass, ascending);
    for (size_t i = 0; i < s->count; i++) {
        const size_t k = n > 0 ? below(&s->state, n) : 0;
        if (n == 0)
            s->mass[i] = random_mass(s);
        else if (k + 1 < n && next_random(&s->state) & 1u)
            s->mass[i] = sqrt(mass[k] * mass[k + 1]);
        else
            s->mass[i] = beside(s, mass[k]);
    }
}

static double inside(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

static void draw(sampler *s, int near)
{
    const cmp_branches *in = &s->lists[0];
    near = near && s->lists[0].count + s->lists[1].count > 0;
    s->alpha = near ? velocity_near(s) : in->alpha_min + uniform(&s->state) * (in->alpha_max - in->alpha_min);
    s->alpha = inside(s->alpha, in->alpha_min, in->alpha_max);
    if (near)
        draw_masses_near(s);
    else
        for (size_t i = 0; i < s->count; i++)
            s->mass[i] = random_mass(s);
    for (size_t i = 0; i < s->count; i++)
        s->mass[i] = inside(s->mass[i], in->mass_min, in->mass_max);
    s->out->near_lines += near ? s->count : 0;
}

static void judge_point(sampler *s, size_t i)
{
    cmp_line_samples *out = s->out;
    int decided = 1;
    for (int m = 0; m < CMP_METHODS; m++) {
        out->undecided[m] += s->decided[m][i] != CV_OK;
        decided = decided && s->decided[m][i] == CV_OK;
    }
    out->points++;
    out->undecided_points += !decided;
    if (!decided || s->roots[0][i] == s->roots[1][i])
        return;
    if (out->mismatches < CMP_MISMATCHES_KEPT)
        out->kept[out->mismatches] = (cmp_mismatch){s->alpha, s->mass[i], {s->roots[0][i], s->roots[1][i]}};
    out->mismatches++;
    cmp_verdict_worsen(&out->verdict, CMP_DISAGREE,
                       "at alpha = %.17g, eta_M = %.17g %s counts %d unstable roots, %s %d", s->alpha,
                       s->mass[i], s->methods[0]->name, s->roots[0][i], s->methods[1]->name, s->roots[1][i]);
}

static cv_status sample_velocity(sampler *s, int near, cv_message *why)
{
    cv_status status = CV_OK;
    draw(s, near);
    for (int m = 0; m < CMP_METHODS && status == CV_OK; m++)
        status =
            s->methods[m]->count(s->handles[m], s->roots[m], s->decided[m], s->alpha, s->count, s->mass, why);
    for (size_t i = 0; i < s->count && status == CV_OK; i++)
        judge_point(s, i);
    return status;
}

cv_status cmp_lines_sample(cmp_line_samples *out, const cmp_branches lists[CMP_METHODS],
                           const cmp_line_method *const methods[CMP_METHODS],
                           void *const handles[CMP_METHODS], size_t points, unsigned long seed,
                           cv_message *why)
{
    sampler s = {.lists = lists, .methods = methods, .handles = handles, .state = seed, .out = out};
    cv_status status = CV_OK;
    *out = (cmp_line_samples){0};
    cmp_verdict_init(&out->verdict);
    for (int near = 0; status == CV_OK && out->points < points; near = !near) {
        s.count = points - out->points < MASSES ? points - out->points : MASSES;
        status = sample_velocity(&s, near, why);
    }
    if (status == CV_OK && 100 * out->undecided_points > out->points)
        cmp_verdict_worsen(&out->verdict, CMP_UNDECIDED,
                           "at %zu of %zu points unstable roots cannot be counted", out->undecided_points,
                           out->points);
    return status;
}
