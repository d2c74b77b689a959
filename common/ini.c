/* inih splits "key = value"; this file feeds it through a reader of its own, because inih by itself neither
 * tells the line of a key nor sees an empty section, cuts names at 49 characters, splits lines at 200 and
 * takes an indented key for the continuation of the one before. */
#include "common/ini.h"

#include <ini.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/text.h"

enum {
    MAX_FILE = 4 << 20,
    MAX_LINE = 65536,
    MAX_SECTIONS = 10000,  /* so that looking for duplicates stays quick */
    MAX_KEYS = 1000,       /* of a section */
    MAX_SECTION_NAME = 49, /* what inih keeps of one */
    SHOWN = 60             /* characters of the file that a message repeats */
};

/* State of one pass through the text. */
typedef struct {
    cv_ini *ini;
    char *next;       /* the text after the current line; NULL at the end */
    char *rest;       /* what of the current line inih has not got yet; NULL: nothing */
    int line;         /* number of the current line */
    int continuation; /* the piece inih has now is not the first of its line */
    cv_status status; /* of the first error; ends the pass */
    cv_message *why;
} reader;

cv_status cv_ini_fail(cv_message *why, cv_status code, const char *path, int line, const char *format, ...)
{
    enum { PATH_SHOWN = 200 };
    char what[CV_MESSAGE_SIZE];
    va_list args;
    va_start(args, format);
    if (vsnprintf(what, sizeof what, format, args) < 0)
        what[0] = '\0';
    va_end(args);
    const size_t n = strlen(path);
    const char *end = n > PATH_SHOWN ? path + n - PATH_SHOWN : path;
    const char *dots = n > PATH_SHOWN ? "..." : "";
    if (line > 0)
        return cv_fail(why, code, "%s%s:%d: %s", dots, end, line, what);
    return cv_fail(why, code, "%s%s: %s", dots, end, what);
}

const cv_ini_entry *cv_ini_find(const cv_ini_section *s, const char *key)
{
    for (size_t i = 0; i < s->count; ++i)
        if (strcmp(s->entries[i].key, key) == 0)
            return &s->entries[i];
    return NULL;
}

void cv_ini_clear(cv_ini *ini)
{
    for (size_t i = 0; i < ini->count; ++i) {
        cv_ini_section *s = &ini->sections[i];
        for (size_t j = 0; j < s->count; ++j) {
            free(s->entries[j].key);
            free(s->entries[j].value);
        }
        free(s->entries);
        free(s->name);
    }
    free(ini->sections);
    free(ini->path);
    *ini = (cv_ini){0};
}

static int out_of_memory(reader *r)
{
    r->status = cv_fail(r->why, CV_FAILED, "out of memory");
    return 0;
}

#define WRONG(r, ...)                                                                                        \
    ((r)->status = cv_ini_fail((r)->why, CV_BAD_INPUT, (r)->ini->path, (r)->line, __VA_ARGS__))

static char *strip(char *s)
{
    s += strspn(s, " \t");
    size_t n = strlen(s);
    while (n > 0 && strchr(" \t\r", s[n - 1]) != NULL)
        --n;
    s[n] = '\0';
    return s;
}

/* Cuts the comment off: ';' or '#' at the beginning or after a blank. */
static void cut_comment(char *s)
{
    for (char *c = s; (c = strpbrk(c, ";#")) != NULL; ++c)
        if (c == s || c[-1] == ' ' || c[-1] == '\t') {
            *c = '\0';
            return;
        }
}

static int add_section(reader *r, const char *name, size_t length)
{
    cv_ini *ini = r->ini;
    if (ini->count == MAX_SECTIONS) {
        WRONG(r, "more than %d sections", MAX_SECTIONS);
        return 0;
    }
    cv_ini_section *larger = realloc(ini->sections, (ini->count + 1) * sizeof *larger);
    if (larger == NULL)
        return out_of_memory(r);
    ini->sections = larger;
    char *copy = strndup(name, length);
    if (copy == NULL)
        return out_of_memory(r);
    ini->sections[ini->count++] = (cv_ini_section){.name = copy, .line = r->line};
    return 1;
}

/* A stripped line that begins with '[' */
static int open_section(reader *r, const char *s)
{
    const char *end = strchr(s, ']');
    if (end == NULL || end[1] != '\0') {
        WRONG(r, "expected '[section]' and nothing else on the line");
        return 0;
    }
    if (end - s - 1 > MAX_SECTION_NAME) {
        WRONG(r, "section name of more than %d bytes", MAX_SECTION_NAME);
        return 0;
    }
    const char *name = s + 1 + strspn(s + 1, " \t");
    while (end > name && (end[-1] == ' ' || end[-1] == '\t'))
        --end;
    return add_section(r, name, (size_t)(end - name));
}

/* A stripped line that is not empty and not a section */
static int check_key(reader *r, const char *s)
{
    const char *separator = strpbrk(s, "=:");
    if (separator == NULL || separator == s)
        WRONG(r, "expected 'key = value', found '%.*s%s'", SHOWN, s, strlen(s) > SHOWN ? "..." : "");
    else if (r->ini->count == 0)
        WRONG(r, "key before the first section");
    return r->status == CV_OK;
}

/* Steps to the next line that holds something and sets rest to it; 0 at the end of the text or on error. */
static int next_line(reader *r)
{
    while (r->next != NULL) {
        char *s = r->next;
        char *end = strchr(s, '\n');
        const size_t n = end != NULL ? (size_t)(end - s) : strlen(s);
        r->next = end != NULL ? end + 1 : NULL;
        s[n] = '\0';
        ++r->line;
        if (n > MAX_LINE) {
            WRONG(r, "line of more than %d bytes", MAX_LINE);
            return 0;
        }
        cut_comment(s);
        s = strip(s);
        if (*s == '\0')
            continue;
        r->rest = s;
        r->continuation = 0;
        return *s == '[' ? open_section(r, s) : check_key(r, s);
    }
    return 0;
}

/* Bytes of rest that fit into room, cut before a blank after the '='; 0 when that is impossible. */
static size_t piece(const char *rest, size_t room, int first)
{
    if (strlen(rest) <= room)
        return strlen(rest);
    const size_t least = first ? strcspn(rest, "=:") + 1 : 1;
    for (size_t n = room; n >= least; --n)
        if (rest[n] == ' ' || rest[n] == '\t')
            return n;
    return 0;
}

/* The ini_reader: a line, or of one that is longer than inih's buffer the next piece, which a leading blank
 * makes a continuation. The buffer is never filled: later versions of inih take a full one for a line cut off
 * and drop what follows. */
static char *deliver(char *buffer, int size, void *stream)
{
    reader *r = stream;
    if (r->status != CV_OK)
        return NULL;
    if (r->rest != NULL)
        r->continuation = 1;
    else if (!next_line(r))
        return NULL;
    const int room = size - 4;
    const size_t n = piece(r->rest, (size_t)room, !r->continuation);
    if (n == 0) {
        WRONG(r, "a word of more than %d bytes", room);
        return NULL;
    }
    snprintf(buffer, (size_t)size, "%s%.*s", r->continuation ? " " : "", (int)n, r->rest);
    r->rest += n;
    r->rest += strspn(r->rest, " \t");
    if (*r->rest == '\0')
        r->rest = NULL;
    return buffer;
}

static int append(reader *r, cv_ini_entry *e, const char *value)
{
    const size_t old = strlen(e->value), size = old + strlen(value) + 2;
    char *longer = realloc(e->value, size);
    if (longer == NULL)
        return out_of_memory(r);
    e->value = longer;
    snprintf(longer + old, size - old, " %s", value);
    return 1;
}

static int add_entry(reader *r, cv_ini_section *s, const char *key, const char *value)
{
    const cv_ini_entry *first = cv_ini_find(s, key);
    if (first != NULL) {
        WRONG(r, "duplicate key '%s' (first on line %d)", key, first->line);
        return 0;
    }
    if (s->count == MAX_KEYS) {
        WRONG(r, "more than %d keys in a section", MAX_KEYS);
        return 0;
    }
    cv_ini_entry *larger = realloc(s->entries, (s->count + 1) * sizeof *larger);
    if (larger == NULL)
        return out_of_memory(r);
    s->entries = larger;
    cv_ini_entry e = {strdup(key), strdup(value), r->line};
    if (e.key == NULL || e.value == NULL) {
        free(e.key);
        free(e.value);
        return out_of_memory(r);
    }
    s->entries[s->count++] = e;
    return 1;
}

/* The ini_handler: called after each piece that is not a section. */
static int take(void *user, const char *section, const char *key, const char *value)
{
    reader *r = user;
    (void)section; /* inih cannot tell two sections of one name; add_section can */
    if (r->status != CV_OK)
        return 0;
    cv_ini_section *s = &r->ini->sections[r->ini->count - 1];
    return r->continuation ? append(r, &s->entries[s->count - 1], value) : add_entry(r, s, key, value);
}

/* Splits the text, which is modified. */
static cv_status split(cv_ini *ini, char *text, cv_message *why)
{
    reader r = {.ini = ini, .next = text, .why = why};
    if (strncmp(text, "\xEF\xBB\xBF", 3) == 0)
        r.next += 3;
    const int result = ini_parse_stream(deliver, &r, take, &r);
    if (r.status == CV_OK && result != 0) /* next_line refuses first whatever inih would refuse */
        return cv_ini_fail(why, CV_FAILED, ini->path, 0, "inih failed with %d", result);
    return r.status;
}

static cv_status read_text(char **text, const char *path, cv_message *why)
{
    cv_message reason;
    size_t n = 0;
    const cv_status status = cv_text_read(text, &n, path, MAX_FILE, &reason);
    if (status != CV_OK)
        return cv_ini_fail(why, status, path, 0, "%s", reason.text);
    const int bad = cv_text_first_bad_line(*text, n);
    if (bad == 0 && n > 0)
        return CV_OK;
    free(*text);
    if (n == 0)
        return cv_ini_fail(why, CV_BAD_INPUT, path, 0, "the file is empty");
    return cv_ini_fail(why, CV_BAD_INPUT, path, bad, "not text (a control character or malformed UTF-8)");
}

cv_status cv_ini_read(cv_ini *out, const char *path, cv_message *why)
{
    char *text = NULL;
    cv_status status = read_text(&text, path, why);
    if (status != CV_OK)
        return status;
    *out = (cv_ini){.path = strdup(path)};
    status = out->path != NULL ? split(out, text, why) : cv_fail(why, CV_FAILED, "out of memory");
    free(text);
    if (status != CV_OK)
        cv_ini_clear(out);
    return status;
}
