/* More points of a D-decomposition curve, so that it is smooth in a window that stretches it. */
#ifndef CRITVEL_COMPARE_CURVE_SMOOTH_H
#define CRITVEL_COMPARE_CURVE_SMOOTH_H

#include "dgreen/stability_curve.h"

/* z = eta_M zeta at qbar = delta + i q, in a window left <= Re z <= right, |Im z| <= top. */
typedef struct {
    double alpha, eta_M, delta;
    double left, right, top;
} cmp_window;

/* Puts vertices between those of the line, until chords inside the window are shorter than about a hundredth
 * of it. The line stays ascending in q. */
cv_status cmp_curve_smooth(dg_polyline *line, const dg_sampler *sampler, const cmp_window *w,
                           cv_message *why);

#endif
