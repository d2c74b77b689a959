/* The D-decomposition curve zeta(alpha, i q), q = 0 .. infinity, at one velocity: sampled once, it serves
 * every mass ratio. Its crossings of the real axis decide the number of unstable roots. All dimensionless. */
#ifndef CRITVEL_DGREEN_CURVE_H
#define CRITVEL_DGREEN_CURVE_H

#include "dgreen/branch_points.h"
#include "dgreen/curve_probe.h"

/* A zero of Im zeta with x = Re zeta. */
typedef struct {
    double q_low, q_high; /* the sign of Im zeta changes between them, certified */
    double q, x;          /* between q_low and q_high, x_low and x_high: linear interpolation */
    double x_low, x_high; /* range of Re zeta in the bracket */
    int direction;        /* +1: Im zeta goes from + to - as q grows; -1: from - to + */
    double dq, dx;        /* d q/d alpha and d x/d alpha along Im zeta = 0 */
    double position;      /* grows with q; comparable between neighbouring velocities where q itself is not,
                             because branch points move: sum over them of asinh(distance/width) */
    double scale;         /* distance in q over which zeta changes here */
} dg_crossing;

/* A place where |Im zeta| has a small minimum above zero: two crossings may be born there. */
typedef struct {
    double q, re, im;
    double d_im; /* d Im zeta/d alpha of the minimum */
} dg_dip;

/* Without damping: a hard branch point, where zeta ~ C/sqrt(q - q_b) goes to infinity. */
typedef struct {
    dg_dd q;
    int waves_above; /* its waves run for larger q, or (0) for smaller */
    int real;        /* sign of Re zeta beside it on the side without waves */
    int imaginary;   /* sign of Im zeta beside it on the side of the waves */
} dg_pole;

typedef struct {
    dg_station at;
    double x_floor; /* crossings and dips with smaller Re zeta are not listed */
    size_t node_count, node_room;
    dg_node
        *nodes; /* ascending in q; between consecutive ones zeta does not go around any real x >= x_floor */
    size_t crossing_count, crossing_room;
    dg_crossing *crossings; /* ascending in q, all with x >= x_floor */
    size_t dip_count, dip_room;
    dg_dip *dips;
    size_t pole_count;
    dg_pole *poles; /* ascending in q; none with damping */
} dg_curve;

/* Method: nodes at logarithmic distances from q = 0 and, on both sides, from every branch point, down to a
 * small part of its width, because zeta is smooth in the logarithm of that distance (but not towards branch
 * points too weak to bring zeta to the positive real axis from where it is); then more nodes where Im
 * zeta is not what the cubic through the neighbouring nodes leads to expect, where |Im zeta| has a minimum
 * that may hide two zeros, and where the curve turns. Ends: q so small that |zeta| < x_floor/2 with |zeta| ~
 * q^2 before it, and so large that the bare rail (Re zeta < 0, Im zeta < 0) rules. Not found: two zeros of Im
 * zeta between consecutive nodes if neither |Im zeta| shows a minimum there nor the cubic a surprise. x_floor
 * > 0. Without damping there are nodes beside every pole, at neighbouring doubles where Im zeta lets them.
 * Between them zeta goes to infinity: a crossing there has x = x_low = x_high = INFINITY; and where Im zeta
 * beside the pole has not yet the sign that it has on the pole, there is one more, with x = Re zeta. *c must
 * be zero or a former curve, whose memory is used again. CV_UNDECIDED: a sign could not be certified, or one
 * of the ends could not be reached. */
cv_status dg_curve_at(dg_curve *c, const dg_probe *p, double alpha, double x_floor, cv_message *why);
void dg_curve_clear(dg_curve *c);

/* Narrows the brackets of those crossings that leave open on which side of x they pass. CV_UNDECIDED: to
 * double precision one of them passes through x. */
cv_status dg_curve_separate(dg_curve *c, const dg_probe *p, double x, cv_message *why);
/* The same by brackets beyond double precision (dg_line_at_alpha). CV_UNDECIDED: x
 * is the crossing to nearly all digits of a double, or it is not found. */
cv_status dg_curve_separate_exactly(dg_curve *c, const dg_probe *p, double x, cv_message *why);

/* Narrows [a, b], where Im zeta changes sign, and fills the crossing, its slopes included. */
cv_status dg_curve_cross(dg_crossing *x, const dg_probe *p, const dg_station *at, const dg_node *a,
                         const dg_node *b);

/* Whether q is above the pole (the pole below q), exactly; and the pole between two consecutive nodes, or
 * NULL. */
int dg_pole_below(const dg_pole *pole, double q);
const dg_pole *dg_curve_pole(const dg_curve *c, const dg_node *a, const dg_node *b);

#endif
