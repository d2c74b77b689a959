/* One crossing of the curve with the real axis, followed from one velocity to another. */
#ifndef CRITVEL_DGREEN_CROSSING_FOLLOW_H
#define CRITVEL_DGREEN_CROSSING_FOLLOW_H

#include "dgreen/curve.h"

typedef struct {
    double alpha;
    dg_crossing at;
} dg_followed;

/* Fills m->at for the velocity m->alpha between those of l and r, the same crossing at two velocities. alike:
 * both have the same branch points, so that positions compare. station: zero or a former one; becomes that of
 * m->alpha. Method: from the expected place in the direction where the sign change must be, with growing
 * steps. CV_UNDECIDED: there is none near. */
cv_status dg_crossing_between(dg_followed *m, dg_station *station, const dg_probe *p, const dg_followed *l,
                              const dg_followed *r, int alike, cv_message *why);

#endif
