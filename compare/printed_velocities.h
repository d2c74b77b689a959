/* Velocities of the moving force that the paper prints, beside those of semianalytic/, which alone computes
 * them. */
#ifndef CRITVEL_COMPARE_PRINTED_VELOCITIES_H
#define CRITVEL_COMPARE_PRINTED_VELOCITIES_H

#include "compare/printed.h"
#include "compare/printed_file.h"

/* Append one row for each printed velocity of the entry: the computed one nearest to it, and whether it
 * rounds to the print and is of the printed kind. entry->printed holds "velocity kind velocity kind ...", the
 * kinds being resonances       true false pseudocritical   max min active_point, or any CV_FAILED: more rows
 * than "room", or an entry that is not so. */
cv_status cmp_printed_resonances(cmp_printed *out, size_t room, const cmp_printed_entry *entry,
                                 const cv_params *track, cv_message *why);
cv_status cmp_printed_pseudocritical(cmp_printed *out, size_t room, const cmp_printed_entry *entry,
                                     const cv_params *track, cv_message *why);

#endif
