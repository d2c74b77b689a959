#include "compare/table.h"

#include <stdlib.h>
#include <string.h>

void cmp_table_init(cmp_table *t, const char *align)
{
    *t = (cmp_table){.columns = strlen(align), .align = align};
}

void cmp_table_clear(cmp_table *t)
{
    for (size_t i = 0; i < t->rows * t->columns; i++)
        free(t->cells[i]);
    free(t->cells);
    t->cells = NULL;
    t->rows = t->capacity = 0;
}

static int make_room(cmp_table *t)
{
    if (t->rows < t->capacity)
        return 1;
    const size_t capacity = 2 * t->capacity + 8;
    char **cells = realloc(t->cells, capacity * t->columns * sizeof *cells);
    if (cells == NULL)
        return 0;
    t->cells = cells;
    t->capacity = capacity;
    return 1;
}

void cmp_table_add(cmp_table *t, const char *const cells[])
{
    if (t->failed || !make_room(t)) {
        t->failed = 1;
        return;
    }
    char **row = t->cells + t->rows * t->columns;
    for (size_t i = 0; i < t->columns; i++) {
        row[i] = strdup(cells[i]);
        t->failed |= row[i] == NULL;
    }
    t->rows++;
}

static size_t width(const cmp_table *t, size_t column)
{
    size_t widest = 0;
    for (size_t r = 0; r < t->rows; r++) {
        const size_t length = strlen(t->cells[r * t->columns + column]);
        widest = length > widest ? length : widest;
    }
    return widest;
}

/* One line; blanks are held back until something follows them. */
static void print_line(const cmp_table *t, FILE *out, int indent, char *const *row)
{
    size_t blanks = (size_t)indent;
    for (size_t c = 0; c < t->columns; c++) {
        const size_t full = width(t, c), length = row != NULL ? strlen(row[c]) : full;
        const size_t before = t->align[c] == 'r' ? full - length : 0;
        if (length > 0)
            fprintf(out, "%*s", (int)(blanks + before), "");
        for (size_t i = 0; row == NULL && i < full; i++)
            fputc('-', out);
        if (row != NULL)
            fputs(row[c], out);
        blanks = length > 0 ? full - before - length + 2 : blanks + full + 2;
    }
    fputc('\n', out);
}

cv_status cmp_table_print(const cmp_table *t, FILE *out, int indent, cv_message *why)
{
    if (t->failed)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t r = 0; r < t->rows; r++) {
        print_line(t, out, indent, t->cells + r * t->columns);
        if (r == 0)
            print_line(t, out, indent, NULL);
    }
    return CV_OK;
}
