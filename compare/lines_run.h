/* Instability lines by both methods over the cases and damping levels of a case file. */
#ifndef CRITVEL_COMPARE_LINES_RUN_H
#define CRITVEL_COMPARE_LINES_RUN_H

#include "common/casefile.h"
#include "compare/lines.h"
#include "compare/lines_sample.h"
#include "compare/pool.h"

/* One damping level of a case. */
typedef struct {
    cv_params params;
    void *handles[CMP_METHODS]; /* NULL: not open */
    cmp_branches lists[CMP_METHODS];
    cmp_branch_pairs pairs;
    cmp_line_samples samples;
    cmp_verdict verdict; /* of everything; digits: the fewest of any pair */
} cmp_lines_level;

typedef struct {
    const cv_case *from; /* inside the case file */
    size_t level_count;
    cmp_lines_level *levels;
} cmp_lines_case;

typedef struct {
    const cv_number *range[4]; /* alpha_min, alpha_max, mass_min, mass_max */
    int digits;
    size_t points; /* samples of each level */
    unsigned long seed;
} cmp_lines_task;

typedef struct {
    cmp_lines_task task; /* its numbers must outlive the run */
    const cmp_line_method *methods[CMP_METHODS];
    size_t case_count;
    cmp_lines_case *cases;
    cmp_kind worst; /* of all levels, after cmp_lines_run_judge */
} cmp_lines_run;

/* Everything empty but allocated. case_name NULL: all cases; damping not NULL: that one instead of the levels
 * of the file. On failure nothing is allocated. */
cv_status cmp_lines_run_init(cmp_lines_run *out, const cv_casefile *file, const char *case_name,
                             const cv_number *damping, const cmp_lines_task *task,
                             const cmp_line_method *const methods[CMP_METHODS], cv_message *why);
void cmp_lines_run_clear(cmp_lines_run *run);

/* Finds the lines by both methods; pairs, judges and counts. The outcome does not depend on the number of
 * threads. CV_OK whatever the verdicts. */
cv_status cmp_lines_run_find(cmp_lines_run *run, size_t threads, const cmp_listener *listener,
                             cv_message *why);
cv_status cmp_lines_run_judge(cmp_lines_run *run, size_t threads, const cmp_listener *listener,
                              cv_message *why);

#endif
