#include "semianalytic/interval.h"

static mpfr_prec_t precision_of(const sa_polynomial *p)
{
    return mpfr_get_prec(p->coefficient[0].low);
}

void sa_polynomial_init(sa_polynomial *p, mpfr_prec_t precision)
{
    p->degree = 0;
    for (int i = 0; i <= SA_POLYNOMIAL_DEGREE; i++) {
        sa_interval_init(&p->coefficient[i], precision);
    }
}

void sa_polynomial_clear(sa_polynomial *p)
{
    for (int i = 0; i <= SA_POLYNOMIAL_DEGREE; i++) {
        sa_interval_clear(&p->coefficient[i]);
    }
}

void sa_polynomial_set(sa_polynomial *to, const sa_polynomial *p)
{
    to->degree = p->degree;
    for (int i = 0; i <= SA_POLYNOMIAL_DEGREE; i++) {
        sa_interval_set(&to->coefficient[i], &p->coefficient[i]);
    }
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

/* coefficients above the degree are always 0 */
void sa_polynomial_add(sa_polynomial *to, const sa_polynomial *a, const sa_polynomial *b)
{
    for (int i = 0; i <= SA_POLYNOMIAL_DEGREE; i++) {
        sa_interval_add(&to->coefficient[i], &a->coefficient[i], &b->coefficient[i]);
    }
    to->degree = larger(a->degree, b->degree);
}

void sa_polynomial_sub(sa_polynomial *to, const sa_polynomial *a, const sa_polynomial *b)
{
    for (int i = 0; i <= SA_POLYNOMIAL_DEGREE; i++) {
        sa_interval_sub(&to->coefficient[i], &a->coefficient[i], &b->coefficient[i]);
    }
    to->degree = larger(a->degree, b->degree);
}

void sa_polynomial_mul(sa_polynomial *to, const sa_polynomial *a, const sa_polynomial *b)
{
    sa_polynomial product;
    sa_interval t;

    sa_polynomial_init(&product, precision_of(to));
    sa_interval_init(&t, precision_of(to));
    product.degree = a->degree + b->degree;
    for (int i = 0; i <= a->degree; i++) {
        for (int j = 0; j <= b->degree; j++) {
            sa_interval_mul(&t, &a->coefficient[i], &b->coefficient[j]);
            sa_interval_add(&product.coefficient[i + j], &product.coefficient[i + j], &t);
        }
    }
    sa_polynomial_set(to, &product);
    sa_interval_clear(&t);
    sa_polynomial_clear(&product);
}

void sa_polynomial_trim(sa_polynomial *p)
{
    while (p->degree > 0 && sa_interval_sign(&p->coefficient[p->degree]) == 0) {
        p->degree--;
    }
}

void sa_polynomial_at(sa_interval *value, const sa_polynomial *p, const sa_interval *x)
{
    sa_interval sum;

    sa_interval_init(&sum, precision_of(p));
    for (int i = p->degree; i >= 0; i--) {
        sa_interval_mul(&sum, &sum, x);
        sa_interval_add(&sum, &sum, &p->coefficient[i]);
    }
    sa_interval_set(value, &sum);
    sa_interval_clear(&sum);
}

void sa_polynomial_variations(int *least, int *most, const sa_polynomial *p)
{
    int known = 0;                 /* last sign that can be told */
    int reach[2] = {-1000, -1000}; /* most changes so far when the last sign is taken as -, + */

    *least = 0;
    for (int i = 0; i <= p->degree; i++) {
        int sign = sa_interval_sign(&p->coefficient[i]);
        if (sign == 0) {
            continue;
        }
        int before[2] = {reach[0], reach[1]};
        if (sign != 1) {
            reach[0] = larger(larger(before[0], before[1] + 1), 0);
        }
        if (sign != -1) {
            reach[1] = larger(larger(before[1], before[0] + 1), 0);
        }
        if (sign != 2) {
            *least += known != 0 && sign != known;
            known = sign;
        }
    }
    *most = larger(larger(reach[0], reach[1]), 0);
}

/* p(x + 1), by Horner's triangle */
static void shift_by_one(sa_polynomial *p)
{
    for (int i = 0; i < p->degree; i++) {
        for (int j = p->degree - 1; j >= i; j--) {
            sa_interval_add(&p->coefficient[j], &p->coefficient[j], &p->coefficient[j + 1]);
        }
    }
}

static void scale_argument(sa_polynomial *p, const sa_interval *factor)
{
    sa_interval power;

    sa_interval_init(&power, precision_of(p));
    sa_interval_set_si(&power, 1);
    for (int i = 1; i <= p->degree; i++) {
        sa_interval_mul(&power, &power, factor);
        sa_interval_mul(&p->coefficient[i], &p->coefficient[i], &power);
    }
    sa_interval_clear(&power);
}

static void reverse(sa_polynomial *p)
{
    for (int i = 0; 2 * i < p->degree; i++) {
        mpfr_swap(p->coefficient[i].low, p->coefficient[p->degree - i].low);
        mpfr_swap(p->coefficient[i].high, p->coefficient[p->degree - i].high);
    }
}

/* x = low + width y, y = 1/(1 + t) */
void sa_polynomial_restrict(sa_polynomial *to, const sa_polynomial *p, const mpfr_t low, const mpfr_t high)
{
    sa_interval step, width;

    sa_interval_init(&step, precision_of(to));
    sa_interval_init(&width, precision_of(to));
    sa_polynomial_set(to, p);
    sa_interval_set_mpfr(&step, low);
    sa_interval_set_mpfr(&width, high);
    sa_interval_sub(&width, &width, &step);
    if (mpfr_sgn(low) != 0) { /* p(low + low u) = p(low (1 + u)), then u = (width/low) y */
        scale_argument(to, &step);
        shift_by_one(to);
        mpfr_div(step.low, width.low, low, MPFR_RNDD);
        mpfr_div(step.high, width.high, low, MPFR_RNDU);
        sa_interval_set(&width, &step);
    }
    scale_argument(to, &width);
    reverse(to);      /* y = 1/z, z in (1, inf) */
    shift_by_one(to); /* z = 1 + t */
    sa_interval_clear(&step);
    sa_interval_clear(&width);
}
