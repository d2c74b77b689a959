/* The roots qbar of z = eta_M zeta(alpha, qbar) = 1 at one velocity and one mass ratio, found by both
 * methods: paired, judged, put back, counted. Dimensionless; Re qbar growth rate, Im qbar mass-induced
 * frequency. Roots come in conjugate pairs; the one with Im qbar >= 0 stands for both. */
#ifndef CRITVEL_COMPARE_ROOTS_H
#define CRITVEL_COMPARE_ROOTS_H

#include "compare/judge.h"

typedef struct {
    mpfr_t re, im;     /* qbar */
    mpfr_t error;      /* bound of the error of each part, > 0 */
    cv_status decided; /* CV_UNDECIDED: the method does not vouch for the digits */
} cmp_root;

typedef struct {
    int unstable; /* roots with Re qbar > 0 by the argument principle, conjugates counted */
    size_t count;
    cmp_root *items;  /* Re qbar descending: the unstable ones, then the nearest stable ones */
    cv_status status; /* CV_UNDECIDED: no or no complete list */
    cv_message why;
} cmp_root_list;

void cmp_root_list_init(cmp_root_list *list);
void cmp_root_list_clear(cmp_root_list *list);
/* Copies at the precision of the arguments. CV_FAILED when out of memory. */
cv_status cmp_root_list_append(cmp_root_list *list, mpfr_srcptr re, mpfr_srcptr im, mpfr_srcptr error,
                               cv_status decided, cv_message *why);

/* One solver tree, as cmp_method. A handle serves one track, one velocity, one mass ratio. */
typedef struct {
    const char *name;
    cv_status (*open)(void **handle, const cv_params *track, const cv_number *alpha,
                      const cv_number *mass_ratio, cv_message *why);
    void (*close)(void *handle);
    /* out initialised by the caller. All unstable roots, and stable ones with Re qbar >= -depth as far as the
     * method looks for them. What cannot be decided is said in the list. */
    cv_status (*find)(void *handle, cmp_root_list *out, double depth, int digits, cv_message *why);
    /* zeta computed with "bits" bits, continued from Re qbar > 0 along Im qbar = const where Re qbar < 0;
     * |zeta - exact| <= error */
    cv_status (*zeta)(void *handle, mpc_ptr zeta, mpfr_ptr error, mpc_srcptr qbar, mpfr_prec_t bits,
                      cv_message *why);
} cmp_root_method;

extern const cmp_root_method cmp_roots_semianalytic;
extern const cmp_root_method cmp_roots_dgreen;

/* A root, by the methods that list it. */
typedef struct {
    const cmp_root *by[CMP_METHODS]; /* inside the lists; NULL: not listed */
    int unstable;
    cmp_verdict verdict; /* digits: infinite unless both list it */
    mpfr_t residual;     /* largest |z - 1| of any claim put into either method */
    double used;         /* largest part of what was allowed */
} cmp_root_row;

typedef struct {
    cmp_root_list lists[CMP_METHODS];
    size_t count;
    cmp_root_row *rows; /* Re qbar descending */
    cmp_verdict verdict;
} cmp_roots;

/* Finds by the second method, then by the first as deep as the second went, and judges.
 * Agree: the counts are equal and each list has as many unstable roots; each unstable root is in both lists;
 * partners differ by no more than the sum of their bounds and by less than 10^-digits in each part; each
 * claim satisfies z = 1 of both methods within what its bound allows. A stable root that only one method
 * lists is no disagreement, since neither claims to list all, if it satisfies z = 1 of the other; it is
 * CMP_UNDECIDED where the other cannot tell. CV_OK whatever the verdict; *out needs clearing then. */
cv_status cmp_roots_compare(cmp_roots *out, const cmp_root_method *const methods[CMP_METHODS],
                            const cv_params *track, const cv_number *alpha, const cv_number *mass_ratio,
                            int digits, cv_message *why);
void cmp_roots_clear(cmp_roots *r);

#endif
