#include "dgreen/operator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/lanes.h"

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

/* A polynomial in y with the sizes of the parts of its coefficients. Coefficient k is element ZEROS + k,
 * behind ZEROS zeros, so that loops for vector instructions can run over all coefficients of a product. */
enum { ZEROS = 4, WIDTH = 8 };
typedef struct {
    double re[ZEROS + WIDTH], im[ZEROS + WIDTH], size_re[ZEROS + WIDTH], size_im[ZEROS + WIDTH];
} polynomial;

/* sum += factor * a * b, as far as the degree is below WIDTH; degree_a <= ZEROS */
DG_PART void add_product(polynomial *restrict sum, double factor, const polynomial *restrict a, int degree_a,
                         const polynomial *restrict b)
{
    for (int i = 0; i <= degree_a; i++) {
        const double re = factor * a->re[ZEROS + i], im = factor * a->im[ZEROS + i];
        const double size_re = factor * a->size_re[ZEROS + i], size_im = factor * a->size_im[ZEROS + i];
        for (int k = ZEROS; k < ZEROS + WIDTH; k++) {
            sum->re[k] += re * b->re[k - i] - im * b->im[k - i];
            sum->im[k] += re * b->im[k - i] + im * b->re[k - i];
            sum->size_re[k] += size_re * b->size_re[k - i] + size_im * b->size_im[k - i];
            sum->size_im[k] += size_re * b->size_im[k - i] + size_im * b->size_re[k - i];
        }
    }
}

DG_PART void add(polynomial *sum, const polynomial *a)
{
    for (int k = ZEROS; k < ZEROS + WIDTH; k++) {
        sum->re[k] += a->re[k];
        sum->im[k] += a->im[k];
        sum->size_re[k] += a->size_re[k];
        sum->size_im[k] += a->size_im[k];
    }
}

/* A term of coefficient k, with its size */
DG_PART void add_term(polynomial *sum, int k, double re, double im)
{
    sum->re[ZEROS + k] += re;
    sum->im[ZEROS + k] += im;
    sum->size_re[ZEROS + k] += fabs(re);
    sum->size_im[ZEROS + k] += fabs(im);
}

/* s = i (w - alpha y), w = -i qbar */
typedef struct {
    double alpha, w_re, w_im;
} shift;

/* sum += factor * s^2 */
DG_PART void add_square(polynomial *sum, double factor, const shift *s)
{
    add_term(sum, 0, -factor * s->w_re * s->w_re, -2 * factor * s->w_re * s->w_im);
    add_term(sum, 0, factor * s->w_im * s->w_im, 0);
    add_term(sum, 1, 2 * factor * s->alpha * s->w_re, 2 * factor * s->alpha * s->w_im);
    add_term(sum, 2, -factor * s->alpha * s->alpha, 0);
}

/* sum += 2 eta s + kappa */
DG_PART void add_spring(polynomial *sum, double eta, double kappa, const shift *s)
{
    add_term(sum, 0, kappa, 0);
    add_term(sum, 0, -2 * eta * s->w_im, 2 * eta * s->w_re);
    add_term(sum, 1, 0, -2 * eta * s->alpha);
}

DG_PART void set_beam(polynomial *a, const dg_track *t, const shift *s)
{
    add_square(a, 4, s);
    add_term(a, 2, -4 * t->eta_N, 0);
    add_term(a, 4, 1, 0);
}

DG_PART void set_foundation(polynomial *f, const dg_track *t, const shift *s)
{
    add_spring(f, t->eta_f, 1, s);
    add_square(f, t->mu_b, s);
    add_term(f, 2, t->eta_s, 0);
}

/* The leading coefficient of Delta is that of R, for that of A is 1 and of degree 4. */
DG_PART void store(dg_operator *op, const polynomial *delta, const polynomial *r)
{
    for (int k = 0; k < DG_DEGREE; k++) {
        op->re[k] = delta->re[ZEROS + k];
        op->im[k] = delta->im[ZEROS + k];
        op->size_re[k] = delta->size_re[ZEROS + k];
        op->size_im[k] = delta->size_im[ZEROS + k];
    }
    for (int k = 0; k <= DG_R_DEGREE; k++) {
        op->r_re[k] = r->re[ZEROS + k];
        op->r_im[k] = r->im[ZEROS + k];
        op->r_size_re[k] = r->size_re[ZEROS + k];
        op->r_size_im[k] = r->size_im[ZEROS + k];
        op->r_size[k] = op->r_size_re[k] + op->r_size_im[k];
    }
    op->re[DG_DEGREE] = op->r_re[DG_R_DEGREE];
    op->im[DG_DEGREE] = op->r_im[DG_R_DEGREE];
    op->size_re[DG_DEGREE] = op->r_size_re[DG_R_DEGREE];
    op->size_im[DG_DEGREE] = op->r_size_im[DG_R_DEGREE];
    for (int k = 0; k <= DG_DEGREE; k++)
        op->size[k] = op->size_re[k] + op->size_im[k];
}

DG_CLONES void dg_operator_set(dg_operator *op, const dg_track *t, double alpha, double complex qbar)
{
    const shift s = {alpha, cimag(qbar), -creal(qbar)};
    polynomial beam = {0}, pad = {0}, sleeper = {0}, ballast = {0}, foundation = {0};
    set_beam(&beam, t, &s);
    add_spring(&pad, t->eta_p, t->kappa_p, &s);
    add_square(&sleeper, t->mu_s, &s);
    add_spring(&ballast, t->eta_b, t->kappa_b, &s);
    set_foundation(&foundation, t, &s);

    polynomial c = foundation, inner = {0}, r, delta = {0};
    add(&c, &ballast);
    add_product(&inner, 1, &sleeper, 2, &c);
    add_product(&inner, 1, &ballast, 1, &foundation);
    r = inner;
    add_product(&r, 1, &pad, 1, &c);
    add_product(&delta, 4, &pad, 1, &inner);
    add_product(&delta, 1, &beam, 4, &r);
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
