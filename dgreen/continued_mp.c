#include "dgreen/continued_mp.h"

#include <stdlib.h>

#include "dgreen/residues_mp.h"

static const mpc_rnd_t CRND = MPC_RNDNN;

struct dg_continued_mp {
    const dg_track *track;
    dg_constants constants;
    dg_mp_operator op;
    dg_mp_roots roots;
    dg_mp_residues sums;
    mpfr_t alpha;
    mpc_t factor;
};

cv_status dg_continued_mp_new(dg_continued_mp **out, const dg_track *track, const cv_number *alpha,
                              mpfr_prec_t precision, cv_message *why)
{
    dg_continued_mp *w = calloc(1, sizeof *w);
    *out = w;
    if (w == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    w->track = track;
    dg_constants_init(&w->constants, track, precision);
    dg_mp_operator_init(&w->op, precision);
    dg_mp_roots_init(&w->roots, precision);
    dg_mp_residues_init(&w->sums, precision);
    mpc_init2(w->factor, precision);
    mpfr_init2(w->alpha, precision);
    cv_number_get_mpfr(w->alpha, alpha);
    return CV_OK;
}

void dg_continued_mp_free(dg_continued_mp *w)
{
    if (w == NULL)
        return;
    dg_constants_clear(&w->constants);
    dg_mp_operator_clear(&w->op);
    dg_mp_roots_clear(&w->roots);
    dg_mp_residues_clear(&w->sums);
    mpc_clear(w->factor);
    mpfr_clear(w->alpha);
    free(w);
}

/* Re lambda = -Im y; Im(1/y) has the other sign. */
static int is_physical(const dg_mp_roots *roots, unsigned chosen)
{
    for (int i = 0; i < roots->count; i++) {
        const int far = roots->far && i == roots->count - 1;
        const int right = (mpfr_sgn(mpc_imagref(roots->y[i])) < 0) != far;
        if (right != (int)(chosen >> i & 1u))
            return 0;
    }
    return 1;
}

/* |4 qbar^2| (units of the sum's two parts + 64 units of the sum itself), in absolute terms */
static void bound(mpfr_ptr error, dg_continued_mp *w)
{
    const double units = w->sums.re_error + w->sums.im_error + 64 * dg_mp_modulus(w->sums.right);
    mpc_abs(error, w->factor, MPFR_RNDU);
    mpfr_mul_d(error, error, units, MPFR_RNDU);
    mpfr_div_2si(error, error, (long)w->op.precision, MPFR_RNDU);
}

cv_status dg_continued_mp_zeta(mpc_ptr zeta, mpfr_ptr error, int *physical, dg_continued_mp *w,
                               const dg_continued *near, mpc_srcptr qbar)
{
    dg_mp_operator_set(&w->op, w->track, &w->constants, w->alpha, qbar);
    cv_status status = dg_mp_roots_find(&w->roots, &w->op, &near->roots, 0);
    if (status == CV_OK)
        status = dg_mp_residues_sum_chosen(&w->sums, &w->op, &w->roots, near->chosen);
    if (status != CV_OK)
        return status;
    *physical = is_physical(&w->roots, near->chosen);
    mpc_sqr(w->factor, qbar, CRND);
    mpc_mul_i(w->factor, w->factor, 1, CRND);
    mpc_mul_ui(w->factor, w->factor, 4, CRND);
    mpc_mul(zeta, w->factor, w->sums.right, CRND);
    bound(error, w);
    return CV_OK;
}
