/* critvel-semianalytic: the table of its subcommands. */
#include <gsl/gsl_errno.h>
#include <string.h>

#include "semianalytic/commands.h"

static const struct {
    const char *name;
    sa_command *run;
} commands[] = {
    {"kernel", sa_command_kernel}, {"resonances", sa_command_resonances}, {"steady", sa_command_steady},
    {"roots", sa_command_roots},   {"response", sa_command_response},     {"lines", sa_command_lines},
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

static const char help[] =
    "critvel-semianalytic: a mass moving on a beam on three viscoelastic layers, by poles in the wave "
    "number.\n"
    "\n"
    "usage: critvel-semianalytic COMMAND FILE [OPTIONS]\n"
    "\n"
    "  kernel       K(xi, q) of (13) and zeta = q^2 K(0, q) / (2 pi) at one velocity and frequency\n"
    "  resonances   resonance and pseudocritical velocities of the moving force\n"
    "  steady       shape of rail, sleepers and ballast under the moving force (text: CSV;\n"
    "               pictures: critvel-compare figures --only steady)\n"
    "  roots        roots of z = eta_M zeta = 1: mass-induced frequencies and growth rates\n"
    "  response     deflection in time at the load and at xi, by inversion of (14) (text: CSV)\n"
    "  lines        instability lines: all branches in a range of alpha and eta_M, and their asymptotes\n"
    "\n"
    "FILE is a case file, e.g. data/paper.ini.\n"
    "\n"
    "examples:\n"
    "  critvel-semianalytic kernel data/paper.ini --case 1 --damping 1e-10 --alpha 0.3 --frequency 0.22\n"
    "  critvel-semianalytic kernel data/paper.ini --case 1 --damping 0 --alpha 0.3 --frequency 0.22 --digits "
    "60\n"
    "  critvel-semianalytic kernel data/paper.ini --alpha 0.3 --frequency 0.22 --xi -1.5 --format json\n"
    "  critvel-semianalytic resonances data/paper.ini --case 3 --digits 25 --format json\n"
    "  critvel-semianalytic steady data/paper.ini --case 3 --damping 0 --alpha 0.4 --from -60 --to 30\n"
    "  critvel-semianalytic roots data/paper.ini --case 1 --damping 0.05 --alpha 0.5 --mass-ratio 100\n"
    "  critvel-semianalytic response data/paper.ini --alpha 0.5 --mass-ratio 100 --time 0:200:401\n"
    "  critvel-semianalytic lines data/paper.ini --case 4 --damping 1e-10 --format csv --output lines.csv\n"
    "  critvel-semianalytic lines data/paper.ini --case 3 --damping 1e-4 --alpha 0.3:0.9 --mass-ratio "
    "10:1e5\n"
    "\n"
    "options:\n"
    "  --case NAME      the section [case NAME] or [track NAME] (default: the first of the file)\n"
    "  --damping X      eta_p = eta_b = eta_f = X, 0 allowed (default: the file's first level)\n"
    "  --alpha X        velocity ratio of (4); lines: a:b (default: the range of the file)\n"
    "  --frequency X    q, dimensionless; qbar = i q\n"
    "  --xi X           distance from the load, dimensionless (default 0)\n"
    "  --mass-ratio X   eta_M of (11); lines: a:b (default: 1:10000)\n"
    "  --time T         response: t1,t2,... or a:b:n\n"
    "  --depth X        roots: stable ones down to Re qbar = -X (default 1)\n"
    "  --quadrature     K also by numerical integration along the real p axis (damped tracks)\n"
    "  --from X, --to X, --points N   steady: where the shape is written (default: 401 from -20 to 20)\n"
    "  --digits N       significant digits of each part (default: digits of the file)\n"
    "  --format FORMAT  text or json; lines: also csv, a row per vertex\n"
    "  --output FILE    lines: write there, whole or not at all, instead of to standard output\n"
    "  --help, --version\n"
    "\n"
    "Real and imaginary part are each right to all digits printed. Damping 0 is the limit q - i0.\n"
    "exit status: 0 done, 1 undecided, 2 wrong usage or input, 3 internal or I/O failure\n";

/* One number for most commands, a range a:b for lines. */
static cv_status set_range(cv_optional_number *single, sa_typed_range *range, const char *text,
                           cv_message *why)
{
    char low[64];
    const char *colon = strchr(text, ':');
    if (colon == NULL)
        return cv_set_number(single, text, why);
    size_t n = (size_t)(colon - text);
    if (n >= sizeof low)
        return cv_fail(why, CV_BAD_INPUT, "not a range a:b of numbers");
    memcpy(low, text, n);
    low[n] = '\0';
    range->given = 1;
    cv_status status = cv_number_parse(&range->low, low, why);
    if (status == CV_OK)
        status = cv_number_parse(&range->high, colon + 1, why);
    if (status == CV_OK &&
        (cv_number_sign(&range->low) <= 0 || cv_number_compare(&range->low, &range->high) >= 0))
        status = cv_fail(why, CV_BAD_INPUT, "a range a:b must have 0 < a < b");
    return status;
}

static cv_status set_alpha(void *to, const char *text, cv_message *why)
{
    sa_options *o = to;
    return set_range(&o->selection.alpha, &o->alphas, text, why);
}

static cv_status set_mass_ratio(void *to, const char *text, cv_message *why)
{
    sa_options *o = to;
    return set_range(&o->selection.mass_ratio, &o->masses, text, why);
}

static cv_status set_format(void *to, const char *text, cv_message *why)
{
    sa_options *o = to;
    o->csv = strcmp(text, "csv") == 0;
    return o->csv ? CV_OK : cv_set_format(&o->selection.format, text, why);
}

/* What only lines understands. */
static cv_status refuse_for(const char *command, const sa_options *o, cv_message *why)
{
    if (strcmp(command, "lines") == 0)
        return CV_OK;
    if (o->alphas.given || o->masses.given)
        return cv_fail(why, CV_BAD_INPUT, "--%s: %s takes one number, not a range",
                       o->alphas.given ? "alpha" : "mass-ratio", command);
    if (o->csv || o->output != NULL)
        return cv_fail(why, CV_BAD_INPUT, "--%s is for lines", o->csv ? "format csv" : "output");
    return CV_OK;
}

static cv_status work(const void *options, const cv_arguments *arguments, FILE *out, FILE *log,
                      cv_message *why)
{
    const cv_status status = refuse_for(arguments->command, options, why);
    if (status != CV_OK)
        return status;
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(commands[i].name, arguments->command) == 0)
            return commands[i].run(options, arguments, out, log, why);
    return cv_fail(why, CV_BAD_INPUT, "unknown command '%s'", arguments->command);
}

int main(int argc, char **argv)
{
    static const cv_option table[] = {
        CV_OPTION_CASE(offsetof(sa_options, selection)),
        CV_OPTION_DAMPING(offsetof(sa_options, selection)),
        {"alpha", set_alpha, 0, 0},
        CV_OPTION_FREQUENCY(offsetof(sa_options, selection)),
        {"mass-ratio", set_mass_ratio, 0, 0},
        CV_OPTION_DIGITS(offsetof(sa_options, selection)),
        {"format", set_format, 0, 0},
        {"output", cv_set_text, offsetof(sa_options, output), 0},
        {"xi", cv_set_number, offsetof(sa_options, xi), 0},
        {"quadrature", cv_set_flag, offsetof(sa_options, quadrature), 1},
        {"from", cv_set_number, offsetof(sa_options, from), 0},
        {"to", cv_set_number, offsetof(sa_options, to), 0},
        {"points", cv_set_number, offsetof(sa_options, points), 0},
        {"time", cv_set_text, offsetof(sa_options, times), 0},
        {"depth", cv_set_number, offsetof(sa_options, depth), 0},
        {NULL, NULL, 0, 0},
    };
    const char *names[COMMANDS + 1] = {NULL};
    for (int i = 0; i < COMMANDS; i++)
        names[i] = commands[i].name;
    const cv_program program = {"critvel-semianalytic", help, names, table, work};
    sa_options options;
    gsl_set_error_handler_off();
    cv_selection_init(&options.selection);
    options.quadrature = options.csv = options.alphas.given = options.masses.given = 0;
    options.times = options.output = NULL;
    cv_number *ends[] = {&options.alphas.low, &options.alphas.high, &options.masses.low,
                         &options.masses.high};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        cv_number_init(ends[i]);
    cv_optional_number *numbers[] = {&options.xi, &options.from, &options.to, &options.points,
                                     &options.depth};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        numbers[i]->given = 0;
        cv_number_init(&numbers[i]->value);
    }
    int status = cv_main(&program, &options, argc, argv);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        cv_number_clear(&numbers[i]->value);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        cv_number_clear(ends[i]);
    cv_selection_clear(&options.selection);
    return status;
}
