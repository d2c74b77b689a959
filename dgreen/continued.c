#include "dgreen/continued.h"

#include <math.h>

/* Largest change of a root in one step, relative to its distance from the others */
static const double STEP = 0.2;
enum { DEPTH = 30 };

static double complex root(const dg_roots *r, int i)
{
    return CMPLX(r->re[i], r->im[i]);
}

static int near_count(const dg_roots *r)
{
    return r->count - r->far;
}

static double nearest(const dg_roots *r, int i)
{
    double distance = HUGE_VAL;
    for (int k = 0; k < near_count(r); k++)
        if (k != i)
            distance = fmin(distance, cabs(root(r, i) - root(r, k)));
    return distance;
}

/* No root moved so far that it could be another one. */
static int same_order(const dg_roots *before, const dg_roots *after)
{
    if (before->count != after->count || before->far != after->far)
        return 0;
    for (int i = 0; i < near_count(before); i++)
        if (!(cabs(root(after, i) - root(before, i)) <= STEP * nearest(before, i)))
            return 0;
    return 1;
}

static cv_status walk(dg_continued *c, double complex qbar, int depth)
{
    dg_operator op;
    dg_roots next = c->roots;
    dg_operator_set(&op, c->track, c->alpha, qbar);
    if (dg_roots_polish(&next, &op) == CV_OK && same_order(&c->roots, &next)) {
        c->roots = next;
        c->qbar = qbar;
        return CV_OK;
    }
    if (depth == DEPTH)
        return CV_UNDECIDED;
    const cv_status status = walk(c, (c->qbar + qbar) / 2, depth + 1);
    return status == CV_OK ? walk(c, qbar, depth + 1) : status;
}

cv_status dg_continued_move(dg_continued *c, double complex qbar)
{
    dg_continued moved = *c;
    const cv_status status = walk(&moved, qbar, 0);
    if (status == CV_OK)
        *c = moved;
    return status;
}

/* R(i y)/(d Delta(i y)/dy) at a root; reversed: of u = 1/y, -u^2 [u^4 R(i/u)]/[d/du u^8 Delta(i/u)] */
static double complex residue(const dg_operator *op, double complex y, int reversed)
{
    const int n = op->degree;
    double complex value = 0, slope = 0, top = 0;
    for (int k = n; k >= 0; k--) {
        const int at = reversed ? n - k : k;
        slope = slope * y + value;
        value = value * y + CMPLX(op->re[at], op->im[at]);
    }
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const int at = reversed ? DG_R_DEGREE - k : k;
        top = top * y + CMPLX(op->r_re[at], op->r_im[at]);
    }
    return (reversed ? -y * y : 1) * top / slope;
}

double complex dg_continued_zeta(const dg_continued *c)
{
    dg_operator op;
    double complex sum = 0;
    dg_operator_set(&op, c->track, c->alpha, c->qbar);
    for (int i = 0; i < c->roots.count; i++)
        if (c->chosen >> i & 1u)
            sum += residue(&op, root(&c->roots, i), i >= near_count(&c->roots));
    return 4 * CMPLX(0, 1) * c->qbar * c->qbar * sum;
}

cv_status dg_continued_slope(double complex *slope, const dg_continued *c, double room)
{
    static const double PART = 5e-3;
    dg_continued left = *c, right = *c;
    cv_status status = dg_continued_move(&left, c->qbar - PART * room);
    if (status == CV_OK)
        status = dg_continued_move(&right, c->qbar + PART * room);
    if (status == CV_OK)
        *slope = (dg_continued_zeta(&right) - dg_continued_zeta(&left)) / (right.qbar - left.qbar);
    return status;
}

/* Re lambda = -Im y; Im(1/y) has the other sign. */
static void choose(dg_continued *c)
{
    c->chosen = 0;
    for (int i = 0; i < c->roots.count; i++)
        if ((c->roots.im[i] < 0) != (i >= near_count(&c->roots)))
            c->chosen |= 1u << i;
}

cv_status dg_continued_start(dg_continued *c, dg_follow *follow, const dg_track *track, double alpha,
                             double q, double aside)
{
    static const double TOLERANCE = 1e-6;
    dg_operator op;
    dg_value v;
    *c = (dg_continued){.track = track, .alpha = alpha, .qbar = CMPLX(aside, q)};
    dg_operator_set(&op, track, alpha, c->qbar);
    cv_status status = dg_roots_cold(&c->roots, &op);
    if (status == CV_OK)
        status = dg_roots_polish_cold(&c->roots, &op);
    if (status == CV_OK)
        status = dg_zeta_adaptive(&v, follow, track, alpha, c->qbar, INFINITY, INFINITY);
    if (status != CV_OK)
        return status;
    choose(c);
    const double complex expected = CMPLX(v.re, v.im);
    if (!(cabs(dg_continued_zeta(c) - expected) <= TOLERANCE * cabs(expected) + v.re_error + v.im_error))
        return CV_UNDECIDED;
    return dg_continued_move(c, CMPLX(0, q));
}
