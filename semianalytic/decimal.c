#include "semianalytic/decimal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 0.d1d2... * 10^exponent in plain notation, at the end of text; exponent is not above the number of digits
 */
static void plain(char *text, const char *digits, long exponent)
{
    if (exponent <= 0) {
        strcat(text, "0.");
        memset(text + strlen(text), '0', (size_t)-exponent); /* text was all NUL */
        strcat(text, digits);
    } else {
        strncat(text, digits, (size_t)exponent);
        if (digits[exponent] != '\0')
            strcat(text, ".");
        strcat(text, digits + exponent);
    }
}

static void scientific(char *text, const char *digits, long exponent)
{
    strncat(text, digits, 1);
    if (digits[1] != '\0')
        strcat(text, ".");
    sprintf(text + strlen(text), "%se%ld", digits + 1, exponent - 1);
}

char *sa_decimal_text(const mpfr_t x, int digits)
{
    mpfr_exp_t exponent;
    if (mpfr_zero_p(x))
        return strdup("0");
    char *raw = mpfr_number_p(x) ? mpfr_get_str(NULL, &exponent, 10, (size_t)digits, x, MPFR_RNDN) : NULL;
    char *text = raw != NULL ? calloc((size_t)digits + 64, 1) : NULL;
    if (text != NULL) {
        int negative = raw[0] == '-';
        if (negative)
            text[0] = '-';
        if (exponent > -5 && exponent <= 20 && exponent <= digits)
            plain(text, raw + negative, exponent);
        else
            scientific(text, raw + negative, exponent);
    }
    if (raw != NULL)
        mpfr_free_str(raw);
    return text;
}
