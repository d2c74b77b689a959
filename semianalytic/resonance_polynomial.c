#include "semianalytic/resonance_polynomial.h"

/* c + slope x + ... from numbers: to += number * factor * x^power */
static void add_term(sa_polynomial *to, const cv_number *number, long factor, int power)
{
    sa_interval t;

    sa_interval_init(&t, mpfr_get_prec(to->coefficient[0].low));
    sa_interval_set_number(&t, number);
    sa_interval_mul_si(&t, &t, factor);
    sa_interval_add(&to->coefficient[power], &to->coefficient[power], &t);
    if (power > to->degree) {
        to->degree = power;
    }
    sa_interval_clear(&t);
}

static void add_one(sa_polynomial *to, int power, long shift)
{
    sa_interval t;

    sa_interval_init(&t, mpfr_get_prec(to->coefficient[0].low));
    sa_interval_set_si(&t, 1);
    sa_interval_shift(&t, &t, shift);
    sa_interval_add(&to->coefficient[power], &to->coefficient[power], &t);
    if (power > to->degree) {
        to->degree = power;
    }
    sa_interval_clear(&t);
}

/* The pieces of the determinant: rail = x^2/4 - eta_N x, ground = 1 + eta_s x, e[0] = k22 k33 - kappa_b^2
 * without its cancellation, e[1] = mu_s k33 + mu_b k22, e[2] = mu_s mu_b, with the entries k of K. */
typedef struct {
    sa_polynomial rail, ground, e[3], kp, kb, mu_b, t;
} pieces;

static void pieces_set(pieces *w, const cv_params *p)
{
    add_one(&w->rail, 2, -2);
    add_term(&w->rail, &p->eta_N, -1, 1);
    add_one(&w->ground, 0, 0);
    add_term(&w->ground, &p->eta_s, 1, 1);
    add_term(&w->kp, &p->kappa_p, 1, 0);
    add_term(&w->kb, &p->kappa_b, 1, 0);
    add_term(&w->mu_b, &p->mu_b, 1, 0);
    /* e0 = kappa_p kappa_b + (kappa_p + kappa_b) ground */
    sa_polynomial_add(&w->t, &w->kp, &w->kb);
    sa_polynomial_mul(&w->e[0], &w->t, &w->ground);
    sa_polynomial_mul(&w->e[1], &w->t, &w->mu_b);
    sa_polynomial_mul(&w->t, &w->kp, &w->kb);
    sa_polynomial_add(&w->e[0], &w->e[0], &w->t);
    /* e1 = mu_b (kappa_p + kappa_b) + mu_s (kappa_b + ground) */
    add_term(&w->e[2], &p->mu_s, 1, 0);
    sa_polynomial_add(&w->t, &w->kb, &w->ground);
    sa_polynomial_mul(&w->t, &w->t, &w->e[2]);
    sa_polynomial_add(&w->e[1], &w->e[1], &w->t);
    sa_polynomial_mul(&w->e[2], &w->e[2], &w->mu_b);
}

/* With A = rail + kappa_p: f0 = rail e0 + kappa_p kappa_b ground, f1 = -(e0 + A e1) + kappa_p^2 mu_b,
 * f2 = e1 + A e2, f3 = -e2. */
static void pieces_expand(sa_characteristic *c, pieces *w)
{
    sa_polynomial_mul(&c->f[0], &w->rail, &w->e[0]);
    sa_polynomial_mul(&w->t, &w->kp, &w->kb);
    sa_polynomial_mul(&w->t, &w->t, &w->ground);
    sa_polynomial_add(&c->f[0], &c->f[0], &w->t);

    sa_polynomial_mul(&c->f[1], &w->kp, &w->kp);
    sa_polynomial_mul(&c->f[1], &c->f[1], &w->mu_b);
    sa_polynomial_sub(&c->f[1], &c->f[1], &w->e[0]);
    sa_polynomial_add(&w->rail, &w->rail, &w->kp);
    sa_polynomial_mul(&w->t, &w->rail, &w->e[1]);
    sa_polynomial_sub(&c->f[1], &c->f[1], &w->t);

    sa_polynomial_mul(&c->f[2], &w->rail, &w->e[2]);
    sa_polynomial_add(&c->f[2], &c->f[2], &w->e[1]);
    sa_polynomial_sub(&c->f[3], &c->f[3], &w->e[2]);
}

void sa_characteristic_init(sa_characteristic *c, const cv_params *params, mpfr_prec_t precision)
{
    pieces w;
    sa_polynomial *all[] = {&w.rail, &w.ground, &w.e[0], &w.e[1], &w.e[2], &w.kp, &w.kb, &w.mu_b, &w.t};

    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        sa_polynomial_init(all[i], precision);
    }
    for (int a = 0; a < 4; a++) {
        sa_polynomial_init(&c->f[a], precision);
    }
    pieces_set(&w, params);
    pieces_expand(c, &w);
    for (int a = 0; a < 4; a++) {
        sa_polynomial_trim(&c->f[a]);
    }
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        sa_polynomial_clear(all[i]);
    }
}

void sa_characteristic_clear(sa_characteristic *c)
{
    for (int a = 0; a < 4; a++) {
        sa_polynomial_clear(&c->f[a]);
    }
}

/* f_a h_b - f_b h_a, where H = sum h_b L^b, h_b = x f_b' + (b - 3) f_b. Term by term, so that what cancels
 * identically is exactly zero: the coefficients are ((j + b) - (i + a)) f_ai f_bj. */
static void bezout(sa_polynomial *to, const sa_characteristic *c, int a, int b)
{
    const sa_polynomial *fa = &c->f[a], *fb = &c->f[b];
    sa_interval t;

    sa_interval_init(&t, mpfr_get_prec(to->coefficient[0].low));
    for (int i = 0; i <= fa->degree; i++) {
        for (int j = 0; j <= fb->degree; j++) {
            sa_interval_mul(&t, &fa->coefficient[i], &fb->coefficient[j]);
            sa_interval_mul_si(&t, &t, (j + b) - (i + a));
            sa_interval_add(&to->coefficient[i + j], &to->coefficient[i + j], &t);
        }
    }
    to->degree = fa->degree + fb->degree;
    sa_polynomial_trim(to);
    sa_interval_clear(&t);
}

/* Determinant of the symmetric 3 x 3 Bezout matrix [[b10, b20, b30], [b20, b30 + b21, b31], [b30, b31, b32]].
 */
void sa_characteristic_resultant(sa_polynomial *resultant, const sa_characteristic *c)
{
    enum { B10, B20, B30, B11, B31, B32, T, U, COUNT };
    sa_polynomial m[COUNT];

    for (int i = 0; i < COUNT; i++) {
        sa_polynomial_init(&m[i], mpfr_get_prec(resultant->coefficient[0].low));
    }
    bezout(&m[B10], c, 1, 0);
    bezout(&m[B20], c, 2, 0);
    bezout(&m[B30], c, 3, 0);
    bezout(&m[B11], c, 2, 1);
    bezout(&m[B31], c, 3, 1);
    bezout(&m[B32], c, 3, 2);
    sa_polynomial_add(&m[B11], &m[B11], &m[B30]);

    sa_polynomial_mul(&m[T], &m[B11], &m[B32]);
    sa_polynomial_mul(&m[U], &m[B31], &m[B31]);
    sa_polynomial_sub(&m[T], &m[T], &m[U]);
    sa_polynomial_mul(resultant, &m[B10], &m[T]);
    sa_polynomial_mul(&m[T], &m[B20], &m[B32]);
    sa_polynomial_mul(&m[U], &m[B31], &m[B30]);
    sa_polynomial_sub(&m[T], &m[T], &m[U]);
    sa_polynomial_mul(&m[T], &m[T], &m[B20]);
    sa_polynomial_sub(resultant, resultant, &m[T]);
    sa_polynomial_mul(&m[T], &m[B20], &m[B31]);
    sa_polynomial_mul(&m[U], &m[B11], &m[B30]);
    sa_polynomial_sub(&m[T], &m[T], &m[U]);
    sa_polynomial_mul(&m[T], &m[T], &m[B30]);
    sa_polynomial_add(resultant, resultant, &m[T]);
    sa_polynomial_trim(resultant);
    for (int i = 0; i < COUNT; i++) {
        sa_polynomial_clear(&m[i]);
    }
}

void sa_characteristic_cubic(sa_polynomial *cubic, const sa_characteristic *c, const sa_interval *x)
{
    cubic->degree = 3;
    for (int a = 0; a < 4; a++) {
        sa_polynomial_at(&cubic->coefficient[a], &c->f[a], x);
    }
}

void sa_characteristic_euler(sa_interval *value, const sa_characteristic *c, const sa_interval *x,
                             const sa_interval *L)
{
    sa_polynomial cubic, weighted;

    sa_polynomial_init(&cubic, mpfr_get_prec(value->low));
    sa_polynomial_init(&weighted, mpfr_get_prec(value->low));
    cubic.degree = 3;
    for (int a = 0; a < 4; a++) {
        sa_polynomial_set(&weighted, &c->f[a]);
        for (int i = 0; i <= weighted.degree; i++) {
            sa_interval_mul_si(&weighted.coefficient[i], &weighted.coefficient[i], i + a);
        }
        sa_polynomial_at(&cubic.coefficient[a], &weighted, x);
    }
    sa_polynomial_at(value, &cubic, L);
    sa_polynomial_clear(&cubic);
    sa_polynomial_clear(&weighted);
}
