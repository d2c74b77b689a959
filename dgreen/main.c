/* critvel-dgreen: the D-decomposition method of section 4 of the paper. */
#include <stdlib.h>
#include <string.h>

#include "common/output.h"
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
    "  critvel-dgreen transitions FILE --case 3 --damping 0 --digits 12\n"
    "      all velocities of the range where that number changes, with q; default: every mass ratio\n"
    "  critvel-dgreen roots FILE --alpha 0.3 --mass-ratio 100\n"
    "      roots qbar of z = 1: growth rates and frequencies of all unstable ones and the nearest stable "
    "ones\n"
    "  critvel-dgreen lines FILE --case 4 --damping 1e-10 --format csv --output lines.csv\n"
    "      instability lines as polylines alpha, q, eta_M, with what is known of each, and their asymptotes\n"
    "  critvel-dgreen lines FILE --case 3 --damping 1e-4 --alpha 0.3:0.9 --mass-ratio 10:1e5\n"
    "      in ranges of velocity and mass ratio; default: the range of FILE and 1:10000\n"
    "\n"
    "FILE is a case file; the mass is on the edge of instability where z = 1.\n"
    "\n"
    "  --case NAME        what follows \"case\" or \"track\" in the section name; default: the first\n"
    "  --damping X        sets all three damping ratios; default: the first level of FILE\n"
    "  --alpha X          velocity ratio, 0 or more; map: first:last:count; lines: first:last\n"
    "  --frequency X      dimensionless frequency q\n"
    "  --mass-ratio X     mass ratio eta_M; map: first:last:count; lines: first:last\n"
    "  --delta X          Re qbar of the second curve of curve; default: 0.01\n"
    "  --digits N         significant digits of each part; default: as in FILE\n"
    "  --format FORMAT    text (default), csv (means text except for lines) or json\n"
    "  --output FILE      write there, whole or not at all, instead of to standard output\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 done, 1 undecided, 2 wrong usage or input, 3 internal or I/O failure.\n";

/* One number or a grid; a grid alone is for map. */
static cv_status set_axis(dg_grid *grid, cv_optional_number *single, const char *text, cv_message *why)
{
    const cv_status status = dg_grid_parse(grid, text, why);
    return status == CV_OK && grid->count == 1 ? cv_set_number(single, text, why) : status;
}

static cv_status set_alpha(void *to, const char *text, cv_message *why)
{
    dg_options *o = to;
    return set_axis(&o->alphas, &o->selection.alpha, text, why);
}

static cv_status set_mass_ratio(void *to, const char *text, cv_message *why)
{
    dg_options *o = to;
    return set_axis(&o->masses, &o->selection.mass_ratio, text, why);
}

/* The text of curve and map is CSV and may be asked for by that name. */
static cv_status set_format(void *to, const char *text, cv_message *why)
{
    dg_options *o = to;
    o->csv = strcmp(text, "csv") == 0;
    return cv_set_format(&o->selection.format, o->csv ? "text" : text, why);
}

static const cv_option options[] = {CV_OPTION_CASE(offsetof(dg_options, selection)),
                                    CV_OPTION_DAMPING(offsetof(dg_options, selection)),
                                    {"alpha", set_alpha, 0, 0},
                                    CV_OPTION_FREQUENCY(offsetof(dg_options, selection)),
                                    {"mass-ratio", set_mass_ratio, 0, 0},
                                    CV_OPTION_DIGITS(offsetof(dg_options, selection)),
                                    {"delta", cv_set_number, offsetof(dg_options, delta), 0},
                                    {"format", set_format, 0, 0},
                                    {"output", cv_set_text, offsetof(dg_options, output), 0},
                                    {NULL, NULL, 0, 0}};

/* One row per subcommand; names[i] belongs to commands[i]. */
static const char *const names[] = {"z", "count", "transitions", "roots", "curve", "map", "lines", NULL};
static dg_command *const commands[] = {dg_command_z,     dg_command_count, dg_command_transitions,
                                       dg_command_roots, dg_command_curve, dg_command_map,
                                       dg_command_lines};

/* Rows of numbers are for map, ranges for lines. */
static cv_status check_axes(const dg_options *o, const char *command, cv_message *why)
{
    const int map = strcmp(command, "map") == 0, lines = strcmp(command, "lines") == 0;
    const dg_grid *grids[] = {&o->alphas, &o->masses};
    static const char *const axes[] = {"alpha", "mass-ratio"};
    for (int i = 0; i < 2; i++) {
        const dg_grid *g = grids[i];
        if (g->given && ((g->count == 0 && !lines) || (g->count > 1 && !map) || (g->count != 0 && lines)))
            return cv_fail(why, CV_BAD_INPUT, "--%s: %s takes %s", axes[i], command,
                           lines ? "a range first:last"
                           : map ? "a number or first:last:count"
                                 : "one number");
    }
    return CV_OK;
}

static cv_status run(const dg_options *o, const cv_arguments *arguments, FILE *out, FILE *log,
                     cv_message *why)
{
    const cv_status status = check_axes(o, arguments->command, why);
    if (status != CV_OK)
        return status;
    for (size_t i = 0; names[i] != NULL; i++)
        if (strcmp(arguments->command, names[i]) == 0)
            return commands[i](o, arguments->path, out, log, why);
    return cv_fail(why, CV_BAD_INPUT, "unknown command %s", arguments->command);
}

/* The same into a file; an undecided answer is written, too. */
static cv_status run_into(const dg_options *o, const cv_arguments *arguments, FILE *log, cv_message *why)
{
    char *bytes = NULL;
    size_t n = 0;
    cv_message reason;
    cv_status status = cv_output_check(o->output, why);
    FILE *memory = status == CV_OK ? open_memstream(&bytes, &n) : NULL;
    if (memory == NULL)
        return status == CV_OK ? cv_fail(why, CV_FAILED, "out of memory") : status;
    status = run(o, arguments, memory, log, why);
    const int incomplete = ferror(memory);
    if ((fclose(memory) != 0 || incomplete) && status <= CV_UNDECIDED)
        status = cv_fail(why, CV_FAILED, "out of memory for the output");
    if (status <= CV_UNDECIDED && cv_output_write(o->output, bytes, n, &reason) != CV_OK) {
        *why = reason;
        status = CV_FAILED;
    }
    free(bytes);
    return status;
}

static cv_status work(const void *typed, const cv_arguments *arguments, FILE *out, FILE *log, cv_message *why)
{
    const dg_options *o = typed;
    return o->output != NULL ? run_into(o, arguments, log, why) : run(o, arguments, out, log, why);
}

int main(int argc, char **argv)
{
    const cv_program program = {"critvel-dgreen", help, names, options, work};
    dg_options typed = {0};
    cv_selection_init(&typed.selection);
    cv_number_init(&typed.delta.value);
    dg_grid_init(&typed.alphas);
    dg_grid_init(&typed.masses);
    const int status = cv_main(&program, &typed, argc, argv);
    cv_selection_clear(&typed.selection);
    cv_number_clear(&typed.delta.value);
    dg_grid_clear(&typed.alphas);
    dg_grid_clear(&typed.masses);
    return status;
}
