/* cv_number from and to decimal text. */
#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/number.h"

enum {
    MAX_EXPONENT = 300, /* largest decimal exponent of a magnitude that is accepted */
    SHOWN = 60          /* characters of a refused text that a message repeats */
};

/* The parts of a decimal: value = digits * 10^exponent */
typedef struct {
    char *digits; /* the mantissa without its point and leading zeros; empty for zero */
    long exponent;
    int negative;
} decimal;

static cv_status not_a_number(const char *text, cv_message *why)
{
    const size_t n = strlen(text);
    if (n == 0)
        return cv_fail(why, CV_BAD_INPUT, "a number is missing");
    return cv_fail(why, CV_BAD_INPUT, "'%.*s%s' is not a decimal number", SHOWN, text,
                   n > SHOWN ? "..." : "");
}

/* Digits with at most one point from *s into d (digits has room for all of them); 0 when there is no digit.
 */
static int scan_mantissa(decimal *d, const char **s)
{
    size_t count = 0, kept = 0;
    int point = 0;
    for (;; ++*s) {
        if (**s == '.' && !point) {
            point = 1;
            continue;
        }
        if (!isdigit((unsigned char)**s))
            break;
        ++count;
        d->exponent -= point;
        if (kept > 0 || **s != '0')
            d->digits[kept++] = **s;
    }
    d->digits[kept] = '\0';
    return count > 0;
}

/* An optional exponent from *s, added to d. It stops growing far beyond any that can be accepted, so that no
 * text overflows it; 0 when "e" has no digits after it. */
static int scan_exponent(decimal *d, const char **s)
{
    if (**s != 'e' && **s != 'E')
        return 1;
    ++*s;
    const int negative = **s == '-';
    if (**s == '-' || **s == '+')
        ++*s;
    if (!isdigit((unsigned char)**s))
        return 0;
    long e = 0;
    for (; isdigit((unsigned char)**s); ++*s)
        if (e < LONG_MAX / 40)
            e = 10 * e + (**s - '0');
    d->exponent += negative ? -e : e;
    return 1;
}

static int scan(decimal *d, const char *text)
{
    const char *s = text;
    d->exponent = 0;
    d->negative = *s == '-';
    if (*s == '-' || *s == '+')
        ++s;
    return scan_mantissa(d, &s) && scan_exponent(d, &s) && *s == '\0';
}

/* to = the decimal, whose digits and exponent are known to be of moderate size */
static void build(mpq_t to, const decimal *d)
{
    mpz_t power;
    mpz_init(power);
    mpz_ui_pow_ui(power, 10, (unsigned long)labs(d->exponent));
    mpz_set_str(mpq_numref(to), d->digits, 10);
    mpz_set_ui(mpq_denref(to), 1);
    if (d->exponent >= 0)
        mpz_mul(mpq_numref(to), mpq_numref(to), power);
    else
        mpz_set(mpq_denref(to), power);
    mpq_canonicalize(to);
    if (d->negative)
        mpq_neg(to, to);
    mpz_clear(power);
}

/* 1e-300 <= magnitude <= 1e300, seen from the text alone: nothing large is built to find that it is large. */
static int in_range(const decimal *d)
{
    const long top = (long)strlen(d->digits) - 1 + d->exponent; /* exponent of the leading digit */
    if (top < -MAX_EXPONENT || top > MAX_EXPONENT)
        return 0;
    if (top < MAX_EXPONENT)
        return 1;
    return d->digits[0] == '1' && strspn(d->digits + 1, "0") == strlen(d->digits + 1);
}

cv_status cv_number_parse(cv_number *to, const char *text, cv_message *why)
{
    decimal d;
    d.digits = malloc(strlen(text) + 1);
    if (d.digits == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = CV_OK;
    if (!scan(&d, text)) {
        status = not_a_number(text, why);
    } else if (d.digits[0] == '\0') {
        mpq_set_ui(to->factor, 0, 1);
        mpq_set_ui(to->radicand, 1, 1);
    } else if (!in_range(&d)) {
        status = cv_fail(why, CV_BAD_INPUT, "'%.*s%s' is outside 1e-300 .. 1e300", SHOWN, text,
                         strlen(text) > SHOWN ? "..." : "");
    } else {
        build(to->factor, &d);
        mpq_set_ui(to->radicand, 1, 1);
    }
    free(d.digits);
    return status;
}

/* 1, with the decimal d of |x|, when x is a rational with a finite decimal expansion; d->digits is to be
 * freed with free and NULL when out of memory. */
static int exact_decimal(decimal *d, const cv_number *x)
{
    mpz_t rest, factor;
    mpz_inits(rest, factor, NULL);
    mpz_set_ui(factor, 2);
    const unsigned long twos = mpz_remove(rest, mpq_denref(x->factor), factor);
    mpz_set_ui(factor, 5);
    const unsigned long fives = mpz_remove(rest, rest, factor);
    const int finite = cv_number_is_rational(x) && mpz_cmp_ui(rest, 1) == 0;
    if (finite) {
        const unsigned long places = twos > fives ? twos : fives;
        mpz_ui_pow_ui(factor, 10, places);
        mpz_mul(factor, factor, mpq_numref(x->factor));
        mpz_divexact(factor, factor, mpq_denref(x->factor));
        mpz_abs(factor, factor);
        d->exponent = -(long)places;
        d->digits = malloc(mpz_sizeinbase(factor, 10) + 2);
        if (d->digits != NULL)
            mpz_get_str(d->digits, 10, factor);
    }
    mpz_clears(rest, factor, NULL);
    return finite;
}

/* d = |x| rounded to so many significant digits */
static void rounded_decimal(decimal *d, const cv_number *x, int digits)
{
    const size_t n = digits < 1 ? 1 : (size_t)digits;
    mpfr_t value;
    mpfr_init2(value, (mpfr_prec_t)(4 * n + 64));
    cv_number_get_mpfr(value, x);
    mpfr_abs(value, value, MPFR_RNDN);
    mpfr_exp_t point;
    d->digits = malloc(n + 8); /* mpfr_get_str asks for max(n + 2, 7) */
    if (d->digits != NULL)
        mpfr_get_str(d->digits, &point, 10, n, value, MPFR_RNDN);
    d->exponent = d->digits != NULL ? (long)point - (long)n : 0;
    mpfr_clear(value);
}

static void strip_trailing_zeros(decimal *d)
{
    size_t n = strlen(d->digits);
    for (; n > 1 && d->digits[n - 1] == '0'; --n)
        ++d->exponent;
    d->digits[n] = '\0';
}

/* d.ddde-XX */
static void write_scientific(FILE *out, const decimal *d, long top)
{
    fprintf(out, "%c", d->digits[0]);
    if (d->digits[1] != '\0')
        fprintf(out, ".%s", d->digits + 1);
    fprintf(out, "e%ld", top);
}

static void write_plain(FILE *out, const decimal *d)
{
    const long n = (long)strlen(d->digits);
    const long whole = n + d->exponent; /* digits before the point */
    if (whole <= 0)
        fprintf(out, "0.%.*s%s", (int)-whole, "00000000000000000000", d->digits);
    else if (whole >= n)
        fprintf(out, "%s%.*s", d->digits, (int)(whole - n), "00000000000000000000");
    else
        fprintf(out, "%.*s.%s", (int)whole, d->digits, d->digits + whole);
}

static char *write_decimal(const decimal *d)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL)
        return NULL;
    const long top = (long)strlen(d->digits) - 1 + d->exponent;
    if (d->negative)
        fprintf(out, "-");
    if (top < -5 || top > 20)
        write_scientific(out, d, top);
    else
        write_plain(out, d);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

char *cv_number_text(const cv_number *x, int digits)
{
    if (cv_number_sign(x) == 0)
        return strdup("0");
    decimal d = {.digits = NULL, .negative = cv_number_sign(x) < 0};
    if (!exact_decimal(&d, x))
        rounded_decimal(&d, x, digits);
    if (d.digits == NULL)
        return NULL;
    strip_trailing_zeros(&d);
    char *text = write_decimal(&d);
    free(d.digits);
    return text;
}
