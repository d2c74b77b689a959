/* The map of N and growth rate against roots found one by one, and the grids of its command line. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/grid.h"
#include "dgreen/map.h"
#include "dgreen/mass_roots.h"
#include "tests/dgreen_points.h"

static const double PI = 3.14159265358979323846;
enum { MASSES = 7 };

static double complex characteristic(dg_follow *f, const dg_track *t, double alpha, double mass,
                                     double complex qbar)
{
    dg_value v;
    ck_assert_int_eq(dg_zeta_adaptive(&v, f, t, alpha, qbar, 1e-6, 1e-6) == CV_FAILED, 0);
    return mass * CMPLX(v.re, v.im) - 1;
}

/* Turns of eta_M zeta - 1 around zero on a circle inside the right half-plane */
static double turns(dg_follow *f, const dg_track *t, double alpha, double mass, double complex centre,
                    double radius)
{
    enum { STEPS = 48 };
    double sum = 0;
    double complex before = characteristic(f, t, alpha, mass, centre + radius);
    for (int i = 1; i <= STEPS; i++) {
        const double complex here =
            characteristic(f, t, alpha, mass, centre + radius * cexp(CMPLX(0, 2 * PI * i / STEPS)));
        sum += carg(here / before);
        before = here;
    }
    return sum / (2 * PI);
}

/* A root of the characteristic equation is where the map says, by a circle around it. */
static void root_is_there(dg_follow *f, const dg_track *t, double alpha, double mass, const dg_map_cell *cell)
{
    const double complex root = CMPLX(cell->growth, cell->frequency);
    const double round = turns(f, t, alpha, mass, root, 1e-4 * cell->growth);
    ck_assert_msg(fabs(round - 1) < 1e-6, "alpha %.17g eta_M %.17g: %g turns around %g + %gi", alpha, mass,
                  round, creal(root), cimag(root));
}

/* The greatest Re qbar of all roots, and their number */
static cv_status dominant(double *growth, int *count, dg_sampler *s, double alpha, double mass)
{
    cv_number a, m;
    dg_mass_roots roots;
    cv_number_init(&a);
    cv_number_init(&m);
    mpq_set_d(a.factor, alpha);
    mpq_set_d(m.factor, mass);
    const cv_status status = dg_find_mass_roots(&roots, s, &a, &m, 10, NULL);
    if (status == CV_OK) {
        *count = roots.unstable_count;
        *growth = *count > 0 ? mpfr_get_d(roots.items[0].re, MPFR_RNDN) : 0;
        dg_mass_roots_clear(&roots);
    }
    cv_number_clear(&a);
    cv_number_clear(&m);
    return status;
}

START_TEST(rows_hold_the_roots)
{
    gsl_rng *rng = random_start("test_dgreen_map", 20240712);
    dg_follow *f;
    int cells = 0, unstable = 0, missing = 0;
    ck_assert_int_eq(dg_follow_new(&f, NULL), CV_OK);
    for (int i = 0; i < 25; i++) {
        dg_track *t = random_damped_track(rng);
        const double alpha = log_uniform(rng, 0.1, 2);
        double masses[MASSES];
        dg_map_cell row[MASSES];
        dg_sampler s;
        for (int k = 0; k < MASSES; k++)
            masses[k] = pow(10, 0.5 * k + 0.01 * gsl_rng_uniform(rng));
        ck_assert_int_eq(dg_sampler_init(&s, &t->exact, alpha, alpha, NULL), CV_OK);
        const cv_status status = dg_map_row(row, &s, alpha, MASSES, masses, NULL);
        for (int k = 0; k < MASSES; k++) {
            double growth;
            int count;
            cells++;
            if (status != CV_OK || row[k].count < 0 || isnan(row[k].growth) ||
                dominant(&growth, &count, &s, alpha, masses[k]) != CV_OK) {
                missing++;
                continue;
            }
            ck_assert_int_eq(row[k].count, count);
            ck_assert_double_eq_tol(row[k].growth, growth, 2e-6 * growth + 1e-300);
            if (count > 0)
                root_is_there(f, t, alpha, masses[k], &row[k]);
            unstable += count > 0;
        }
        dg_sampler_clear(&s);
        dg_track_free(t);
    }
    printf("%d cells, %d unstable, %d missing\n", cells, unstable, missing);
    ck_assert(unstable > 20);
    ck_assert(missing <= cells / 20);
    dg_follow_free(f);
    gsl_rng_free(rng);
}
END_TEST

/* A vanishing mass is stable at any damping, and a row does not depend on which other masses it holds. */
START_TEST(rows_are_independent_of_their_grid)
{
    dg_track *t = track_of("6 5 0.03 3 1e-4 1e-4 1e-4 0 0");
    dg_sampler s;
    ck_assert_int_eq(dg_sampler_init(&s, &t->exact, 0.02, 2, NULL), CV_OK);
    for (double alpha = 0.3; alpha < 1.2; alpha += 0.1) {
        double masses[40], one = 0;
        dg_map_cell row[40], cell;
        for (int k = 0; k < 40; k++)
            masses[k] = pow(10, -3 + 6.0 * k / 39);
        ck_assert_int_eq(dg_map_row(row, &s, alpha, 40, masses, NULL), CV_OK);
        ck_assert_int_eq(row[0].count, 0);
        for (int k = 5; k < 40; k += 11) {
            one = masses[k];
            ck_assert_int_eq(dg_map_row(&cell, &s, alpha, 1, &one, NULL), CV_OK);
            ck_assert_int_eq(cell.count, row[k].count);
            ck_assert_double_eq_tol(cell.growth, row[k].growth, 1e-6 * cell.growth + 1e-300);
        }
    }
    dg_sampler_clear(&s);
    dg_track_free(t);
}
END_TEST

/* Without damping: growth rates of strongly damped waves are those of tiny damping, and a light mass in case
 * 4 grows like the cube of eta_M (a weak branch point, d q ~ (eta_M C)^2, times its radiation). */
START_TEST(no_damping)
{
    const double masses[] = {3, 30, 300};
    dg_track *none = track_of("6 5 0.03 3 0 0 0 0 0"), *little = track_of("6 5 0.03 3 1e-12 1e-12 1e-12 0 0");
    dg_sampler s, d;
    dg_map_cell row[3], other[3];
    ck_assert_int_eq(dg_sampler_init(&s, &none->exact, 0.02, 2, NULL), CV_OK);
    ck_assert_int_eq(dg_sampler_init(&d, &little->exact, 0.02, 2, NULL), CV_OK);
    for (double alpha = 0.7; alpha < 1.3; alpha += 0.11) {
        ck_assert_int_eq(dg_map_row(row, &s, alpha, 3, masses, NULL), CV_OK);
        ck_assert_int_eq(dg_map_row(other, &d, alpha, 3, masses, NULL), CV_OK);
        for (int k = 0; k < 3; k++) {
            ck_assert_int_ge(row[k].count, other[k].count);
            ck_assert(row[k].growth > 0);
            if (other[k].count > 0)
                ck_assert_double_eq_tol(row[k].growth, other[k].growth, 1e-6 * row[k].growth);
        }
    }
    ck_assert_int_eq(dg_map_row(row, &s, 0.45, 2, masses, NULL), CV_OK);
    ck_assert_int_eq(row[0].count, 2);
    ck_assert_double_eq_tol(row[1].growth / row[0].growth, 1000, 1);
    dg_sampler_clear(&s);
    dg_sampler_clear(&d);
    dg_track_free(none);
    dg_track_free(little);
}
END_TEST

START_TEST(grids)
{
    dg_grid g;
    cv_number x, expected;
    dg_grid_init(&g);
    cv_number_init(&x);
    cv_number_init(&expected);
    ck_assert_int_eq(dg_grid_parse(&g, "0.1:0.7:7", NULL), CV_OK);
    dg_grid_linear(&x, &g, 2);
    ck_assert_int_eq(cv_number_parse(&expected, "0.3", NULL), CV_OK);
    ck_assert_int_eq(cv_number_compare(&x, &expected), 0);
    ck_assert_int_eq(dg_grid_parse(&g, "1:1000:4", NULL), CV_OK);
    ck_assert_double_eq_tol(dg_grid_logarithmic(&g, 2), 100, 1e-12);
    ck_assert(dg_grid_logarithmic(&g, 3) == 1000);
    ck_assert_int_eq(dg_grid_parse(&g, "0.5", NULL), CV_OK);
    ck_assert_int_eq(g.count, 1);
    ck_assert_int_eq(dg_grid_parse(&g, "0.1:0.7", NULL), CV_OK); /* a range */
    ck_assert_int_eq(g.count, 0);
    const char *wrong[] = {"",     "a",     "2:1",   "1:2:1",   "1:2:x",     "1:2:3x", "1:2:",
                           ":2:3", "2:1:3", "1:1:3", "1:2:3:4", "1:2:10001", "1:2:-3", "1::3"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        ck_assert_msg(dg_grid_parse(&g, wrong[i], NULL) == CV_BAD_INPUT, "%s", wrong[i]);
    dg_grid_clear(&g);
    cv_number_clear(&x);
    cv_number_clear(&expected);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen map");
    TCase *c = tcase_create("map");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, rows_hold_the_roots);
    tcase_add_test(c, rows_are_independent_of_their_grid);
    tcase_add_test(c, no_damping);
    tcase_add_test(c, grids);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
