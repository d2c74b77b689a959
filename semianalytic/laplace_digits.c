#include "semianalytic/laplace_digits.h"

#include "semianalytic/laplace.h"
#include "semianalytic/poles_box.h"

/* The poles that make K at qbar, in double; 0 where they cannot be followed there. */
static int find_starts(double complex start[SA_POLES_MAX], int *count, const sa_track *t,
                       const cv_number *alpha, const mpc_t qbar)
{
    sa_sheet sheet;
    const double complex q =
        CMPLX(mpfr_get_d(mpc_imagref(qbar), MPFR_RNDN), -mpfr_get_d(mpc_realref(qbar), MPFR_RNDN));
    *count = 0;
    if (sa_sheet_at(&sheet, t, cv_number_get_double(alpha), q) != CV_OK)
        return 0;
    for (int i = 0; i < sheet.count; i++)
        if (sheet.upper[i])
            start[(*count)++] = sheet.p[i];
    return 1;
}

static void set_place(sa_place *place, const sa_track *t, const cv_number *alpha, const mpc_t qbar)
{
    cv_number zero;
    mpfr_t minus_re;
    cv_number_init(&zero);
    mpfr_init2(minus_re, mpfr_get_prec(mpc_realref(qbar)));
    sa_place_set(place, t, alpha, &zero);
    mpfr_neg(minus_re, mpc_realref(qbar), MPFR_RNDN);
    sa_span_set(&place->q, mpc_imagref(qbar));
    sa_span_set(&place->q_im, minus_re);
    mpfr_clear(minus_re);
    cv_number_clear(&zero);
}

/* zeta = i q^2 (sum of the residues of d2/d3) = -i qbar^2 (...) */
static void sum_up(sa_box *zeta, const sa_pole_set *set, const mpc_t qbar)
{
    const mpfr_prec_t precision = set->place.precision;
    sa_box square;
    sa_span re, im;
    sa_box_init(&square, precision);
    sa_span_init(&re, precision);
    sa_span_init(&im, precision);
    sa_span_set(&re, mpc_realref(qbar));
    sa_span_set(&im, mpc_imagref(qbar));
    sa_box_set_real(&square, &im);
    sa_box_times_i(&square, &square);
    sa_box_add_real(&square, &square, &re);
    sa_box_sqr(&square, &square);
    sa_box_zero(zeta);
    for (int i = 0; i < set->count; i++)
        sa_box_add(zeta, zeta, &set->poles[i].residue);
    sa_box_mul(zeta, zeta, &square);
    sa_box_times_i(zeta, zeta);
    sa_box_neg(zeta, zeta);
    sa_box_clear(&square);
    sa_span_clear(&re);
    sa_span_clear(&im);
}

cv_status sa_zeta_continued(mpc_t zeta, mpfr_t re_error, mpfr_t im_error, const sa_track *t,
                            const cv_number *alpha, const mpc_t qbar)
{
    double complex start[SA_POLES_MAX];
    int count;
    sa_pole_set set;
    sa_box value;
    if (!find_starts(start, &count, t, alpha, qbar))
        return CV_UNDECIDED;
    sa_pole_set_init(&set, t, mpc_get_prec(zeta));
    sa_box_init(&value, mpc_get_prec(zeta));
    set_place(&set.place, t, alpha, qbar);
    sa_pole_set_find(&set, start, count, 0, 0); /* the sides do not matter: which poles to take is known */
    const int complete = set.count == count;
    if (complete) {
        sum_up(&value, &set, qbar);
        mpc_set(zeta, value.m, MPC_RNDNN);
        mpfr_set_ld(re_error, value.re_rad * SA_BOX_INFLATE, MPFR_RNDU);
        mpfr_set_ld(im_error, value.im_rad * SA_BOX_INFLATE, MPFR_RNDU);
    }
    sa_box_clear(&value);
    sa_pole_set_clear(&set);
    return complete ? CV_OK : CV_UNDECIDED;
}
