/* Two manufactured "methods" with known instability lines, which can be spoilt one fault at a time.
 * The truth, for 0.25 <= alpha <= 1.25 and 1 <= eta_M <= 1000:
 *   line 0   alpha = 1/2 + q, eta_M = 1/(4 q), down from its asymptote; more roots at larger alpha
 *   line 1   alpha = 3/4 + q, eta_M = 1/(4 q), up to its asymptote; fewer roots at larger alpha
 *   line 2   closed: alpha = 1.125 + sqrt(1/256 - (q - 5/16)^2), both signs, eta_M = 2^(5 + 32 (q - 5/16));
 * two more roots inside */
#ifndef CRITVEL_TESTS_FAKE_LINES_H
#define CRITVEL_TESTS_FAKE_LINES_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/lines_run.h"

enum { FAKE_LINES = 3, FAKE_BITS = 160, FAKE_STEPS = 160 };

/* What a fake does wrong; all zero: nothing. */
typedef struct {
    int drop;            /* 1 + line that is not listed */
    int drop_from_count; /* 1 + line that the count does not know */
    int move;            /* 1 + line that is displaced, points and vertices alike */
    double by;           /* relative, of the coordinate that is not given */
    int only_q;          /* 1: that is q, where alpha is given */
    int unbounded;       /* points have no bounds */
    int loose;           /* 1 + line whose vertices alone are displaced by that */
    double bound;        /* stated relative bound; 0: 1e-24 */
    int no_bounds;       /* vertices without bounds, as from double precision */
    int reverse;         /* 1 + line that runs the other way */
    int end;             /* 1 + line whose first end is called the lowest velocity */
    int zero_mass;       /* 1 + line of which the first end is said to run to zero mass */
    double asymptote;    /* added to the asymptotes */
    double asymptote_q;  /* their frequency */
    int open;            /* nothing is claimed beyond the greatest mass */
    double least;        /* relative, of the least masses */
    int bend;            /* 1 + line with one turning point more */
    int nan;             /* 1 + line with a vertex that is not a number */
    int half;            /* 1 + line of which the second half is missing */
    int blind;           /* points are undecided */
    unsigned blind_in;   /* the count is undecided at one point in so many */
    int undecided;       /* the list says so */
    cv_status find;      /* returned by find */
} line_faults;

static line_faults fake_line[CMP_METHODS];

static void fake_set_error(double *error, mpfr_srcptr x, double bound)
{
    *error = bound * fabs(mpfr_get_d(x, MPFR_RNDN));
}

/* x +- sqrt(1/256 - (other - center)^2) for the closed line; the sign that is nearer to start. */
static void fake_circle(mpfr_ptr x, double middle, mpfr_srcptr other, double center, double start)
{
    mpfr_sub_d(x, other, center, MPFR_RNDN);
    mpfr_sqr(x, x, MPFR_RNDN);
    mpfr_d_sub(x, 1.0 / 256, x, MPFR_RNDN);
    mpfr_sqrt(x, x, MPFR_RNDN);
    if (start < middle)
        mpfr_neg(x, x, MPFR_RNDN);
    mpfr_add_d(x, x, middle, MPFR_RNDN);
}

/* The point of a line at the given coordinate. */
static void fake_on_line(cmp_line_point *out, int line, int by_q, mpfr_srcptr given, double start)
{
    mpfr_ptr free_one = by_q ? out->alpha : out->q, fixed = by_q ? out->q : out->alpha;
    mpfr_set_prec(out->alpha, FAKE_BITS);
    mpfr_set_prec(out->q, FAKE_BITS);
    mpfr_set_prec(out->eta_M, FAKE_BITS);
    mpfr_set(fixed, given, MPFR_RNDN);
    if (line == 2)
        fake_circle(free_one, by_q ? 1.125 : 0.3125, given, by_q ? 0.3125 : 1.125, start);
    else
        mpfr_add_d(free_one, given, (by_q ? 1 : -1) * (line == 0 ? 0.5 : 0.75), MPFR_RNDN);
}

static void fake_mass(cmp_line_point *p, int line)
{
    if (line == 2) {
        mpfr_sub_d(p->eta_M, p->q, 0.3125, MPFR_RNDN);
        mpfr_mul_ui(p->eta_M, p->eta_M, 32, MPFR_RNDN);
        mpfr_add_ui(p->eta_M, p->eta_M, 5, MPFR_RNDN);
        mpfr_exp2(p->eta_M, p->eta_M, MPFR_RNDN);
    } else {
        mpfr_mul_ui(p->eta_M, p->q, 4, MPFR_RNDN);
        mpfr_ui_div(p->eta_M, 1, p->eta_M, MPFR_RNDN);
    }
}

static void fake_displace(mpfr_ptr x, double by)
{
    mpfr_t share;
    mpfr_init2(share, FAKE_BITS);
    mpfr_set_d(share, by, MPFR_RNDN);
    mpfr_fma(x, x, share, x, MPFR_RNDN);
    mpfr_clear(share);
}

static void fake_make(cmp_line_point *out, const line_faults *f, int line, int by_q, mpfr_srcptr given,
                      double start)
{
    const double bound = f->bound > 0 ? f->bound : 1e-24;
    out->decided = CV_OK;
    fake_on_line(out, line, by_q, given, start);
    fake_mass(out, line);
    if (f->move == line + 1 && !(f->only_q && by_q))
        fake_displace(by_q ? out->alpha : out->q, f->by);
    fake_set_error(&out->alpha_error, out->alpha, by_q ? bound : 0);
    fake_set_error(&out->q_error, out->q, by_q ? 0 : bound);
    fake_set_error(&out->eta_M_error, out->eta_M, bound);
    if (f->unbounded)
        *(by_q ? &out->alpha_error : &out->q_error) = out->eta_M_error = (double)NAN;
}

/* Coordinate and where the other one is about, of vertex i of n. */
static int fake_vertex_at(mpfr_ptr given, double *start, int line, int i)
{
    const double pi = acos(-1.0), part = (double)i / FAKE_STEPS, angle = 2 * pi * part;
    const int by_q = line < 2 || fabs(cos(angle)) > 0.7;
    double alpha = 1.125 + cos(angle) / 16, q = 0.3125 + sin(angle) / 16;
    if (line == 2 && i % FAKE_STEPS == 0)
        q = 0.3125;
    if (line < 2)
        q = 0.25 * pow(1000, -(line == 0 ? 1 - part : part));
    mpfr_set_d(given, by_q ? q : alpha, MPFR_RNDN);
    *start = by_q ? alpha : q;
    return by_q;
}

static void fake_vertices(cmp_branch *b, const line_faults *f, int line)
{
    mpfr_t given;
    mpfr_init2(given, 53);
    const int last = f->half == line + 1 ? FAKE_STEPS / 2 : FAKE_STEPS;
    for (int k = 0; k <= last; k++) {
        double start;
        const int i = f->reverse == line + 1 ? FAKE_STEPS - k : k;
        const int by_q = fake_vertex_at(given, &start, line, i);
        cmp_line_point *v = cmp_branch_append(b);
        if (v == NULL)
            abort();
        fake_make(v, f, line, by_q, given, start);
        v->turns = line == 2 && i % (FAKE_STEPS / 2) == 0;
        if (f->loose == line + 1)
            fake_displace(by_q ? v->alpha : v->q, f->by);
        if (f->no_bounds)
            v->alpha_error = v->q_error = v->eta_M_error = (double)NAN;
        if (f->nan == line + 1 && k == last / 3)
            mpfr_set_nan(v->eta_M);
        if (f->bend == line + 1 && k == last / 3)
            v->turns = 1;
    }
    mpfr_clear(given);
}

static void fake_branch(cmp_branches *out, const line_faults *f, int line)
{
    cmp_branch *b = cmp_branches_append(out);
    if (b == NULL)
        abort();
    fake_vertices(b, f, line);
    const cmp_line_end closed = {CMP_END_CLOSED, (double)NAN, (double)NAN, 0, 0, 0},
                       bottom = {CMP_END_MASS_LOW, (double)NAN, (double)NAN, 0, 0, 0},
                       top = {CMP_END_MASS_HIGH,
                              (line == 0 ? 0.5 : 0.75) + f->asymptote,
                              1e-16,
                              f->asymptote_q,
                              f->open,
                              0};
    b->ends[0] = line == 2 ? closed : line == 0 ? top : bottom;
    b->ends[1] = line == 2 ? closed : line == 0 ? bottom : top;
    b->ends[0].zero_mass = f->zero_mass == line + 1;
    if (f->end == line + 1)
        b->ends[0] = (cmp_line_end){CMP_END_ALPHA_LOW, (double)NAN, (double)NAN, 0, 0, 0};
    b->least_mass = (line == 2 ? 8 : 1) * (1 + f->least);
    b->least_mass_error = 1e-12;
}

static cv_status fake_lines_find(void *handle, cmp_branches *out, int digits, cv_message *why)
{
    const line_faults *f = handle;
    (void)digits;
    if (f->find != CV_OK)
        return cv_fail(why, f->find, "the fake was told to fail");
    for (int line = 0; line < FAKE_LINES; line++)
        if (f->drop != line + 1)
            fake_branch(out, f, line);
    if (f->undecided)
        out->status = cv_fail(&out->why, CV_UNDECIDED, "the fake has its doubts");
    return CV_OK;
}

static cv_status fake_line_point(void *handle, cmp_line_point *out, int by_q, mpfr_srcptr given,
                                 mpfr_srcptr from, double reach, int digits, cv_message *why)
{
    const double start = mpfr_get_d(from, MPFR_RNDN);
    const line_faults *f = handle;
    (void)digits;
    for (int line = 0; line < FAKE_LINES && !f->blind; line++) {
        fake_make(out, f, line, by_q, given, start);
        if (mpfr_cmp_d(out->eta_M, 0.9) > 0 && /* lines 0 and 1 end there: further on they would meet 2 */
            fabs(mpfr_get_d(by_q ? out->alpha : out->q, MPFR_RNDN) - start) <= reach)
            return CV_OK;
    }
    return cv_fail(why, out->decided = CV_UNDECIDED, "no line there");
}

static int fake_roots(const line_faults *f, double alpha, double mass)
{
    const double q = 0.3125 + (log2(mass) - 5) / 32;
    int n = 0;
    n += f->drop_from_count != 1 && alpha > 0.5 + 0.25 / mass ? 2 : 0;
    n -= f->drop_from_count != 2 && alpha > 0.75 + 0.25 / mass ? 2 : 0;
    n += f->drop_from_count != 3 && hypot(alpha - 1.125, q - 0.3125) < 1.0 / 16 ? 2 : 0;
    return n;
}

static cv_status fake_lines_count(void *handle, int *roots, cv_status *decided, double alpha,
                                  size_t mass_count, const double *mass_ratios, cv_message *why)
{
    const line_faults *f = handle;
    (void)why;
    for (size_t i = 0; i < mass_count; i++) {
        roots[i] = fake_roots(f, alpha, mass_ratios[i]);
        decided[i] = CV_OK;
        if (f->blind_in > 0 && (unsigned)(1e6 * fmod(1e3 * alpha + mass_ratios[i], 1)) % f->blind_in == 0)
            decided[i] = CV_UNDECIDED;
    }
    return CV_OK;
}

static cv_status fake_lines_open_first(void **handle, const cv_params *track, const cv_number *const range[4],
                                       cv_message *why)
{
    (void)track, (void)range, (void)why;
    *handle = &fake_line[0];
    return CV_OK;
}

static cv_status fake_lines_open_second(void **handle, const cv_params *track,
                                        const cv_number *const range[4], cv_message *why)
{
    (void)track, (void)range, (void)why;
    *handle = &fake_line[1];
    return CV_OK;
}

static void fake_lines_close(void *handle)
{
    (void)handle;
}

static const cmp_line_method FAKE_LINES_FIRST = {"semianalytic",  fake_lines_open_first, fake_lines_close,
                                                 fake_lines_find, fake_line_point,       fake_lines_count};
static const cmp_line_method FAKE_LINES_SECOND = {"dgreen",        fake_lines_open_second, fake_lines_close,
                                                  fake_lines_find, fake_line_point,        fake_lines_count};

#endif
