/* The subcommands of critvel-semianalytic; main.c holds the table. */
#ifndef CRITVEL_SEMIANALYTIC_COMMANDS_H
#define CRITVEL_SEMIANALYTIC_COMMANDS_H

#include "common/selection.h"

/* low:high */
typedef struct {
    int given;
    cv_number low, high;
} sa_typed_range;

/* Everything the command line can say; a command ignores what is not meant for it. */
typedef struct {
    cv_selection selection;
    cv_optional_number xi;               /* place relative to the load, dimensionless */
    int quadrature;                      /* kernel: K along the real axis too */
    cv_optional_number from, to, points; /* steady: where the shape is written */
    cv_optional_number depth;            /* roots: how far to the left of the imaginary axis */
    const char *times;                   /* response: list or range; NULL where not given */
    sa_typed_range alphas, masses;       /* lines: --alpha a:b, --mass-ratio a:b */
    int csv;                             /* lines: --format csv */
    const char *output;                  /* lines: file to write; NULL where not given */
} sa_options;

/* As cv_work of common/cli.h. */
typedef cv_status sa_command(const sa_options *options, const cv_arguments *arguments, FILE *out, FILE *log,
                             cv_message *why);

sa_command sa_command_kernel;     /* K(xi, q) and zeta at one (alpha, q) */
sa_command sa_command_resonances; /* resonance and pseudocritical velocities of the moving force */
sa_command sa_command_steady;     /* shape of the track under a moving constant force */
sa_command sa_command_response;   /* deflection in time after the load is switched on */
sa_command sa_command_roots;      /* mass-induced frequencies and growth rates */
sa_command sa_command_lines;      /* instability lines and their asymptotes */

#endif
