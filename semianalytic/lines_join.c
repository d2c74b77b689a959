#include <stdlib.h>

#include "semianalytic/lines_parts.h"

/* The lines as they will be, with all samples. */
typedef struct {
    sa_line_samples samples;
    size_t count;
    sa_line *line;
    sa_line_end (*end)[2];
} joined;

/* The line that goes on from this one, or line_count. */
static size_t next_of(const sa_line_store *s, size_t line)
{
    const sa_line_end *end = &s->end[line][1];
    return !s->line[line].closed && end->beyond == SA_BEYOND_BRANCH ? end->number : s->line_count;
}

static int has_previous(const sa_line_store *s, size_t line)
{
    return !s->line[line].closed && s->end[line][0].beyond == SA_BEYOND_BRANCH;
}

/* One line from "first" on, to the last or round to the first. */
static cv_status join_from(joined *out, char *used, const sa_line_store *s, size_t first)
{
    sa_line *line = &out->line[out->count];
    size_t last = first, at = first;
    *line = (sa_line){.first = out->samples.count, .closed = s->line[first].closed};
    for (; at < s->line_count && !used[at]; at = next_of(s, at)) {
        const sa_line *part = &s->line[at];
        used[at] = 1;
        last = at;
        for (size_t i = 0; i < part->count; ++i)
            if (sa_line_samples_add(&out->samples, &s->samples.item[part->first + i]) != CV_OK)
                return CV_FAILED;
    }
    line->closed |= at < s->line_count;
    line->count = out->samples.count - line->first;
    out->end[out->count][0] = s->end[first][0];
    out->end[out->count][1] = s->end[last][1];
    ++out->count;
    return CV_OK;
}

static void replace(sa_line_store *s, const joined *by)
{
    free(s->samples.item);
    free(s->line);
    free(s->end);
    s->samples = by->samples;
    s->line = by->line;
    s->end = by->end;
    s->line_count = by->count;
}

cv_status sa_lines_join(sa_lines *lines)
{
    sa_line_store *s = lines->store;
    const size_t n = s->line_count;
    joined out = {.line = calloc(n + 1, sizeof *out.line), .end = calloc(n + 1, sizeof *out.end)};
    char *used = calloc(n + 1, 1);
    cv_status status = out.line != NULL && out.end != NULL && used != NULL ? CV_OK : CV_FAILED;
    for (int rings = 0; rings < 2; ++rings) /* first those with a beginning */
        for (size_t i = 0; i < n && status == CV_OK; ++i)
            if (!used[i] && (rings || !has_previous(s, i)))
                status = join_from(&out, used, s, i);
    free(used);
    if (status == CV_OK) {
        replace(s, &out);
        lines->line_count = s->line_count;
    } else {
        free(out.samples.item);
        free(out.line);
        free(out.end);
    }
    return status;
}
