/* Number of unstable roots against roots found in the half-plane itself. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/count.h"
#include "dgreen/z.h"
#include "tests/dgreen_points.h"

static const double PI = 3.14159265358979323846;

static double complex mass_function(dg_follow *f, const dg_track *t, double alpha, double mass,
                                    double complex qbar)
{
    dg_value v;
    ck_assert_int_eq(dg_zeta_adaptive(&v, f, t, alpha, qbar, 1e-6, 1e-6) == CV_FAILED, 0);
    return 1 - mass * CMPLX(v.re, v.im);
}

/* Change of arg(1 - eta_M zeta) from a to b, halving steps until each turns by less than 0.5 */
static double turning(dg_follow *f, const dg_track *t, double alpha, double mass, double complex a,
                      double complex b, double complex at_a, double complex at_b, int depth)
{
    const double complex m = (a + b) / 2, at_m = mass_function(f, t, alpha, mass, m);
    const double first = carg(at_m / at_a), second = carg(at_b / at_m);
    if (depth == 0 || (fabs(first) < 0.25 && fabs(second) < 0.25))
        return first + second;
    return turning(f, t, alpha, mass, a, m, at_a, at_m, depth - 1) +
           turning(f, t, alpha, mass, m, b, at_m, at_b, depth - 1);
}

/* Roots in the rectangle left < Re < right, bottom < Im < top, by the argument principle around it: every
 * side inside the half-plane, where the function is analytic. */
static int roots_in_rectangle(dg_follow *f, const dg_track *t, double alpha, double mass, double left,
                              double right, double bottom, double top)
{
    const double complex corner[5] = {CMPLX(left, bottom), CMPLX(right, bottom), CMPLX(right, top),
                                      CMPLX(left, top), CMPLX(left, bottom)};
    double sum = 0;
    for (int side = 0; side < 4; side++)
        for (int i = 0; i < 64; i++) {
            const double complex a = corner[side] + (corner[side + 1] - corner[side]) * i / 64;
            const double complex b = corner[side] + (corner[side + 1] - corner[side]) * (i + 1) / 64;
            sum += turning(f, t, alpha, mass, a, b, mass_function(f, t, alpha, mass, a),
                           mass_function(f, t, alpha, mass, b), 40);
        }
    const double count = sum / (2 * PI);
    ck_assert(fabs(count - round(count)) < 1e-3);
    return (int)lround(count);
}

static dg_counter *counter_of(const dg_track *t)
{
    dg_counter *c;
    ck_assert_int_eq(dg_counter_new(&c, &t->exact, 0.02, 2, NULL), CV_OK);
    return c;
}

static int count_of(dg_counter *c, double alpha, double mass)
{
    cv_number number;
    size_t failed;
    int roots;
    cv_number_init(&number);
    mpq_set_d(number.factor, mass);
    if (dg_count_unstable(&roots, &failed, c, alpha, 1, &number, NULL) != CV_OK)
        roots = -1;
    cv_number_clear(&number);
    return roots;
}

/* Twice the roots in a large rectangle of the upper quadrant: the left side so close to the axis that roots
 * between are few, and then the count differs; those are told by moving it closer. */
START_TEST(count_is_the_number_of_roots)
{
    gsl_rng *rng = random_start("test_dgreen_winding", 20240701);
    dg_follow *f;
    int unstable = 0, compared = 0;
    ck_assert_int_eq(dg_follow_new(&f, NULL), CV_OK);
    for (int i = 0; i < 12; i++) {
        cv_params p;
        dg_track *t;
        cv_params_init(&p);
        random_track(&p, rng);
        set_decimal(&p.eta_p, log_uniform(rng, 1e-3, 0.2));
        set_decimal(&p.eta_b, log_uniform(rng, 1e-3, 0.2));
        set_decimal(&p.eta_f, log_uniform(rng, 1e-3, 0.2));
        ck_assert_int_eq(dg_track_new(&t, &p, NULL), CV_OK);
        dg_counter *c = counter_of(t);
        for (int j = 0; j < 3; j++) {
            const double alpha = 0.3 + 1.7 * gsl_rng_uniform(rng), mass = log_uniform(rng, 3, 1000);
            const int counted = count_of(c, alpha, mass);
            int found = -1;
            for (double left = 1e-4; left > 1e-7 && 2 * found != counted; left /= 10)
                found = roots_in_rectangle(f, t, alpha, mass, left, 300, 1e-5, 300);
            if (counted < 0)
                continue;
            ck_assert_msg(2 * found == counted, "alpha %.17g, eta_M %g: %d by the curve, %d by the rectangle",
                          alpha, mass, counted, 2 * found);
            unstable += counted > 0;
            compared++;
        }
        dg_counter_free(c);
        dg_track_free(t);
        cv_params_clear(&p);
    }
    ck_assert(compared > 25 && unstable > 3);
    dg_follow_free(f);
    gsl_rng_free(rng);
}
END_TEST

/* Case 1, eta = 0.05, eta_M = 100, alpha = 0.5: the eigenvalue of the discretised beam next to the axis is
 * -0.002726 + 0.209815i, stable; at alpha = 0.35 the same branch is unstable. */
START_TEST(case_1_around_the_eigenvalue)
{
    dg_track *t = track_of("6 35 300 7 0.05 0.05 0.05 0 0");
    dg_counter *c = counter_of(t);
    ck_assert_int_eq(count_of(c, 0.5, 100), 0);
    ck_assert_int_eq(count_of(c, 0.35, 100), 2);
    dg_counter_free(c);
    dg_track_free(t);
}
END_TEST

/* Counts are even and not negative on any track; none for a mass that is next to nothing. */
START_TEST(counts_are_even)
{
    gsl_rng *rng = random_start("test_dgreen_winding", 20240702);
    int undecided = 0, counted = 0;
    for (int i = 0; i < 15; i++) {
        dg_track *t = random_damped_track(rng);
        dg_counter *c = counter_of(t);
        for (int j = 0; j < 20; j++) {
            const int roots = count_of(c, log_uniform(rng, 0.02, 2), log_uniform(rng, 0.1, 3000));
            undecided += roots < 0;
            counted++;
            ck_assert(roots < 0 || roots % 2 == 0);
        }
        ck_assert_int_eq(count_of(c, log_uniform(rng, 0.02, 0.3), 1e-6), 0);
        dg_counter_free(c);
        dg_track_free(t);
    }
    ck_assert_msg(undecided == 0, "%d of %d undecided", undecided, counted);
    gsl_rng_free(rng);
}
END_TEST

/* Next to a transition the count is decided on both sides, as close as 1e-11 in alpha. Case 1, eta = 0.05,
 * eta_M = 100: alpha = 0.28220890987922522995 (tests/reference). */
START_TEST(close_to_a_transition)
{
    dg_track *t = track_of("6 35 300 7 0.05 0.05 0.05 0 0");
    dg_counter *c = counter_of(t);
    for (double away = 1e-3; away > 5e-12; away /= 10) {
        ck_assert_int_eq(count_of(c, 0.28220890987922522995 - away, 100), 0);
        ck_assert_int_eq(count_of(c, 0.28220890987922522995 + away, 100), 2);
    }
    dg_counter_free(c);
    dg_track_free(t);
}
END_TEST

/* Zero damping is the limit of vanishing damping, which can be far: at alpha = 0.62 one of the light masses
 * of case 1 needs less than 1e-16 to become unstable. */
START_TEST(undamped_is_the_limit)
{
    dg_track *none = track_of("6 35 300 7 0 0 0 0 0"), *little = track_of("6 35 300 7 1e-22 1e-22 1e-22 0 0");
    dg_counter *c = counter_of(none), *d = counter_of(little);
    int unstable = 0;
    for (double alpha = 0.1; alpha < 1.5; alpha += 0.26)
        for (double mass = 3; mass < 2000; mass *= 20) {
            const int limit = count_of(c, alpha, mass);
            ck_assert_int_eq(limit, count_of(d, alpha, mass));
            unstable += limit > 0;
        }
    ck_assert(unstable > 5);
    dg_counter_free(c);
    dg_counter_free(d);
    dg_track_free(none);
    dg_track_free(little);
}
END_TEST

/* Case 1 without damping: at the lowest resonance velocity, sa_resonances: 0.15090146494801031, a branch
 * point leaves q = 0 and the mass loses stability, however light it is. There zeta is infinite, though it is
 * small at the nearest double when the branch point is still near to q = 0. */
START_TEST(undamped_resonance_velocity)
{
    const double resonance = 0.15090146494801031;
    dg_track *none = track_of("6 35 300 7 0 0 0 0 0");
    dg_counter *c = counter_of(none);
    for (double away = 1e-3; away > 5e-12; away /= 10)
        for (double mass = 0.1; mass < 2e4; mass *= 10) {
            ck_assert_int_eq(count_of(c, resonance * (1 - away), mass), 0);
            ck_assert_int_eq(count_of(c, resonance * (1 + away), mass), 2);
        }
    dg_counter_free(c);
    dg_track_free(none);
}
END_TEST

/* Two crossings 3.6e-11 apart in q, a relative 1.8e-6 in eta_M: by mpmath, 60 digits, at eta_M =
 * 2.539581114227665 and 2.539585800321528. Doubles for q do not separate them from masses between. */
START_TEST(crossings_side_by_side)
{
    static const double mass[] = {2.53958, 2.53958111, 2.53958112, 2.5395834572815619, 2.5395857, 2.5395859};
    static const int between[] = {0, 0, 2, 2, 2, 0};
    dg_track *t = track_of("1.28997 41.4038 0.77235 12.1394 1.35e-7 5.45e-9 1.08e-9 0 -0.965911");
    dg_counter *c = counter_of(t);
    const int base = count_of(c, 1.4148774978492069, mass[0]);
    for (int i = 0; i < 6; i++)
        ck_assert_int_eq(count_of(c, 1.4148774978492069, mass[i]), base + between[i]);
    dg_counter_free(c);
    dg_track_free(t);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen winding");
    TCase *c = tcase_create("winding");
    tcase_set_timeout(c, 90);
    tcase_add_test(c, count_is_the_number_of_roots);
    tcase_add_test(c, case_1_around_the_eigenvalue);
    tcase_add_test(c, counts_are_even);
    tcase_add_test(c, close_to_a_transition);
    tcase_add_test(c, undamped_is_the_limit);
    tcase_add_test(c, crossings_side_by_side);
    tcase_add_test(c, undamped_resonance_velocity);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
