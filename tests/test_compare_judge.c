/* Pairing and judging of manufactured lists of transitions: what a reader would call the same must agree, and
 * nothing else may. */
#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "compare/judge.h"

enum { DIGITS = 20 };

typedef struct {
    const char *alpha, *q;
    double error; /* relative bound of both */
    int below, above;
} item;

/* Three transitions as at damping 1e-10: two of them 1e-9 apart in alpha, with different q. */
static const item THREE[] = {{"0.3", "0.21", 1e-22, 0, 2},
                             {"0.300000000300000000000000000000", "0.25", 1e-22, 2, 4},
                             {"0.7", "0.4", 1e-22, 4, 2}};

static void fill(cmp_list *list, const item *items, size_t count)
{
    mpfr_t alpha, q;
    mpfr_inits2(160, alpha, q, (mpfr_ptr)0);
    cmp_list_init(list);
    for (size_t i = 0; i < count; i++) {
        mpfr_set_str(alpha, items[i].alpha, 10, MPFR_RNDN);
        mpfr_set_str(q, items[i].q, 10, MPFR_RNDN);
        const double error = items[i].error;
        ck_assert_int_eq(cmp_list_append(list, alpha, q, error * mpfr_get_d(alpha, MPFR_RNDN),
                                         error * mpfr_get_d(q, MPFR_RNDN), items[i].below, items[i].above,
                                         CV_OK, NULL),
                         CV_OK);
    }
    mpfr_clears(alpha, q, (mpfr_ptr)0);
}

static cmp_verdict judge_lists(const cmp_list *a, const cmp_list *b)
{
    static const char *const names[] = {"semianalytic", "dgreen"};
    const cmp_list *const lists[] = {a, b};
    cmp_pairing pairing;
    cmp_verdict v;
    cmp_verdict_init(&v);
    ck_assert_int_eq(cmp_pair(&pairing, a, b, NULL), CV_OK);
    cv_number low, high;
    cv_number_init(&low);
    cv_number_init(&high);
    ck_assert_int_eq(cv_number_parse(&low, "0.02", NULL), CV_OK);
    ck_assert_int_eq(cv_number_parse(&high, "0.8", NULL), CV_OK);
    cmp_judge(&v, lists, &pairing, names, &low, &high, DIGITS);
    cv_number_clear(&low);
    cv_number_clear(&high);
    cmp_pairing_clear(&pairing);
    return v;
}

static cmp_verdict judge_items(const item *a, size_t na, const item *b, size_t nb)
{
    cmp_list first, second;
    fill(&first, a, na);
    fill(&second, b, nb);
    cmp_verdict v = judge_lists(&first, &second);
    cmp_list_clear(&first);
    cmp_list_clear(&second);
    return v;
}

/* THREE against THREE with item i replaced. */
static cmp_verdict judge_replaced(size_t i, item other)
{
    item changed[3];
    memcpy(changed, THREE, sizeof changed);
    changed[i] = other;
    return judge_items(THREE, 3, changed, 3);
}

static void expect(cmp_verdict v, cmp_kind kind, const char *word)
{
    ck_assert_msg(v.kind == kind, "%s: %s", cmp_kind_name(v.kind), v.reason.text);
    ck_assert_msg(strstr(v.reason.text, word) != NULL, "\"%s\" lacks \"%s\"", v.reason.text, word);
}

START_TEST(equal_lists_agree_to_what_the_bounds_claim)
{
    cmp_verdict v = judge_items(THREE, 3, THREE, 3);
    expect(v, CMP_AGREE, "");
    ck_assert_double_eq_tol(v.digits, 22.0, 0.01);
}
END_TEST

START_TEST(digits_are_those_of_the_worst_pair)
{
    /* 0.7 differs by 7e-22, that is 1e-21 relative; the bounds allow it */
    cmp_verdict v = judge_replaced(2, (item){"0.7000000000000000000007", "0.4", 2e-21, 4, 2});
    expect(v, CMP_AGREE, "");
    ck_assert_double_eq_tol(v.digits, -log10(2e-21), 0.01);
    v = judge_replaced(2, (item){"0.7", "0.4000000000000000000012", 3.1e-21, 4, 2});
    expect(v, CMP_AGREE, "");
    ck_assert_double_eq_tol(v.digits, -log10(3.1e-21), 0.01);
}
END_TEST

START_TEST(two_empty_lists_agree_to_the_digits_asked_for)
{
    cmp_verdict v = judge_items(NULL, 0, NULL, 0);
    expect(v, CMP_AGREE, "");
    ck_assert_double_eq(v.digits, DIGITS);
}
END_TEST

START_TEST(a_transition_only_one_method_has_is_a_disagreement)
{
    const item without_last[] = {THREE[0], THREE[1]};
    expect(judge_items(THREE, 3, without_last, 2), CMP_DISAGREE, "only semianalytic has alpha = 0.7");
    expect(judge_items(without_last, 2, THREE, 3), CMP_DISAGREE, "only dgreen has alpha = 0.7");
    expect(judge_items(NULL, 0, THREE, 3), CMP_DISAGREE, "only dgreen has alpha = 0.3");
    /* the second of the close pair is missing: 0 -> 2, then 4 -> 2 cannot follow either */
    const item without_second[] = {THREE[0], {"0.7", "0.4", 1e-22, 2, 0}};
    expect(judge_items(THREE, 3, without_second, 2), CMP_DISAGREE, "");
}
END_TEST

START_TEST(bounds_that_lie_are_a_disagreement)
{
    expect(judge_replaced(0, (item){"0.30000000000000000000007", "0.21", 1e-22, 0, 2}), CMP_DISAGREE,
           "their bounds allow");
    expect(judge_replaced(0, (item){"0.3", "0.210000000000000000001", 1e-22, 0, 2}), CMP_DISAGREE,
           "q = 0.21");
}
END_TEST

START_TEST(a_difference_in_the_seventh_digit_is_a_disagreement)
{
    expect(judge_replaced(2, (item){"0.7000001", "0.4", 1e-22, 4, 2}), CMP_DISAGREE, "0.7");
    expect(judge_replaced(2, (item){"0.71", "0.4", 1e-22, 4, 2}), CMP_DISAGREE, "only");
}
END_TEST

START_TEST(bounds_too_wide_for_the_digits_are_undecided)
{
    expect(judge_replaced(2, (item){"0.7", "0.4", 1e-15, 4, 2}), CMP_UNDECIDED, "bounds of dgreen");
    /* both wide: even an equal value decides nothing */
    const item wide[] = {{"0.3", "0.21", 1e-19, 0, 2}};
    expect(judge_items(wide, 1, wide, 1), CMP_UNDECIDED, "20 digits");
}
END_TEST

START_TEST(other_numbers_of_roots_are_a_disagreement)
{
    const item one[] = {{"0.3", "0.21", 1e-22, 0, 2}}, two[] = {{"0.3", "0.21", 1e-22, 2, 4}};
    expect(judge_items(one, 1, two, 1), CMP_DISAGREE, "unstable roots 0 to 2");
    const item down[] = {{"0.3", "0.21", 1e-22, 2, 0}};
    expect(judge_items(one, 1, down, 1), CMP_DISAGREE, "only");
}
END_TEST

START_TEST(numbers_of_roots_must_follow_from_one_to_the_next)
{
    const item gap[] = {{"0.3", "0.21", 1e-22, 0, 2}, {"0.7", "0.4", 1e-22, 4, 6}};
    expect(judge_items(gap, 2, gap, 2), CMP_DISAGREE, "2 unstable roots above");
    const item odd[] = {{"0.3", "0.21", 1e-22, 0, 1}};
    expect(judge_items(odd, 1, odd, 1), CMP_DISAGREE, "0 to 1");
    const item none[] = {{"0.3", "0.21", 1e-22, 2, 2}};
    expect(judge_items(none, 1, none, 1), CMP_DISAGREE, "2 to 2");
}
END_TEST

START_TEST(lists_out_of_order_are_a_disagreement)
{
    /* the close pair swapped, with numbers of roots that still follow */
    const item swapped[] = {
        {THREE[1].alpha, THREE[1].q, 1e-22, 0, 2}, {THREE[0].alpha, THREE[0].q, 1e-22, 2, 4}, THREE[2]};
    expect(judge_items(THREE, 3, swapped, 3), CMP_DISAGREE, "");
    expect(judge_items(swapped, 3, swapped, 3), CMP_DISAGREE, "ascending");
}
END_TEST

START_TEST(close_transitions_pair_by_frequency_and_direction)
{
    /* relative distance 1e-25 in alpha: only q tells them apart */
    const item up[] = {{"0.3", "0.21", 1e-22, 0, 2}, {"0.30000000000000000000000003", "0.25", 1e-22, 2, 4}};
    cmp_verdict v = judge_items(up, 2, up, 2);
    expect(v, CMP_AGREE, "");
    /* the same point, opposite directions */
    const item touch[] = {{"0.3", "0.21", 1e-22, 0, 2},
                          {"0.30000000000000000000000003", "0.21", 1e-22, 2, 0}};
    expect(judge_items(touch, 2, touch, 2), CMP_AGREE, "");
}
END_TEST

START_TEST(values_off_within_their_bounds_pair_by_frequency)
{
    /* by alpha alone the first of one list is nearest to the second of the other */
    const item a[] = {{"0.3", "0.21", 1e-22, 0, 2}, {"0.30000000000000000000001", "0.25", 1e-22, 2, 4}};
    const item b[] = {{"0.300000000000000000000008", "0.21", 1e-22, 0, 2},
                      {"0.300000000000000000000017", "0.25", 1e-22, 2, 4}};
    expect(judge_items(a, 2, b, 2), CMP_AGREE, "");
}
END_TEST

START_TEST(one_transition_pairs_with_one_only)
{
    const item two[] = {{"0.3", "0.21", 1e-22, 0, 2}, {"0.3001", "0.21", 1e-22, 2, 4}};
    const item one[] = {{"0.3", "0.21", 1e-22, 0, 2}};
    expect(judge_items(two, 2, one, 1), CMP_DISAGREE, "only semianalytic has alpha = 0.3001");
    expect(judge_items(one, 1, two, 2), CMP_DISAGREE, "only dgreen has alpha = 0.3001");
}
END_TEST

START_TEST(one_at_the_end_of_the_range_is_undecided)
{
    const item at_low[] = {{"0.02", "0.2", 1e-22, 0, 2}},
               at_high[] = {{"0.80000000000000001", "0.2", 1e-22, 0, 2}};
    const item near_high[] = {{"0.7999999999999", "0.2", 1e-22, 0, 2}};
    expect(judge_items(at_low, 1, NULL, 0), CMP_UNDECIDED, "end of the range");
    expect(judge_items(NULL, 0, at_high, 1), CMP_UNDECIDED, "end of the range");
    expect(judge_items(NULL, 0, near_high, 1), CMP_DISAGREE, "only dgreen");
}
END_TEST

START_TEST(what_a_method_calls_undecided_stays_undecided)
{
    cmp_list a, b;
    fill(&a, THREE, 3);
    fill(&b, THREE, 3);
    b.items[1].decided = CV_UNDECIDED;
    expect(judge_lists(&a, &b), CMP_UNDECIDED, "dgreen is undecided about alpha = 0.3000000003");
    b.items[1].decided = CV_OK;
    b.status = CV_UNDECIDED;
    strcpy(b.why.text, "4096 bits were not enough");
    expect(judge_lists(&a, &b), CMP_UNDECIDED, "4096 bits");
    cmp_list_clear(&b);
    fill(&b, THREE, 2);
    b.status = CV_UNDECIDED; /* an incomplete list by its own account: no evidence against the other */
    expect(judge_lists(&a, &b), CMP_UNDECIDED, "dgreen could not decide");
    /* it may have missed two roots that came before the first one it has */
    for (size_t i = 0; i < b.count; i++) {
        b.items[i].below += 2;
        b.items[i].above += 2;
    }
    expect(judge_lists(&a, &b), CMP_UNDECIDED, "dgreen could not decide");
    /* but what it does claim counts */
    b.items[0].above = b.items[0].below + 4;
    expect(judge_lists(&a, &b), CMP_DISAGREE, "");
    cmp_list_clear(&a);
    cmp_list_clear(&b);
}
END_TEST

START_TEST(nan_and_infinity_never_agree)
{
    static const char *const bad[] = {"nan", "inf", "-inf", "0", "-0.3"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const item x[] = {{bad[i], "0.21", 1e-22, 0, 2}}, y[] = {{"0.3", bad[i], 1e-22, 0, 2}};
        expect(judge_items(x, 1, x, 1), CMP_DISAGREE, "");
        expect(judge_items(y, 1, y, 1), CMP_DISAGREE, "");
        expect(judge_items(THREE, 1, y, 1), CMP_DISAGREE, "");
    }
    const item z[] = {{"0.3", "0.21", (double)NAN, 0, 2}};
    expect(judge_items(z, 1, z, 1), CMP_DISAGREE, "");
    const item w[] = {{"0.3", "0.21", HUGE_VAL, 0, 2}};
    expect(judge_items(w, 1, w, 1), CMP_DISAGREE, "");
}
END_TEST

START_TEST(a_bound_of_zero_claims_no_more_than_the_value_holds)
{
    const item exact[] = {{"0.3", "0.21", 0.0, 0, 2}};
    cmp_verdict v = judge_items(exact, 1, exact, 1);
    expect(v, CMP_AGREE, "");
    ck_assert_double_gt(v.digits, 47.0); /* 160 bits */
    ck_assert_double_lt(v.digits, 48.5);
}
END_TEST

START_TEST(stability_limit_is_the_first_transition_from_stable)
{
    cmp_list list;
    fill(&list, THREE, 3);
    ck_assert_uint_eq(cmp_list_limit(&list), 0);
    list.items[0].below = 2;
    ck_assert_uint_eq(cmp_list_limit(&list), 3);
    cmp_list_clear(&list);
    const item restarts[] = {{"0.3", "0.21", 1e-22, 2, 0}, {"0.5", "0.2", 1e-22, 0, 2}};
    fill(&list, restarts, 2);
    ck_assert_uint_eq(cmp_list_limit(&list), 1);
    cmp_list_clear(&list);
}
END_TEST

START_TEST(first_reason_of_the_worst_kind_stands)
{
    cmp_verdict v;
    cmp_verdict_init(&v);
    cmp_verdict_worsen(&v, CMP_UNDECIDED, "one");
    cmp_verdict_worsen(&v, CMP_DISAGREE, "two");
    cmp_verdict_worsen(&v, CMP_DISAGREE, "three");
    cmp_verdict_worsen(&v, CMP_UNDECIDED, "four");
    expect(v, CMP_DISAGREE, "two");
}
END_TEST

START_TEST(log10_works_beyond_double)
{
    mpfr_t x;
    mpfr_init2(x, 64);
    mpfr_set_str(x, "-1e-1000", 10, MPFR_RNDN);
    ck_assert_double_eq_tol(cmp_log10(x), -1000.0, 1e-9);
    mpfr_set_zero(x, 1);
    ck_assert(cmp_log10(x) < -1e300);
    mpfr_set_nan(x);
    ck_assert(isnan(cmp_log10(x)));
    mpfr_clear(x);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: judge");
    TCase *t = tcase_create("manufactured lists");
    tcase_add_test(t, equal_lists_agree_to_what_the_bounds_claim);
    tcase_add_test(t, digits_are_those_of_the_worst_pair);
    tcase_add_test(t, two_empty_lists_agree_to_the_digits_asked_for);
    tcase_add_test(t, a_transition_only_one_method_has_is_a_disagreement);
    tcase_add_test(t, bounds_that_lie_are_a_disagreement);
    tcase_add_test(t, a_difference_in_the_seventh_digit_is_a_disagreement);
    tcase_add_test(t, bounds_too_wide_for_the_digits_are_undecided);
    tcase_add_test(t, other_numbers_of_roots_are_a_disagreement);
    tcase_add_test(t, numbers_of_roots_must_follow_from_one_to_the_next);
    tcase_add_test(t, lists_out_of_order_are_a_disagreement);
    tcase_add_test(t, close_transitions_pair_by_frequency_and_direction);
    tcase_add_test(t, values_off_within_their_bounds_pair_by_frequency);
    tcase_add_test(t, one_transition_pairs_with_one_only);
    tcase_add_test(t, one_at_the_end_of_the_range_is_undecided);
    tcase_add_test(t, what_a_method_calls_undecided_stays_undecided);
    tcase_add_test(t, nan_and_infinity_never_agree);
    tcase_add_test(t, a_bound_of_zero_claims_no_more_than_the_value_holds);
    tcase_add_test(t, stability_limit_is_the_first_transition_from_stable);
    tcase_add_test(t, first_reason_of_the_worst_kind_stands);
    tcase_add_test(t, log10_works_beyond_double);
    suite_add_tcase(s, t);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
