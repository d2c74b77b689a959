/* The search in double of dgreen/limit_transitions.h; for the files limit_*.c only. */
#ifndef CRITVEL_DGREEN_LIMIT_SEARCH_H
#define CRITVEL_DGREEN_LIMIT_SEARCH_H

#include "dgreen/sampler.h"
#include "dgreen/transitions_sweep.h"

/* A transition in double; jump: at a special velocity, of which only alpha and change are set. */
typedef struct {
    dg_find find;
    int jump;
} dg_limit_event;

typedef struct {
    double x; /* 1/eta_M */
    int count_at_min;
    size_t count, room;
    dg_limit_event *events; /* ascending in alpha */
    cv_status status;       /* CV_UNDECIDED: the list may be incomplete, why says where */
    cv_message why;
} dg_limit_mass;

/* What is kept of the curve at one velocity, for all masses. */
typedef struct dg_limit_look dg_limit_look;

typedef struct {
    dg_probe probe;
    size_t mass_count;
    dg_limit_mass *masses; /* x set, the rest zero */
    int look;              /* as in dg_find_transitions */
    size_t look_count, look_room;
    dg_limit_look *looks; /* freed by dg_limit_search_run */
    cv_message *why;
} dg_limit_search;

/* Fills the masses. CV_FAILED: out of memory. */
cv_status dg_limit_search_run(dg_limit_search *s, double alpha_min, double alpha_max);

#endif
