/* Does an enclosure hold an exact value? For the tests of interval arithmetic in double and MPC. */
#ifndef CRITVEL_TESTS_ENCLOSURE_H
#define CRITVEL_TESTS_ENCLOSURE_H

#include "semianalytic/box.h"
#include "semianalytic/rect.h"

enum { EXACT = 800 }; /* bits that make rounding negligible */

static inline int part_holds(double mid, long double radius, const mpfr_t x)
{
    mpfr_t gap;
    mpfr_init2(gap, EXACT);
    mpfr_sub_d(gap, x, mid, MPFR_RNDN);
    mpfr_abs(gap, gap, MPFR_RNDN);
    int yes = mpfr_cmp_ld(gap, radius * SA_BOX_INFLATE) <= 0;
    mpfr_clear(gap);
    return yes;
}

static inline int rect_holds(sa_rect r, const mpc_t z)
{
    return part_holds(r.re, r.re_rad, mpc_realref(z)) && part_holds(r.im, r.im_rad, mpc_imagref(z));
}

static inline int box_holds(const sa_box *b, const mpc_t z)
{
    mpc_t gap;
    mpc_init2(gap, EXACT);
    mpc_sub(gap, z, b->m, MPC_RNDNN);
    int yes = mpfr_cmp_ld(mpc_realref(gap), b->re_rad * SA_BOX_INFLATE) <= 0 &&
              mpfr_cmp_ld(mpc_realref(gap), -b->re_rad * SA_BOX_INFLATE) >= 0 &&
              mpfr_cmp_ld(mpc_imagref(gap), b->im_rad * SA_BOX_INFLATE) <= 0 &&
              mpfr_cmp_ld(mpc_imagref(gap), -b->im_rad * SA_BOX_INFLATE) >= 0;
    mpc_clear(gap);
    return yes;
}

#endif
