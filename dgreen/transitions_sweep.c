#include "dgreen/transitions_sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/transitions_cell.h"
#include "dgreen/velocities.h"

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

static cv_status walk(dg_sweep *s, const dg_velocities *v, dg_curve *curves)
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
    dg_velocities v = {0};
    dg_curve curves[2];
    memset(curves, 0, sizeof curves);
    cv_status status =
        dg_velocities_choose(&v, s->probe.branches, alpha_min, alpha_max, s->probe.look, s->why);
    if (status == CV_OK)
        status = walk(s, &v, curves);
    dg_curve_clear(&curves[0]);
    dg_curve_clear(&curves[1]);
    free(v.at);
    return status;
}
