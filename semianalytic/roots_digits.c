#include "semianalytic/roots_digits.h"

#include <math.h>

#include "semianalytic/poles_box.h"

typedef struct {
    const sa_rough_root *rough;
    const cv_number *mass_ratio;
    double complex start[SA_POLES_MAX]; /* the poles that make K, at the rough root */
    int count;
    sa_pole_set set;
    sa_box q, f, part;
    sa_span mass;
} newton;

static void newton_init(newton *n, const sa_track *t, const cv_number *alpha, mpfr_prec_t precision)
{
    cv_number zero;
    cv_number_init(&zero);
    sa_pole_set_init(&n->set, t, precision);
    sa_place_set(&n->set.place, t, alpha, &zero);
    cv_number_clear(&zero);
    sa_box_init(&n->q, precision);
    sa_box_init(&n->f, precision);
    sa_box_init(&n->part, precision);
    sa_span_init(&n->mass, precision);
    sa_span_set_number(&n->mass, n->mass_ratio);
    mpc_set_d_d(n->q.m, creal(n->rough->q), cimag(n->rough->q), MPC_RNDNN);
}

static void newton_clear(newton *n)
{
    sa_pole_set_clear(&n->set);
    sa_box_clear(&n->q);
    sa_box_clear(&n->f);
    sa_box_clear(&n->part);
    sa_span_clear(&n->mass);
}

/* f = 1 - eta_M zeta at q, zeta = i q^2 (sum of the residues). The sides of the poles do not matter: which
 * ones to take is known. */
static int evaluate(newton *n)
{
    sa_span_set(&n->set.place.q, mpc_realref(n->q.m));
    sa_span_set(&n->set.place.q_im, mpc_imagref(n->q.m));
    sa_pole_set_find(&n->set, n->start, n->count, 0, 0);
    if (n->set.count != n->count)
        return 0;
    sa_box_zero(&n->f);
    for (int i = 0; i < n->count; i++)
        sa_box_add(&n->f, &n->f, &n->set.poles[i].residue);
    sa_box_sqr(&n->part, &n->q);
    sa_box_mul(&n->f, &n->f, &n->part);
    sa_box_times_i(&n->f, &n->f);
    sa_box_scale(&n->f, &n->f, &n->mass);
    sa_box_neg(&n->f, &n->f);
    sa_box_add_real(&n->f, &n->f, &n->set.place.one);
    return 1;
}

/* 2 |f| / |slope|: the distance to the root, with room for a slope that is wrong by less than a half over
 * that distance; it is right to 1e-10 or so at its start. */
static long double bound(const newton *n)
{
    long double size = sa_magnitude(mpc_realref(n->f.m)) + sa_magnitude(mpc_imagref(n->f.m));
    return 2 * (size + n->f.re_rad + n->f.im_rad) * SA_BOX_INFLATE / (long double)cabs(n->rough->f_q);
}

static void take_step(newton *n)
{
    const double complex inverse = -1 / n->rough->f_q;
    mpc_set_d_d(n->part.m, creal(inverse), cimag(inverse), MPC_RNDNN);
    mpc_mul(n->part.m, n->part.m, n->f.m, MPC_RNDNN);
    mpc_add(n->q.m, n->q.m, n->part.m, MPC_RNDNN);
    if (creal(n->rough->q) == 0)
        mpfr_set_zero(mpc_realref(n->q.m), 1);
}

static int good_enough(long double error, const mpc_t q, int digits)
{
    const long double share = powl(10, -digits - 1);
    long double re = fabsl(mpfr_get_ld(mpc_realref(q), MPFR_RNDN));
    long double im = fabsl(mpfr_get_ld(mpc_imagref(q), MPFR_RNDN));
    return (mpfr_zero_p(mpc_realref(q)) || error <= share * re) && error <= share * im;
}

/* Steps as long as they pay. */
static int converge(newton *n, long double *error, int digits)
{
    enum { STEPS_MAX = 200 };
    long double last = INFINITY;
    for (int i = 0; i < STEPS_MAX; i++) {
        if (!evaluate(n))
            return 0;
        *error = bound(n);
        if (good_enough(*error, n->q.m, digits))
            return 1;
        if (!(*error < last))
            return 0;
        last = *error;
        take_step(n);
    }
    return 0;
}

/* qbar = i q */
static void hand_over(sa_root *out, const newton *n, long double error)
{
    mpfr_set_prec(out->re, mpc_get_prec(n->q.m));
    mpfr_set_prec(out->im, mpc_get_prec(n->q.m));
    mpfr_neg(out->re, mpc_imagref(n->q.m), MPFR_RNDN);
    mpfr_set(out->im, mpc_realref(n->q.m), MPFR_RNDN);
    out->error = fmin((double)error * (1 + 0x1p-40), 1e300);
}

cv_status sa_root_polish(sa_root *out, const sa_rough_root *rough, const sa_track *t, const cv_number *alpha,
                         const cv_number *mass_ratio, int digits)
{
    enum { GUARD = 64, ATTEMPTS = 4 };
    newton n = {.rough = rough, .mass_ratio = mass_ratio};
    sa_sheet sheet;
    cv_status status = sa_sheet_at(&sheet, t, cv_number_get_double(alpha), rough->q);
    mpfr_inits2(64, out->re, out->im, (mpfr_ptr)0);
    mpfr_set_d(out->re, -cimag(rough->q), MPFR_RNDN);
    mpfr_set_d(out->im, creal(rough->q), MPFR_RNDN);
    out->qbar = CMPLX(-cimag(rough->q), creal(rough->q));
    out->slope = rough->f_q;
    out->error = 1e-9 * cabs(rough->q);
    out->decided = CV_UNDECIDED;
    if (status != CV_OK)
        return status == CV_FAILED ? CV_FAILED : CV_OK;
    for (int i = 0; i < sheet.count; i++)
        if (sheet.upper[i])
            n.start[n.count++] = sheet.p[i];
    mpfr_prec_t precision = (mpfr_prec_t)(digits * 10 / 3) + GUARD;
    for (int i = 0; i < ATTEMPTS && out->decided != CV_OK; i++, precision += precision / 2 + GUARD) {
        long double error = INFINITY;
        newton_init(&n, t, alpha, precision);
        if (converge(&n, &error, digits)) {
            hand_over(out, &n, error);
            out->decided = CV_OK;
        }
        newton_clear(&n);
    }
    return CV_OK;
}

void sa_root_clear(sa_root *root)
{
    mpfr_clear(root->re);
    mpfr_clear(root->im);
}
