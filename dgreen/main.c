/* critvel-dgreen: the D-decomposition method of section 4 of the paper. */
#include <string.h>

#include "dgreen/command.h"

static const char help[] =
    "critvel-dgreen: a mass moving on a beam on three viscoelastic layers, by the moving Green's function "
    "and\n"
    "D-decomposition.\n"
    "\n"
    "  critvel-dgreen z FILE --alpha 0.3 --frequency 0.22\n"
    "      zeta = z/eta_M of (30) at qbar = iq, first case and first damping level of FILE\n"
    "  critvel-dgreen z FILE --case 3 --damping 1e-10 --alpha 0.45 --frequency 0.3 --digits 30\n"
    "      another case, eta_p = eta_b = eta_f = 1e-10, 30 correct digits of each part\n"
    "  critvel-dgreen z FILE --damping 0 --alpha 0.3 --frequency 0.22\n"
    "      without damping: the limit of vanishing real part of qbar\n"
    "  critvel-dgreen z FILE --alpha 0.3 --frequency 0.22 --mass-ratio 100 --format json\n"
    "      z for eta_M = 100 as well, as JSON\n"
    "  critvel-dgreen count FILE --alpha 0.3\n"
    "      number of unstable roots for every mass ratio of the case, by the winding of the curve z(iq)\n"
    "  critvel-dgreen transitions FILE --case 3 --damping 1e-10 --mass-ratio 100\n"
    "      all velocities of the range where that number changes, with q; default: every mass ratio\n"
    "  critvel-dgreen roots FILE --alpha 0.3 --mass-ratio 100\n"
    "      roots qbar of z = 1: growth rates and frequencies of all unstable ones and the nearest stable "
    "ones\n"
    "\n"
    "FILE is a case file; the mass is on the edge of instability where z = 1.\n"
    "\n"
    "  --case NAME        what follows \"case\" or \"track\" in the section name; default: the first\n"
    "  --damping X        sets all three damping ratios; default: the first level of FILE\n"
    "  --alpha X          velocity ratio, 0 or more\n"
    "  --frequency X      dimensionless frequency q\n"
    "  --mass-ratio X     mass ratio eta_M\n"
    "  --digits N         significant digits of each part; default: as in FILE\n"
    "  --format FORMAT    text (default) or json\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 done, 1 undecided, 2 wrong usage or input, 3 internal or I/O failure.\n";

static const cv_option options[] = {CV_OPTION_CASE(offsetof(dg_options, selection)),
                                    CV_OPTION_DAMPING(offsetof(dg_options, selection)),
                                    CV_OPTION_ALPHA(offsetof(dg_options, selection)),
                                    CV_OPTION_FREQUENCY(offsetof(dg_options, selection)),
                                    CV_OPTION_MASS_RATIO(offsetof(dg_options, selection)),
                                    CV_OPTION_DIGITS(offsetof(dg_options, selection)),
                                    CV_OPTION_FORMAT(offsetof(dg_options, selection)),
                                    {NULL, NULL, 0, 0}};

/* One row per subcommand; names[i] belongs to commands[i]. */
static const char *const names[] = {"z", "count", "transitions", "roots", NULL};
static dg_command *const commands[] = {dg_command_z, dg_command_count, dg_command_transitions,
                                       dg_command_roots};

static cv_status work(const void *typed, const cv_arguments *arguments, FILE *out, FILE *log, cv_message *why)
{
    for (size_t i = 0; names[i] != NULL; i++)
        if (strcmp(arguments->command, names[i]) == 0)
            return commands[i](typed, arguments->path, out, log, why);
    return cv_fail(why, CV_BAD_INPUT, "unknown command %s", arguments->command);
}

int main(int argc, char **argv)
{
    const cv_program program = {"critvel-dgreen", help, names, options, work};
    dg_options typed = {0};
    cv_selection_init(&typed.selection);
    const int status = cv_main(&program, &typed, argc, argv);
    cv_selection_clear(&typed.selection);
    return status;
}
