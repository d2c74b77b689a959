/* Both trees against values from a third, rigorous route that shares no code with them:
 * data/reference_*.json, made by tests/reference/ with ball arithmetic. */
#include <check.h>
#include <mpc.h>

#include "dgreen/z_mp.h"
#include "semianalytic/kernel.h"
#include "tests/reference_data.h"

enum { DIGITS = 38, BITS = 200 };

/* |value - reference| <= 10^-DIGITS |reference|; an exact zero is exactly 0 */
static int same(mpfr_srcptr value, const char *reference)
{
    mpfr_t wanted, error;
    mpfr_init2(wanted, BITS);
    mpfr_init2(error, BITS);
    mpfr_set_str(wanted, reference, 10, MPFR_RNDN);
    mpfr_sub(error, value, wanted, MPFR_RNDN);
    mpfr_abs(error, error, MPFR_RNDN);
    mpfr_abs(wanted, wanted, MPFR_RNDN);
    for (int i = 0; i < DIGITS; i++)
        mpfr_mul_ui(error, error, 10, MPFR_RNDN);
    const int result = mpfr_lessequal_p(error, wanted) != 0;
    mpfr_clears(wanted, error, (mpfr_ptr)0);
    return result;
}

static void check_zeta(const char *tree, size_t index, const json_t *point, mpc_srcptr zeta, cv_status status,
                       const cv_message *why)
{
    ck_assert_msg(status == CV_OK, "%s, point %zu: status %d, %s", tree, index, (int)status, why->text);
    ck_assert_msg(same(mpc_realref(zeta), reference_text(point, "zeta_re")), "%s, point %zu: Re zeta", tree,
                  index);
    ck_assert_msg(same(mpc_imagref(zeta), reference_text(point, "zeta_im")), "%s, point %zu: Im zeta", tree,
                  index);
}

static void both_trees(size_t index, const json_t *point)
{
    cv_params params;
    cv_number alpha, q;
    cv_message why = {""};
    sa_track *semianalytic;
    dg_track *dgreen;
    mpc_t zeta;
    cv_params_init(&params);
    cv_number_init(&alpha);
    cv_number_init(&q);
    mpc_init2(zeta, 53);
    reference_params(&params, point);
    reference_number(&alpha, point, "alpha");
    reference_number(&q, point, "q");
    ck_assert_int_eq(sa_track_new(&semianalytic, &params, &why), CV_OK);
    ck_assert_int_eq(dg_track_new(&dgreen, &params, &why), CV_OK);
    cv_status status = sa_zeta_digits(zeta, semianalytic, &alpha, &q, DIGITS + 2, &why);
    check_zeta("semianalytic", index, point, zeta, status, &why);
    status = dg_zeta_digits(zeta, dgreen, &alpha, NULL, &q, DIGITS + 2, &why);
    check_zeta("dgreen", index, point, zeta, status, &why);
    sa_track_free(semianalytic);
    dg_track_free(dgreen);
    mpc_clear(zeta);
    cv_number_clear(&q);
    cv_number_clear(&alpha);
    cv_params_clear(&params);
}

START_TEST(zeta_of_both_trees)
{
    json_t *file = reference_load("data/reference_zeta.json", "critvel-reference-zeta/1", "points");
    ck_assert_msg(file != NULL, "data/reference_zeta.json cannot be read or does not match its checksum");
    const json_t *points = json_object_get(file, "points");
    ck_assert_uint_gt(json_array_size(points), 100);
    for (size_t i = 0; i < json_array_size(points); i++)
        both_trees(i, json_array_get(points, i));
    json_decref(file);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("reference values");
    TCase *values = tcase_create("zeta");
    tcase_add_test(values, zeta_of_both_trees);
    suite_add_tcase(suite, values);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
