/* The undamped steady state under a force that moves at velocity alpha: (12) with q = 0 and P as in (3),
 *
 *     w(xi) = (1/pi) integral d2/d3 e^{ip xi} dp,   d3 of p^2 only,
 *
 * as the limit q -> q - i0 of residues. d3(p, 0) = det(K(p) - alpha^2 p^2 M) has four roots x = p^2: a
 * positive one is a pair of waves +-p, which are all ahead of the force or all behind it; the others decay on
 * both sides. All quantities are dimensionless. */
#ifndef CRITVEL_SEMIANALYTIC_UNDAMPED_H
#define CRITVEL_SEMIANALYTIC_UNDAMPED_H

#include <complex.h>

#include "semianalytic/dispersion.h"

typedef enum { SA_DECAYING, SA_WAVE_AHEAD, SA_WAVE_BEHIND } sa_pole_kind;

enum { SA_FIELDS = 3 }; /* w, u_s, u_b */

/* On the sides where it exists, a pole adds Re(weight[f] e^{ip|xi|}) to field f. */
typedef struct {
    sa_pole_kind kind;
    complex long double p;                  /* Im p > 0 for SA_DECAYING; real and positive for waves */
    complex long double dp;                 /* dp/dalpha */
    complex long double weight[SA_FIELDS];  /* -i amplitude for waves: amplitude * sin(p |xi|) */
    complex long double dweight[SA_FIELDS]; /* d weight / dalpha */
} sa_undamped_pole;

typedef struct {
    long double alpha;
    int count; /* at most 4; conjugate pairs are one pole */
    sa_undamped_pole pole[4];
    /* The shortest of |x_i - x_j| / |dx_i/dalpha - dx_j/dalpha|: up to a factor 2 the distance in alpha to
     * the nearest velocity, real or complex, where two roots meet; a resonance velocity when it is real and x
     * > 0 */
    long double reach;
} sa_undamped;

/* alpha >= 0. CV_UNDECIDED when two roots meet within 1e-11 of alpha: at a resonance velocity, where the
 * deflection is infinite, or where a decaying pair is about to become two. */
cv_status sa_undamped_solve(sa_undamped *out, const sa_dispersion *track, long double alpha, cv_message *why);

/* Field f at distance |xi| ahead of the force (ahead = 1) or behind it (0), and its derivatives: value[0] the
 * field, value[1] d/d|xi|, value[2] d^2/d|xi|^2, value[3] d/dalpha. */
void sa_undamped_at(long double value[4], const sa_undamped *s, int field, int ahead, long double distance);

#endif
