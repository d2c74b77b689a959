/* The command line and the way answers leave: in the process for reading, in child processes for streams and
 * exit statuses. */
#include <check.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/selection.h"

typedef struct {
    cv_selection selection;
    int flag;
    const char *letter;
} options;

static const char *const commands[] = {"first", "second", NULL};

static const cv_option table[] = {CV_OPTION_CASE(0),
                                  CV_OPTION_DIGITS(0),
                                  CV_OPTION_FORMAT(0),
                                  CV_OPTION_DAMPING(0),
                                  CV_OPTION_ALPHA(0),
                                  CV_OPTION_FREQUENCY(0),
                                  CV_OPTION_MASS_RATIO(0),
                                  {"flag", cv_set_flag, offsetof(options, flag), 1},
                                  {"o", cv_set_text, offsetof(options, letter), 0},
                                  {NULL, NULL, 0, 0}};

/* What the work of the test program does is named by FILE. */
static cv_status work(const void *o, const cv_arguments *arguments, FILE *out, FILE *log, cv_message *why)
{
    (void)o;
    fprintf(out, "answer %s\n", arguments->command);
    if (strcmp(arguments->path, "undecided") == 0)
        return cv_fail(why, CV_UNDECIDED, "cannot tell");
    if (strcmp(arguments->path, "failed") == 0)
        return cv_fail(why, CV_FAILED, "it failed");
    if (strcmp(arguments->path, "wrong") == 0)
        return cv_fail(why, CV_BAD_INPUT, "it is wrong");
    fprintf(log, "progress\n");
    return CV_OK;
}

static const cv_program program = {"critvel-test", "the help\n", commands, table, work};

enum { MAX_WORDS = 20 };

/* argv from words separated by blanks; the text is kept alive by the caller. */
static int split(char *argv[MAX_WORDS + 1], char *text)
{
    int n = 0;
    for (char *word = strtok(text, " "); word != NULL && n < MAX_WORDS; word = strtok(NULL, " "))
        argv[n++] = word;
    argv[n] = NULL;
    return n;
}

typedef struct {
    options o;
    cv_arguments arguments;
    cv_cli_action action;
    cv_message why;
    char text[200];
    cv_status status;
} outcome;

static void read_line(outcome *r, const char *line)
{
    char *argv[MAX_WORDS + 1];
    *r = (outcome){.why = {""}};
    cv_selection_init(&r->o.selection);
    snprintf(r->text, sizeof r->text, "critvel-test %s", line);
    const int argc = split(argv, r->text);
    r->status = cv_cli_read(&r->o, &r->arguments, &r->action, &program, argc, argv, &r->why);
}

START_TEST(everything_given)
{
    outcome r;
    read_line(&r, "second --case x --digits 30 FILE --format=json --damping 1e-10 --alpha 0.3 "
                  "--frequency -0.22 --flag");
    ck_assert_msg(r.status == CV_OK, "%s", r.why.text);
    ck_assert_int_eq(r.action, CV_CLI_WORK);
    ck_assert_str_eq(r.arguments.command, "second");
    ck_assert_str_eq(r.arguments.path, "FILE");
    ck_assert_str_eq(r.o.selection.case_name, "x");
    ck_assert_int_eq(r.o.selection.digits, 30);
    ck_assert_int_eq(r.o.selection.format, CV_FORMAT_JSON);
    ck_assert(r.o.selection.damping.given && r.o.selection.alpha.given && r.o.selection.frequency.given);
    ck_assert(!r.o.selection.mass_ratio.given);
    ck_assert(cv_number_get_double(&r.o.selection.damping.value) == 1e-10);
    ck_assert(cv_number_get_double(&r.o.selection.frequency.value) == -0.22);
    ck_assert_int_eq(r.o.flag, 1);
    cv_selection_clear(&r.o.selection);
}
END_TEST

START_TEST(option_of_one_letter)
{
    static const char *const lines[] = {"first -o DIR FILE --flag", "first FILE -oDIR --flag"};
    for (int i = 0; i < 2; i++) {
        outcome r;
        read_line(&r, lines[i]);
        ck_assert_msg(r.status == CV_OK, "%s", r.why.text);
        ck_assert_str_eq(r.o.letter, "DIR");
        ck_assert_str_eq(r.arguments.path, "FILE");
        ck_assert_int_eq(r.o.flag, 1);
        cv_selection_clear(&r.o.selection);
    }
}
END_TEST

START_TEST(nothing_given)
{
    outcome r;
    read_line(&r, "first -- --odd-name.ini");
    ck_assert_msg(r.status == CV_OK, "%s", r.why.text);
    ck_assert_str_eq(r.arguments.path, "--odd-name.ini");
    ck_assert_ptr_null(r.o.selection.case_name);
    ck_assert_int_eq(r.o.selection.digits, 0);
    ck_assert_int_eq(r.o.flag, 0);
    cv_selection_clear(&r.o.selection);
}
END_TEST

START_TEST(help_and_version_need_nothing)
{
    outcome r;
    read_line(&r, "--help");
    ck_assert_int_eq(r.status, CV_OK);
    ck_assert_int_eq(r.action, CV_CLI_HELP);
    cv_selection_clear(&r.o.selection);
    read_line(&r, "first --version");
    ck_assert_int_eq(r.status, CV_OK);
    ck_assert_int_eq(r.action, CV_CLI_VERSION);
    cv_selection_clear(&r.o.selection);
}
END_TEST

static const char *const wrong[][2] = {
    {"", "no command; see --help"},
    {"third FILE", "unknown command 'third'; see --help"},
    {"first", "no case file; see --help"},
    {"first FILE more", "surplus argument 'more'; see --help"},
    {"first FILE --frob", "unknown or ambiguous option '--frob'; see --help"},
    {"first FILE --f", "unknown or ambiguous option '--f'; see --help"},
    {"first FILE -x", "unknown or ambiguous option '-x'; see --help"},
    {"first FILE --flag=1", "unknown or ambiguous option '--flag=1'; see --help"},
    {"first FILE --case", "option '--case' needs a value"},
    {"first FILE --case a --case b", "option --case given twice"},
    {"first FILE -o", "option '-o' needs a value"},
    {"first FILE -o a -ob", "option -o given twice"},
    {"first FILE --digits 0", "--digits: '0' is not a whole number from 1 to 1000"},
    {"first FILE --digits 1e2", "--digits: '1e2' is not a whole number from 1 to 1000"},
    {"first FILE --digits=-5", "--digits: '-5' is not a whole number from 1 to 1000"},
    {"first FILE --format xml", "--format: 'xml' is neither text nor json"},
    {"first FILE --alpha 0,3", "--alpha: '0,3' is not a decimal number"},
    {"first FILE --damping nan", "--damping: 'nan' is not a decimal number"},
    {"first FILE --mass-ratio 1e400", "--mass-ratio: '1e400' is outside 1e-300 .. 1e300"},
};

START_TEST(wrong_command_lines)
{
    outcome r;
    read_line(&r, wrong[_i][0]);
    ck_assert_int_eq(r.status, CV_BAD_INPUT);
    ck_assert_str_eq(r.why.text, wrong[_i][1]);
    cv_selection_clear(&r.o.selection);
}
END_TEST

/* Selection from data/paper.ini */
static cv_status choose(cv_choice *c, const char *line, cv_message *why)
{
    outcome r;
    read_line(&r, line);
    ck_assert_msg(r.status == CV_OK, "%s", r.why.text);
    const cv_status status = cv_choose(c, &r.o.selection, r.arguments.path, why);
    cv_selection_clear(&r.o.selection);
    return status;
}

START_TEST(selection_of_a_point)
{
    cv_choice c;
    cv_message why = {""};
    ck_assert_int_eq(choose(&c, "first data/paper.ini", &why), CV_OK);
    ck_assert_str_eq(c.chosen->name, "1");
    ck_assert_int_eq(c.digits, 20);
    ck_assert(cv_number_get_double(&c.params.eta_b) == 0.1); /* the first level */
    cv_choice_clear(&c);
    ck_assert_int_eq(choose(&c, "first data/paper.ini --case 4 --damping 0 --digits 7", &why), CV_OK);
    ck_assert_str_eq(c.chosen->name, "4");
    ck_assert_int_eq(c.digits, 7);
    ck_assert(cv_params_undamped(&c.params));
    ck_assert(cv_number_get_double(&c.params.mu_b) == 10);
    cv_choice_clear(&c);
}
END_TEST

START_TEST(wrong_selections)
{
    static const char *const lines[][2] = {
        {"first data/paper.ini --case 5", "data/paper.ini: no case '5' in the file; there is: 1, 2, 3, 4"},
        {"first data/none.ini", "data/none.ini: cannot open: No such file or directory"},
        {"first data/paper.ini --damping -1e-9", "--damping: must be >= 0"},
        {"first data/paper.ini --alpha -1", "--alpha: must be >= 0"},
        {"first data/paper.ini --mass-ratio 0", "--mass-ratio: must be > 0"},
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) {
        cv_choice c;
        cv_message why = {""};
        ck_assert_int_eq(choose(&c, lines[i][0], &why), CV_BAD_INPUT);
        ck_assert_str_eq(why.text, lines[i][1]);
    }
}
END_TEST

START_TEST(required_options)
{
    cv_optional_number x = {.given = 0};
    cv_message why = {""};
    ck_assert_int_eq(cv_require(&x, "alpha", &why), CV_BAD_INPUT);
    ck_assert_str_eq(why.text, "missing option --alpha; see --help");
    x.given = 1;
    ck_assert_int_eq(cv_require(&x, "alpha", &why), CV_OK);
}
END_TEST

/* What a child process that runs cv_main leaves behind. */
typedef struct {
    int status; /* exit status, or 256 + the signal that killed it */
    char out[200], err[300];
} result;

static void slurp(int fd, char *to, size_t size)
{
    size_t n = 0;
    ssize_t got;
    while (n < size - 1 && (got = read(fd, to + n, size - 1 - n)) > 0)
        n += (size_t)got;
    to[n] = '\0';
    close(fd);
}

/* Runs cv_main with stdout going to out_fd (-1: a pipe that is read). */
static result run_program(const char *line, int out_fd)
{
    result r = {.out = ""};
    int out[2], err[2], state;
    ck_assert_int_eq(pipe(out), 0);
    ck_assert_int_eq(pipe(err), 0);
    fflush(NULL);
    const pid_t child = fork();
    ck_assert_int_ge(child, 0);
    if (child == 0) {
        char text[200], *argv[MAX_WORDS + 1];
        dup2(out_fd >= 0 ? out_fd : out[1], STDOUT_FILENO);
        dup2(err[1], STDERR_FILENO);
        options o = {.flag = 0};
        cv_selection_init(&o.selection);
        snprintf(text, sizeof text, "critvel-test %s", line);
        const int argc = split(argv, text);
        const int status = cv_main(&program, &o, argc, argv);
        cv_selection_clear(&o.selection);
        _exit(status);
    }
    close(out[1]);
    close(err[1]);
    slurp(out[0], r.out, sizeof r.out);
    slurp(err[0], r.err, sizeof r.err);
    ck_assert_int_eq(waitpid(child, &state, 0), child);
    r.status = WIFEXITED(state) ? WEXITSTATUS(state) : 256 + WTERMSIG(state);
    return r;
}

typedef struct {
    const char *line;
    int status;
    const char *out, *err;
} run_case;

static const run_case runs[] = {
    {"first FILE", 0, "answer first\n", "progress\n"},
    {"first undecided", 1, "answer first\n", "critvel-test: cannot tell\n"},
    {"second wrong", 2, "", "critvel-test: it is wrong\n"},
    {"second failed", 3, "", "critvel-test: it failed\n"},
    {"second", 2, "", "critvel-test: no case file; see --help\n"},
    {"--help", 0, "the help\n", ""},
    {"--version", 0, "critvel-test " CV_VERSION "\n", ""},
};

START_TEST(exit_status_and_streams)
{
    const result r = run_program(runs[_i].line, -1);
    ck_assert_int_eq(r.status, runs[_i].status);
    ck_assert_str_eq(r.out, runs[_i].out);
    ck_assert_str_eq(r.err, runs[_i].err);
}
END_TEST

START_TEST(full_disk)
{
    static const char *const lines[] = {"first FILE", "--help", "--version", "first undecided"};
    const int full = open("/dev/full", O_WRONLY);
    ck_assert_int_ge(full, 0);
    for (size_t i = 0; i < 4; ++i) {
        const result r = run_program(lines[i], full);
        ck_assert_int_eq(r.status, 3);
        ck_assert_ptr_nonnull(
            strstr(r.err, "critvel-test: cannot write the output: No space left on device\n"));
    }
    close(full);
}
END_TEST

START_TEST(closed_pipe)
{
    int ends[2];
    ck_assert_int_eq(pipe(ends), 0);
    close(ends[0]);
    const result r = run_program("first FILE", ends[1]);
    ck_assert_int_eq(r.status, 3);
    ck_assert_ptr_nonnull(strstr(r.err, "cannot write the output: Broken pipe"));
    close(ends[1]);
}
END_TEST

START_TEST(stdout_not_writable)
{
    const int read_only = open("/dev/null", O_RDONLY);
    const result r = run_program("first FILE", read_only);
    ck_assert_int_eq(r.status, 3);
    ck_assert_ptr_nonnull(strstr(r.err, "cannot write the output: Bad file descriptor"));
    close(read_only);
}
END_TEST

START_TEST(messages_are_one_line)
{
    cv_message why;
    ck_assert_int_eq(cv_fail(&why, CV_FAILED, "a%sb", "\n\r\t\033"), CV_FAILED);
    ck_assert_str_eq(why.text, "a????b");
    ck_assert_int_eq(cv_fail(NULL, CV_UNDECIDED, "nobody listens"), CV_UNDECIDED);
    char longer[2 * CV_MESSAGE_SIZE];
    memset(longer, 'x', sizeof longer);
    longer[sizeof longer - 1] = '\0';
    cv_fail(&why, CV_FAILED, "%s", longer);
    ck_assert_uint_eq(strlen(why.text), CV_MESSAGE_SIZE - 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("common/cli");
    TCase *c = tcase_create("cli");
    tcase_add_test(c, everything_given);
    tcase_add_test(c, nothing_given);
    tcase_add_test(c, option_of_one_letter);
    tcase_add_test(c, help_and_version_need_nothing);
    tcase_add_loop_test(c, wrong_command_lines, 0, (int)(sizeof wrong / sizeof wrong[0]));
    tcase_add_test(c, selection_of_a_point);
    tcase_add_test(c, wrong_selections);
    tcase_add_test(c, required_options);
    tcase_add_loop_test(c, exit_status_and_streams, 0, (int)(sizeof runs / sizeof runs[0]));
    tcase_add_test(c, full_disk);
    tcase_add_test(c, closed_pipe);
    tcase_add_test(c, stdout_not_writable);
    tcase_add_test(c, messages_are_one_line);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
