/* The sampled curve zeta(iq): its crossings against many-digit evaluations, printed values and blunt
 * sampling. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/curve.h"
#include "dgreen/z_mp.h"
#include "tests/dgreen_points.h"

enum { TRACKS = 12, BITS = 200 };
static const double FLOOR = 3e-4;

/* Everything one needs to sample curves of one track */
typedef struct {
    dg_track *track;
    dg_branch_curves *branches;
    dg_follow *follow;
    dg_probe probe;
} bench;

static bench bench_open(dg_track *t)
{
    bench b = {.track = t};
    if (dg_follow_new(&b.follow, NULL) != CV_OK ||
        dg_branch_curves_new(&b.branches, t, 0.02, 2, NULL) != CV_OK)
        abort();
    b.probe = (dg_probe){t, b.follow, b.branches, 0};
    return b;
}

static void bench_close(bench *b)
{
    dg_branch_curves_free(b->branches);
    dg_follow_free(b->follow);
    dg_track_free(b->track);
}

/* Parts of zeta with many digits */
static void exact(double *re, double *im, const dg_track *t, double alpha, double q)
{
    mpc_t zeta;
    mpfr_t re_error, im_error, a, f;
    mpc_init2(zeta, BITS);
    mpfr_inits2(BITS, re_error, im_error, a, f, (mpfr_ptr)NULL);
    mpfr_set_d(a, alpha, MPFR_RNDN);
    mpfr_set_d(f, q, MPFR_RNDN);
    ck_assert_int_eq(dg_zeta_mp(zeta, re_error, im_error, t, a, f, BITS), CV_OK);
    *re = mpfr_get_d(mpc_realref(zeta), MPFR_RNDN);
    *im = mpfr_get_d(mpc_imagref(zeta), MPFR_RNDN);
    mpc_clear(zeta);
    mpfr_clears(re_error, im_error, a, f, (mpfr_ptr)NULL);
}

/* A velocity anywhere, or close to a special one */
static double some_velocity(const bench *b, gsl_rng *rng)
{
    size_t count;
    const dg_special_velocity *special = dg_special_velocities(&count, b->branches);
    if (count == 0 || gsl_rng_uniform_int(rng, 2))
        return log_uniform(rng, 0.02, 2);
    const double away = log_uniform(rng, 1e-9, 0.1) * (gsl_rng_uniform_int(rng, 2) ? 1 : -1);
    return fmin(fmax(special[gsl_rng_uniform_int(rng, count)].alpha * (1 + away), 0.02), 2);
}

/* At every crossing Im zeta changes sign as stated between the ends of the bracket, and x lies between the
 * values of Re zeta there. */
START_TEST(crossings_are_crossings)
{
    gsl_rng *rng = random_start("test_dgreen_curve", 20240601);
    int seen = 0;
    for (int i = 0; i < TRACKS; i++) {
        bench b = bench_open(random_damped_track(rng));
        dg_curve c = {0};
        for (int j = 0; j < 12; j++) {
            const double alpha = some_velocity(&b, rng);
            ck_assert_int_eq(dg_curve_at(&c, &b.probe, alpha, FLOOR, NULL), CV_OK);
            for (size_t k = 0; k < c.crossing_count; k++) {
                const dg_crossing *x = &c.crossings[k];
                double re[2], im[2];
                exact(&re[0], &im[0], b.track, alpha, x->q_low);
                exact(&re[1], &im[1], b.track, alpha, x->q_high);
                ck_assert(im[0] * x->direction > 0 && im[1] * x->direction < 0);
                const double low = fmin(re[0], re[1]), high = fmax(re[0], re[1]);
                const double room = 1e-3 * fabs(x->x) + 0.1 * (high - low);
                ck_assert(x->x > low - room && x->x < high + room);
                ck_assert(x->x_low <= low && x->x_high >= high);
                seen++;
            }
        }
        dg_curve_clear(&c);
        bench_close(&b);
    }
    ck_assert(seen > 10);
    gsl_rng_free(rng);
}
END_TEST

/* Between consecutive crossings, all of them above a tiny floor, Im zeta has the sign they leave wherever
 * Re zeta is above the floor and no crossing below it can have intervened: blunt sampling finds no pair of
 * sign changes on the positive side that the list has not. */
START_TEST(blunt_sampling_finds_nothing_more)
{
    gsl_rng *rng = random_start("test_dgreen_curve", 20240602);
    for (int i = 0; i < TRACKS; i++) {
        bench b = bench_open(random_damped_track(rng));
        dg_curve c = {0};
        for (int j = 0; j < 3; j++) {
            const double alpha = some_velocity(&b, rng);
            ck_assert_int_eq(dg_curve_at(&c, &b.probe, alpha, FLOOR, NULL), CV_OK);
            double before_re = 0, before_im = 0, before = 0;
            for (int k = 0; k < 3000; k++) {
                const double q = 1e-3 * pow(1e5, k / 3000.0);
                dg_value v;
                if (dg_zeta_double(&v, b.follow, b.track, alpha, CMPLX(0, q)) != CV_OK ||
                    !(v.im_error < fabs(v.im)))
                    continue;
                if (before > 0 && (v.im > 0) != (before_im > 0) && v.re > 3 * FLOOR &&
                    before_re > 3 * FLOOR) {
                    int listed = 0;
                    for (size_t m = 0; m < c.crossing_count; m++)
                        listed += c.crossings[m].q > before && c.crossings[m].q < q;
                    ck_assert_msg(listed % 2 == 1,
                                  "alpha %.17g: crossing between q = %.17g and %.17g missing", alpha, before,
                                  q);
                }
                before = q;
                before_re = v.re;
                before_im = v.im;
            }
        }
        dg_curve_clear(&c);
        bench_close(&b);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Slopes along Im zeta = 0: the crossing at a neighbouring velocity is where they say. */
START_TEST(slopes_lead_to_the_neighbour)
{
    gsl_rng *rng = random_start("test_dgreen_curve", 20240603);
    int seen = 0;
    for (int i = 0; i < TRACKS; i++) {
        bench b = bench_open(random_damped_track(rng));
        dg_curve c = {0}, d = {0};
        for (int j = 0; j < 10; j++) {
            const double alpha = log_uniform(rng, 0.02, 2), h = 1e-3 * dg_special_distance(b.branches, alpha);
            ck_assert_int_eq(dg_curve_at(&c, &b.probe, alpha - h, FLOOR, NULL), CV_OK);
            ck_assert_int_eq(dg_curve_at(&d, &b.probe, alpha + h, FLOOR, NULL), CV_OK);
            if (c.crossing_count != d.crossing_count)
                continue;
            for (size_t k = 0; k < c.crossing_count; k++) {
                const dg_crossing *x = &c.crossings[k], *y = &d.crossings[k];
                if (fabs(y->dx - x->dx) > 1e-2 * fabs(x->dx))
                    continue; /* next to a fold */
                const double dx = (y->x - x->x) / (2 * h), dq = (y->q - x->q) / (2 * h);
                ck_assert_msg(fabs(dx - x->dx) <= 0.05 * fabs(dx) + 1e-3 * x->x / alpha,
                              "dx %g, should be %g", x->dx, dx);
                ck_assert_msg(fabs(dq - x->dq) <= 0.02 * fabs(dq) + 1e-3 * x->q / alpha,
                              "dq %g, should be %g", x->dq, dq);
                seen++;
            }
        }
        dg_curve_clear(&c);
        dg_curve_clear(&d);
        bench_close(&b);
    }
    ck_assert(seen > 10);
    gsl_rng_free(rng);
}
END_TEST

/* Case 3 at 1e-10, alpha = 0.45: crossings at eta_M near 60.49, 1023.86 and 32.2, as noted from an earlier
 * program; case 4, alpha = 0.4: one near 231.0. */
START_TEST(known_crossings)
{
    const double wanted[3] = {32.2, 1023.86, 60.49}, room[3] = {0.05, 0.01, 0.01};
    bench b = bench_open(track_of("6 5 0.03 3 1e-10 1e-10 1e-10 0 0"));
    dg_curve c = {0};
    ck_assert_int_eq(dg_curve_at(&c, &b.probe, 0.45, FLOOR, NULL), CV_OK);
    ck_assert_uint_eq(c.crossing_count, 3);
    for (size_t k = 0; k < 3; k++)
        ck_assert(fabs(1 / c.crossings[k].x - wanted[k]) < room[k]);
    dg_curve_clear(&c);
    bench_close(&b);
    b = bench_open(track_of("3 10 0.03 0.1 1e-10 1e-10 1e-10 0 0"));
    ck_assert_int_eq(dg_curve_at(&c, &b.probe, 0.4, FLOOR, NULL), CV_OK);
    ck_assert_uint_eq(c.crossing_count, 1);
    ck_assert(fabs(1 / c.crossings[0].x - 231.0) < 0.05);
    dg_curve_clear(&c);
    bench_close(&b);
}
END_TEST

/* Position and frequency are inverse to one another. */
START_TEST(positions_invert)
{
    gsl_rng *rng = random_start("test_dgreen_curve", 20240604);
    for (int i = 0; i < TRACKS; i++) {
        bench b = bench_open(random_damped_track(rng));
        dg_station s = {0};
        for (int j = 0; j < 50; j++) {
            ck_assert_int_eq(dg_station_set(&s, b.branches, some_velocity(&b, rng), NULL), CV_OK);
            const dg_branch_point *near = s.count > 0 ? &s.points[gsl_rng_uniform_int(rng, s.count)] : NULL;
            double q = log_uniform(rng, 1e-3, 10);
            if (near != NULL && gsl_rng_uniform_int(rng, 2))
                q = near->q * (1 + log_uniform(rng, 1e-12, 0.5));
            const double back = dg_station_frequency(&s, dg_station_position(&s, q));
            const double loss = 4e-16 * fabs(dg_station_position(&s, q)); /* rounding of the position */
            ck_assert(fabs(back - q) <= 1e-11 * dg_station_scale(&s, q) + 4e-15 * q + 10 * loss * q);
        }
        dg_station_clear(&s);
        bench_close(&b);
    }
    gsl_rng_free(rng);
}
END_TEST

/* Re zeta at q; must be had */
static double real_part(const bench *b, double alpha, double q)
{
    dg_value v;
    ck_assert_int_eq(dg_zeta_adaptive(&v, b->follow, b->track, alpha, CMPLX(0, q), 1e-3, (double)INFINITY),
                     CV_OK);
    return v.re;
}

/* Next to branch points that the curve does not look at closely, Re zeta is negative at all distances, from a
 * part of the width on. */
START_TEST(quiet_branch_points_stay_quiet)
{
    gsl_rng *rng = random_start("test_dgreen_curve", 20240605);
    int seen = 0;
    for (int i = 0; i < 60; i++) {
        /* weakly coupled to the shear waves of the ballast, or anything */
        bench b =
            bench_open(i % 3 ? random_damped_track(rng)
                             : track_of("1.00085 30.1569 21067.1 0.568674 1e-10 1e-10 1e-10 1.59728 0"));
        dg_curve c = {0};
        for (int j = 0; j < 4; j++) {
            const double alpha = some_velocity(&b, rng);
            ck_assert_int_eq(dg_curve_at(&c, &b.probe, alpha, FLOOR, NULL), CV_OK);
            for (size_t k = 0; k < c.at.count; k++) {
                const dg_branch_point *point = &c.at.points[k];
                for (double d = point->width / 8; point->quiet && d < 0.01 * point->q; d *= 2)
                    ck_assert(real_part(&b, alpha, point->q - d) < 0 &&
                              real_part(&b, alpha, point->q + d) < 0);
                seen += point->quiet;
            }
        }
        dg_curve_clear(&c);
        bench_close(&b);
    }
    printf("%d quiet branch points\n", seen);
    ck_assert_int_gt(seen, 20);
    gsl_rng_free(rng);
}
END_TEST

/* A crossing close to zero, between two nodes on the negative side: it is there or not by Re zeta alone, not
 * by where the nodes happen to be. Found on a random track. */
START_TEST(crossing_between_negative_nodes)
{
    bench b = bench_open(track_of("4.37021 16.3432 147.72 0.166702 1e-4 1e-4 1e-4 6.31155 -0.923956"));
    dg_curve c = {0};
    for (int i = 0; i < 40; i++) {
        const double alpha = 0.614218802351219 * (1 + 1e-15 * i);
        int found = 0;
        ck_assert_int_eq(dg_curve_at(&c, &b.probe, alpha, 3e-7, NULL), CV_OK);
        for (size_t k = 0; k < c.crossing_count; k++)
            found += fabs(c.crossings[k].q - 0.0404437566) < 1e-9 && fabs(c.crossings[k].x - 4.81e-6) < 1e-8;
        ck_assert_int_eq(found, 1);
    }
    dg_curve_clear(&c);
    bench_close(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen curve");
    TCase *c = tcase_create("curve");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, crossings_are_crossings);
    tcase_add_test(c, blunt_sampling_finds_nothing_more);
    tcase_add_test(c, slopes_lead_to_the_neighbour);
    tcase_add_test(c, known_crossings);
    tcase_add_test(c, positions_invert);
    tcase_add_test(c, quiet_branch_points_stay_quiet);
    tcase_add_test(c, crossing_between_negative_nodes);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
