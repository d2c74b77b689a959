/* critvel-compare convergence */
#include <stdlib.h>

#include "common/selection.h"
#include "compare/commands.h"
#include "compare/convergence.h"
#include "compare/progress.h"

static const char HELP[] =
    "usage: critvel-compare convergence FILE [options]\n"
    "\n"
    "Finds the stability limit at damping 1e-2, 1e-3 ... 1e-12 (eta_p = eta_b = eta_f) by both methods, and\n"
    "without damping by the semianalytical one, for every case and mass ratio of the case file FILE. Says "
    "how\n"
    "many digits the methods agree in, how the limits change from level to level, in which order of the "
    "damping\n"
    "they tend to the limit without damping, where they jump from one branch of the instability lines to "
    "another,\n"
    "and where there is no limit. The limit is checked by the number of unstable roots on either side of "
    "it,\n"
    "from dgreen's winding without damping.\n"
    "\n"
    "  --case NAME       only the section [case NAME] or [track NAME]\n"
    "  --mass-ratio M    only eta_M = M\n"
    "  --format FORMAT   text (default) or json (schema critvel-compare-convergence/1)\n"
    "  --threads N       at most N threads (default: one for each processor); the answer does not depend on "
    "it\n"
    "  --help            this text\n"
    "  --version         the version\n"
    "\n"
    "example: critvel-compare convergence data/paper.ini --case 2 --mass-ratio 100\n"
    "exit status: 0 both methods agree everywhere, 1 a disagreement or an undecided result, 2 bad usage or "
    "bad\n"
    "input, 3 internal or I/O failure\n";

typedef struct {
    cv_selection selection;
    size_t threads;
} options;

static const cv_option OPTIONS[] = {CV_OPTION_CASE(offsetof(options, selection)),
                                    CV_OPTION_MASS_RATIO(offsetof(options, selection)),
                                    CV_OPTION_FORMAT(offsetof(options, selection)),
                                    {"threads", cmp_set_threads, offsetof(options, threads), 0},
                                    {NULL, NULL, 0, 0}};

/* Every case has this mass ratio alone. */
static void choose_mass(cv_casefile *file, const cv_number *mass_ratio)
{
    for (size_t c = 0; c < file->case_count; c++) {
        cv_case *at = &file->cases[c];
        for (size_t m = 1; m < at->mass_count; m++)
            cv_number_clear(&at->mass_ratios[m]);
        at->mass_count = 1;
        cv_number_set(&at->mass_ratios[0], mass_ratio);
    }
}

static cv_status report(FILE *out, FILE *log, const cv_casefile *file, const options *o, cv_message *why)
{
    cmp_convergence_run run;
    cmp_progress_line line = {log, "stability limits", 0};
    const cmp_listener listener = cmp_progress_listener(&line);
    cv_status status = cmp_convergence_init(&run, file, o->selection.case_name, why);
    if (status != CV_OK)
        return status;
    status = cmp_convergence_find(&run, o->threads, &listener, why);
    if (line.shown)
        fputc('\n', log);
    if (status == CV_OK)
        status = o->selection.format == CV_FORMAT_JSON ? cmp_convergence_json(out, &run, why)
                                                       : cmp_convergence_text(out, &run, why);
    if (status == CV_OK && cmp_convergence_verdict(&run) != CMP_AGREE)
        status = CV_UNDECIDED;
    cmp_convergence_clear(&run);
    return status;
}

static cv_status work(const void *typed, const cv_arguments *arguments, FILE *out, FILE *log, cv_message *why)
{
    const options *o = typed;
    const cv_optional_number *mass = &o->selection.mass_ratio;
    cv_casefile file;
    if (mass->given && cv_number_sign(&mass->value) <= 0)
        return cv_fail(why, CV_BAD_INPUT, "--mass-ratio must be positive");
    cv_status status = cv_casefile_read(&file, arguments->path, why);
    if (status != CV_OK)
        return status;
    if (mass->given)
        choose_mass(&file, &mass->value);
    status = cmp_convergence_levels(&file, CMP_FIRST_LEVEL, CMP_LAST_LEVEL, why);
    if (status == CV_OK)
        status = report(out, log, &file, o, why);
    cv_casefile_clear(&file);
    return status;
}

int cmp_convergence_main(int argc, char **argv)
{
    static const char *const commands[] = {"convergence", NULL};
    const cv_program program = {"critvel-compare", HELP, commands, OPTIONS, work};
    options o = {.threads = 0};
    cv_selection_init(&o.selection);
    const int status = cv_main(&program, &o, argc, argv);
    cv_selection_clear(&o.selection);
    return status;
}
