/* A check from outside: the moving mass on a beam cut off at +-80 and discretised by finite differences, in
 * the moving frame and straight from (1) in dimensionless form, as an eigenvalue problem in qbar. Its
 * eigenvalue must be the root of the characteristic equation z = 1, (29)-(30), and not of the printed form of
 * (13), pi - 2 eta_M q^2 K = 0, which is z = 1/4.
 *
 * In case 1, eta = 0.05, eta_M = 100, alpha = 0.5, it lies a little to the left of the imaginary
 * axis, so zeta is continued there from Re qbar > 0 with the roots lambda that have Re lambda > 0 over there;
 * two of them have changed sides on the way. (The sum over Re lambda > 0 on the spot is 1 at qbar = -0.002726
 * + 0.209815i, 6e-4 off: no eigenvalue.) */
#include <check.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/roots.h"
#include "dgreen/z.h"
#include "tests/dgreen_points.h"

static const double LENGTH = 80;

/* Per node: w, u_s, s u_s, u_b, s u_b with s = d/dtau - alpha d/dxi. Nothing moves ahead of the mass, at xi =
 * +40; sleepers and ballast, which only pass by, are differenced towards it. */
enum { W, US, VS, UB, VB, UNKNOWNS, BAND = 2 * UNKNOWNS + UNKNOWNS - 1, HEIGHT = 3 * BAND + 1 };

typedef struct {
    int nodes;
    double h, alpha, mass;
    double complex qbar;
    const dg_track *track;
    lapack_complex_double *band; /* LAPACK band storage */
} mesh;

static void put(mesh *m, int row, int node, int unknown, double complex value)
{
    if (node < 0 || node >= m->nodes)
        return;
    const int column = node * UNKNOWNS + unknown;
    m->band[(size_t)column * HEIGHT + (size_t)(2 * BAND + row - column)] += value;
}

/* factor * (qbar - alpha d/dxi) by central differences */
static void put_rate(mesh *m, int row, int node, int unknown, double complex factor)
{
    put(m, row, node, unknown, factor * m->qbar);
    put(m, row, node + 1, unknown, -factor * m->alpha / (2 * m->h));
    put(m, row, node - 1, unknown, factor * m->alpha / (2 * m->h));
}

/* the same, differenced towards +xi, of second order */
static void put_passing_rate(mesh *m, int row, int node, int unknown, double complex factor)
{
    put(m, row, node, unknown, factor * (m->qbar + 3 * m->alpha / (2 * m->h)));
    put(m, row, node + 1, unknown, -factor * 4 * m->alpha / (2 * m->h));
    put(m, row, node + 2, unknown, factor * m->alpha / (2 * m->h));
}

static void put_beam(mesh *m, int j)
{
    const int row = j * UNKNOWNS + W;
    const double h2 = m->h * m->h, bending = 1 / (4 * h2 * h2),
                 second = (m->track->eta_N + m->alpha * m->alpha) / h2;
    const double binomial[5] = {1, -4, 6, -4, 1};
    for (int k = -2; k <= 2; k++)
        put(m, row, j + k, W, bending * binomial[k + 2]);
    for (int k = -1; k <= 1; k++)
        put(m, row, j + k, W, second * (k == 0 ? -2 : 1));
    put(m, row, j, W, m->qbar * m->qbar + m->track->kappa_p);
    put(m, row, j + 1, W, -m->alpha * m->qbar / m->h);
    put(m, row, j - 1, W, m->alpha * m->qbar / m->h);
    put_rate(m, row, j, W, 2 * m->track->eta_p);
    put(m, row, j, VS, -2 * m->track->eta_p);
    put(m, row, j, US, -m->track->kappa_p);
    if (j == m->nodes / 2)
        put(m, row, j, W, m->mass * m->qbar * m->qbar / m->h);
}

static void put_layers(mesh *m, int j)
{
    const dg_track *t = m->track;
    const int row = j * UNKNOWNS;
    put(m, row + US, j, VS, 1);
    put_passing_rate(m, row + US, j, US, -1);
    put_passing_rate(m, row + VS, j, VS, t->mu_s);
    put(m, row + VS, j, VS, 2 * (t->eta_p + t->eta_b));
    put(m, row + VS, j, US, t->kappa_p + t->kappa_b);
    put_rate(m, row + VS, j, W, -2 * t->eta_p);
    put(m, row + VS, j, W, -t->kappa_p);
    put(m, row + VS, j, VB, -2 * t->eta_b);
    put(m, row + VS, j, UB, -t->kappa_b);
    put(m, row + UB, j, VB, 1);
    put_passing_rate(m, row + UB, j, UB, -1);
    put_passing_rate(m, row + VB, j, VB, t->mu_b);
    put(m, row + VB, j, VB, 2 * (t->eta_b + t->eta_f));
    put(m, row + VB, j, UB, t->kappa_b + 1);
    put(m, row + VB, j, VS, -2 * t->eta_b);
    put(m, row + VB, j, US, -t->kappa_b);
}

static void assemble(mesh *m, double complex qbar)
{
    m->qbar = qbar;
    memset(m->band, 0, sizeof *m->band * HEIGHT * UNKNOWNS * (size_t)m->nodes);
    for (int j = 0; j < m->nodes; j++) {
        put_beam(m, j);
        put_layers(m, j);
    }
}

/* out += factor * T(qbar) u */
static void multiply(double complex *out, mesh *m, double complex qbar, const double complex *u,
                     double factor)
{
    const int n = UNKNOWNS * m->nodes;
    assemble(m, qbar);
    for (int column = 0; column < n; column++)
        for (int row = column > BAND ? column - BAND : 0; row <= column + BAND && row < n; row++)
            out[row] +=
                factor * m->band[(size_t)column * HEIGHT + (size_t)(2 * BAND + row - column)] * u[column];
}

/* One step of inverse iteration on T(qbar) u = 0, T quadratic in qbar: solve T x = T' u, then
 * qbar -= u_0/x_0 with the beam under the mass as component 0. */
static double complex inverse_step(mesh *m, double complex qbar, double complex *u)
{
    const int n = UNKNOWNS * m->nodes, under = m->nodes / 2 * UNKNOWNS + W;
    double complex *x = calloc((size_t)n, sizeof *x);
    lapack_int *pivots = calloc((size_t)n, sizeof *pivots);
    ck_assert(x != NULL && pivots != NULL);
    multiply(x, m, qbar + 0.01, u, 50);
    multiply(x, m, qbar - 0.01, u, -50);
    assemble(m, qbar);
    ck_assert_int_eq(LAPACKE_zgbsv(LAPACK_COL_MAJOR, n, BAND, BAND, 1, m->band, HEIGHT, pivots, x, n), 0);
    const double complex growth = x[under] / u[under];
    for (int i = 0; i < n; i++)
        u[i] = x[i] / x[under];
    free(pivots);
    free(x);
    return qbar - 1 / growth;
}

static double complex eigenvalue(const dg_track *t, double alpha, double mass, double complex start, double h)
{
    mesh m = {2 * (int)(LENGTH / h) + 1, h, alpha, mass, 0, t, NULL};
    const size_t n = (size_t)UNKNOWNS * (size_t)m.nodes;
    double complex qbar = start, *u = calloc(n, sizeof *u), last = 0;
    m.band = malloc(sizeof *m.band * HEIGHT * n);
    ck_assert(u != NULL && m.band != NULL);
    for (size_t i = 0; i < n; i++)
        u[i] = 1;
    for (int i = 0; i < 30 && !(cabs(qbar - last) < 1e-8); i++) {
        last = qbar;
        qbar = inverse_step(&m, qbar, u);
    }
    ck_assert(cabs(qbar - last) < 1e-8); /* rounding: 1e-16/h^4 */
    free(m.band);
    free(u);
    return qbar;
}

/* Extrapolated from two meshes: the error is of second order in h. */
static double complex extrapolated(const dg_track *t, double alpha, double mass, double complex start)
{
    return (4 * eigenvalue(t, alpha, mass, start, 0.01) - eigenvalue(t, alpha, mass, start, 0.02)) / 3;
}

/* The sum over the roots marked, by products of differences. */
static double complex zeta_of(const dg_operator *op, const dg_roots *roots, const int *marked,
                              double complex qbar)
{
    double complex sum = 0;
    for (int i = 0; i < DG_DEGREE; i++) {
        const double complex y = CMPLX(roots->re[i], roots->im[i]);
        double complex r = 0, product = CMPLX(op->re[DG_DEGREE], op->im[DG_DEGREE]);
        for (int k = DG_R_DEGREE; k >= 0; k--)
            r = r * y + CMPLX(op->r_re[k], op->r_im[k]);
        for (int k = 0; k < DG_DEGREE; k++)
            if (k != i)
                product *= y - CMPLX(roots->re[k], roots->im[k]);
        sum += marked[i] ? r / product : 0;
    }
    return 4 * CMPLX(0, 1) * qbar * qbar * sum;
}

static const double ALPHA = 0.5, MASS = 100, FROM_RIGHT = 0.1;

/* Roots at qbar, continued along a straight line from qbar + shift; those with Re lambda > 0 there are
 * marked. */
static double complex continued_zeta(const dg_track *t, double complex qbar, double shift)
{
    enum { STEPS = 200 };
    dg_operator op;
    dg_roots roots;
    int right[DG_DEGREE];
    dg_operator_set(&op, t, ALPHA, qbar + shift);
    ck_assert(dg_roots_cold(&roots, &op) == CV_OK && dg_roots_polish_cold(&roots, &op) == CV_OK);
    for (int i = 0; i < DG_DEGREE; i++)
        right[i] = roots.im[i] < 0; /* Re lambda > 0 */
    for (int step = 1; step <= STEPS; step++) {
        dg_operator_set(&op, t, ALPHA, qbar + shift - shift * step / STEPS);
        ck_assert_int_eq(dg_roots_polish(&roots, &op), CV_OK);
    }
    return zeta_of(&op, &roots, right, qbar);
}

/* Root of eta_M zeta = value near qbar, by the secant rule. */
static double complex characteristic_root(const dg_track *t, double complex qbar, double value)
{
    double complex last = qbar + 1e-3, f_last = MASS * continued_zeta(t, last, FROM_RIGHT) - value;
    for (int i = 0; i < 20 && cabs(qbar - last) > 1e-13; i++) {
        const double complex f = MASS * continued_zeta(t, qbar, FROM_RIGHT) - value;
        const double complex next = qbar - f * (qbar - last) / (f - f_last);
        last = qbar;
        f_last = f;
        qbar = next;
    }
    return qbar;
}

START_TEST(stable_eigenvalue)
{
    dg_track *t = track_of("6 35 300 7 0.05 0.05 0.05 0 0");
    const double complex limit = extrapolated(t, ALPHA, MASS, CMPLX(0, 0.2));
    const double complex root = characteristic_root(t, CMPLX(-0.0027, 0.2098), 1);
    printf("eigenvalue %.7f %+.7fi, root of z = 1: %.7f %+.7fi\n", creal(limit), cimag(limit), creal(root),
           cimag(root));
    fflush(stdout);
    ck_assert(cabs(MASS * continued_zeta(t, root, FROM_RIGHT) - 1) < 1e-10);
    ck_assert(cabs(limit - root) < 2e-6);
    const double complex printed = characteristic_root(t, CMPLX(-0.0027, 0.2098), 0.25);
    ck_assert(!(cabs(limit - printed) < 0.01));
    const double complex on_the_spot = CMPLX(-0.002726, 0.209815);
    ck_assert(cabs(MASS * continued_zeta(t, on_the_spot, 0) - 1) < 1e-5 && cabs(limit - on_the_spot) > 5e-4);
    dg_track_free(t);
}
END_TEST

/* Unstable mass: no continuation needed, zeta as the program has it. */
START_TEST(unstable_eigenvalues)
{
    const struct {
        const char *track;
        double alpha, mass;
        double complex start;
    } rows[] = {{"6 35 300 7 0.05 0.05 0.05 0 0", 0.9, 30, CMPLX(0.2, 0.7)},
                {"6 35 300 7 0.05 0.05 0.05 0 0", 1.4, 171, CMPLX(0.06, 0.8)},
                {"6 5 0.03 3 0.05 0.05 0.05 0 0", 0.7, 30, CMPLX(0.03, 0.15)}};
    dg_follow *follow;
    ck_assert_int_eq(dg_follow_new(&follow, NULL), CV_OK);
    for (int i = 0; i < 3; i++) {
        dg_track *t = track_of(rows[i].track);
        const double complex limit = extrapolated(t, rows[i].alpha, rows[i].mass, rows[i].start);
        dg_value v;
        ck_assert_int_eq(dg_zeta_double(&v, follow, t, rows[i].alpha, limit), CV_OK);
        printf("eigenvalue %.7f %+.7fi, z there: %.7f %+.7fi\n", creal(limit), cimag(limit),
               rows[i].mass * v.re, rows[i].mass * v.im);
        fflush(stdout);
        ck_assert(creal(limit) > 0.01 && cabs(rows[i].mass * CMPLX(v.re, v.im) - 1) < 5e-4);
        dg_track_free(t);
    }
    dg_follow_free(follow);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("outside beam");
    TCase *c = tcase_create("beam");
    tcase_set_timeout(c, 30);
    tcase_add_test(c, stable_eigenvalue);
    tcase_add_test(c, unstable_eigenvalues);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
