/* One velocity with its branch points: distances in q as zeta sees them. All dimensionless. */
#ifndef CRITVEL_DGREEN_CURVE_STATION_H
#define CRITVEL_DGREEN_CURVE_STATION_H

#include "dgreen/branch_points.h"

typedef struct {
    double alpha;
    size_t count, hard_count; /* branch points, and those among them that are not soft */
    dg_branch_point *points;  /* ascending in q */
} dg_station;

/* Fills the station for alpha; *s must be zero or a former station of the same branch curves, whose memory is
 * used again. CV_FAILED: out of memory. */
cv_status dg_station_set(dg_station *s, const dg_branch_curves *b, double alpha, cv_message *why);
void dg_station_clear(dg_station *s);

/* A measure of q that grows with q and is comparable between neighbouring velocities where q itself is not,
 * because branch points move: log q + sum over hard branch points of asinh(distance/width). */
double dg_station_position(const dg_station *s, double q);
/* The q of that position, to double precision. */
double dg_station_frequency(const dg_station *s, double position);

/* Distance from q to the nearest branch point or to 0, at least the width of that point. */
double dg_station_scale(const dg_station *s, double q);
/* The nearest hard branch point; NULL when there is none. */
const dg_branch_point *dg_station_nearest(const dg_station *s, double q);
/* Between a and b, half way in the logarithm of the distance to the nearest branch point. */
double dg_station_middle(const dg_station *s, double a, double b);

#endif
