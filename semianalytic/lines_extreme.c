#include <math.h>

#include "semianalytic/lines_parts.h"

/* Three points of the line at x - h, x, x + h of the coordinate that is given; y is what is extreme. */
typedef struct {
    const sa_line_store *store;
    sa_line_given which;
    int of_alpha, digits;
    double start, slope; /* the other coordinate at x, and how it changes with x */
    mpfr_t x, h, shift, y[3], bend, scratch;
} parabola;

static void parabola_init(parabola *p, mpfr_prec_t bits)
{
    mpfr_inits2(bits, p->x, p->h, p->shift, p->bend, p->scratch, p->y[0], p->y[1], p->y[2], (mpfr_ptr)0);
}

static void parabola_clear(parabola *p)
{
    mpfr_clears(p->x, p->h, p->shift, p->bend, p->scratch, p->y[0], p->y[1], p->y[2], (mpfr_ptr)0);
}

static cv_status point_at(sa_line_vertex *out, parabola *p, int side)
{
    int rises;
    mpfr_mul_si(p->scratch, p->h, side, MPFR_RNDN);
    mpfr_add(p->scratch, p->scratch, p->x, MPFR_RNDN);
    double start = p->start + side * p->slope * mpfr_get_d(p->h, MPFR_RNDN);
    cv_status status =
        sa_line_point(out, &rises, p->store->sweep, p->store->track, p->which, p->scratch, start, p->digits);
    return status == CV_OK && out->decided != CV_OK ? CV_UNDECIDED : status;
}

/* shift to the extreme of the parabola. CV_UNDECIDED: there is none within reach. */
static cv_status fit(parabola *p)
{
    for (int side = -1; side <= 1; ++side) {
        sa_line_vertex v;
        cv_status status = point_at(&v, p, side);
        if (status == CV_OK)
            mpfr_set(p->y[side + 1], p->of_alpha ? v.alpha : v.eta_M, MPFR_RNDN);
        if (side == 0 && status == CV_OK)
            p->start = mpfr_get_d(p->which == SA_GIVEN_ALPHA ? v.q : v.alpha, MPFR_RNDN);
        sa_line_vertex_clear(&v);
        if (status != CV_OK)
            return status;
    }
    /* shift = h (y0 - y2) / (2 (y0 - 2 y1 + y2)) */
    mpfr_add(p->bend, p->y[0], p->y[2], MPFR_RNDN);
    mpfr_mul_2ui(p->scratch, p->y[1], 1, MPFR_RNDN);
    mpfr_sub(p->bend, p->bend, p->scratch, MPFR_RNDN);
    mpfr_sub(p->shift, p->y[0], p->y[2], MPFR_RNDN);
    mpfr_mul(p->shift, p->shift, p->h, MPFR_RNDN);
    mpfr_div(p->shift, p->shift, p->bend, MPFR_RNDN);
    mpfr_div_2ui(p->shift, p->shift, 1, MPFR_RNDN);
    return mpfr_number_p(p->shift) ? CV_OK : CV_UNDECIDED;
}

/* What moving by the last shift changed: bend / 2 (shift / h)^2 */
static double last_change(parabola *p)
{
    mpfr_div(p->scratch, p->shift, p->h, MPFR_RNDN);
    mpfr_sqr(p->scratch, p->scratch, MPFR_RNDN);
    mpfr_mul(p->scratch, p->scratch, p->bend, MPFR_RNDN);
    return fabs(mpfr_get_d(p->scratch, MPFR_RNDA)) / 2;
}

/* x moves by the shift, at most by twice h. 1: it was less than h. */
static int move(parabola *p)
{
    int within = mpfr_cmpabs(p->shift, p->h) < 0;
    mpfr_mul_2ui(p->scratch, p->h, 1, MPFR_RNDN);
    if (mpfr_cmpabs(p->shift, p->scratch) > 0)
        mpfr_copysign(p->shift, p->scratch, p->shift, MPFR_RNDN);
    mpfr_add(p->x, p->x, p->shift, MPFR_RNDN);
    p->start += p->slope * mpfr_get_d(p->shift, MPFR_RNDN);
    return within;
}

/* Parabolas ever narrower: each leaves about the square of its width, relative to the scale of the line. */
static cv_status approach(parabola *p, double scale, double tolerance, double *left)
{
    enum { STEPS = 60 };
    const double widest = 1e-2;
    double width = widest;
    for (int i = 0, narrowed = 0; i < STEPS; ++i) {
        mpfr_set_d(p->h, scale * width, MPFR_RNDN);
        cv_status status = fit(p);
        if (status == CV_FAILED)
            return status;
        if (status != CV_OK) {
            scale /= 8; /* the line bends too much over this width */
            continue;
        }
        if (!move(p)) {
            width = fmin(8 * width, widest);
            continue;
        }
        *left = last_change(p);
        if (narrowed++ && *left < tolerance)
            return CV_OK;
        width = fmax(width * width, sqrt(tolerance) * 1e-2);
    }
    return CV_UNDECIDED;
}

/* At a turning point alpha is the extreme and q runs through. */
static void choose(parabola *p, double *x, double *scale, const sa_line_sample *s)
{
    p->of_alpha = (s->marks & SA_MARK_TURN) != 0;
    p->which = p->of_alpha ? SA_GIVEN_Q : sa_line_best_given(s);
    int q_runs = p->which == SA_GIVEN_Q;
    double before = q_runs ? s[-1].q : s[-1].alpha, after = q_runs ? s[1].q : s[1].alpha;
    *x = q_runs ? s->q : s->alpha;
    p->start = q_runs ? s->alpha : s->q;
    p->slope = q_runs ? -s->im_q / s->im_alpha : -s->im_alpha / s->im_q;
    *scale = fmin(fabs(after - *x), fabs(*x - before));
    if (!(*scale > 1e-9 * fabs(after - before)))
        *scale = fabs(after - before);
}

cv_status sa_line_extreme(sa_line_vertex *out, const sa_line_store *store, const sa_line_sample *sample,
                          int digits)
{
    parabola p = {.store = store, .digits = 2 * digits + 10};
    double x, scale, left = INFINITY;
    choose(&p, &x, &scale, sample);
    double size = p.of_alpha ? sample->alpha : 1 / sample->re;
    parabola_init(&p, 4 * p.digits + 64);
    mpfr_set_d(p.x, x, MPFR_RNDN);
    cv_status status = approach(&p, scale, pow(10, -digits) * size, &left);
    out->marks = sample->marks & (SA_MARK_LEAST_MASS | SA_MARK_MOST_MASS | SA_MARK_TURN);
    out->value_error = left;
    if (status == CV_OK) {
        sa_line_vertex better;
        mpfr_set_zero(p.h, 1);
        status = point_at(&better, &p, 0);
        if (status == CV_OK) {
            better.marks = out->marks;
            better.value_error = left + (p.of_alpha ? better.alpha_error : better.eta_M_error);
            sa_line_vertex_clear(out);
            *out = better;
        } else {
            sa_line_vertex_clear(&better);
        }
    }
    if (status == CV_UNDECIDED)
        out->decided = CV_UNDECIDED;
    parabola_clear(&p);
    return status == CV_FAILED ? status : CV_OK;
}
