/* The velocities that the figures mark, and the range of velocities they show. */
#ifndef CRITVEL_COMPARE_FIGURE_VELOCITIES_H
#define CRITVEL_COMPARE_FIGURE_VELOCITIES_H

#include "compare/figure.h"
#include "semianalytic/pseudocritical.h"
#include "semianalytic/resonances.h"

typedef struct {
    double low, high;             /* the file's range of velocities */
    sa_resonance_list resonances; /* all there are */
    sa_pseudocritical_list peaks; /* in the range */
} cmp_velocities;

/* out is zero; to be cleared also after a failure. */
cv_status cmp_velocities_find(cmp_velocities *out, const cmp_figure *f, cv_message *why);
void cmp_velocities_clear(cmp_velocities *v);

double cmp_resonance_alpha(const sa_resonance *r);

/* Where a picture may end: somewhat beyond the last of these velocities in the range, a round number if that
 * is in the range. */
double cmp_velocities_end(const cmp_velocities *v);

/* Where it begins: at 0 when the range goes down far enough. */
double cmp_velocities_begin(const cmp_velocities *v, double end);

/* The mass ratios a picture shows: those of the case, at least three decades, between 1e-10 and 1e10. */
void cmp_mass_range(double *lightest, double *heaviest, const cv_case *c);

/* Tics at powers of ten for a y axis that holds log10 of the mass ratio. */
void cmp_mass_tics(FILE *script, double lightest, double heaviest);

/* The smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is at least x > 0 */
double cmp_round_up(double x);

/* Data blocks "true", "false", "merging", "pseudocritical", those that are not empty. */
void cmp_velocities_data(FILE *data, const cmp_velocities *v);

/* Vertical lines from "bottom" to "top" of the script, as further elements of a plot command: dashed for true
 * resonance velocities, dash-dotted for false ones, and with_peaks dotted for the pseudocritical ones of max
 * and min. */
void cmp_velocities_plot(FILE *script, const cmp_velocities *v, int with_peaks);

#endif
