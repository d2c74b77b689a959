/* Roots in double precision, for roots.c and response.c. */
#ifndef CRITVEL_SEMIANALYTIC_ROOTS_SEARCH_H
#define CRITVEL_SEMIANALYTIC_ROOTS_SEARCH_H

#include "semianalytic/laplace.h"
#include "semianalytic/roots_contour.h"

enum { SA_ROOTS_MAX = 64 };

/* q with Re q >= 0 */
typedef struct {
    double complex q, f_q; /* f = 1 - eta_M zeta */
} sa_rough_root;

typedef struct {
    int count;
    sa_rough_root root[SA_ROOTS_MAX];
} sa_rough_roots;

/* Zeros of 1 - eta_M zeta with Im q <= top (continued where Im q > 0, see laplace.h): Newton's iteration from
 * the points of the contour and from a grid. Without any claim to be complete. */
void sa_roots_search(sa_rough_roots *out, const sa_contour *contour, const sa_track *t, double alpha,
                     double mass_ratio, double top);

/* How many zeros those with Im q < -height stand for: two each off the imaginary qbar-axis' mirror Re q = 0,
 * one on it. */
int sa_roots_below(const sa_rough_roots *roots, double height);

#endif
