/* The [run] section of a case file. Used by casefile.c only. */
#ifndef CRITVEL_COMMON_RUN_H
#define CRITVEL_COMMON_RUN_H

#include "common/casefile.h"
#include "common/values.h"

typedef struct {
    cv_number_list alpha; /* the two ends of the velocity range */
    int digits;
    cv_number_list damping[3];  /* eta_p, eta_b, eta_f, of equal length; empty: not given */
    cv_number_list mass_ratios; /* empty: not given */
} cv_run;

/* Reads the section, NULL for a file without: then, as for keys that are missing, the defaults. CV_BAD_INPUT
 * "path:line: what is wrong"; nothing is then allocated. */
cv_status cv_run_read(cv_run *out, const cv_ini_section *s, const char *path, cv_message *why);
void cv_run_clear(cv_run *run);

#endif
