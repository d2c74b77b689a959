/* Tests on one rectangular cell of a block: five samples of a function with its gradient. They replace a
 * proof by the smoothness that the coordinates of map.h give: each compares what the corners predict for the
 * centre with what is found there. All are invariant under scaling of the function. */
#ifndef CRITVEL_SEMIANALYTIC_MAP_CELL_H
#define CRITVEL_SEMIANALYTIC_MAP_CELL_H

#include "semianalytic/map_field.h"

/* Order of the points: (u0, t0), (u1, t0), (u0, t1), (u1, t1), centre. */
enum { SA_CELL_POINTS = 5, SA_CELL_CORNERS = 4 };

/* Derivatives are per side of the cell, that is times its size. */
typedef struct {
    double f[SA_CELL_POINTS], f_u[SA_CELL_POINTS], f_t[SA_CELL_POINTS];
} sa_cell_values;

/* 1 when the function keeps its sign in the cell: it has one sign at all five points, and log|f|, which has a
 * pole at every zero of f in or near the cell, is at the centre what a cubic through the corners predicts, up
 * to "tolerance", and its slopes are below "steepest". roughness: mismatch of the slope of log|f| along u and
 * t (infinite where signs differ); the cell is best split across the larger. */
int sa_cell_one_signed(double roughness[2], const sa_cell_values *v, double tolerance, double steepest);

/* 1 when the function is monotone along u (axis 0) or t (1): its derivative has one sign, varies little and
 * smoothly, and agrees with the differences of the values, so that it does not turn between the points. */
int sa_cell_steady(const sa_cell_values *v, int axis);

/* 1 when the rise over an interval lies between what the slopes at its ends (per length of the interval)
 * give, or nearly so */
int sa_slopes_fit(double rise, double slope0, double slope1);

/* 1 when the cubic with these end values and slopes (per length of the interval) keeps a clear distance from
 * zero. */
int sa_cubic_one_signed(double f0, double f1, double slope0, double slope1);

#endif
