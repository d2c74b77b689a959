/* Polylines through points of a curve that is a function of the frequency, fine where the curve bends. For
 * stability_curve.c and for pictures. */
#ifndef CRITVEL_DGREEN_POLYLINE_H
#define CRITVEL_DGREEN_POLYLINE_H

#include "dgreen/stability_curve.h"

/* Fills re and im for the q of the vertex. */
typedef cv_status dg_vertex_rule(dg_vertex *v, void *context);

/* Adds a vertex at the end. */
cv_status dg_polyline_push(dg_polyline *line, const dg_vertex *v, cv_message *why);

/* Adds vertices, half way between two in the logarithm of the distance from the station's branch points,
 * until the line turns as little as dg_stability_curve_at says; then leaves out those that its shape does not
 * need. The two vertices around a change of the sign of im stay. */
cv_status dg_polyline_shape(dg_polyline *line, const dg_station *station, dg_vertex_rule *rule, void *context,
                            cv_message *why);

void dg_polyline_clear(dg_polyline *line);

#endif
