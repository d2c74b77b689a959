#include "semianalytic/kernel.h"

#include <math.h>

#include "common/casefile.h"
#include "semianalytic/kernel_box.h"

enum { BITS_BEYOND_DIGITS_MAX = 4096 };

/* What is asked for, and what has been found. */
typedef struct {
    const sa_track *track;
    const cv_number *alpha, *q, *xi;
    long double tolerance; /* relative, of each part */
    double complex start[SA_STARTS_MAX];
    int starts;
} request;

static int part_known(const mpfr_t mid, long double radius, long double tolerance)
{
    return radius == 0 || radius * SA_BOX_INFLATE <= tolerance * sa_magnitude(mid) / 2;
}

static int known(const sa_box *x, long double tolerance)
{
    return part_known(mpc_realref(x->m), x->re_rad, tolerance) &&
           part_known(mpc_imagref(x->m), x->im_rad, tolerance);
}

/* x *= 2 pi */
static void times_two_pi(sa_box *x)
{
    sa_span two_pi;
    sa_span_init(&two_pi, mpc_get_prec(x->m));
    mpfr_const_pi(two_pi.m, MPFR_RNDN);
    mpfr_mul_2ui(two_pi.m, two_pi.m, 1, MPFR_RNDN);
    two_pi.r = ldexpl(sa_magnitude(two_pi.m), -(int)mpfr_get_prec(two_pi.m));
    sa_box_scale(x, x, &two_pi);
    sa_span_clear(&two_pi);
}

/* The upper poles alone where they are enough and the starting values tell which they are, else all. */
static int find_poles(sa_pole_set *set, const request *r, int all)
{
    double complex upper[SA_STARTS_MAX];
    int n = 0;
    for (int i = 0; i < r->starts; i++)
        if (cimag(r->start[i]) > 0)
            upper[n++] = r->start[i];
    if (!all && n == set->place.upper_count && sa_pole_set_find(set, upper, n, 0, 0))
        return 1;
    return sa_pole_set_find(set, r->start, r->starts, 1, all);
}

typedef enum { KNOWN, VAGUE, UNSEPARATED } outcome;

/* One precision. KNOWN: both values are known well enough; VAGUE: not with these bits; UNSEPARATED: nor are
 * the poles. */
static outcome evaluate(mpc_t zeta, mpc_t kernel, const request *r, mpfr_prec_t precision)
{
    sa_pole_set set;
    sa_box value[2];
    sa_span xi;
    sa_pole_set_init(&set, r->track, precision);
    sa_place_set(&set.place, r->track, r->alpha, r->q);
    sa_box_init(&value[0], precision);
    sa_box_init(&value[1], precision);
    sa_span_init(&xi, precision);
    if (r->xi != NULL)
        sa_span_set_number(&xi, r->xi);
    outcome result = UNSEPARATED;
    if (find_poles(&set, r, r->track->undamped || mpfr_sgn(xi.m) < 0)) {
        sa_zeta_box(&value[0], &set);
        sa_kernel_box(&value[1], &set, &xi);
        times_two_pi(&value[1]);
        result = known(&value[0], r->tolerance) && known(&value[1], r->tolerance) ? KNOWN : VAGUE;
    }
    if (result == KNOWN) {
        mpc_set_prec(zeta, precision);
        mpc_set_prec(kernel, precision);
        mpc_set(zeta, value[0].m, MPC_RNDNN);
        mpc_set(kernel, value[1].m, MPC_RNDNN);
    }
    sa_span_clear(&xi);
    sa_box_clear(&value[0]);
    sa_box_clear(&value[1]);
    sa_pole_set_clear(&set);
    return result;
}

cv_status sa_kernel_digits(mpc_t zeta, mpc_t kernel, const sa_track *t, const cv_number *alpha,
                           const cv_number *q, const cv_number *xi, int digits, cv_message *why)
{
    if (digits < 1 || digits > CV_DIGITS_MAX)
        return cv_fail(why, CV_BAD_INPUT, "digits must be 1 to %d", CV_DIGITS_MAX);
    if (cv_number_sign(alpha) < 0)
        return cv_fail(why, CV_BAD_INPUT, "alpha must not be negative");
    request r = {.track = t, .alpha = alpha, .q = q, .xi = xi, .tolerance = powl(10, -digits - 1)};
    if (sa_kernel_starts(r.start, &r.starts, t, alpha, q) != CV_OK)
        return cv_fail(why, CV_FAILED, "LAPACK zggev failed");
    long needed = (long)(digits * 3.3219280948873624) + 48;
    long most = needed + BITS_BEYOND_DIGITS_MAX;
    outcome result = UNSEPARATED;
    for (long bits = (needed | 63); bits <= most && result != KNOWN; bits = (bits + bits / 2) | 63)
        result = evaluate(zeta, kernel, &r, bits);
    if (result == VAGUE)
        return cv_fail(why, CV_UNDECIDED, "%ld bits are not enough for %d digits of both parts", most,
                       digits);
    if (result == UNSEPARATED)
        return cv_fail(why, CV_UNDECIDED,
                       "%ld bits do not separate the poles: a branch point of the track, or too close to one",
                       most);
    return CV_OK;
}

cv_status sa_zeta_digits(mpc_t zeta, const sa_track *t, const cv_number *alpha, const cv_number *q,
                         int digits, cv_message *why)
{
    mpc_t kernel;
    mpc_init2(kernel, MPFR_PREC_MIN);
    cv_status status = sa_kernel_digits(zeta, kernel, t, alpha, q, NULL, digits, why);
    mpc_clear(kernel);
    return status;
}
