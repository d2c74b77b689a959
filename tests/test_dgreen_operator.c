/* Delta and R of dgreen/operator.h against the matrix (7), against (17) as printed, and in two precisions. */
#include <check.h>
#include <math.h>

#include "dgreen/operator_mp.h"
#include "tests/dgreen_points.h"

static gsl_rng *rng;

static void setup(void)
{
    rng = random_start("test_dgreen_operator", 20240301);
}

static void teardown(void)
{
    gsl_rng_free(rng);
}

static double complex random_complex(double low, double high)
{
    const double angle = 2 * M_PI * gsl_rng_uniform(rng), modulus = log_uniform(rng, low, high);
    return modulus * CMPLX(cos(angle), sin(angle));
}

/* sum c[k] y^k, and the same of the sizes at |y| */
static double complex horner(double *size, const double *re, const double *im, const double *sizes,
                             int degree, double complex y)
{
    double complex sum = 0;
    *size = 0;
    for (int k = degree; k >= 0; k--) {
        sum = sum * y + CMPLX(re[k], im[k]);
        *size = *size * cabs(y) + sizes[k];
    }
    return sum;
}

/* Delta = 4 d3 and R = d2 at lambda = i p, for any complex p and qbar (p = y). */
START_TEST(delta_is_four_times_the_determinant)
{
    for (int i = 0; i < 3000; i++) {
        dg_track *t = random_damped_track(rng);
        const double alpha = log_uniform(rng, 0.02, 2);
        const double complex qbar = random_complex(1e-3, 10), y = random_complex(1e-2, 30);
        const matrix_7 m = matrix_at(t, alpha, qbar, y);
        dg_operator op;
        dg_operator_set(&op, t, alpha, qbar);
        double size, r_size;
        const double complex delta = horner(&size, op.re, op.im, op.size, DG_DEGREE, y);
        const double complex r = horner(&r_size, op.r_re, op.r_im, op.r_size, DG_R_DEGREE, y);
        /* The matrix form cancels up to kappa_p kappa_b/1 = 5e8 of its terms, in long double. */
        ck_assert_msg(cabsl(delta - 4 * m.d3) <= 1e-13L * (long double)size + 1e-9L * cabsl(m.d3),
                      "Delta at %d", i);
        ck_assert_msg(cabsl(r - m.d2) <= 1e-13L * (long double)r_size + 1e-9L * cabsl(m.d2), "R at %d", i);
        dg_track_free(t);
    }
}
END_TEST

/* (17) with D_xi = lambda. "literal" takes the print at its word: 8 alpha s D_xi with s = qbar - alpha D_xi,
 * and L_32 = L_{xi,s,23}, that is, s in the place of qbar. */
static void entries_17(double complex l[6], const dg_track *t, double alpha, double complex q,
                       double complex D, int literal_11)
{
    const double complex s = q - alpha * D;
    l[0] = cpow(D, 4) + 4 * (t->eta_N + alpha * alpha) * D * D + 4 * q * q -
           8 * alpha * (literal_11 ? s : q) * D - 8 * alpha * t->eta_p * D + 8 * t->eta_p * q +
           4 * t->kappa_p;
    l[1] = 8 * alpha * t->eta_p * D - 8 * t->eta_p * q - 4 * t->kappa_p;
    l[2] = 2 * alpha * t->eta_p * D - 2 * t->eta_p * q - t->kappa_p;
    l[3] = alpha * alpha * t->mu_s * D * D + t->mu_s * q * q - 2 * alpha * t->mu_s * q * D -
           2 * alpha * (t->eta_p + t->eta_b) * D + 2 * (t->eta_p + t->eta_b) * q + t->kappa_p + t->kappa_b;
    l[4] = 2 * alpha * t->eta_b * D - 2 * t->eta_b * q - t->kappa_b;
    l[5] = (alpha * alpha * t->mu_b - t->eta_s) * D * D + t->mu_b * q * q - 2 * alpha * t->mu_b * q * D -
           2 * alpha * (t->eta_b + t->eta_f) * D + 2 * (t->eta_b + t->eta_f) * q + t->kappa_b + 1;
}

static double complex determinant_17(const dg_track *t, double alpha, double complex q, double complex D,
                                     int literal_11, int literal_32)
{
    double complex l[6], shifted[6];
    entries_17(l, t, alpha, q, D, literal_11);
    entries_17(shifted, t, alpha, q - alpha * D, D, 0);
    const double complex l32 = literal_32 ? shifted[4] : l[4];
    return l[0] * (l[3] * l[5] - l[4] * l32) - l[1] * l[2] * l[5];
}

/* (19), (21): Delta = det of (16) with (17) corrected; the two misprints change it. */
START_TEST(print_of_17)
{
    dg_track *t = track_of("6 35 300 7 0.05 0.04 0.03 2 -0.3");
    for (int i = 0; i < 100; i++) {
        const double alpha = log_uniform(rng, 0.1, 1);
        const double complex qbar = random_complex(0.1, 1), lambda = random_complex(0.3, 3);
        dg_operator op;
        dg_operator_set(&op, t, alpha, qbar);
        double size;
        const double complex delta = horner(&size, op.re, op.im, op.size, DG_DEGREE, lambda / CMPLX(0, 1));
        ck_assert(cabs(delta - determinant_17(t, alpha, qbar, lambda, 0, 0)) < 1e-10 * size);
        ck_assert(cabs(delta - determinant_17(t, alpha, qbar, lambda, 1, 0)) > 1e-6 * size);
        ck_assert(cabs(delta - determinant_17(t, alpha, qbar, lambda, 0, 1)) > 1e-8 * size);
    }
    dg_track_free(t);
}
END_TEST

/* a0 = c[8] = alpha^2 mu_s (alpha^2 mu_b - eta_s); at alpha = 0 the degree is 6, or 4 where eta_s = 0. */
START_TEST(leading_coefficient)
{
    dg_track *shear = track_of("3 20 200 40 0.01 0.02 1e-5 5 -0.4"),
             *plain = track_of("3 20 200 40 0 0 0 0 0");
    dg_operator op;
    dg_operator_set(&op, shear, 0.75, CMPLX(0.1, 0.2));
    ck_assert_double_eq_tol(op.re[8], 0.75 * 0.75 * 3 * (0.75 * 0.75 * 20 - 5), 1e-13);
    ck_assert_int_eq(op.degree, 8);
    dg_operator_set(&op, shear, 0.5, CMPLX(0, 0.2));
    ck_assert(op.re[8] == 0 && op.relative_a0 == 0);
    dg_operator_set(&op, shear, 0, CMPLX(0, 0.2));
    ck_assert_int_eq(op.degree, 6);
    ck_assert(op.re[6] != 0 && op.re[7] == 0 && op.re[8] == 0);
    dg_operator_set(&op, plain, 0, CMPLX(0, 0.2));
    ck_assert_int_eq(op.degree, 4);
    ck_assert(op.re[4] != 0 && op.re[5] == 0 && op.re[6] == 0);
    dg_track_free(shear);
    dg_track_free(plain);
}
END_TEST

/* The bound of the header: 72 units of the size of each part (the doubles alpha and qbar are exact here). */
static void check_coefficient(int k, double part, double size, mpfr_srcptr exact)
{
    mpfr_t error;
    mpfr_init2(error, 200);
    mpfr_sub_d(error, exact, part, MPFR_RNDN);
    ck_assert_msg(fabs(mpfr_get_d(error, MPFR_RNDN)) <= 72 * 0x1p-53 * size, "coefficient %d", k);
    mpfr_clear(error);
}

START_TEST(rounding_of_coefficients)
{
    dg_mp_operator exact;
    dg_constants constants;
    mpfr_t alpha;
    mpc_t qbar;
    dg_mp_operator_init(&exact, 255);
    mpfr_init2(alpha, 255);
    mpc_init2(qbar, 255);
    for (int i = 0; i < 1000; i++) {
        dg_track *t = random_damped_track(rng);
        const double complex point = i % 2 ? random_complex(1e-3, 10) : CMPLX(0, log_uniform(rng, 1e-3, 10));
        mpfr_set_d(alpha, log_uniform(rng, 0.02, 2), MPFR_RNDN);
        mpc_set_d_d(qbar, creal(point), cimag(point), MPC_RNDNN);
        dg_constants_init(&constants, t, 255);
        dg_mp_operator_set(&exact, t, &constants, alpha, qbar);
        dg_operator in_double;
        const dg_operator *op = &in_double;
        dg_operator_set(&in_double, t, mpfr_get_d(alpha, MPFR_RNDN), point);
        for (int k = 0; k <= DG_DEGREE; k++) {
            check_coefficient(k, op->re[k], op->size_re[k], mpc_realref(exact.delta.c[k]));
            check_coefficient(k, op->im[k], op->size_im[k], mpc_imagref(exact.delta.c[k]));
        }
        for (int k = 0; k <= DG_R_DEGREE; k++) {
            check_coefficient(k, op->r_re[k], op->r_size_re[k], mpc_realref(exact.r.c[k]));
            check_coefficient(k, op->r_im[k], op->r_size_im[k], mpc_imagref(exact.r.c[k]));
        }
        dg_constants_clear(&constants);
        dg_track_free(t);
    }
    mpc_clear(qbar);
    mpfr_clear(alpha);
    dg_mp_operator_clear(&exact);
}
END_TEST

/* qbar = i q without damping: real coefficients, exactly, in both precisions. */
START_TEST(undamped_coefficients_are_real)
{
    dg_track *t = track_of("3.3 10 200 40 0 0 0 5 -0.4");
    dg_mp_operator exact;
    mpfr_t alpha;
    mpc_t qbar;
    dg_mp_operator_init(&exact, dg_ladder[0]);
    mpfr_init2(alpha, 127);
    mpc_init2(qbar, 127);
    mpfr_set_d(alpha, 0.3, MPFR_RNDN);
    mpc_set_d_d(qbar, 0, 0.7, MPC_RNDNN);
    dg_mp_operator_set(&exact, t, &t->ladder[0], alpha, qbar);
    for (int k = 0; k <= DG_DEGREE; k++) {
        ck_assert(exact.rounded.im[k] == 0 && exact.rounded.size_im[k] == 0);
        ck_assert(mpfr_zero_p(mpc_imagref(exact.delta.c[k])));
    }
    mpc_clear(qbar);
    mpfr_clear(alpha);
    dg_mp_operator_clear(&exact);
    dg_track_free(t);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen operator");
    TCase *c = tcase_create("operator");
    tcase_add_checked_fixture(c, setup, teardown);
    tcase_add_test(c, delta_is_four_times_the_determinant);
    tcase_add_test(c, print_of_17);
    tcase_add_test(c, leading_coefficient);
    tcase_add_test(c, rounding_of_coefficients);
    tcase_add_test(c, undamped_coefficients_are_real);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
