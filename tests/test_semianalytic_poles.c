/* Poles of d2/d3 in p: complete, certified, on the right side; facts about all residues together. */
#include <check.h>
#include <math.h>

#include "semianalytic/kernel_box.h"
#include "tests/semianalytic_points.h"

static gsl_rng *rng;

static void setup(void)
{
    rng = random_start("test_semianalytic_poles", 99);
}

static void teardown(void)
{
    gsl_rng_free(rng);
}

/* A random place at 191 bits with all its poles; undamped for one in four. NULL where the poles are
 * undecided. */
typedef struct {
    sa_track *track;
    cv_number alpha, q;
    sa_pole_set set;
} place;

static int place_make(place *x, int kind)
{
    cv_params p;
    double alpha, q;
    double complex start[SA_STARTS_MAX];
    int n;
    cv_params_init(&p);
    random_track(&p, rng);
    if (kind % 4 != 0)
        random_damping(&p, rng);
    random_point(&alpha, &q, &p, rng);
    ck_assert_int_eq(sa_track_new(&x->track, &p, NULL), CV_OK);
    cv_params_clear(&p);
    cv_number_init(&x->alpha);
    cv_number_init(&x->q);
    mpq_set_d(x->alpha.factor, alpha);
    mpq_set_d(x->q.factor, q);
    sa_pole_set_init(&x->set, x->track, 255);
    sa_place_set(&x->set.place, x->track, &x->alpha, &x->q);
    ck_assert_int_eq(sa_kernel_starts(start, &n, x->track, &x->alpha, &x->q), CV_OK);
    return sa_pole_set_find(&x->set, start, n, 1, 1);
}

static void place_clear(place *x)
{
    sa_pole_set_clear(&x->set);
    cv_number_clear(&x->alpha);
    cv_number_clear(&x->q);
    sa_track_free(x->track);
}

/* sum of p^k residue over all poles, as a box */
static void moment(sa_box *sum, const sa_pole_set *set, int k)
{
    sa_box term;
    sa_box_init(&term, set->place.precision);
    sa_box_zero(sum);
    for (int i = 0; i < set->count; i++) {
        sa_box_set(&term, &set->poles[i].residue);
        for (int j = 0; j < k; j++)
            sa_box_mul(&term, &term, &set->poles[i].p);
        sa_box_add(sum, sum, &term);
    }
    sa_box_clear(&term);
}

/* d2/d3 = 4/p^4 + ... at infinity, so the moments 0, 1, 2 of the residues vanish and moment 3 is 4: a pole
 * missing or counted twice, or a wrong residue, breaks it. */
START_TEST(moments_of_the_residues)
{
    int undecided = 0;
    for (int i = 0; i < 200; i++) {
        place x;
        sa_box sum;
        if (place_make(&x, i)) {
            sa_box_init(&sum, x.set.place.precision);
            for (int k = 0; k <= 3; k++) {
                moment(&sum, &x.set, k);
                double re = mpfr_get_d(mpc_realref(sum.m), MPFR_RNDN) - (k == 3 ? 4 : 0);
                double im = mpfr_get_d(mpc_imagref(sum.m), MPFR_RNDN);
                ck_assert_double_le(fabs(re), (double)sum.re_rad + 1e-15);
                ck_assert_double_le(fabs(im), (double)sum.im_rad);
                ck_assert_double_le((double)(sum.re_rad + sum.im_rad), 1e-20);
            }
            sa_box_clear(&sum);
        } else {
            undecided++;
        }
        place_clear(&x);
    }
    printf("moments: %d of 200 places undecided at 255 bits\n", undecided);
    ck_assert_int_le(undecided, 4);
}
END_TEST

/* A zero of an undamped track is real or has its conjugate; and the real ones take the side that 1e-40 of
 * damping gives them. */
START_TEST(real_poles_take_the_side_of_small_damping)
{
    int compared = 0;
    for (int i = 0; i < 60; i++) {
        place x, y;
        if (place_make(&x, 0)) {
            cv_params p;
            cv_params_init(&p);
            cv_params_set(&p, &x.track->exact);
            set_damping(&p, "1e-40", "1e-40", "1e-40");
            ck_assert_int_eq(sa_track_new(&y.track, &p, NULL), CV_OK);
            sa_pole_set_init(&y.set, y.track, 511);
            sa_place_set(&y.set.place, y.track, &x.alpha, &x.q);
            for (int k = 0; k < x.set.count; k++) {
                const mpc_ptr at = (const mpc_ptr)x.set.poles[k].p.m;
                double complex start =
                    CMPLX(mpfr_get_d(mpc_realref(at), MPFR_RNDN), mpfr_get_d(mpc_imagref(at), MPFR_RNDN));
                sa_pole_set_find(&y.set, &start, 1, 1, 0);
                ck_assert_int_eq(y.set.count, 1);
                ck_assert_int_eq(x.set.poles[k].is_real, mpfr_zero_p(mpc_imagref(at)) != 0);
                ck_assert_int_eq(y.set.poles[0].side, x.set.poles[k].side);
                compared += x.set.poles[k].is_real;
            }
            sa_pole_set_clear(&y.set);
            sa_track_free(y.track);
            cv_params_clear(&p);
        }
        place_clear(&x);
    }
    ck_assert_int_gt(compared, 100);
}
END_TEST

/* residue d2/d3' in double at the poles in Im p > 0, whatever q */
static double complex zeta_by_definition(const sa_track *t, double alpha, double complex q, int *upper)
{
    double complex poles[SA_POLES_MAX], sum = 0;
    int n;
    ck_assert_int_eq(sa_poles_cold(poles, &n, t, alpha, q), CV_OK);
    ck_assert_int_eq(n, 8);
    *upper = 0;
    for (int i = 0; i < n; i++)
        if (cimag(poles[i]) > 0) {
            sa_point m;
            sa_matrix_point(&m, t, alpha, q, poles[i]);
            sum += m.w[SA_RAIL] / m.det_p;
            ++*upper;
        }
    return CMPLX(0, 1) * q * q * sum;
}

/* Case 1, damping 0.05, eta_M = 100, alpha = 0.5: a discretised beam in the moving frame has the eigenvalue
 * qbar = -0.002726 + 0.209815i. It is stable, Re qbar < 0, and there the poles with Im p > 0, waves that
 * decay away from the mass, are four. */
START_TEST(known_eigenvalue_solves_the_characteristic_equation)
{
    sa_track *t = make_track(table1[0], "0.05");
    int upper;
    double complex qbar = CMPLX(-0.002726, 0.209815), q = qbar / CMPLX(0, 1);
    ck_assert_double_le(cabs(100 * zeta_by_definition(t, 0.5, q, &upper) - 1), 2e-5);
    ck_assert_int_eq(upper, 4);
    sa_track_free(t);
}
END_TEST

/* Where K exists the two or three upper poles are those counted. */
START_TEST(number_of_upper_poles)
{
    for (int i = 0; i < 400; i++) {
        cv_params p;
        double alpha, q;
        sa_track *t;
        double complex poles[SA_POLES_MAX];
        int n, upper = 0;
        cv_params_init(&p);
        random_track(&p, rng);
        set_damping(&p, "0.1", "0.15", "0.2");
        random_point(&alpha, &q, &p, rng);
        ck_assert_int_eq(sa_track_new(&t, &p, NULL), CV_OK);
        ck_assert_int_eq(sa_poles_cold(poles, &n, t, alpha, CMPLX(q, -0.1)), CV_OK);
        for (int k = 0; k < n; k++)
            upper += cimag(poles[k]) > 0;
        double gap = alpha * alpha * t->mu_b.m / t->eta_s.m - 1;
        if (!(fabs(gap) < 1e-6))
            ck_assert_int_eq(upper, gap < 0 ? 3 : 2);
        cv_params_clear(&p);
        sa_track_free(t);
    }
}
END_TEST

/* alpha = 0: p^4/4 - eta_N p^2 + c = 0 with c the support of springs in series, solved by hand */
START_TEST(poles_of_a_load_at_rest)
{
    const char *const values[6] = {"6", "35", "3", "6", "0", "-0.5"};
    sa_track *t = make_track(values, "0");
    double complex poles[SA_POLES_MAX];
    double c = 1 / (1.0 / 3 + 1.0 / 6 + 1), product = 1;
    int n;
    ck_assert_int_eq(sa_poles_cold(poles, &n, t, 0, 0), CV_OK);
    ck_assert_int_eq(n, 4);
    for (int i = 0; i < n; i++) {
        double complex p2 = poles[i] * poles[i];
        ck_assert_double_le(cabs(p2 * p2 / 4 + 0.5 * p2 + c), 1e-14);
        product *= cabs(poles[i]);
    }
    ck_assert_double_eq_tol(product, 4 * c, 1e-14);
    sa_track_free(t);
}
END_TEST

/* Boxes around the same pole are not two poles; a box across the real axis is not an upper pole. */
START_TEST(certificate_refuses_doubtful_boxes)
{
    sa_rect one = {1, 1e-8, 1e-15, 1e-20}, same = {1 + 1e-16, 1e-8, 1e-15, 1e-20},
            other = {1, 3e-8, 1e-15, 1e-20};
    sa_rect across = {2, 1e-8, 1e-15, 2e-8}, below = {2, -1e-8, 1e-15, 1e-20};
    const sa_rect pairs[][2] = {{one, same}, {one, other}, {one, across}, {one, below}};
    for (int i = 0; i < 4; i++) {
        sa_pole poles[2] = {{pairs[i][0], one}, {pairs[i][1], one}};
        ck_assert_int_eq(sa_poles_separate(poles, 2), i == 1);
    }
}
END_TEST

/* number of poles of the set within the radii of mid */
static int poles_within(const sa_pole_set *set, const mpc_t mid, long double re_rad, long double im_rad)
{
    mpc_t gap;
    int n = 0;
    mpc_init2(gap, 600);
    for (int j = 0; j < set->count; j++) {
        mpc_sub(gap, set->poles[j].p.m, mid, MPC_RNDNN);
        mpfr_abs(mpc_realref(gap), mpc_realref(gap), MPFR_RNDN);
        mpfr_abs(mpc_imagref(gap), mpc_imagref(gap), MPFR_RNDN);
        n += mpfr_cmp_ld(mpc_realref(gap), re_rad) <= 0 && mpfr_cmp_ld(mpc_imagref(gap), im_rad) <= 0;
    }
    mpc_clear(gap);
    return n;
}

/* A point between exactly on and far from pole k. */
static double complex near_pole(const sa_pole_set *set, int k)
{
    const mpc_ptr at = (const mpc_ptr)set->poles[k].p.m;
    double complex p = CMPLX(mpfr_get_d(mpc_realref(at), MPFR_RNDN), mpfr_get_d(mpc_imagref(at), MPFR_RNDN));
    double phase = 2 * M_PI * gsl_rng_uniform(rng);
    return p * (1 + log_uniform(rng, 1e-16, 1) * CMPLX(cos(phase), sin(phase)));
}

/* Wherever a certificate is given, exactly one zero is in the box, also when Newton's iteration has not
 * converged. */
START_TEST(boxes_hold_one_pole)
{
    int certified = 0, refused = 0;
    for (int i = 0; i < 300; i++) {
        place x;
        if (place_make(&x, i))
            for (int k = 0; k < x.set.count; k++) {
                sa_point m;
                sa_pole pole;
                mpc_t mid;
                double alpha = cv_number_get_double(&x.alpha), q = cv_number_get_double(&x.q);
                sa_matrix_point(&m, x.track, alpha, q, near_pole(&x.set, k));
                if (!sa_poles_enclose(&pole, &m, x.track, alpha, q)) {
                    refused++;
                    continue;
                }
                mpc_init2(mid, 53);
                mpc_set_d_d(mid, pole.box.re, pole.box.im, MPC_RNDNN);
                ck_assert_int_eq(poles_within(&x.set, mid, pole.box.re_rad, pole.box.im_rad), 1);
                mpc_clear(mid);
                certified++;
            }
        place_clear(&x);
    }
    printf("boxes in double: %d certified, %d refused\n", certified, refused);
    ck_assert(certified > 500 && refused > 100);
}
END_TEST

START_TEST(boxes_of_many_digits_hold_one_pole)
{
    int certified = 0, refused = 0;
    for (int i = 0; i < 300; i++) {
        place x;
        if (place_make(&x, i)) {
            sa_pole_set set;
            sa_pole_set_init(&set, x.track, 127);
            sa_place_set(&set.place, x.track, &x.alpha, &x.q);
            for (int k = 0; k < x.set.count; k++) {
                double complex p = near_pole(&x.set, k);
                mpc_set_d_d(set.matrix.p.m, creal(p), cimag(p), MPC_RNDNN);
                set.matrix.p.re_rad = set.matrix.p.im_rad = 0;
                sa_box_matrix_set(&set.matrix, &set.place);
                sa_box_matrix_slope(&set.matrix, &set.place);
                if (sa_pole_set_certify(&set, 0)) {
                    const sa_box *box = &set.matrix.p;
                    ck_assert_int_eq(poles_within(&x.set, box->m, box->re_rad, box->im_rad), 1);
                    certified++;
                } else {
                    refused++;
                }
            }
            sa_pole_set_clear(&set);
        }
        place_clear(&x);
    }
    printf("boxes at 127 bits: %d certified, %d refused\n", certified, refused);
    ck_assert(certified > 500 && refused > 100);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic poles");
    TCase *tests = tcase_create("poles");
    tcase_add_checked_fixture(tests, setup, teardown);
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, moments_of_the_residues);
    tcase_add_test(tests, real_poles_take_the_side_of_small_damping);
    tcase_add_test(tests, known_eigenvalue_solves_the_characteristic_equation);
    tcase_add_test(tests, number_of_upper_poles);
    tcase_add_test(tests, poles_of_a_load_at_rest);
    tcase_add_test(tests, certificate_refuses_doubtful_boxes);
    tcase_add_test(tests, boxes_hold_one_pole);
    tcase_add_test(tests, boxes_of_many_digits_hold_one_pole);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
