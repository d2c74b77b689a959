/* Instability lines: all points (alpha, q), q > 0, with Im zeta = 0 < Re zeta, seen in the plane of alpha and
 * eta_M = 1 / Re zeta. A mass on a line has a pair of roots qbar = +-iq; the number N of unstable roots
 * differs by 2 across it. Lines do not cross in (alpha, q), but may in (alpha, eta_M).
 *
 * Lines are put together from the short monotone segments that sa_map_search (map_search.h) finds in every
 * cell of the map, over all eta_M > 0 as far as eta_M = 1e12 or more, and then cut at the ends of the range
 * of eta_M into branches. What goes on beyond the cut is known: an asymptote (asymptotes.h), a point where
 * zeta = 0 at q > 0, another branch. Whatever does not fit together is an undecided end.
 *
 * Without damping the lines are the limit of the damped ones as eta_p = eta_b = eta_f tend to zero
 * (transitions.h). It has, besides the points with Im zeta = 0, vertical parts at special velocities of the
 * branch curves, where eta_M grows or falls at constant (alpha, q), and parts at eta_M = 0 along branch
 * curves (limit_meeting.h). Only those parts of the vertical ones depend on eta_p : eta_b : eta_f that are
 * passed up and down, so that N is the same on both sides.
 *
 * Every line runs so that, with alpha to the right and eta_M upwards, N is larger by 2 on its left. All
 * quantities are dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_LINES_H
#define CRITVEL_SEMIANALYTIC_LINES_H

#include <stddef.h>

#include "semianalytic/asymptotes.h"

/* What a vertex is besides a point of the line; flags. */
enum {
    SA_MARK_LEAST_MASS = 1, /* local minimum of eta_M along the line */
    SA_MARK_MOST_MASS = 2,  /* local maximum */
    SA_MARK_TURN = 4,       /* turning point: alpha has a local extremum along the line */
    SA_MARK_CUT = 8,        /* at an end of the range, where one coordinate is exact */
    SA_MARK_VERTICAL = 16,  /* without damping: on a vertical part, at a special velocity */
    SA_MARK_CURVE = 32,     /* without damping: on a branch curve, at less than 1e-12 of it */
    SA_MARK_BELOW = 64,     /* of vertical parts at one velocity: at smaller alpha for small damping */
    SA_MARK_ABOVE = 128     /* at larger alpha */
};

/* |error| <= bound for each coordinate; a bound of 0 means exact, or less than a double holds. At marked
 * extremes the bounds say that the point is on the line; the extreme value is within value_error (see there)
 * of the largest or smallest on the line. */
typedef struct {
    mpfr_t alpha, q, eta_M;
    double alpha_error, q_error, eta_M_error;
    int marks;
    double value_error; /* of the extreme eta_M (LEAST_, MOST_MASS) or alpha (TURN); else 0 */
    /* CV_UNDECIDED: a bound is larger than 10^-digits of its coordinate. On a vertical part alpha has all
     * digits at a resonance velocity, and those of a double elsewhere; that does not make the lines
     * undecided.
     */
    cv_status decided;
} sa_line_vertex;

/* Where a branch ends. */
typedef enum {
    SA_END_CLOSED,     /* nowhere: first and last vertex are the same */
    SA_END_ALPHA_LOW,  /* the lower end of the range of alpha */
    SA_END_ALPHA_HIGH, /* the upper end */
    SA_END_MASS_LOW,   /* the lower end of the range of eta_M */
    SA_END_MASS_HIGH,  /* the upper end */
    SA_END_UNDECIDED,  /* the pieces of the line do not fit together here */
    SA_END_CURVE,      /* undecided at a branch curve; only without damping, as the next one */
    SA_END_SPECIAL     /* undecided at a special velocity of the branch curves */
} sa_end_kind;

/* What the line does beyond the end of its branch. */
typedef enum {
    SA_BEYOND_NOTHING,   /* not known: the range of alpha ends, undecided, or lost beyond any range of eta_M;
                          * closed lines */
    SA_BEYOND_ASYMPTOTE, /* eta_M grows to infinity as q -> 0, alpha -> that of asymptote "number" */
    SA_BEYOND_ZERO,      /* eta_M grows to infinity at q > 0: zeta(zero_alpha, zero_q) = 0 */
    SA_BEYOND_BRANCH,    /* comes back into the range of eta_M as branch "number" */
    SA_BEYOND_ALPHA_LOW, /* leaves the range of alpha outside that of eta_M */
    SA_BEYOND_ALPHA_HIGH,
    SA_BEYOND_VERTICAL /* without damping: eta_M grows to infinity at (zero_alpha, zero_q), a special velocity
                          (q = 0: a resonance velocity) or, rarely, a branch curve */
} sa_beyond_kind;

typedef struct {
    sa_end_kind kind;
    sa_beyond_kind beyond;
    size_t number;
    double zero_alpha, zero_q; /* in double precision */
} sa_line_end;

/* Of the whole line, not only of the branch. */
typedef enum {
    SA_LINE_CLOSED,
    SA_LINE_INFINITE,  /* both ends at infinite mass: asymptotes or zeros of zeta */
    SA_LINE_ZERO_MASS, /* one end leaves the range of alpha at its upper end, on the way to zero mass at
                        * infinite velocity */
    SA_LINE_OUT,       /* leaves the range of alpha at its lower end, or at the upper with both ends */
    SA_LINE_UNDECIDED  /* an end is, or is lost beyond any range of eta_M */
} sa_line_kind;

typedef struct {
    size_t line; /* branches cut from one line have the same */
    sa_line_kind kind;
    sa_line_end start, end;
    size_t count;
    sa_line_vertex *vertex; /* in the direction of the line */
    /* N on both sides at one vertex, from the crossings of the real axis there (crossings.h); elsewhere on
     * the branch both may differ from this by the same number, where other lines pass. CV_UNDECIDED: no
     * vertex was found at which it can be counted. */
    size_t counted_at;
    int roots_left, roots_right;
    cv_status counted;
} sa_branch;

typedef struct sa_line_store sa_line_store;

typedef struct {
    size_t line_count; /* lines, also those outside the range of eta_M */
    size_t count;
    sa_branch *branch; /* by line, and along it */
    sa_asymptote_list asymptotes;
    cv_status decided; /* CV_UNDECIDED: something does not fit together; reason names the first of it */
    cv_message reason;
    size_t place_count; /* velocities and frequencies at which lines could not be put together */
    double (*place)[2];
    sa_line_store *store; /* for sa_lines_count */
} sa_lines;

#define SA_LINES_MASS_MAX 1e10

/* 0 < alpha_min < alpha_max, 1 / SA_LINES_MASS_MAX <= mass_min < mass_max <= SA_LINES_MASS_MAX */
typedef struct {
    const cv_number *alpha_min, *alpha_max, *mass_min, *mass_max;
} sa_lines_range;

/* All branches in the range. Vertices are so many that the polyline in (alpha, log eta_M) is nearer than 1e-3
 * of the range (each axis by its own) to the line, and hardly more; one coordinate of each is exact in double
 * or at the end of the range, the others are right to the digits. CV_OK also when something is undecided.
 * CV_BAD_INPUT: params refused by cv_params_check, not a range. CV_FAILED: out of memory, a
 * library failed; nothing is then allocated. */
cv_status sa_lines_find(sa_lines *out, const cv_params *params, const sa_lines_range *range, int digits,
                        cv_message *why);
void sa_lines_clear(sa_lines *lines);

/* N(alpha, eta_M) by the lines: 2 (those that pass alpha below eta_M towards larger alpha, minus those
 * towards smaller alpha). CV_UNDECIDED: a line passes or turns at the point within double precision, or lines
 * are undecided; without damping also next to a special velocity. CV_BAD_INPUT: alpha outside the range,
 * eta_M not positive or above SA_LINES_MASS_MAX. */
cv_status sa_lines_count(int *roots, sa_lines *lines, double alpha, double eta_M, cv_message *why);

/* Puts a point on a line: one coordinate is given exactly, the other is the zero of Im zeta next to "start",
 * found by secants in MPFR and enclosed by a proven change of sign. */
typedef enum { SA_GIVEN_ALPHA, SA_GIVEN_Q } sa_line_given;

/* out is initialised here and has relative bounds below 10^-digits (eta_M: as far as Re zeta varies linearly
 * over the enclosure) where decided. *rises: 1 when Im zeta grows with the coordinate sought, else -1, 0 if
 * undecided. eta_M is negative where Re zeta is, and 0 where that is exactly 0, which happens without
 * damping. The zero found need not be the nearest to start if start is not near; compare. sweep is only a
 * warm start. CV_OK also when undecided; CV_BAD_INPUT: given or start not positive. */
cv_status sa_line_point(sa_line_vertex *out, int *rises, sa_sweep *sweep, const sa_track *track,
                        sa_line_given which, const mpfr_t given, double start, int digits);
/* The same from a start in any precision. */
cv_status sa_line_point_from(sa_line_vertex *out, int *rises, sa_sweep *sweep, const sa_track *track,
                             sa_line_given which, const mpfr_t given, const mpfr_t start, int digits);
void sa_line_vertex_clear(sa_line_vertex *vertex);

#endif
