/* zeta in floating point at real q > 0 for damped tracks: all eight roots p, followed from point to point.
 * Brute force for finding candidates; nothing it says is certified. */
#ifndef CRITVEL_REFERENCE_FASTROOTS_H
#define CRITVEL_REFERENCE_FASTROOTS_H

#include "dispersion.h"

/* The arithmetic of the brute force. double finds the same candidates five times faster on all but stiff
 * tracks at very low damping; "make reference CFLAGS='-O2 -DREF_REAL=double'". */
#ifdef REF_REAL
typedef REF_REAL ref_real;
#else
typedef long double ref_real;
#endif

enum { REF_ROOTS = 8 };

typedef struct {
    ref_real re, im;
} ref_cx;

/* A point and its roots, in an order that is kept from point to point. */
typedef struct {
    ref_real alpha, q;
    ref_cx p[REF_ROOTS];
    ref_real gap[REF_ROOTS]; /* distance of each root to its nearest neighbour */
    ref_real re, im;         /* zeta */
    int upper;               /* number of roots with Im p > 0 */
} ref_state;

/* Roots and zeta at (alpha, q) without a starting point. 0, or -1 without convergence. */
int ref_fast_cold(ref_state *out, const ref_dtrack *t, ref_real alpha, ref_real q);

/* The same from a nearby point; "guess" holds starting values (may be out->p itself). */
int ref_fast_warm(ref_state *out, const ref_dtrack *t, ref_real alpha, ref_real q,
                  const ref_cx guess[REF_ROOTS]);

/* The largest |movement| / gap between two states over all roots. */
ref_real ref_fast_movement(const ref_state *from, const ref_state *to);

#endif
