/* The (alpha, q) plane cut along everything near which zeta is not smooth, in coordinates in which it is.
 *
 * Near a branch curve q_b(alpha) (branch_curves.h) zeta behaves like 1/sqrt(q - q_b - i eps), eps being the
 * modal damping of the wave, so that Im zeta changes its sign at any distance between eps and 1 from q_b: it
 * is smooth in log(distance) down to eps, and in the distance itself below. Likewise in alpha near the
 * special velocities at which branch curves meet, end or reach q = 0. Beyond a cusp the two branch points
 * that met there are complex, at distance (alpha - alpha_c)^(3/2) from the real axis; their real part goes on
 * as a "ghost" curve until they are far off.
 *
 *     column  between neighbouring special velocities; two sides, graded towards its ends
 *     strip   between neighbouring curves (and q = 0, and q_top); two sides, graded towards its curves
 *     block   one side of a column times one side of a strip: the unit square (u, t)
 *
 *     alpha = end + direction * a (e^{u X} - 1), u = 0 at the special velocity, u = 1 in mid-column
 *     q     = curve + direction * b (e^{t Y} - 1), t = 0 at the curve, t = 1 in mid-strip
 *
 * with a, b a tenth of the damping there; X and Y follow from the widths. All quantities are dimensionless.
 *
 * Without damping b is what doubles resolve, curves keep a gap, and the surroundings of each special
 * velocity, so near that the curves meeting there cannot be told apart, are a closed column: a is its half
 * width.
 */
#ifndef CRITVEL_SEMIANALYTIC_MAP_H
#define CRITVEL_SEMIANALYTIC_MAP_H

#include <stddef.h>

#include "semianalytic/branch_curves.h"

enum { SA_MAP_CURVES_MAX = 30 };

/* Straight continuation of a branch curve beyond its cusp. */
typedef struct {
    double alpha, q, slope; /* the cusp, q signed; dq/dalpha there */
    double width;           /* the branch points are width |alpha - alpha_c|^(3/2) off the real axis */
    double damping;         /* of the wave at the cusp */
    double end;             /* velocity at which it may be forgotten */
} sa_ghost;

typedef struct {
    double alpha_low, alpha_high;
    double length_low, length_high; /* grading lengths a */
    int count;                      /* curves, q ascending, without q = 0 and q_top */
    int curve[SA_MAP_CURVES_MAX];   /* arc of the branch curves, or -1 - number of a ghost */
    double q_top;
    int closed;  /* undamped tracks: around a special velocity, not searched */
    int special; /* of a closed column: which special velocity of the branch curves is inside, or below */
} sa_column;

enum {
    SA_COLUMN_PLAIN = -1,
    SA_COLUMN_SEVERAL = -2
}; /* none of them: only a ghost meets a curve; more than one */

typedef struct {
    sa_branch_curves curves;
    double eta_p, eta_b, eta_f;
    int undamped; /* all three are zero */
    size_t ghost_count;
    sa_ghost *ghost;
    size_t count;
    sa_column *column; /* alpha ascending, without gaps */
} sa_map;

/* Prepares the map for 0 < alpha_min < alpha_max and the dampings of params, which must have passed
 * cv_params_check. CV_FAILED: out of memory or a track with more than
 * SA_MAP_CURVES_MAX curves at one velocity; nothing is then allocated. */
cv_status sa_map_build(sa_map *out, const cv_params *params, double alpha_min, double alpha_max,
                       cv_message *why);
void sa_map_clear(sa_map *map);

/* All curves at one velocity. Index 0 is q = 0 and count - 1 is q_top. */
typedef struct {
    double alpha, alpha_u; /* alpha_u = d alpha / du */
    int count;
    double q[SA_MAP_CURVES_MAX + 2], slope[SA_MAP_CURVES_MAX + 2]; /* slope = dq/dalpha */
    double length[SA_MAP_CURVES_MAX + 2], length_slope[SA_MAP_CURVES_MAX + 2];
    double gap[SA_MAP_CURVES_MAX + 2], gap_slope[SA_MAP_CURVES_MAX + 2];
} sa_map_node;

/* side 0: towards alpha_low, 1: towards alpha_high. CV_FAILED when a wave cannot be computed. */
cv_status sa_map_node_at(sa_map_node *out, const sa_map *map, size_t column, int side, double u);

/* The same at a given velocity (side and u are chosen); clamped to the range of the map. */
cv_status sa_map_node_of(sa_map_node *out, const sa_map *map, double alpha);

/* X and Y: extent of a block in natural logarithms. strip = 0 .. count - 2; the last one has only side 0. */
double sa_map_column_extent(const sa_column *column, int side);
double sa_map_strip_extent(const sa_map_node *node, int strip, int side);
int sa_map_strip_sides(const sa_map_node *node, int strip);

typedef struct {
    double alpha, q;
    double alpha_u, q_u, q_t; /* partial derivatives; alpha_t = 0 */
} sa_map_point;

void sa_map_point_at(sa_map_point *out, const sa_map_node *node, int strip, int side, double t);

/* The strip, its side and t of 0 < q < q_top at a node; within the gap of a curve t is 0. */
void sa_map_locate(int *strip, int *side, double *t, const sa_map_node *node, double q);

#endif
