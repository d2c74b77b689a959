/* All instability lines of a track by either method: the
 * cases of table 1 at each damping level, eta_M from 1 to 10 000. Seconds belong to the machine; the ratios,
 * medians of rounds that interleave the methods, do not. semianalytic finds each vertex to 20 digits, dgreen
 * to those of a double. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "common/casefile.h"
#include "dgreen/lines.h"
#include "semianalytic/lines.h"

enum { ROUNDS = 3, METHODS = 2 };
static const char *const NAMES[METHODS] = {"semianalytic", "dgreen"};

static void check(cv_status status, const cv_message *why)
{
    if (status != CV_OK) {
        fprintf(stderr, "%s\n", why->text);
        exit(EXIT_FAILURE);
    }
}

static void find_semianalytic(const cv_params *params, const cv_casefile *file)
{
    sa_lines lines;
    cv_message why;
    cv_number least, most;
    cv_number_init(&least);
    cv_number_init(&most);
    mpq_set_ui(least.factor, 1, 1);
    mpq_set_ui(most.factor, 10000, 1);
    const sa_lines_range range = {&file->alpha_min, &file->alpha_max, &least, &most};
    check(sa_lines_find(&lines, params, &range, file->digits, &why), &why);
    sa_lines_clear(&lines);
    cv_number_clear(&least);
    cv_number_clear(&most);
}

static void find_dgreen(const cv_params *params, const cv_casefile *file)
{
    dg_lines lines;
    cv_message why;
    check(dg_lines_find(&lines, params, cv_number_get_double(&file->alpha_min),
                        cv_number_get_double(&file->alpha_max), 1, 10000, &why),
          &why);
    dg_lines_clear(&lines);
}

static double seconds_of(int method, const cv_params *params, const cv_casefile *file)
{
    struct timespec from, to;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
    if (method == 0)
        find_semianalytic(params, file);
    else
        find_dgreen(params, file);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
    return (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* One row: case and level */
static void measure(cv_case *one, size_t level, const cv_casefile *file)
{
    double time[METHODS][ROUNDS];
    cv_number_set(&one->params.eta_p, &one->levels[level].eta_p);
    cv_number_set(&one->params.eta_b, &one->levels[level].eta_b);
    cv_number_set(&one->params.eta_f, &one->levels[level].eta_f);
    for (int round = 0; round < ROUNDS; round++)
        for (int m = 0; m < METHODS; m++)
            time[m][round] = seconds_of(m, &one->params, file);
    printf("%-6s %-10g", one->name, cv_number_get_double(&one->levels[level].eta_p));
    for (int m = 0; m < METHODS; m++) {
        qsort(time[m], ROUNDS, sizeof time[m][0], ascending);
        printf(" %12.3f", time[m][ROUNDS / 2]);
    }
    printf(" %12.2f\n", time[1][ROUNDS / 2] / time[0][ROUNDS / 2]);
}

int main(void)
{
    cv_casefile file;
    cv_message why;
    check(cv_casefile_read(&file, "data/paper.ini", &why), &why);
    printf("%-6s %-10s %12s %12s %12s\n", "case", "damping", NAMES[0], NAMES[1], "ratio");
    for (size_t i = 0; i < file.case_count; i++)
        for (size_t k = 0; k < file.cases[i].level_count; k++)
            measure(&file.cases[i], k, &file);
    cv_casefile_clear(&file);
    mpfr_free_cache();
    return EXIT_SUCCESS;
}
