#include "semianalytic/roots_contour.h"

#include <math.h>
#include <stdlib.h>

#include "semianalytic/branch_curves.h"
#include "semianalytic/laplace.h"
#include "semianalytic/matrix.h"

static const double pi = 3.14159265358979323846;

typedef struct {
    const sa_track *track;
    double alpha, mass, height;
    sa_sweep *sweep;
    sa_contour *out;
    double turned; /* change of arg f so far */
    int on_arc;
} walk;

/* zeta with a bound where that is cheap, else to a few digits; off the axis also without */
static cv_status zeta_at(double complex *zeta, double complex *zeta_q, walk *w, double complex q)
{
    sa_value v;
    cv_status status = sa_zeta_complex(&v, w->sweep, w->track, w->alpha, q);
    if (status == CV_UNDECIDED && cimag(q) == 0)
        status = sa_zeta_adaptive(&v, w->sweep, w->track, w->alpha, creal(q), 1e-3);
    if (status == CV_OK) {
        *zeta = CMPLX(v.re, v.im);
        *zeta_q = v.d_q;
        return CV_OK;
    }
    sa_sheet s;
    if (cimag(q) < 0)
        status = sa_sheet_start(&s, w->track, w->alpha, q);
    if (status == CV_OK)
        *zeta = sa_sheet_zeta(zeta_q, &s);
    return status;
}

static cv_status point_at(sa_contour_point *p, walk *w, double complex q)
{
    double complex zeta = 0, zeta_q = 0;
    cv_status status = q == 0 ? CV_OK : zeta_at(&zeta, &zeta_q, w, q);
    *p = (sa_contour_point){q, 1 - w->mass * zeta, -w->mass * zeta_q};
    return status;
}

static cv_status append(sa_contour *c, const sa_contour_point *p)
{
    if (c->count == c->room) {
        size_t room = 2 * c->room + 64;
        sa_contour_point *more = realloc(c->points, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        c->points = more;
        c->room = room;
    }
    c->points[c->count++] = *p;
    return CV_OK;
}

/* middle of a piece, on the line or on the circle about -i height */
static double complex middle_of(const walk *w, double complex a, double complex b)
{
    const double complex centre = CMPLX(0, -w->height);
    if (!w->on_arc)
        return (a + b) / 2;
    const double complex m = (a + b) / 2 - centre;
    return centre + m / cabs(m) * cabs(a - centre);
}

static int smooth(const sa_contour_point *a, const sa_contour_point *m, const sa_contour_point *b)
{
    const double least = fmin(cabs(a->f), fmin(cabs(m->f), cabs(b->f)));
    const double complex half = m->q - a->q, rest = b->q - m->q;
    const double complex cubic = (a->f + b->f) / 2 + (half + rest) * (a->f_q - b->f_q) / 8;
    return cabs(m->f - a->f) < least / 2 && cabs(b->f - m->f) < least / 2 &&
           cabs(m->f - cubic) < least / 10 && cabs(half) < 0.15 * cabs(m->q) + 0.02;
}

static cv_status piece(walk *w, const sa_contour_point *a, const sa_contour_point *b, int depth)
{
    sa_contour_point m;
    cv_status status = point_at(&m, w, middle_of(w, a->q, b->q));
    if (status != CV_OK)
        return status;
    if (smooth(a, &m, b)) {
        w->turned += carg(m.f / a->f) + carg(b->f / m.f);
        if (!w->on_arc)
            status = append(w->out, &m);
        return status == CV_OK && !w->on_arc ? append(w->out, b) : status;
    }
    if (depth == 0)
        return CV_UNDECIDED;
    status = piece(w, a, &m, depth - 1);
    return status == CV_OK ? piece(w, &m, b, depth - 1) : status;
}

static cv_status span(walk *w, double complex from, double complex to)
{
    enum { DEPTH_MAX = 70 };
    sa_contour_point a, b;
    cv_status status = point_at(&a, w, from);
    if (status == CV_OK)
        status = point_at(&b, w, to);
    return status == CV_OK ? piece(w, &a, &b, DEPTH_MAX) : status;
}

/* zeta of the bare beam is -sqrt(qbar)/2 (response.h) */
static int bare_beam(walk *w, double radius)
{
    for (int i = 0; i <= 4; i++) {
        double complex zeta, zeta_q, q = CMPLX(0, -w->height) + radius * cexp(CMPLX(0, -pi / 8 * i));
        double complex beam = -csqrt(CMPLX(-cimag(q), creal(q))) / 2;
        if (zeta_at(&zeta, &zeta_q, w, q) != CV_OK || !(cabs(zeta - beam) < cabs(beam) / 10))
            return 0;
    }
    return 1;
}

static cv_status choose_radius(walk *w)
{
    const double largest = 1e7;
    for (w->out->radius = 4; w->out->radius < largest; w->out->radius *= 2)
        if (bare_beam(w, w->out->radius))
            return CV_OK;
    return CV_UNDECIDED;
}

/* The line from 0 to Q, cut at the branch points of the undamped track. */
static cv_status along_line(walk *w, cv_message *why)
{
    const double around = 1e-3;
    double from = 0;
    sa_branch_curves curves;
    sa_branch_point *at = NULL;
    cv_status status = CV_OK;
    int n = 0;
    if (w->alpha > 0) {
        status = sa_branch_curves_build(&curves, &w->track->exact, w->alpha * (1 - around),
                                        w->alpha * (1 + around), why);
        if (status != CV_OK)
            return status;
        at = malloc((curves.arc_count + 1) * sizeof *at);
        n = at != NULL ? sa_branch_points(at, curves.arc_count, &curves, w->alpha) : -1;
        sa_branch_curves_clear(&curves);
        if (n < 0)
            status = CV_FAILED;
    }
    for (int i = 0; i <= n && status == CV_OK; i++) {
        double to = i < n ? at[i].q : w->out->radius;
        if (!(to > from) || to > w->out->radius)
            continue;
        status = span(w, CMPLX(from, -w->height), CMPLX(to, -w->height));
        from = to;
    }
    free(at);
    return status;
}

static cv_status count(walk *w, cv_message *why)
{
    const double radius = w->out->radius;
    cv_status status = along_line(w, why);
    w->on_arc = 1;
    if (status == CV_OK)
        status = span(w, CMPLX(radius, -w->height), CMPLX(0, -w->height) + radius * cexp(CMPLX(0, -pi / 4)));
    if (status == CV_OK)
        status =
            span(w, CMPLX(0, -w->height) + radius * cexp(CMPLX(0, -pi / 4)), CMPLX(0, -w->height - radius));
    const double turns = -w->turned / pi;
    w->out->roots = (int)lround(turns);
    if (status == CV_OK && !(fabs(turns - w->out->roots) < 0.01 && w->out->roots >= 0))
        return cv_fail(why, CV_UNDECIDED, "argument changes by %.3f pi along the contour", -turns);
    return status;
}

cv_status sa_contour_build(sa_contour *out, const sa_track *t, double alpha, double mass_ratio, double height,
                           cv_message *why)
{
    walk w = {.track = t, .alpha = alpha, .mass = mass_ratio, .height = height, .out = out};
    *out = (sa_contour){0};
    if (!(height >= 0) || (t->undamped && height == 0))
        return cv_fail(why, CV_BAD_INPUT,
                       "the contour passes through the singularities of an undamped track");
    w.sweep = sa_sweep_new();
    if (w.sweep == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = choose_radius(&w);
    if (status != CV_OK)
        cv_fail(why, status, "no radius beyond which the beam alone matters");
    if (status == CV_OK)
        status = count(&w, why);
    sa_sweep_free(w.sweep);
    if (status == CV_OK)
        return CV_OK;
    if (why != NULL && why->text[0] == '\0')
        cv_fail(why, status, "zeta is not to be had, or too near 1/eta_M, on the contour");
    sa_contour_clear(out);
    return status;
}

void sa_contour_clear(sa_contour *c)
{
    free(c->points);
    *c = (sa_contour){0};
}
