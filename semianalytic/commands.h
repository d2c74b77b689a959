/* The subcommands of critvel-semianalytic; main.c holds the table. */
#ifndef CRITVEL_SEMIANALYTIC_COMMANDS_H
#define CRITVEL_SEMIANALYTIC_COMMANDS_H

#include "common/selection.h"

/* Everything the command line can say; a command ignores what is not meant for it. */
typedef struct {
    cv_selection selection;
    cv_optional_number xi; /* place relative to the load, dimensionless */
    int quadrature;        /* kernel: K along the real axis too */
} sa_options;

/* As cv_work of common/cli.h. */
typedef cv_status sa_command(const sa_options *options, const cv_arguments *arguments, FILE *out, FILE *log,
                             cv_message *why);

sa_command sa_command_kernel;     /* K(xi, q) and zeta at one (alpha, q) */
sa_command sa_command_resonances; /* resonance and pseudocritical velocities of the moving force */

#endif
