/* All roots at once, for vector instructions: arrays with one number per root, and loops over all of them.
 *
 * A slot that holds no near root (fewer roots, or the far one) is at NOWHERE, so far out that it neither
 * repels nor is near to any other; what is computed for it has no meaning. */
#ifndef CRITVEL_DGREEN_LANES_H
#define CRITVEL_DGREEN_LANES_H

#include "dgreen/roots.h"

/* For functions whose time counts: compiled twice, the better one for the processor is chosen when the
 * program starts. Neither contracts products and sums, so the results are the same. Sanitizers cannot do
 * that. */
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__)
#define DG_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define DG_CLONES
#endif

/* Parts of such functions */
#define DG_PART static inline __attribute__((always_inline))

#define DG_NOWHERE 1e200

typedef struct {
    double of[DG_DEGREE];
} dg_lanes;

/* The near roots, twice in a row, so that those "k places further" are contiguous */
typedef struct {
    double re[2 * DG_DEGREE], im[2 * DG_DEGREE];
} dg_ring;

DG_PART void dg_ring_set(dg_ring *ring, const dg_roots *r)
{
    const int near = r->count - r->far;
    for (int i = 0; i < DG_DEGREE; i++) {
        ring->re[i] = ring->re[i + DG_DEGREE] = i < near ? r->re[i] : DG_NOWHERE;
        ring->im[i] = ring->im[i + DG_DEGREE] = i < near ? r->im[i] : DG_NOWHERE;
    }
}

#endif
