/* The dispersion branches cut into stretches, and the families of branch points on them. Shared by
 * branch_points.c and branch_points_special.c only. All dimensionless. */
#ifndef CRITVEL_DGREEN_BRANCH_POINTS_CURVES_H
#define CRITVEL_DGREEN_BRANCH_POINTS_CURVES_H

#include "dgreen/branch_points.h"
#include "dgreen/branch_points_wave.h"

typedef struct {
    double p, group, curvature;
} dg_wave_sample;

/* Growing array of samples, ascending in p */
typedef struct {
    size_t count, room;
    dg_wave_sample *at;
} dg_wave_table;

/* Branch points with one sign of p on one stretch: samples first .. last of the branch's table, between which
 * group is monotone and takes sign * alpha for every alpha in [alpha_low, alpha_high]. */
typedef struct {
    int branch, sign;
    size_t first, last;
    double alpha_low, alpha_high;
} dg_family;

typedef struct {
    int branch, cusp; /* cusp 1: group stationary; 0: peak of the curvature */
    double p, omega, group;
    double scale;                 /* cusp: d^3 omega/dp^3; peak: curvature */
    double group_low, group_high; /* peak: between them, with room, lie the group velocities on both sides */
} dg_bend;

enum { DG_MAX_FAMILIES = 64, DG_MAX_BENDS = 64 };

struct dg_branch_curves {
    const dg_track *track;
    dg_wave_table tables[DG_WAVE_BRANCHES];
    size_t family_count, bend_count, special_count, special_room;
    dg_family families[DG_MAX_FAMILIES];
    dg_bend bends[DG_MAX_BENDS];
    dg_special_velocity *specials;
};

/* The branch point of that family at alpha in [alpha_low, alpha_high]. */
void dg_family_point(dg_branch_point *out, const dg_branch_curves *b, size_t family, double alpha);

/* Fills the tables, families and bends. */
cv_status dg_branch_curves_fill(dg_branch_curves *b, double alpha_min, double alpha_max, cv_message *why);

/* Fills the special velocities; families must be there. */
cv_status dg_branch_curves_specials(dg_branch_curves *b, double alpha_min, double alpha_max, cv_message *why);

#endif
