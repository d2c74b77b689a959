/* Subcommands of critvel-dgreen; each in its own command_<name>.c, listed in main.c. */
#ifndef CRITVEL_DGREEN_COMMAND_H
#define CRITVEL_DGREEN_COMMAND_H

#include <stdio.h>

#include "common/selection.h"
#include "dgreen/grid.h"

/* What was typed: the target of main.c's option table. */
typedef struct {
    cv_selection selection;
    dg_grid alphas, masses;   /* --alpha and --mass-ratio; one number goes to the selection as well */
    cv_optional_number delta; /* of curve */
    const char *output;       /* NULL: standard output */
    int csv;                  /* --format csv; for most commands that is their text */
} dg_options;

/* As cv_work: reads FILE at path, writes the answer to out; warnings to log. */
typedef cv_status dg_command(const dg_options *options, const char *path, FILE *out, FILE *log,
                             cv_message *why);

dg_command dg_command_z;           /* zeta (and z) at one point */
dg_command dg_command_count;       /* unstable roots at one velocity */
dg_command dg_command_transitions; /* all transitions over the velocity range */
dg_command dg_command_roots;       /* mass-induced frequencies at one velocity */
dg_command dg_command_curve;       /* curves of figures 2 and 3 at one velocity */
dg_command dg_command_map;         /* stability over mass ratio and velocity */
dg_command dg_command_lines;       /* instability lines in a range of velocity and mass ratio */

#endif
