/* critvel-compare: command line, warnings, progress; the work is in run.h and report.h. */
#include <stdlib.h>
#include <string.h>

#include "common/output.h"
#include "common/selection.h"
#include "compare/commands.h"
#include "compare/efficiency.h"
#include "compare/figures.h"
#include "compare/progress.h"
#include "compare/report.h"

static const char HELP[] =
    "usage: critvel-compare [options] FILE\n"
    "       critvel-compare lines FILE [options]\n"
    "       critvel-compare roots FILE --alpha X --mass-ratio M [options]\n"
    "       critvel-compare convergence FILE [options]\n"
    "       critvel-compare efficiency FILE [options]\n"
    "       critvel-compare figures FILE -o DIR [options]\n"
    "\n"
    "Finds the velocities at which a mass moving on an infinite beam on three viscoelastic layers gains\n"
    "or loses unstable roots, by two independent methods (semianalytical and D-decomposition), for every\n"
    "case, damping level and mass ratio of the case file FILE, and says how many digits agree, where they\n"
    "do not, and where it cannot tell. Besides (each but efficiency has a --help of its own):\n"
    "\n"
    "  lines        instability lines of both methods, branch by branch, and roots counted at sample points\n"
    "  roots        mass-induced frequencies and growth rates at one velocity and mass ratio\n"
    "  convergence  the stability limit as the damping falls to 1e-12, beside its limit without damping\n"
    "  efficiency   what each method spent: evaluations, how many of them above double precision, the\n"
    "               largest precision, processor time\n"
    "  figures      the figures of the paper for the cases of FILE, SVG and PDF through gnuplot\n"
    "\n"
    "examples:\n"
    "  critvel-compare data/paper.ini\n"
    "  critvel-compare data/paper.ini --case 3 --damping 1e-10 --transitions\n"
    "  critvel-compare data/paper.ini --format json --output report.json\n"
    "  critvel-compare lines data/paper.ini --case 4 --damping 1e-10\n"
    "  critvel-compare figures data/paper.ini -o figures\n"
    "\n"
    "options:\n"
    "  --case NAME       only the section [case NAME] or [track NAME]\n"
    "  --damping X       eta_p = eta_b = eta_f = X instead of the levels of the file\n"
    "  --transitions     list every transition in the table for people, too\n"
    "  --format FORMAT   text (default) or json (schema critvel-compare/1)\n"
    "  --output FILE     write there, whole or not at all, instead of to standard output\n"
    "  --threads N       at most N threads (default: one for each processor); the answer does not depend\n"
    "                    on it\n"
    "  --help            this text\n"
    "  --version         the version\n"
    "\n"
    "exit status: 0 everything agrees, 1 a disagreement or an undecided result, 2 bad usage or bad input,\n"
    "3 internal or I/O failure\n";

typedef struct {
    cv_selection selection;
    const char *output;
    size_t threads; /* 0: as many as processors */
    int transitions;
} options;

static const cv_option OPTIONS[] = {
    CV_OPTION_CASE(offsetof(options, selection)),
    CV_OPTION_DAMPING(offsetof(options, selection)),
    CV_OPTION_FORMAT(offsetof(options, selection)),
    {"output", cv_set_text, offsetof(options, output), 0},
    {"threads", cmp_set_threads, offsetof(options, threads), 0},
    {"transitions", cv_set_flag, offsetof(options, transitions), 1},
    {NULL, NULL, 0, 0},
};

static cv_status do_phases(cmp_run *run, size_t threads, int with_checks, FILE *log, cv_message *why)
{
    cmp_progress_line p = {log, "transitions", 0};
    const cmp_listener listener = cmp_progress_listener(&p);
    cv_status status = cmp_run_find(run, threads, &listener, why);
    p.doing = "checks     ";
    if (status == CV_OK && with_checks)
        status = cmp_run_judge(run, threads, &listener, why);
    p.doing = "again      ";
    if (status == CV_OK && with_checks)
        status = cmp_run_search_again(run, threads, &listener, why);
    if (p.shown)
        fputc('\n', log);
    return status;
}

static void warn(const cmp_run *run, FILE *log)
{
    cv_message warning;
    for (size_t i = 0; i < run->case_count; i++)
        if (cv_params_warn(&run->cases[i].from->params, &warning))
            fprintf(log, "critvel-compare: warning: %s %s: %s\n",
                    run->cases[i].from->is_track ? "track" : "case", run->cases[i].from->name, warning.text);
}

static cv_status report_verdicts(FILE *out, const cmp_run *run, const options *o, cv_message *why)
{
    cmp_printed printed;
    cv_status status = cmp_printed_make(&printed, run, why);
    if (status != CV_OK)
        return status;
    if (o->selection.format == CV_FORMAT_JSON)
        status = cmp_report_json(out, run, &printed, why);
    else
        status = cmp_report_text(out, run, &printed, o->transitions, why);
    cmp_printed_clear(&printed);
    return status;
}

static cv_status report_efficiency(FILE *out, const cmp_run *run, const options *o, cv_message *why)
{
    return o->selection.format == CV_FORMAT_JSON ? cmp_efficiency_json(out, run, why)
                                                 : cmp_efficiency_text(out, run, why);
}

/* Writes what the command is asked for. */
typedef cv_status reporter(FILE *out, const cmp_run *run, const options *o, cv_message *why);

/* The report goes to memory first, so that the file is written in one piece. */
static cv_status report_to_file(reporter *report, const cmp_run *run, const options *o, cv_message *why)
{
    char *bytes = NULL;
    size_t n = 0;
    FILE *memory = open_memstream(&bytes, &n);
    if (memory == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = report(memory, run, o, why);
    if (fclose(memory) != 0 && status == CV_OK)
        status = cv_fail(why, CV_FAILED, "out of memory");
    if (status == CV_OK)
        status = cv_output_write(o->output, bytes, n, why);
    free(bytes);
    return status;
}

/* efficiency: the searches alone; otherwise everything, and CV_UNDECIDED unless everything agrees. */
static cv_status compare(int efficiency, const options *o, const cv_casefile *file, FILE *out, FILE *log,
                         cv_message *why)
{
    static const cmp_method *const methods[] = {&cmp_method_semianalytic, &cmp_method_dgreen};
    reporter *const report = efficiency ? report_efficiency : report_verdicts;
    cmp_run run;
    cmp_summary summary;
    cv_status status =
        cmp_run_init(&run, file, o->selection.case_name,
                     o->selection.damping.given ? &o->selection.damping.value : NULL, methods, why);
    if (status != CV_OK)
        return status;
    warn(&run, log);
    status = do_phases(&run, o->threads, !efficiency, log, why);
    if (status == CV_OK)
        status = o->output != NULL ? report_to_file(report, &run, o, why) : report(out, &run, o, why);
    cmp_run_summary(&summary, &run);
    cmp_run_clear(&run);
    return status == CV_OK && summary.worst != CMP_AGREE ? CV_UNDECIDED : status;
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
    if (o->output != NULL)
        status = cv_output_check(o->output, why);
    if (status == CV_OK)
        status = compare(arguments->command != NULL, o, &file, out, log, why);
    cv_casefile_clear(&file);
    return status;
}

/* Commands with options of their own. */
static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} OWN_OPTIONS[] = {{"convergence", cmp_convergence_main},
                   {"figures", cmp_figures_main},
                   {"lines", cmp_lines_main},
                   {"roots", cmp_roots_main}};

/* The first word is FILE unless it is a command; a file of that name can be given as ./efficiency. */
int main(int argc, char **argv)
{
    static const char *const commands[] = {"efficiency", NULL};
    for (size_t i = 0; argc > 1 && i < sizeof OWN_OPTIONS / sizeof *OWN_OPTIONS; i++)
        if (strcmp(argv[1], OWN_OPTIONS[i].name) == 0)
            return OWN_OPTIONS[i].run(argc, argv);
    const int commanded = argc > 1 && strcmp(argv[1], commands[0]) == 0;
    const cv_program program = {"critvel-compare", HELP, commanded ? commands : NULL, OPTIONS, work};
    options o = {.output = NULL, .threads = 0, .transitions = 0};
    cv_selection_init(&o.selection);
    const int status = cv_main(&program, &o, argc, argv);
    cv_selection_clear(&o.selection);
    return status;
}
