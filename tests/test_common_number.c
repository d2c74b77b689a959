/* Exact numbers against MPFR's own reading of decimals and against the definition of a fourth root. */
#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/number.h"
#include "tests/seed.h"

static void parse(cv_number *x, const char *text)
{
    cv_message why = {""};
    ck_assert_msg(cv_number_parse(x, text, &why) == CV_OK, "%s: %s", text, why.text);
}

/* x = radicand^(1/4) for a decimal radicand */
static void set_root(cv_number *x, const char *radicand)
{
    cv_number r, one;
    cv_number_init(&r);
    cv_number_init(&one);
    parse(&r, radicand);
    parse(&one, "1");
    cv_number_set_root(x, r.factor, one.factor);
    cv_number_clear(&r);
    cv_number_clear(&one);
}

/* A decimal with up to 40 digits and an exponent of up to +-99. */
static void random_decimal(char *out, size_t size, seed_random *r)
{
    char digits[48];
    const unsigned n = 1 + seed_below(r, 40), point = seed_below(r, n + 1);
    size_t used = 0;
    for (unsigned i = 0; i < n; ++i) {
        if (i == point)
            digits[used++] = '.';
        digits[used++] = (char)('0' + seed_below(r, 10));
    }
    digits[used] = '\0';
    snprintf(out, size, "%s%s%c%d", seed_below(r, 2) ? "-" : "", digits, seed_below(r, 2) ? 'e' : 'E',
             (int)seed_below(r, 199) - 99);
}

static void assert_as_mpfr(const char *text, mpfr_prec_t precision)
{
    cv_number x;
    mpfr_t ours, theirs;
    cv_number_init(&x);
    mpfr_inits2(precision, ours, theirs, (mpfr_ptr)0);
    parse(&x, text);
    cv_number_get_mpfr(ours, &x);
    ck_assert_int_eq(mpfr_set_str(theirs, text, 10, MPFR_RNDN), 0);
    ck_assert_msg(mpfr_equal_p(ours, theirs), "%s at %ld bits", text, (long)precision);
    mpfr_clears(ours, theirs, (mpfr_ptr)0);
    cv_number_clear(&x);
}

START_TEST(decimal_is_not_a_double)
{
    assert_as_mpfr("0.03", 200);
    mpfr_t exact, from_double;
    cv_number x;
    cv_number_init(&x);
    mpfr_inits2(200, exact, from_double, (mpfr_ptr)0);
    parse(&x, "0.03");
    cv_number_get_mpfr(exact, &x);
    mpfr_set_d(from_double, 0.03, MPFR_RNDN);
    ck_assert(!mpfr_equal_p(exact, from_double));
    ck_assert(cv_number_get_double(&x) == 0.03); /* and rounds to the double all the same */
    mpfr_clears(exact, from_double, (mpfr_ptr)0);
    cv_number_clear(&x);
}
END_TEST

START_TEST(random_decimals_as_mpfr_reads_them)
{
    seed_random r = seed_start("random_decimals_as_mpfr_reads_them");
    for (int i = 0; i < 3000; ++i) {
        char text[80];
        random_decimal(text, sizeof text, &r);
        assert_as_mpfr(text, 2 + (mpfr_prec_t)seed_below(&r, 400));
    }
}
END_TEST

static const char *const refused[] = {
    "",
    " ",
    "nan",
    "NaN",
    "inf",
    "-inf",
    "1,5",
    "1x",
    "1 ",
    " 1",
    "1e",
    "1e+",
    "e5",
    ".",
    "-",
    "+",
    "--1",
    "+-1",
    "1.2.3",
    "0x10",
    "1_0",
    "1e5.0",
    "1e5e5",
    "1/3",
    "1e301",
    "1e-301",
    "1e400",
    "-1e400",
    "9e300",
    "1.0000000000001e300",
    "1e99999999999999999999999999",
    "1e-99999999999999999999999999",
    "0.99999999999999999999e-300",
    "\xd9\xa1",
    "1\n",
};

START_TEST(anything_else_is_refused)
{
    cv_number x, seven;
    cv_message why;
    cv_number_init(&x);
    cv_number_init(&seven);
    parse(&x, "7");
    parse(&seven, "7");
    ck_assert_msg(cv_number_parse(&x, refused[_i], &why) == CV_BAD_INPUT, "'%s' was read", refused[_i]);
    ck_assert_uint_gt(strlen(why.text), 0);
    ck_assert_int_eq(cv_number_compare(&x, &seven), 0); /* unchanged */
    cv_number_clear(&x);
    cv_number_clear(&seven);
}
END_TEST

START_TEST(limits_are_accepted)
{
    static const char *const texts[] = {"1e300",
                                        "-1e300",
                                        "1e-300",
                                        "1000e297",
                                        "0.001e-297",
                                        "+5",
                                        "5.",
                                        ".5",
                                        "0",
                                        "-0.000",
                                        "0e9999999999999999999999"};
    cv_number x;
    cv_number_init(&x);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i)
        parse(&x, texts[i]);
    ck_assert_int_eq(cv_number_sign(&x), 0);
    cv_number_clear(&x);
}
END_TEST

/* 10^5 zeros before the first digit and an exponent that takes them back: 0.5 */
START_TEST(long_text)
{
    enum { ZEROS = 100000 };
    char *text = malloc(ZEROS + 40);
    ck_assert_ptr_nonnull(text);
    memset(text, '0', ZEROS);
    text[1] = '.';
    snprintf(text + ZEROS, 40, "5e%d", ZEROS - 2);
    cv_number x;
    cv_number_init(&x);
    parse(&x, text);
    ck_assert(cv_number_get_double(&x) == 0.5);
    text[ZEROS] = 'q';
    cv_message why;
    ck_assert_int_eq(cv_number_parse(&x, text, &why), CV_BAD_INPUT);
    free(text);
    cv_number_clear(&x);
}
END_TEST

typedef struct {
    const char *in, *out;
} text_case;

static const text_case texts[] = {
    {"0", "0"},
    {"-0.0", "0"},
    {"6", "6"},
    {"0.03", "0.03"},
    {"1e-10", "1e-10"},
    {"1e-5", "0.00001"},
    {"1e-6", "1e-6"},
    {"1234.500", "1234.5"},
    {"1e20", "100000000000000000000"},
    {"1e21", "1e21"},
    {"-1.25e-7", "-1.25e-7"},
    {"123456789012345678901", "123456789012345678901"},
    {"1234567890123456789012", "1.234567890123456789012e21"},
    {"50000", "50000"},
    {"-0.5", "-0.5"},
};

START_TEST(text_of_decimals)
{
    cv_number x;
    cv_number_init(&x);
    parse(&x, texts[_i].in);
    char *text = cv_number_text(&x, 3); /* the three digits do not matter to decimals */
    ck_assert_str_eq(text, texts[_i].out);
    free(text);
    cv_number_clear(&x);
}
END_TEST

START_TEST(text_reads_back)
{
    seed_random r = seed_start("text_reads_back");
    cv_number x, y;
    cv_number_init(&x);
    cv_number_init(&y);
    for (int i = 0; i < 1000; ++i) {
        char in[80];
        random_decimal(in, sizeof in, &r);
        parse(&x, in);
        char *text = cv_number_text(&x, 1);
        ck_assert_ptr_nonnull(text);
        parse(&y, text);
        ck_assert_msg(cv_number_compare(&x, &y) == 0, "%s -> %s", in, text);
        free(text);
    }
    cv_number_clear(&x);
    cv_number_clear(&y);
}
END_TEST

/* 1/3 and sqrt(2) = 1.4142135623730950488016887242096980785696718753769... have no finite decimal. */
START_TEST(text_of_other_numbers)
{
    cv_number x, three;
    cv_number_init(&x);
    cv_number_init(&three);
    parse(&x, "1");
    parse(&three, "3");
    cv_number_div(&x, &x, &three);
    char *text = cv_number_text(&x, 5);
    ck_assert_str_eq(text, "0.33333");
    free(text);
    set_root(&x, "4");
    text = cv_number_text(&x, 41);
    ck_assert_str_eq(text, "1.4142135623730950488016887242096980785697");
    free(text);
    cv_number_clear(&x);
    cv_number_clear(&three);
}
END_TEST

START_TEST(roots_that_are_rational)
{
    cv_number x, y;
    cv_number_init(&x);
    cv_number_init(&y);
    set_root(&x, "0.0016");
    parse(&y, "0.2");
    ck_assert(cv_number_is_rational(&x));
    ck_assert_int_eq(cv_number_compare(&x, &y), 0);
    set_root(&x, "4"); /* sqrt(2) sqrt(2) = 2 */
    ck_assert(!cv_number_is_rational(&x));
    cv_number_mul(&x, &x, &x);
    parse(&y, "2");
    ck_assert(cv_number_is_rational(&x));
    ck_assert_int_eq(cv_number_compare(&x, &y), 0);
    set_root(&x, "12"); /* 12^(1/4) / 12^(1/4) = 1 */
    cv_number_div(&x, &x, &x);
    ck_assert(cv_number_is_rational(&x));
    parse(&y, "1");
    ck_assert_int_eq(cv_number_compare(&x, &y), 0);
    cv_number_clear(&x);
    cv_number_clear(&y);
}
END_TEST

START_TEST(comparison_is_exact)
{
    static const char *const below = "1.41421356237309504880168872420969807856967187537694";
    static const char *const above = "1.41421356237309504880168872420969807856967187537695";
    cv_number root, x, minus;
    cv_number_init(&root);
    cv_number_init(&x);
    cv_number_init(&minus);
    set_root(&root, "4");
    parse(&x, below);
    ck_assert_int_eq(cv_number_compare(&root, &x), 1);
    ck_assert_int_eq(cv_number_compare(&x, &root), -1);
    parse(&x, above);
    ck_assert_int_eq(cv_number_compare(&root, &x), -1);
    parse(&minus, "-1");
    cv_number_mul(&root, &root, &minus);
    cv_number_mul(&x, &x, &minus);
    ck_assert_int_eq(cv_number_compare(&root, &x), 1); /* -1.41..3 > -1.41..5 */
    parse(&x, "0");
    ck_assert_int_eq(cv_number_compare(&root, &x), -1);
    ck_assert_int_eq(cv_number_compare(&x, &root), 1);
    ck_assert_int_eq(cv_number_compare(&x, &x), 0);
    cv_number_clear(&root);
    cv_number_clear(&x);
    cv_number_clear(&minus);
}
END_TEST

/* |got - x| < ulp(got), decided exactly: (got -+ ulp)^4 lies on either side of x^4. */
static void assert_faithful(const cv_number *x, mpfr_prec_t precision)
{
    mpfr_t got, side;
    cv_number bound;
    cv_number_init(&bound);
    mpfr_init2(got, precision);
    mpfr_init2(side, precision);
    cv_number_get_mpfr(got, x);
    mpfr_set(side, got, MPFR_RNDN);
    mpfr_nextabove(side);
    mpfr_get_q(bound.factor, side);
    ck_assert_int_eq(cv_number_compare(x, &bound), -1);
    mpfr_set(side, got, MPFR_RNDN);
    mpfr_nextbelow(side);
    mpfr_get_q(bound.factor, side);
    ck_assert_int_eq(cv_number_compare(x, &bound), 1);
    mpfr_clears(got, side, (mpfr_ptr)0);
    cv_number_clear(&bound);
}

START_TEST(roots_are_rounded_faithfully)
{
    seed_random r = seed_start("roots_are_rounded_faithfully");
    cv_number x, factor;
    cv_number_init(&x);
    cv_number_init(&factor);
    for (int i = 0; i < 500; ++i) {
        char text[80];
        do
            random_decimal(text, sizeof text, &r);
        while (strpbrk(text, "123456789") >= strpbrk(text, "eE"));
        set_root(&x, text[0] == '-' ? text + 1 : text);
        random_decimal(text, sizeof text, &r);
        parse(&factor, text);
        cv_number_mul(&x, &x, &factor);
        if (cv_number_sign(&x) != 0)
            assert_faithful(&x, 2 + (mpfr_prec_t)seed_below(&r, 300));
    }
    cv_number_clear(&x);
    cv_number_clear(&factor);
}
END_TEST

START_TEST(what_a_double_holds)
{
    cv_number x, y;
    cv_number_init(&x);
    cv_number_init(&y);
    ck_assert(cv_number_fits_double(&x)); /* zero */
    parse(&x, "1e-300");
    ck_assert(cv_number_fits_double(&x));
    parse(&y, "1e300");
    ck_assert(cv_number_fits_double(&y));
    cv_number_div(&x, &x, &y);
    ck_assert(!cv_number_fits_double(&x));
    parse(&x, "-10");
    cv_number_mul(&x, &x, &y);
    ck_assert(!cv_number_fits_double(&x));
    cv_number_clear(&x);
    cv_number_clear(&y);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("common/number");
    TCase *c = tcase_create("number");
    tcase_add_test(c, decimal_is_not_a_double);
    tcase_add_test(c, random_decimals_as_mpfr_reads_them);
    tcase_add_loop_test(c, anything_else_is_refused, 0, (int)(sizeof refused / sizeof refused[0]));
    tcase_add_test(c, limits_are_accepted);
    tcase_add_test(c, long_text);
    tcase_add_loop_test(c, text_of_decimals, 0, (int)(sizeof texts / sizeof texts[0]));
    tcase_add_test(c, text_reads_back);
    tcase_add_test(c, text_of_other_numbers);
    tcase_add_test(c, roots_that_are_rational);
    tcase_add_test(c, comparison_is_exact);
    tcase_add_test(c, roots_are_rounded_faithfully);
    tcase_add_test(c, what_a_double_holds);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
