#include "dgreen/transitions_sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/transitions_cell.h"

/* Velocities of the first look: steps of at most this part of alpha and of the range, and this many per
 * decade of the distance from a special velocity, down to this part of its width. */
static const double RELATIVE_STEP = 0.015, RANGE_STEP = 0.005, FIRST = 0.3;
enum { PER_DECADE = 2 };

cv_status dg_sweep_add(dg_sweep *s, size_t mass, const dg_find *find)
{
    dg_mass *m = &s->masses[mass];
    if (m->count == m->room) {
        const size_t room = m->room ? 2 * m->room : 16;
        dg_find *grown = realloc(m->finds, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(s->why, CV_FAILED, "out of memory");
        m->finds = grown;
        m->room = room;
    }
    m->finds[m->count++] = *find;
    return CV_OK;
}

void dg_sweep_forget(dg_sweep *s, const size_t *keep)
{
    for (size_t k = 0; k < s->mass_count; k++)
        s->masses[k].count = keep[k];
}

void dg_sweep_doubt(dg_mass *mass, const char *reason, double alpha, double other)
{
    if (mass->status == CV_OK)
        mass->status =
            cv_fail(&mass->why, CV_UNDECIDED, "%s between alpha = %.17g and %.17g", reason, alpha, other);
}

typedef struct {
    size_t count, room;
    double *at;
} velocities;

static cv_status push(velocities *v, double alpha, cv_message *why)
{
    if (v->count == v->room) {
        const size_t room = v->room ? 2 * v->room : 512;
        double *grown = realloc(v->at, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        v->at = grown;
        v->room = room;
    }
    v->at[v->count++] = alpha;
    return CV_OK;
}

static cv_status push_graded(velocities *v, const dg_special_velocity *s, double low, double high,
                             cv_message *why)
{
    const double ratio = pow(10, 1.0 / PER_DECADE);
    cv_status status = CV_OK;
    for (double d = fmax(FIRST * s->width, 4e-16 * s->alpha); d < high - low && status == CV_OK; d *= ratio) {
        if (s->alpha - d > low)
            status = push(v, s->alpha - d, why);
        if (status == CV_OK && s->alpha + d < high)
            status = push(v, s->alpha + d, why);
    }
    return status;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* All velocities of the first look, ascending, the ends included. */
static cv_status choose(velocities *v, const dg_sweep *s, double alpha_min, double alpha_max)
{
    size_t n;
    const dg_special_velocity *special = dg_special_velocities(&n, s->probe.branches);
    const double range = RANGE_STEP * (alpha_max - alpha_min);
    cv_status status = push(v, alpha_max, s->why);
    for (double a = alpha_min; a < alpha_max && status == CV_OK; a += fmin(RELATIVE_STEP * a, range))
        status = push(v, a, s->why);
    for (size_t i = 0; i < n && status == CV_OK; i++) {
        const double low = i > 0 ? (special[i - 1].alpha + special[i].alpha) / 2 : alpha_min;
        const double high = i + 1 < n ? (special[i + 1].alpha + special[i].alpha) / 2 : alpha_max;
        status = push_graded(v, &special[i], low, high, s->why);
    }
    qsort(v->at, v->count, sizeof *v->at, ascending);
    size_t kept = 0;
    for (size_t i = 0; i < v->count; i++)
        if (kept == 0 || v->at[i] > v->at[kept - 1])
            v->at[kept++] = v->at[i];
    v->count = kept;
    return status;
}

/* The counts at one velocity must agree in both ways; not asked where the velocity is so close to a
 * transition that the curve in double passes through 1/eta_M. */
static void check_counts(dg_sweep *s, const dg_curve *c)
{
    for (size_t k = 0; k < s->mass_count; k++) {
        int roots;
        cv_message why;
        if (!dg_curve_touches(c, s->masses[k].x) && dg_winding(&roots, c, s->masses[k].x, &why) != CV_OK &&
            s->masses[k].status == CV_OK) {
            s->masses[k].status = CV_UNDECIDED;
            s->masses[k].why = why;
        }
    }
}

static cv_status walk(dg_sweep *s, const velocities *v, dg_curve *curves)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < v->count && status == CV_OK; i++) {
        dg_curve *here = &curves[i % 2];
        status = dg_curve_at(here, &s->probe, v->at[i], s->x_floor, s->why);
        if (status != CV_OK)
            break;
        check_counts(s, here);
        if (i == 0)
            for (size_t k = 0; k < s->mass_count; k++)
                s->masses[k].count_at_min = dg_crossing_balance(here, s->masses[k].x);
        else
            status = dg_cell_search(s, &curves[(i + 1) % 2], here);
    }
    return status;
}

cv_status dg_sweep_run(dg_sweep *s, double alpha_min, double alpha_max)
{
    velocities v = {0};
    dg_curve curves[2];
    memset(curves, 0, sizeof curves);
    cv_status status = choose(&v, s, alpha_min, alpha_max);
    if (status == CV_OK)
        status = walk(s, &v, curves);
    dg_curve_clear(&curves[0]);
    dg_curve_clear(&curves[1]);
    free(v.at);
    return status;
}
