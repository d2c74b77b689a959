#include "common/text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static cv_status grow(char **buffer, size_t size, cv_message *why)
{
    char *larger = realloc(*buffer, size);
    if (larger == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    *buffer = larger;
    return CV_OK;
}

static cv_status read_stream(char **buffer, size_t *n, FILE *in, size_t limit, cv_message *why)
{
    size_t room = 4096;
    cv_status status = grow(buffer, room, why);
    *n = 0;
    while (status == CV_OK) {
        const size_t got = fread(*buffer + *n, 1, room - 1 - *n, in);
        *n += got;
        if (*n > limit)
            return cv_fail(why, CV_BAD_INPUT, "larger than %zu bytes, which no case file is", limit);
        if (got == 0)
            break;
        if (*n == room - 1)
            status = grow(buffer, room *= 2, why);
    }
    if (status != CV_OK)
        return status;
    if (ferror(in))
        return cv_fail(why, CV_FAILED, "cannot read: %s", strerror(errno));
    (*buffer)[*n] = '\0';
    return CV_OK;
}

cv_status cv_text_read(char **out, size_t *n, const char *path, size_t limit, cv_message *why)
{
    struct stat info;
    FILE *in = fopen(path, "rb");
    if (in == NULL)
        return cv_fail(why, CV_BAD_INPUT, "cannot open: %s", strerror(errno));
    char *buffer = NULL;
    cv_status status;
    if (fstat(fileno(in), &info) == 0 && S_ISDIR(info.st_mode))
        status = cv_fail(why, CV_BAD_INPUT, "is a directory");
    else
        status = read_stream(&buffer, n, in, limit, why);
    fclose(in); /* opened for reading: nothing can be lost */
    if (status == CV_OK)
        *out = buffer;
    else
        free(buffer);
    return status;
}

static int is_tail(unsigned char c)
{
    return (c & 0xC0) == 0x80;
}

/* Length of the well-formed UTF-8 sequence at s (n bytes left), 0 when there is none (Unicode 15, table 3-7:
 * no overlong forms, no surrogates, nothing above U+10FFFF). */
static size_t sequence(const unsigned char *s, size_t n)
{
    if (s[0] < 0x80)
        return 1;
    if (s[0] >= 0xC2 && s[0] <= 0xDF)
        return n >= 2 && is_tail(s[1]) ? 2 : 0;
    if (s[0] >= 0xE0 && s[0] <= 0xEF) {
        const int range =
            (s[0] != 0xE0 || (n >= 2 && s[1] >= 0xA0)) && (s[0] != 0xED || (n >= 2 && s[1] <= 0x9F));
        return n >= 3 && range && is_tail(s[1]) && is_tail(s[2]) ? 3 : 0;
    }
    if (s[0] >= 0xF0 && s[0] <= 0xF4) {
        const int range =
            (s[0] != 0xF0 || (n >= 2 && s[1] >= 0x90)) && (s[0] != 0xF4 || (n >= 2 && s[1] <= 0x8F));
        return n >= 4 && range && is_tail(s[1]) && is_tail(s[2]) && is_tail(s[3]) ? 4 : 0;
    }
    return 0;
}

static int is_control(const unsigned char *s, size_t n)
{
    if (*s == '\r')
        return n < 2 || s[1] != '\n';
    return (*s < 0x20 && *s != '\t' && *s != '\n') || *s == 0x7F;
}

int cv_text_first_bad_line(const char *text, size_t n)
{
    const unsigned char *s = (const unsigned char *)text;
    int line = 1;
    for (size_t i = 0; i < n;) {
        const size_t length = is_control(s + i, n - i) ? 0 : sequence(s + i, n - i);
        if (length == 0)
            return line;
        line += s[i] == '\n';
        i += length;
    }
    return 0;
}
