/* Velocities at which a range is looked at first. All dimensionless. */
#ifndef CRITVEL_DGREEN_VELOCITIES_H
#define CRITVEL_DGREEN_VELOCITIES_H

#include "dgreen/branch_points.h"

/* Growing array; {0} is empty, free(at) ends it. */
typedef struct {
    size_t count, room;
    double *at; /* ascending */
} dg_velocities;

/* Fills *v with alpha_min, alpha_max and velocities between them: in small steps, and graded logarithmically
 * towards every special velocity, down to a part of its width. look: 0 is normal, each further one halves the
 * steps. CV_FAILED: out of memory. */
cv_status dg_velocities_choose(dg_velocities *v, const dg_branch_curves *branches, double alpha_min,
                               double alpha_max, int look, cv_message *why);

/* Between low and high, half way in the logarithm of the distance to the nearest special velocity. */
double dg_velocities_middle(const dg_branch_curves *branches, double low, double high);

#endif
