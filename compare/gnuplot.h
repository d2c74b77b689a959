/* gnuplot as a program. */
#ifndef CRITVEL_COMPARE_GNUPLOT_H
#define CRITVEL_COMPARE_GNUPLOT_H

#include <limits.h>

#include "common/status.h"

/* The absolute path of gnuplot from PATH. CV_FAILED: there is none; the message names the Debian package. */
cv_status cmp_gnuplot_find(char program[PATH_MAX], cv_message *why);

/* Runs "gnuplot SCRIPT" in "folder" with the variable "format" set, without the user's settings and in the C.UTF-8
 * locale; no shell is involved. CV_FAILED unless it ends with exit status 0; the message holds what it said.
 * A file gnuplot.log is left in folder. May be called by several threads for different folders. */
cv_status cmp_gnuplot_run(const char *program, const char *folder, const char *script, const char *format,
                          cv_message *why);

#endif
