/* The integral of (14) along a line, for response.c. */
#ifndef CRITVEL_SEMIANALYTIC_RESPONSE_PANELS_H
#define CRITVEL_SEMIANALYTIC_RESPONSE_PANELS_H

#include <stddef.h>

#include "semianalytic/zeta.h"

/* W(xi, x - i height) of response.h as a function of x. */
typedef struct {
    const sa_track *track;
    double alpha, mass, xi, height;
} sa_image;

enum { SA_PANEL_NODES = 16, SA_PANELS_MAX = 200000 };

typedef struct {
    double middle, half;
    double complex c[SA_PANEL_NODES]; /* W = sum of c[n] P_n((x - middle)/half) */
} sa_panel;

typedef struct {
    size_t count, room;
    sa_panel *panel;
    double end;   /* of the last panel */
    double tail;  /* |W| there, at xi = 0 */
    double error; /* estimated error of the integral of |W - its Legendre sums|, and of rounding */
} sa_panels;

/* Panels from 0 to where the rest, |W| falling like x^(-5/2) or faster, no longer matters, at most 1e7, less
 * for xi != 0. Each
 * is halved until its last coefficients are below 1e-14 of the whole at the load. CV_UNDECIDED: the kernel is
 * not to be had somewhere, or SA_PANELS_MAX were not enough, as for |xi| in the thousands. On failure nothing
 * is allocated. */
cv_status sa_panels_build(sa_panels *out, const sa_image *image, cv_message *why);
void sa_panels_clear(sa_panels *p);

/* The integral of W e^{i x tau} over x > 0 and an estimate of its error. CV_FAILED: GSL. */
cv_status sa_panels_integrate(double complex *integral, double *error, const sa_panels *p, double tau);

#endif
