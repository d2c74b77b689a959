/* Largest and smallest undamped steady deflection of the rail under a moving force, over the whole infinite
 * rail: the waves do not decay, so that far away the supremum is the sum of their amplitudes (for wave
 * numbers that are not commensurable), and near the force finitely many peaks can exceed it. */
#ifndef CRITVEL_SEMIANALYTIC_EXTREMES_H
#define CRITVEL_SEMIANALYTIC_EXTREMES_H

#include "semianalytic/undamped.h"

/* A supremum of sign * w over the rail. */
typedef struct {
    long double value; /* of sign * w, >= 0 */
    long double slope; /* d value / dalpha */
    int ahead;         /* side of the force, 1 ahead */
    long double
        distance; /* |xi| where it is attained; INFINITY where it is only approached far from the force */
} sa_summit;

/* The supremum over the rail of w (sign = 1: downward, like the force) or of -w (sign = -1). Every maximum
 * along the rail is visited up to the distance beyond which the decaying parts cannot lift the waves above
 * the result by more than 1e-14 of the deflection; between samples five to the radian of the shortest wave
 * that brings at least 1e-4 of the curvature (weaker ones make no maxima of their own). */
void sa_summit_find(sa_summit *out, const sa_undamped *s, int sign);

/* Follows a local maximum of sign * w to another velocity, from its distance there; 1 when there is one
 * nearby. A far summit stays far. */
int sa_summit_follow(sa_summit *to, const sa_summit *from, const sa_undamped *s, int sign);

#endif
