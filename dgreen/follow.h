/* Inside of dg_follow; private to dgreen/z*.c. */
#ifndef CRITVEL_DGREEN_FOLLOW_H
#define CRITVEL_DGREEN_FOLLOW_H

#include "dgreen/roots.h"
#include "dgreen/z.h"
#include "dgreen/z_mp.h"

struct dg_follow {
    dg_counters counters;
    int warm; /* roots are those of the last point */
    dg_roots roots;
    /* above double: one workspace and one point per rung of the ladder, made when first needed */
    dg_mp *mp[DG_LADDER];
    mpfr_t alpha;
    mpc_t qbar;
};

#endif
