/* zeta in double precision: warm poles, certified, and their residues. */
#include <stdlib.h>
#include <string.h>

#include "semianalytic/sweep.h"

sa_sweep *sa_sweep_new(void)
{
    return calloc(1, sizeof(sa_sweep));
}

void sa_sweep_free(sa_sweep *s)
{
    free(s);
}

sa_counts sa_sweep_counts(const sa_sweep *s)
{
    return s->counts;
}

void sa_sweep_predict(double complex p[SA_UPPER_MAX], const sa_sweep *s, double alpha, double complex q)
{
    for (int i = 0; i < s->count; i++)
        p[i] = s->p[i] + s->slopes[i].p_alpha * (alpha - s->alpha) + s->slopes[i].p_q * (q - s->q);
}

typedef enum { CERTIFIED, UNBOUNDED, LOST } outcome;

/* Improves n starting values to upper poles, remembers and encloses them. LOST: Newton's iteration does not
 * lead to n different upper poles, other starting values may; UNBOUNDED: it seems to, but double precision
 * cannot prove it, and the remembered poles may serve as starting values in more. */
static outcome certify(sa_pole *poles, sa_sweep *state, double complex *start, int n, const sa_track *t,
                       double alpha, double complex q)
{
    sa_point m[SA_UPPER_MAX];
    state->count = 0;
    for (int i = 0; i < n; i++) {
        if (!sa_poles_newton(&start[i], &m[i], t, alpha, q) || !(cimag(start[i]) > 0))
            return LOST;
        for (int j = 0; j < i; j++)
            if (cabs(start[i] - start[j]) <= 0x1p-40 * cabs(start[i]))
                return LOST;
        state->p[i] = start[i];
        sa_matrix_slopes(&state->slopes[i], &m[i], t, alpha);
    }
    state->count = n;
    state->alpha = alpha;
    state->q = q;
    for (int i = 0; i < n; i++)
        if (!sa_poles_enclose(&poles[i], &m[i], t, alpha, q))
            return UNBOUNDED;
    return sa_poles_separate(poles, n) ? CERTIFIED : UNBOUNDED;
}

static outcome cold(sa_pole *poles, sa_sweep *state, int n, const sa_track *t, double alpha, double complex q)
{
    double complex all[SA_POLES_MAX], start[SA_UPPER_MAX];
    int found, upper = 0;
    state->counts.cold_starts++;
    if (sa_poles_cold(all, &found, t, alpha, q) != CV_OK)
        return LOST;
    for (int i = 0; i < found; i++)
        if (cimag(all[i]) > 0) {
            if (upper == n)
                return LOST;
            start[upper++] = all[i];
        }
    return upper == n ? certify(poles, state, start, n, t, alpha, q) : LOST;
}

/* zeta = i q^2 (sum of the residues) */
static void assemble(sa_value *out, const sa_pole *poles, const sa_sweep *state, double complex q)
{
    sa_rect sum = poles[0].residue, q2 = sa_rect_sqr(sa_rect_exact(q));
    double complex total = state->slopes[0].residue, along_q = state->slopes[0].residue_q;
    double complex along_alpha = state->slopes[0].residue_alpha;
    for (int i = 1; i < state->count; i++) {
        sum = sa_rect_add(sum, poles[i].residue);
        total += state->slopes[i].residue;
        along_q += state->slopes[i].residue_q;
        along_alpha += state->slopes[i].residue_alpha;
    }
    sa_rect zeta = sa_rect_times_i(sa_rect_mul(q2, sum));
    *out = (sa_value){.re = zeta.re,
                      .im = zeta.im,
                      .re_error = zeta.re_rad * SA_INFLATE,
                      .im_error = zeta.im_rad * SA_INFLATE,
                      .d_alpha = CMPLX(0, 1) * q * q * along_alpha,
                      .d_q = CMPLX(0, 1) * (2 * q * total + q * q * along_q),
                      .upper_count = state->count};
}

static int in_double_range(double x)
{
    return x == 0 || (fabs(x) >= 1e-20 && fabs(x) <= 1e20);
}

cv_status sa_zeta_complex(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double complex q)
{
    if (!isfinite(alpha) || !(alpha >= 0) || !isfinite(creal(q)) || !(cimag(q) <= 0) || !isfinite(cimag(q)))
        return CV_BAD_INPUT;
    if (!t->double_range || !in_double_range(alpha) || !in_double_range(creal(q)) ||
        !in_double_range(cimag(q)))
        return CV_UNDECIDED;
    if (t->undamped && cimag(q) == 0)
        return sa_zeta_limit(out, state, t, alpha, creal(q));
    int n = sa_matrix_upper_count_double(t, alpha);
    sa_pole poles[SA_UPPER_MAX];
    double complex start[SA_UPPER_MAX];
    state->counts.evaluations++;
    sa_sweep_predict(start, state, alpha, q);
    outcome result = state->count == n ? certify(poles, state, start, n, t, alpha, q) : LOST;
    if (result == LOST)
        result = cold(poles, state, n, t, alpha, q);
    if (result != CERTIFIED)
        return CV_UNDECIDED;
    assemble(out, poles, state, q);
    return isfinite(out->re_error) && isfinite(out->im_error) ? CV_OK : CV_UNDECIDED;
}

cv_status sa_zeta_double(sa_value *out, sa_sweep *state, const sa_track *t, double alpha, double q)
{
    return sa_zeta_complex(out, state, t, alpha, q);
}
