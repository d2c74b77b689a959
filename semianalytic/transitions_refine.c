#include <math.h>

#include "semianalytic/transitions_parts.h"

/* Newton's iteration at one precision, x = (alpha, q), f = (Re zeta - 1 / eta_M, Im zeta). The Jacobian is
 * that of the candidate, mostly right to 1e-6 or better, which each step gains in digits; where it is not,
 * approach() finds a better one. */
typedef struct {
    mpfr_t x[2], f[2], f_error[2], step[2], bound[2], base[2], full[2], level, scratch;
    mpc_t zeta;
    double inverse[2][2];
} newton;

static void invert(newton *n, const double j[2][2])
{
    double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    n->inverse[0][0] = j[1][1] / det;
    n->inverse[0][1] = -j[0][1] / det;
    n->inverse[1][0] = -j[1][0] / det;
    n->inverse[1][1] = j[0][0] / det;
}

/* Back to the candidate */
static void start(newton *n, const sa_candidate *from)
{
    invert(n, from->jacobian);
    mpfr_set_d(n->x[0], from->alpha, MPFR_RNDN);
    mpfr_set_d(n->x[1], from->q, MPFR_RNDN);
}

static void newton_init(newton *n, const sa_candidate *from, const cv_number *mass_ratio, mpfr_prec_t bits)
{
    for (int i = 0; i < 2; ++i)
        mpfr_inits2(bits, n->x[i], n->f[i], n->f_error[i], n->step[i], n->bound[i], n->base[i], n->full[i],
                    (mpfr_ptr)0);
    mpfr_inits2(bits, n->level, n->scratch, (mpfr_ptr)0);
    mpc_init2(n->zeta, bits);
    cv_number_get_mpfr(n->level, mass_ratio);
    mpfr_ui_div(n->level, 1, n->level, MPFR_RNDN);
    start(n, from);
}

static void newton_clear(newton *n)
{
    for (int i = 0; i < 2; ++i)
        mpfr_clears(n->x[i], n->f[i], n->f_error[i], n->step[i], n->bound[i], n->base[i], n->full[i],
                    (mpfr_ptr)0);
    mpfr_clears(n->level, n->scratch, (mpfr_ptr)0);
    mpc_clear(n->zeta);
}

/* step = inverse * f; bound = 2 |inverse| (|f| + f_error): the distance to the solution, with room for an
 * inverse that is wrong by less than a half over that distance. */
static void newton_step(newton *n)
{
    for (int i = 0; i < 2; ++i) {
        mpfr_set_zero(n->step[i], 1);
        mpfr_set_zero(n->bound[i], 1);
        for (int k = 0; k < 2; ++k) {
            mpfr_mul_d(n->scratch, n->f[k], n->inverse[i][k], MPFR_RNDN);
            mpfr_add(n->step[i], n->step[i], n->scratch, MPFR_RNDN);
            mpfr_abs(n->scratch, n->f[k], MPFR_RNDU);
            mpfr_add(n->scratch, n->scratch, n->f_error[k], MPFR_RNDU);
            mpfr_mul_d(n->scratch, n->scratch, 2 * fabs(n->inverse[i][k]), MPFR_RNDU);
            mpfr_add(n->bound[i], n->bound[i], n->scratch, MPFR_RNDU);
        }
    }
}

static cv_status newton_evaluate(newton *n, sa_sweep *sweep, const sa_track *track)
{
    cv_status status = sa_zeta_mp(n->zeta, n->f_error[0], n->f_error[1], sweep, track, n->x[0], n->x[1]);
    if (status != CV_OK)
        return status;
    /* the level is rounded once and subtracted with one more rounding: both below this */
    mpfr_set(n->scratch, n->level, MPFR_RNDU);
    mpfr_div_2si(n->scratch, n->scratch, mpfr_get_prec(n->level) - 2, MPFR_RNDU);
    mpfr_add(n->f_error[0], n->f_error[0], n->scratch, MPFR_RNDU);
    mpfr_sub(n->f[0], mpc_realref(n->zeta), n->level, MPFR_RNDN);
    mpfr_set(n->f[1], mpc_imagref(n->zeta), MPFR_RNDN);
    newton_step(n);
    return CV_OK;
}

/* bound[i] < 10^-digits |x[i]| for both */
static int precise(newton *n, int digits)
{
    for (int i = 0; i < 2; ++i) {
        mpfr_ui_pow_ui(n->scratch, 10, (unsigned long)digits, MPFR_RNDU);
        mpfr_mul(n->scratch, n->bound[i], n->scratch, MPFR_RNDU);
        if (!(mpfr_cmpabs(n->scratch, n->x[i]) < 0))
            return 0;
    }
    return 1;
}

/* The larger of |step / x|: what damped steps are measured by. */
static double relative_step(newton *n)
{
    double size = 0;
    for (int i = 0; i < 2; ++i) {
        mpfr_div(n->scratch, n->step[i], n->x[i], MPFR_RNDN);
        size = fmax(size, fabs(mpfr_get_d(n->scratch, MPFR_RNDN)));
    }
    return size;
}

/* Whether a difference of zeta stands clear of the bounds of its two values. */
static int clear_of_noise(newton *n, mpc_srcptr difference)
{
    mpc_abs(n->scratch, difference, MPFR_RNDD);
    mpfr_div_2si(n->scratch, n->scratch, 20, MPFR_RNDD);
    for (int i = 0; i < 2; ++i)
        if (!(mpfr_cmp(n->f_error[i], n->scratch) < 0 && mpfr_cmp(n->bound[i], n->scratch) < 0))
            return 0;
    return 1;
}

/* The Jacobian by differences at x, where zeta is known. Half of the working precision is left to it.
 * CV_UNDECIDED: the precision is not enough for that. */
static cv_status differentiate(newton *n, sa_sweep *sweep, const sa_track *track)
{
    double j[2][2];
    cv_status status = CV_OK;
    mpc_t there;
    mpc_init2(there, mpfr_get_prec(n->level));
    for (int i = 0; i < 2 && status == CV_OK; ++i) {
        mpfr_set(n->base[i], n->x[i], MPFR_RNDN);
        mpfr_div_2si(n->full[i], n->x[i], mpfr_get_prec(n->level) / 2, MPFR_RNDN);
        mpfr_add(n->x[i], n->x[i], n->full[i], MPFR_RNDN);
        mpfr_sub(n->full[i], n->x[i], n->base[i], MPFR_RNDN);
        status = sa_zeta_mp(there, n->bound[0], n->bound[1], sweep, track, n->x[0], n->x[1]);
        mpfr_set(n->x[i], n->base[i], MPFR_RNDN);
        mpc_sub(there, there, n->zeta, MPC_RNDNN);
        if (status == CV_OK && !clear_of_noise(n, there))
            status = CV_UNDECIDED;
        mpc_div_fr(there, there, n->full[i], MPC_RNDNN);
        j[0][i] = mpfr_get_d(mpc_realref(there), MPFR_RNDN);
        j[1][i] = mpfr_get_d(mpc_imagref(there), MPFR_RNDN);
    }
    mpc_clear(there);
    if (status == CV_OK)
        invert(n, (const double(*)[2])j);
    return status;
}

/* x = base - part * full; size is that of the next step by the same Jacobian. */
static cv_status try_part(double *size, newton *n, sa_sweep *sweep, const sa_track *track, double part)
{
    for (int i = 0; i < 2; ++i) {
        mpfr_mul_d(n->scratch, n->full[i], part, MPFR_RNDN);
        mpfr_sub(n->x[i], n->base[i], n->scratch, MPFR_RNDN);
        if (mpfr_sgn(n->x[i]) <= 0)
            return CV_UNDECIDED;
    }
    cv_status status = newton_evaluate(n, sweep, track);
    *size = INFINITY;
    if (status == CV_OK)
        *size = relative_step(n);
    return status == CV_FAILED ? status : CV_OK;
}

/* One Newton step with a new Jacobian, halved until the next step by the same Jacobian is smaller (the
 * natural test of monotony). *gain: how much smaller. CV_UNDECIDED: never. */
static cv_status damped_step(double *gain, newton *n, sa_sweep *sweep, const sa_track *track)
{
    const double shortest = 1e-4;
    double size = INFINITY;
    cv_status status = differentiate(n, sweep, track);
    if (status != CV_OK)
        return status;
    newton_step(n);
    const double whole = relative_step(n);
    for (int i = 0; i < 2; ++i)
        mpfr_set(n->full[i], n->step[i], MPFR_RNDN);
    for (double part = 1; status != CV_FAILED && part > shortest; part /= 2) {
        status = try_part(&size, n, sweep, track, part);
        if (status == CV_OK && size < (1 - part / 4) * whole) {
            *gain = part < 1 ? 1 : size / whole;
            return CV_OK;
        }
    }
    return status == CV_FAILED ? status : CV_UNDECIDED;
}

/* Whether x is the solution that the candidate stands for: near, and passed in the same direction (the counts
 * of roots between transitions are the proof). Along a branch curve a candidate in double may be 1e-5 off. */
static int same_solution(newton *n, const sa_candidate *from)
{
    const double reach = 1e-3, candidate[2] = {from->alpha, from->q};
    const double(*j)[2] = from->jacobian, (*k)[2] = (const double(*)[2])n->inverse;
    for (int i = 0; i < 2; ++i) {
        mpfr_sub_d(n->scratch, n->x[i], candidate[i], MPFR_RNDN);
        if (!(fabs(mpfr_get_d(n->scratch, MPFR_RNDN)) <= reach * candidate[i]))
            return 0;
    }
    return (j[0][0] * j[1][1] - j[0][1] * j[1][0] > 0) == (k[0][0] * k[1][1] - k[0][1] * k[1][0] > 0);
}

/* For candidates so close to a branch curve that double resolves neither the point nor the way zeta turns
 * there: damped steps until a whole one gains two digits, so that iterate() can go on with its Jacobian. */
static cv_status approach(newton *n, sa_sweep *sweep, const sa_track *track)
{
    enum { STEPS = 60 };
    double gain = 1;
    cv_status status = newton_evaluate(n, sweep, track);
    for (int k = 0; k < STEPS && status == CV_OK && gain > 0.01; ++k)
        status = damped_step(&gain, n, sweep, track);
    return status == CV_OK && gain > 0.01 ? CV_UNDECIDED : status;
}

/* CV_UNDECIDED: no convergence at this precision. The Jacobian is believed after a step that shrank. */
static cv_status iterate(newton *n, sa_sweep *sweep, const sa_track *track, int digits)
{
    const double slowest = 0.1;
    double last = INFINITY;
    cv_status status;
    for (int done = 0; !done;) {
        status = newton_evaluate(n, sweep, track);
        if (status != CV_OK)
            return status;
        const double size = relative_step(n);
        if (!(size <= slowest * last))
            return CV_UNDECIDED;
        done = isfinite(last) && precise(n, digits);
        last = size;
        for (int i = 0; i < 2 && !done; ++i) {
            mpfr_sub(n->x[i], n->x[i], n->step[i], MPFR_RNDN);
            if (mpfr_sgn(n->x[i]) <= 0)
                return CV_UNDECIDED;
        }
    }
    return status;
}

/* The candidate, of which no digit is claimed. */
static void give_up(newton *n, const sa_candidate *from)
{
    start(n, from);
    for (int i = 0; i < 2; ++i)
        mpfr_abs(n->bound[i], n->x[i], MPFR_RNDU);
}

static void report(sa_transition *item, const newton *n, cv_status decided)
{
    mpfr_set_prec(item->alpha, mpfr_get_prec(n->x[0]));
    mpfr_set_prec(item->q, mpfr_get_prec(n->x[1]));
    mpfr_set(item->alpha, n->x[0], MPFR_RNDN);
    mpfr_set(item->q, n->x[1], MPFR_RNDN);
    item->alpha_error = mpfr_get_d(n->bound[0], MPFR_RNDU);
    item->q_error = mpfr_get_d(n->bound[1], MPFR_RNDU);
    item->decided = decided;
}

cv_status sa_transition_refine(sa_transition *item, sa_sweep *sweep, const sa_track *track,
                               const sa_candidate *from, const cv_number *mass_ratio, int digits)
{
    const mpfr_prec_t guard = 60, largest = SA_PRECISION_MAX + 4 * (mpfr_prec_t)digits;
    cv_status status = CV_UNDECIDED;
    mpfr_init2(item->alpha, 53);
    mpfr_init2(item->q, 53);
    for (mpfr_prec_t bits = digits * 10L / 3 + guard; status == CV_UNDECIDED && bits < largest;
         bits += bits / 2) {
        newton n;
        newton_init(&n, from, mass_ratio, bits);
        status = iterate(&n, sweep, track, digits);
        if (status == CV_UNDECIDED) {
            start(&n, from);
            status = approach(&n, sweep, track);
            if (status == CV_OK)
                status = iterate(&n, sweep, track, digits);
        }
        if (status == CV_OK && !same_solution(&n, from))
            status = CV_UNDECIDED;
        if (status != CV_OK)
            give_up(&n, from);
        report(item, &n, status);
        newton_clear(&n);
    }
    return status == CV_UNDECIDED ? CV_OK : status;
}

int sa_transition_step(const sa_candidate *c)
{
    const double(*j)[2] = c->jacobian;
    /* along the line Im zeta = 0, d Re zeta / d alpha = det / (d Im zeta / dq): where it is positive a
     * crossing enters the count, which is +2 where Im zeta falls with q and -2 where it grows */
    return j[0][0] * j[1][1] - j[0][1] * j[1][0] > 0 ? -2 : 2;
}
