#include "fastscan.h"

#include <tgmath.h>

enum { MAX_STEPS = 200000, REFINEMENTS = 80 };
static const double q_min = 2e-5, move_max = 0.12, move_good = 0.06, step_max = 0.03;
static const ref_real epsilon = sizeof(ref_real) > sizeof(double) ? (ref_real)1e-19L : (ref_real)1e-16L;

typedef struct {
    const ref_dtrack *t;
    ref_column *out;
    double re_min;
} scan;

/* zeta at q from the nearer of two neighbours, by linear interpolation of the roots; bisects its way where
 * that does not converge to the same roots. */
static int between(ref_state *out, const scan *s, const ref_state *a, const ref_state *b, ref_real q)
{
    ref_cx guess[REF_ROOTS];
    ref_real w = (q - a->q) / (b->q - a->q);
    for (int i = 0; i < REF_ROOTS; i++) {
        guess[i].re = a->p[i].re + w * (b->p[i].re - a->p[i].re);
        guess[i].im = a->p[i].im + w * (b->p[i].im - a->p[i].im);
    }
    return ref_fast_warm(out, s->t, a->alpha, q, guess);
}

static int keep(const scan *s, const ref_state *x, int fall)
{
    if (!(x->re > s->re_min))
        return 0;
    if (s->out->count == REF_ZEROS)
        return -1;
    s->out->zero[s->out->count++] = (ref_zero){x->q, x->re, fall};
    return 0;
}

/* The zero of Im zeta between two states of different sign: bisection with secant trials. */
static int refine(const scan *s, ref_state a, ref_state b)
{
    int fall = a.im > 0 ? 1 : -1;
    ref_state m = a;
    for (int i = 0; i < REFINEMENTS && b.q - a.q > 4 * epsilon * a.q; i++) {
        ref_real q = i % 3 == 2 ? 0.5 * (a.q + b.q) : a.q - a.im * (b.q - a.q) / (b.im - a.im);
        if (!(q > a.q && q < b.q))
            q = 0.5 * (a.q + b.q);
        if (!(q > a.q && q < b.q))
            break;
        if (between(&m, s, &a, &b, q) != 0)
            return -1;
        if ((m.im > 0) == (a.im > 0))
            a = m;
        else
            b = m;
    }
    return keep(s, &m, fall);
}

/* Three states of one sign, the middle one nearest to zero: looks for a sign change at the extremum. */
static int check_extremum(const scan *s, ref_state a, ref_state m, ref_state b)
{
    ref_real sign = a.im > 0 ? 1 : -1;
    ref_state left = a, right = b, x;
    for (int i = 0; i < 30 && b.q - a.q > 100 * epsilon * a.q; i++) {
        int upper_part = b.q - m.q > m.q - a.q;
        ref_real q = upper_part ? m.q + 0.38 * (b.q - m.q) : m.q - 0.38 * (m.q - a.q);
        if ((upper_part ? between(&x, s, &m, &b, q) : between(&x, s, &a, &m, q)) != 0)
            return -1;
        if (!(sign * x.im > 0)) {
            int status = refine(s, left, x);
            return status != 0 ? status : refine(s, x, right);
        }
        if (sign * x.im < sign * m.im) {
            *(upper_part ? &a : &b) = m;
            m = x;
        } else {
            *(upper_part ? &b : &a) = x;
        }
    }
    return 0;
}

/* The next state above "now", the step *h adapted to the movement of the roots. */
static int advance(ref_state *next, const scan *s, const ref_state *last, const ref_state *now, ref_real *h)
{
    for (int tries = 0; tries < 60; tries++) {
        ref_cx guess[REF_ROOTS];
        ref_real w = now->q > last->q ? *h / (now->q - last->q) : 0;
        for (int i = 0; i < REF_ROOTS; i++) {
            guess[i].re = now->p[i].re + w * (now->p[i].re - last->p[i].re);
            guess[i].im = now->p[i].im + w * (now->p[i].im - last->p[i].im);
        }
        if (ref_fast_warm(next, s->t, now->alpha, now->q + *h, guess) == 0) {
            ref_real moved = ref_fast_movement(now, next);
            if (moved <= move_max) {
                if (moved < move_good)
                    *h = fmin(*h * fmin(2, move_good / (moved + 0.01)), step_max * next->q);
                return 0;
            }
        }
        *h *= 0.5;
        if (now->q + *h <= now->q)
            return -1;
    }
    return -1;
}

static int step_through(const scan *s, ref_state now, ref_real q_max)
{
    ref_state last = now, next;
    ref_real h = 0.01 * now.q;
    int status = 0;
    for (s->out->steps = 0; status == 0 && now.q < q_max; s->out->steps++) {
        if (s->out->steps == MAX_STEPS || advance(&next, s, &last, &now, &h) != 0)
            return -1;
        if ((next.im > 0) != (now.im > 0))
            status = refine(s, now, next);
        else if (last.q < now.q && (last.im > 0) == (now.im > 0) && fabs(now.im) < fabs(last.im) &&
                 fabs(now.im) <= fabs(next.im))
            status = check_extremum(s, last, now, next);
        last = now;
        now = next;
    }
    return status != 0 || now.re > 0 ? -1 : 0;
}

int ref_scan(ref_column *out, const ref_dtrack *t, ref_real alpha, double re_min)
{
    const double *c = t->value;
    scan s = {t, out, re_min};
    ref_state first;
    double beam = sqrt(c[REF_KAPPA_P]) + sqrt((c[REF_KAPPA_P] + c[REF_KAPPA_B]) / c[REF_MU_S]);
    out->alpha = alpha;
    out->count = 0;
    out->steps = 0;
    if (ref_fast_cold(&first, t, alpha, q_min) != 0)
        return -1;
    return step_through(&s, first, 4 * (beam + alpha * alpha + fabs(c[REF_ETA_N]) + 3));
}

int ref_scan_unstable(const ref_column *c, double eta_M)
{
    int n = 0;
    for (int i = 0; i < c->count; i++)
        if (c->zero[i].re * eta_M > 1)
            n += 2 * c->zero[i].fall;
    return n;
}
