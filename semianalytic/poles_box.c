#include "semianalytic/poles_box.h"

#include <math.h>

void sa_pole_set_init(sa_pole_set *set, const sa_track *t, mpfr_prec_t precision)
{
    sa_place_init(&set->place, t, precision);
    sa_box_matrix_init(&set->matrix, precision);
    for (int i = 0; i < SA_POLES_MAX; i++) {
        sa_box_init(&set->poles[i].p, precision);
        sa_box_init(&set->poles[i].residue, precision);
    }
    set->count = 0;
}

void sa_pole_set_clear(sa_pole_set *set)
{
    sa_place_clear(&set->place);
    sa_box_matrix_clear(&set->matrix);
    for (int i = 0; i < SA_POLES_MAX; i++) {
        sa_box_clear(&set->poles[i].p);
        sa_box_clear(&set->poles[i].residue);
    }
}

static double complex rounded(const mpc_t z)
{
    return CMPLX(mpfr_get_d(mpc_realref(z), MPFR_RNDN), mpfr_get_d(mpc_imagref(z), MPFR_RNDN));
}

/* Newton's step f/f' becomes that of f over the product of (p - p_j), so that two starting values do not run
 * to one zero. Doubles are enough: the correction only matters far from the zero. */
static void deflate(mpc_t step, const sa_pole_set *set, mpc_t scratch)
{
    double complex pull = 0;
    for (int j = 0; j < set->count; j++) {
        mpc_sub(scratch, set->matrix.p.m, set->poles[j].p.m, MPC_RNDNN);
        pull += 1 / rounded(scratch);
    }
    double complex factor = 1 / (1 - rounded(step) * pull);
    if (!(cabs(factor - 1) > 0x1p-30) || !isfinite(creal(factor)) || !isfinite(cimag(factor)))
        return;
    mpc_set_d_d(scratch, creal(factor), cimag(factor), MPC_RNDNN);
    mpc_mul(step, step, scratch, MPC_RNDNN);
}

/* log2 |part| is below log2 |whole| by more than bits */
static int small(const mpfr_t part, const mpfr_t whole, long bits)
{
    return mpfr_zero_p(part) ||
           (mpfr_number_p(part) && !mpfr_zero_p(whole) && mpfr_get_exp(part) < mpfr_get_exp(whole) - bits);
}

/* The step in one part is small beside that part, or far below the last bit of the other: then the part is
 * zero, but for rounding. */
static int settled(const mpfr_t step, const mpfr_t part, const mpfr_t other, long half)
{
    return small(step, part, half) || small(step, other, 4 * half);
}

/* Newton's iteration on matrix.p until the next step would be below the precision; leaves det_p near the
 * zero. */
static void iterate(sa_pole_set *set, int is_real)
{
    enum { STEPS_MAX = 100 };
    sa_box_matrix *m = &set->matrix;
    long half = (long)set->place.precision * 11 / 20;
    mpc_t step, scratch;
    mpc_init2(step, set->place.precision);
    mpc_init2(scratch, set->place.precision);
    for (int i = 0; i < STEPS_MAX; i++) {
        sa_box_matrix_set(m, &set->place);
        sa_box_matrix_slope(m, &set->place);
        mpc_div(step, m->det.m, m->det_p.m, MPC_RNDNN);
        deflate(step, set, scratch);
        mpc_sub(m->p.m, m->p.m, step, MPC_RNDNN);
        if (is_real)
            mpfr_set_zero(mpc_imagref(m->p.m), 1);
        if (!mpfr_number_p(mpc_realref(step)) || !mpfr_number_p(mpc_imagref(step)))
            break;
        if (settled(mpc_realref(step), mpc_realref(m->p.m), mpc_imagref(m->p.m), half) &&
            settled(mpc_imagref(step), mpc_imagref(m->p.m), mpc_realref(m->p.m), half))
            break;
    }
    mpc_clear(step);
    mpc_clear(scratch);
}

/* |Re x| and |Im x| within the radii of the box? A box may be flat where an equation has real coefficients.
 */
static int inside(const sa_box *x, const sa_box *box)
{
    return (sa_magnitude(mpc_realref(x->m)) + x->re_rad) * SA_BOX_INFLATE <= box->re_rad &&
           (sa_magnitude(mpc_imagref(x->m)) + x->im_rad) * SA_BOX_INFLATE <= box->im_rad;
}

/* Twice a bound of Newton's step, and no less than the last bit. */
static void choose_radii(sa_box *p, const sa_box *step, int is_real)
{
    int precision = (int)mpc_get_prec(p->m);
    p->re_rad = 2 * (sa_magnitude(mpc_realref(step->m)) + step->re_rad) +
                ldexpl(sa_magnitude(mpc_realref(p->m)), -precision);
    p->im_rad = is_real ? 0
                        : 2 * (sa_magnitude(mpc_imagref(step->m)) + step->im_rad) +
                              ldexpl(sa_magnitude(mpc_imagref(p->m)), -precision);
}

/* The free place of the set holds what is not in the matrix: d3 at the midpoint, and the step. */
int sa_pole_set_certify(sa_pole_set *set, int is_real)
{
    sa_box_matrix *m = &set->matrix;
    sa_box *thin = &set->poles[set->count].p, *step = &set->poles[set->count].residue;
    sa_box_matrix_set(m, &set->place);
    sa_box_set(thin, &m->det);
    m->det_p.re_rad = m->det_p.im_rad = 0;
    if (!sa_box_div(step, thin, &m->det_p))
        return 0;
    choose_radii(&m->p, step, is_real);
    for (int attempt = 0; attempt < 3; attempt++) {
        sa_box_matrix_set(m, &set->place);
        sa_box_matrix_slope(m, &set->place);
        if (sa_box_div(step, thin, &m->det_p) && inside(step, &m->p))
            return 1;
        m->p.re_rad *= 4;
        m->p.im_rad *= 4;
    }
    return 0;
}

/* 1 when the sign of Im p is certain: its sign, else 0 */
static int half_plane(const sa_box *p)
{
    int certain = sa_magnitude(mpc_imagref(p->m)) / 2 > p->im_rad * SA_BOX_INFLATE;
    return certain ? mpfr_sgn(mpc_imagref(p->m)) : 0;
}

/* The zero of d3 next to start as the next pole of the set; 0 when no box is certain. */
static int find_near(sa_pole_set *set, double complex start)
{
    sa_box_pole *pole = &set->poles[set->count];
    sa_box_matrix *m = &set->matrix;
    mpc_set_d_d(m->p.m, creal(start), cimag(start), MPC_RNDNN);
    m->p.re_rad = m->p.im_rad = 0;
    iterate(set, 0);
    /* d3 of an undamped track has real coefficients: a zero that close to the axis is real or has its
     * conjugate beside it, and only a real one is certified by real interval Newton */
    pole->is_real = set->place.undamped &&
                    small(mpc_imagref(m->p.m), mpc_realref(m->p.m), (long)set->place.precision / 3);
    if (pole->is_real) {
        mpfr_set_zero(mpc_imagref(m->p.m), 1);
        iterate(set, 1);
    }
    if (!sa_pole_set_certify(set, pole->is_real) || !sa_box_matrix_residue(&pole->residue, m))
        return 0;
    sa_box_set(&pole->p, &m->p);
    pole->side = pole->is_real ? sa_box_matrix_side(m, &set->place) : half_plane(&m->p);
    return pole->side != 0;
}

static int is_new(const sa_pole_set *set)
{
    for (int j = 0; j < set->count; j++)
        if (!sa_box_disjoint(&set->poles[j].p, &set->poles[set->count].p))
            return 0;
    return 1;
}

/* Newton's iteration cannot leave the real axis of an undamped track, nor the middle between two poles: then
 * it starts again from the side. */
static int find(sa_pole_set *set, double complex start)
{
    const double complex turns[] = {1, CMPLX(1, 0.25), CMPLX(1, -0.25)};
    if (start == 0)
        start = 0x1p-100;
    for (size_t i = 0; i < sizeof turns / sizeof turns[0]; i++)
        if (find_near(set, start * turns[i]) && is_new(set))
            return 1;
    return 0;
}

int sa_pole_set_find(sa_pole_set *set, const double complex *start, int n, int skip, int all)
{
    int upper = 0;
    set->count = 0;
    for (int i = 0; i < n && set->count < SA_POLES_MAX; i++) {
        if (!find(set, start[i])) {
            if (!skip)
                return 0;
            continue;
        }
        upper += set->poles[set->count].side > 0;
        set->count++;
    }
    return upper == set->place.upper_count && (!all || set->count == set->place.degree);
}
