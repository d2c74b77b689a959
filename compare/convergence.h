/* How the stability limit tends to that of the undamped track as the damping falls. All quantities
 * dimensionless.
 *
 * Where zeta is smooth at the limit the order is 1. At a resonance velocity alpha_r of the moving force
 * branch points
 * +-q_b, q_b ~ |alpha - alpha_r|, meet at q = 0, and the order is 2/11: next to q_b, at a distance d, Re zeta
 * ~ q_b^2 d^(-1/2) = 1 / eta_M gives d ~ q_b^4; there damping makes Im zeta ~ eta q_b^2 d^(-3/2) ~ eta
 * q_b^(-4), which balances the waves of the other branch point, at a distance 2 q_b on the side where they
 * run, Im zeta ~ q_b^2 q_b^(-1/2): eta ~ q_b^(11/2). */
#ifndef CRITVEL_COMPARE_CONVERGENCE_H
#define CRITVEL_COMPARE_CONVERGENCE_H

#include "compare/run.h"

/* The stability limit at one level of damping. */
typedef struct {
    const cmp_transition *limit; /* inside the list; NULL: none in the range */
    int branch;                  /* 1, 2, ...: equal where it is the same transition, followed from level to
                                    level; 0: there is none */
    double step;     /* |alpha - that of the level before|, where the branch is the same; else NaN */
    double order;    /* log(step before / step) / log(damping before / damping); NaN where one of the two
                        steps is not there */
    double to_limit; /* |alpha - alpha without damping|; NaN where one of them is not there */
} cmp_convergence_row;

typedef enum {
    CMP_TENDS,     /* the last level is on the branch of the limit */
    CMP_ELSEWHERE, /* it is not: another transition is the lower one without damping */
    CMP_NONE       /* no stability limit in the range at the last level, or without damping */
} cmp_convergence_kind;

typedef struct {
    cmp_convergence_kind kind;
    const cmp_transition *limit; /* without damping; NULL: none */
    int jumps;                   /* changes of branch from level to level */
    double order;                /* of the last level; NaN: none */
} cmp_convergence;

/* Fills rows[0 .. count-1] from the lists at falling dampings and the list without damping. A transition is
 * the same at two levels when each is the nearest in alpha, of those that change the number of roots in the
 * same direction, to the other. lists[i] and damping[i] > 0 belong together; all must outlive the rows. */
void cmp_convergence_study(cmp_convergence *out, cmp_convergence_row *rows, size_t count,
                           const cmp_list *const *lists, const double *damping, const cmp_list *undamped);

/* One mass ratio of a case: N of the other method's winding next to the limit without damping. */
typedef enum { CMP_COUNTS_AGREE, CMP_COUNTS_DIFFER, CMP_COUNTS_UNDECIDED } cmp_limit_counts;

/* A case file at falling dampings, by both methods, and without damping by the semianalytical one. */
typedef struct {
    cmp_run run;
    cmp_list **undamped;       /* by case of the run, by mass ratio */
    cmp_limit_counts **counts; /* the same */
} cmp_convergence_run;

enum { CMP_FIRST_LEVEL = 2, CMP_LAST_LEVEL = 12, CMP_LIMIT_DIGITS = 14 };

/* The levels of every case become 10^-first, 10^-(first+1) ... 10^-last. */
cv_status cmp_convergence_levels(cv_casefile *file, int first, int last, cv_message *why);

/* Everything empty but allocated; case_name NULL: all cases. On failure nothing is allocated. */
cv_status cmp_convergence_init(cmp_convergence_run *out, const cv_casefile *file, const char *case_name,
                               cv_message *why);
void cmp_convergence_clear(cmp_convergence_run *run);

/* Searches and judges. The outcome is independent of the number of threads. */
cv_status cmp_convergence_find(cmp_convergence_run *run, size_t threads, const cmp_listener *listener,
                               cv_message *why);

/* CMP_AGREE when both methods agree at every level and about the counts next to every limit. */
cmp_kind cmp_convergence_verdict(const cmp_convergence_run *run);

/* Tables for people, and schema "critvel-compare-convergence/1". */
cv_status cmp_convergence_text(FILE *out, const cmp_convergence_run *run, cv_message *why);
cv_status cmp_convergence_json(FILE *out, const cmp_convergence_run *run, cv_message *why);

#endif
