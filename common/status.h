/* Status codes and one-line messages, used by every library entry point.
 * The values of CV_OK, CV_BAD_INPUT and CV_FAILED are the exit statuses of the programs. */
#ifndef CRITVEL_COMMON_STATUS_H
#define CRITVEL_COMMON_STATUS_H

typedef enum {
    CV_OK = 0,        /* done, every promise of the header holds */
    CV_UNDECIDED = 1, /* the largest precision allowed could not decide; never counts as agreement */
    CV_BAD_INPUT = 2, /* the caller's data are wrong; the message says what and, for files, where */
    CV_FAILED = 3     /* out of memory, I/O, or a library that reported an error */
} cv_status;

enum { CV_MESSAGE_SIZE = 512 };

typedef struct {
    char text[CV_MESSAGE_SIZE]; /* one line, no newline, always terminated */
} cv_message;

/* Writes the formatted message (cut at CV_MESSAGE_SIZE - 1 characters) and returns code, so that a
 * failing function can end with "return cv_fail(why, CV_FAILED, ...)". why may be NULL. */
cv_status cv_fail(cv_message *why, cv_status code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
