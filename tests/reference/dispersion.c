#include "dispersion.h"

#include <math.h>
#include <stdlib.h>

/* Wavenumbers of the grid on which the branches are bracketed: |p| from e^GRID_LOG_MIN, GRID_STEP apart. */
enum { GRID_SIZE = 6000 };
static const double grid_log_min = -9.0, grid_step = 0.0025;

void ref_dtrack_set(ref_dtrack *to, const ref_track *from)
{
    arb_t x;
    arb_init(x);
    for (int i = 0; i < REF_PARAMS; i++) {
        arb_set_fmpq(x, &from->value[i], 100);
        to->value[i] = arf_get_d(arb_midref(x), ARF_RND_NEAR);
    }
    arb_clear(x);
}

/* One Jacobi rotation in the plane (i, j) of the symmetric a; v collects the rotations. */
static void rotate(long double a[3][3], long double v[3][3], int i, int j)
{
    if (a[i][j] == 0)
        return;
    long double theta = (a[j][j] - a[i][i]) / (2 * a[i][j]);
    long double t = (theta >= 0 ? 1 : -1) / (fabsl(theta) + sqrtl(theta * theta + 1));
    long double c = 1 / sqrtl(t * t + 1), s = t * c;
    for (int k = 0; k < 3; k++) {
        long double x = a[k][i], y = a[k][j];
        a[k][i] = c * x - s * y;
        a[k][j] = s * x + c * y;
    }
    for (int k = 0; k < 3; k++) {
        long double x = a[i][k], y = a[j][k];
        a[i][k] = c * x - s * y;
        a[j][k] = s * x + c * y;
        x = v[k][i];
        y = v[k][j];
        v[k][i] = c * x - s * y;
        v[k][j] = s * x + c * y;
    }
}

void ref_dispersion(double omega[3], double group[3], const ref_dtrack *t, double p)
{
    const double *c = t->value;
    long double p2 = (long double)p * p;
    long double rs = 1 / sqrtl(c[REF_MU_S]), rb = 1 / sqrtl(c[REF_MU_B]);
    long double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, a[3][3] = {{0}};
    a[0][0] = p2 * p2 / 4 - c[REF_ETA_N] * p2 + c[REF_KAPPA_P];
    a[1][1] = ((long double)c[REF_KAPPA_P] + c[REF_KAPPA_B]) * rs * rs;
    a[2][2] = (c[REF_KAPPA_B] + 1.0L + c[REF_ETA_S] * p2) * rb * rb;
    a[0][1] = a[1][0] = -c[REF_KAPPA_P] * rs;
    a[1][2] = a[2][1] = -c[REF_KAPPA_B] * rs * rb;
    for (int sweep = 0; sweep < 12; sweep++) {
        rotate(a, v, 0, 1);
        rotate(a, v, 1, 2);
        rotate(a, v, 0, 2);
    }
    for (int k = 0; k < 3; k++) {
        long double w = sqrtl(fmaxl(a[k][k], 0));
        long double slope = ((long double)p2 * p - 2 * c[REF_ETA_N] * p) * v[0][k] * v[0][k] +
                            2 * c[REF_ETA_S] * p * rb * rb * v[2][k] * v[2][k];
        omega[k] = (double)w;
        group[k] = w > 0 ? (double)(slope / (2 * w)) : 0;
    }
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2 - i; k++) {
            if (omega[k] > omega[k + 1]) {
                double x = omega[k];
                omega[k] = omega[k + 1];
                omega[k + 1] = x;
                x = group[k];
                group[k] = group[k + 1];
                group[k + 1] = x;
            }
        }
    }
}

void ref_branch_point(double *alpha, double *q, const ref_dtrack *t, int k, double p)
{
    double omega[3], group[3];
    ref_dispersion(omega, group, t, p);
    *alpha = fabs(group[k]);
    *q = fabs(omega[k] - p * group[k]);
}

static double grid_p(int i)
{
    return exp(grid_log_min + grid_step * i);
}

/* What is bisected in p: the signed group velocity minus target, or its slope, or the signed branch point. */
typedef enum { GROUP, GROUP_SLOPE, BRANCH } curve;

static double curve_value(const ref_dtrack *t, int k, curve what, double p, double target)
{
    double omega[3], group[3], next[3];
    ref_dispersion(omega, group, t, p);
    if (what == GROUP)
        return group[k] - target;
    if (what == BRANCH)
        return omega[k] - p * group[k];
    double h = 1e-5 * p;
    ref_dispersion(omega, next, t, p + h);
    ref_dispersion(omega, group, t, p - h);
    return next[k] - group[k];
}

static double bisect(const ref_dtrack *t, int k, curve what, double target, double lo, double hi)
{
    double sign = curve_value(t, k, what, lo, target) < 0 ? -1 : 1;
    for (int i = 0; i < 60; i++) {
        double mid = 0.5 * (lo + hi);
        if (sign * curve_value(t, k, what, mid, target) > 0)
            lo = mid;
        else
            hi = mid;
    }
    return 0.5 * (lo + hi);
}

size_t ref_branch_points(double *q, size_t max, const ref_dtrack *t, double alpha)
{
    size_t n = 0;
    for (int k = 0; k < 3; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            double before = curve_value(t, k, GROUP, grid_p(0), sign * alpha);
            for (int i = 1; i < GRID_SIZE && n < max; i++) {
                double now = curve_value(t, k, GROUP, grid_p(i), sign * alpha), a;
                if (before * now < 0)
                    ref_branch_point(&a, &q[n++], t, k,
                                     bisect(t, k, GROUP, sign * alpha, grid_p(i - 1), grid_p(i)));
                before = now;
            }
        }
    }
    return n;
}
