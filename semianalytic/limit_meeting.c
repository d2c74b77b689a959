#include "semianalytic/limit_meeting.h"

#include <math.h>

#include "semianalytic/map_build.h"
#include "semianalytic/poles.h"

/* One of the curves at the meeting, at q >= 0. */
typedef struct {
    int arc, doppler, sigma; /* S and sigma of the header */
    double p, slope;         /* of the double pole; dq/dalpha */
    double square, strength; /* A^2 and A^2 / e but for a factor that all curves have */
} meeting_curve;

static cv_status set_curve(meeting_curve *c, const sa_map *map, size_t arc, double alpha)
{
    const sa_branch_arc *a = &map->curves.arc[arc];
    sa_wave wave;
    double damping;
    long double q, at = fminl(fmaxl(alpha, a->alpha_low), a->alpha_high);
    if (sa_branch_arc_at(&wave, &q, &map->curves, arc, at) != CV_OK)
        return CV_FAILED;
    c->arc = (int)arc;
    c->doppler = q < 0 ? -1 : 1;
    c->sigma = wave.d[2] > 0 ? c->doppler : -c->doppler;
    c->p = c->slope = (double)(-c->doppler * a->direction * wave.p);
    c->square = sa_map_strength(&damping, map, &wave);
    c->strength = c->square / damping;
    return CV_OK;
}

/* The arc of branch k that passes |p| at alpha, other than "not"; -1: none */
static int arc_at(const sa_map *map, int k, double p, double alpha, int not )
{
    const double near = 1e-6;
    double nearest = near;
    int found = -1;
    for (size_t i = 0; i < map->curves.arc_count; ++i) {
        const sa_branch_arc *a = &map->curves.arc[i];
        const long double slack = 1e-14L * alpha;
        sa_wave wave;
        long double q;
        if (a->k != k || (int)i == not || !(alpha >= a->alpha_low - slack && alpha <= a->alpha_high + slack))
            continue;
        if (sa_branch_arc_at(&wave, &q, &map->curves, i, fminl(fmaxl(alpha, a->alpha_low), a->alpha_high)) !=
            CV_OK)
            continue;
        double distance = fabs((double)wave.p - p) / p;
        if (distance < nearest) {
            nearest = distance;
            found = (int)i;
        }
    }
    return found;
}

/* Takes the pole nearest to p out of the list. */
static void drop(double complex *pole, int *count, double p)
{
    int nearest = 0;
    for (int i = 1; i < *count; ++i)
        if (cabs(pole[i] - p) < cabs(pole[nearest] - p))
            nearest = i;
    pole[nearest] = pole[--*count];
}

/* B at the meeting: the poles that are simple there (zeta_limit.c). The two at a branch point have opposite
 * residues but for terms of the order of their distance. */
static cv_status regular_part(double *re, double *im, double *im_size, const sa_track *t,
                              const meeting_curve curve[2], double alpha, double q)
{
    const double noise = 0x1p-26;
    double complex pole[SA_POLES_MAX];
    int count;
    *re = *im = *im_size = 0;
    if (sa_poles_cold(pole, &count, t, alpha, q) != CV_OK || count < 4)
        return CV_FAILED;
    for (int i = 0; i < 4; ++i)
        drop(pole, &count, curve[i / 2].p);
    for (int i = 0; i < count; ++i) {
        sa_point m;
        int real = fabs(cimag(pole[i])) <= noise * cabs(pole[i]);
        double complex p = real ? creal(pole[i]) : pole[i];
        if (!sa_poles_newton(&p, &m, t, alpha, q))
            return CV_UNDECIDED;
        double complex residue = m.w[SA_RAIL] / m.det_p;
        double term = q * q * (real ? cabs(residue) / 2 : -cimag(residue));
        if (!real && cimag(p) > 0)
            *re += term;
        if (real)
            *im -= q - alpha * creal(p) > 0 ? term : -term;
        if (real)
            *im_size += term;
    }
    return CV_OK;
}

static sa_terminal at_infinity(void)
{
    return (sa_terminal){.kind = SA_TERMINAL_INFINITE, .arc = -1};
}

/* Half of a curve: within the waves of the other (1) or outside (0). */
static sa_terminal on_curve(const meeting_curve *c, const meeting_curve *other, int within)
{
    int side = other->sigma * (c->slope - other->slope) > 0 ? 1 : -1;
    if (c->sigma * c->doppler < 0)
        return at_infinity();
    return (sa_terminal){SA_TERMINAL_CURVE, c->arc, within ? side : -side, INFINITY};
}

static void add(sa_meeting *m, sa_terminal a, sa_terminal b, int side)
{
    if (a.kind != SA_TERMINAL_INFINITE || b.kind != SA_TERMINAL_INFINITE)
        m->bridge[m->count++] = (sa_bridge){{a, b}, side};
}

/* Side of the special velocity on which X_1 : X_2 = A_1^2 : A_2^2 with both positive. */
static int side_of_waves(const meeting_curve *a, const meeting_curve *b)
{
    double along = a->sigma * a->square - b->sigma * b->square;
    return (along > 0) == (b->slope > a->slope) ? 1 : -1;
}

static cv_status opposite(sa_meeting *m, const meeting_curve curve[2], double re, int im_sign)
{
    const double equal = 1e-9;
    const meeting_curve *strong = &curve[curve[1].strength > curve[0].strength],
                        *weak = strong == &curve[0] ? &curve[1] : &curve[0];
    const meeting_curve *outer = strong->doppler == im_sign ? strong : weak,
                        *inner = outer == strong ? weak : strong;
    if (!(fabs(strong->strength - weak->strength) > equal * strong->strength))
        return CV_UNDECIDED;
    sa_terminal line = {SA_TERMINAL_LINE, -1, 0, re};
    int side = side_of_waves(strong, weak);
    add(m, re > 0 ? line : at_infinity(), on_curve(weak, strong, 1), side);
    add(m, on_curve(strong, weak, 1), on_curve(outer, inner, 0), -side);
    return CV_OK;
}

static cv_status crossing(sa_meeting *m, const sa_track *track, const meeting_curve curve[2])
{
    const double certain = 1e-10;
    double re, im, im_size;
    cv_status status = regular_part(&re, &im, &im_size, track, curve, m->alpha, m->q);
    if (status != CV_OK)
        return status;
    if (!(fabs(im) > certain * im_size))
        return CV_UNDECIDED;
    int im_sign = im > 0 ? 1 : -1;
    if (curve[0].doppler != curve[1].doppler)
        return opposite(m, curve, re, im_sign);
    if (im_sign == curve[0].doppler)
        add(m, on_curve(&curve[0], &curve[1], 0), on_curve(&curve[1], &curve[0], 0), 0);
    return CV_OK;
}

/* The sign of Im zeta below the curve beside a resonance velocity, where its own waves are not. */
static cv_status sign_below(int *sign, const sa_track *track, double alpha, double p)
{
    const double beside = 1e-6, part = 0.1;
    sa_value v;
    sa_sweep *sweep = sa_sweep_new();
    if (sweep == NULL)
        return CV_FAILED;
    cv_status status =
        sa_zeta_adaptive(&v, sweep, track, alpha * (1 - beside), part * fabs(p) * alpha * beside, part);
    sa_sweep_free(sweep);
    *sign = status == CV_OK && v.im > 0 ? 1 : -1;
    return status;
}

static cv_status resonance(sa_meeting *m, const sa_map *map, const sa_track *track, const meeting_curve *c)
{
    int sign;
    sa_terminal above = {SA_TERMINAL_CURVE, c->arc, 1, INFINITY},
                below = {SA_TERMINAL_CURVE, c->arc, -1, INFINITY};
    if (c->sigma * c->doppler < 0)
        return CV_OK;
    add(m, at_infinity(), above, 1);
    if (!(m->alpha > map->curves.alpha_min))
        return CV_OK;
    cv_status status = sign_below(&sign, track, m->alpha, c->p);
    if (status == CV_OK && sign > 0)
        add(m, below, at_infinity(), -1);
    return status;
}

cv_status sa_meeting_find(sa_meeting *out, const sa_map *map, const sa_track *track, size_t number)
{
    const sa_special *s = &map->curves.special[number];
    meeting_curve curve[2];
    *out = (sa_meeting){.alpha = s->alpha, .q = s->q, .arc = {-1, -1}};
    if (s->kind == SA_SPECIAL_CUSP || s->kind == SA_SPECIAL_SHEAR)
        return CV_OK;
    out->arc[0] = arc_at(map, s->k, s->p, s->alpha, -1);
    if (out->arc[0] < 0 || set_curve(&curve[0], map, (size_t)out->arc[0], s->alpha) != CV_OK)
        return CV_FAILED;
    if (s->kind == SA_SPECIAL_RESONANCE)
        return resonance(out, map, track, &curve[0]);
    out->arc[1] = arc_at(map, s->l, s->p_l, s->alpha, out->arc[0]);
    if (out->arc[1] < 0 || set_curve(&curve[1], map, (size_t)out->arc[1], s->alpha) != CV_OK)
        return CV_FAILED;
    return crossing(out, track, curve);
}
