/* Waves of the undamped track against facts from outside dispersion.c: the determinant of K - L M as written
 * in (7)-(10), in MPFR, and GSL's symmetric eigenvalues. */
#include <check.h>
#include <float.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sort_vector.h>
#include <math.h>

#include "semianalytic/dispersion.h"
#include "tests/random_track.h"

enum { BITS = 600 };

/* out = det(K(p) - L M), every entry as in the header, nothing rounded in effect */
static void determinant(mpfr_t out, const sa_dispersion *d, mpfr_t p, mpfr_t L)
{
    mpfr_t a, b, c, t, x;

    mpfr_inits2(BITS, a, b, c, t, x, (mpfr_ptr)0);
    mpfr_sqr(x, p, MPFR_RNDN);
    mpfr_sqr(a, x, MPFR_RNDN);
    mpfr_div_ui(a, a, 4, MPFR_RNDN);
    mpfr_set_ld(t, d->eta_N, MPFR_RNDN);
    mpfr_mul(t, t, x, MPFR_RNDN);
    mpfr_sub(a, a, t, MPFR_RNDN);
    mpfr_set_ld(t, d->kappa_p, MPFR_RNDN);
    mpfr_add(a, a, t, MPFR_RNDN);
    mpfr_sub(a, a, L, MPFR_RNDN); /* rail */
    mpfr_set_ld(b, d->kappa_b, MPFR_RNDN);
    mpfr_add(b, b, t, MPFR_RNDN);
    mpfr_set_ld(t, d->mu_s, MPFR_RNDN);
    mpfr_mul(t, t, L, MPFR_RNDN);
    mpfr_sub(b, b, t, MPFR_RNDN); /* sleeper */
    mpfr_set_ld(c, d->eta_s, MPFR_RNDN);
    mpfr_mul(c, c, x, MPFR_RNDN);
    mpfr_add_ui(c, c, 1, MPFR_RNDN);
    mpfr_set_ld(t, d->kappa_b, MPFR_RNDN);
    mpfr_add(c, c, t, MPFR_RNDN);
    mpfr_set_ld(t, d->mu_b, MPFR_RNDN);
    mpfr_mul(t, t, L, MPFR_RNDN);
    mpfr_sub(c, c, t, MPFR_RNDN); /* ballast */
    mpfr_mul(out, a, b, MPFR_RNDN);
    mpfr_mul(out, out, c, MPFR_RNDN);
    mpfr_set_ld(t, d->kappa_b, MPFR_RNDN);
    mpfr_sqr(t, t, MPFR_RNDN);
    mpfr_mul(t, t, a, MPFR_RNDN);
    mpfr_sub(out, out, t, MPFR_RNDN);
    mpfr_set_ld(t, d->kappa_p, MPFR_RNDN);
    mpfr_sqr(t, t, MPFR_RNDN);
    mpfr_mul(t, t, c, MPFR_RNDN);
    mpfr_sub(out, out, t, MPFR_RNDN);
    mpfr_clears(a, b, c, t, x, (mpfr_ptr)0);
}

/* sqrt of the eigenvalue of the determinant nearest to the wave, by bisection; p + h with exact h */
static void exact_omega(mpfr_t omega, const sa_dispersion *d, const sa_wave *w, double h, double spread)
{
    mpfr_t p, low, high, mid, f;
    mpfr_inits2(BITS, p, low, high, mid, f, (mpfr_ptr)0);
    mpfr_set_ld(p, w->p, MPFR_RNDN);
    mpfr_add_d(p, p, h, MPFR_RNDN);
    mpfr_set_ld(low, w->omega, MPFR_RNDN);
    mpfr_sqr(low, low, MPFR_RNDN);
    mpfr_mul_d(high, low, 1 + spread, MPFR_RNDN);
    mpfr_mul_d(low, low, 1 - spread, MPFR_RNDN);
    determinant(f, d, p, low);
    int sign = mpfr_sgn(f);
    determinant(f, d, p, high);
    ck_assert_msg(mpfr_sgn(f) == -sign, "no eigenvalue within %g of omega %Lg at p %Lg", spread, w->omega,
                  w->p);
    for (int i = 0; i < 200; i++) {
        mpfr_add(mid, low, high, MPFR_RNDN);
        mpfr_div_2ui(mid, mid, 1, MPFR_RNDN);
        determinant(f, d, p, mid);
        mpfr_set(mpfr_sgn(f) == sign ? low : high, mid, MPFR_RNDN);
    }
    mpfr_sqrt(omega, mid, MPFR_RNDN);
    mpfr_clears(p, low, high, mid, f, (mpfr_ptr)0);
}

static void eigenvalues(double out[3], const sa_dispersion *d, double p)
{
    double mass[3] = {1, (double)d->mu_s, (double)d->mu_b}, kp = (double)d->kappa_p, kb = (double)d->kappa_b;
    double a[9] = {p * p * p * p / 4 - (double)d->eta_N * p * p + kp,
                   -kp,
                   0,
                   -kp,
                   kp + kb,
                   -kb,
                   0,
                   -kb,
                   kb + 1 + (double)d->eta_s * p * p};
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(3);
    gsl_vector_view values = gsl_vector_view_array(out, 3);

    for (int i = 0; i < 9; i++) {
        a[i] /= sqrt(mass[i / 3] * mass[i % 3]);
    }
    gsl_matrix_view matrix = gsl_matrix_view_array(a, 3, 3);
    ck_assert_int_eq(gsl_eigen_symm(&matrix.matrix, &values.vector, work), GSL_SUCCESS);
    gsl_eigen_symm_free(work);
    gsl_sort_vector(&values.vector);
}

START_TEST(omega_is_an_eigenvalue_to_all_digits)
{
    gsl_rng *rng = random_start("dispersion", 2024);
    cv_params params;
    sa_dispersion d;
    mpfr_t exact;

    mpfr_init2(exact, BITS);
    cv_params_init(&params);
    for (int track = 0; track < 200; track++) {
        random_track(&params, rng);
        sa_dispersion_set(&d, &params);
        double p = log_uniform(rng, 1e-3, 1e4);
        double reference[3];
        eigenvalues(reference, &d, p);
        for (int k = 0; k < SA_BRANCHES; k++) {
            sa_wave w;
            ck_assert_int_eq(sa_dispersion_wave(&w, &d, k, p, 0), CV_OK);
            double square = (double)(w.omega * w.omega);
            ck_assert_msg(fabs(square - reference[k]) <= 1e-14 * reference[2], "track %d, k %d, p %g", track,
                          k, p);
            exact_omega(exact, &d, &w, 0, 1e-15);
            long double error = mpfr_get_ld(exact, MPFR_RNDN) - w.omega;
            ck_assert_msg(fabsl(error) <= 200 * LDBL_EPSILON * w.omega, "track %d, k %d, p %g: error %Lg",
                          track, k, p, error / w.omega);
        }
    }
    cv_params_clear(&params);
    mpfr_clear(exact);
    gsl_rng_free(rng);
}
END_TEST

/* Central differences of exact omega against d[1], d[2], d[3]; the step follows the nearest other branch. */
START_TEST(derivatives_match_differences_of_the_determinant)
{
    gsl_rng *rng = random_start("derivatives", 11);
    cv_params params;
    sa_dispersion d;
    mpfr_t f[5], t;

    mpfr_init2(t, BITS);
    for (int i = 0; i < 5; i++) {
        mpfr_init2(f[i], BITS);
    }
    cv_params_init(&params);
    for (int track = 0; track < 100; track++) {
        random_track(&params, rng);
        sa_dispersion_set(&d, &params);
        double p = log_uniform(rng, 0.05, 200);
        for (int k = 0; k < SA_BRANCHES; k++) {
            sa_wave w;
            ck_assert_int_eq(sa_dispersion_wave(&w, &d, k, p, 0), CV_OK);
            double h = ldexp(1, -44) * p, h3 = h * h * h;
            for (int i = 0; i < 5; i++) {
                exact_omega(f[i], &d, &w, (i - 2) * h, 1e-10);
            }
            mpfr_sub(t, f[3], f[1], MPFR_RNDN);
            long double d1 = mpfr_get_ld(t, MPFR_RNDN) / (2 * h);
            mpfr_add(t, f[3], f[1], MPFR_RNDN);
            mpfr_sub(t, t, f[2], MPFR_RNDN);
            mpfr_sub(t, t, f[2], MPFR_RNDN);
            long double d2 = mpfr_get_ld(t, MPFR_RNDN) / (h * h);
            mpfr_sub(t, f[3], f[1], MPFR_RNDN);
            mpfr_mul_2ui(t, t, 1, MPFR_RNDN);
            mpfr_sub(t, f[4], t, MPFR_RNDN);
            mpfr_sub(t, t, f[0], MPFR_RNDN);
            long double d3 = mpfr_get_ld(t, MPFR_RNDN) / (2 * h3);
            long double scale = w.omega / p;
            ck_assert_msg(fabsl(d1 - w.d[1]) <= 1e-13L * (fabsl(d1) + 1e-3L * scale), "d1 track %d k %d p %g",
                          track, k, p);
            ck_assert_msg(fabsl(d2 - w.d[2]) <= 1e-10L * (fabsl(d2) + scale / p),
                          "d2 track %d k %d p %g: %Lg %Lg", track, k, p, d2, w.d[2]);
            ck_assert_msg(fabsl(d3 - w.d[3]) <= 1e-8L * (fabsl(d3) + scale / (p * p)),
                          "d3 track %d k %d p %g: %Lg %Lg", track, k, p, d3, w.d[3]);
            ck_assert(fabsl(w.intercept - (w.omega - w.p * w.d[1])) <= 1e-17L * w.omega * (1 + p));
        }
    }
    cv_params_clear(&params);
    mpfr_clear(t);
    for (int i = 0; i < 5; i++) {
        mpfr_clear(f[i]);
    }
    gsl_rng_free(rng);
}
END_TEST

/* For kappa_p so small that the rail is free, omega^2 = p^4/4 - eta_N p^2 + kappa_p; at p = 0 with a stiff
 * pad and bed the first wave is the whole track on the foundation, omega^2 = 1/(1 + mu_s + mu_b). */
START_TEST(limits_are_those_of_a_beam_and_of_a_block)
{
    const double free_rail[6] = {1, 2.5, 1e-12, 1, 0, -0.5}, block[6] = {6, 35, 1e12, 1e12, 3, 0};
    cv_params params;
    sa_dispersion d;
    sa_wave w;

    cv_params_init(&params);
    set_track(&params, free_rail);
    sa_dispersion_set(&d, &params);
    ck_assert_int_eq(sa_dispersion_wave(&w, &d, 2, 4, 0), CV_OK);
    ck_assert(fabsl(w.omega - sqrtl(72)) < 1e-11L);
    ck_assert(fabsl(w.d[1] - (64 + 4) / (2 * sqrtl(72))) < 1e-11L);
    set_track(&params, block);
    sa_dispersion_set(&d, &params);
    ck_assert_int_eq(sa_dispersion_wave(&w, &d, 0, 0, 0), CV_OK);
    ck_assert(fabsl(w.omega * sqrtl(42) - 1) < 1e-10L);
    ck_assert(fabsl(sa_dispersion_shear_speed(&d) - sqrtl(3.0L / 35)) < 1e-17L);
    cv_params_clear(&params);
}
END_TEST

/* A start value on another branch, or absurd, changes nothing. */
START_TEST(guess_does_not_select_the_branch)
{
    const double near_crossing[6] = {2, 5, 50000, 0.1, 3, -3};
    cv_params params;
    sa_dispersion d;
    sa_wave cold[3], warm;

    cv_params_init(&params);
    set_track(&params, near_crossing);
    sa_dispersion_set(&d, &params);
    for (double p = 150; p < 260; p += 0.37) {
        for (int k = 0; k < SA_BRANCHES; k++) {
            ck_assert_int_eq(sa_dispersion_wave(&cold[k], &d, k, p, 0), CV_OK);
        }
        for (int k = 0; k < SA_BRANCHES; k++) {
            for (int from = 0; from < SA_BRANCHES; from++) {
                ck_assert_int_eq(sa_dispersion_wave(&warm, &d, k, p, cold[from].omega), CV_OK);
                ck_assert(fabsl(warm.omega - cold[k].omega) <= 100 * LDBL_EPSILON * cold[k].omega);
            }
            ck_assert_int_eq(sa_dispersion_wave(&warm, &d, k, p, 1e-30L), CV_OK);
            ck_assert(fabsl(warm.omega - cold[k].omega) <= 100 * LDBL_EPSILON * cold[k].omega);
        }
    }
    cv_params_clear(&params);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic dispersion");
    TCase *tests = tcase_create("waves");

    gsl_set_error_handler_off();
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, omega_is_an_eigenvalue_to_all_digits);
    tcase_add_test(tests, derivatives_match_differences_of_the_determinant);
    tcase_add_test(tests, limits_are_those_of_a_beam_and_of_a_block);
    tcase_add_test(tests, guess_does_not_select_the_branch);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
