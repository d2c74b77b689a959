/* Velocities of the moving force that the paper prints, beside those of semianalytic/. */
#ifndef CRITVEL_COMPARE_PRINTED_VELOCITIES_H
#define CRITVEL_COMPARE_PRINTED_VELOCITIES_H

#include "compare/printed.h"
#include "compare/printed_file.h"

/* Appends one row for each printed resonance velocity of the track: the computed one nearest to it, and
 * whether both say true or false. printed holds "velocity kind velocity kind ...". CV_FAILED: more rows than
 * "room". */
cv_status cmp_printed_resonances(cmp_printed *out, size_t room, const cmp_printed_entry *entry,
                                 const cv_params *track, cv_message *why);

#endif
