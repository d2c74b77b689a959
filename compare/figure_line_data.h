/* Instability lines as data of a picture. */
#ifndef CRITVEL_COMPARE_FIGURE_LINE_DATA_H
#define CRITVEL_COMPARE_FIGURE_LINE_DATA_H

#include "compare/figure_velocities.h"

/* The part of the plane: low is the file's lowest velocity, begin and end are those of the picture. */
typedef struct {
    double begin, low, end;    /* alpha */
    double lightest, heaviest; /* eta_M */
} cmp_line_range;

cmp_line_range cmp_line_range_of(const cmp_velocities *v, const cv_case *c);

/* The velocities over which branches go. */
typedef struct {
    size_t count;
    double (*ends)[2];
} cmp_extents;

/* Adds the block "NAME LEVEL" (from 1 on): alpha, eta_M, q along each branch of the semianalytical method's
 * lines at one damping, branches apart by an empty line. *branches becomes their number; without any
 * there is no block. What is undecided about them is noted in the picture. extents NULL, or
 * the branches are added to it; the caller frees ends. */
cv_status cmp_line_data(cmp_picture *p, const char *name, size_t *branches, cmp_extents *extents,
                        const cv_params *params, const cmp_line_range *range, size_t level, cv_message *why);

#endif
