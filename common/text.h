/* A text file in memory. Used by ini.c only. */
#ifndef CRITVEL_COMMON_TEXT_H
#define CRITVEL_COMMON_TEXT_H

#include <stddef.h>

#include "common/status.h"

/* The bytes of the file at path, n of them, followed by a NUL; the caller frees *out. CV_BAD_INPUT when it
 * cannot be opened, is a directory or is larger than limit; CV_FAILED: out of memory, read error. Messages do
 * not name the path. */
cv_status cv_text_read(char **out, size_t *n, const char *path, size_t limit, cv_message *why);

/* The 1-based line of the first byte that is not text, 0 when all are. Text is well-formed UTF-8 without
 * control characters other than tab, LF, and CR before LF. */
int cv_text_first_bad_line(const char *text, size_t n);

#endif
