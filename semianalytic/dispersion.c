/* Method: K - L M (L = omega^2) is a chain of springs and masses. It is eliminated from the ballast upwards
 * and from the rail downwards with dynamic stiffnesses, so that no large stiffness is ever subtracted from
 * another: each rounding is a relative perturbation of one mass or one spring, and L is relatively well
 * conditioned in those. The two eliminations meet at the component where the remaining stiffness is smallest
 * (the twisted factorisation of Parlett and Dhillon, Linear Algebra Appl. 267 (1997) 247-279), which gives
 * every component of the eigenvector relatively accurate, also those that are 1e-9 of the others. Derivatives
 * follow from the perturbation series of the eigenpair, solved with the same factors. */
#include "semianalytic/dispersion.h"

#include <float.h>
#include <math.h>

/* Dynamic stiffnesses of the chain at (p, L); "low" eliminated upwards, "top" downwards. */
typedef struct {
    long double rail;     /* p^4/4 - eta_N p^2 - L */
    long double ground;   /* 1 + eta_s p^2 - mu_b L */
    long double low2;     /* sleeper and all below it */
    long double top1;     /* rail seen through the pads */
    long double top2;     /* the same with the sleeper */
    long double pad_low;  /* kappa_p + low2, a pivot */
    long double bed_low;  /* kappa_b + ground, a pivot */
    long double pad_top;  /* kappa_p + rail, a pivot */
    long double bed_top;  /* kappa_b + top2, a pivot */
    long double twist[3]; /* what remains of equation i when the two others are eliminated */
} chain;

/* Eigenvector with v[at] = 1, and the stretch of the two springs above and below the sleeper. */
typedef struct {
    int at;
    long double v[3];
    long double pad;  /* v[0] - v[1] */
    long double bed;  /* v[1] - v[2] */
    long double mass; /* v' M v */
} mode;

void sa_dispersion_set(sa_dispersion *out, const cv_params *params)
{
    const cv_number *from[6] = {&params->mu_s,    &params->mu_b,  &params->kappa_p,
                                &params->kappa_b, &params->eta_s, &params->eta_N};
    long double *to[6] = {&out->mu_s, &out->mu_b, &out->kappa_p, &out->kappa_b, &out->eta_s, &out->eta_N};
    mpfr_t x;

    mpfr_init2(x, LDBL_MANT_DIG);
    for (int i = 0; i < 6; i++) {
        cv_number_get_mpfr(x, from[i]);
        *to[i] = mpfr_get_ld(x, MPFR_RNDN);
    }
    mpfr_clear(x);
}

/* A pivot of exactly zero is a rounding accident; the smallest change of sign-definite size mends it. */
static long double pivot(long double sum, long double stiffness)
{
    return sum == 0 ? LDBL_EPSILON * LDBL_EPSILON * stiffness : sum;
}

static void chain_set(chain *c, const sa_dispersion *d, long double p, long double L)
{
    long double x = p * p;

    c->rail = x * (x / 4 - d->eta_N) - L;
    c->ground = (1 + d->eta_s * x) - d->mu_b * L;
    c->bed_low = pivot(d->kappa_b + c->ground, d->kappa_b);
    long double bed = d->kappa_b / c->bed_low * c->ground;
    c->low2 = bed - d->mu_s * L;
    c->pad_low = pivot(d->kappa_p + c->low2, d->kappa_p);
    c->pad_top = pivot(d->kappa_p + c->rail, d->kappa_p);
    c->top1 = d->kappa_p / c->pad_top * c->rail;
    c->top2 = c->top1 - d->mu_s * L;
    c->bed_top = pivot(d->kappa_b + c->top2, d->kappa_b);
    c->twist[0] = c->rail + d->kappa_p / c->pad_low * c->low2;
    c->twist[1] = c->top2 + bed;
    c->twist[2] = c->ground + d->kappa_b / c->bed_top * c->top2;
}

/* Negative pivots of the upward elimination = eigenvalues below L (Sylvester). */
static int chain_count(const chain *c)
{
    return (c->bed_low < 0) + (c->pad_low < 0) + (c->twist[0] < 0);
}

int sa_dispersion_count(const sa_dispersion *d, long double p, long double square)
{
    chain c;

    chain_set(&c, d, p, square);
    return chain_count(&c);
}

static int smallest_twist(const chain *c, const sa_dispersion *d)
{
    long double size[3] = {fabsl(c->twist[0]), fabsl(c->twist[1]) / d->mu_s, fabsl(c->twist[2]) / d->mu_b};
    int at = size[1] < size[0] ? 1 : 0;

    return size[2] < size[at] ? 2 : at;
}

static void mode_set(mode *m, const chain *c, const sa_dispersion *d)
{
    m->at = smallest_twist(c, d);
    m->v[m->at] = 1;
    if (m->at == 2) {
        m->v[1] = d->kappa_b / c->bed_top;
        m->bed = -c->top2 / c->bed_top;
    }
    if (m->at != 0) {
        m->v[0] = d->kappa_p / c->pad_top * m->v[1];
        m->pad = -c->rail / c->pad_top * m->v[1];
    } else {
        m->v[1] = d->kappa_p / c->pad_low;
        m->pad = c->low2 / c->pad_low;
    }
    if (m->at != 2) {
        m->v[2] = d->kappa_b / c->bed_low * m->v[1];
        m->bed = c->ground / c->bed_low * m->v[1];
    }
    m->mass = m->v[0] * m->v[0] + d->mu_s * m->v[1] * m->v[1] + d->mu_b * m->v[2] * m->v[2];
}

/* Eigenvalue k, and no other, lies within 64 units in the last place of L. */
static int is_eigenvalue(const sa_dispersion *d, int k, long double p, long double L)
{
    return sa_dispersion_count(d, p, L * (1 - 64 * LDBL_EPSILON)) == k &&
           sa_dispersion_count(d, p, L * (1 + 64 * LDBL_EPSILON)) == k + 1;
}

/* Rayleigh quotient iteration inside a bracket that holds eigenvalue k, bisection where it leaves the bracket
 * or where other eigenvalues are still inside; what it converges to is believed only after the counts. */
static int find_square(long double *square, const sa_dispersion *d, int k, long double p, long double guess)
{
    long double low = 0, x = p * p;
    long double high = 2 * (fabsl(x * (x / 4 - d->eta_N)) + d->kappa_p + (d->kappa_p + d->kappa_b) / d->mu_s +
                            (d->kappa_b + 1 + d->eta_s * x) / d->mu_b);
    int warm = guess > 0 && guess < high;
    long double L = warm ? guess : high / 2;
    int below = 0, above = SA_BRANCHES;

    for (int i = 0; i < 400; i++) {
        chain c;
        mode m;

        chain_set(&c, d, p, L);
        int count = chain_count(&c);
        if (count <= k) {
            low = L;
            below = count;
        } else {
            high = L;
            above = count;
        }
        mode_set(&m, &c, d);
        long double next = L + c.twist[m.at] / m.mass;
        int alone = (below == k && above == k + 1) || (warm && i < 4);
        if (alone && fabsl(next - L) <= 8 * LDBL_EPSILON * L && is_eigenvalue(d, k, p, next)) {
            *square = next;
            return 1;
        }
        if (high - low <= 2 * LDBL_EPSILON * high) {
            *square = L;
            return below == k && above == k + 1;
        }
        if (alone && next > low && next < high) {
            L = next;
        } else {
            L = low > 0 ? sqrtl(low) * sqrtl(high) : high / 1024;
        }
    }
    return 0;
}

/* Solves (K - L M) u = -f for u with u[at] = 0; the equation at "at" holds because f is orthogonal to v. */
static void solve(long double u[3], const long double f[3], const chain *c, const sa_dispersion *d, int at)
{
    long double g[3] = {-f[0], -f[1], -f[2]};

    u[at] = 0;
    switch (at) {
    case 0:
        u[1] = (g[1] + d->kappa_b * g[2] / c->bed_low) / c->pad_low;
        u[2] = (g[2] + d->kappa_b * u[1]) / c->bed_low;
        break;
    case 1:
        u[0] = g[0] / c->pad_top;
        u[2] = g[2] / c->bed_low;
        break;
    default:
        u[1] = (g[1] + d->kappa_p * g[0] / c->pad_top) / c->bed_top;
        u[0] = (g[0] + d->kappa_p * u[1]) / c->pad_top;
    }
}

/* Coefficients L[1..3] of L(p + h) = sum L[n] h^n by the perturbation series of the eigenpair:
 * order n of (K - L M) v = 0 is (K0 - L0 M) v_n = -sum_{m=1..n} (K_m - L_m M) v_{n-m}. */
static void square_series(long double L[4], const mode *m0, const chain *c, const sa_dispersion *d,
                          long double p)
{
    const long double mass[3] = {1, d->mu_s, d->mu_b};
    const long double rail[4] = {0, p * (p * p - 2 * d->eta_N), 3 * p * p / 2 - d->eta_N, p};
    const long double bed[4] = {0, 2 * d->eta_s * p, d->eta_s, 0};
    long double v[3][3] = {{m0->v[0], m0->v[1], m0->v[2]}};

    for (int n = 1; n <= 3; n++) {
        long double f[3] = {rail[n] * v[0][0], 0, bed[n] * v[0][2]};
        for (int m = 1; m < n; m++) {
            f[0] += rail[m] * v[n - m][0];
            f[2] += bed[m] * v[n - m][2];
            for (int i = 0; i < 3; i++) {
                f[i] -= L[m] * mass[i] * v[n - m][i];
            }
        }
        L[n] = (f[0] * v[0][0] + f[1] * v[0][1] + f[2] * v[0][2]) / m0->mass;
        for (int i = 0; i < 3; i++) {
            f[i] -= L[n] * mass[i] * v[0][i];
        }
        if (n < 3) {
            solve(v[n], f, c, d, m0->at);
        }
    }
}

cv_status sa_dispersion_wave(sa_wave *out, const sa_dispersion *d, int k, long double p,
                             long double omega_guess)
{
    long double L[4];
    chain c;
    mode m;

    if (!find_square(&L[0], d, k, p, omega_guess * omega_guess)) {
        return CV_FAILED;
    }
    chain_set(&c, d, p, L[0]);
    mode_set(&m, &c, d);
    square_series(L, &m, &c, d, p);

    long double w = sqrtl(L[0]);
    long double w1 = L[1] / (2 * w);
    long double w2 = (L[2] - w1 * w1) / (2 * w);
    long double w3 = (L[3] - 2 * w1 * w2) / (2 * w);
    long double p2 = p * p;
    /* L - (p/2) dL/dp as energies: K - (p/2) dK/dp has the springs unchanged, -p^4/4 for the rail */
    long double energy = d->kappa_p * m.pad * m.pad + d->kappa_b * m.bed * m.bed + m.v[2] * m.v[2] -
                         p2 * p2 / 4 * m.v[0] * m.v[0];
    *out = (sa_wave){.p = p, .omega = w, .d = {w, w1, 2 * w2, 6 * w3}, .intercept = energy / (m.mass * w)};
    return CV_OK;
}

long double sa_dispersion_shear_speed(const sa_dispersion *d)
{
    return sqrtl(d->eta_s / d->mu_b);
}
