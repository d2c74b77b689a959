/* The crossings at all velocities that were looked at, linked to lines. For lines*.c only. All dimensionless.
 */
#ifndef CRITVEL_DGREEN_LINES_GRAPH_H
#define CRITVEL_DGREEN_LINES_GRAPH_H

#include "dgreen/crossing_follow.h"
#include "dgreen/lines.h"

enum { DG_LINE_NONE = -1 };

/* The two sides of a node: towards lower and towards higher velocities */
enum { DG_LINE_LOWER, DG_LINE_HIGHER };

/* One crossing at one velocity, or the turning point where two meet. */
typedef struct {
    dg_followed is;
    int turns;            /* 1: turning point; its two links lead to the two arms */
    int stable_roots;     /* as in dg_line_vertex */
    int link[2];          /* the neighbour on each side, or DG_LINE_NONE; */
    int back[2];          /* and which link of the neighbour leads back */
    dg_line_exit exit[2]; /* where there is no neighbour */
} dg_line_node;

typedef struct dg_line_graph {
    dg_track *track;
    dg_follow *follow;
    dg_branch_curves *branches;
    dg_probe probe; /* of the three */
    double alpha_min, alpha_max;
    double x_min, x_max;           /* 1/eta_M at the ends of the range */
    double x_hidden;               /* lines are followed down to this, so that it is known where they end */
    double x_floor;                /* crossings below are not seen */
    double scale_alpha, scale_log; /* of the plot: lengths of the ranges of alpha and log eta_M */
    size_t node_count, node_room;
    dg_line_node *nodes;
    dg_lines *lines;    /* where doubts and results go */
    dg_station station; /* scratch */
    int cuts;           /* of the cell that is being searched */
    cv_message *why;
} dg_line_graph;

/* Appends an unlinked node whose exits are undecided. Returns its index, or DG_LINE_NONE when out of memory.
 */
int dg_line_add(dg_line_graph *g, const dg_followed *is);
void dg_line_join(dg_line_graph *g, int a, int a_side, int b, int b_side);
cv_status dg_line_doubt_add(dg_line_graph *g, double low, double high, const char *reason);

/* Distance in the plot of the middle of the cubic between two samples (values and slopes) from their chord */
double dg_line_sagitta(const dg_line_graph *g, const dg_followed *l, const dg_followed *r);

/* One velocity: its curve and the nodes of its crossings, first .. first + crossing_count - 1. */
typedef struct {
    dg_curve curve;
    int first;
} dg_line_column;

/* Links everything between two neighbouring columns, with more columns in between where needed. */
cv_status dg_line_cell(dg_line_graph *g, const dg_line_column *left, const dg_line_column *right);
/* Samples the curve at alpha and adds its nodes. *c is zero or a former column. */
cv_status dg_line_column_at(dg_line_column *c, dg_line_graph *g, double alpha);

/* Links node a of the left column to node b of the right one with as many in between as the chord error asks
 * for. CV_UNDECIDED: they are not the same line, or it is not smooth. */
cv_status dg_line_follow(dg_line_graph *g, int a, int b, int alike);

/* Crossings a and a + 1 (nodes), which have different directions and do not exist at the velocity "gone"
 * beyond the side: the turning point between, linked to both. *q: where the minimum of |Im zeta| is at
 * "gone". CV_UNDECIDED: not found. */
cv_status dg_line_turn(double *q, dg_line_graph *g, int a, int side, double gone);

/* Pairs of the crossings of two columns. */
enum { DG_LINE_MAX = 64, DG_LINE_MEETS_NEXT = -1, DG_LINE_MEETS_LAST = -2, DG_LINE_ALONE = -3 };
typedef struct {
    int of_left[DG_LINE_MAX], of_right[DG_LINE_MAX]; /* index in the other column, or one of the above */
} dg_line_pairs;
/* 0: too many crossings */
int dg_line_align(dg_line_pairs *p, const dg_curve *left, const dg_curve *right, double x_floor);

/* The crossing at m->alpha between two nodes that are linked, l the one with the lower velocity. */
cv_status dg_line_between(dg_followed *m, dg_line_graph *g, const dg_followed *l, const dg_followed *r);

/* Narrows the bracket of a crossing as far as doubles go; the rest of it follows. Never fails: what cannot be
 * certified stays as wide as it is. */
void dg_line_polish(dg_followed *f, const dg_line_graph *g);

/* Where the line whose last crossings are "before" and h, beyond the greatest eta_M of the range, runs on to
 * infinity. 0: it is not known to do so. */
int dg_line_runs_to_infinity(double *alpha, double *q, dg_line_graph *g, const dg_followed *before,
                             const dg_followed *h);

/* 1: the line with the crossing h at the highest velocity goes on to zero mass as the velocity grows, as far
 * as it was followed; 0: it does not, or it was lost. */
int dg_line_runs_to_zero_mass(const dg_line_graph *g, const dg_followed *h);

/* Turns the linked nodes into lines. */
cv_status dg_line_collect(dg_line_graph *g);

#endif
