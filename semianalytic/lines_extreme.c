#include <math.h>

#include "semianalytic/lines_parts.h"

/* Newton's iteration in (alpha, q) on
 *
 *     Im zeta = 0  and  e = 0,   e = d Im zeta / dq                      where alpha turns,
 *                                e = Re_alpha Im_q - Re_q Im_alpha       where Re zeta is extreme,
 *
 * with derivatives by differences in MPFR: next to a branch curve the line may turn within less than doubles
 * resolve, and gradients of zeta are parallel to many digits. That does not matter to an iteration in both
 * coordinates, which is the same in any others that depend on them linearly. */
enum { VALUE, BY_ALPHA, BY_Q, BY_ALPHA2, BY_ALPHA_Q, BY_Q2, DERIVATIVES };

typedef struct {
    const sa_line_store *store;
    int of_alpha;
    mpfr_t x[2], h[2], step[2], at[2], error[2]; /* alpha, q; error: of the two parts of zeta */
    mpfr_t re[DERIVATIVES], im[DERIVATIVES];
    mpfr_t e[3]; /* value, derivatives by alpha and q */
    mpfr_t det, scratch;
    mpc_t zeta;
} newton;

static void newton_init(newton *n, mpfr_prec_t bits)
{
    for (int i = 0; i < 2; ++i)
        mpfr_inits2(bits, n->x[i], n->h[i], n->step[i], n->at[i], n->error[i], (mpfr_ptr)0);
    for (int i = 0; i < DERIVATIVES; ++i)
        mpfr_inits2(bits, n->re[i], n->im[i], (mpfr_ptr)0);
    mpfr_inits2(bits, n->e[0], n->e[1], n->e[2], n->det, n->scratch, (mpfr_ptr)0);
    mpc_init2(n->zeta, bits);
}

static void newton_clear(newton *n)
{
    for (int i = 0; i < 2; ++i)
        mpfr_clears(n->x[i], n->h[i], n->step[i], n->at[i], n->error[i], (mpfr_ptr)0);
    for (int i = 0; i < DERIVATIVES; ++i)
        mpfr_clears(n->re[i], n->im[i], (mpfr_ptr)0);
    mpfr_clears(n->e[0], n->e[1], n->e[2], n->det, n->scratch, (mpfr_ptr)0);
    mpc_clear(n->zeta);
}

/* zeta at x + (i h_alpha, k h_q), into its place among the derivatives for now */
static cv_status evaluate(newton *n, int i, int k, int place)
{
    const sa_line_store *store = n->store;
    const int by[2] = {i, k};
    for (int c = 0; c < 2; ++c) {
        mpfr_mul_si(n->at[c], n->h[c], by[c], MPFR_RNDN);
        mpfr_add(n->at[c], n->at[c], n->x[c], MPFR_RNDN);
    }
    if (mpfr_sgn(n->at[0]) <= 0 || mpfr_sgn(n->at[1]) <= 0)
        return CV_UNDECIDED;
    cv_status status =
        sa_zeta_mp(n->zeta, n->error[0], n->error[1], store->sweep, store->track, n->at[0], n->at[1]);
    mpfr_set(n->re[place], mpc_realref(n->zeta), MPFR_RNDN);
    mpfr_set(n->im[place], mpc_imagref(n->zeta), MPFR_RNDN);
    return status;
}

/* From f at x, x + h (first), x - h (second): first and second derivative in their places */
static void central(mpfr_t first, mpfr_t second, const mpfr_t f, const mpfr_t h, mpfr_t scratch)
{
    mpfr_sub(scratch, first, second, MPFR_RNDN);
    mpfr_add(second, first, second, MPFR_RNDN);
    mpfr_div(first, scratch, h, MPFR_RNDN);
    mpfr_div_2ui(first, first, 1, MPFR_RNDN);
    mpfr_mul_2ui(scratch, f, 1, MPFR_RNDN);
    mpfr_sub(second, second, scratch, MPFR_RNDN);
    mpfr_div(second, second, h, MPFR_RNDN);
    mpfr_div(second, second, h, MPFR_RNDN);
}

/* (f(+, +) - f(+, 0) - f(0, +) + f) / (h k), before the others become derivatives */
static void mixed(mpfr_t f[DERIVATIVES], const newton *n)
{
    mpfr_sub(f[BY_ALPHA_Q], f[BY_ALPHA_Q], f[BY_ALPHA], MPFR_RNDN);
    mpfr_sub(f[BY_ALPHA_Q], f[BY_ALPHA_Q], f[BY_Q], MPFR_RNDN);
    mpfr_add(f[BY_ALPHA_Q], f[BY_ALPHA_Q], f[VALUE], MPFR_RNDN);
    mpfr_div(f[BY_ALPHA_Q], f[BY_ALPHA_Q], n->h[0], MPFR_RNDN);
    mpfr_div(f[BY_ALPHA_Q], f[BY_ALPHA_Q], n->h[1], MPFR_RNDN);
}

/* Differences over a quarter of the bits leave as many right in second derivatives. */
static cv_status differentiate(newton *n)
{
    static const int at[DERIVATIVES][2] = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {1, 1}, {0, -1}};
    cv_status status = CV_OK;
    for (int c = 0; c < 2; ++c)
        mpfr_div_2ui(n->h[c], n->x[c], (unsigned long)mpfr_get_prec(n->x[c]) / 4, MPFR_RNDN);
    for (int i = 0; i < DERIVATIVES && status == CV_OK; ++i)
        status = evaluate(n, at[i][0], at[i][1], i);
    for (int part = 0; part < 2 && status == CV_OK; ++part) {
        mpfr_t *f = part == 0 ? n->re : n->im;
        mixed(f, n);
        central(f[BY_ALPHA], f[BY_ALPHA2], f[VALUE], n->h[0], n->scratch);
        central(f[BY_Q], f[BY_Q2], f[VALUE], n->h[1], n->scratch);
    }
    return status;
}

/* out = a b - c d */
static void cross(mpfr_t out, const mpfr_t a, const mpfr_t b, const mpfr_t c, const mpfr_t d)
{
    mpfr_fmms(out, a, b, c, d, MPFR_RNDN);
}

static void set_e(newton *n)
{
    static const int second[2][2] = {{BY_ALPHA2, BY_ALPHA_Q}, {BY_ALPHA_Q, BY_Q2}};
    if (n->of_alpha) {
        mpfr_set(n->e[0], n->im[BY_Q], MPFR_RNDN);
        mpfr_set(n->e[1], n->im[BY_ALPHA_Q], MPFR_RNDN);
        mpfr_set(n->e[2], n->im[BY_Q2], MPFR_RNDN);
        return;
    }
    cross(n->e[0], n->re[BY_ALPHA], n->im[BY_Q], n->re[BY_Q], n->im[BY_ALPHA]);
    for (int c = 0; c < 2; ++c) {
        cross(n->scratch, n->re[second[c][0]], n->im[BY_Q], n->re[second[c][1]], n->im[BY_ALPHA]);
        cross(n->e[1 + c], n->re[BY_ALPHA], n->im[second[c][1]], n->re[BY_Q], n->im[second[c][0]]);
        mpfr_add(n->e[1 + c], n->e[1 + c], n->scratch, MPFR_RNDN);
    }
}

/* x moves by a Newton step. *change: of what is extreme by that, to first order, relative. */
static cv_status move(newton *n, double *change)
{
    cv_status status = differentiate(n);
    if (status != CV_OK)
        return status;
    set_e(n);
    cross(n->det, n->im[BY_ALPHA], n->e[2], n->im[BY_Q], n->e[1]);
    cross(n->step[0], n->im[VALUE], n->e[2], n->im[BY_Q], n->e[0]);
    cross(n->step[1], n->im[BY_ALPHA], n->e[0], n->im[VALUE], n->e[1]);
    for (int c = 0; c < 2; ++c) {
        mpfr_div(n->step[c], n->step[c], n->det, MPFR_RNDN);
        mpfr_sub(n->x[c], n->x[c], n->step[c], MPFR_RNDN);
        if (!mpfr_number_p(n->x[c]) || mpfr_sgn(n->x[c]) <= 0)
            return CV_UNDECIDED;
    }
    if (n->of_alpha) {
        mpfr_div(n->scratch, n->step[0], n->x[0], MPFR_RNDN);
    } else {
        mpfr_fmma(n->scratch, n->re[BY_ALPHA], n->step[0], n->re[BY_Q], n->step[1], MPFR_RNDN);
        mpfr_div(n->scratch, n->scratch, n->re[VALUE], MPFR_RNDN);
    }
    *change = fabs(mpfr_get_d(n->scratch, MPFR_RNDA));
    return isfinite(*change) ? CV_OK : CV_UNDECIDED;
}

/* Until a step changes what is extreme by less than the tolerance, which the next would square. */
static cv_status iterate(newton *n, const sa_line_sample *from, double tolerance, double *change)
{
    enum { STEPS = 40 };
    mpfr_set_d(n->x[0], from->alpha, MPFR_RNDN);
    mpfr_set_d(n->x[1], from->q, MPFR_RNDN);
    *change = INFINITY;
    cv_status status = CV_OK;
    for (int i = 0; i < STEPS && status == CV_OK && !(*change < tolerance); ++i)
        status = move(n, change);
    return status == CV_OK && !(*change < tolerance) ? CV_UNDECIDED : status;
}

/* Of alpha as a function of q: -Im_qq / Im_alpha */
static int bend_of(const newton *n)
{
    return mpfr_sgn(n->im[BY_Q2]) * mpfr_sgn(n->im[BY_ALPHA]) > 0 ? -1 : 1;
}

/* x as a vertex: q, or the coordinate best given, is exact */
static cv_status vertex_at(sa_line_vertex *out, newton *n, const sa_line_sample *sample, int digits)
{
    int rises;
    const sa_line_given which = n->of_alpha ? SA_GIVEN_Q : sa_line_best_given(sample);
    const int given = which == SA_GIVEN_Q;
    return sa_line_point_from(out, &rises, n->store->sweep, n->store->track, which, n->x[given], n->x[!given],
                              digits);
}

cv_status sa_line_extreme(sa_line_vertex *out, int *bend, const sa_line_store *store,
                          const sa_line_sample *sample, int digits)
{
    const mpfr_prec_t guard = 320;
    newton n = {.store = store, .of_alpha = (sample->marks & SA_MARK_TURN) != 0};
    double change;
    newton_init(&n, digits * 10L / 3 + guard);
    const cv_status found = iterate(&n, sample, pow(10, -digits - 2), &change);
    if (found != CV_OK) { /* the vertex is the sample, undecided */
        mpfr_set_d(n.x[0], sample->alpha, MPFR_RNDN);
        mpfr_set_d(n.x[1], sample->q, MPFR_RNDN);
    }
    cv_status status = vertex_at(out, &n, sample, digits);
    if (status == CV_OK && found != CV_OK)
        out->decided = CV_UNDECIDED;
    const double size = mpfr_get_d(n.of_alpha ? out->alpha : out->eta_M, MPFR_RNDA);
    out->marks = sample->marks & (SA_MARK_LEAST_MASS | SA_MARK_MOST_MASS | SA_MARK_TURN);
    out->value_error = change * size + (n.of_alpha ? out->alpha_error : out->eta_M_error);
    if (bend != NULL)
        *bend = bend_of(&n);
    newton_clear(&n);
    return found == CV_FAILED ? found : status;
}
