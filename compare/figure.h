/* The pictures of critvel-compare figures: one function for each kind. */
#ifndef CRITVEL_COMPARE_FIGURE_H
#define CRITVEL_COMPARE_FIGURE_H

#include "common/selection.h"
#include "compare/picture.h"

/* One picture to be drawn. */
typedef struct {
    const cv_casefile *file;
    const cv_case *of;       /* the case inside file */
    const char *slug;        /* its name as part of a file name */
    const cv_selection *set; /* --damping, --alpha, --mass-ratio */
} cmp_figure;

/* Writes data, script and "shows" of a picture that is open, or sets "absent" when the case has nothing that
 * it could show. CV_UNDECIDED: it could not be computed; why says so. */
typedef cv_status cmp_figure_draw(cmp_picture *p, const cmp_figure *f, cv_message *why);

cmp_figure_draw cmp_draw_curve_right; /* figure 2 */
cmp_figure_draw cmp_draw_curve_left;  /* figure 3 */
cmp_figure_draw cmp_draw_lines;       /* figures 4 and 5 */
cmp_figure_draw cmp_draw_deflection;  /* figures 6 and 7 */
cmp_figure_draw cmp_draw_map;         /* unstable roots and growth rate over velocity and mass ratio */
cmp_figure_draw cmp_draw_steady;      /* shapes of rail, sleepers and ballast */

/* The damping levels of a picture, and the track at one of them: those of the case, or --damping alone. out:
 * initialised. */
size_t cmp_figure_levels(const cmp_figure *f);
void cmp_figure_params(cv_params *out, const cmp_figure *f, size_t level);

/* "case 3" or "track Zhai", into a buffer of CMP_PICTURE_SHOWS. */
const char *cmp_figure_case(char *out, const cmp_figure *f);

#endif
