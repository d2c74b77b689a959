/* What the paper prints (data/printed.ini, compiled in) beside what is computed here. Nothing is tuned to the
 * print. */
#ifndef CRITVEL_COMPARE_PRINTED_H
#define CRITVEL_COMPARE_PRINTED_H

#include "compare/run.h"

enum { CMP_PRINTED_SIZE = 128 };

/* One line of the report; empty strings never. */
typedef struct {
    char item[CMP_PRINTED_SIZE];     /* what */
    char where[CMP_PRINTED_SIZE];    /* section or equation of the paper */
    char printed[CMP_PRINTED_SIZE];  /* as printed, or computed from the formula as printed */
    char computed[CMP_PRINTED_SIZE]; /* to a few digits more than printed */
    int agrees;                      /* computed, rounded as the print is, is the print */
} cmp_printed_row;

typedef struct {
    size_t count;
    cmp_printed_row *rows;
} cmp_printed;

/* The rows that concern the run: those of a case of table 1 when a case of the run has exactly its parameters
 * (whatever its name), the general ones when any has. *out is empty, and needs no clearing, on failure. */
cv_status cmp_printed_make(cmp_printed *out, const cmp_run *run, cv_message *why);
void cmp_printed_clear(cmp_printed *p);

#endif
