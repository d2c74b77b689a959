/* Where zeta(iq), q = 0 .. infinity, crosses the positive real axis at one velocity, and the number of
 * unstable roots that follows from it: with qbar = i q,
 *
 *     N(alpha, eta_M) = 2 (crossings with Re zeta > 1 / eta_M where Im zeta goes from + to - as q grows,
 * minus those where it goes from - to +)
 *
 * is the number of roots of 1 - eta_M zeta with Re qbar > 0 (argument principle; zeta ~ - sqrt(q) at
 * infinity). Without damping zeta(iq) goes through infinity at a branch point: a crossing there has re =
 * INFINITY, and one that is nearer to it than doubles resolve has the re of the rim of that gap. */
#ifndef CRITVEL_SEMIANALYTIC_CROSSINGS_H
#define CRITVEL_SEMIANALYTIC_CROSSINGS_H

#include "semianalytic/map_field.h"

typedef struct {
    double q;
    double re, re_error; /* Re zeta there and its uncertainty */
    int direction;       /* 1: Im zeta goes from + to -, -1: from - to + */
} sa_crossing;

typedef struct {
    size_t count, room;
    sa_crossing *items; /* no particular order */
} sa_crossings;

/* All crossings with Re zeta > re_low > 0 at alpha, within the range of the map. CV_UNDECIDED: two of them
 * too close to be told apart, or zeta not to be had; then, and on failure, the list is empty. */
cv_status sa_crossings_find(sa_crossings *out, const sa_map *map, sa_field *field, double alpha,
                            double re_low, cv_message *why);
/* The same from shorter first intervals, by 1.7 for each refinement. */
cv_status sa_crossings_find_finer(sa_crossings *out, const sa_map *map, sa_field *field, double alpha,
                                  double re_low, int refinement, cv_message *why);
void sa_crossings_clear(sa_crossings *list);

/* N for 1 / eta_M = level >= re_low. CV_UNDECIDED: a crossing lies at that level within its uncertainty. */
cv_status sa_crossings_count(int *roots, const sa_crossings *list, double level);

#endif
