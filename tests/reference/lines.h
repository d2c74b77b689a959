/* Candidates for all transitions of one damped track over a range of velocities, by brute force: a dense grid
 * of columns (fastscan.h) graded to the special velocities, bisected wherever the zeros of neighbouring
 * columns do not correspond. */
#ifndef CRITVEL_REFERENCE_LINES_H
#define CRITVEL_REFERENCE_LINES_H

#include "fastscan.h"

typedef struct {
    size_t mass;        /* index of the mass ratio */
    int fall;           /* direction of the zero, as in ref_zero */
    ref_real alpha[2];  /* neighbouring columns between which that zero passes 1/eta_M */
    ref_real q[2];      /* the zero in the two columns */
    ref_real excess[2]; /* Re zeta - 1/eta_M there, of different signs */
} ref_candidate;

typedef struct {
    size_t columns, count, allocated;
    size_t unresolved; /* neighbours whose zeros do not correspond however close */
    ref_candidate *candidate;
} ref_candidates;

typedef struct {
    double alpha_min, alpha_max;
    size_t uniform;    /* columns spread evenly */
    double per_decade; /* columns per decade of distance to each special velocity */
    double closest;    /* least distance to a special velocity */
    const double *mass;
    size_t mass_count;
} ref_search;

/* Fills out (free with ref_candidates_clear). 0, or -1. Lost columns and unresolved neighbours are written to
 * stderr. */
int ref_search_lines(ref_candidates *out, const ref_dtrack *t, const ref_search *s);

/* Where the zero passes 1/eta_M by linear interpolation. */
void ref_candidate_guess(ref_real *alpha, ref_real *q, const ref_candidate *c);

/* Halves the interval of a candidate by the column between. 0, or -1 when the zero is not there any more or
 * the interval cannot be halved. */
int ref_candidate_halve(ref_candidate *c, const ref_dtrack *t, double mass);

void ref_candidates_clear(ref_candidates *c);

#endif
