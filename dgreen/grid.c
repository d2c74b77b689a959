#include "dgreen/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void dg_grid_init(dg_grid *g)
{
    g->given = 0;
    g->count = 0;
    cv_number_init(&g->first);
    cv_number_init(&g->last);
}

void dg_grid_clear(dg_grid *g)
{
    cv_number_clear(&g->first);
    cv_number_clear(&g->last);
}

/* The number in the first "length" characters of text */
static cv_status parse_part(cv_number *to, const char *text, size_t length, cv_message *why)
{
    char part[400];
    if (length >= sizeof part)
        return cv_fail(why, CV_BAD_INPUT, "number too long");
    memcpy(part, text, length);
    part[length] = '\0';
    return cv_number_parse(to, part, why);
}

static cv_status parse_count(long *count, const char *text, cv_message *why)
{
    char *end;
    const size_t digits = strspn(text, "0123456789");
    *count = strtol(text, &end, 10);
    if (digits == 0 || digits > 6 || *end != '\0' || *count < 2 || *count > DG_GRID_MAX)
        return cv_fail(why, CV_BAD_INPUT, "number of points must be 2 to %d, not \"%.40s\"", DG_GRID_MAX,
                       text);
    return CV_OK;
}

cv_status dg_grid_parse(dg_grid *g, const char *text, cv_message *why)
{
    const char *colon = strchr(text, ':'), *second = colon == NULL ? NULL : strchr(colon + 1, ':');
    g->given = 1;
    g->count = 1;
    if (colon == NULL) {
        const cv_status status = cv_number_parse(&g->first, text, why);
        cv_number_set(&g->last, &g->first);
        return status;
    }
    const size_t last = second == NULL ? strlen(colon + 1) : (size_t)(second - colon - 1);
    g->count = 0;
    cv_status status = parse_part(&g->first, text, (size_t)(colon - text), why);
    if (status == CV_OK)
        status = parse_part(&g->last, colon + 1, last, why);
    if (status == CV_OK && second != NULL)
        status = parse_count(&g->count, second + 1, why);
    if (status == CV_OK && cv_number_compare(&g->first, &g->last) >= 0)
        return cv_fail(why, CV_BAD_INPUT, "the last point must be greater than the first");
    return status;
}

void dg_grid_linear(cv_number *to, const dg_grid *g, long i)
{
    cv_number_set(to, &g->first);
    if (g->count == 1)
        return;
    mpq_t part;
    mpq_init(part);
    mpq_set_si(part, i, (unsigned long)(g->count - 1));
    mpq_canonicalize(part);
    mpq_sub(to->factor, g->last.factor, g->first.factor);
    mpq_mul(to->factor, to->factor, part);
    mpq_add(to->factor, to->factor, g->first.factor);
    mpq_clear(part);
}

double dg_grid_logarithmic(const dg_grid *g, long i)
{
    const double first = cv_number_get_double(&g->first), last = cv_number_get_double(&g->last);
    if (i == 0)
        return first;
    if (i == g->count - 1)
        return last;
    return first * pow(last / first, (double)i / (double)(g->count - 1));
}
