#include "fastroots.h"

#include <string.h>
#include <tgmath.h>

enum { COLD_ITERATIONS = 400, WARM_ITERATIONS = 25 };

static ref_cx add(ref_cx x, ref_cx y)
{
    return (ref_cx){x.re + y.re, x.im + y.im};
}

static ref_cx sub(ref_cx x, ref_cx y)
{
    return (ref_cx){x.re - y.re, x.im - y.im};
}

static ref_cx mul(ref_cx x, ref_cx y)
{
    return (ref_cx){x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
}

static ref_cx scale(ref_real c, ref_cx x)
{
    return (ref_cx){c * x.re, c * x.im};
}

static ref_real norm(ref_cx x)
{
    return x.re * x.re + x.im * x.im;
}

static ref_cx divide(ref_cx x, ref_cx y)
{
    ref_real r = 1 / norm(y);
    return (ref_cx){(x.re * y.re + x.im * y.im) * r, (x.im * y.re - x.re * y.im) * r};
}

/* c + 2 damping s */
static ref_cx spring(ref_real c, ref_real damping, ref_cx s)
{
    return (ref_cx){c + 2 * damping * s.re, 2 * damping * s.im};
}

/* mu_b s^2 + eta_s p^2. Where its leading coefficient nearly vanishes, one root p is huge and the two terms
 * cancel there: then by powers of p. */
static ref_cx shear(const ref_state *x, const double *c, ref_cx p, ref_cx p2, ref_cx s2)
{
    ref_real lead = c[REF_ETA_S] - c[REF_MU_B] * x->alpha * x->alpha;
    if (!(fabs(lead) < 1e-3 * c[REF_ETA_S]))
        return add(scale(c[REF_MU_B], s2), scale(c[REF_ETA_S], p2));
    ref_cx linear = scale(2 * c[REF_MU_B] * x->q * x->alpha, p);
    return add(add(scale(lead, p2), linear), (ref_cx){-c[REF_MU_B] * x->q * x->q, 0});
}

/* d3, its derivative by p, and d2 at p. Written so that no two terms of the coefficients of s cancel: small
 * real or imaginary parts keep their own relative accuracy. */
static void evaluate(ref_cx *f, ref_cx *fp, ref_cx *minor, const ref_state *x, const ref_dtrack *t, ref_cx p)
{
    const double *c = t->value;
    ref_cx s = {x->alpha * p.im, x->q - x->alpha * p.re}, sp = {0, -x->alpha};
    ref_cx s2 = mul(s, s), s2p = scale(2, mul(s, sp)), p2 = mul(p, p);
    ref_cx d1 = add(sub(scale(0.25, mul(p2, p2)), scale(c[REF_ETA_N], p2)), s2);
    ref_cx d1p = add(mul(p, sub(p2, (ref_cx){2 * c[REF_ETA_N], 0})), s2p);
    ref_cx d2 = spring(c[REF_KAPPA_P], c[REF_ETA_P], s), d2p = scale(2 * c[REF_ETA_P], sp);
    ref_cx d3 = scale(c[REF_MU_S], s2), d3p = scale(c[REF_MU_S], s2p);
    ref_cx d4 = spring(c[REF_KAPPA_B], c[REF_ETA_B], s), d4p = scale(2 * c[REF_ETA_B], sp);
    ref_cx e = shear(x, c, p, p2, s2), ep = add(scale(c[REF_MU_B], s2p), scale(2 * c[REF_ETA_S], p));
    e = add(e, spring(1, c[REF_ETA_F], s));
    ep = add(ep, scale(2 * c[REF_ETA_F], sp));
    ref_cx sum = add(d4, e), sump = add(d4p, ep);
    ref_cx g = add(mul(d3, sum), mul(d4, e));
    ref_cx gp = add(add(mul(d3p, sum), mul(d3, sump)), add(mul(d4p, e), mul(d4, ep)));
    ref_cx m = add(mul(d2, sum), g), mp = add(add(mul(d2p, sum), mul(d2, sump)), gp);
    *minor = m;
    *f = add(mul(d1, m), mul(d2, g));
    *fp = add(add(mul(d1p, m), mul(d1, mp)), add(mul(d2p, g), mul(d2, gp)));
}

static void set_gaps(ref_state *x)
{
    for (int i = 0; i < REF_ROOTS; i++)
        x->gap[i] = INFINITY;
    for (int i = 0; i < REF_ROOTS; i++) {
        for (int j = 0; j < i; j++) {
            ref_real d = norm(sub(x->p[i], x->p[j]));
            x->gap[i] = fmin(x->gap[i], d);
            x->gap[j] = fmin(x->gap[j], d);
        }
    }
    for (int i = 0; i < REF_ROOTS; i++)
        x->gap[i] = sqrt(x->gap[i]);
}

/* One simultaneous step of all roots (Ehrlich-Aberth); returns the largest |step| / gap. */
static ref_real aberth_step(ref_state *x, const ref_dtrack *t)
{
    ref_real largest = 0;
    set_gaps(x);
    for (int i = 0; i < REF_ROOTS; i++) {
        ref_cx f, fp, minor, repulsion = {0, 0};
        evaluate(&f, &fp, &minor, x, t, x->p[i]);
        for (int j = 0; j < REF_ROOTS; j++)
            if (j != i)
                repulsion = add(repulsion, divide((ref_cx){1, 0}, sub(x->p[i], x->p[j])));
        ref_cx step = divide(f, sub(fp, mul(f, repulsion)));
        x->p[i] = sub(x->p[i], step);
        ref_real moved = sqrt(norm(step)) / x->gap[i];
        largest = moved <= largest ? largest : moved; /* NaN is kept */
    }
    return largest;
}

/* A last Newton step of each root, so that tiny imaginary parts are right by themselves, and zeta. The sum
 * over the upper roots is taken as half the difference to the sum over the lower ones where that matters:
 * all residues together give 0. */
static int finish(ref_state *x, const ref_dtrack *t)
{
    ref_cx up = {0, 0}, down = {0, 0}, f, fp, minor;
    x->upper = 0;
    for (int i = 0; i < REF_ROOTS; i++) {
        evaluate(&f, &fp, &minor, x, t, x->p[i]);
        x->p[i] = sub(x->p[i], divide(f, fp));
        evaluate(&f, &fp, &minor, x, t, x->p[i]);
        ref_cx rho = divide(minor, fp);
        if (x->p[i].im > 0)
            up = add(up, rho);
        else
            down = add(down, rho);
        x->upper += x->p[i].im > 0;
    }
    set_gaps(x);
    x->re = -x->q * x->q * up.im;
    x->im = x->q * x->q * 0.5 * (up.re - down.re);
    return x->upper >= 1 && x->upper <= 4 && isfinite(x->re) && isfinite(x->im) ? 0 : -1;
}

/* Until the steps are small beside the gaps, or rounding keeps them from getting smaller. */
static int iterate(ref_state *x, const ref_dtrack *t, int limit)
{
    ref_real before = INFINITY;
    for (int i = 0; i < limit; i++) {
        ref_real moved = aberth_step(x, t);
        if (moved < 1e-5 || (i >= 6 && moved < 0.03 && moved > 0.5 * before))
            return finish(x, t);
        if (!(moved < 1e300))
            return -1;
        before = moved;
    }
    return -1;
}

int ref_fast_cold(ref_state *out, const ref_dtrack *t, ref_real alpha, ref_real q)
{
    static const ref_real radii[REF_ROOTS] = {1, 1, 2, 2, 4, 4, 8, 8};
    out->alpha = alpha;
    out->q = q;
    for (int i = 0; i < REF_ROOTS; i++) {
        ref_real angle = 0.4 + 0.7853981633974483 * i;
        out->p[i] = (ref_cx){radii[i] * cos(angle), radii[i] * sin(angle)};
    }
    return iterate(out, t, COLD_ITERATIONS);
}

int ref_fast_warm(ref_state *out, const ref_dtrack *t, ref_real alpha, ref_real q,
                  const ref_cx guess[REF_ROOTS])
{
    out->alpha = alpha;
    out->q = q;
    memmove(out->p, guess, sizeof out->p);
    return iterate(out, t, WARM_ITERATIONS);
}

ref_real ref_fast_movement(const ref_state *from, const ref_state *to)
{
    ref_real largest = 0;
    for (int i = 0; i < REF_ROOTS; i++) {
        ref_real d = sqrt(norm(sub(to->p[i], from->p[i]))) / fmin(from->gap[i], to->gap[i]);
        largest = d <= largest ? largest : d;
    }
    return largest;
}
