#include "semianalytic/map_cell.h"

#include <math.h>

/* Mean of a over the corners at u0 minus that over the corners at u1; the same along t. */
static double across_u(const double *a)
{
    return (a[0] + a[2] - a[1] - a[3]) / 2;
}

static double across_t(const double *a)
{
    return (a[0] + a[1] - a[2] - a[3]) / 2;
}

int sa_cell_one_signed(double roughness[2], const sa_cell_values *v, double tolerance, double steepest)
{
    double log_f[SA_CELL_POINTS], slope_u[SA_CELL_POINTS], slope_t[SA_CELL_POINTS], largest = 0;
    roughness[0] = roughness[1] = INFINITY;
    for (int i = 0; i < SA_CELL_POINTS; ++i) {
        if (!(v->f[i] * v->f[0] > 0))
            return 0;
        log_f[i] = log(fabs(v->f[i]));
        slope_u[i] = v->f_u[i] / v->f[i];
        slope_t[i] = v->f_t[i] / v->f[i];
        largest = fmax(largest, fmax(fabs(slope_u[i]), fabs(slope_t[i])));
    }
    double mean = (log_f[0] + log_f[1] + log_f[2] + log_f[3]) / 4;
    double centre = mean + across_u(slope_u) / 8 + across_t(slope_t) / 8;
    double mean_u = (slope_u[0] + slope_u[1] + slope_u[2] + slope_u[3]) / 4;
    double mean_t = (slope_t[0] + slope_t[1] + slope_t[2] + slope_t[3]) / 4;
    roughness[0] = fabs(slope_u[4] - (-1.5 * across_u(log_f) - mean_u / 2));
    roughness[1] = fabs(slope_t[4] - (-1.5 * across_t(log_f) - mean_t / 2));
    return fabs(log_f[4] - centre) < tolerance && roughness[0] < 2 * tolerance &&
           roughness[1] < 2 * tolerance && largest < steepest;
}

static int smooth(const double slope[SA_CELL_POINTS])
{
    const double largest_ratio = 8, largest_bend = 0.5;
    double smallest = INFINITY, largest = 0, mean = 0;
    for (int i = 0; i < SA_CELL_POINTS; ++i) {
        if (!(slope[i] * slope[0] > 0))
            return 0;
        smallest = fmin(smallest, fabs(slope[i]));
        largest = fmax(largest, fabs(slope[i]));
        if (i < SA_CELL_CORNERS)
            mean += log(fabs(slope[i])) / SA_CELL_CORNERS;
    }
    return largest < largest_ratio * smallest && fabs(log(fabs(slope[4])) - mean) < largest_bend;
}

int sa_slopes_fit(double rise, double slope0, double slope1)
{
    const double slack = 1.5;
    double low = fmin(fabs(slope0), fabs(slope1)), high = fmax(fabs(slope0), fabs(slope1));
    return rise * slope0 > 0 && fabs(rise) * slack > low && fabs(rise) < slack * high;
}

int sa_cell_steady(const sa_cell_values *v, int axis)
{
    const double largest_surprise = 0.25;
    const double *f = v->f, *slope = axis == 0 ? v->f_u : v->f_t;
    const int step = axis == 0 ? 1 : 2, next = 3 - step; /* corners 0 and 0 + step, next and next + step */
    if (!smooth(slope) || !sa_slopes_fit(f[step] - f[0], slope[0], slope[step]) ||
        !sa_slopes_fit(f[3] - f[next], slope[next], slope[3]))
        return 0;
    double centre = (f[0] + f[1] + f[2] + f[3]) / 4 + across_u(v->f_u) / 8 + across_t(v->f_t) / 8;
    return fabs(f[4] - centre) < largest_surprise * fabs(slope[4]);
}

int sa_cubic_one_signed(double f0, double f1, double slope0, double slope1)
{
    /* Bernstein coefficients f0, f0 + slope0 / 3, f1 - slope1 / 3, f1 bound the cubic */
    double sign = f0 > 0 ? 1 : -1, margin = 0.2 * fmin(fabs(f0), fabs(f1));
    return f0 * f1 > 0 && sign * (f0 + slope0 / 3) > margin && sign * (f1 - slope1 / 3) > margin;
}
