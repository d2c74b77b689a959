#include "common/status.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>

cv_status cv_fail(cv_message *why, cv_status code, const char *format, ...)
{
    if (why != NULL) {
        va_list args;
        va_start(args, format);
        if (vsnprintf(why->text, sizeof why->text, format, args) < 0)
            why->text[0] = '\0';
        for (char *c = why->text; *c != '\0'; ++c)
            if (iscntrl((unsigned char)*c)) /* of a file name, say */
                *c = '?';
        va_end(args);
    }
    return code;
}
