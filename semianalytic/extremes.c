#include "semianalytic/extremes.h"

#include <float.h>
#include <math.h>

/* As in the header. */
static const long double TOLERANCE = 1e-14L, WEAK = 1e-4L;

/* Samples of the derivative in a side's shortest wave length / 2 pi; no side needs this many (decay length of
 * 1e4 wave lengths). */
enum { STEPS_PER_RADIAN = 5, MAX_STEPS = 2000000 };

typedef struct {
    const sa_undamped *s;
    int sign, ahead;
    long double scale; /* size of the deflection, which tolerances are relative to */
    sa_summit *best;
} search;

static int is_present(const sa_undamped_pole *pole, int ahead)
{
    return pole->kind != (ahead ? SA_WAVE_BEHIND : SA_WAVE_AHEAD);
}

/* Bound of |w| from here to infinity on one side. */
static long double bound(const search *t, long double distance)
{
    long double total = 0;

    for (int j = 0; j < t->s->count; j++) {
        const sa_undamped_pole *pole = &t->s->pole[j];
        if (is_present(pole, t->ahead)) {
            total += cabsl(pole->weight[0]) * expl(-cimagl(pole->p) * distance);
        }
    }
    return total;
}

/* Share of the bending that one exponential brings. */
static long double bend(const sa_undamped_pole *pole)
{
    return cabsl(pole->weight[0]) * cabsl(pole->p) * cabsl(pole->p);
}

/* Waves too weak to bend the rail to a maximum of their own are left out of the search for maxima; decaying
 * exponentials never are. */
static int is_searched(const search *t, const sa_undamped_pole *pole)
{
    long double total = 0;

    for (int j = 0; j < t->s->count; j++) {
        total += is_present(&t->s->pole[j], t->ahead) ? bend(&t->s->pole[j]) : 0;
    }
    return is_present(pole, t->ahead) && (pole->kind == SA_DECAYING || bend(pole) > WEAK * total);
}

/* The largest |p| among the exponentials that carry at least that share of the bending. */
static long double largest_wave_number(const search *t, long double share)
{
    long double total = 0, largest = 0;

    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < t->s->count; j++) {
            const sa_undamped_pole *pole = &t->s->pole[j];
            if (!is_searched(t, pole)) {
                continue;
            }
            if (pass == 0) {
                total += bend(pole);
            } else if (bend(pole) > share * total) {
                largest = fmaxl(largest, cabsl(pole->p));
            }
        }
    }
    return largest;
}

/* Newton on the derivative along the rail; 1 when it ends at a maximum of sign * w within "room" of the
 * start. */
static int climb(sa_summit *to, const search *t, long double distance, long double room)
{
    long double at = distance, v[4];

    for (int i = 0; i < 50; i++) {
        sa_undamped_at(v, t->s, 0, t->ahead, at);
        if (!(t->sign * v[2] < 0)) {
            return 0;
        }
        long double step = -v[1] / v[2];
        at += step;
        if (!(at >= 0 && fabsl(at - distance) <= room)) {
            return 0;
        }
        if (fabsl(step) <= 8 * LDBL_EPSILON * at) {
            break;
        }
    }
    sa_undamped_at(v, t->s, 0, t->ahead, at);
    *to = (sa_summit){t->sign * v[0], t->sign * v[3], t->ahead, at};
    return 1;
}

/* Samples of the derivative along one side, each exponential advanced by a multiplication. */
typedef struct {
    complex long double term[4], factor[4];
    int count;
} march;

static void march_start(march *m, const search *t, long double step)
{
    m->count = 0;
    for (int j = 0; j < t->s->count; j++) {
        const sa_undamped_pole *pole = &t->s->pole[j];
        complex long double ip = pole->p * (complex long double)_Complex_I;
        if (is_searched(t, pole)) {
            m->term[m->count] = ip * pole->weight[0];
            m->factor[m->count++] = cexpl(ip * step);
        }
    }
}

static long double march_next(march *m)
{
    long double value = 0;

    for (int j = 0; j < m->count; j++) {
        m->term[j] *= m->factor[j];
        value += creall(m->term[j]);
    }
    return value;
}

/* A maximum between two samples of the derivative of sign * w that go from + to -: bisection until Newton
 * works. */
static int climb_between(sa_summit *to, const search *t, long double low, long double high)
{
    for (int i = 0; i < 60; i++) {
        long double mid = low + (high - low) / 2, v[4];
        if (climb(to, t, mid, high - low)) {
            return 1;
        }
        sa_undamped_at(v, t->s, 0, t->ahead, mid);
        if (t->sign * v[1] > 0) {
            low = mid;
        } else {
            high = mid;
        }
    }
    return 0;
}

static void scan_side(const search *t)
{
    long double step = 1 / (STEPS_PER_RADIAN * largest_wave_number(t, TOLERANCE)), before;
    march m;
    sa_summit found;

    march_start(&m, t, step);
    before = 0;
    for (int i = 0; i < MAX_STEPS; i++) {
        if (i % 8 == 0 && !(bound(t, step * i) > t->best->value + TOLERANCE * t->scale)) {
            return;
        }
        long double here = t->sign * march_next(&m);
        if (before >= 0 && here < 0 && climb_between(&found, t, step * i, step * (i + 1)) &&
            found.value > t->best->value) {
            *t->best = found;
        }
        before = here;
    }
}

/* Far away on one side: the amplitudes add up. */
static sa_summit far_summit(const sa_undamped *s, int ahead)
{
    sa_summit far = {.ahead = ahead, .distance = INFINITY};

    for (int j = 0; j < s->count; j++) {
        const sa_undamped_pole *pole = &s->pole[j];
        if (pole->kind == (ahead ? SA_WAVE_AHEAD : SA_WAVE_BEHIND)) {
            long double amplitude = cimagl(pole->weight[0]);
            far.value += fabsl(amplitude);
            far.slope += amplitude < 0 ? -cimagl(pole->dweight[0]) : cimagl(pole->dweight[0]);
        }
    }
    return far;
}

void sa_summit_find(sa_summit *out, const sa_undamped *s, int sign)
{
    sa_summit ahead = far_summit(s, 1);
    long double v[4];

    *out = far_summit(s, 0);
    if (ahead.value > out->value) {
        *out = ahead;
    }
    sa_undamped_at(v, s, 0, 1, 0);
    if (sign * v[0] > out->value) {
        *out = (sa_summit){sign * v[0], sign * v[3], 1, 0};
    }
    for (int side = 0; side < 2; side++) {
        search t = {
            .s = s, .sign = sign, .ahead = side, .scale = fmaxl(fabsl(v[0]), out->value), .best = out};
        scan_side(&t);
    }
}

int sa_summit_follow(sa_summit *to, const sa_summit *from, const sa_undamped *s, int sign)
{
    if (isinf(from->distance)) {
        *to = far_summit(s, from->ahead);
        return 1;
    }
    search t = {.s = s, .sign = sign, .ahead = from->ahead, .scale = from->value};
    return climb(to, &t, from->distance, 1 / largest_wave_number(&t, 0.05L));
}
