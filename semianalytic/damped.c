#include "semianalytic/damped.h"

#include <float.h>
#include <gsl/gsl_poly.h>
#include <math.h>
#include <string.h>

enum { DEGREE = 8 };

typedef struct {
    long double mu_s, mu_b, kappa_p, kappa_b, eta_p, eta_b, eta_f, eta_s, eta_N, alpha;
} track;

/* a function of l with its derivative */
typedef struct {
    complex long double f, d;
} jet;

typedef struct {
    jet d3, top[SA_FIELDS];
} system_jets;

static jet linear(long double slope, long double constant, complex long double l)
{
    return (jet){slope * l + constant, slope};
}

static jet square(long double factor, complex long double l)
{
    return (jet){factor * l * l, 2 * factor * l};
}

static jet sum(jet u, jet v)
{
    return (jet){u.f + v.f, u.d + v.d};
}

static jet product(jet u, jet v)
{
    return (jet){u.f * v.f, u.d * v.f + u.f * v.d};
}

/* (7)-(10) with C = D4 + D5 + D6 + D7 and t = D3 C + D4 (D5 + D6 + D7): d2 = D2 C + t, d3 = D1 d2 + D2 t,
 * where large stiffnesses are never subtracted. D_2 etc. as in the paper. */
static void system_set(system_jets *s, const track *t, complex long double l)
{
    long double a2 = t->alpha * t->alpha;
    jet l2 = square(1, l);
    jet D1 = sum(product(l2, sum(square(0.25L, l), (jet){t->eta_N, 0})), square(a2, l));
    jet D2 = linear(-2 * t->eta_p * t->alpha, t->kappa_p, l);
    jet D3 = square(t->mu_s * a2, l);
    jet D4 = linear(-2 * t->eta_b * t->alpha, t->kappa_b, l);
    jet D567 = sum(square(t->mu_b * a2 - t->eta_s, l), linear(-2 * t->eta_f * t->alpha, 1, l));
    jet C = sum(D4, D567);
    jet T = sum(product(D3, C), product(D4, D567));

    s->top[0] = sum(product(D2, C), T);
    s->top[1] = product(D2, C);
    s->top[2] = product(D2, D4);
    s->d3 = sum(product(D1, s->top[0]), product(D2, T));
}

/* to += factor a b, polynomials of degree <= DEGREE with ascending coefficients */
static void add_product(long double *to, long double factor, const long double *a, const long double *b)
{
    for (int i = 0; i <= DEGREE; i++) {
        for (int j = 0; j <= DEGREE - i; j++) {
            to[i + j] += factor * a[i] * b[j];
        }
    }
}

/* d3 as a polynomial in l, for start values. Returns its degree. */
static int coefficients(long double c[DEGREE + 1], const track *t)
{
    long double a2 = t->alpha * t->alpha;
    long double D1[DEGREE + 1] = {0, 0, t->eta_N + a2, 0, 0.25L};
    long double D2[DEGREE + 1] = {t->kappa_p, -2 * t->eta_p * t->alpha};
    long double D3[DEGREE + 1] = {0, 0, t->mu_s * a2};
    long double D4[DEGREE + 1] = {t->kappa_b, -2 * t->eta_b * t->alpha};
    long double D567[DEGREE + 1] = {1, -2 * t->eta_f * t->alpha, t->mu_b * a2 - t->eta_s};
    long double C[DEGREE + 1] = {0}, T[DEGREE + 1] = {0}, d2[DEGREE + 1] = {0};
    int degree = DEGREE;

    for (int i = 0; i <= DEGREE; i++) {
        C[i] = D4[i] + D567[i];
        c[i] = 0;
    }
    add_product(T, 1, D3, C);
    add_product(T, 1, D4, D567);
    memcpy(d2, T, sizeof d2);
    add_product(d2, 1, D2, C);
    add_product(c, 1, D1, d2);
    add_product(c, 1, D2, T);
    while (degree > 0 && c[degree] == 0) {
        degree--;
    }
    return degree;
}

static int start_values(complex long double l[DEGREE], const track *t)
{
    long double c[DEGREE + 1], power = 1;
    double scaled[DEGREE + 1], root[2 * DEGREE];
    int degree = coefficients(c, t);

    long double scale = powl(fabsl(c[0] / c[degree]), 1.0L / degree);
    for (int i = 0; i <= degree; i++, power *= scale) {
        scaled[i] = (double)(c[i] * power / c[0]);
    }
    gsl_poly_complex_workspace *work = gsl_poly_complex_workspace_alloc((size_t)degree + 1);
    if (!work || gsl_poly_complex_solve(scaled, (size_t)degree + 1, work, root) != 0) {
        degree = 0;
    }
    gsl_poly_complex_workspace_free(work);
    for (int i = 0; i < degree; i++) {
        l[i] = scale * (root[2 * i] + (complex long double)_Complex_I * root[2 * i + 1]);
    }
    return degree;
}

/* Simultaneous iteration (Ehrlich and Aberth) on d3 itself. 1 when it has converged. */
static int polish(complex long double l[DEGREE], int count, const track *t)
{
    for (int iteration = 0; iteration < 200; iteration++) {
        long double worst = 0;
        for (int i = 0; i < count; i++) {
            system_jets s;
            system_set(&s, t, l[i]);
            complex long double step = s.d3.f / s.d3.d, others = 0;
            for (int j = 0; j < count; j++) {
                others += j == i ? 0 : 1 / (l[i] - l[j]);
            }
            step /= 1 - step * others;
            l[i] -= step;
            worst = fmaxl(worst, cabsl(step) / cabsl(l[i]));
        }
        if (worst <= 1e-17L || (iteration > 20 && worst <= 1e-14L)) {
            return 1;
        }
        if (!(worst <= LDBL_MAX)) {
            return 0;
        }
    }
    return 0;
}

/* Real part of the root next to l, 0 when rounding errors could change its sign. At l = i sigma + tiny the
 * even and the odd powers of l stay apart in the real and the imaginary part, so that Newton's step has a
 * relatively accurate real part even where |l| LDBL_EPSILON exceeds it; steps from neighbouring numbers show
 * how accurate. */
static long double real_part(const track *t, complex long double l)
{
    long double least = INFINITY, most = -INFINITY;

    for (int k = -3; k <= 3; k++) {
        system_jets s;
        complex long double near = l * (1 + 2 * k * LDBL_EPSILON);
        system_set(&s, t, near);
        long double re = creall(near - s.d3.f / s.d3.d);
        least = fminl(least, re);
        most = fmaxl(most, re);
    }
    return fabsl(most + least) / 2 > 2 * (most - least) ? (most + least) / 2 : 0;
}

static void track_set(track *t, const cv_params *params, const cv_number *alpha)
{
    const cv_number *from[] = {&params->mu_s,  &params->mu_b,  &params->kappa_p, &params->kappa_b,
                               &params->eta_p, &params->eta_b, &params->eta_f,   &params->eta_s,
                               &params->eta_N, alpha};
    long double *to[] = {&t->mu_s,  &t->mu_b,  &t->kappa_p, &t->kappa_b, &t->eta_p,
                         &t->eta_b, &t->eta_f, &t->eta_s,   &t->eta_N,   &t->alpha};
    mpfr_t x;

    mpfr_init2(x, LDBL_MANT_DIG);
    for (size_t i = 0; i < sizeof to / sizeof to[0]; i++) {
        cv_number_get_mpfr(x, from[i]);
        *to[i] = mpfr_get_ld(x, MPFR_RNDN);
    }
    mpfr_clear(x);
}

/* (1/pi) integral top/d3 e^{ip xi} dp = 2 sum_{Re l < 0} top/(dd3/dl) e^{l xi} ahead, minus the others
 * behind. */
cv_status sa_damped_terms(sa_steady *s, const cv_params *params, const cv_number *alpha, cv_message *why)
{
    complex long double l[DEGREE];
    track t;

    track_set(&t, params, alpha);
    s->count = start_values(l, &t);
    if (s->count == 0 || !polish(l, s->count, &t)) {
        return cv_fail(why, CV_UNDECIDED, "the wave numbers at this velocity cannot be told apart");
    }
    for (int i = 0; i < s->count; i++) {
        system_jets at;
        sa_steady_term *term = &s->term[i];
        long double side = real_part(&t, l[i]);
        if (side == 0) {
            return cv_fail(why, CV_UNDECIDED, "the damping is too small to tell on which side a wave runs");
        }
        l[i] = side + (complex long double)_Complex_I * cimagl(l[i]);
        system_set(&at, &t, l[i]);
        term->ahead = side < 0;
        term->p = (term->ahead ? -1 : 1) * (complex long double)_Complex_I * l[i];
        for (int f = 0; f < SA_FIELDS; f++) {
            term->weight[f] = (term->ahead ? 2 : -2) * at.top[f].f / at.d3.d;
        }
    }
    return CV_OK;
}
