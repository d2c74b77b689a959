/* zeta(alpha, qbar) continued analytically across the stability boundary, in double, not bounded.
 *
 * For Re qbar > 0 the sum in (30) runs over the roots with Re lambda > 0. As qbar goes to the left half-plane
 * roots lambda cross the imaginary axis; the continued zeta keeps the roots it began with, whatever the signs
 * of their real parts become. The result depends on which way the path passes the branch points, which lie
 * at Re qbar < 0 with damping and on Re qbar = 0 without. All dimensionless. */
#ifndef CRITVEL_DGREEN_CONTINUED_H
#define CRITVEL_DGREEN_CONTINUED_H

#include <complex.h>

#include "dgreen/roots.h"
#include "dgreen/z.h"

typedef struct {
    const dg_track *track;
    double alpha;
    double complex qbar;
    dg_roots roots;  /* at qbar; each keeps its slot along the path */
    unsigned chosen; /* bit i: root i belongs to the sum */
} dg_continued;

/* At qbar = i q, the roots chosen where they are at qbar = aside + i q (aside > 0, far below the distance to
 * the nearest branch point). follow serves the check against dg_zeta_adaptive. CV_UNDECIDED: double does not
 * tell the roots apart. */
cv_status dg_continued_start(dg_continued *c, dg_follow *follow, const dg_track *track, double alpha,
                             double q, double aside);

/* Along the straight line to another qbar, in steps that leave no doubt which root is which. CV_UNDECIDED:
 * the line passes too near to a branch point; *c is then unchanged. */
cv_status dg_continued_move(dg_continued *c, double complex qbar);

/* zeta at c->qbar. */
double complex dg_continued_zeta(const dg_continued *c);

/* d zeta/d qbar by a central difference; room: distance over which zeta changes. */
cv_status dg_continued_slope(double complex *slope, const dg_continued *c, double room);

#endif
