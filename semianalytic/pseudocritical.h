/* Pseudocritical velocities of the moving force: finite local extrema over alpha of the undamped steady
 * deflection (extremes.h), for three curves that have three different answers: the largest deflection over
 * the whole rail, the largest uplift over the whole rail, and the size of the deflection at the active point.
 * Each is a local maximum of what its curve measures; the valleys between are not listed, nor are the
 * resonance velocities, where it is infinite. All quantities are dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_PSEUDOCRITICAL_H
#define CRITVEL_SEMIANALYTIC_PSEUDOCRITICAL_H

#include <stddef.h>

#include "semianalytic/extremes.h"

typedef enum { SA_CURVE_MAX, SA_CURVE_MIN, SA_CURVE_ACTIVE_POINT, SA_CURVES } sa_curve;

typedef struct {
    sa_curve of;
    long double alpha;
    double error; /* the derivative changes sign, beyond its rounding errors, between alpha - error and alpha
                     + error */
    double deflection; /* w there: of the maximum, the minimum (negative) or the active point */
    int ahead;         /* side of the force where it is found, 1 ahead; for the active point 1 */
    double distance;   /* |xi| there; INFINITY where it is only approached far from the force */
} sa_pseudocritical;

typedef struct {
    size_t count;
    sa_pseudocritical *item; /* by curve, then alpha ascending */
} sa_pseudocritical_list;

/* All of them for alpha_min <= alpha <= alpha_max, 0 < alpha_min. Velocities are visited in steps that are a
 * fraction of the distance to the nearest velocity, real or complex, at which two wave numbers meet, so that
 * peaks of any sharpness show; those within a relative 1e-6 of a resonance velocity are taken as part of it.
 * params must have passed cv_params_check; dampings are ignored. CV_FAILED: out of memory. */
cv_status sa_pseudocritical_find(sa_pseudocritical_list *out, const cv_params *params, double alpha_min,
                                 double alpha_max, cv_message *why);
void sa_pseudocritical_clear(sa_pseudocritical_list *list);

/* "max", "min", "active point" */
const char *sa_curve_text(sa_curve of);

/* One curve at one velocity: value >= 0 of what it measures, its slope over alpha and the place. */
void sa_curve_at(sa_summit *out, const sa_undamped *s, sa_curve of);

#endif
