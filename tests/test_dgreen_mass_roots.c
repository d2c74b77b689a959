/* Roots of eta_M zeta = 1: put back, continued across the axis, against values from elsewhere. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/count.h"
#include "dgreen/mass_roots.h"
#include "dgreen/z_mp.h"
#include "tests/dgreen_points.h"

static const double PI = 3.14159265358979323846;

static cv_status find(dg_mass_roots *out, const dg_track *t, double alpha, double mass, int digits)
{
    dg_sampler s;
    cv_message why;
    cv_number a, m;
    cv_number_init(&a);
    cv_number_init(&m);
    mpq_set_d(a.factor, alpha);
    mpq_set_d(m.factor, mass);
    ck_assert_int_eq(dg_sampler_init(&s, &t->exact, alpha, alpha, &why), CV_OK);
    const cv_status status = dg_find_mass_roots(out, &s, &a, &m, digits, &why);
    if (status != CV_OK)
        printf("alpha %.17g eta_M %.17g: %s\n", alpha, mass, why.text);
    dg_sampler_clear(&s);
    cv_number_clear(&a);
    cv_number_clear(&m);
    return status;
}

static void exact(cv_number *to, mpfr_srcptr from)
{
    cv_number_init(to);
    mpfr_get_q(to->factor, from);
}

/* |eta_M zeta - 1| at a root with Re qbar > 0, from scratch by dg_zeta_digits */
static double residual(const dg_track *t, double alpha, double mass, const dg_mass_root *r)
{
    cv_number a, re, im;
    mpc_t zeta;
    mpfr_t size;
    cv_number_init(&a);
    mpq_set_d(a.factor, alpha);
    exact(&re, r->re);
    exact(&im, r->im);
    mpc_init2(zeta, 53);
    mpfr_init2(size, 53);
    ck_assert_int_eq(dg_zeta_digits(zeta, t, &a, &re, &im, 40, NULL), CV_OK);
    mpfr_mul_d(mpc_realref(zeta), mpc_realref(zeta), mass, MPFR_RNDN);
    mpfr_mul_d(mpc_imagref(zeta), mpc_imagref(zeta), mass, MPFR_RNDN);
    mpfr_sub_ui(mpc_realref(zeta), mpc_realref(zeta), 1, MPFR_RNDN);
    mpc_abs(size, zeta, MPFR_RNDU);
    const double result = mpfr_get_d(size, MPFR_RNDU);
    mpc_clear(zeta);
    mpfr_clear(size);
    cv_number_clear(&a);
    cv_number_clear(&re);
    cv_number_clear(&im);
    return result;
}

/* Random tracks and points: roots solve the equation to the digits asked for, differ from one another, and
 * are as many as the counter says. */
START_TEST(unstable_roots_put_back)
{
    enum { DIGITS = 25 };
    gsl_rng *rng = random_start("test_dgreen_mass_roots", 20240711);
    int unstable = 0, undecided = 0, points = 0;
    for (int i = 0; i < 40; i++) {
        dg_track *t = random_damped_track(rng);
        const double alpha = log_uniform(rng, 0.1, 2), mass = log_uniform(rng, 3, 3000);
        dg_mass_roots roots;
        points++;
        if (find(&roots, t, alpha, mass, DIGITS) != CV_OK) {
            undecided++;
            dg_track_free(t);
            continue;
        }
        int found = 0;
        for (size_t k = 0; k < roots.count; k++) {
            const dg_mass_root *r = &roots.items[k];
            ck_assert(mpfr_sgn(r->im) > 0);
            if (k > 0)
                ck_assert(mpfr_cmp(r->re, r[-1].re) < 0);
            if (mpfr_sgn(r->re) <= 0)
                continue;
            found += 2;
            const double off = residual(t, alpha, mass, r);
            ck_assert_msg(off < 1e-18, "alpha %.17g eta_M %g: residual %g", alpha, mass, off);
        }
        ck_assert_int_eq(found, roots.unstable_count);
        unstable += found;
        dg_mass_roots_clear(&roots);
        dg_track_free(t);
    }
    printf("%d points, %d unstable roots, %d points undecided\n", points, unstable, undecided);
    ck_assert(unstable > 20);
    ck_assert(undecided <= points / 20);
    gsl_rng_free(rng);
}
END_TEST

/* A stable root of zeta continued: the eigenvalue of a discretised beam (tests/test_outside_beam.c). The sum
 * over Re lambda > 0 taken literally has a root at -0.002726 + 0.209815 i instead, which is none. */
START_TEST(stable_root_of_case_1)
{
    dg_track *t = track_of("6 35 300 7 0.05 0.05 0.05 0 0");
    dg_mass_roots roots;
    ck_assert_int_eq(find(&roots, t, 0.5, 100, 12), CV_OK);
    ck_assert_int_eq(roots.unstable_count, 0);
    ck_assert(roots.count > 0);
    ck_assert_double_eq_tol(mpfr_get_d(roots.items[0].re, MPFR_RNDN), -0.0021275, 1e-7);
    ck_assert_double_eq_tol(mpfr_get_d(roots.items[0].im, MPFR_RNDN), 0.2097854, 1e-7);
    dg_mass_roots_clear(&roots);
    dg_track_free(t);
}
END_TEST

/* zeta at the stable root by its Taylor series around a point of the right half-plane, whose coefficients
 * come from values there only (trapezoidal rule on a circle, Cauchy's formula). */
START_TEST(stable_root_by_taylor_series)
{
    enum { POINTS = 64, TERMS = 40 };
    const double alpha = 0.5, mass = 100, radius = 0.02;
    dg_track *t = track_of("6 35 300 7 0.05 0.05 0.05 0 0");
    dg_follow *f;
    dg_mass_roots roots;
    double complex value[POINTS], sum = 0;
    ck_assert_int_eq(dg_follow_new(&f, NULL), CV_OK);
    ck_assert_int_eq(find(&roots, t, alpha, mass, 12), CV_OK);
    const double complex root =
        CMPLX(mpfr_get_d(roots.items[0].re, MPFR_RNDN), mpfr_get_d(roots.items[0].im, MPFR_RNDN));
    const double complex centre = CMPLX(radius, cimag(root));
    for (int i = 0; i < POINTS; i++) {
        dg_value v;
        const double complex q = centre + radius * cexp(CMPLX(0, 2 * PI * i / POINTS));
        ck_assert_int_eq(dg_zeta_adaptive(&v, f, t, alpha, CMPLX(fmax(creal(q), 0), cimag(q)), 1e-12, 1e-12),
                         CV_OK);
        value[i] = CMPLX(v.re, v.im);
    }
    for (int k = 0; k < TERMS; k++) {
        double complex coefficient = 0;
        for (int i = 0; i < POINTS; i++)
            coefficient += value[i] * cexp(CMPLX(0, -2 * PI * i * k / POINTS)) / POINTS;
        sum += coefficient * cpow((root - centre) / radius, k);
    }
    ck_assert_double_eq_tol(cabs(mass * sum - 1), 0, 1e-6);
    dg_mass_roots_clear(&roots);
    dg_follow_free(f);
    dg_track_free(t);
}
END_TEST

/* Case 1, damping 0.05, eta_M = 100: the root passes the axis at alpha = 0.28220890987922522995
 * (tests/reference), smoothly, so that its real part is odd around there to first order. */
START_TEST(root_passes_the_axis)
{
    const double transition = 0.28220890987922522995;
    dg_track *t = track_of("6 35 300 7 0.05 0.05 0.05 0 0");
    for (double away = 1e-3; away > 1e-7; away /= 10) {
        dg_mass_roots below, above;
        ck_assert_int_eq(find(&below, t, transition - away, 100, 10), CV_OK);
        ck_assert_int_eq(find(&above, t, transition + away, 100, 10), CV_OK);
        ck_assert_int_eq(below.unstable_count, 0);
        ck_assert_int_eq(above.unstable_count, 2);
        const double re = mpfr_get_d(below.items[0].re, MPFR_RNDN),
                     other = mpfr_get_d(above.items[0].re, MPFR_RNDN);
        const double im = mpfr_get_d(below.items[0].im, MPFR_RNDN);
        ck_assert(re < 0 && other > 0);
        ck_assert_double_eq_tol(re + other, 0, 100 * other * away + 1e-15);
        ck_assert_double_eq_tol(im, mpfr_get_d(above.items[0].im, MPFR_RNDN), 10 * away);
        dg_mass_roots_clear(&below);
        dg_mass_roots_clear(&above);
    }
    dg_track_free(t);
}
END_TEST

/* More digits do not change the digits there were; the errors claimed hold. */
START_TEST(errors_claimed)
{
    dg_track *t = track_of("6 5 0.03 3 1e-10 1e-10 1e-10 0 0");
    dg_mass_roots few, many;
    ck_assert_int_eq(find(&few, t, 0.45, 100, 12), CV_OK);
    ck_assert_int_eq(find(&many, t, 0.45, 100, 60), CV_OK);
    ck_assert_int_eq(few.unstable_count, 4);
    ck_assert_uint_eq(few.count, many.count);
    mpfr_t off;
    mpfr_init2(off, 53);
    for (size_t i = 0; i < few.count; i++) {
        mpfr_sub(off, few.items[i].re, many.items[i].re, MPFR_RNDA);
        ck_assert(fabs(mpfr_get_d(off, MPFR_RNDA)) <= pow(10, few.items[i].log_error));
        mpfr_sub(off, few.items[i].im, many.items[i].im, MPFR_RNDA);
        ck_assert(fabs(mpfr_get_d(off, MPFR_RNDA)) <= pow(10, few.items[i].log_error));
        ck_assert(many.items[i].log_error < log10(fabs(mpfr_get_d(many.items[i].re, MPFR_RNDN))) - 60);
    }
    mpfr_clear(off);
    dg_mass_roots_clear(&few);
    dg_mass_roots_clear(&many);
    dg_track_free(t);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen mass roots");
    TCase *c = tcase_create("roots");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, unstable_roots_put_back);
    tcase_add_test(c, stable_root_of_case_1);
    tcase_add_test(c, stable_root_by_taylor_series);
    tcase_add_test(c, root_passes_the_axis);
    tcase_add_test(c, errors_claimed);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
