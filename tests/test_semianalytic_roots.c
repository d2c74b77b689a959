/* Roots of z = 1: put back into K integrated along real p; counted by the crossings of the real axis; stable
 * ones against the eigenvalue of a discretised beam and Cauchy and Riemann. */
#include <check.h>
#include <gsl/gsl_errno.h>
#include <math.h>

#include "semianalytic/laplace.h"
#include "semianalytic/roots_digits.h"
#include "semianalytic/transitions.h"
#include "tests/semianalytic_points.h"

static sa_root_list roots_of(const sa_track *t, const char *alpha, const char *mass, double depth, int digits)
{
    cv_number a, m;
    sa_root_list list;
    cv_message why = {""};
    cv_number_init(&a);
    cv_number_init(&m);
    set_text(&a, alpha);
    set_text(&m, mass);
    ck_assert_msg(sa_roots_find(&list, t, &a, &m, depth, digits, &why) == CV_OK, "%s", why.text);
    cv_number_clear(&a);
    cv_number_clear(&m);
    return list;
}

/* d2/d3 of (7), v as in table1 */
static double complex compliance(const double v[6], double damping, double alpha, double complex q, double p)
{
    const double complex s = CMPLX(0, 1) * (q - alpha * p), s2 = s * s, d4 = 2 * damping * s + v[3];
    const double complex d2 = 2 * damping * s + v[2];
    double complex below = v[1] * s2 + 2 * damping * s + 1 + v[4] * p * p; /* foundation and ballast mass */
    below = v[0] * s2 + d4 * below / (d4 + below);                         /* under the pad */
    return 1 / (p * p * p * p / 4 - v[5] * p * p + s2 + d2 * below / (d2 + below));
}

/* zeta by the trapezoidal rule in u, p = sinh u, which converges exponentially */
static double complex integrated_zeta(const double v[6], double damping, double alpha, double complex q)
{
    enum { POINTS = 20000 };
    const double end = 14, h = 2 * end / POINTS;
    double complex sum = 0;
    for (int i = 0; i <= POINTS; i++) {
        double u = -end + i * h;
        sum += compliance(v, damping, alpha, q, sinh(u)) * cosh(u);
    }
    return q * q * sum * h / (2 * 3.14159265358979323846);
}

START_TEST(unstable_roots_satisfy_the_equation)
{
    const struct {
        int table;
        const char *damping, *alpha, *mass;
    } rows[] = {{0, "0.05", "0.9", "30"},
                {0, "0.05", "1.4", "171"},
                {2, "0.05", "0.7", "30"},
                {1, "0.1", "0.9", "300"},
                {3, "0.1", "0.6", "30"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        sa_track *t = make_track(table1[rows[i].table], rows[i].damping);
        sa_root_list list = roots_of(t, rows[i].alpha, rows[i].mass, 0, 15);
        double v[6];
        int seen = 0;
        for (int k = 0; k < 6; k++)
            v[k] = atof(table1[rows[i].table][k]);
        ck_assert(list.decided == CV_OK && list.unstable_roots >= 2);
        for (size_t k = 0; k < list.count; k++) {
            const double complex qbar = list.items[k].qbar, q = CMPLX(cimag(qbar), -creal(qbar));
            if (!(creal(qbar) > 0.001))
                continue;
            const double complex z =
                atof(rows[i].mass) * integrated_zeta(v, atof(rows[i].damping), atof(rows[i].alpha), q);
            ck_assert_msg(cabs(z - 1) < 1e-9, "row %zu: z - 1 = %g", i, cabs(z - 1));
            seen++;
        }
        ck_assert(seen > 0);
        sa_roots_clear(&list);
        sa_track_free(t);
    }
}
END_TEST

/* tests/test_outside_beam.c extrapolates the eigenvalue of the discretised beam from two meshes; the root of
 * the sum over Im p > 0 on the spot is another, see laplace.h */
START_TEST(stable_root_is_the_eigenvalue_of_a_beam)
{
    const double complex eigenvalue = CMPLX(-0.0021275, 0.2097854), on_the_spot = CMPLX(-0.002726, 0.209815);
    sa_track *t = make_track(table1[0], "0.05");
    sa_root_list list = roots_of(t, "0.5", "100", 0.1, 20);
    ck_assert(list.decided == CV_OK && list.unstable_roots == 0 && list.count == 1);
    ck_assert(cabs(list.items[0].qbar - eigenvalue) < 2e-6);
    ck_assert(cabs(list.items[0].qbar - on_the_spot) > 5e-4);
    sa_roots_clear(&list);
    sa_track_free(t);
}
END_TEST

/* The crossings of tests/test_semianalytic_cli.c's kind: at alpha = 0.45, case 3, damping 1e-10, a root
 * passes the axis at eta_M = 1023.86, and others at 60.49 and 32.2, found by an independent prototype. */
START_TEST(roots_pass_the_axis_where_lines_are_crossed)
{
    const struct {
        const char *below, *above;
    } rows[] = {{"60.48", "60.5"}, {"1023.85", "1023.87"}, {"32.1", "32.3"}};
    sa_track *t = make_track(table1[2], "1e-10");
    for (int i = 0; i < 3; i++) {
        sa_root_list below = roots_of(t, "0.45", rows[i].below, 0, 10);
        sa_root_list above = roots_of(t, "0.45", rows[i].above, 0, 10);
        ck_assert(below.decided == CV_OK && above.decided == CV_OK);
        ck_assert_int_eq(abs(above.unstable_roots - below.unstable_roots), 2);
        sa_roots_clear(&below);
        sa_roots_clear(&above);
    }
    sa_track_free(t);
}
END_TEST

/* N by the contour, N by the roots found, N by the crossings of the map */
START_TEST(three_counts_agree_on_random_tracks)
{
    enum { TRACKS = 6, POINTS = 6 };
    gsl_rng *rng = random_start("test_semianalytic_roots", 42);
    cv_number low, high, alpha, mass;
    int unstable = 0;
    cv_number_init(&low);
    cv_number_init(&high);
    cv_number_init(&alpha);
    cv_number_init(&mass);
    set_text(&low, "0.1");
    set_text(&high, "1.6");
    for (int i = 0; i < TRACKS; i++) {
        cv_params p;
        sa_track *t;
        sa_boundary *boundary;
        cv_params_init(&p);
        random_track(&p, rng);
        random_damping(&p, rng);
        ck_assert(sa_track_new(&t, &p, NULL) == CV_OK &&
                  sa_boundary_new(&boundary, &p, &low, &high, NULL) == CV_OK);
        for (int k = 0; k < POINTS; k++) {
            int crossings;
            sa_root_list list;
            cv_message why = {""};
            set_decimal(&alpha, log_uniform(rng, 0.11, 1.5));
            set_decimal(&mass, log_uniform(rng, 1, 1000));
            if (sa_boundary_unstable_roots(&crossings, boundary, cv_number_get_double(&alpha), 1, &mass,
                                           NULL) != CV_OK)
                continue;
            ck_assert_msg(sa_roots_find(&list, t, &alpha, &mass, 0, 10, &why) == CV_OK, "%s", why.text);
            ck_assert_msg(list.decided == CV_OK, "%s", list.reason.text);
            ck_assert_int_eq(list.unstable_roots, crossings);
            unstable += crossings;
            sa_roots_clear(&list);
        }
        sa_boundary_free(boundary);
        sa_track_free(t);
        cv_params_clear(&p);
    }
    ck_assert_int_gt(unstable, 0);
    cv_number_clear(&low);
    cv_number_clear(&high);
    cv_number_clear(&alpha);
    cv_number_clear(&mass);
    gsl_rng_free(rng);
}
END_TEST

static void compare_digits(const mpfr_t few, const mpfr_t many, int digits)
{
    mpfr_t gap;
    mpfr_init2(gap, 64);
    mpfr_sub(gap, few, many, MPFR_RNDN);
    if (!mpfr_zero_p(gap)) {
        mpfr_div(gap, gap, many, MPFR_RNDN);
        ck_assert(mpfr_get_ld(gap, MPFR_RNDN) < powl(10, -digits) &&
                  mpfr_get_ld(gap, MPFR_RNDN) > -powl(10, -digits));
    }
    mpfr_clear(gap);
}

START_TEST(digits_asked_for_are_right)
{
    sa_track *t = make_track(table1[2], "1e-10");
    sa_root_list few = roots_of(t, "0.7", "30", 1, 25), many = roots_of(t, "0.7", "30", 1, 120);
    ck_assert(few.count >= 3 && few.count == many.count);
    for (size_t i = 0; i < few.count; i++) {
        ck_assert(few.items[i].decided == CV_OK && many.items[i].decided == CV_OK);
        compare_digits(few.items[i].re, many.items[i].re, 25);
        compare_digits(few.items[i].im, many.items[i].im, 25);
    }
    sa_roots_clear(&few);
    sa_roots_clear(&many);
    sa_track_free(t);
}
END_TEST

/* A transition (transitions.h, from zeta at real q) is a root on the imaginary axis. */
START_TEST(transitions_are_roots_on_the_axis)
{
    cv_params p;
    cv_number low, high, mass, alpha;
    sa_boundary *boundary;
    sa_transitions all;
    sa_track *t = make_track(table1[2], "0.05");
    cv_number *numbers[] = {&low, &high, &mass, &alpha};
    for (int i = 0; i < 4; i++)
        cv_number_init(numbers[i]);
    cv_params_init(&p);
    set_params(&p, table1[2], "0.05");
    set_text(&low, "0.3");
    set_text(&high, "1");
    set_text(&mass, "100");
    ck_assert(sa_boundary_new(&boundary, &p, &low, &high, NULL) == CV_OK &&
              sa_boundary_transitions(&all, boundary, 1, &mass, 30, 0, NULL) == CV_OK && all.count > 0);
    for (size_t i = 0; i < all.count; i++) {
        const double complex q = mpfr_get_d(all.items[i].q, MPFR_RNDN);
        sa_sheet s;
        sa_rough_root rough = {q, 0};
        sa_root root;
        mpfr_get_q(alpha.factor, all.items[i].alpha);
        ck_assert_int_eq(sa_sheet_at(&s, t, cv_number_get_double(&alpha), q), CV_OK);
        sa_sheet_zeta(&rough.f_q, &s);
        rough.f_q *= -100;
        ck_assert_int_eq(sa_root_polish(&root, &rough, t, &alpha, &mass, 5), CV_OK);
        mpfr_sub(root.im, root.im, all.items[i].q, MPFR_RNDN);
        ck_assert(root.decided == CV_OK && fabs(mpfr_get_d(root.re, MPFR_RNDN)) < 1e-27 &&
                  fabs(mpfr_get_d(root.im, MPFR_RNDN)) < 1e-27);
        sa_root_clear(&root);
    }
    sa_transitions_clear(&all);
    sa_boundary_free(boundary);
    cv_params_clear(&p);
    for (int i = 0; i < 4; i++)
        cv_number_clear(numbers[i]);
    sa_track_free(t);
}
END_TEST

/* Beyond the axis the continuation is analytic: its differences in both directions are the slope that comes
 * from the poles; and it is the value that a Taylor series from below the axis has. */
START_TEST(continuation_is_analytic)
{
    const double h = 1e-5;
    const double complex points[] = {CMPLX(0.2098, 0.0027), CMPLX(0.05, 0.02), CMPLX(2.5, 0.3),
                                     CMPLX(0.7, 0.01)};
    for (int k = 0; k < 4; k++) {
        sa_track *t = make_track(table1[k], "0.05");
        for (int i = 0; i < 4; i++) {
            const double complex sides[] = {h, -h, CMPLX(0, h), CMPLX(0, -h)};
            double complex z[4], slope;
            sa_sheet s;
            for (int j = 0; j < 4; j++) {
                ck_assert_int_eq(sa_sheet_at(&s, t, 0.5, points[i] + sides[j]), CV_OK);
                z[j] = sa_sheet_zeta(NULL, &s);
            }
            ck_assert_int_eq(sa_sheet_at(&s, t, 0.5, points[i]), CV_OK);
            sa_sheet_zeta(&slope, &s);
            const double size = cabs(slope) + cabs(z[0]) / cabs(points[i]);
            ck_assert(cabs((z[0] - z[1]) / (2 * h) - slope) < 1e-5 * size);
            ck_assert(cabs((z[2] - z[3]) / CMPLX(0, 2 * h) - slope) < 1e-5 * size);
        }
        sa_track_free(t);
    }
}
END_TEST

/* Across the real axis, too: zeta from both sides meets with its slope. */
START_TEST(continuation_starts_where_the_image_ends)
{
    sa_track *t = make_track(table1[0], "0.05");
    sa_sheet above, below;
    for (double x = 0.05; x < 5; x *= 1.3) {
        double complex slope;
        ck_assert(sa_sheet_at(&above, t, 0.5, CMPLX(x, 1e-6)) == CV_OK &&
                  sa_sheet_at(&below, t, 0.5, CMPLX(x, -1e-6)) == CV_OK);
        double complex jump = sa_sheet_zeta(&slope, &above) - sa_sheet_zeta(NULL, &below);
        ck_assert(cabs(jump - CMPLX(0, 2e-6) * slope) < 1e-4 * cabs(jump));
    }
    sa_track_free(t);
}
END_TEST

START_TEST(undamped_tracks_are_refused)
{
    sa_track *t = make_track(table1[0], "0");
    cv_number x;
    sa_root_list list;
    cv_message why = {""};
    cv_number_init(&x);
    set_text(&x, "1");
    ck_assert_int_eq(sa_roots_find(&list, t, &x, &x, 1, 10, &why), CV_BAD_INPUT);
    ck_assert(why.text[0] != '\0' && list.count == 0);
    cv_number_clear(&x);
    sa_track_free(t);
}
END_TEST

int main(void)
{
    gsl_set_error_handler_off();
    Suite *suite = suite_create("semianalytic roots");
    TCase *c = tcase_create("roots");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, unstable_roots_satisfy_the_equation);
    tcase_add_test(c, stable_root_is_the_eigenvalue_of_a_beam);
    tcase_add_test(c, roots_pass_the_axis_where_lines_are_crossed);
    tcase_add_test(c, three_counts_agree_on_random_tracks);
    tcase_add_test(c, digits_asked_for_are_right);
    tcase_add_test(c, transitions_are_roots_on_the_axis);
    tcase_add_test(c, continuation_is_analytic);
    tcase_add_test(c, continuation_starts_where_the_image_ends);
    tcase_add_test(c, undamped_tracks_are_refused);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
