/* N and the growth rate over the plane of mass ratio and velocity.
 *
 * One D-decomposition curve per velocity serves all mass ratios: as eta_M grows from 0, where N = 0, N
 * changes by two wherever 1/eta_M passes a crossing of the curve, and there a pair of roots enters the right
 * half-plane and is followed (dgreen/path.h). At every mass ratio N by the winding must equal the roots that
 * are there. */
#ifndef CRITVEL_DGREEN_MAP_H
#define CRITVEL_DGREEN_MAP_H

#include "dgreen/sampler.h"

typedef struct {
    int count;     /* roots with Re qbar > 0; -1: undecided */
    double growth; /* greatest Re qbar among them; 0 when there is none, NAN when it could not be followed */
    double frequency; /* Im qbar of that root; 0, NAN likewise */
} dg_map_cell;

/* One velocity: cells[i] for mass_ratios[i], ascending and > 0. Growth rates to six digits. CV_UNDECIDED: the
 * curve could not be sampled; all cells are then undecided. */
cv_status dg_map_row(dg_map_cell *cells, dg_sampler *s, double alpha, size_t mass_count,
                     const double *mass_ratios, cv_message *why);

#endif
