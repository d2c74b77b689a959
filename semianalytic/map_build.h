/* Parts of sa_map_build. */
#ifndef CRITVEL_SEMIANALYTIC_MAP_BUILD_H
#define CRITVEL_SEMIANALYTIC_MAP_BUILD_H

#include "semianalytic/map.h"

/* A velocity at which a column ends; graded: zeta is not smooth there. */
typedef struct {
    double alpha;
    int graded;
    double length; /* grading length there; 0: by the damping */
    int closes;    /* the column above is closed; special as in sa_column */
    int special;
} sa_map_cut;

typedef struct {
    size_t count, room;
    sa_map_cut *cut;
} sa_map_cuts;

cv_status sa_map_cuts_add(sa_map_cuts *cuts, double alpha, int graded);
void sa_map_cuts_sort(sa_map_cuts *cuts); /* ascending, equal ones joined */

/* Fills map->ghost from map->curves and adds where they end and what they meet. */
cv_status sa_map_ghosts(sa_map *map, sa_map_cuts *cuts);

/* Undamped tracks: replaces graded cuts, which are sorted, by the ends of closed columns around them. */
cv_status sa_map_close(const sa_map *map, sa_map_cuts *cuts);

/* Smallest distance between neighbouring curves at alpha, relative to 1 + q; 0 when one is next to q = 0. */
cv_status sa_map_narrowest(double *width, const sa_map *map, double alpha);

/* Signed q of a ghost at alpha. */
double sa_map_ghost_q(const sa_ghost *ghost, double alpha);

/* Rate at which a wave decays at the damping of the map, to first order: (eta_p (W-V)^2 + eta_b (V-U)^2 +
 * eta_f U^2) / (W^2 + mu_s V^2 + mu_b U^2); slope (may be NULL): its derivative in p. */
double sa_map_damping(double *slope, const sa_map *map, const sa_wave *wave);

/* Grading length for a damping at a place of this size: a tenth of it, but not below what doubles resolve. */
double sa_map_grading(double damping, double size);

/* Adds the velocities at which the damping along an arc dips far below its surroundings: with some of the
 * three dampings zero or much smaller, there are waves that stretch none of the other elements. */
cv_status sa_map_dips(const sa_map *map, sa_map_cuts *cuts);

/* A^2 of a wave (limit_meeting.h), times 8; damping: e for eta_p = eta_b = eta_f = 1. */
double sa_map_strength(double *damping, const sa_map *map, const sa_wave *wave);

/* Undamped tracks: distance that is kept from a curve at q. */
double sa_map_gap(double q);

/* 1 when the singularity of zeta at the branch point of this wave is too weak to matter even at its sharpest
 * (distance = damping): its height W^2 / (2 omega sqrt(2 omega'' damping)) for a mode of unit kinetic norm,
 * times q^2, is far below the Im zeta ~ eta q^3 that damping makes anywhere. So it is where a branch becomes
 * flat or nears the shear speed, W^2 ~ p^-8. Without damping: at the distance that is kept from curves,
 * against what any track radiates; what crosses the real axis nearer than that is found by crossings.h. */
int sa_map_negligible(const sa_map *map, const sa_wave *wave, double q);

/* Fills the curves and grading lengths of a column whose ends are set. CV_FAILED: too many curves, or a wave
 * cannot be computed. */
cv_status sa_map_column_fill(sa_column *column, const sa_map *map, int graded_low, int graded_high);

#endif
