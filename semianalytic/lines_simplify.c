#include <math.h>

#include "semianalytic/lines_parts.h"

/* Samples are within a quarter of 1e-3 of the line; this leaves a margin. */
static const double tolerance = 5e-4;

/* Distance of m from the chord a b in the plot. */
static double chord_distance(const sa_line_sample *a, const sa_line_sample *m, const sa_line_sample *b,
                             const sa_line_plot *plot)
{
    double x = (b->alpha - a->alpha) / plot->alpha_span, y = log(a->re / b->re) / plot->log_span;
    double u = (m->alpha - a->alpha) / plot->alpha_span, v = log(a->re / m->re) / plot->log_span;
    double length2 = x * x + y * y, along = length2 > 0 ? (u * x + v * y) / length2 : 0;
    along = fmin(fmax(along, 0), 1);
    return hypot(u - along * x, v - along * y);
}

static int chord_holds(const sa_line_sample *s, size_t from, size_t to, const sa_line_plot *plot)
{
    for (size_t i = from + 1; i < to; ++i)
        if (s[i].marks != 0 || !(chord_distance(&s[from], &s[i], &s[to], plot) < tolerance))
            return 0;
    return 1;
}

void sa_line_simplify(char *kept, const sa_line_sample *sample, size_t count, const sa_line_plot *plot)
{
    for (size_t i = 0; i < count; ++i)
        kept[i] = 0;
    for (size_t from = 0, to; from + 1 < count; from = to) {
        kept[from] = 1;
        for (to = from + 1; to + 1 < count && chord_holds(sample, from, to + 1, plot); ++to)
            ;
    }
    kept[count - 1] = 1;
}
