/* Samples of the three dispersion branches over p = 0 .. p_max, dense enough that between neighbours every
 * branch is resolved: the spacing is a fraction of the distance to the nearest singularity of omega_k in the
 * complex p plane, which is where two branches meet or where omega vanishes. */
#ifndef CRITVEL_SEMIANALYTIC_BRANCH_GRID_H
#define CRITVEL_SEMIANALYTIC_BRANCH_GRID_H

#include <stddef.h>

#include "semianalytic/dispersion.h"

typedef struct {
    long double p;
    sa_wave wave[SA_BRANCHES];
} sa_branch_node;

typedef struct {
    sa_dispersion track;
    size_t count, room;
    sa_branch_node *node; /* p ascending from 0 */
} sa_branch_grid;

/* Beyond the last node every branch is in its asymptotic regime: |omega'| below alpha_min and falling (flat
 * branches), above alpha_max and growing (rail), or growing towards sqrt(eta_s/mu_b) (ballast with
 * shear stiffness). CV_FAILED when out of memory or when the track is not one; grid is then empty. */
cv_status sa_branch_grid_build(sa_branch_grid *grid, const sa_dispersion *track, double alpha_min,
                               double alpha_max, cv_message *why);
void sa_branch_grid_clear(sa_branch_grid *grid);

/* A function of p made of the waves at p, with its derivative. */
typedef struct {
    int kind; /* 1: omega_k''; 2: omega_k' - sign * omega_l' */
    int k, l, sign;
} sa_branch_function;

/* All roots p in (0, p_max) of the function, ascending; *out is allocated, caller frees. Pairs of roots
 * between two nodes are found by the extremum between them. */
cv_status sa_branch_grid_roots(long double **out, size_t *count, const sa_branch_grid *grid,
                               const sa_branch_function *function);

#endif
