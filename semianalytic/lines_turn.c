#include <math.h>
#include <string.h>

#include "semianalytic/lines_parts.h"

/* Whether the turning point is the one next to the sample: no farther than from there to its neighbours, with
 * room for samples at uneven distances. */
static int belongs(const sa_line_vertex *v, const sa_line_sample *a, const sa_line_sample *s,
                   const sa_line_sample *b)
{
    const double room = 4, clear = 3;
    const double d_alpha = fmax(fabs(s->alpha - a->alpha), fabs(b->alpha - s->alpha));
    const double d_q = fmax(fabs(s->q - a->q), fabs(b->q - s->q));
    const double excess = mpfr_get_d(v->eta_M, MPFR_RNDN) * s->re;
    return fabs(mpfr_get_d(v->alpha, MPFR_RNDN) - s->alpha) <= room * d_alpha &&
           fabs(mpfr_get_d(v->q, MPFR_RNDN) - s->q) <= room * d_q && excess < clear && excess * clear > 1;
}

static void set_turn(sa_line_sample *s, const sa_line_vertex *v)
{
    mpfr_t rest;
    mpfr_init2(rest, 53);
    s->alpha = mpfr_get_d(v->alpha, MPFR_RNDN);
    s->q = mpfr_get_d(v->q, MPFR_RNDN);
    s->re = 1 / mpfr_get_d(v->eta_M, MPFR_RNDN);
    s->im_q = 0;
    s->marks = SA_MARK_TURN;
    s->turn = SA_TURN_SETTLED;
    mpfr_sub_d(rest, v->alpha, s->alpha, MPFR_RNDN);
    s->alpha_rest = mpfr_get_d(rest, MPFR_RNDN);
    s->alpha_error = v->value_error + 1e-15 * fabs(s->alpha_rest);
    mpfr_clear(rest);
}

static void remove_sample(sa_line *line, sa_line_sample *s, size_t k)
{
    memmove(&s[k], &s[k + 1], (line->count - k - 1) * sizeof *s);
    --line->count;
}

/* Samples next to turn k that are beyond it: their alpha was found in double. */
static void remove_beyond(sa_line *line, sa_line_sample *s, size_t k, int bend)
{
    const size_t least = 4;
    for (int side = -1; side <= 1; side += 2)
        while (line->count > least) {
            const size_t n = line->count, next = side < 0 ? (k + n - 1) % n : (k + 1) % n;
            const int outside = !line->closed && (side < 0 ? k == 0 : k + 1 == n);
            if (outside || s[next].turn == SA_TURN_SETTLED || (s[next].alpha - s[k].alpha) * bend > 0)
                break;
            remove_sample(line, s, next);
            k -= next < k;
        }
}

cv_status sa_line_settle_turn(const sa_line_store *store, sa_line *line, size_t k)
{
    enum { DIGITS = 24 };
    sa_line_sample *s = &store->samples.item[line->first], near = s[k];
    const size_t n = line->count;
    sa_line_vertex v;
    int bend;
    near.marks = SA_MARK_TURN;
    cv_status status = sa_line_extreme(&v, &bend, store, &near, DIGITS);
    s[k].turn = SA_TURN_UNSETTLED;
    if (status == CV_OK && (v.decided != CV_OK || !belongs(&v, &s[(k + n - 1) % n], &s[k], &s[(k + 1) % n])))
        status = CV_UNDECIDED;
    if (status == CV_OK) {
        set_turn(&s[k], &v);
        remove_beyond(line, s, k, bend);
    }
    sa_line_vertex_clear(&v);
    return status;
}
