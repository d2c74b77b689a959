/* Instability lines by both methods at one damping level: paired branch by branch, compared to many digits at
 * their vertices, and used to count unstable roots all over the plane. All dimensionless; alpha velocity
 * ratio (to the right), eta_M mass ratio (upwards, logarithmic), q the frequency at which eta_M zeta(alpha,
 * iq) = 1.
 */
#ifndef CRITVEL_COMPARE_LINES_H
#define CRITVEL_COMPARE_LINES_H

#include "compare/judge.h"

/* A point of a line with absolute bounds. */
typedef struct {
    mpfr_t alpha, q, eta_M;
    double alpha_error, q_error, eta_M_error; /* 0: exact, or less than a double holds; NaN: not bounded */
    int turns;                                /* 1: alpha has a local extremum along the line here */
    cv_status decided;                        /* CV_UNDECIDED: not to the digits asked for */
} cmp_line_point;

void cmp_line_point_init(cmp_line_point *p); /* NaN, errors NaN */
void cmp_line_point_clear(cmp_line_point *p);

/* Where a branch ends. */
typedef enum {
    CMP_END_CLOSED, /* nowhere: the last vertex is the first */
    CMP_END_ALPHA_LOW,
    CMP_END_ALPHA_HIGH,
    CMP_END_MASS_LOW,
    CMP_END_MASS_HIGH,
    CMP_END_UNDECIDED
} cmp_end_kind;

typedef struct {
    cmp_end_kind kind;
    double asymptote, asymptote_error; /* velocity at which eta_M grows to infinity from here on, and its
                                          bound; NaN: none, no bound */
    double asymptote_q;                /* and the frequency there: mostly 0, else zeta is 0 there */
    int open;      /* 1: what is beyond the greatest mass is not known; nothing is claimed */
    int zero_mass; /* 1: found to go on to zero mass as alpha grows to infinity; 0 claims
                      nothing, so that it is reported, not judged */
} cmp_line_end;

/* The part of a line inside the range; two more roots are unstable on its left. The polyline of the vertices
 * is nearer to the line than 1e-3 of the range in (alpha, log eta_M). */
typedef struct {
    size_t count;
    cmp_line_point *vertices;
    cmp_line_end ends[2];
    double least_mass, least_mass_error; /* smallest eta_M on it, relative bound */
} cmp_branch;

typedef struct {
    double alpha_min, alpha_max, mass_min, mass_max;
    size_t count;
    cmp_branch *branches;
    cv_status status; /* CV_UNDECIDED: something may be missing or not fit together */
    cv_message why;
} cmp_branches;

void cmp_branches_init(cmp_branches *b);
void cmp_branches_clear(cmp_branches *b);
/* Both return NULL when out of memory; what they return is initialised and stays valid until the next of the
 * same kind is appended. */
cmp_branch *cmp_branches_append(cmp_branches *b);
cmp_line_point *cmp_branch_append(cmp_branch *b);

/* One solver tree, as cmp_method. A handle serves one track and one range, and one thread at a time. */
typedef struct {
    const char *name;
    cv_status (*open)(void **handle, const cv_params *track, const cv_number *const range[4],
                      cv_message *why); /* alpha_min, alpha_max, mass_min, mass_max */
    void (*close)(void *handle);
    /* out initialised by the caller */
    cv_status (*find)(void *handle, cmp_branches *out, int digits, cv_message *why);
    /* the point of a line at exactly this alpha (by_q 0) or q (by_q 1), the other coordinate within "reach"
     * of start, or of its double; out initialised by the caller; what is not found or not to the digits is
     * undecided */
    cv_status (*point)(void *handle, cmp_line_point *out, int by_q, mpfr_srcptr given, mpfr_srcptr start,
                       double reach, int digits, cv_message *why);
    /* unstable roots at each of the mass ratios; decided[i] CV_UNDECIDED where it cannot tell; after find */
    cv_status (*count)(void *handle, int *roots, cv_status *decided, double alpha, size_t mass_count,
                       const double *mass_ratios, cv_message *why);
} cmp_line_method;

extern const cmp_line_method cmp_lines_semianalytic;
extern const cmp_line_method cmp_lines_dgreen;

/* Branches by the methods that have them. */
typedef struct {
    const cmp_branch *by[CMP_METHODS]; /* inside the lists; NULL: not there */
    double plot_distance; /* largest of a vertex of one from the polyline of the other, in parts of
                             the range */
    size_t vertices;      /* compared to many digits */
    double difference;    /* largest relative difference of a coordinate of any of them */
    cmp_verdict verdict;  /* digits: the fewest of any of them */
} cmp_branch_pair;

typedef struct {
    size_t count;
    cmp_branch_pair *pairs; /* by lowest velocity */
} cmp_branch_pairs;

/* Pairs branches that are mutually nearest (largest distance of a vertex of either from the other's polyline,
 * where that runs in the same direction) and nearer than 2 % of the range. CV_FAILED when out of memory;
 * nothing is then allocated. */
cv_status cmp_branches_pair(cmp_branch_pairs *out, const cmp_branches lists[CMP_METHODS], cv_message *why);
void cmp_branch_pairs_clear(cmp_branch_pairs *p);

/* Judges one pair; the verdicts are initialised by cmp_branches_pair.
 * A branch of one method alone: CMP_DISAGREE, or CMP_UNDECIDED where a list says that it may be incomplete. A
 * pair: the same ends, asymptotes (CMP_UNDECIDED where the
 * other method knows that there is none) and least mass within the bounds, as many turning points, nowhere
 * further apart than 5e-3 of the range. Each vertex of either: its exact coordinate (q at a turning point) is
 * given to both methods' "point", or to the other's alone where the vertex has the digits already; the two
 * points must agree within the sum of their bounds and to 10^-digits, and the vertex with the point of its
 * own method within its bounds. */
cv_status cmp_branches_judge(cmp_branch_pair *pair, const cmp_branches lists[CMP_METHODS],
                             const cmp_line_method *const methods[CMP_METHODS],
                             void *const handles[CMP_METHODS], int digits, cv_message *why);

#endif
