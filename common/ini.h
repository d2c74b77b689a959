/* The sections and keys of an INI file as text, with the line each stands on. Used by casefile.c only. */
#ifndef CRITVEL_COMMON_INI_H
#define CRITVEL_COMMON_INI_H

#include <stddef.h>

#include "common/status.h"

typedef struct {
    char *key;
    char *value; /* without comment and outer blanks; may be empty */
    int line;    /* from 1 */
} cv_ini_entry;

typedef struct {
    char *name; /* between the brackets, without outer blanks */
    int line;
    size_t count;
    cv_ini_entry *entries; /* no two with the same key */
} cv_ini_section;

typedef struct {
    char *path;
    size_t count;
    cv_ini_section *sections; /* in the order of the file; names may repeat */
} cv_ini;

/* Reads a whole file: UTF-8 text (a byte order mark is skipped) in lines that end with LF or CR LF, each
 * "[section]", "key = value" (or "key: value"), or empty; ';' or '#' at the beginning of a line or after a
 * blank starts a comment. Leading blanks mean nothing.
 * CV_BAD_INPUT "path: ..." or "path:line: ..." for a file that cannot be opened, is a directory, is empty, is
 * larger than 4 MiB or is not such text, for lines over 65536 bytes, for a key twice in a section and
 * for more than 10000 sections or 1000 keys in one.
 * CV_FAILED: out of memory, read error. On failure nothing is allocated. */
cv_status cv_ini_read(cv_ini *out, const char *path, cv_message *why);
void cv_ini_clear(cv_ini *ini);

/* The entry of that key, or NULL. */
const cv_ini_entry *cv_ini_find(const cv_ini_section *s, const char *key);

/* cv_fail with "path:line: " in front (line 0: "path: "); of a long path only the end is shown. */
cv_status cv_ini_fail(cv_message *why, cv_status code, const char *path, int line, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

#endif
