#include "dgreen/crossing_follow.h"

#include <math.h>

/* Search near the expected position: first step and last distance */
static const double FIRST_STEP = 0.05, LAST_STEP = 8;

/* Where the crossing is expected at the station's velocity: q for the position plus "step". */
static double expected(const dg_station *station, const dg_followed *l, const dg_followed *r, int alike,
                       double step)
{
    const double part = (station->alpha - l->alpha) / (r->alpha - l->alpha);
    if (alike)
        return dg_station_frequency(station,
                                    l->at.position + part * (r->at.position - l->at.position) + step);
    return exp(log(l->at.q) + part * log(r->at.q / l->at.q) + step);
}

cv_status dg_crossing_between(dg_followed *m, dg_station *station, const dg_probe *p, const dg_followed *l,
                              const dg_followed *r, int alike, cv_message *why)
{
    dg_node here, next;
    cv_status status = dg_station_set(station, p->branches, m->alpha, why);
    if (status == CV_OK)
        status = dg_probe_at(&here, p, m->alpha, expected(station, l, r, alike, 0));
    if (status != CV_OK)
        return status;
    const int up = (here.im > 0) == (l->at.direction > 0); /* the crossing lies above */
    for (double step = FIRST_STEP; step < LAST_STEP; step *= 2, here = next) {
        const double q = expected(station, l, r, alike, up ? step : -step);
        next = here;
        if (q != here.q)
            status = dg_probe_at(&next, p, m->alpha, q);
        if (status != CV_OK)
            return status;
        if ((next.im > 0) != (here.im > 0))
            return dg_curve_cross(&m->at, p, station, up ? &here : &next, up ? &next : &here);
    }
    return CV_UNDECIDED;
}
