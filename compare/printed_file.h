/* data/printed.ini as it was compiled in. */
#ifndef CRITVEL_COMPARE_PRINTED_FILE_H
#define CRITVEL_COMPARE_PRINTED_FILE_H

#include <stddef.h>

#include "common/params.h"

enum { CMP_PRINTED_ENTRIES = 40, CMP_PRINTED_TEXT = 128 };

/* One section [kind key] with its values; "" where a key is missing. */
typedef struct {
    char kind[32], key[32];
    char item[CMP_PRINTED_TEXT], where[CMP_PRINTED_TEXT], printed[CMP_PRINTED_TEXT], meant[CMP_PRINTED_TEXT];
    char parameters[CMP_PRINTED_TEXT];
} cmp_printed_entry;

typedef struct {
    size_t count;
    cmp_printed_entry entries[CMP_PRINTED_ENTRIES];
} cmp_printed_file;

/* CV_FAILED: the file as compiled in is not what this program understands. */
cv_status cmp_printed_file_read(cmp_printed_file *out, cv_message *why);

/* The parameters of case "key" of table 1, without damping; out initialised. */
cv_status cmp_printed_case(cv_params *out, const cmp_printed_file *file, const char *key, cv_message *why);

#endif
