#include "dgreen/path.h"

#include <math.h>

/* Largest step relative to the distance from the nearest branch point */
static const double STEP = 0.15;
/* The corrector may move at most this part of the step. */
static const double CORRECTION = 0.4;
static const double SMALLEST = 1e-5;
enum { STEPS = 3000, CORRECTIONS = 3, POLISHES = 6 };

/* Damping has moved a branch point to -width + i q. */
double dg_path_room(const dg_station *s, double complex qbar)
{
    double distance = cabs(qbar);
    for (size_t i = 0; i < s->count; i++)
        distance = fmin(distance, cabs(qbar - CMPLX(-s->points[i].width, s->points[i].q)));
    return distance;
}

cv_status dg_path_start(dg_path *p, const dg_probe *probe, const dg_station *station, double q)
{
    static const double ASIDE = 1e-3;
    p->station = station;
    const double aside = ASIDE * dg_station_scale(station, q);
    const cv_status status =
        dg_continued_start(&p->at, probe->follow, probe->track, station->alpha, q, aside);
    if (status == CV_OK)
        p->value = dg_continued_zeta(&p->at);
    return status;
}

cv_status dg_path_enter(dg_path *p, const dg_probe *probe, const dg_curve *curve, const dg_crossing *crossing)
{
    static const double BESIDE = 1e-8;
    if (isfinite(crossing->x))
        return dg_path_start(p, probe, &curve->at, crossing->q);
    dg_path other;
    const cv_status below = dg_path_start(p, probe, &curve->at, crossing->q * (1 - BESIDE));
    const cv_status above = dg_path_start(&other, probe, &curve->at, crossing->q * (1 + BESIDE));
    if (above == CV_OK && (below != CV_OK || creal(other.value) > creal(p->value)))
        *p = other; /* zeta is nearly real on this side */
    return above == CV_OK ? CV_OK : below;
}

/* One step to the value "next"; *accepted tells whether prediction and correction agree. */
static void step(dg_path *p, int *accepted, double complex next, double complex slope)
{
    dg_path moved = *p;
    const double complex predicted = (next - p->value) / slope;
    double complex correction = 0;
    *accepted = dg_continued_move(&moved.at, p->at.qbar + predicted) == CV_OK;
    for (int i = 0; i < CORRECTIONS && *accepted; i++) {
        moved.value = dg_continued_zeta(&moved.at);
        const double complex change = (next - moved.value) / slope;
        correction += change;
        *accepted = cabs(correction) <= CORRECTION * cabs(predicted) &&
                    dg_continued_move(&moved.at, moved.at.qbar + change) == CV_OK;
    }
    if (!*accepted)
        return;
    moved.value = dg_continued_zeta(&moved.at);
    *p = moved;
}

/* Newton at the target */
static cv_status polish(dg_path *p, double complex target)
{
    double last = HUGE_VAL;
    for (int i = 0; i < POLISHES; i++) {
        double complex slope;
        cv_status status = dg_continued_slope(&slope, &p->at, dg_path_room(p->station, p->at.qbar));
        const double complex change = (target - p->value) / slope;
        if (status != CV_OK || !(cabs(change) < last / 2))
            return status;
        last = cabs(change);
        status = dg_continued_move(&p->at, p->at.qbar + change);
        if (status != CV_OK)
            return status;
        p->value = dg_continued_zeta(&p->at);
    }
    return CV_OK;
}

cv_status dg_path_go(dg_path *p, double complex target)
{
    double shrink = 1;
    for (int i = 0; i < STEPS; i++) {
        double complex slope;
        int accepted;
        const double reach = dg_path_room(p->station, p->at.qbar);
        if (dg_continued_slope(&slope, &p->at, reach) != CV_OK)
            return CV_UNDECIDED;
        const double whole = cabs((target - p->value) / slope), most = shrink * STEP * reach;
        const double part = whole <= most ? 1 : most / whole;
        step(p, &accepted, part < 1 ? p->value + part * (target - p->value) : target, slope);
        if (accepted && part == 1)
            return polish(p, target);
        shrink = accepted ? fmin(1, 2 * shrink) : shrink / 2;
        if (!(shrink > SMALLEST))
            return CV_UNDECIDED;
    }
    return CV_UNDECIDED;
}
