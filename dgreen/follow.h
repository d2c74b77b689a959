/* Inside of dg_follow; private to dgreen/z*.c. */
#ifndef CRITVEL_DGREEN_FOLLOW_H
#define CRITVEL_DGREEN_FOLLOW_H

#include "dgreen/roots.h"
#include "dgreen/z.h"
#include "dgreen/z_mp.h"

/* Roots along one row: the same alpha, ascending q, qbar = i q. */
typedef struct {
    double alpha;
    size_t count, room;
    double *q;
    dg_roots *roots;
} dg_follow_row;

struct dg_follow {
    dg_counters counters;
    int warm; /* roots are those of the last point */
    double q; /* there */
    dg_roots roots;
    dg_follow_row here, before; /* the row of the last point, and the last long one before it */
    /* above double: one workspace and one point per rung of the ladder, made when first needed */
    dg_mp *mp[DG_LADDER];
    mpfr_t alpha;
    mpc_t qbar;
};

/* For a point i q far from the last one: the roots to start from become those of the nearest point of the two
 * rows. */
void dg_follow_jump(dg_follow *f, double alpha, double q);
/* Notes the point i q, whose roots f holds. Lack of memory costs time only. */
void dg_follow_note(dg_follow *f, double alpha, double q);
void dg_follow_row_clear(dg_follow_row *row);

#endif
