/* The command line, the same for all programs: a table of options, a subcommand, one FILE, and the way an
 * answer or an error leaves the process. A program's main is one call of cv_main. */
#ifndef CRITVEL_COMMON_CLI_H
#define CRITVEL_COMMON_CLI_H

#include <stddef.h>
#include <stdio.h>

#include "common/number.h"
#include "common/status.h"

#define CV_VERSION "0.1.0"

/* Stores the text of one option at "to", or refuses it (CV_BAD_INPUT; the option's name is put before the
 * message by the caller). */
typedef cv_status cv_setter(void *to, const char *text, cv_message *why);

typedef struct {
    const char *name; /* without the dashes; NULL ends a table; one letter: "-o", which takes a value */
    cv_setter *set;
    size_t offset; /* of the target inside the program's options structure */
    int is_flag;   /* 1: the option takes no value and set is called with NULL */
} cv_option;

typedef struct {
    int given;
    cv_number value;
} cv_optional_number; /* a program initialises value and clears it */

typedef enum { CV_FORMAT_TEXT, CV_FORMAT_JSON } cv_format;

cv_setter cv_set_text;   /* const char *: the argument itself, not copied */
cv_setter cv_set_number; /* cv_optional_number: an exact decimal */
cv_setter cv_set_digits; /* int: 1 .. CV_DIGITS_MAX */
cv_setter cv_set_format; /* cv_format: "text" or "json" */
cv_setter cv_set_flag;   /* int: becomes 1 */

typedef struct {
    const char *command; /* one of the program's commands; NULL for a program without */
    const char *path;    /* FILE */
} cv_arguments;

/* The program's work: options is the structure the table filled. Writes its answer to out, which is memory:
 * nothing of it reaches the user unless the status is CV_OK or CV_UNDECIDED. log is for warnings and
 * progress. why is printed whenever it is not empty. */
typedef cv_status cv_work(const void *options, const cv_arguments *arguments, FILE *out, FILE *log,
                          cv_message *why);

typedef struct {
    const char *name;            /* "critvel-dgreen" */
    const char *help;            /* what --help prints, ending with a newline */
    const char *const *commands; /* NULL-terminated; NULL: the program has no subcommands */
    const cv_option *options;    /* ended by a NULL name; --help and --version are added */
    cv_work *work;
} cv_program;

typedef enum { CV_CLI_WORK, CV_CLI_HELP, CV_CLI_VERSION } cv_cli_action;

/* Reads argv into options and arguments. Options may stand anywhere and be given once; the first other word
 * is the command, where the program has commands, the next is FILE. --help and --version need neither.
 * CV_BAD_INPUT: unknown or ambiguous option or command, missing or surplus word, a value that is refused. */
cv_status cv_cli_read(void *options, cv_arguments *arguments, cv_cli_action *action,
                      const cv_program *program, int argc, char **argv, cv_message *why);

/* Writes n bytes and flushes; CV_FAILED with the system's reason (full disk, closed pipe) otherwise. The
 * stream stays open. */
cv_status cv_write_out(FILE *stream, const char *bytes, size_t n, cv_message *why);

/* The whole of main: reads the command line, does the work, writes the answer to stdout, prints
 * "program: message" on stderr and returns the exit status (the cv_status). SIGPIPE is ignored, so that a
 * closed pipe is an error like any other. options must be initialised; the caller clears it. */
int cv_main(const cv_program *program, void *options, int argc, char **argv);

#endif
