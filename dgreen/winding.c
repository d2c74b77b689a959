#include "dgreen/winding.h"

#include <complex.h>
#include <math.h>

static const double PI = 3.14159265358979323846;

int dg_crossing_balance(const dg_curve *c, double x)
{
    int balance = 0;
    for (size_t i = 0; i < c->crossing_count; i++)
        if (c->crossings[i].x > x)
            balance += 2 * c->crossings[i].direction;
    return balance;
}

int dg_curve_touches(const dg_curve *c, double x)
{
    for (size_t i = 0; i < c->crossing_count; i++)
        if (c->crossings[i].x_low <= x && c->crossings[i].x_high >= x)
            return 1;
    return 0;
}

/* arg(b - x) - arg(a - x) along the straight line from a to b; 0 with *passes = 1 where the line comes too
 * near to x for the values to tell the side. */
static double turn(int *passes, const dg_node *a, const dg_node *b, double x)
{
    const double one = x - a->re, other = x - b->re, across = a->im * b->im + one * other;
    const double up = one * -b->im - other * -a->im;
    const double doubt = a->re_error * fabs(b->im) + b->re_error * fabs(a->im);
    if ((a->im > 0) != (b->im > 0) && !(fabs(up) > doubt))
        *passes = 1;
    return atan2(up, across);
}

/* The same where zeta goes through infinity: from one node along the real direction, on the side without
 * waves, there round to the imaginary direction, and back along it to the other node. */
static double turn_at_pole(const dg_pole *pole, const dg_node *a, const dg_node *b, double x)
{
    const dg_node *wave = pole->waves_above ? b : a, *rest = pole->waves_above ? a : b;
    const double complex real = CMPLX(pole->real, 0), imaginary = CMPLX(0, pole->imaginary);
    const double complex from = CMPLX(rest->re - x, rest->im), to = CMPLX(wave->re - x, wave->im);
    const double way = carg(real / from) + carg(imaginary / real) + carg(to / imaginary);
    return pole->waves_above ? way : -way;
}

cv_status dg_winding(int *roots, const dg_curve *c, double x, cv_message *why)
{
    const dg_node *first = &c->nodes[0], *last = &c->nodes[c->node_count - 1];
    int passes = dg_curve_touches(c, x);
    double sum = atan2(-first->im, x - first->re); /* zeta(0) = 0 */
    for (size_t i = 0; i + 1 < c->node_count; i++) {
        const dg_node *a = &c->nodes[i], *b = a + 1;
        const dg_pole *pole = dg_curve_pole(c, a, b);
        sum += pole != NULL ? turn_at_pole(pole, a, b, x) : turn(&passes, a, b, x);
    }
    sum += PI / 4 - atan2(-last->im, x - last->re); /* the bare rail to infinity */
    if (passes)
        return cv_fail(why, CV_UNDECIDED, "a root on the stability boundary at alpha = %.17g", c->at.alpha);
    const double count = 0.25 - sum / PI;
    *roots = 2 * (int)lround(count / 2);
    if (!(fabs(count - *roots) < 1e-6) || *roots < 0)
        return cv_fail(why, CV_UNDECIDED, "winding gives %.7f roots at alpha = %.17g", count, c->at.alpha);
    if (*roots != dg_crossing_balance(c, x))
        return cv_fail(why, CV_UNDECIDED, "winding gives %d roots, crossings give %d at alpha = %.17g",
                       *roots, dg_crossing_balance(c, x), c->at.alpha);
    return CV_OK;
}
