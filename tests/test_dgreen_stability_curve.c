/* The curves of figures 2 and 3: crossings against Im zeta = 0, the verdict against the drawing itself, and
 * the paper's rule that z(delta +- iq) shows the unstable side. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/count.h"
#include "dgreen/stability_curve.h"
#include "tests/dgreen_points.h"

static const double PI = 3.14159265358979323846;
static const double DEGREE = 3.14159265358979323846 / 180;

/* N = 1/4 - Delta/pi, Delta the change of arg(1 - z) along the polyline, closed at both ends */
static double roots_by_drawing(const dg_polyline *line)
{
    double sum = carg(1 - CMPLX(line->at[0].re, line->at[0].im));
    for (size_t i = 0; i + 1 < line->count; i++) {
        const double complex a = CMPLX(line->at[i].re, line->at[i].im);
        const double complex b = CMPLX(line->at[i + 1].re, line->at[i + 1].im);
        sum += carg((1 - b) / (1 - a));
    }
    const dg_vertex *last = &line->at[line->count - 1];
    sum += PI / 4 - carg(1 - CMPLX(last->re, last->im));
    return 0.25 - sum / PI;
}

static void turns_are_bounded(const dg_polyline *line)
{
    for (size_t i = 1; i + 1 < line->count; i++) {
        const dg_vertex *v = &line->at[i];
        const double complex before = CMPLX(v->re - v[-1].re, v->im - v[-1].im);
        const double complex after = CMPLX(v[1].re - v->re, v[1].im - v->im);
        const double small = 1e-6 * hypot(v->re, v->im), narrow = fmin(v->q - v[-1].q, v[1].q - v->q);
        ck_assert_msg(fabs(carg(after / before)) < 15 * DEGREE || fmin(cabs(before), cabs(after)) <= small ||
                          narrow < 4e-15 * v->q,
                      "q = %.17g: %g degrees", v->q, carg(after / before) / DEGREE);
    }
}

/* The polyline passes the positive real axis where the list says, and nowhere else above the floor. */
static void drawing_shows_the_cuts(const dg_stability_curve *c)
{
    size_t passes = 0;
    for (size_t i = 0; i + 1 < c->boundary.count; i++) {
        const dg_vertex *a = &c->boundary.at[i], *b = a + 1;
        if ((a->im > 0) == (b->im > 0) || !(fmin(a->re, b->re) > 1.001 * c->x_floor))
            continue;
        passes++;
        int listed = 0;
        for (size_t k = 0; k < c->cut_count; k++)
            listed += c->cuts[k].q >= a->q && c->cuts[k].q <= b->q;
        ck_assert_int_eq(listed, 1);
    }
    ck_assert_uint_le(passes, c->cut_count);
}

/* Im zeta changes its sign at the frequency of a cut, and z there is what it says. */
static void cuts_are_zeros(dg_follow *f, const dg_track *t, const dg_stability_curve *c, double alpha,
                           double mass)
{
    for (size_t i = 0; i < c->cut_count; i++) {
        const dg_cut *cut = &c->cuts[i];
        dg_value at, beside;
        ck_assert_int_ge(cut->left, 0);
        ck_assert_int_eq(abs(cut->left - cut->right), 2);
        ck_assert_int_eq(dg_zeta_adaptive(&at, f, t, alpha, CMPLX(0, cut->q), 1e-8, INFINITY), CV_OK);
        ck_assert_int_eq(
            dg_zeta_adaptive(&beside, f, t, alpha, CMPLX(0, cut->q * (1 + 1e-13)), 1e-8, INFINITY), CV_OK);
        ck_assert_double_eq_tol(mass * at.re / cut->x, 1, 1e-4);
        ck_assert(fabs(at.im) < 1e-4 * at.re);
    }
}

START_TEST(random_tracks)
{
    gsl_rng *rng = random_start("test_dgreen_stability_curve", 20240713);
    dg_stability_curve c = {0};
    dg_follow *f;
    int unstable = 0, undecided = 0;
    ck_assert_int_eq(dg_follow_new(&f, NULL), CV_OK);
    for (int i = 0; i < 40; i++) {
        dg_track *t = random_damped_track(rng);
        dg_sampler s;
        const double alpha = log_uniform(rng, 0.1, 2), mass = log_uniform(rng, 3, 3000);
        ck_assert_int_eq(dg_sampler_init(&s, &t->exact, alpha, alpha, NULL), CV_OK);
        if (dg_stability_curve_at(&c, &s, alpha, mass, 0.01, NULL) == CV_OK) {
            turns_are_bounded(&c.boundary);
            turns_are_bounded(&c.shifted);
            drawing_shows_the_cuts(&c);
            cuts_are_zeros(f, t, &c, alpha, mass);
            ck_assert_double_eq_tol(roots_by_drawing(&c.boundary), c.unstable, 0.01);
            unstable += c.unstable > 0;
        } else {
            undecided++;
        }
        dg_sampler_clear(&s);
        dg_track_free(t);
    }
    printf("%d unstable, %d undecided\n", unstable, undecided);
    ck_assert(unstable > 5);
    ck_assert(undecided <= 2);
    dg_stability_curve_clear(&c);
    dg_follow_free(f);
    gsl_rng_free(rng);
}
END_TEST

/* Where z(delta + i q) passes the real axis next to the cut */
static double shifted_crossing(const dg_stability_curve *c, const dg_cut *cut)
{
    double nearest = HUGE_VAL;
    for (size_t i = 0; i + 1 < c->shifted.count; i++) {
        const dg_vertex *a = &c->shifted.at[i], *b = a + 1;
        if ((a->im > 0) == (b->im > 0))
            continue;
        const double x = a->re - a->im * (b->re - a->re) / (b->im - a->im);
        if (fabs(x - cut->x) < fabs(nearest - cut->x))
            nearest = x;
    }
    return nearest;
}

/* Figure 2: stable to the right of the curve; figure 3: to its left. The curve with delta > 0 lies on the
 * other side, whichever the point (1, 0) is on. */
START_TEST(stable_side)
{
    const struct {
        const char *track;
        double alpha, mass;
        int left, right, unstable;
    } at[] = {{"6 35 300 7 0.05 0.05 0.05 0 0", 0.3, 80, 2, 0, 0},
              {"6 35 300 7 0.05 0.05 0.05 0 0", 0.3, 120, 2, 0, 2},
              {"6 5 0.03 3 1e-4 1e-4 1e-4 0 0", 0.45, 1000, 0, 2, 2},
              {"6 5 0.03 3 1e-4 1e-4 1e-4 0 0", 0.45, 1040, 0, 2, 0}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        dg_track *t = track_of(at[i].track);
        dg_sampler s;
        dg_stability_curve c = {0};
        ck_assert_int_eq(dg_sampler_init(&s, &t->exact, at[i].alpha, at[i].alpha, NULL), CV_OK);
        ck_assert_int_eq(dg_stability_curve_at(&c, &s, at[i].alpha, at[i].mass, 1e-6, NULL), CV_OK);
        const dg_cut *cut = &c.cuts[0];
        for (size_t k = 1; k < c.cut_count; k++)
            if (fabs(log(c.cuts[k].x)) < fabs(log(cut->x)))
                cut = &c.cuts[k];
        ck_assert_int_eq(cut->left, at[i].left);
        ck_assert_int_eq(cut->right, at[i].right);
        ck_assert_int_eq(c.unstable, at[i].unstable);
        const double moved = shifted_crossing(&c, cut) - cut->x;
        ck_assert_msg(cut->left > cut->right ? moved < 0 : moved > 0, "%zu: %g", i, moved);
        dg_stability_curve_clear(&c);
        dg_sampler_clear(&s);
        dg_track_free(t);
    }
}
END_TEST

/* Case 3 without damping: a cut at infinity, beyond which there is no region. */
START_TEST(no_damping)
{
    dg_track *t = track_of("6 5 0.03 3 0 0 0 0 0");
    dg_sampler s;
    dg_stability_curve c = {0};
    ck_assert_int_eq(dg_sampler_init(&s, &t->exact, 0.45, 0.45, NULL), CV_OK);
    ck_assert_int_eq(dg_stability_curve_at(&c, &s, 0.45, 100, 0.01, NULL), CV_OK);
    ck_assert_uint_eq(c.cut_count, 3);
    ck_assert(isinf(c.cuts[2].x) && isfinite(c.cuts[1].x));
    ck_assert_int_eq(c.unstable, 4);
    dg_stability_curve_clear(&c);
    dg_sampler_clear(&s);
    dg_track_free(t);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dgreen stability curve");
    TCase *c = tcase_create("curve");
    tcase_set_timeout(c, 60);
    tcase_add_test(c, random_tracks);
    tcase_add_test(c, stable_side);
    tcase_add_test(c, no_damping);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
