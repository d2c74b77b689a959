/* The two steps of sa_branch_curves_build after the samples; not for use elsewhere. */
#ifndef CRITVEL_SEMIANALYTIC_BRANCH_SPECIAL_H
#define CRITVEL_SEMIANALYTIC_BRANCH_SPECIAL_H

#include "semianalytic/branch_curves.h"

/* Fills arc, arc_count from the samples. */
cv_status sa_branch_arcs_find(sa_branch_curves *curves);

/* Fills special, special_count from the arcs. */
cv_status sa_branch_special_find(sa_branch_curves *curves);

#endif
