/* critvel-compare lines */
#include <stdlib.h>
#include <string.h>

#include "common/cli.h"
#include "common/selection.h"
#include "compare/commands.h"
#include "compare/lines_report.h"
#include "compare/progress.h"

static const char HELP[] =
    "usage: critvel-compare lines FILE [options]\n"
    "\n"
    "Finds the instability lines (velocity alpha against mass ratio eta_M at which the mass gains or\n"
    "loses a pair of unstable roots) by both methods, pairs them branch by branch, compares ends,\n"
    "asymptotes and extremes, puts every vertex of either on the line of the other to many digits, and\n"
    "counts the unstable roots at sample points, half of them close to the lines, by winding and by\n"
    "counting lines; more than one in a hundred that cannot be counted make the verdict undecided.\n"
    "\n"
    "  --case NAME       only the section [case NAME] or [track NAME]\n"
    "  --damping X       eta_p = eta_b = eta_f = X instead of the levels of the file\n"
    "  --alpha LOW:HIGH  range of velocities; default: that of the file\n"
    "  --mass-ratio LOW:HIGH\n"
    "                    range of mass ratios; default: 1:10000\n"
    "  --digits N        digits of the points compared; default: those of the file\n"
    "  --samples N       sample points of each case and damping level; default: 10000\n"
    "  --seed N          of the sample points; default: 1\n"
    "  --format FORMAT   text (default) or json (schema critvel-compare-lines/1)\n"
    "  --threads N       at most N threads (default: one for each processor); the answer does not depend on "
    "it\n"
    "  --help            this text\n"
    "  --version         the version\n"
    "\n"
    "example: critvel-compare lines data/paper.ini --case 3 --damping 1e-4\n"
    "exit status: 0 everything agrees, 1 a disagreement or an undecided result, 2 bad usage or bad input,\n"
    "3 internal or I/O failure\n";

typedef struct {
    int given;
    cv_number low, high;
} range;

typedef struct {
    cv_selection selection;
    range alpha, mass_ratio;
    unsigned long samples, seed;
    size_t threads;
} options;

/* LOW:HIGH, 0 < LOW < HIGH */
static cv_status set_range(void *to, const char *text, cv_message *why)
{
    range *r = to;
    char low[64];
    const char *colon = strchr(text, ':');
    const size_t length = colon != NULL ? (size_t)(colon - text) : 0;
    if (colon == NULL || length >= sizeof low)
        return cv_fail(why, CV_BAD_INPUT, "\"%.60s\" is not LOW:HIGH", text);
    memcpy(low, text, length);
    low[length] = '\0';
    cv_status status = cv_number_parse(&r->low, low, why);
    if (status == CV_OK)
        status = cv_number_parse(&r->high, colon + 1, why);
    if (status == CV_OK && (cv_number_sign(&r->low) <= 0 || cv_number_compare(&r->low, &r->high) >= 0))
        status = cv_fail(why, CV_BAD_INPUT, "\"%.60s\" is not a range above 0", text);
    r->given = status == CV_OK;
    return status;
}

static cv_status set_count(void *to, const char *text, cv_message *why)
{
    char *end;
    const unsigned long n = strtoul(text, &end, 10);
    if (text[0] < '0' || text[0] > '9' || *end != '\0' || n > 100000000)
        return cv_fail(why, CV_BAD_INPUT, "\"%.60s\" is not a number from 0 to 100000000", text);
    *(unsigned long *)to = n;
    return CV_OK;
}

static const cv_option OPTIONS[] = {CV_OPTION_CASE(offsetof(options, selection)),
                                    CV_OPTION_DAMPING(offsetof(options, selection)),
                                    CV_OPTION_DIGITS(offsetof(options, selection)),
                                    CV_OPTION_FORMAT(offsetof(options, selection)),
                                    {"alpha", set_range, offsetof(options, alpha), 0},
                                    {"mass-ratio", set_range, offsetof(options, mass_ratio), 0},
                                    {"samples", set_count, offsetof(options, samples), 0},
                                    {"seed", set_count, offsetof(options, seed), 0},
                                    {"threads", cmp_set_threads, offsetof(options, threads), 0},
                                    {NULL, NULL, 0, 0}};

static cv_status do_phases(cmp_lines_run *run, size_t threads, FILE *log, cv_message *why)
{
    cmp_progress_line line = {log, "lines      ", 0};
    const cmp_listener listener = cmp_progress_listener(&line);
    cv_status status = cmp_lines_run_find(run, threads, &listener, why);
    line.doing = "comparisons";
    if (status == CV_OK)
        status = cmp_lines_run_judge(run, threads, &listener, why);
    if (line.shown)
        fputc('\n', log);
    return status;
}

static void warn(const cmp_lines_run *run, FILE *log)
{
    cv_message warning;
    for (size_t i = 0; i < run->case_count; i++) {
        const cv_case *c = run->cases[i].from;
        if (cv_params_warn(&c->params, &warning))
            fprintf(log, "critvel-compare: warning: %s %s: %s\n", c->is_track ? "track" : "case", c->name,
                    warning.text);
    }
}

static cv_status compare(const options *o, const cv_casefile *file, FILE *out, FILE *log, cv_message *why)
{
    static const cmp_line_method *const methods[] = {&cmp_lines_semianalytic, &cmp_lines_dgreen};
    const cv_selection *s = &o->selection;
    const cmp_lines_task task = {{o->alpha.given ? &o->alpha.low : &file->alpha_min,
                                  o->alpha.given ? &o->alpha.high : &file->alpha_max, &o->mass_ratio.low,
                                  &o->mass_ratio.high},
                                 s->digits > 0 ? s->digits : file->digits,
                                 o->samples,
                                 o->seed};
    cmp_lines_run run;
    cv_status status = cmp_lines_run_init(&run, file, s->case_name,
                                          s->damping.given ? &s->damping.value : NULL, &task, methods, why);
    if (status != CV_OK)
        return status;
    warn(&run, log);
    status = do_phases(&run, o->threads, log, why);
    if (status == CV_OK)
        status = s->format == CV_FORMAT_JSON ? cmp_lines_report_json(out, &run, why)
                                             : cmp_lines_report_text(out, &run, why);
    if (status == CV_OK && run.worst != CMP_AGREE)
        status = CV_UNDECIDED;
    cmp_lines_run_clear(&run);
    return status;
}

static cv_status work(const void *typed, const cv_arguments *arguments, FILE *out, FILE *log, cv_message *why)
{
    const options *o = typed;
    cv_casefile file;
    if (o->selection.damping.given && cv_number_sign(&o->selection.damping.value) < 0)
        return cv_fail(why, CV_BAD_INPUT, "--damping must not be negative");
    cv_status status = cv_casefile_read(&file, arguments->path, why);
    if (status != CV_OK)
        return status;
    status = compare(o, &file, out, log, why);
    cv_casefile_clear(&file);
    return status;
}

static void range_init(range *r, const char *low, const char *high)
{
    r->given = 0;
    cv_number_init(&r->low);
    cv_number_init(&r->high);
    (void)cv_number_parse(&r->low, low, NULL);
    (void)cv_number_parse(&r->high, high, NULL);
}

static void range_clear(range *r)
{
    cv_number_clear(&r->low);
    cv_number_clear(&r->high);
}

int cmp_lines_main(int argc, char **argv)
{
    static const char *const commands[] = {"lines", NULL};
    const cv_program program = {"critvel-compare", HELP, commands, OPTIONS, work};
    options o = {.samples = 10000, .seed = 1};
    cv_selection_init(&o.selection);
    range_init(&o.alpha, "1", "2"); /* unless given, that of the file is used */
    range_init(&o.mass_ratio, "1", "10000");
    const int status = cv_main(&program, &o, argc, argv);
    cv_selection_clear(&o.selection);
    range_clear(&o.alpha);
    range_clear(&o.mass_ratio);
    return status;
}
