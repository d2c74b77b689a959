/* Resonance velocities put back into the determinant of (7) with q = 0, compared with the branch curves, and
 * a track whose double resonance is known exactly. */
#include <check.h>
#include <gsl/gsl_errno.h>
#include <math.h>

#include "semianalytic/branch_curves.h"
#include "semianalytic/interval.h"
#include "semianalytic/resonances.h"
#include "tests/random_track.h"

enum { BITS = 1200 };

static const double paper_case[4][6] = {
    {6, 35, 300, 7, 0, 0}, {6, 35, 30, 7, 0, 0}, {6, 5, 0.03, 3, 0, 0}, {3, 10, 0.03, 0.1, 0, 0}};

/* out = d3 of (7)-(10) at q = 0 without damping; size: of its products, including what cancels inside the
 * entries */
static void d3(mpfr_t out, mpfr_t size, const cv_params *params, mpfr_t p, mpfr_t alpha)
{
    const cv_number *from[6] = {&params->mu_s,    &params->mu_b,  &params->kappa_p,
                                &params->kappa_b, &params->eta_s, &params->eta_N};
    mpfr_t v[6], x, s2, d1, d3_, d5, a, b, c;

    for (int i = 0; i < 6; i++) {
        mpfr_init2(v[i], BITS);
        cv_number_get_mpfr(v[i], from[i]);
    }
    mpfr_inits2(BITS, x, s2, d1, d3_, d5, a, b, c, (mpfr_ptr)0);
    mpfr_sqr(x, p, MPFR_RNDN);
    mpfr_mul(s2, p, alpha, MPFR_RNDN);
    mpfr_sqr(s2, s2, MPFR_RNDN); /* -s^2 */
    mpfr_sqr(d1, x, MPFR_RNDN);
    mpfr_div_ui(d1, d1, 4, MPFR_RNDN);
    mpfr_mul(a, v[5], x, MPFR_RNDN);
    mpfr_sub(d1, d1, a, MPFR_RNDN);
    mpfr_sub(d1, d1, s2, MPFR_RNDN);
    mpfr_mul(d3_, v[0], s2, MPFR_RNDN);
    mpfr_mul(d5, v[1], s2, MPFR_RNDN);
    mpfr_add(a, d1, v[2], MPFR_RNDN);
    mpfr_add(b, v[2], v[3], MPFR_RNDN);
    mpfr_sub(b, b, d3_, MPFR_RNDN);
    mpfr_mul(c, v[4], x, MPFR_RNDN);
    mpfr_add(c, c, v[3], MPFR_RNDN);
    mpfr_add_ui(c, c, 1, MPFR_RNDN);
    mpfr_sub(c, c, d5, MPFR_RNDN);
    mpfr_mul(out, a, b, MPFR_RNDN);
    mpfr_mul(out, out, c, MPFR_RNDN);
    double P = mpfr_get_d(x, MPFR_RNDN), S = mpfr_get_d(s2, MPFR_RNDN), V[6];
    for (int i = 0; i < 6; i++) {
        V[i] = fabs(mpfr_get_d(v[i], MPFR_RNDN));
    }
    mpfr_set_d(
        size, (P * P / 4 + V[5] * P + S + V[2]) * (V[2] + V[3] + V[0] * S) * (V[3] + 1 + V[4] * P + V[1] * S),
        MPFR_RNDN);
    mpfr_sqr(v[3], v[3], MPFR_RNDN);
    mpfr_mul(v[3], v[3], a, MPFR_RNDN);
    mpfr_sub(out, out, v[3], MPFR_RNDN);
    mpfr_sqr(v[2], v[2], MPFR_RNDN);
    mpfr_mul(v[2], v[2], c, MPFR_RNDN);
    mpfr_sub(out, out, v[2], MPFR_RNDN);
    for (int i = 0; i < 6; i++) {
        mpfr_clear(v[i]);
    }
    mpfr_clears(x, s2, d1, d3_, d5, a, b, c, (mpfr_ptr)0);
}

/* d3(p, 0) has a double root at p to the digits given; beside it d3 (the product of omega_j^2 - alpha^2 p^2)
 * has the sign of k negative factors for a minimum of the phase velocity of branch k, of k + 1 for a maximum.
 */
static void put_back(const cv_params *params, const sa_resonance *r, int digits)
{
    mpfr_t zero, left, right, size, p, h, t;
    const double tiny = pow(10, -digits);

    mpfr_inits2(BITS, zero, left, right, size, p, h, t, (mpfr_ptr)0);
    d3(zero, size, params, (mpfr_ptr)r->p, (mpfr_ptr)r->alpha);
    mpfr_div(zero, zero, size, MPFR_RNDN);
    ck_assert_msg(fabs(mpfr_get_d(zero, MPFR_RNDN)) <= 100 * tiny, "not a root: %g",
                  mpfr_get_d(zero, MPFR_RNDN));
    mpfr_mul_d(h, r->p, sqrt(tiny) * 1e3, MPFR_RNDN);
    mpfr_sub(p, r->p, h, MPFR_RNDN);
    d3(left, size, params, p, (mpfr_ptr)r->alpha);
    mpfr_add(p, r->p, h, MPFR_RNDN);
    d3(right, size, params, p, (mpfr_ptr)r->alpha);
    mpfr_sub(t, right, left, MPFR_RNDN);
    mpfr_div(t, t, right, MPFR_RNDN);
    ck_assert_msg(fabs(mpfr_get_d(t, MPFR_RNDN)) <= 1e-3, "not a double root: %g", mpfr_get_d(t, MPFR_RNDN));
    int negatives = r->k + (r->kind == SA_RESONANCE_FALSE);
    ck_assert_int_eq(mpfr_sgn(right), negatives % 2 ? -1 : 1);
    mpfr_clears(zero, left, right, size, p, h, t, (mpfr_ptr)0);
}

START_TEST(every_resonance_is_a_double_root)
{
    gsl_rng *rng = random_start("put back", 31);
    cv_params params;

    cv_params_init(&params);
    for (int track = 0; track < 60; track++) {
        sa_resonance_list list;
        int digits = track < 20 ? 40 : 25;
        if (track < 4) {
            set_track(&params, paper_case[track]);
        } else {
            random_track(&params, rng);
        }
        ck_assert_int_eq(sa_resonances(&list, &params, digits, NULL), CV_OK);
        ck_assert_uint_ge(list.count, 1);
        ck_assert_uint_le(list.count, 5);
        for (size_t i = 0; i < list.count; i++) {
            ck_assert_int_ge(list.item[i].bits, (long)(digits * log2(10)));
            put_back(&params, &list.item[i], digits);
        }
        sa_resonances_clear(&list);
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

/* The branch curves come from sampled branches in long double: the same velocities, none more, none less. */
START_TEST(the_branch_curves_see_the_same_list)
{
    gsl_rng *rng = random_start("same list", 8);
    cv_params params;

    cv_params_init(&params);
    for (int track = 0; track < 200; track++) {
        sa_branch_curves curves;
        sa_resonance_list list;
        size_t found = 0;
        random_track(&params, rng);
        ck_assert_int_eq(sa_resonances(&list, &params, 20, NULL), CV_OK);
        ck_assert_int_eq(sa_branch_curves_build(&curves, &params, 0.01, 1000, NULL), CV_OK);
        for (size_t i = 0; i < curves.special_count; i++) {
            const sa_special *s = &curves.special[i];
            if (s->kind == SA_SPECIAL_RESONANCE) {
                ck_assert_uint_lt(found, list.count);
                const sa_resonance *r = &list.item[found++];
                ck_assert_double_eq_tol(s->alpha, mpfr_get_d(r->alpha, MPFR_RNDN), 1e-15 * s->alpha);
                ck_assert_double_eq_tol(s->p, mpfr_get_d(r->p, MPFR_RNDN), 1e-9 * s->p);
                ck_assert_int_eq(s->k, r->k);
            }
        }
        ck_assert_uint_eq(found, list.count);
        sa_branch_curves_clear(&curves);
        sa_resonances_clear(&list);
    }
    cv_params_clear(&params);
    gsl_rng_free(rng);
}
END_TEST

static void expect(const cv_params *params, size_t count, const double *alpha, const char *kinds,
                   double tolerance)
{
    sa_resonance_list list;

    ck_assert_int_eq(sa_resonances(&list, params, 25, NULL), CV_OK);
    ck_assert_uint_eq(list.count, count);
    for (size_t i = 0; i < count; i++) {
        if (alpha) {
            ck_assert_double_eq_tol(mpfr_get_d(list.item[i].alpha, MPFR_RNDN), alpha[i], tolerance);
        }
        ck_assert_int_eq(sa_resonance_kind_text(list.item[i].kind)[0], kinds[i]);
    }
    sa_resonances_clear(&list);
}

/* Section 5: 0.745, 0.750 (case 3; the printed 0.449 is 0.444855), 0.437, 0.442 (false), 0.456 (case 4);
 * "case 1 has three true critical velocities, case 2 only one"; "the maximum number of resonances is five".
 */
START_TEST(the_paper)
{
    const double three[3] = {0.444855, 0.745475, 0.750040}, four[3] = {0.437, 0.442, 0.456};
    cv_params params;

    cv_params_init(&params);
    set_track(&params, paper_case[0]);
    expect(&params, 5, NULL, "tftft", 0);
    set_track(&params, paper_case[1]);
    expect(&params, 1, NULL, "t", 0);
    set_track(&params, paper_case[2]);
    expect(&params, 3, three, "tft", 5e-7);
    set_track(&params, paper_case[3]);
    expect(&params, 3, four, "tft", 5e-4);
    cv_params_clear(&params);
}
END_TEST

/* On sleepers of unlimited mass the rail is a Winkler beam of stiffness kappa_p under axial force: p^2 = 2
 * sqrt(kappa_p), alpha^2 = sqrt(kappa_p) - eta_N. (The two other resonances of this track agree in 32
 * digits.) */
START_TEST(winkler_limit)
{
    const double track[6] = {1e12, 1, 4, 1e12, 0, 0.25};
    cv_params params;
    sa_resonance_list list;

    cv_params_init(&params);
    set_track(&params, track);
    ck_assert_int_eq(sa_resonances(&list, &params, 20, NULL), CV_OK);
    ck_assert_uint_eq(list.count, 3);
    const sa_resonance *r = &list.item[0];
    for (size_t i = 1; i < list.count; i++) {
        r = fabs(mpfr_get_d(list.item[i].p, MPFR_RNDN) - 2) < 0.1 ? &list.item[i] : r;
    }
    ck_assert_double_eq_tol(mpfr_get_d(r->alpha, MPFR_RNDN), sqrt(1.75), 1e-10);
    ck_assert_double_eq_tol(mpfr_get_d(r->p, MPFR_RNDN), 2, 1e-10);
    sa_resonances_clear(&list);
    cv_params_clear(&params);
}
END_TEST

/* to = n/d */
static void set_ratio(cv_number *to, long n, long d)
{
    mpq_set_si(to->factor, n, (unsigned long)d);
    mpq_canonicalize(to->factor);
    mpq_set_si(to->radicand, 1, 1);
}

/* A track with an exact inflection of the phase velocity of branch 0 instead of an extremum. With eta_s =
 * eta_N = 0 the rail has x^2/4 = L - h(L), h = the dynamic stiffness under it; stationary phase velocity is L
 * - 2h + L h' = 0, an inflection also 1 - h' + L h'' = 0. With kappa_p/(kappa_p + k2) = 1/2 and u =
 * kappa_b/(kappa_b + g) = 21/65, g = 1 - mu_b L = 21/86, u^2 mu_b + mu_s = 1 both hold for the values below,
 * where L = omega^2 = (65/86)/mu_b. */
static void inflection(cv_params *p)
{
    /* mu_b = (65/86)(7/4) / (2 u^2 (65/86)) = (7/8)/u^2 = (7/8)(4225/441) */
    set_ratio(&p->mu_b, 7 * 4225, 8 * 441);
    set_ratio(&p->mu_s, 1, 8);
    /* kappa_b = u g/(1 - u) = (21/44)(21/86); kappa_p = k2 = L (1 - 1/4) = (3/4)(65/86)(8 * 441)/(7 * 4225)
     */
    set_ratio(&p->kappa_b, 21 * 21, 44 * 86);
    set_ratio(&p->kappa_p, 3 * 65 * 8 * 441L, 4 * 86 * 7 * 4225L);
    set_ratio(&p->eta_s, 0, 1);
    set_ratio(&p->eta_N, 0, 1);
}

START_TEST(merging_resonances_are_said_to_merge)
{
    cv_params params;
    sa_resonance_list list;
    int merging = 0;

    cv_params_init(&params);
    inflection(&params);
    ck_assert_int_eq(sa_resonances(&list, &params, 20, NULL), CV_OK);
    for (size_t i = 0; i < list.count; i++) {
        const sa_resonance *r = &list.item[i];
        if (r->kind == SA_RESONANCE_MERGING) {
            /* L = 65/86/mu_b, x^2/4 = L - h with h = kappa_p/2 = 3L/8, alpha^2 = L/x */
            double L = 65.0 / 86 * 8 * 441 / (7.0 * 4225), x = 2 * sqrt(L * 5 / 8);
            ck_assert_double_eq_tol(mpfr_get_d(r->p, MPFR_RNDN), sqrt(x), 1e-14);
            ck_assert_double_eq_tol(mpfr_get_d(r->alpha, MPFR_RNDN), sqrt(L / x), 1e-14);
            ck_assert_int_eq(r->k, 0);
            merging++;
        }
    }
    ck_assert_int_eq(merging, 1);
    size_t others = list.count - 1;
    sa_resonances_clear(&list);

    /* the least change of a parameter decides: two resonances more, or none */
    size_t count[2];
    for (int side = 0; side < 2; side++) {
        mpq_t change;
        mpq_init(change);
        mpq_set_si(change, side ? 1 : -1, 1);
        mpq_div_2exp(change, change, 120);
        inflection(&params);
        mpq_add(params.kappa_p.factor, params.kappa_p.factor, change);
        mpq_clear(change);
        ck_assert_int_eq(sa_resonances(&list, &params, 20, NULL), CV_OK);
        count[side] = list.count;
        for (size_t i = 0; i < list.count; i++) {
            ck_assert_int_ne(list.item[i].kind, SA_RESONANCE_MERGING);
        }
        sa_resonances_clear(&list);
    }
    ck_assert_uint_eq(count[0] + count[1], 2 * others + 2);
    ck_assert_uint_ne(count[0], count[1]);
    cv_params_clear(&params);
}
END_TEST

/* (x - 1/3)(x - 2)^2 (x + 5)(x^2 + 1): one certain root, one place that cannot be certain, nothing else. */
START_TEST(isolation_of_known_roots)
{
    const long factor[5][3] = {{-1, 3, 0}, {-2, 1, 0}, {-2, 1, 0}, {5, 1, 0}, {1, 0, 1}};
    sa_polynomial p, f;
    sa_root_place *place;
    size_t count;

    sa_polynomial_init(&p, 300);
    sa_polynomial_init(&f, 300);
    sa_interval_set_si(&p.coefficient[0], 1);
    for (int i = 0; i < 5; i++) {
        f.degree = factor[i][2] ? 2 : 1;
        for (int j = 0; j < 3; j++) {
            sa_interval_set_si(&f.coefficient[j], factor[i][j]);
        }
        sa_polynomial_mul(&p, &p, &f);
    }
    ck_assert_int_eq(sa_polynomial_positive_roots(&place, &count, &p), CV_OK);
    ck_assert_uint_eq(count, 2);
    ck_assert(place[0].least == 1 && place[0].most == 1);
    ck_assert(mpfr_cmp_d(place[0].low, 1.0 / 3) < 0 && mpfr_cmp_d(place[0].high, 0.334) < 2);
    sa_interval x;
    sa_interval_init(&x, 300);
    ck_assert(sa_polynomial_refine(&x, &p, &place[0], 200));
    sa_interval_mul_si(&x, &x, 3);
    ck_assert(mpfr_cmp_si(x.low, 1) <= 0 && mpfr_cmp_si(x.high, 1) >= 0);
    mpfr_sub(x.high, x.high, x.low, MPFR_RNDU);
    ck_assert(mpfr_get_exp(x.high) < -195);
    ck_assert(!(place[1].least == 1 && place[1].most == 1));
    ck_assert(mpfr_cmp_si(place[1].low, 2) <= 0 && mpfr_cmp_si(place[1].high, 2) >= 0);
    sa_interval_clear(&x);
    sa_root_places_free(place, count);
    sa_polynomial_clear(&p);
    sa_polynomial_clear(&f);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic resonances");
    TCase *tests = tcase_create("resonances");

    gsl_set_error_handler_off();
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, every_resonance_is_a_double_root);
    tcase_add_test(tests, the_branch_curves_see_the_same_list);
    tcase_add_test(tests, the_paper);
    tcase_add_test(tests, winkler_limit);
    tcase_add_test(tests, merging_resonances_are_said_to_merge);
    tcase_add_test(tests, isolation_of_known_roots);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
