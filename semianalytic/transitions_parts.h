/* Parts of transitions.h. */
#ifndef CRITVEL_SEMIANALYTIC_TRANSITIONS_PARTS_H
#define CRITVEL_SEMIANALYTIC_TRANSITIONS_PARTS_H

#include "semianalytic/map_search.h"
#include "semianalytic/transitions.h"

/* A transition in double precision. */
typedef struct {
    size_t level;
    double alpha, q;
    double jacobian[2][2]; /* d (Re zeta, Im zeta) / d (alpha, q) */
} sa_candidate;

typedef struct {
    size_t count, room;
    sa_candidate *items;
} sa_candidates;

/* The levels 1 / eta_M, and what is found on them. */
typedef struct {
    size_t count;
    const double *level;
    sa_candidates found;
    char *doubtful;      /* per level: 1 when a line touches it too closely to say */
    double *doubtful_at; /* the velocity where it does */
} sa_levels;

/* Appends every point of the segment at one of the levels. */
cv_status sa_levels_on_segment(sa_levels *levels, sa_field *field, const sa_segment *segment);

/* Newton in (alpha, q) from a candidate, with growing precision, until both have the digits. item is
 * initialised here; item->decided is CV_UNDECIDED when they are not reached. */
cv_status sa_transition_refine(sa_transition *item, sa_sweep *sweep, const sa_track *track,
                               const sa_candidate *from, const cv_number *mass_ratio, int digits);

/* A list from the candidates on one level, in any order: refined, those found twice joined, ascending, with
 * numbers of roots relative to roots_at_start, which the caller has set. */
cv_status sa_transitions_assemble(sa_transitions *list, sa_sweep *sweep, const sa_track *track,
                                  const sa_map *map, sa_field *field, const sa_candidates *found,
                                  size_t level, const cv_number *mass_ratio, int digits);

/* Adds to the reason of an undecided list of an undamped track what may be missing. */
void sa_transitions_explain_limit(sa_transitions *list);

/* Undamped tracks: appends the special velocities at which N changes, as it is counted on either side of the
 * closed columns of the map; list->items has room for one of each. Resonance velocities have all digits,
 * others those of a double. */
cv_status sa_transitions_jumps(sa_transitions *list, const sa_track *track, const sa_map *map,
                               sa_field *field, double level, int digits);

/* Lists that were found together: lists[index[i]] on level[i]. */
typedef struct {
    const sa_map *map;
    sa_field *field;
    sa_transitions *lists;
    size_t count;
    const size_t *index;
    const double *level;
    double re_low;  /* below every level */
    int refinement; /* of the search for crossings */
} sa_verification;

/* Counts N by crossings between all neighbouring transitions of each list and at the upper end of the range,
 * and compares every list with every count, so that a line missed for one mass shows in the counts made for
 * another. A list that differs, or cannot be counted, becomes undecided. */
cv_status sa_transitions_verify(const sa_verification *v);

/* The list is undecided for this reason, unless it is already. */
void sa_transitions_doubt(sa_transitions *list, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Change of N as alpha grows past a transition: + or -2. */
int sa_transition_step(const sa_candidate *c);

#endif
