/* What compare sees of a solver tree: neutral lists of transitions, and one table of functions per tree, so
 * that judging never knows which tree it judges and tests can put a manufactured one in its place. All
 * quantities dimensionless; alpha velocity ratio, q > 0 frequency on the imaginary axis (qbar = i q), eta_M
 * mass ratio of (11), zeta = z / eta_M of (30). */
#ifndef CRITVEL_COMPARE_METHOD_H
#define CRITVEL_COMPARE_METHOD_H

#include <stddef.h>

#include <mpc.h>

#include "common/params.h"

/* A change of the number of unstable roots: 1 - eta_M zeta(iq, alpha) = 0 at (alpha, q). */
typedef struct {
    mpfr_t alpha, q;             /* at the precision of the solver */
    mpfr_t alpha_error, q_error; /* absolute bounds as the solver states them, > 0 */
    int below, above;            /* unstable roots just below and just above alpha */
    cv_status decided;           /* CV_OK, or CV_UNDECIDED: the solver does not vouch for it */
    int at_resonance; /* 1: of a track without damping, at a resonance velocity: q = 0 exactly, and there
                         is no zeta to put it back into; else 0 */
} cmp_transition;

/* All transitions of one mass ratio that a solver claims, alpha ascending. */
typedef struct {
    size_t count;
    cmp_transition *items;
    cv_status status; /* CV_UNDECIDED: the solver could not tell whether the list is complete */
    cv_message why;   /* where status is not CV_OK */
} cmp_list;

void cmp_list_init(cmp_list *list); /* empty, CV_OK */
void cmp_list_clear(cmp_list *list);

/* Appends one transition, copied at the precision of the arguments. Bounds that are zero or that a double
 * could not hold are raised to one unit in the last place of the value they belong to. CV_FAILED when out of
 * memory. */
cv_status cmp_list_append(cmp_list *list, mpfr_srcptr alpha, mpfr_srcptr q, double alpha_error,
                          double q_error, int below, int above, cv_status decided, cv_message *why);

/* Index of the stability limit: the lowest transition from 0 unstable roots to some; list->count if there is
 * none. */
size_t cmp_list_limit(const cmp_list *list);

/* Whether t cannot be told from the velocity alpha: they differ by no more than its bound, or by no more than
 * a unit in the last place of a double, in which the methods may search. */
int cmp_transition_at(const cmp_transition *t, const cv_number *alpha);

/* What a search cost. */
typedef struct {
    unsigned long evaluations;      /* of zeta, at any precision */
    unsigned long evaluations_wide; /* those above double precision */
    unsigned long largest_bits;     /* largest precision used, bits */
    double cpu_seconds; /* processor time of the search; measured by cmp_run, not by the methods */
} cmp_effort;

/* One solver tree. Every function returns CV_OK, CV_UNDECIDED (with what it has), CV_BAD_INPUT or CV_FAILED,
 * and a one-line message where it is not CV_OK. A handle serves one track at one damping, one range of
 * velocities, and one thread at a time. */
typedef struct {
    const char *name;
    cv_status (*open)(void **handle, const cv_params *track, const cv_number *alpha_min,
                      const cv_number *alpha_max, cv_message *why);
    void (*close)(void *handle);
    /* lists[0 .. mass_count-1] initialised by the caller; what cannot be decided is said in the lists, not by
     * the status returned; alpha_min <= alpha <= alpha_max; relative error of alpha and q below 10^-digits.
     * level 0: the usual search; each further one searches more densely */
    cv_status (*find)(void *handle, cmp_list *lists, cmp_effort *effort, size_t mass_count,
                      const cv_number *mass_ratios, int digits, int level, cv_message *why);
    /* number of roots of 1 - eta_M zeta = 0 with Re qbar > 0, for each of the mass ratios */
    cv_status (*count)(void *handle, int *roots, double alpha, size_t mass_count,
                       const cv_number *mass_ratios, cv_message *why);
    /* zeta computed with "bits" bits; re_error, im_error absolute bounds of its parts */
    cv_status (*zeta)(void *handle, mpc_ptr zeta, mpfr_ptr re_error, mpfr_ptr im_error, mpfr_srcptr alpha,
                      mpfr_srcptr q, mpfr_prec_t bits, cv_message *why);
} cmp_method;

enum { CMP_SEMIANALYTIC = 0, CMP_DGREEN = 1, CMP_METHODS = 2 };

extern const cmp_method cmp_method_semianalytic;
extern const cmp_method cmp_method_dgreen;

#endif
