/* Tables of text whose columns line up. */
#ifndef CRITVEL_COMPARE_TABLE_H
#define CRITVEL_COMPARE_TABLE_H

#include <stdio.h>

#include "common/status.h"

typedef struct {
    size_t columns, rows, capacity;
    char **cells;      /* row after row, copies */
    const char *align; /* one letter per column: 'l' or 'r' */
    int failed;        /* out of memory; printing then reports it */
} cmp_table;

/* align has one letter per column and outlives the table. */
void cmp_table_init(cmp_table *t, const char *align);
void cmp_table_clear(cmp_table *t);

/* cells[0 .. columns-1] are copied. The first row added is the heading. */
void cmp_table_add(cmp_table *t, const char *const cells[]);

/* Heading, a line of dashes, rows; each line indented and without trailing blanks. CV_FAILED when out of
 * memory. */
cv_status cmp_table_print(const cmp_table *t, FILE *out, int indent, cv_message *why);

#endif
