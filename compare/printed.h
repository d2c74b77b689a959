/* What the paper prints beside what is computed here. Nothing is tuned to the print. */
#ifndef CRITVEL_COMPARE_PRINTED_H
#define CRITVEL_COMPARE_PRINTED_H

#include <stddef.h>

#include "common/status.h"

enum { CMP_PRINTED_SIZE = 80 };

typedef struct {
    char item[CMP_PRINTED_SIZE];     /* what */
    char where[CMP_PRINTED_SIZE];    /* section or equation of the paper */
    char printed[CMP_PRINTED_SIZE];  /* as printed */
    char computed[CMP_PRINTED_SIZE]; /* to a digit or two more than printed */
    int agrees;                      /* computed, rounded as the print is, is the print */
} cmp_printed_row;

typedef struct {
    size_t count;
    cmp_printed_row *rows;
} cmp_printed;

#endif
