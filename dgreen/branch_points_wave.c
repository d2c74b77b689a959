#include "dgreen/branch_points_wave.h"

#include <complex.h>
#include <math.h>

/* The cubic f(X, Y) and its partial derivatives. */
typedef struct {
    double f, x, y, xx, xy, yy;
} cubic;

/* f = (B - X) R + kappa_p G with B = Y^2/4 - eta_N Y and, as in dgreen/operator.h at s^2 = -X without
 * damping, R = (kappa_p - mu_s X) C + kappa_b E, G = R - kappa_p C, C = kappa_b + E, E = 1 + eta_s Y - mu_b
 * X. */
static void cubic_at(cubic *o, const dg_track *t, double X, double Y)
{
    const double e = 1 + t->eta_s * Y - t->mu_b * X, c = t->kappa_b + e;
    const double pad = t->kappa_p - t->mu_s * X, a = Y * Y / 4 - t->eta_N * Y - X, a_y = Y / 2 - t->eta_N;
    const double r = pad * c + t->kappa_b * e;
    const double r_x = -t->mu_s * c - t->mu_b * (pad + t->kappa_b), r_y = t->eta_s * (pad + t->kappa_b);
    const double r_xx = 2 * t->mu_s * t->mu_b, r_xy = -t->mu_s * t->eta_s;
    const double g = -t->mu_s * X * c + t->kappa_b * e;
    const double g_x = r_x + t->kappa_p * t->mu_b, g_y = r_y - t->kappa_p * t->eta_s;
    o->f = a * r + t->kappa_p * g;
    o->x = -r + a * r_x + t->kappa_p * g_x;
    o->y = a_y * r + a * r_y + t->kappa_p * g_y;
    o->xx = -2 * r_x + a * r_xx + t->kappa_p * r_xx;
    o->xy = a_y * r_x - r_y + a * r_xy + t->kappa_p * r_xy;
    o->yy = r / 2 + 2 * a_y * r_y;
}

/* Brackets root k: the two roots of R in X separate the three of f (both are minors of a symmetric chain),
 * and the last is below the larger of rail alone and foundation alone plus their coupling. */
static void bracket_root(double *low, double *high, const dg_track *t, double Y, int k)
{
    const double ground = t->kappa_b + 1 + t->eta_s * Y, sleeper = t->kappa_p + t->kappa_b;
    const double masses = t->mu_s * t->mu_b, sum = sleeper * t->mu_b + t->mu_s * ground;
    const double difference = sleeper * t->mu_b - t->mu_s * ground;
    const double root = sqrt(difference * difference + 4 * masses * t->kappa_b * t->kappa_b);
    const double upper = (sum + root) / (2 * masses);
    const double lower = 2 * (t->kappa_p * ground + t->kappa_b * (ground - t->kappa_b)) / (sum + root);
    const double rail = Y * Y / 4 - t->eta_N * Y + t->kappa_p;
    *low = k == 0 ? 0 : k == 1 ? lower : fmax(upper, rail);
    *high = k == 0 ? lower : k == 1 ? upper : fmax(upper, rail) + t->kappa_p / sqrt(t->mu_s);
}

/* Newton's method ends at steps below CLOSE, or where those below ROUNDING (relative) no longer become
 * shorter.
 */
static const double CLOSE = 1e-16, ROUNDING = 1e-12;

/* Newton inside a shrinking bracket, from the guess where that is inside; f > 0 below roots 0 and 2, < 0
 * below root 1. */
static double root_of(const dg_track *t, double Y, int k, double guess)
{
    double low, high, step = INFINITY;
    bracket_root(&low, &high, t, Y, k);
    double x = guess > low && guess < high ? guess : (low + high) / 2;
    for (int i = 0; i < 200 && high - low > 1e-16 * high; i++) {
        cubic o;
        cubic_at(&o, t, x, Y);
        *((o.f > 0) == (k != 1) ? &low : &high) = x;
        const double newton = -o.f / o.x;
        const int shorter = fabs(newton) < fabs(step) / 2;
        if (fabs(newton) <= CLOSE * x || (!shorter && fabs(newton) <= ROUNDING * x))
            return x + newton;
        const double next = x + newton;
        step = newton;
        x = shorter && next > low && next < high ? next : (low + high) / 2;
    }
    return x;
}

void dg_wave_at(dg_wave *w, const dg_track *t, double p, int branch)
{
    dg_wave_near(w, t, p, branch, 0);
}

void dg_wave_near(dg_wave *w, const dg_track *t, double p, int branch, double omega)
{
    const double Y = p * p, X = root_of(t, Y, branch, omega * omega);
    cubic o;
    cubic_at(&o, t, X, Y);
    const double first = -o.y / o.x; /* dX/dY on the branch */
    const double second = -(o.yy + 2 * o.xy * first + o.xx * first * first) / o.x;
    w->omega = sqrt(X);
    w->group = p * first / w->omega;
    w->curvature = (first + 2 * Y * second) / w->omega - Y * first * first / (X * w->omega);
}

double dg_wave_strength(const dg_track *t, double p, const dg_wave *w)
{
    const double Y = p * p, X = w->omega * w->omega, e = 1 + t->eta_s * Y - t->mu_b * X;
    const double r = (t->kappa_p - t->mu_s * X) * (t->kappa_b + e) + t->kappa_b * e;
    cubic o;
    cubic_at(&o, t, X, Y);
    return fabs(r / (8 * w->omega * o.x)); /* Delta = 4 f, d f/dq = 2 sigma f_X */
}

double dg_wave_shift(const dg_track *t, double p, const dg_wave *w)
{
    const double Y = p * p, X = w->omega * w->omega;
    const double complex s = CMPLX(0, -w->omega), d2 = 2 * t->eta_p * s + t->kappa_p;
    const double complex d4 = 2 * t->eta_b * s + t->kappa_b;
    const double complex e = 2 * t->eta_f * s + (1 + t->eta_s * Y - t->mu_b * X), c = d4 + e;
    const double complex g = -t->mu_s * X * c + d4 * e, r = d2 * c + g;
    const double complex delta = (Y * Y / 4 - t->eta_N * Y - X) * r + d2 * g;
    cubic o;
    cubic_at(&o, t, X, Y);
    return fabs(cimag(delta) / (2 * w->omega * o.x)); /* d f/dq = 2 sigma f_X */
}
