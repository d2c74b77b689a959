#include "dgreen/operator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const mpfr_prec_t dg_ladder[DG_LADDER] = {127, 191, 255};

static void set_doubles(dg_track *t)
{
    const cv_params *p = &t->exact;
    t->mu_s = cv_number_get_double(&p->mu_s);
    t->mu_b = cv_number_get_double(&p->mu_b);
    t->kappa_p = cv_number_get_double(&p->kappa_p);
    t->kappa_b = cv_number_get_double(&p->kappa_b);
    t->eta_p = cv_number_get_double(&p->eta_p);
    t->eta_b = cv_number_get_double(&p->eta_b);
    t->eta_f = cv_number_get_double(&p->eta_f);
    t->eta_s = cv_number_get_double(&p->eta_s);
    t->eta_N = cv_number_get_double(&p->eta_N);
}

static void list(const cv_number *source[DG_PARAMETERS], const dg_track *t)
{
    const cv_params *p = &t->exact;
    const cv_number *each[DG_PARAMETERS] = {&p->mu_s,  &p->mu_b,  &p->kappa_p, &p->kappa_b, &p->eta_p,
                                            &p->eta_b, &p->eta_f, &p->eta_s,   &p->eta_N};
    memcpy(source, each, sizeof each);
}

void dg_constants_init(dg_constants *c, const dg_track *t, mpfr_prec_t precision)
{
    const cv_number *source[DG_PARAMETERS];
    list(source, t);
    for (int i = 0; i < DG_PARAMETERS; i++) {
        mpfr_init2(c->value[i], precision);
        cv_number_get_mpfr(c->value[i], source[i]);
    }
}

void dg_constants_clear(dg_constants *c)
{
    for (int i = 0; i < DG_PARAMETERS; i++)
        mpfr_clear(c->value[i]);
}

/* x = hi + lo to 106 bits */
static dg_dd twofold(const cv_number *x)
{
    mpfr_t exact, rest;
    mpfr_init2(exact, 2 * 53 + 8);
    mpfr_init2(rest, 53);
    cv_number_get_mpfr(exact, x);
    const double hi = mpfr_get_d(exact, MPFR_RNDN);
    mpfr_sub_d(rest, exact, hi, MPFR_RNDN);
    const dg_dd both = {hi, mpfr_get_d(rest, MPFR_RNDN)};
    mpfr_clears(exact, rest, (mpfr_ptr)NULL);
    return both;
}

cv_status dg_track_new(dg_track **out, const cv_params *p, cv_message *why)
{
    dg_track *t = calloc(1, sizeof *t);
    *out = t;
    if (t == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_params_init(&t->exact);
    cv_params_set(&t->exact, p);
    set_doubles(t);
    t->damped = !cv_params_undamped(p);
    const cv_number *source[DG_PARAMETERS];
    list(source, t);
    for (int i = 0; i < DG_PARAMETERS; i++)
        t->twofold[i] = twofold(source[i]);
    for (int i = 0; i < DG_LADDER; i++)
        dg_constants_init(&t->ladder[i], t, dg_ladder[i]);
    return CV_OK;
}

void dg_track_free(dg_track *t)
{
    if (t == NULL)
        return;
    for (int i = 0; i < DG_LADDER; i++)
        dg_constants_clear(&t->ladder[i]);
    cv_params_clear(&t->exact);
    free(t);
}

/* A polynomial in y with the sizes of the parts of its coefficients; the degree is known where it is used. */
typedef struct {
    double re[DG_DEGREE + 1], im[DG_DEGREE + 1], size_re[DG_DEGREE + 1], size_im[DG_DEGREE + 1];
} polynomial;

/* sum += factor * a * b */
static inline void add_product(polynomial *sum, double factor, const polynomial *a, int degree_a,
                               const polynomial *b, int degree_b)
{
    for (int i = 0; i <= degree_a; i++) {
        const double re = factor * a->re[i], im = factor * a->im[i];
        const double size_re = factor * a->size_re[i], size_im = factor * a->size_im[i];
        for (int j = 0; j <= degree_b; j++) {
            sum->re[i + j] += re * b->re[j] - im * b->im[j];
            sum->im[i + j] += re * b->im[j] + im * b->re[j];
            sum->size_re[i + j] += size_re * b->size_re[j] + size_im * b->size_im[j];
            sum->size_im[i + j] += size_re * b->size_im[j] + size_im * b->size_re[j];
        }
    }
}

static inline void add(polynomial *sum, const polynomial *a, int degree)
{
    for (int i = 0; i <= degree; i++) {
        sum->re[i] += a->re[i];
        sum->im[i] += a->im[i];
        sum->size_re[i] += a->size_re[i];
        sum->size_im[i] += a->size_im[i];
    }
}

/* A term of coefficient k, with its size */
static inline void add_term(polynomial *sum, int k, double re, double im)
{
    sum->re[k] += re;
    sum->im[k] += im;
    sum->size_re[k] += fabs(re);
    sum->size_im[k] += fabs(im);
}

/* s = i (w - alpha y), w = -i qbar */
typedef struct {
    double alpha, w_re, w_im;
} shift;

/* sum += factor * s^2 */
static inline void add_square(polynomial *sum, double factor, const shift *s)
{
    add_term(sum, 0, -factor * s->w_re * s->w_re, -2 * factor * s->w_re * s->w_im);
    add_term(sum, 0, factor * s->w_im * s->w_im, 0);
    add_term(sum, 1, 2 * factor * s->alpha * s->w_re, 2 * factor * s->alpha * s->w_im);
    add_term(sum, 2, -factor * s->alpha * s->alpha, 0);
}

/* sum += 2 eta s + kappa */
static inline void add_spring(polynomial *sum, double eta, double kappa, const shift *s)
{
    add_term(sum, 0, kappa, 0);
    add_term(sum, 0, -2 * eta * s->w_im, 2 * eta * s->w_re);
    add_term(sum, 1, 0, -2 * eta * s->alpha);
}

static void set_beam(polynomial *a, const dg_track *t, const shift *s)
{
    add_square(a, 4, s);
    add_term(a, 2, -4 * t->eta_N, 0);
    add_term(a, 4, 1, 0);
}

static void set_foundation(polynomial *f, const dg_track *t, const shift *s)
{
    add_spring(f, t->eta_f, 1, s);
    add_square(f, t->mu_b, s);
    add_term(f, 2, t->eta_s, 0);
}

static void store(dg_operator *op, const polynomial *delta, const polynomial *r)
{
    memcpy(op->re, delta->re, sizeof op->re);
    memcpy(op->im, delta->im, sizeof op->im);
    memcpy(op->size_re, delta->size_re, sizeof op->size_re);
    memcpy(op->size_im, delta->size_im, sizeof op->size_im);
    memcpy(op->r_re, r->re, sizeof op->r_re);
    memcpy(op->r_im, r->im, sizeof op->r_im);
    memcpy(op->r_size_re, r->size_re, sizeof op->r_size_re);
    memcpy(op->r_size_im, r->size_im, sizeof op->r_size_im);
    for (int k = 0; k <= DG_DEGREE; k++)
        op->size[k] = op->size_re[k] + op->size_im[k];
    for (int k = 0; k <= DG_R_DEGREE; k++)
        op->r_size[k] = op->r_size_re[k] + op->r_size_im[k];
}

void dg_operator_set(dg_operator *op, const dg_track *t, double alpha, double complex qbar)
{
    const shift s = {alpha, cimag(qbar), -creal(qbar)};
    polynomial beam = {0}, pad = {0}, sleeper = {0}, ballast = {0}, foundation = {0};
    set_beam(&beam, t, &s);
    add_spring(&pad, t->eta_p, t->kappa_p, &s);
    add_square(&sleeper, t->mu_s, &s);
    add_spring(&ballast, t->eta_b, t->kappa_b, &s);
    set_foundation(&foundation, t, &s);

    polynomial c = foundation, inner = {0}, r, delta = {0};
    add(&c, &ballast, 1);
    add_product(&inner, 1, &sleeper, 2, &c, 2);
    add_product(&inner, 1, &ballast, 1, &foundation, 2);
    r = inner;
    add_product(&r, 1, &pad, 1, &c, 2);
    add_product(&delta, 4, &pad, 1, &inner, 4);
    add_product(&delta, 1, &beam, 4, &r, 4);
    store(op, &delta, &r);
    const double inertia = alpha * alpha * t->mu_b;
    op->degree = alpha > 0 ? DG_DEGREE : t->eta_s > 0 ? 6 : 4;
    op->relative_a0 = alpha > 0 ? (inertia - t->eta_s) / (inertia + t->eta_s) : -1;
}

int dg_operator_count_fits(const dg_operator *op, int right, int left)
{
    static const double ROUNDING = 1e-14;
    if (op->degree < DG_DEGREE)
        return right == op->degree / 2;
    if (right + left < DG_DEGREE)
        return right == 5;
    if (!(fabs(op->relative_a0) > ROUNDING))
        return right == 5 || right == 6;
    return right == (op->relative_a0 > 0 ? 6 : 5);
}
