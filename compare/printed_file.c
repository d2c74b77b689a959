#include "compare/printed_file.h"

#include <ini.h>
#include <stdio.h>
#include <string.h>

static const char CONTENT[] = {
#include "printed_ini.inc"
    0};

static int copy(char *to, size_t size, const char *from)
{
    return (size_t)snprintf(to, size, "%s", from) < size;
}

/* The entry of the section, the last one or a new one; NULL when there is no room or no "kind key". */
static cmp_printed_entry *entry_of(cmp_printed_file *file, const char *section)
{
    cmp_printed_entry fresh = {.kind = ""};
    const char *blank = strchr(section, ' ');
    if (blank == NULL || (size_t)(blank - section) >= sizeof fresh.kind)
        return NULL;
    memcpy(fresh.kind, section, (size_t)(blank - section));
    if (!copy(fresh.key, sizeof fresh.key, blank + 1))
        return NULL;
    if (file->count > 0) {
        cmp_printed_entry *last = &file->entries[file->count - 1];
        if (strcmp(last->kind, fresh.kind) == 0 && strcmp(last->key, fresh.key) == 0)
            return last;
    }
    if (file->count == CMP_PRINTED_ENTRIES)
        return NULL;
    file->entries[file->count] = fresh;
    return &file->entries[file->count++];
}

static int take(void *user, const char *section, const char *name, const char *value)
{
    cmp_printed_entry *e = entry_of(user, section);
    if (e == NULL)
        return 0;
    if (strcmp(name, "item") == 0)
        return copy(e->item, sizeof e->item, value);
    if (strcmp(name, "where") == 0)
        return copy(e->where, sizeof e->where, value);
    if (strcmp(name, "printed") == 0)
        return copy(e->printed, sizeof e->printed, value);
    if (strcmp(name, "meant") == 0)
        return copy(e->meant, sizeof e->meant, value);
    return strcmp(name, "parameters") == 0 && copy(e->parameters, sizeof e->parameters, value);
}

cv_status cmp_printed_file_read(cmp_printed_file *out, cv_message *why)
{
    out->count = 0;
    const int line = ini_parse_string(CONTENT, take, out);
    return line == 0 ? CV_OK : cv_fail(why, CV_FAILED, "data/printed.ini as compiled in: line %d", line);
}

cv_status cmp_printed_case(cv_params *out, const cmp_printed_file *file, const char *key, cv_message *why)
{
    cv_number *const fields[] = {&out->mu_s,    &out->mu_b,  &out->kappa_p,
                                 &out->kappa_b, &out->eta_s, &out->eta_N};
    size_t i = 0, read = 0;
    while (i < file->count &&
           (strcmp(file->entries[i].kind, "case") != 0 || strcmp(file->entries[i].key, key) != 0))
        i++;
    if (i == file->count)
        return cv_fail(why, CV_FAILED, "data/printed.ini as compiled in: no case %s", key);
    char text[CMP_PRINTED_TEXT], *rest = NULL;
    memcpy(text, file->entries[i].parameters, sizeof text);
    for (char *word = strtok_r(text, " ", &rest); word != NULL && read < 6;
         word = strtok_r(NULL, " ", &rest)) {
        cv_status status = cv_number_parse(fields[read++], word, why);
        if (status != CV_OK)
            return status;
    }
    return read == 6 ? CV_OK
                     : cv_fail(why, CV_FAILED, "data/printed.ini as compiled in: parameters of case %s", key);
}
