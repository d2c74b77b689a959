/* The response after switching on, against what does not come from an inversion: the early-time expansion of
 * a bare beam, the steady state, the roots of z = 1, and a moving-frame beam of finite differences in time.
 */
#include <check.h>
#include <gsl/gsl_errno.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "semianalytic/kernel.h"
#include "semianalytic/response.h"
#include "semianalytic/roots.h"
#include "tests/semianalytic_points.h"

static double response(double *error, const sa_track *t, sa_motion motion, double tau)
{
    sa_response *r;
    double w;
    cv_message why = {""};
    ck_assert_msg(sa_response_new(&r, t, &motion, &why) == CV_OK, "%s", why.text);
    ck_assert_int_eq(sa_response_at(&w, error, r, tau), CV_OK);
    sa_response_free(r);
    return w;
}

/* eta_p differs from the others, eta_N is not 0: all that enters the expansion */
static sa_track *early_track(void)
{
    const char *const values[6] = {"2", "10", "3", "7", "4", "0.3"};
    cv_params p;
    sa_track *track;
    cv_params_init(&p);
    set_params(&p, values, "0");
    set_damping(&p, "0.2", "0.05", "0.4");
    ck_assert_int_eq(sa_track_new(&track, &p, NULL), CV_OK);
    cv_params_clear(&p);
    return track;
}

static const double early_alpha = 0.7, early_c = 0.3 / 2 - 3 * 0.7 * 0.7 / 4 - 3 * 0.2 / 2;

/* W = qbar^(-5/2) (1 + c/qbar + O(qbar^-2)): the next term is of order tau^(7/2) */
START_TEST(force_begins_like_a_bare_beam)
{
    sa_track *t = early_track();
    double rest[2], error;
    for (int i = 0; i < 2; i++) {
        const double tau = i == 0 ? 0.02 : 0.01;
        const double w = response(&error, t, (sa_motion){early_alpha, 0, 0, tau, 0}, tau);
        rest[i] = w - pow(tau, 1.5) / tgamma(2.5) - early_c * pow(tau, 2.5) / tgamma(3.5);
        ck_assert(fabs(rest[i]) < 2 * pow(tau, 3.5) && error < 1e-12);
    }
    ck_assert(fabs(rest[0] / rest[1] - pow(2, 3.5)) < 0.3);
    sa_track_free(t);
}
END_TEST

/* W = 2/(M Q^3) / (1 + (2/M) Q^(-1/2) - (2c/M) Q^(-3/2) + ...), Q = qbar: without c the Mittag-Leffler series
 * in -(2/M) tau^(1/2); c first adds (4c/M^2) tau^(7/2)/Gamma(9/2), and what is left is of order tau^4 */
START_TEST(mass_begins_like_a_free_one)
{
    sa_track *t = early_track();
    const double mass = 2;
    double rest[2], error;
    for (int i = 0; i < 2; i++) {
        const double tau = i == 0 ? 0.02 : 0.01, ratio = 2 / mass;
        double series = ratio * ratio * early_c * pow(tau, 3.5) / tgamma(4.5);
        for (int k = 0; k < 40; k++)
            series += ratio * pow(-ratio, k) * pow(tau, 2 + k / 2.0) / tgamma(3 + k / 2.0);
        rest[i] = response(&error, t, (sa_motion){early_alpha, mass, 0, tau, 0}, tau) - series;
        ck_assert(fabs(rest[i]) < 2 * pow(tau, 4) && error < 1e-13);
    }
    ck_assert(fabs(rest[0] / rest[1] - 16) < 2);
    sa_track_free(t);
}
END_TEST

/* K(xi, 0) / pi */
static double steady(const sa_track *t, const char *alpha, const char *xi)
{
    cv_number a, q, x;
    mpc_t zeta, kernel;
    cv_number_init(&a);
    cv_number_init(&q);
    cv_number_init(&x);
    mpc_init2(zeta, 53);
    mpc_init2(kernel, 53);
    set_text(&a, alpha);
    set_text(&x, xi);
    ck_assert_int_eq(sa_kernel_digits(zeta, kernel, t, &a, &q, &x, 16, NULL), CV_OK);
    double w = mpfr_get_d(mpc_realref(kernel), MPFR_RNDN) / 3.14159265358979323846;
    cv_number_clear(&a);
    cv_number_clear(&q);
    cv_number_clear(&x);
    mpc_clear(zeta);
    mpc_clear(kernel);
    return w;
}

START_TEST(force_tends_to_the_steady_state)
{
    const char *const places[] = {"0", "1.5", "-4"};
    for (int k = 0; k < 4; k += 3) {
        sa_track *t = make_track(table1[k], "0.1");
        for (int i = 0; i < 3; i++) {
            double error, w = response(&error, t, (sa_motion){0.2, 0, atof(places[i]), 4000, 0}, 4000);
            ck_assert_msg(fabs(w - steady(t, "0.2", places[i])) < 1e-9 && error < 1e-9, "case %d xi %s: %g",
                          k + 1, places[i], w - steady(t, "0.2", places[i]));
        }
        sa_track_free(t);
    }
}
END_TEST

/* Lines at different heights pass different roots; the lowest of these passes none. */
START_TEST(lines_at_two_heights_agree)
{
    const struct {
        int table;
        const char *damping;
        sa_motion motion;
        double other;
        int roots, other_roots;
    } rows[] = {
        {0, "0.05", {0.9, 30, 0, 20, 0.03}, 0.3, 2, 0},   {0, "0.05", {0.9, 30, -2, 20, 0.03}, 0.3, 2, 0},
        {0, "0.05", {0.5, 100, 1, 20, 0.02}, 0.25, 0, 0}, {0, "0.05", {0.5, 0, 0, 20, 0.1}, 0.25, 0, 0},
        {2, "1e-10", {0.7, 30, 0, 40, 0.03}, 0.1, 2, 0},  {2, "0", {0.7, 30, 1.5, 40, 0.03}, 0.1, 2, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        sa_track *t = make_track(table1[rows[i].table], rows[i].damping);
        sa_motion low = rows[i].motion;
        sa_response *a, *b;
        low.height = rows[i].other;
        ck_assert_int_eq(sa_response_new(&a, t, &rows[i].motion, NULL), CV_OK);
        ck_assert_int_eq(sa_response_new(&b, t, &low, NULL), CV_OK);
        ck_assert_int_eq(sa_response_roots(a), rows[i].roots);
        ck_assert_int_eq(sa_response_roots(b), rows[i].other_roots);
        for (double tau = 0.1; tau <= rows[i].motion.tau_max; tau *= 1.5) {
            double wa, wb, ea, eb;
            ck_assert(sa_response_at(&wa, &ea, a, tau) == CV_OK && sa_response_at(&wb, &eb, b, tau) == CV_OK);
            ck_assert_msg(fabs(wa - wb) <= 1e-10 * fmax(1, fabs(wa)) && fabs(wa - wb) <= 20 * (ea + eb),
                          "row %zu tau %g: %g (%g, %g)", i, tau, wa - wb, ea, eb);
        }
        sa_response_free(a);
        sa_response_free(b);
        sa_track_free(t);
    }
}
END_TEST

/* qbar of the oscillation that four values at equal distances show (Prony) */
static double complex dominant(const double v[4], double distance)
{
    double det = v[1] * v[1] - v[0] * v[2];
    double sum = (v[1] * v[2] - v[0] * v[3]) / det, product = (v[2] * v[2] - v[1] * v[3]) / det;
    return clog(sum / 2 + csqrt(sum * sum / 4 - product)) / distance;
}

/* The first root of z = 1 */
static double complex root_of(const sa_track *t, const char *alpha, const char *mass)
{
    cv_number a, m;
    sa_root_list list;
    cv_number_init(&a);
    cv_number_init(&m);
    set_text(&a, alpha);
    set_text(&m, mass);
    ck_assert_int_eq(sa_roots_find(&list, t, &a, &m, 0.2, 10, NULL), CV_OK);
    ck_assert(list.decided == CV_OK && list.count > 0);
    double complex root = list.items[0].qbar;
    sa_roots_clear(&list);
    cv_number_clear(&a);
    cv_number_clear(&m);
    return root;
}

/* No residue of that root is taken: the line lies below it where the mass is unstable. */
START_TEST(late_growth_and_decay_are_the_first_root)
{
    const struct {
        int table;
        const char *alpha, *mass;
        double tau, distance, height;
    } rows[] = {{0, "0.9", "30", 60, 2, 0.25}, {2, "0.3", "300", 900, 60, 0.001}};
    for (int i = 0; i < 2; i++) {
        sa_track *t = make_track(table1[rows[i].table], "0.05");
        double v[4], error;
        for (int j = 0; j < 4; j++) {
            const double tau = rows[i].tau + j * rows[i].distance;
            const sa_motion motion = {atof(rows[i].alpha), atof(rows[i].mass), 0, tau, rows[i].height};
            v[j] = response(&error, t, motion, tau) - steady(t, rows[i].alpha, "0");
        }
        double complex seen = dominant(v, rows[i].distance), root = root_of(t, rows[i].alpha, rows[i].mass);
        ck_assert_msg(fabs(creal(seen - root)) < 1e-6 * fabs(creal(root)) &&
                          fabs(fabs(cimag(seen)) - cimag(root)) < 1e-6 * cimag(root),
                      "seen %.9g %+.9gi, root %.9g %+.9gi", creal(seen), cimag(seen), creal(root),
                      cimag(root));
        sa_track_free(t);
    }
}
END_TEST

/* The beam from -25 to 25 by central differences, second order in space, straight from (1) in dimensionless
 * form: w, u_s, u_b at each node, A0 u + A1 u' + A2 u'' = load with u' = du/dtau; and BDF2 in time. */
enum { UNKNOWNS = 3, BAND = 8, HEIGHT = 3 * BAND + 1 };
static const double LENGTH = 25;

typedef struct {
    int nodes, size;
    double h, alpha;
    double *a[3]; /* LAPACK band storage */
} mesh;

static void put(mesh *m, int power, int row, int node, int unknown, double value)
{
    const int column = node * UNKNOWNS + unknown;
    if (node >= 0 && node < m->nodes)
        m->a[power][(size_t)column * HEIGHT + (size_t)(2 * BAND + row - column)] += value;
}

/* factor d^2/dxi^2 */
static void put_second(mesh *m, int row, int node, int unknown, double factor)
{
    for (int k = -1; k <= 1; k++)
        put(m, 0, row, node + k, unknown, factor / (m->h * m->h) * (k == 0 ? -2 : 1));
}

/* factor (d/dtau - alpha d/dxi) */
static void put_rate(mesh *m, int row, int node, int unknown, double factor)
{
    put(m, 1, row, node, unknown, factor);
    put(m, 0, row, node + 1, unknown, -factor * m->alpha / (2 * m->h));
    put(m, 0, row, node - 1, unknown, factor * m->alpha / (2 * m->h));
}

/* mass (d/dtau - alpha d/dxi)^2, with the square of the difference quotient: with the usual second difference
 * sleepers and ballast, which nothing couples along xi, would grow */
static void put_inertia(mesh *m, int row, int node, int unknown, double mass)
{
    put(m, 2, row, node, unknown, mass);
    put(m, 1, row, node + 1, unknown, -mass * m->alpha / m->h);
    put(m, 1, row, node - 1, unknown, mass * m->alpha / m->h);
    for (int k = -1; k <= 1; k++)
        put(m, 0, row, node + 2 * k, unknown,
            mass * m->alpha * m->alpha / (4 * m->h * m->h) * (k == 0 ? -2 : 1));
}

/* spring and damper to another unknown of the node, or to the ground */
static void put_link(mesh *m, int node, int from, int to, double stiffness, double loss)
{
    const int row = node * UNKNOWNS + from;
    put(m, 0, row, node, from, stiffness);
    put_rate(m, row, node, from, loss);
    if (to < 0)
        return;
    put(m, 0, row, node, to, -stiffness);
    put_rate(m, row, node, to, -loss);
}

/* mu_s, mu_b, kappa_p, kappa_b, eta_s, eta_N and one damping; the mass in the middle */
static void assemble(mesh *m, const double v[6], double damping, double mass)
{
    const double binomial[5] = {1, -4, 6, -4, 1}, h4 = m->h * m->h * m->h * m->h;
    for (int j = 0; j < m->nodes; j++) {
        const int row = j * UNKNOWNS;
        for (int k = -2; k <= 2; k++)
            put(m, 0, row, j + k, 0, binomial[k + 2] / (4 * h4));
        put_second(m, row, j, 0, v[5]);
        put_inertia(m, row, j, 0, 1);
        put_link(m, j, 0, 1, v[2], 2 * damping);
        put_inertia(m, row + 1, j, 1, v[0]);
        put_link(m, j, 1, 0, v[2], 2 * damping);
        put_link(m, j, 1, 2, v[3], 2 * damping);
        put_inertia(m, row + 2, j, 2, v[1]);
        put_second(m, row + 2, j, 2, -v[4]);
        put_link(m, j, 2, 1, v[3], 2 * damping);
        put_link(m, j, 2, -1, 1, 2 * damping);
        if (j == m->nodes / 2)
            put(m, 2, row, j, 0, mass / m->h);
    }
}

/* out -= a x */
static void subtract(double *out, const mesh *m, const double *a, const double *x)
{
    for (int column = 0; column < m->size; column++)
        for (int row = column > BAND ? column - BAND : 0; row <= column + BAND && row < m->size; row++)
            out[row] -= a[(size_t)column * HEIGHT + (size_t)(2 * BAND + row - column)] * x[column];
}

/* u' = (3/2 u_n - 2 u_(n-1) + 1/2 u_(n-2)) / step, and the same again for u''; u[0] is the new one.
 * Half the load at tau = 0 makes the sum of the loads right to second order. */
static void march(mesh *m, double *u[5], int steps, double step)
{
    const double first[5] = {1.5, -2, 0.5, 0, 0}, second[5] = {2.25, -6, 5.5, -2, 0.25};
    double *lu = malloc(sizeof *lu * HEIGHT * (size_t)m->size),
           *past = malloc(sizeof *past * (size_t)m->size);
    lapack_int *pivots = malloc(sizeof *pivots * (size_t)m->size);
    ck_assert(lu != NULL && past != NULL && pivots != NULL);
    for (size_t i = 0; i < HEIGHT * (size_t)m->size; i++)
        lu[i] = m->a[0][i] + first[0] / step * m->a[1][i] + second[0] / (step * step) * m->a[2][i];
    ck_assert_int_eq(LAPACKE_dgbtrf(LAPACK_COL_MAJOR, m->size, m->size, BAND, BAND, lu, HEIGHT, pivots), 0);
    for (int n = 0; n <= steps; n++) {
        double *oldest = u[4];
        memmove(u + 1, u, 4 * sizeof *u);
        u[0] = oldest;
        memset(u[0], 0, sizeof *u[0] * (size_t)m->size);
        u[0][m->nodes / 2 * UNKNOWNS] = (n == 0 ? 1 : 2) / m->h;
        for (int power = 1; power <= 2; power++) {
            memset(past, 0, sizeof *past * (size_t)m->size);
            for (int k = 1; k < 5; k++)
                for (int i = 0; i < m->size; i++)
                    past[i] += (power == 1 ? first[k] / step : second[k] / (step * step)) * u[k][i];
            subtract(u[0], m, m->a[power], past);
        }
        ck_assert_int_eq(
            LAPACKE_dgbtrs(LAPACK_COL_MAJOR, 'N', m->size, BAND, BAND, 1, lu, HEIGHT, pivots, u[0], m->size),
            0);
    }
    free(lu);
    free(past);
    free(pivots);
}

/* w at 0 and at xi after tau, on a mesh of h and time steps of tau/steps */
static void discretised(double w[2], const double v[6], double damping, const sa_motion *motion, double tau,
                        double h, int steps)
{
    mesh m = {.nodes = 2 * (int)lround(LENGTH / h) + 1, .h = h, .alpha = motion->alpha};
    double *u[5];
    m.size = m.nodes * UNKNOWNS;
    for (int i = 0; i < 3; i++)
        ck_assert_ptr_nonnull(m.a[i] = calloc(HEIGHT * (size_t)m.size, sizeof *m.a[i]));
    for (int i = 0; i < 5; i++)
        ck_assert_ptr_nonnull(u[i] = calloc((size_t)m.size, sizeof *u[i]));
    assemble(&m, v, damping, motion->mass_ratio);
    march(&m, u, steps, tau / steps);
    w[0] = u[0][m.nodes / 2 * UNKNOWNS];
    w[1] = u[0][(m.nodes / 2 + (int)lround(motion->xi / h)) * UNKNOWNS];
    for (int i = 0; i < 3; i++)
        free(m.a[i]);
    for (int i = 0; i < 5; i++)
        free(u[i]);
}

/* Halving mesh and step together divides the error by about four; extrapolated it is far below that. */
START_TEST(finite_differences_in_time_agree)
{
    const char *const tracks[3][6] = {{"6", "35", "30", "7", "0", "0"},
                                      {"6", "5", "0.03", "3", "0", "0"},
                                      {"2", "10", "30", "7", "5", "0.3"}};
    const sa_motion motions[3] = {{0.5, 3, -1.2, 5, 0}, {0.7, 0, 0.8, 5, 0}, {0.9, 10, 1.2, 5, 0}};
    for (int i = 0; i < 3; i++) {
        sa_track *t = make_track(tracks[i], "0.1");
        double v[6], coarse[2], fine[2], error;
        for (int k = 0; k < 6; k++)
            v[k] = atof(tracks[i][k]);
        discretised(coarse, v, 0.1, &motions[i], 5, 0.05, 400);
        discretised(fine, v, 0.1, &motions[i], 5, 0.025, 800);
        for (int k = 0; k < 2; k++) {
            sa_motion motion = motions[i];
            motion.xi *= k;
            const double w = response(&error, t, motion, 5), limit = fine[k] + (fine[k] - coarse[k]) / 3;
            printf("w %.8f, differences %.8f %.8f, extrapolated %.8f\n", w, coarse[k], fine[k], limit);
            fflush(stdout);
            ck_assert(fabs(limit - w) < 1.5e-4 * fabs(w) && fabs(fine[k] - w) < 0.01 * fabs(w));
            ck_assert(fabs(fine[k] - w) < 0.4 * fabs(coarse[k] - w) || fabs(coarse[k] - w) < 1e-5);
        }
        sa_track_free(t);
    }
}
END_TEST

/* Far from the load and early, waves on a free beam: w = (8/pi) (integral over p > 0 of (1 - cos(p^2 tau/2))
 * cos(p xi) / p^4), by the trapezoidal rule; the soft pads of case 3 change the phase by 1e-4 only. There K
 * is tiny until waves begin. */
START_TEST(far_waves_are_those_of_a_free_beam)
{
    enum { POINTS = 1000000 };
    const double xi = 20, tau = 0.2, h = 1e-3;
    double sum = tau * tau / 16, error; /* half the value at p = 0 */
    sa_track *t = make_track(table1[0], "0");
    for (int i = 1; i < POINTS; i++) {
        const double p = i * h;
        sum += (1 - cos(p * p * tau / 2)) * cos(p * xi) / (p * p * p * p);
    }
    const double free_beam = 8 / 3.14159265358979323846 * h * sum;
    const double w = response(&error, t, (sa_motion){0, 0, xi, tau, 0}, tau);
    ck_assert_msg(fabs(w - free_beam) < 0.1 * fabs(free_beam), "%g, free beam %g", w, free_beam);
    sa_track_free(t);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    sa_track *t = make_track(table1[0], "0.1");
    const sa_motion bad[] = {{-1, 1, 0, 1, 0}, {1, -1, 0, 1, 0}, {1, 1, NAN, 1, 0},
                             {1, 1, 0, 0, 0},  {1, 1, 0, 1, -1}, {NAN, 1, 0, 1, 0}};
    sa_response *r;
    double w, error;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        ck_assert_int_eq(sa_response_new(&r, t, &bad[i], NULL), CV_BAD_INPUT);
    ck_assert_int_eq(sa_response_new(&r, t, &(sa_motion){1, 1, 0, 1, 0}, NULL), CV_OK);
    ck_assert_int_eq(sa_response_at(&w, &error, r, -1), CV_BAD_INPUT);
    ck_assert_int_eq(sa_response_at(&w, &error, r, NAN), CV_BAD_INPUT);
    sa_response_free(r);
    sa_track_free(t);
}
END_TEST

int main(void)
{
    gsl_set_error_handler_off();
    Suite *suite = suite_create("semianalytic response");
    TCase *c = tcase_create("response");
    tcase_set_timeout(c, 30);
    tcase_add_test(c, force_begins_like_a_bare_beam);
    tcase_add_test(c, mass_begins_like_a_free_one);
    tcase_add_test(c, force_tends_to_the_steady_state);
    tcase_add_test(c, lines_at_two_heights_agree);
    tcase_add_test(c, late_growth_and_decay_are_the_first_root);
    tcase_add_test(c, finite_differences_in_time_agree);
    tcase_add_test(c, far_waves_are_those_of_a_free_beam);
    tcase_add_test(c, bad_arguments_are_refused);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
