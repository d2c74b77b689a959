/* From the linked crossings of one line to its vertices. For lines*.c only. */
#ifndef CRITVEL_DGREEN_LINES_SHAPE_H
#define CRITVEL_DGREEN_LINES_SHAPE_H

#include "dgreen/lines_graph.h"

/* A piece of a line inside the range: its points in order, and how it ends. */
typedef struct {
    size_t count, room;
    dg_line_node *points;
    dg_line_exit exits[2];
    double asymptote[2], asymptote_q[2];
    int zero_mass[2];
} dg_line_piece;

cv_status dg_line_piece_push(dg_line_piece *p, const dg_line_node *point, cv_message *why);

/* The point between two nodes, one inside and one outside the range, with x = bound. */
cv_status dg_line_boundary(dg_line_node *out, dg_line_graph *g, const dg_line_node *a, const dg_line_node *b,
                           double bound);

/* Adds the piece to the result: puts its greatest x (smallest eta_M) in, leaves out what the chord error
 * allows. */
cv_status dg_line_finish(dg_line_graph *g, dg_line_piece *p);

#endif
