/* A number, a range or an even row of numbers, from the command line: "0.3", "0.1:0.5" or "0.1:0.5:41"
 * (first:last:how many). */
#ifndef CRITVEL_DGREEN_GRID_H
#define CRITVEL_DGREEN_GRID_H

#include "common/number.h"

enum { DG_GRID_MAX = 10000 };

typedef struct {
    int given;
    long count; /* 1 .. DG_GRID_MAX; 0: a range */
    cv_number first, last;
} dg_grid;

void dg_grid_init(dg_grid *g);
void dg_grid_clear(dg_grid *g);

/* CV_BAD_INPUT: not of one of the three forms, fewer than two points or too many, last <= first. */
cv_status dg_grid_parse(dg_grid *g, const char *text, cv_message *why);

/* Point i (not of a range) of 0 .. count-1 in even steps, the ends exact. to: initialised. */
void dg_grid_linear(cv_number *to, const dg_grid *g, long i);
/* The same in even steps of the logarithm, in double, the ends rounded once; first > 0. */
double dg_grid_logarithmic(const dg_grid *g, long i);

#endif
