/* Roots and inclusion discs on manufactured polynomials: roots are prescribed, close together, double, next
 * to the real axis of y or far out, and every disc must hold the one that belongs there. */
#include <check.h>
#include <math.h>

#include "dgreen/roots_mp.h"
#include "tests/dgreen_points.h"

static gsl_rng *rng;

static void setup(void)
{
    rng = random_start("test_dgreen_roots", 20240302);
}

static void teardown(void)
{
    gsl_rng_free(rng);
}

/* product of (y - roots[i]), with sizes; far > 0: the last factor is 1 - y roots[7] instead. */
static void manufacture(dg_operator *op, const double complex roots[DG_DEGREE], int far)
{
    memset(op, 0, sizeof *op);
    op->degree = DG_DEGREE;
    op->relative_a0 = far ? 1e-3 : 1;
    op->re[0] = op->size_re[0] = 1;
    for (int i = 0; i < DG_DEGREE; i++) {
        const int last = far && i == DG_DEGREE - 1;
        const double complex up = last ? -roots[i] : 1, stay = last ? 1 : -roots[i];
        for (int k = i + 1; k >= 0; k--) {
            const double complex here = CMPLX(op->re[k], op->im[k]);
            const double complex below = k > 0 ? CMPLX(op->re[k - 1], op->im[k - 1]) : 0;
            const double complex c = here * stay + below * up;
            const double re = op->size_re[k] * fabs(creal(stay)) + op->size_im[k] * fabs(cimag(stay));
            const double im = op->size_re[k] * fabs(cimag(stay)) + op->size_im[k] * fabs(creal(stay));
            const double lower_re = k > 0 ? op->size_re[k - 1] : 0, lower_im = k > 0 ? op->size_im[k - 1] : 0;
            op->re[k] = creal(c);
            op->im[k] = cimag(c);
            op->size_re[k] = re + lower_re * fabs(creal(up)) + lower_im * fabs(cimag(up));
            op->size_im[k] = im + lower_re * fabs(cimag(up)) + lower_im * fabs(creal(up));
        }
    }
    for (int k = 0; k <= DG_DEGREE; k++)
        op->size[k] = op->size_re[k] + op->size_im[k];
}

/* Every prescribed root in exactly one disc, and within radius_im of its centre. */
static void check_discs(const dg_roots *found, const dg_discs *discs, const double complex roots[DG_DEGREE])
{
    for (int i = 0; i < DG_DEGREE; i++) {
        int holders = 0;
        for (int k = 0; k < DG_DEGREE; k++) {
            const double complex error = CMPLX(found->re[k], found->im[k]) - roots[i];
            if ((found->far && k == DG_DEGREE - 1) != (found->far && i == DG_DEGREE - 1) ||
                !(cabs(error) <= discs->radius[k] * 0x1p-53))
                continue;
            holders++;
            ck_assert(fabs(cimag(error)) <= discs->radius_im[k] * 0x1p-53);
        }
        ck_assert_msg(holders == 1, "root %g%+gi is in %d discs", creal(roots[i]), cimag(roots[i]), holders);
    }
}

static cv_status solve(dg_roots *found, dg_discs *discs, const dg_operator *op)
{
    if (dg_roots_cold(found, op) != CV_OK)
        return CV_FAILED;
    return dg_roots_polish_cold(found, op) == CV_OK ? dg_roots_enclose(discs, found, op) : CV_UNDECIDED;
}

/* Scattered roots; the second next to the first at distance "gap"; the third next to the real axis. */
static void scatter(double complex roots[DG_DEGREE], double gap, double off_axis)
{
    for (int i = 0; i < DG_DEGREE; i++) {
        const double angle = 2 * M_PI * (i + 0.6 * gsl_rng_uniform(rng)) / DG_DEGREE;
        const double modulus = log_uniform(rng, 0.5, 2);
        roots[i] = modulus * CMPLX(cos(angle), sin(angle));
    }
    roots[1] = roots[0] + gap * CMPLX(0.6, 0.8);
    roots[2] = CMPLX(log_uniform(rng, 3, 4), -off_axis);
}

/* The products that make the coefficients round; the discs account for it. */
START_TEST(discs_hold_prescribed_roots)
{
    int decided = 0;
    for (int i = 0; i < 5000; i++) {
        double complex roots[DG_DEGREE];
        dg_operator op;
        dg_roots found;
        dg_discs discs;
        const double gap = log_uniform(rng, 1e-9, 0.3);
        scatter(roots, gap, log_uniform(rng, 1e-16, 1e-2));
        manufacture(&op, roots, 0);
        const cv_status status = solve(&found, &discs, &op);
        ck_assert(status == CV_OK || (status == CV_UNDECIDED && gap < 1e-3));
        if (status == CV_OK) {
            check_discs(&found, &discs, roots);
            decided++;
        }
    }
    ck_assert_int_gt(decided, 2500);
}
END_TEST

/* All roots near the real axis at 1e-10 and with real parts well apart: the half-plane of each is decided,
 * which the disc alone, of radius 1e-12 and more, does by little and the bound of the imaginary part with
 * digits to spare. */
START_TEST(half_planes_near_the_axis)
{
    for (int i = 0; i < 1000; i++) {
        double complex roots[DG_DEGREE];
        dg_operator op;
        dg_roots found;
        dg_discs discs;
        for (int k = 0; k < DG_DEGREE; k++)
            roots[k] = CMPLX(k - 3.5 + 0.3 * gsl_rng_uniform(rng), (k % 3 ? -1e-10 : 1e-10) * (1 + k));
        manufacture(&op, roots, 0);
        ck_assert_int_eq(solve(&found, &discs, &op), CV_OK);
        check_discs(&found, &discs, roots);
        for (int k = 0; k < DG_DEGREE; k++)
            ck_assert(fabs(found.im[k]) > 1e3 * discs.radius_im[k] * 0x1p-53);
    }
}
END_TEST

/* Delta' at the approximations, in long double, is within the rounding bounds of its parts. */
START_TEST(rounding_of_the_derivative)
{
    for (int i = 0; i < 1000; i++) {
        double complex roots[DG_DEGREE];
        dg_operator op;
        dg_roots found;
        dg_discs discs;
        for (int k = 0; k < DG_DEGREE; k++)
            roots[k] = CMPLX(k - 3.5 + 0.3 * gsl_rng_uniform(rng), -log_uniform(rng, 1e-14, 1e-3));
        manufacture(&op, roots, 0);
        ck_assert_int_eq(solve(&found, &discs, &op), CV_OK);
        for (int k = 0; k < DG_DEGREE; k++) {
            const long double complex y = CMPLX(found.re[k], found.im[k]);
            long double complex slope = 0;
            for (int n = DG_DEGREE; n >= 1; n--)
                slope = slope * y + n * (long double complex)CMPLX(op.re[n], op.im[n]);
            ck_assert(discs.flat[k]);
            /* 72 units of the coefficients are not rounding here */
            ck_assert(fabsl(discs.d_re[k] - creall(slope)) <= discs.rounding_re[k] * 58 / 130 * 0x1p-53);
            ck_assert(fabsl(discs.d_im[k] - cimagl(slope)) <= discs.rounding_im[k] * 58 / 130 * 0x1p-53);
        }
    }
}
END_TEST

/* A double root (of 2^-2 multiples, so that all coefficients are exact) has no disjoint discs. */
START_TEST(double_root_is_undecided)
{
    const double complex roots[DG_DEGREE] = {1.25,  1.25,           CMPLX(0.5, 2), CMPLX(0.5, -2),
                                             -1.75, CMPLX(-2, 0.5), -3.25,         CMPLX(0, -1.5)};
    dg_operator op;
    dg_roots found;
    dg_discs discs;
    manufacture(&op, roots, 0);
    ck_assert_int_eq(solve(&found, &discs, &op), CV_UNDECIDED);
}
END_TEST

/* One root at 1/u, u small or exactly 0, is kept as u. */
START_TEST(root_through_infinity)
{
    for (int i = 0; i < 1000; i++) {
        double complex roots[DG_DEGREE];
        dg_operator op;
        dg_roots found;
        dg_discs discs;
        scatter(roots, 0.1, 1e-6);
        roots[7] = i % 10 == 0 ? 0 : log_uniform(rng, 1e-18, 1e-3) * CMPLX(0.8, 0.6);
        manufacture(&op, roots, 1);
        ck_assert_int_eq(solve(&found, &discs, &op), CV_OK);
        ck_assert_int_eq(found.far, 1);
        check_discs(&found, &discs, roots);
    }
}
END_TEST

/* Warm: continued from the roots of another polynomial. */
START_TEST(continuation_finds_the_same_roots)
{
    for (int i = 0; i < 1000; i++) {
        double complex roots[DG_DEGREE], moved[DG_DEGREE];
        dg_operator op;
        dg_roots found;
        dg_discs discs;
        scatter(roots, 0.1, 1e-6);
        memcpy(moved, roots, sizeof moved);
        for (int k = 0; k < DG_DEGREE; k++)
            moved[k] += log_uniform(rng, 1e-8, 0.1) * CMPLX(0.6, -0.8);
        manufacture(&op, roots, 0);
        ck_assert_int_eq(solve(&found, &discs, &op), CV_OK);
        manufacture(&op, moved, 0);
        ck_assert_int_eq(dg_roots_polish(&found, &op), CV_OK);
        ck_assert_int_eq(dg_roots_enclose(&discs, &found, &op), CV_OK);
        check_discs(&found, &discs, moved);
    }
}
END_TEST

/* product of (y - roots[i]) at the operator's precision; roots are double plus 2^-shift for the second */
static void manufacture_mp(dg_mp_operator *op, const double complex roots[DG_DEGREE], long shift,
                           mpc_t second)
{
    manufacture(&op->rounded, roots, 0);
    mpc_t root, term;
    mpc_init2(root, op->precision);
    mpc_init2(term, op->precision);
    for (int k = 0; k <= DG_DEGREE; k++)
        mpc_set_ui(op->delta.c[k], k == 0, MPC_RNDNN);
    for (int i = 0; i < DG_DEGREE; i++) {
        mpc_set_d_d(root, creal(roots[i]), cimag(roots[i]), MPC_RNDNN);
        if (i == 1) {
            mpc_set_ui(term, 1, MPC_RNDNN);
            mpc_div_2ui(term, term, (unsigned long)shift, MPC_RNDNN);
            mpc_add(root, root, term, MPC_RNDNN);
            mpc_set(second, root, MPC_RNDNN);
        }
        for (int k = i + 1; k >= 0; k--) {
            mpc_mul(op->delta.c[k], op->delta.c[k], root, MPC_RNDNN);
            mpc_neg(op->delta.c[k], op->delta.c[k], MPC_RNDNN);
            if (k > 0)
                mpc_add(op->delta.c[k], op->delta.c[k], op->delta.c[k - 1], MPC_RNDNN);
        }
    }
    mpc_clear(root);
    mpc_clear(term);
}

static cv_status solve_pair(dg_mp_roots *found, mpc_t second, mpfr_prec_t precision, long shift)
{
    const double complex roots[DG_DEGREE] = {1.25,  1.25,           CMPLX(0.5, 2), CMPLX(0.5, -2),
                                             -1.75, CMPLX(-2, 0.5), -3.25,         CMPLX(0, -1.5)};
    dg_mp_operator op;
    dg_roots start;
    dg_mp_operator_init(&op, precision);
    manufacture_mp(&op, roots, shift, second);
    ck_assert_int_eq(dg_roots_cold(&start, &op.rounded), CV_OK);
    const cv_status status = dg_mp_roots_find(found, &op, &start, 0);
    dg_mp_operator_clear(&op);
    return status;
}

/* Two roots 2^-30 apart separate at 127 bits, 2^-60 apart at 191 bits and not at 127, and a double root
 * never; the iteration starts from double values in which they are one. */
START_TEST(clusters_need_precision)
{
    const struct {
        mpfr_prec_t precision;
        long shift;
        cv_status expected;
    } rows[] = {{127, 30, CV_OK},
                {127, 60, CV_UNDECIDED},
                {191, 60, CV_OK},
                {191, 400, CV_UNDECIDED},
                {1023, 400, CV_OK}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        dg_mp_roots found;
        mpc_t second;
        mpc_init2(second, 1023);
        dg_mp_roots_init(&found, rows[i].precision);
        const cv_status status = solve_pair(&found, second, rows[i].precision, rows[i].shift);
        ck_assert_msg(status == rows[i].expected, "row %zu: status %d", i, (int)status);
        if (rows[i].expected == CV_OK) {
            int holders = 0;
            for (int k = 0; k < DG_DEGREE; k++) {
                mpc_sub(found.value, found.y[k], second, MPC_RNDNN);
                holders += dg_mp_units(found.value, rows[i].precision) <= found.radius[k];
            }
            ck_assert_int_eq(holders, 1);
        }
        dg_mp_roots_clear(&found);
        mpc_clear(second);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen roots");
    TCase *c = tcase_create("roots");
    tcase_add_checked_fixture(c, setup, teardown);
    tcase_add_test(c, discs_hold_prescribed_roots);
    tcase_add_test(c, half_planes_near_the_axis);
    tcase_add_test(c, rounding_of_the_derivative);
    tcase_add_test(c, double_root_is_undecided);
    tcase_add_test(c, root_through_infinity);
    tcase_add_test(c, continuation_finds_the_same_roots);
    tcase_add_test(c, clusters_need_precision);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
