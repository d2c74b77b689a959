/* Inside of dg_follow; private to dgreen/z*.c. */
#ifndef CRITVEL_DGREEN_FOLLOW_H
#define CRITVEL_DGREEN_FOLLOW_H

#include "dgreen/roots.h"
#include "dgreen/z.h"

struct dg_follow {
    dg_counters counters;
    int warm; /* roots are those of the last point */
    dg_roots roots;
};

#endif
