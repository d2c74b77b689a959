/* Both methods over every case, damping level and mass ratio of a case file, judged. */
#ifndef CRITVEL_COMPARE_RUN_H
#define CRITVEL_COMPARE_RUN_H

#include "common/casefile.h"
#include "compare/countcheck.h"
#include "compare/judge.h"
#include "compare/pool.h"
#include "compare/putback.h"

/* What was found about one mass ratio. */
typedef struct {
    cmp_verdict verdict;
    cmp_counts counts;
    cmp_residual worst; /* of any transition put back into either zeta */
    int searches;       /* by each method, each denser than the one before; the last one is judged */
} cmp_result;

/* Nothing judged yet; searches stay. */
void cmp_result_reset(cmp_result *r);

/* One damping level of a case; arrays by mass ratio, in the order of the case. */
typedef struct {
    cv_params params;
    cmp_list *lists[CMP_METHODS];
    cmp_result *results;
    cmp_effort effort[CMP_METHODS];
} cmp_level;

typedef struct {
    const cv_case *from; /* inside the case file */
    size_t level_count;
    cmp_level *levels;
} cmp_case;

typedef struct {
    const cv_casefile *file; /* must outlive the run */
    const cmp_method *methods[CMP_METHODS];
    size_t case_count;
    cmp_case *cases;
} cmp_run;

/* Everything empty but allocated. case_name NULL: all cases. damping not NULL: one level per case with
 * eta_p = eta_b = eta_f = damping instead of those of the file. On failure nothing is allocated. */
cv_status cmp_run_init(cmp_run *out, const cv_casefile *file, const char *case_name, const cv_number *damping,
                       const cmp_method *const methods[CMP_METHODS], cv_message *why);
void cmp_run_clear(cmp_run *run);

/* Finds the transitions by both methods; judges, puts back and counts; then, for the mass ratios whose
 * verdict is incomplete (judge.h), searches again by both methods more densely, without telling either where,
 * and judges again, until it is not or CMP_SEARCHES are done. The outcome is independent of the number of
 * threads, cpu_seconds excepted. CV_OK whatever the verdicts. */
enum { CMP_SEARCHES = 3 };
cv_status cmp_run_find(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why);
cv_status cmp_run_judge(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why);
cv_status cmp_run_search_again(cmp_run *run, size_t threads, const cmp_listener *listener, cv_message *why);

/* Verdicts counted over a run. */
typedef struct {
    size_t total, of_kind[3]; /* by cmp_kind */
    double fewest_digits;     /* among those that agree on transitions; infinite if none do */
    double used;              /* largest part of the allowed residual */
    cmp_kind worst;
} cmp_summary;

void cmp_run_summary(cmp_summary *out, const cmp_run *run);

#endif
