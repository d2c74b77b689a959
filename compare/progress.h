/* Progress for people who wait: a line on a terminal, from the third second on. */
#ifndef CRITVEL_COMPARE_PROGRESS_H
#define CRITVEL_COMPARE_PROGRESS_H

#include <stdio.h>

#include "compare/pool.h"

typedef struct {
    FILE *log;
    const char *doing;
    int shown; /* a line has been begun: end it with a newline */
} cmp_progress_line;

/* A cmp_progress for cmp_pool_run, whose context is a cmp_progress_line; silent unless log is a terminal. */
cmp_listener cmp_progress_listener(cmp_progress_line *line);

#endif
