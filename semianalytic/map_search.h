/* All lines Im zeta = 0 of the map, as short monotone segments. */
#ifndef CRITVEL_SEMIANALYTIC_MAP_SEARCH_H
#define CRITVEL_SEMIANALYTIC_MAP_SEARCH_H

#include "semianalytic/map_cell.h"

/* A piece of a line inside one cell: in the coordinates of the block it is a graph over the chosen axis (0:
 * u, 1: t) and Im zeta grows or falls strictly across it. */
typedef struct {
    sa_sample from, to;
    int axis;
    size_t column; /* the block, as for sa_field_block */
    int side_u, strip, side_t;
    struct {
        int along;        /* 0: along u, t is fixed; 1: along t, u is fixed */
        double low, high; /* in that coordinate */
    } edge[2];            /* the edges of the cell that hold from and to, the only zero on them */
} sa_segment;

typedef struct {
    double re_low, re_high;      /* only lines with Re zeta between these matter */
    double tolerance;            /* of sa_cell_one_signed */
    double largest_cell;         /* size of the first cells, natural logarithms of distance */
    unsigned long cells;         /* at most; 0: SA_MAP_CELLS_MAX */
    unsigned long beyond_double; /* evaluations of the field in more than double, at most; 0: any number */
    void *context;
    /* Called for each segment, in no particular order; field is set to its block. */
    cv_status (*segment)(void *context, sa_field *field, const sa_segment *segment);
    /* Called for a cell so small that it cannot be divided, in which the lines are not simple (they cross) or
     * zeta cannot be computed; centre, and the largest change of Re zeta to a corner. */
    cv_status (*unresolved)(void *context, const sa_sample *centre, double re_range);
} sa_search;

/* Subdivides every block until the lines in each cell are simple. What is left out is certain as far as Im
 * zeta and Re zeta are smooth in the coordinates of map.h on the scale of the first cells; the count of
 * unstable roots between the transitions (transitions.h) is the check. CV_UNDECIDED: more than
 * search->cells cells or search->beyond_double evaluations, or a point where no precision gives zeta. Ends
 * with the first status of a callback that is not CV_OK. */
enum { SA_MAP_CELLS_MAX = 500000 };
cv_status sa_map_search(const sa_map *map, sa_field *field, const sa_search *search);

/* The point of a segment at fraction x of its axis. */
cv_status sa_segment_point(sa_sample *out, sa_field *field, const sa_segment *segment, double x);

/* d Re zeta / dx along the segment at a point of it. */
double sa_segment_slope(const sa_segment *segment, const sa_sample *at);

#endif
