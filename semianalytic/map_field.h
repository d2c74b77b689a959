/* zeta and its derivatives in the coordinates of a block of the map, computed once per point. */
#ifndef CRITVEL_SEMIANALYTIC_MAP_FIELD_H
#define CRITVEL_SEMIANALYTIC_MAP_FIELD_H

#include "semianalytic/map.h"
#include "semianalytic/zeta.h"

/* zeta at one point. re_error, im_error are bounds; the derivatives have none. */
typedef struct {
    double u, t, alpha, q;
    double re, im, re_error, im_error;
    double re_u, re_t, im_u, im_t;
    double re_alpha, re_q, im_alpha, im_q;
} sa_sample;

typedef struct sa_field sa_field;

/* map and track must outlive the field, which is for one thread. Nothing is asked where Re zeta < re_floor.
 * NULL when out of memory. */
sa_field *sa_field_new(const sa_map *map, const sa_track *track, double re_floor);
void sa_field_free(sa_field *field); /* NULL allowed */
sa_counts sa_field_counts(const sa_field *field);

/* Chooses the block that u and t refer to. */
void sa_field_block(sa_field *field, size_t column, int side_u, int strip, int side_t);

/* How well points of lines Im zeta = 0 are placed by sa_field_at, in u and t, and how accurate Re zeta is
 * there, relative to itself or to re_floor. It is SA_FIELD_RESOLUTION until this is called. */
#define SA_FIELD_RESOLUTION 1e-2
void sa_field_resolution(sa_field *field, double resolution);

/* Any point of the block, in double precision where that is enough to place a line that passes here, else in
 * more. CV_UNDECIDED: no precision is; CV_FAILED: a library failed. */
cv_status sa_field_at(sa_sample *out, sa_field *field, double u, double t);

/* A corner of a cell: remembered, Im zeta known to a tenth, so that its sign is certain, and Re zeta to a
 * hundredth of itself or re_floor. */
cv_status sa_field_corner(sa_sample *out, sa_field *field, double u, double t);

/* Curves at u; valid until the next call. NULL when a wave cannot be computed. */
const sa_map_node *sa_field_node(sa_field *field, double u);

/* A point given by its node instead of its u, for searches along q; not remembered. */
cv_status sa_field_at_node(sa_sample *out, sa_field *field, const sa_map_node *node, int strip, int side_t,
                           double t, int certain);

#endif
