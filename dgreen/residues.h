/* Residues R/Delta' and their sum over a half-plane, in double. */
#ifndef CRITVEL_DGREEN_RESIDUES_H
#define CRITVEL_DGREEN_RESIDUES_H

#include "dgreen/roots.h"

/* A sum of residues R(i y)/(d Delta(i y)/dy); each part is off by at most its error, units of 2^-53 */
typedef struct {
    double re, im, error_re, error_im;
} dg_residue;

typedef struct {
    dg_residue right, left; /* over Re lambda > 0 and Re lambda < 0; right + left = 0 for the exact sums */
    int right_count, left_count;
} dg_residues;

/* CV_UNDECIDED: the disc of a root meets the imaginary axis of lambda. (The far root may: its small residue
 * then becomes part of both errors and it is in neither count.) CV_FAILED: the sum of all residues is not 0
 * within the errors, which cannot be (deg R <= deg Delta - 2). */
cv_status dg_residues_sum(dg_residues *out, const dg_operator *op, const dg_roots *roots,
                          const dg_discs *discs);

#endif
