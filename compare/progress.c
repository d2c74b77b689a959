#include "compare/progress.h"

#include <unistd.h>

static void show(void *context, size_t done, size_t total, double seconds)
{
    cmp_progress_line *line = context;
    if (seconds < 2.0)
        return;
    fprintf(line->log, "\r%s: %zu of %zu, %.0f s", line->doing, done, total, seconds);
    fflush(line->log);
    line->shown = 1;
}

cmp_listener cmp_progress_listener(cmp_progress_line *line)
{
    return (cmp_listener){isatty(fileno(line->log)) ? show : NULL, line};
}
