/* A report into a file, whole or not at all. */
#ifndef CRITVEL_COMMON_OUTPUT_H
#define CRITVEL_COMMON_OUTPUT_H

#include <stddef.h>

#include "common/status.h"

/* Whether path could be written now: not a directory, and its folder exists and may be written to. CV_FAILED
 * says why not. Asked before the work, so that a long run does not end with this message. */
cv_status cv_output_check(const char *path, cv_message *why);

/* Writes n bytes to path. A regular or new file is written beside path under a temporary name, flushed to
 * disk and renamed, so that path holds the old or the new content, never half; what a link points to is
 * replaced, not the link. A device or pipe is written directly. CV_FAILED: nothing changed (device: perhaps
 * some was written). */
cv_status cv_output_write(const char *path, const char *bytes, size_t n, cv_message *why);

#endif
