/* Branch points and special velocities against brute force: omega_k and omega_k' (Hellmann-Feynman) from
 * GSL's eigenvectors on a dense grid of p, and the order of the curves between special velocities. */
#include <check.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "semianalytic/branch_curves.h"
#include "tests/random_track.h"

enum { DENSE = 6000, ROOM = 64 };

/* Table 1 of the paper, and a track two of whose cusps lie between neighbouring samples. */
enum { FIXED = 5 };
static const double fixed_track[FIXED][6] = {{6, 35, 300, 7, 0, 0},
                                             {6, 35, 30, 7, 0, 0},
                                             {6, 5, 0.03, 3, 0, 0},
                                             {3, 10, 0.03, 0.1, 0, 0},
                                             {2.696061, 28.15135, 0.8258916, 1416.077, 74.00978, 0}};

typedef struct {
    double p, omega[3], speed[3];
} dense_point;

static void brute(dense_point *out, const sa_dispersion *d, double p)
{
    double mass[3] = {1, (double)d->mu_s, (double)d->mu_b}, kp = (double)d->kappa_p, kb = (double)d->kappa_b;
    double eta_N = (double)d->eta_N, eta_s = (double)d->eta_s;
    double a[9] = {
        p * p * p * p / 4 - eta_N * p * p + kp, -kp, 0, -kp, kp + kb, -kb, 0, -kb, kb + 1 + eta_s * p * p};
    double value[3], vector[9];
    gsl_eigen_symmv_workspace *work = gsl_eigen_symmv_alloc(3);
    gsl_vector_view values = gsl_vector_view_array(value, 3);
    gsl_matrix_view vectors = gsl_matrix_view_array(vector, 3, 3);

    for (int i = 0; i < 9; i++) {
        a[i] /= sqrt(mass[i / 3] * mass[i % 3]);
    }
    gsl_matrix_view matrix = gsl_matrix_view_array(a, 3, 3);
    gsl_eigen_symmv(&matrix.matrix, &values.vector, &vectors.matrix, work);
    gsl_eigen_symmv_sort(&values.vector, &vectors.matrix, GSL_EIGEN_SORT_VAL_ASC);
    gsl_eigen_symmv_free(work);
    out->p = p;
    for (int k = 0; k < 3; k++) {
        double rail = vector[k], ballast = vector[6 + k];
        out->omega[k] = sqrt(value[k]);
        out->speed[k] =
            ((p * p * p - 2 * eta_N * p) * rail * rail + 2 * eta_s * p * ballast * ballast / mass[2]) /
            (2 * out->omega[k]);
    }
}

/* Dense samples up to p = 60; tracks with structure beyond are not for this test. */
static dense_point *dense_samples(const sa_dispersion *d)
{
    dense_point *out = malloc(DENSE * sizeof *out);

    for (int i = 0; i < DENSE; i++) {
        brute(&out[i], d, 1e-3 * pow(60 / 1e-3, (double)i / (DENSE - 1)));
    }
    return out;
}

static int build(sa_branch_curves *curves, const double track[6])
{
    cv_params params;

    cv_params_init(&params);
    set_track(&params, track);
    cv_status status = sa_branch_curves_build(curves, &params, 0.02, 2, NULL);
    cv_params_clear(&params);
    return status == CV_OK;
}

/* Every sign change of |omega_k'| - alpha over the dense grid is a branch point, and the other way round. */
static void compare_points(const sa_branch_curves *curves, const dense_point *dense, double alpha)
{
    sa_branch_point point[ROOM];
    int count = sa_branch_points(point, ROOM, curves, alpha);
    int matched = 0, expected = 0;

    ck_assert_int_ge(count, 0);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i + 1 < DENSE; i++) {
            double before = fabs(dense[i].speed[k]) - alpha, after = fabs(dense[i + 1].speed[k]) - alpha;
            if ((before < 0) == (after < 0)) {
                continue;
            }
            expected++;
            for (int j = 0; j < count; j++) {
                matched += point[j].k == k && fabs(point[j].p) > dense[i].p * (1 - 1e-9) &&
                           fabs(point[j].p) < dense[i + 1].p * (1 + 1e-9);
            }
        }
    }
    int within = 0;
    for (int j = 0; j < count; j++) {
        within += fabs(point[j].p) > dense[0].p && fabs(point[j].p) < dense[DENSE - 1].p;
    }
    ck_assert_msg(matched == expected && within == expected, "alpha %.17g: %d of %d found, %d listed", alpha,
                  matched, expected, within);
}

/* d3(p, q) of (7), q - alpha p = f, without damping, with the sum of the magnitudes of its terms */
static long double d3(const sa_dispersion *d, long double p, long double f, long double *size)
{
    long double a = p * p * (p * p / 4 - d->eta_N) - f * f + d->kappa_p;
    long double b = d->kappa_p + d->kappa_b - d->mu_s * f * f;
    long double c = d->kappa_b + 1 + d->eta_s * p * p - d->mu_b * f * f;
    long double kp = d->kappa_p, kb = d->kappa_b, x = p * p;

    *size = (x * x / 4 + fabsl(d->eta_N) * x + f * f + kp) * (kp + kb + d->mu_s * f * f) *
            (kb + 1 + d->eta_s * x + d->mu_b * f * f);
    return a * b * c - kb * kb * a - kp * kp * c;
}

START_TEST(points_are_double_roots_of_d3)
{
    gsl_rng *rng = random_start("double roots", 5);

    for (int c = 0; c < 4; c++) {
        sa_branch_curves curves;
        ck_assert(build(&curves, fixed_track[c]));
        for (int i = 0; i < 50; i++) {
            sa_branch_point point[ROOM];
            double alpha = log_uniform(rng, 0.02, 2);
            int count = sa_branch_points(point, ROOM, &curves, alpha);
            for (int j = 0; j < count; j++) {
                long double p = point[j].p, q = point[j].q, h = 1e-5L * fabsl(p), size;
                const sa_dispersion *d = &curves.grid.track;
                long double zero = d3(d, p, q - alpha * p, &size);
                long double left = d3(d, p - h, q - alpha * (p - h), &size);
                long double right = d3(d, p + h, q - alpha * (p + h), &size);
                ck_assert_msg(fabsl(zero) <= 1e-14L * size, "case %d alpha %g: not a root", c + 1, alpha);
                /* a double root: the values beside it agree to third order */
                ck_assert_msg(fabsl(right - left) <= 1e-2L * fabsl(right + left) + 1e-16L * size,
                              "case %d alpha %g p %Lg: not double", c + 1, alpha, p);
            }
        }
        sa_branch_curves_clear(&curves);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Along a curve dq_b/dalpha = p and dp/dalpha = -1/curvature. */
START_TEST(slopes_are_those_of_the_envelope)
{
    gsl_rng *rng = random_start("slopes", 21);

    for (int i = 0; i < 200; i++) {
        sa_branch_curves curves;
        sa_branch_point here[ROOM], next[ROOM];
        double alpha = log_uniform(rng, 0.03, 1.9), h = 1e-7 * alpha;
        ck_assert(build(&curves, fixed_track[i % 4]));
        int count = sa_branch_points(here, ROOM, &curves, alpha);
        int same = sa_branch_points(next, ROOM, &curves, alpha + h);
        for (int j = 0; j < count && count == same; j++) {
            if (here[j].arc != next[j].arc) {
                continue;
            }
            double slope = (next[j].q - here[j].q) / h, turn = (next[j].p - here[j].p) / h;
            ck_assert_msg(fabs(slope - here[j].p) <= 1e-4 * fabs(here[j].p), "dq/dalpha %g, p %g", slope,
                          here[j].p);
            ck_assert_msg(fabs(turn * here[j].curvature + 1) <= 1e-2, "dp/dalpha %g, curvature %g", turn,
                          here[j].curvature);
        }
        sa_branch_curves_clear(&curves);
    }
    gsl_rng_free(rng);
}
END_TEST

START_TEST(points_are_complete)
{
    gsl_rng *rng = random_start("complete", 77);
    cv_params params;

    cv_params_init(&params);
    for (int track = 0; track < 60; track++) {
        sa_branch_curves curves;
        if (track < FIXED) {
            set_track(&params, fixed_track[track]);
        } else {
            random_track(&params, rng);
        }
        ck_assert_int_eq(sa_branch_curves_build(&curves, &params, 0.02, 2, NULL), CV_OK);
        dense_point *dense = dense_samples(&curves.grid.track);
        for (int i = 0; i < 20; i++) {
            compare_points(&curves, dense, log_uniform(rng, 0.02, 2));
        }
        free(dense);
        sa_branch_curves_clear(&curves);
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

/* The arcs in ascending order of q_b, with the sign of each, as text. */
static void order_text(char *text, size_t size, const sa_branch_curves *curves, double alpha)
{
    sa_branch_point point[ROOM];
    int count = sa_branch_points(point, ROOM, curves, alpha);
    size_t used = 0;

    text[0] = '\0';
    for (int i = 0; i < count && used + 16 < size; i++) {
        used +=
            (size_t)snprintf(text + used, size - used, "%d%c ", point[i].arc, point[i].sign > 0 ? '+' : '-');
    }
}

/* Between special velocities the order of the points never changes; across one it does (cusps and shear
 * change their number, resonances a sign, crossings the order). */
START_TEST(order_changes_at_special_velocities_only)
{
    gsl_rng *rng = random_start("order", 99);
    cv_params params;

    cv_params_init(&params);
    for (int track = 0; track < 300; track++) {
        sa_branch_curves curves;
        if (track < FIXED) {
            set_track(&params, fixed_track[track]);
        } else {
            random_track(&params, rng);
        }
        ck_assert_int_eq(sa_branch_curves_build(&curves, &params, 0.02, 2, NULL), CV_OK);
        char previous[1000] = "";
        double low = 0.02;
        for (size_t i = 0; i <= curves.special_count; i++) {
            double high = i < curves.special_count ? curves.special[i].alpha : 2;
            char first[1000], other[1000];
            /* closer together than double can separate: nothing to look at */
            if (high - low > 1e-9 * high) {
                order_text(first, sizeof first, &curves, low + (high - low) / 100);
                for (int j = 0; j < 20; j++) {
                    double t = gsl_rng_uniform(rng);
                    t = j % 2 ? t : j % 4 ? pow(1e-3, t) : 1 - pow(1e-3, t);
                    order_text(other, sizeof other, &curves, low + (high - low) * t);
                    ck_assert_msg(strcmp(first, other) == 0, "track %d: %s / %s between %.17g and %.17g",
                                  track, first, other, low, high);
                }
                ck_assert_msg(strcmp(first, previous) != 0, "track %d: nothing happens at %.17g", track, low);
                strcpy(previous, first);
            } else {
                previous[0] = '\0';
            }
            low = high;
        }
        sa_branch_curves_clear(&curves);
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

/* Two cusps whose velocities differ by 6e-8: omega_1' rises, falls and rises again by less than that. */
START_TEST(nearly_equal_cusps_are_both_found)
{
    sa_branch_curves curves;
    int turns = 0, listed = 0;
    dense_point a, b, c;

    ck_assert(build(&curves, fixed_track[4]));
    const sa_dispersion *d = &curves.grid.track;
    brute(&a, d, 2.30);
    brute(&b, d, 2.305);
    for (int i = 2; i <= 40; i++) {
        brute(&c, d, 2.30 + i * 0.005);
        turns += (c.speed[1] > b.speed[1]) != (b.speed[1] > a.speed[1]);
        a = b;
        b = c;
    }
    for (size_t i = 0; i < curves.special_count; i++) {
        const sa_special *s = &curves.special[i];
        listed += s->kind == SA_SPECIAL_CUSP && s->k == 1 && s->p > 2.3 && s->p < 2.5;
    }
    ck_assert_int_eq(turns, 2);
    ck_assert_int_eq(listed, 2);
    sa_branch_curves_clear(&curves);
}
END_TEST

static size_t count_special(const sa_branch_curves *curves, sa_special_kind kind, double found[ROOM])
{
    size_t count = 0;

    for (size_t i = 0; i < curves->special_count; i++) {
        if (curves->special[i].kind == kind && count < ROOM) {
            found[count++] = curves->special[i].alpha;
        }
    }
    return count;
}

/* Section 5 of the paper: 0.745, 0.750 (case 3; its 0.449 is 0.444855, see DESIGN.md section 3) and 0.437,
 * 0.442, 0.456 (case 4); three true ones and five in all for case 1, one for case 2 above 0.02. */
START_TEST(resonances_of_the_paper)
{
    double a[ROOM];
    sa_branch_curves curves;

    ck_assert(build(&curves, fixed_track[0]));
    ck_assert_uint_eq(count_special(&curves, SA_SPECIAL_RESONANCE, a), 4);
    sa_branch_curves_clear(&curves);
    ck_assert(build(&curves, fixed_track[2]));
    ck_assert_uint_eq(count_special(&curves, SA_SPECIAL_RESONANCE, a), 3);
    ck_assert_double_eq_tol(a[0], 0.444855, 1e-6);
    ck_assert_double_eq_tol(a[1], 0.745475, 1e-6);
    ck_assert_double_eq_tol(a[2], 0.750040, 1e-6);
    sa_branch_curves_clear(&curves);
    ck_assert(build(&curves, fixed_track[3]));
    ck_assert_uint_eq(count_special(&curves, SA_SPECIAL_RESONANCE, a), 3);
    ck_assert_double_eq_tol(a[0], 0.437, 5e-4);
    ck_assert_double_eq_tol(a[1], 0.442, 5e-4);
    ck_assert_double_eq_tol(a[2], 0.456, 5e-4);
    sa_branch_curves_clear(&curves);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic branch curves");
    TCase *tests = tcase_create("curves");

    gsl_set_error_handler_off();
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, points_are_double_roots_of_d3);
    tcase_add_test(tests, slopes_are_those_of_the_envelope);
    tcase_add_test(tests, points_are_complete);
    tcase_add_test(tests, order_changes_at_special_velocities_only);
    tcase_add_test(tests, nearly_equal_cusps_are_both_found);
    tcase_add_test(tests, resonances_of_the_paper);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
