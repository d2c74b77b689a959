#include "semianalytic/resonances.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "semianalytic/dispersion.h"
#include "semianalytic/resonance_polynomial.h"

/* Bits of the first attempt beyond twice those promised; guard bits between what is computed and what is
 * promised; how often the precision is doubled before two roots count as merging. */
enum { FIRST_PRECISION = 256, GUARD = 24, DOUBLINGS = 3 };

/* Everything that one attempt at a precision works with. */
typedef struct {
    mpfr_prec_t precision;
    long bits; /* relative accuracy wanted of x = p^2: enough for neighbours that the precision can isolate */
    sa_characteristic characteristic;
    sa_polynomial resultant;
} attempt;

static void attempt_init(attempt *a, const cv_params *params, mpfr_prec_t precision, long bits)
{
    a->precision = precision;
    a->bits = bits;
    sa_characteristic_init(&a->characteristic, params, precision);
    sa_polynomial_init(&a->resultant, precision);
    sa_characteristic_resultant(&a->resultant, &a->characteristic);
}

static void attempt_clear(attempt *a)
{
    sa_polynomial_clear(&a->resultant);
    sa_characteristic_clear(&a->characteristic);
}

static void middle(mpfr_t to, const sa_interval *x)
{
    mpfr_add(to, x->low, x->high, MPFR_RNDN);
    mpfr_div_2ui(to, to, 1, MPFR_RNDN);
}

/* Encloses the three L_k over all of x: they are the positive roots of a cubic with interval coefficients.
 * The enclosures widen until the width of x allows them. */
static int enclose(sa_interval L[SA_BRANCHES], const attempt *a, const sa_interval *x)
{
    sa_polynomial cubic;
    sa_root_place *place = NULL;
    size_t count = 0;

    sa_polynomial_init(&cubic, a->precision);
    sa_characteristic_cubic(&cubic, &a->characteristic, x);
    int done = sa_polynomial_positive_roots(&place, &count, &cubic) == CV_OK && count == SA_BRANCHES;
    for (int k = 0; k < SA_BRANCHES && done; k++) {
        done = 0;
        for (long bits = a->bits; bits > a->bits / 4 && !done; bits -= 4) {
            done = sa_polynomial_refine(&L[k], &cubic, &place[k], bits);
        }
    }
    sa_root_places_free(place, count);
    sa_polynomial_clear(&cubic);
    return done;
}

/* The branch that is stationary somewhere in x, -1 when the precision cannot tell: there is exactly one root
 * of the resultant in x, so when two branches are proved not to be stationary it is the third. */
static int stationary_branch(const sa_interval L[SA_BRANCHES], const attempt *a, const sa_interval *x)
{
    int branch = -1, candidates = 0;
    sa_interval euler;

    sa_interval_init(&euler, a->precision);
    for (int k = 0; k < SA_BRANCHES; k++) {
        sa_characteristic_euler(&euler, &a->characteristic, x, &L[k]);
        if (sa_interval_sign(&euler) == 2) {
            candidates++;
            branch = k;
        }
    }
    sa_interval_clear(&euler);
    return candidates == 1 ? branch : -1;
}

/* Bits that the ends of a positive interval share with its middle. */
static long shared_bits(const mpfr_t low, const mpfr_t high)
{
    mpfr_t width;
    long bits;

    mpfr_init2(width, 64);
    mpfr_sub(width, high, low, MPFR_RNDU);
    if (mpfr_zero_p(width)) {
        bits = (long)mpfr_get_prec(low) - 1;
    } else {
        mpfr_div(width, width, low, MPFR_RNDU);
        bits = -(long)mpfr_get_exp(width);
    }
    mpfr_clear(width);
    return bits;
}

/* p = sqrt(x), alpha = sqrt(L / x) over the enclosures. */
static void fill(sa_resonance *r, const attempt *a, const sa_interval *x, const sa_interval *L)
{
    sa_interval t;

    sa_interval_init(&t, a->precision);
    mpfr_inits2(a->precision, r->alpha, r->p, (mpfr_ptr)0);
    mpfr_sqrt(t.low, x->low, MPFR_RNDD);
    mpfr_sqrt(t.high, x->high, MPFR_RNDU);
    middle(r->p, &t);
    r->bits = shared_bits(t.low, t.high);
    mpfr_div(t.low, L->low, x->high, MPFR_RNDD);
    mpfr_div(t.high, L->high, x->low, MPFR_RNDU);
    mpfr_sqrt(t.low, t.low, MPFR_RNDD);
    mpfr_sqrt(t.high, t.high, MPFR_RNDU);
    middle(r->alpha, &t);
    long bits = shared_bits(t.low, t.high);
    if (bits < r->bits) {
        r->bits = bits;
    }
    sa_interval_clear(&t);
}

/* A place with one certain root, or (merging) one that stays undecided, where x is the place itself.
 * 1 filled, 0 the precision does not suffice. */
static int fill_place(sa_resonance *r, const attempt *a, const sa_root_place *place, int merging)
{
    sa_interval x, L[SA_BRANCHES];
    int done = 1;

    sa_interval_init(&x, a->precision);
    for (int k = 0; k < SA_BRANCHES; k++) {
        sa_interval_init(&L[k], a->precision);
    }
    if (merging) {
        mpfr_set(x.low, place->low, MPFR_RNDD);
        mpfr_set(x.high, place->high, MPFR_RNDU);
        r->kind = SA_RESONANCE_MERGING;
    } else {
        done = sa_polynomial_refine(&x, &a->resultant, place, a->bits);
    }
    r->k = done && enclose(L, a, &x) ? stationary_branch(L, a, &x) : -1;
    if (r->k >= 0) {
        fill(r, a, &x, &L[r->k]);
    }
    sa_interval_clear(&x);
    for (int k = 0; k < SA_BRANCHES; k++) {
        sa_interval_clear(&L[k]);
    }
    return r->k >= 0;
}

/* From p = 0, where the phase velocity is infinite, minima and maxima alternate along a branch. The items are
 * still in the order of p. */
static void set_kinds(sa_resonance_list *list)
{
    int before[SA_BRANCHES] = {0};

    for (size_t i = 0; i < list->count; i++) {
        sa_resonance *r = &list->item[i];
        if (r->kind != SA_RESONANCE_MERGING) {
            r->kind = before[r->k]++ % 2 ? SA_RESONANCE_FALSE : SA_RESONANCE_TRUE;
        }
    }
}

static int by_alpha(const void *left, const void *right)
{
    const sa_resonance *a = left, *b = right;

    return mpfr_cmp(a->alpha, b->alpha);
}

/* CV_UNDECIDED: try again with more precision. "last": undecided places become SA_RESONANCE_MERGING. */
static cv_status run(sa_resonance_list *out, const attempt *a, long promised, int last)
{
    sa_root_place *place;
    size_t count;
    cv_status status = sa_polynomial_positive_roots(&place, &count, &a->resultant);

    if (status != CV_OK) {
        return last ? CV_FAILED : CV_UNDECIDED;
    }
    out->item = calloc(count + 1, sizeof *out->item);
    status = out->item ? CV_OK : CV_FAILED;
    for (size_t i = 0; i < count && status == CV_OK; i++) {
        sa_resonance *r = &out->item[out->count];
        int merging = place[i].least != 1 || place[i].most != 1;
        status = (!merging || last) && fill_place(r, a, &place[i], merging) ? CV_OK : CV_UNDECIDED;
        out->count += status == CV_OK;
        if (status == CV_OK && r->bits < promised && r->kind != SA_RESONANCE_MERGING) {
            status = CV_UNDECIDED;
        }
    }
    sa_root_places_free(place, count);
    if (status != CV_OK) {
        sa_resonances_clear(out);
        return status;
    }
    set_kinds(out);
    qsort(out->item, out->count, sizeof *out->item, by_alpha);
    return CV_OK;
}

cv_status sa_resonances(sa_resonance_list *out, const cv_params *params, int digits, cv_message *why)
{
    long promised = (long)ceil(digits * log2(10)) + 8;
    mpfr_prec_t precision = FIRST_PRECISION + 2 * promised;
    cv_status status = CV_UNDECIDED;

    *out = (sa_resonance_list){.count = 0};
    for (int doubling = 0; doubling <= DOUBLINGS && status == CV_UNDECIDED; doubling++) {
        attempt a;
        attempt_init(&a, params, precision << doubling, (promised + GUARD) << doubling);
        status = run(out, &a, promised, doubling == DOUBLINGS);
        attempt_clear(&a);
    }
    return status == CV_OK ? CV_OK : cv_fail(why, CV_FAILED, "the resonance velocities cannot be isolated");
}

void sa_resonances_clear(sa_resonance_list *list)
{
    for (size_t i = 0; i < list->count; i++) {
        mpfr_clear(list->item[i].alpha);
        mpfr_clear(list->item[i].p);
    }
    free(list->item);
    *list = (sa_resonance_list){.count = 0};
}

const char *sa_resonance_kind_text(sa_resonance_kind kind)
{
    static const char *const text[] = {"true", "false", "merging"};

    return text[kind];
}
