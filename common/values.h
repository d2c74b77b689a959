/* Numbers out of the entries of an INI section. Used by casefile.c only. */
#ifndef CRITVEL_COMMON_VALUES_H
#define CRITVEL_COMMON_VALUES_H

#include <stddef.h>

#include "common/ini.h"
#include "common/number.h"

typedef struct {
    size_t count;
    cv_number *items;
} cv_number_list; /* {0} is empty */

void cv_number_list_clear(cv_number_list *list);
cv_status cv_number_list_copy(cv_number_list *to, const cv_number_list *from, cv_message *why);

/* A key that holds one number. */
typedef struct {
    const char *key;
    size_t offset;  /* of the cv_number in the structure that is read */
    int least_sign; /* 1: > 0, 0: >= 0, -1: any */
    int required;
} cv_number_rule;

/* The numbers of an entry, separated by blanks, at least one, each with at least the given sign. list must be
 * empty, and is empty after a failure. CV_BAD_INPUT "path:line: key: what is wrong". */
cv_status cv_values_list(cv_number_list *list, const cv_ini_entry *e, int least_sign, const char *path,
                         cv_message *why);

/* Every entry of a section into the structure at base, whose numbers are initialised. CV_BAD_INPUT for a key
 * that no rule has, a required key that is missing (at the line of the section) and what cv_values_list
 * refuses. */
cv_status cv_values_section(void *base, const cv_number_rule *rules, size_t rule_count,
                            const cv_ini_section *s, const char *path, cv_message *why);

cv_status cv_values_unknown_key(const cv_ini_section *s, const cv_ini_entry *e, const char *path,
                                cv_message *why);

#endif
