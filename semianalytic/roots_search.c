#include "semianalytic/roots_search.h"

#include <math.h>

typedef struct {
    const sa_track *track;
    double alpha, mass, top, radius;
    sa_rough_roots *out;
} search;

/* 1 when another root is, or is about to be, q */
static int known(const search *s, double complex q, double tolerance)
{
    for (int i = 0; i < s->out->count; i++)
        if (cabs(q - s->out->root[i].q) < tolerance * cabs(q))
            return 1;
    return 0;
}

static double complex in_right_half(double complex q)
{
    return creal(q) < 0 ? CMPLX(-creal(q), cimag(q)) : q;
}

/* Zeta is analytic in Im q < 0 and even there about the imaginary axis: a root at rounding distance is on it.
 */
static void keep(search *s, double complex q, double complex f_q)
{
    if (creal(q) < 1e-13 * cabs(q))
        q = CMPLX(0, cimag(q));
    if (s->out->count < SA_ROOTS_MAX && !known(s, q, 1e-9))
        s->out->root[s->out->count++] = (sa_rough_root){q, f_q};
}

/* Newton's iteration; steps are kept within a part of |q|. */
static void iterate(search *s, double complex q)
{
    enum { STEPS_MAX = 40 };
    const double longest = 0.3, limit = 1e-12;
    sa_sheet sheet;
    for (int i = 0; i < STEPS_MAX; i++) {
        q = in_right_half(q);
        if (!(cabs(q) < 2 * s->radius) || !(cimag(q) < 2 * s->top + 0.01) ||
            sa_sheet_at(&sheet, s->track, s->alpha, q) != CV_OK)
            return;
        double complex zeta_q, zeta = sa_sheet_zeta(&zeta_q, &sheet);
        double complex f_q = -s->mass * zeta_q, change = (1 - s->mass * zeta) / f_q;
        double length = cabs(change) / cabs(q);
        if (!isfinite(length))
            return;
        if (length > longest)
            change *= longest / length;
        q -= change;
        if (length < limit) {
            if (cimag(q) <= s->top)
                keep(s, in_right_half(q), f_q);
            return;
        }
    }
}

static double newton_length(const sa_contour_point *p)
{
    return cabs(p->f / p->f_q);
}

/* Where Newton's step from the contour is shortest, compared with its neighbours. */
static void from_contour(search *s, const sa_contour *contour)
{
    for (size_t i = 1; i + 1 < contour->count; i++) {
        const sa_contour_point *p = &contour->points[i];
        double length = newton_length(p);
        if (length <= newton_length(p - 1) && length <= newton_length(p + 1) && length < cabs(p->q))
            iterate(s, p->q);
    }
}

static void from_grid(search *s)
{
    enum { RADII = 16 };
    const double angle[] = {-1.5, -1.1, -0.6, -0.2, -0.02, 0.02, 0.1, 0.25, 0.6};
    const double smallest = 1e-2;
    for (int i = 0; i < RADII; i++)
        for (size_t j = 0; j < sizeof angle / sizeof angle[0]; j++) {
            double r = smallest * pow(s->radius / smallest, (i + 0.5) / RADII);
            if (r * sin(angle[j]) <= s->top)
                iterate(s, r * cexp(CMPLX(0, angle[j])));
        }
}

void sa_roots_search(sa_rough_roots *out, const sa_contour *contour, const sa_track *t, double alpha,
                     double mass_ratio, double top)
{
    search s = {t, alpha, mass_ratio, top, contour->radius, out};
    out->count = 0;
    from_contour(&s, contour);
    from_grid(&s);
}

int sa_roots_below(const sa_rough_roots *roots, double height)
{
    int n = 0;
    for (int i = 0; i < roots->count; i++)
        if (cimag(roots->root[i].q) < -height)
            n += creal(roots->root[i].q) > 0 ? 2 : 1;
    return n;
}
