/* A small pool of threads for jobs that do not depend on one another. */
#ifndef CRITVEL_COMPARE_POOL_H
#define CRITVEL_COMPARE_POOL_H

#include <stddef.h>

#include "common/cli.h"

/* Does job number "index"; writes only to what belongs to that index. */
typedef cv_status cmp_job(void *context, size_t index, cv_message *why);

/* Told about twice a second, in the thread that called cmp_pool_run, how far the jobs are. */
typedef void cmp_progress(void *context, size_t done, size_t total, double seconds);

typedef struct {
    cmp_progress *tell; /* NULL: nobody wants to know */
    void *context;
} cmp_listener;

/* --threads: size_t, 1 to 1024 */
cv_setter cmp_set_threads;

/* Number of processors online, at least 1. */
size_t cmp_processors(void);

/* Does jobs 0 .. count-1 on at most "threads" threads (0: cmp_processors(); never more than jobs), started in
 * ascending order. After a failure no further job starts. Returns the status and message of the failed job of
 * the lowest index, whatever finished first; CV_OK when all are done. */
cv_status cmp_pool_run(size_t threads, size_t count, cmp_job *job, void *context,
                       const cmp_listener *listener, cv_message *why);

#endif
