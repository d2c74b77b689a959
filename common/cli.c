#include "common/cli.h"

#include <errno.h>
#include <getopt.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "common/casefile.h"

enum { MAX_OPTIONS = 32, SHOWN = 60, LONG_OPTION = 256 };

cv_status cv_set_text(void *to, const char *text, cv_message *why)
{
    (void)why;
    *(const char **)to = text;
    return CV_OK;
}

cv_status cv_set_number(void *to, const char *text, cv_message *why)
{
    cv_optional_number *x = to;
    x->given = 1;
    return cv_number_parse(&x->value, text, why);
}

cv_status cv_set_digits(void *to, const char *text, cv_message *why)
{
    const size_t n = strlen(text);
    const long value = n <= 9 && strspn(text, "0123456789") == n ? strtol(text, NULL, 10) : 0;
    if (value < 1 || value > CV_DIGITS_MAX)
        return cv_fail(why, CV_BAD_INPUT, "'%.*s' is not a whole number from 1 to %d", SHOWN, text,
                       CV_DIGITS_MAX);
    *(int *)to = (int)value;
    return CV_OK;
}

cv_status cv_set_format(void *to, const char *text, cv_message *why)
{
    if (strcmp(text, "text") == 0)
        *(cv_format *)to = CV_FORMAT_TEXT;
    else if (strcmp(text, "json") == 0)
        *(cv_format *)to = CV_FORMAT_JSON;
    else
        return cv_fail(why, CV_BAD_INPUT, "'%.*s' is neither text nor json", SHOWN, text);
    return CV_OK;
}

cv_status cv_set_flag(void *to, const char *text, cv_message *why)
{
    (void)text;
    (void)why;
    *(int *)to = 1;
    return CV_OK;
}

/* The tables for getopt_long: the program's options, then --help and --version, and ":x:" for those of one
 * letter, which take a value; returns how many the program has. Long ones are told apart by their index, so
 * that val only has to differ from letters and getopt_long's own answers. */
static int fill_tables(struct option *table, char *letters, const cv_program *program)
{
    int n = 0;
    *letters++ = ':';
    for (; n < MAX_OPTIONS && program->options[n].name != NULL; ++n) {
        const cv_option *o = &program->options[n];
        table[n] = (struct option){o->name, o->is_flag ? no_argument : required_argument, NULL, LONG_OPTION};
        if (o->name[1] == '\0') {
            *letters++ = o->name[0];
            *letters++ = ':';
        }
    }
    *letters = '\0';
    table[n] = (struct option){"help", no_argument, NULL, LONG_OPTION};
    table[n + 1] = (struct option){"version", no_argument, NULL, LONG_OPTION};
    table[n + 2] = (struct option){NULL, 0, NULL, 0};
    return n;
}

static int index_of_letter(const cv_program *program, int letter)
{
    int i = 0;
    while (program->options[i].name[0] != letter || program->options[i].name[1] != '\0')
        ++i;
    return i;
}

static cv_status apply(void *options, const cv_option *option, const char *text, int *seen, cv_message *why)
{
    const char *const dashes = option->name[1] == '\0' ? "-" : "--";
    cv_message reason = {""};
    if (*seen)
        return cv_fail(why, CV_BAD_INPUT, "option %s%s given twice", dashes, option->name);
    *seen = 1;
    const cv_status status = option->set((char *)options + option->offset, text, &reason);
    if (status != CV_OK)
        return cv_fail(why, status, "%s%s: %s", dashes, option->name, reason.text);
    return CV_OK;
}

static cv_status read_options(void *options, cv_cli_action *action, const cv_program *program, int argc,
                              char **argv, cv_message *why)
{
    struct option table[MAX_OPTIONS + 3];
    char letters[2 * MAX_OPTIONS + 2];
    int seen[MAX_OPTIONS] = {0};
    const int count = fill_tables(table, letters, program);
    opterr = 0; /* messages are ours */
    optind = 0; /* glibc: start afresh */
    *action = CV_CLI_WORK;
    for (;;) {
        int index = 0;
        const int c = getopt_long(argc, argv, letters, table, &index);
        if (c == -1)
            return CV_OK;
        if (c == ':')
            return cv_fail(why, CV_BAD_INPUT, "option '%.*s' needs a value", SHOWN, argv[optind - 1]);
        if (c == '?')
            return cv_fail(why, CV_BAD_INPUT, "unknown or ambiguous option '%.*s'; see --help", SHOWN,
                           argv[optind - 1]);
        if (c != LONG_OPTION)
            index = index_of_letter(program, c);
        if (index >= count) {
            *action = index == count ? CV_CLI_HELP : CV_CLI_VERSION;
            return CV_OK;
        }
        const cv_status status = apply(options, &program->options[index], optarg, &seen[index], why);
        if (status != CV_OK)
            return status;
    }
}

static cv_status read_command(cv_arguments *arguments, const cv_program *program, const char *word,
                              cv_message *why)
{
    for (const char *const *c = program->commands; *c != NULL; ++c)
        if (strcmp(*c, word) == 0) {
            arguments->command = *c;
            return CV_OK;
        }
    return cv_fail(why, CV_BAD_INPUT, "unknown command '%.*s'; see --help", SHOWN, word);
}

cv_status cv_cli_read(void *options, cv_arguments *arguments, cv_cli_action *action,
                      const cv_program *program, int argc, char **argv, cv_message *why)
{
    *arguments = (cv_arguments){0};
    cv_status status = read_options(options, action, program, argc, argv, why);
    if (status != CV_OK || *action != CV_CLI_WORK)
        return status;
    int next = optind; /* the first word that is not an option: getopt_long moved those to the end */
    if (program->commands != NULL && next < argc)
        status = read_command(arguments, program, argv[next++], why);
    else if (program->commands != NULL)
        status = cv_fail(why, CV_BAD_INPUT, "no command; see --help");
    if (status != CV_OK)
        return status;
    if (next >= argc)
        return cv_fail(why, CV_BAD_INPUT, "no case file; see --help");
    arguments->path = argv[next++];
    if (next < argc)
        return cv_fail(why, CV_BAD_INPUT, "surplus argument '%.*s'; see --help", SHOWN, argv[next]);
    return CV_OK;
}

cv_status cv_write_out(FILE *stream, const char *bytes, size_t n, cv_message *why)
{
    errno = 0;
    const int written = n == 0 || fwrite(bytes, 1, n, stream) == n;
    if (!written || fflush(stream) != 0)
        return cv_fail(why, CV_FAILED, "cannot write the output: %s", strerror(errno));
    return CV_OK;
}

/* The answer of the work in memory; *bytes is NULL unless it is to be written. */
static cv_status collect(char **bytes, size_t *n, const cv_program *program, const void *options,
                         const cv_arguments *arguments, cv_message *why)
{
    char *buffer = NULL;
    FILE *out = open_memstream(&buffer, n);
    if (out == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = program->work(options, arguments, out, stderr, why);
    const int incomplete = ferror(out);
    if ((fclose(out) != 0 || incomplete) && status <= CV_UNDECIDED)
        status = cv_fail(why, CV_FAILED, "out of memory for the output");
    *bytes = buffer;
    if (status > CV_UNDECIDED) {
        free(buffer);
        *bytes = NULL;
    }
    return status;
}

static cv_status answer(const cv_program *program, const void *options, const cv_arguments *arguments,
                        cv_message *why)
{
    char *bytes = NULL;
    size_t n = 0;
    cv_status status = collect(&bytes, &n, program, options, arguments, why);
    cv_message reason;
    if (bytes != NULL && cv_write_out(stdout, bytes, n, &reason) != CV_OK) {
        *why = reason;
        status = CV_FAILED;
    }
    free(bytes);
    return status;
}

static cv_status run(const cv_program *program, void *options, int argc, char **argv, cv_message *why)
{
    cv_arguments arguments;
    cv_cli_action action;
    const cv_status status = cv_cli_read(options, &arguments, &action, program, argc, argv, why);
    if (status != CV_OK)
        return status;
    if (action == CV_CLI_HELP)
        return cv_write_out(stdout, program->help, strlen(program->help), why);
    if (action == CV_CLI_WORK)
        return answer(program, options, &arguments, why);
    char version[80];
    const int n = snprintf(version, sizeof version, "%s %s\n", program->name, CV_VERSION);
    return cv_write_out(stdout, version, n > 0 ? (size_t)n : 0, why);
}

int cv_main(const cv_program *program, void *options, int argc, char **argv)
{
    cv_message why = {""};
    signal(SIGPIPE, SIG_IGN);
    const cv_status status = run(program, options, argc, argv, &why);
    if (why.text[0] != '\0')
        fprintf(stderr, "%s: %s\n", program->name, why.text);
    return (int)status;
}
