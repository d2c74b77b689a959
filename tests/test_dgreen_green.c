/* Green's function (28) by its definition: Delta G = delta(xi - eps) and G -> 0; the deflection (24) made of
 * it. */
#include <check.h>
#include <float.h>
#include <math.h>

#include "dgreen/green.h"
#include "dgreen/z.h"
#include "tests/dgreen_points.h"

static gsl_rng *rng;
static dg_follow *follow;

static void setup(void)
{
    rng = random_start("test_dgreen_green", 20240303);
    ck_assert_int_eq(dg_follow_new(&follow, NULL), CV_OK);
}

static void teardown(void)
{
    gsl_rng_free(rng);
    dg_follow_free(follow);
}

/* Sum of the moduli of the terms of a derivative at distance 0: what rounding is relative to. Roots that
 * nearly coincide make the terms large. */
static double scale_of(const dg_green *g, int order)
{
    double sum = 0;
    for (int i = 0; i < g->count; i++)
        sum += cabs(g->weight[i]) * pow(cabs(g->lambda[i]), order);
    return sum;
}

static dg_green random_green(void)
{
    dg_green g;
    for (;;) {
        dg_track *t = random_damped_track(rng);
        double alpha, q;
        random_point(&alpha, &q, t, rng);
        const double sigma = gsl_rng_uniform_int(rng, 2) ? 0 : log_uniform(rng, 1e-3, 1);
        const cv_status status = dg_green_set(&g, t, alpha, CMPLX(sigma, q));
        dg_track_free(t);
        if (status == CV_OK)
            return g;
        ck_assert_int_eq(status, CV_UNDECIDED);
    }
}

/* Derivatives 0 ... 6 are continuous at xi = eps, the 7th jumps by 1/a0. (At the degree drop, count 7, 0 ...
 * 5 are and the 6th jumps by 1/a1.) */
START_TEST(jump_conditions)
{
    for (int i = 0; i < 2000; i++) {
        const dg_green g = random_green();
        for (int order = 0; order < g.count; order++) {
            const double complex jump =
                dg_green_derivative(&g, order, 0, DG_AFTER) - dg_green_derivative(&g, order, 0, DG_BEFORE);
            const double complex expected = order == g.count - 1 ? 1 / g.a0 : 0;
            /* the roots are within a few hundred units of exact, the weights as much as clusters make of it
             */
            ck_assert_msg(cabs(jump - expected) <= 1e-6 * scale_of(&g, order), "order %d, jump %g of %g",
                          order, cabs(jump - expected), scale_of(&g, order));
        }
    }
}
END_TEST

/* At an ordinary point the jumps are right to 12 digits. */
START_TEST(jump_conditions_to_rounding)
{
    dg_track *t = track_of("6 35 300 7 0.05 0.04 0.03 2 -0.3");
    dg_green g;
    ck_assert_int_eq(dg_green_set(&g, t, 0.5, CMPLX(0, 0.2)), CV_OK);
    ck_assert_int_eq(g.right_count, 6);
    const double complex top =
        dg_green_derivative(&g, 7, 0, DG_AFTER) - dg_green_derivative(&g, 7, 0, DG_BEFORE);
    ck_assert(cabs(top * g.a0 - 1) < 1e-11);
    ck_assert_double_eq_tol(creal(g.a0), 0.25 * 6 * (0.25 * 35 - 2), 1e-12);
    dg_track_free(t);
}
END_TEST

/* Delta G = 0 away from eps: coefficients from the matrix (7), Delta(lambda) = 4 d3(-i lambda). */
START_TEST(solves_the_equation)
{
    for (int i = 0; i < 500; i++) {
        dg_track *t = random_damped_track(rng);
        const double alpha = log_uniform(rng, 0.1, 1.5), q = log_uniform(rng, 0.05, 2);
        dg_green g;
        if (dg_green_set(&g, t, alpha, CMPLX(0, q)) != CV_OK) {
            dg_track_free(t);
            continue;
        }
        dg_operator op;
        dg_operator_set(&op, t, alpha, CMPLX(0, q));
        for (int before = 0; before < 2; before++) {
            const double distance = (before ? -1 : 1) * log_uniform(rng, 0.01, 3);
            double complex sum = 0;
            double size = 0;
            for (int k = 0; k <= g.count; k++) { /* y = -i D */
                const double complex derivative = dg_green_derivative(&g, k, distance, DG_AFTER);
                sum += CMPLX(op.re[k], op.im[k]) * cpow(CMPLX(0, -1), k) * derivative;
                size += op.size[k] * scale_of(&g, k);
            }
            ck_assert(cabs(sum) <= 1e-10 * size);
        }
        dg_track_free(t);
    }
}
END_TEST

/* G -> 0 on both sides: no term grows. */
START_TEST(decays_on_both_sides)
{
    dg_track *t = track_of("6 35 300 7 0.05 0.05 0.05 0 0");
    dg_green g;
    ck_assert_int_eq(dg_green_set(&g, t, 0.5, CMPLX(0, 0.2)), CV_OK);
    ck_assert(cabs(dg_green_derivative(&g, 0, -1e4, DG_AFTER)) < 1e-9 * scale_of(&g, 0));
    ck_assert(cabs(dg_green_derivative(&g, 0, 1e4, DG_AFTER)) < 1e-9 * scale_of(&g, 0));
    dg_track_free(t);
}
END_TEST

/* The Fourier image of W for a unit right-hand side of (7) is d2/d3. A term c exp(lambda xi) on its half-line
 * has the image c/(ip - lambda) after the force and -c/(ip - lambda) before it. */
START_TEST(deflection_has_the_fourier_image_of_the_matrix)
{
    dg_track *t = track_of("3.3 10 200 40 0.01 0.02 0.03 5 -0.4");
    const double alphas[] = {0.2, 0.5, 0.9, 1.4};
    for (int i = 0; i < 4; i++) {
        const double complex qbar = CMPLX(0.1 * i, 0.4);
        dg_green g;
        ck_assert_int_eq(dg_green_set(&g, t, alphas[i], qbar), CV_OK);
        for (double p = -3; p < 3; p += 0.37) {
            double complex image = 0;
            for (int k = 0; k < g.count; k++) {
                double complex r = 0;
                for (int j = DG_R_DEGREE; j >= 0; j--)
                    r = r * g.lambda[k] + g.r[j];
                image += 4 * r * -g.weight[k] / (CMPLX(0, p) - g.lambda[k]);
            }
            const matrix_7 m = matrix_at(t, alphas[i], qbar, p);
            ck_assert(cabs(image - (double complex)(m.d2 / m.d3)) < 1e-10 * cabs(image));
        }
    }
    dg_track_free(t);
}
END_TEST

/* (25): W(0)/(right-hand side of (7)) = -zeta/qbar^2, by products of differences here, by Delta' and with
 * bounds in dgreen/z.h; and W is continuous at 0. */
START_TEST(deflection_at_zero_is_zeta)
{
    for (int i = 0; i < 300; i++) {
        dg_track *t = random_damped_track(rng);
        const double alpha = log_uniform(rng, 0.1, 1.5), q = log_uniform(rng, 0.05, 2);
        const double complex qbar = CMPLX(0, q);
        dg_green g;
        dg_value v;
        if (dg_green_set(&g, t, alpha, qbar) == CV_OK &&
            dg_zeta_double(&v, follow, t, alpha, qbar) == CV_OK) {
            const double complex w = dg_green_deflection(&g, -0.0), zeta = CMPLX(v.re, v.im);
            ck_assert(cabs(-w * qbar * qbar - zeta) <= 1e-6 * cabs(zeta));
            ck_assert(cabs(dg_green_deflection(&g, 1e-9) - dg_green_deflection(&g, -1e-9)) <= 1e-5 * cabs(w));
        }
        dg_track_free(t);
    }
}
END_TEST

/* The resting track under a static unit force, 2 eta_C = 2 in (7): a Winkler beam on three springs in series,
 * of stiffness k = 1/(1 + 1/kappa_p + 1/kappa_b) against the foundation's 1, deflects by k^(-3/4) under the
 * force, in units of w_st; stiff pads and ballast make it 1. Away from it: exp(-r)(cos r + sin r), r =
 * k^(1/4) |xi|. */
START_TEST(static_winkler_limit)
{
    const char *tracks[] = {"6 35 300 7 0.05 0.05 0.05 0 0", "6 35 0.03 0.1 1e-10 1e-10 1e-10 0 0",
                            "6 35 1e12 1e12 0.01 0.01 0.01 0 0"};
    for (int i = 0; i < 3; i++) {
        dg_track *t = track_of(tracks[i]);
        dg_green g;
        const double k = 1 / (1 + 1 / t->kappa_p + 1 / t->kappa_b);
        ck_assert_int_eq(dg_green_set(&g, t, 0, CMPLX(1e-9, 0)), CV_OK);
        ck_assert_double_eq_tol(creal(2 * dg_green_deflection(&g, 0)), pow(k, -0.75), 1e-7 * pow(k, -0.75));
        for (double xi = -3; xi < 3; xi += 0.7) {
            const double r = pow(k, 0.25) * fabs(xi), w = pow(k, -0.75) * exp(-r) * (cos(r) + sin(r));
            ck_assert_double_eq_tol(creal(2 * dg_green_deflection(&g, xi)), w, 1e-7 * pow(k, -0.75));
        }
        dg_track_free(t);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen green");
    TCase *c = tcase_create("green");
    tcase_add_checked_fixture(c, setup, teardown);
    tcase_add_test(c, jump_conditions);
    tcase_add_test(c, jump_conditions_to_rounding);
    tcase_add_test(c, solves_the_equation);
    tcase_add_test(c, decays_on_both_sides);
    tcase_add_test(c, deflection_has_the_fourier_image_of_the_matrix);
    tcase_add_test(c, deflection_at_zero_is_zeta);
    tcase_add_test(c, static_winkler_limit);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
