#include "semianalytic/undamped.h"

#include <float.h>
#include <gsl/gsl_poly.h>
#include <math.h>

static const long double NEAREST = 1e-11L; /* least reach relative to alpha */

#define I_UNIT ((complex long double)_Complex_I)

/* A function of x = p^2 and a = alpha^2 with the derivatives that are needed. */
typedef struct {
    complex long double f, x, a, xx, xa;
} jet;

/* d3 and the numerators of (12) for W, V and U */
typedef struct {
    jet d3, top[SA_FIELDS];
    jet other;   /* equal to top[0] where d3 = 0; f, x and a only */
    int cancels; /* top[0] is small against its terms, as for waves that hardly move the rail: other is
                    accurate */
} system_jets;

static jet constant(long double c)
{
    return (jet){.f = c};
}

static jet sum(jet u, jet v)
{
    return (jet){u.f + v.f, u.x + v.x, u.a + v.a, u.xx + v.xx, u.xa + v.xa};
}

static jet times(long double c, jet u)
{
    return (jet){c * u.f, c * u.x, c * u.a, c * u.xx, c * u.xa};
}

static jet product(jet u, jet v)
{
    return (jet){u.f * v.f, u.x * v.f + u.f * v.x, u.a * v.f + u.f * v.a,
                 u.xx * v.f + 2 * u.x * v.x + u.f * v.xx, u.xa * v.f + u.x * v.a + u.a * v.x + u.f * v.xa};
}

/* first derivatives only */
static jet quotient(jet u, jet v)
{
    complex long double f = u.f / v.f;

    return (jet){.f = f, .x = (u.x - f * v.x) / v.f, .a = (u.a - f * v.a) / v.f};
}

/* With rail = p^4/4 - eta_N p^2 - L, g = 1 + eta_s p^2 - mu_b L, D3 = -mu_s L, L = a x, and C = kappa_b + g:
 * t = D3 C + kappa_b g, d2 = kappa_p C + t, d3 = rail d2 + kappa_p t: no large stiffness is subtracted. */
static void system_set(system_jets *s, const sa_dispersion *track, complex long double x, long double a)
{
    jet L = {.f = a * x, .x = a, .a = x, .xa = 1};
    jet X = {.f = x, .x = 1};
    jet rail = sum(product(X, sum(times(0.25L, X), constant(-track->eta_N))), times(-1, L));
    jet g = sum(sum(constant(1), times(track->eta_s, X)), times(-track->mu_b, L));
    jet C = sum(constant(track->kappa_b), g);
    jet t = sum(times(-track->mu_s, product(L, C)), times(track->kappa_b, g));

    s->top[0] = sum(times(track->kappa_p, C), t);
    s->top[1] = times(track->kappa_p, C);
    s->top[2] = constant(track->kappa_p * track->kappa_b);
    s->d3 = sum(product(rail, s->top[0]), times(track->kappa_p, t));
    s->other = quotient(times(-track->kappa_p, t), rail);
    s->cancels = cabsl(s->top[0].f) < 0.1L * cabsl(t.f);
}

/* Start values: d3(p, 0) as a polynomial in x, in double. Returns its degree. */
static int start_values(complex long double x[4], const sa_dispersion *t, long double a)
{
    long double m = t->mu_b * a - t->eta_s, n = t->mu_s * a, kp = t->kappa_p, kb = t->kappa_b;
    long double e[3] = {kp * (kb + 1) + kb, -(kp * m + n * (kb + 1) + kb * m), n * m};
    long double r = -(t->eta_N + a);
    long double c[5] = {kp * kb, r * e[0] - kp * (n * (kb + 1) + kb * m), e[0] / 4 + r * e[1] + kp * n * m,
                        e[1] / 4 + r * e[2], e[2] / 4};
    int degree = 4;

    while (degree > 0 && c[degree] == 0) {
        degree--;
    }
    long double scale = powl(fabsl(c[0] / c[degree]), 1.0L / degree), power = 1;
    double scaled[5], root[8];
    for (int i = 0; i <= degree; i++, power *= scale) {
        scaled[i] = (double)(c[i] * power / c[0]);
    }
    gsl_poly_complex_workspace *work = gsl_poly_complex_workspace_alloc((size_t)degree + 1);
    if (!work || gsl_poly_complex_solve(scaled, (size_t)degree + 1, work, root) != 0) {
        degree = 0;
    }
    gsl_poly_complex_workspace_free(work);
    for (int i = 0; i < degree; i++) {
        x[i] = scale * (root[2 * i] + I_UNIT * root[2 * i + 1]);
    }
    return degree;
}

/* Simultaneous iteration (Ehrlich and Aberth) on d3 itself, never expanded. 1 when it has converged. */
static int polish(complex long double x[4], int count, const sa_dispersion *track, long double a)
{
    for (int iteration = 0; iteration < 100; iteration++) {
        long double worst = 0;
        for (int i = 0; i < count; i++) {
            system_jets s;
            system_set(&s, track, x[i], a);
            complex long double step = s.d3.f / s.d3.x, others = 0;
            for (int j = 0; j < count; j++) {
                others += j == i ? 0 : 1 / (x[i] - x[j]);
            }
            step /= 1 - step * others;
            x[i] -= step;
            worst = fmaxl(worst, cabsl(step) / cabsl(x[i]));
        }
        if (worst <= 1e-17L || (iteration > 20 && worst <= 1e-15L)) {
            return 1;
        }
        if (!(worst <= LDBL_MAX)) {
            return 0;
        }
    }
    return 0;
}

/* The contribution of the root x to (1/pi) integral top/d3 e^{ip xi} dp: 2 pi i Res = i top/(d3_x p) pi for
 * one p. */
static void pole_set(sa_undamped_pole *pole, const sa_dispersion *track, complex long double x,
                     long double alpha)
{
    system_jets s;
    system_set(&s, track, x, alpha * alpha);
    complex long double slope = s.d3.x, dx = -s.d3.a / slope * 2 * alpha;
    complex long double dslope = s.d3.xx * dx + s.d3.xa * 2 * alpha;
    int is_wave = cimagl(x) == 0 && creall(x) > 0;

    pole->p = is_wave ? sqrtl(creall(x)) : csqrtl(x);
    if (cimagl(pole->p) < 0) {
        pole->p = -pole->p;
    }
    pole->dp = dx / (2 * pole->p);
    /* a wave that the force overtakes less as it speeds up runs ahead of it: dx/dalpha > 0 is
     * (dd3/dq)/(dd3/dp) > 0 */
    pole->kind = !is_wave ? SA_DECAYING : creall(dx) > 0 ? SA_WAVE_AHEAD : SA_WAVE_BEHIND;
    /* +-p together give twice the sine; a conjugate pair twice the real part; behind, the contour runs the
     * other way */
    long double share = is_wave || cimagl(x) != 0 ? 2 : 1;
    for (int f = 0; f < SA_FIELDS; f++) {
        complex long double factor = I_UNIT * share / pole->p;
        const jet *top = f == 0 && s.cancels ? &s.other : &s.top[f];
        complex long double ratio = top->f / slope;
        complex long double dtop = top->x * dx + top->a * 2 * alpha;
        pole->weight[f] = factor * ratio;
        pole->dweight[f] = factor * ((dtop - ratio * dslope) / slope - ratio * pole->dp / pole->p);
    }
}

static long double shortest_reach(const complex long double x[4], const complex long double dx[4], int count)
{
    long double reach = INFINITY;

    for (int i = 0; i < count; i++) {
        for (int j = i + 1; j < count; j++) {
            reach = fminl(reach, cabsl(x[i] - x[j]) / cabsl(dx[i] - dx[j]));
        }
    }
    return reach;
}

cv_status sa_undamped_solve(sa_undamped *out, const sa_dispersion *track, long double alpha, cv_message *why)
{
    complex long double x[4], dx[4];
    int degree = start_values(x, track, alpha * alpha);
    int done = degree > 0 && polish(x, degree, track, alpha * alpha);

    *out = (sa_undamped){.alpha = alpha};
    for (int i = 0; i < degree && done; i++) {
        sa_undamped_pole pole;
        if (fabsl(cimagl(x[i])) <= 1e-13L * cabsl(x[i])) {
            x[i] = creall(x[i]);
        }
        pole_set(&pole, track, x[i], alpha);
        dx[i] = 2 * pole.p * pole.dp;
        if (cimagl(x[i]) >= 0) {
            out->pole[out->count++] = pole;
        }
    }
    out->reach = done ? shortest_reach(x, dx, degree) : 0;
    /* weights lose LDBL_EPSILON alpha / reach */
    if (!(out->reach >= NEAREST * alpha)) {
        return cv_fail(
            why, CV_UNDECIDED,
            "two wave numbers meet at alpha = %.15Lg: a resonance velocity, where the undamped deflection is "
            "infinite, or too near to where a decaying pair parts",
            alpha);
    }
    return CV_OK;
}

void sa_undamped_at(long double value[4], const sa_undamped *s, int field, int ahead, long double distance)
{
    sa_pole_kind absent = ahead ? SA_WAVE_BEHIND : SA_WAVE_AHEAD;

    for (int i = 0; i < 4; i++) {
        value[i] = 0;
    }
    for (int j = 0; j < s->count; j++) {
        const sa_undamped_pole *pole = &s->pole[j];
        if (pole->kind == absent) {
            continue;
        }
        complex long double e = cexpl(I_UNIT * pole->p * distance);
        complex long double term = pole->weight[field] * e, ip = I_UNIT * pole->p;
        value[0] += creall(term);
        value[1] += creall(ip * term);
        value[2] += creall(ip * ip * term);
        value[3] += creall(pole->dweight[field] * e + I_UNIT * pole->dp * distance * term);
    }
}
