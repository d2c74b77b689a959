#include "semianalytic/laplace.h"

#include <math.h>

static int different(const double complex *p, int n)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            if (!(cabs(p[i] - p[j]) > 0x1p-40 * cabs(p[i])))
                return 0;
    return 1;
}

static void set_slopes(sa_sheet *s)
{
    sa_point m;
    for (int i = 0; i < s->count; i++) {
        sa_matrix_point(&m, s->track, s->alpha, s->q, s->p[i]);
        sa_matrix_slopes(&s->slopes[i], &m, s->track, s->alpha);
    }
}

static void sort_by_height(double complex *p, int n)
{
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && cimag(p[j]) > cimag(p[j - 1]); j--) {
            double complex swap = p[j];
            p[j] = p[j - 1];
            p[j - 1] = swap;
        }
}

cv_status sa_sheet_start(sa_sheet *s, const sa_track *t, double alpha, double complex q)
{
    int upper = sa_matrix_upper_count_double(t, alpha);
    s->track = t;
    s->alpha = alpha;
    s->q = q;
    if (sa_poles_cold(s->p, &s->count, t, alpha, q) != CV_OK)
        return CV_FAILED;
    sort_by_height(s->p, s->count);
    if (s->count <= upper || !(cimag(s->p[upper - 1]) > 0) || !(cimag(s->p[upper]) < 0) ||
        !different(s->p, s->count))
        return CV_UNDECIDED;
    for (int i = 0; i < s->count; i++)
        s->upper[i] = i < upper;
    set_slopes(s);
    return CV_OK;
}

cv_status sa_sheet_far(sa_sheet *s, const sa_track *t, double alpha, double complex q)
{
    const double converged = 1e-12, certain = 0.1;
    *s = (sa_sheet){.track = t, .alpha = alpha, .q = q, .count = 4};
    for (int i = 0; i < s->count; i++) {
        sa_point m;
        double sign = i < 2 ? 1 : -1;
        double complex root = csqrt(alpha * alpha + sign * 2 * q);
        s->p[i] = -sign * alpha + (i % 2 ? root : -root);
        sa_poles_newton(&s->p[i], &m, t, alpha, q);
        s->upper[i] = cimag(s->p[i]) > 0;
        if (!(cabs(m.det / m.det_p) < fmin(converged * cabs(m.p), certain * fabs(cimag(m.p)))))
            return CV_UNDECIDED;
    }
    set_slopes(s);
    return s->upper[0] + s->upper[1] == 1 && s->upper[2] + s->upper[3] == 1 ? CV_OK : CV_UNDECIDED;
}

/* Distance to the nearest other pole. */
static double room(const sa_sheet *s, int i)
{
    double nearest = INFINITY;
    for (int j = 0; j < s->count; j++)
        if (j != i)
            nearest = fmin(nearest, cabs(s->p[i] - s->p[j]));
    return nearest;
}

/* Newton's iteration from the prediction; a step in p of a sixth of the distance to the next pole, and a
 * correction much smaller than that, cannot confuse two poles: the square root of a branch point changes by
 * less than a third then. */
static int step(sa_sheet *next, const sa_sheet *s, double complex q)
{
    const double step_max = 1.0 / 6, correction_max = 1.0 / 30;
    *next = *s;
    next->q = q;
    for (int i = 0; i < s->count; i++) {
        sa_point m;
        double complex change = s->slopes[i].p_q * (q - s->q), predicted = s->p[i] + change;
        double space = room(s, i);
        if (!(cabs(change) < step_max * space))
            return 0;
        next->p[i] = predicted;
        /* not converged in both parts: Im p may pass 0 here, so the size of the correction decides */
        sa_poles_newton(&next->p[i], &m, s->track, s->alpha, q);
        if (!(cabs(next->p[i] - predicted) < correction_max * space) ||
            !(cabs(m.det / m.det_p) < 1e-10 * cabs(m.p)))
            return 0;
        sa_matrix_slopes(&next->slopes[i], &m, s->track, s->alpha);
    }
    return 1;
}

cv_status sa_sheet_move(sa_sheet *s, double complex q)
{
    enum { STEPS_MAX = 3000 };
    const double smallest = 1e-13;
    const double complex from = s->q, way = q - from;
    double done = 0, length = 1;
    sa_sheet next;
    if (way == 0)
        return CV_OK;
    for (int i = 0; i < STEPS_MAX && done < 1; i++) {
        double end = fmin(1, done + length);
        if (step(&next, s, end < 1 ? from + end * way : q)) {
            *s = next;
            done = end;
            length *= 1.7;
        } else {
            length /= 2;
            if (length * cabs(way) < smallest * (cabs(q) + cabs(from)))
                return CV_UNDECIDED;
        }
    }
    return done < 1 ? CV_UNDECIDED : CV_OK;
}

cv_status sa_sheet_at(sa_sheet *s, const sa_track *t, double alpha, double complex q)
{
    cv_status status = sa_sheet_start(s, t, alpha, cimag(q) > 0 ? CMPLX(creal(q), 0) : q);
    if (status == CV_OK && cimag(q) > 0)
        status = sa_sheet_move(s, q);
    return status;
}

double complex sa_sheet_zeta(double complex *zeta_q, const sa_sheet *s)
{
    double complex sum = 0, along_q = 0;
    for (int i = 0; i < s->count; i++)
        if (s->upper[i]) {
            sum += s->slopes[i].residue;
            along_q += s->slopes[i].residue_q;
        }
    if (zeta_q != NULL)
        *zeta_q = CMPLX(0, 1) * s->q * (2 * sum + s->q * along_q);
    return CMPLX(0, 1) * s->q * s->q * sum;
}

double complex sa_sheet_kernel(const sa_sheet *s, double xi)
{
    const double two_pi = 6.283185307179586476925;
    double complex sum = 0;
    for (int i = 0; i < s->count; i++)
        if (s->upper[i] == (xi >= 0))
            sum += s->slopes[i].residue * cexp(CMPLX(0, 1) * s->p[i] * xi);
    return CMPLX(0, xi >= 0 ? two_pi : -two_pi) * sum;
}
