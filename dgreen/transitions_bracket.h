/* A bracketed root of a real function with certified signs, to any precision. */
#ifndef CRITVEL_DGREEN_TRANSITIONS_BRACKET_H
#define CRITVEL_DGREEN_TRANSITIONS_BRACKET_H

#include <mpfr.h>

#include "common/status.h"

typedef struct {
    mpfr_t at, value;
    int sign;     /* certified sign of the function at exactly "at": -1 or 1 */
    mpfr_t aside; /* what the function wants to remember with the point */
    mpfr_t aside_low, aside_high;
} dg_end;

/* Fills value, sign and what it likes for e->at. Any status but CV_OK ends the search. */
typedef cv_status dg_certified(dg_end *e, void *context);

typedef struct {
    dg_end low, high, trial; /* low.at < high.at, signs differ */
    mpfr_t tolerance;        /* width that is asked for */
    double scale;            /* distance over which the slope of the function changes */
    mpfr_t width, step;      /* scratch */
    dg_certified *function;
    void *context;
} dg_bracket;

void dg_bracket_init(dg_bracket *b, mpfr_prec_t precision, dg_certified *function, void *context);
void dg_bracket_clear(dg_bracket *b);

/* Brackets [centre - half, centre + half], growing by factors of 4 until the signs differ; half at most
 * "most". CV_UNDECIDED: they do not. */
cv_status dg_bracket_open(dg_bracket *b, mpfr_srcptr centre, double half, double most);

/* Shrinks the bracket to the tolerance. Method: secant; the function is evaluated on both sides of the
 * secant's zero, at a distance of its expected quadratic error, so that the width is squared in each step;
 * halving where that fails. CV_UNDECIDED: the precision of the points does not reach the tolerance. */
cv_status dg_bracket_close(dg_bracket *b);

#endif
