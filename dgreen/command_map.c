/* critvel-dgreen map: number of unstable roots and growth rate over mass ratio and velocity. Text is CSV. */
#include <math.h>
#include <stdlib.h>

#include "dgreen/command.h"
#include "dgreen/command_json.h"
#include "dgreen/map.h"

typedef struct {
    const cv_choice *choice;
    size_t rows, columns; /* velocities, mass ratios */
    double *alphas, *masses;
    dg_map_cell *cells; /* row after row */
} answer;

static void answer_clear(answer *a)
{
    free(a->alphas);
    free(a->masses);
    free(a->cells);
}

static cv_status prepare(answer *a, const dg_options *o, cv_message *why)
{
    a->rows = (size_t)o->alphas.count;
    a->columns = (size_t)o->masses.count;
    a->alphas = calloc(a->rows, sizeof *a->alphas);
    a->masses = calloc(a->columns, sizeof *a->masses);
    a->cells = calloc(a->rows * a->columns, sizeof *a->cells);
    if (a->alphas == NULL || a->masses == NULL || a->cells == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_number alpha;
    cv_number_init(&alpha);
    for (size_t i = 0; i < a->rows; i++) {
        dg_grid_linear(&alpha, &o->alphas, (long)i);
        a->alphas[i] = cv_number_get_double(&alpha);
    }
    cv_number_clear(&alpha);
    for (size_t i = 0; i < a->columns; i++)
        a->masses[i] = dg_grid_logarithmic(&o->masses, (long)i);
    return CV_OK;
}

/* A velocity whose curve cannot be sampled leaves its cells undecided and does not stop the others. */
static cv_status fill(answer *a, FILE *log, cv_message *why)
{
    dg_sampler sampler;
    cv_message reason;
    cv_status status =
        dg_sampler_init(&sampler, &a->choice->params, a->alphas[0], a->alphas[a->rows - 1], why);
    if (status != CV_OK)
        return status;
    for (size_t i = 0; i < a->rows && status == CV_OK; i++) {
        status =
            dg_map_row(&a->cells[i * a->columns], &sampler, a->alphas[i], a->columns, a->masses, &reason);
        if (status == CV_UNDECIDED) {
            fprintf(log, "warning: %s\n", reason.text);
            status = CV_OK;
        }
    }
    dg_sampler_clear(&sampler);
    return status == CV_OK ? CV_OK : cv_fail(why, status, "%s", reason.text);
}

/* CV_UNDECIDED when the number or the growth rate is missing anywhere */
static cv_status judge(const answer *a, cv_message *why)
{
    size_t missing = 0;
    for (size_t i = 0; i < a->rows * a->columns; i++)
        missing += a->cells[i].count < 0 || isnan(a->cells[i].growth);
    return missing == 0 ? CV_OK
                        : cv_fail(why, CV_UNDECIDED, "%zu of %zu points of the map are undecided", missing,
                                  a->rows * a->columns);
}

static cv_status write_csv(const answer *a, FILE *out)
{
    if (fprintf(out, "alpha,eta_M,unstable_roots,growth_rate,frequency\n") < 0)
        return CV_FAILED;
    for (size_t i = 0; i < a->rows * a->columns; i++) {
        const dg_map_cell *c = &a->cells[i];
        int length = fprintf(out, "%.17g,%.17g,", a->alphas[i / a->columns], a->masses[i % a->columns]);
        if (length >= 0 && c->count >= 0)
            length = fprintf(out, "%d", c->count);
        if (length >= 0)
            length = isnan(c->growth) ? fprintf(out, ",,\n")
                                      : fprintf(out, ",%.6e,%.6e\n", c->growth, c->frequency);
        if (length < 0)
            return CV_FAILED;
    }
    return CV_OK;
}

static json_t *reals(const double *x, size_t n)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++)
        json_array_append_new(list, json_real(x[i]));
    return list;
}

/* null for what is undecided */
static json_t *row_json(const answer *a, size_t row, int which)
{
    json_t *list = json_array();
    for (size_t i = 0; i < a->columns; i++) {
        const dg_map_cell *c = &a->cells[row * a->columns + i];
        const double x = which == 0 ? c->count : which == 1 ? c->growth : c->frequency;
        json_array_append_new(list, c->count < 0 || isnan(x) ? json_null()
                                    : which == 0             ? json_integer(c->count)
                                                             : json_real(x));
    }
    return list;
}

static cv_status write_json(const answer *a, FILE *out)
{
    const cv_params *p = &a->choice->params;
    json_t *tables[3];
    for (int which = 0; which < 3; which++) {
        tables[which] = json_array();
        for (size_t i = 0; i < a->rows; i++)
            json_array_append_new(tables[which], row_json(a, i, which));
    }
    json_t *root = json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o}", "case", a->choice->chosen->name,
                             "damping", dg_json_damping(p), "alpha", reals(a->alphas, a->rows), "eta_M",
                             reals(a->masses, a->columns), "unstable_roots", tables[0], "growth_rate",
                             tables[1], "frequency", tables[2]);
    const int failed = root == NULL || json_dumpf(root, out, JSON_INDENT(1)) != 0 || fputc('\n', out) == EOF;
    json_decref(root);
    return failed ? CV_FAILED : CV_OK;
}

static cv_status map_and_write(const cv_choice *choice, const dg_options *o, FILE *out, FILE *log,
                               cv_message *why)
{
    answer a = {choice, 0, 0, NULL, NULL, NULL};
    cv_status status = prepare(&a, o, why);
    if (status == CV_OK)
        status = fill(&a, log, why);
    if (status == CV_OK) {
        status = o->selection.format == CV_FORMAT_JSON ? write_json(&a, out) : write_csv(&a, out);
        status = status == CV_OK ? judge(&a, why) : cv_fail(why, status, "cannot write: out of memory");
    }
    answer_clear(&a);
    return status;
}

cv_status dg_command_map(const dg_options *options, const char *path, FILE *out, FILE *log, cv_message *why)
{
    cv_choice choice;
    cv_message warning;
    if (!options->alphas.given || !options->masses.given)
        return cv_fail(why, CV_BAD_INPUT,
                       "--alpha and --mass-ratio are needed, first:last:count each; see --help");
    if (cv_number_sign(&options->alphas.first) <= 0 || cv_number_sign(&options->masses.first) <= 0)
        return cv_fail(why, CV_BAD_INPUT, "--alpha and --mass-ratio must be positive");
    cv_status status = cv_choose(&choice, &options->selection, path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "warning: %s\n", warning.text);
    status = map_and_write(&choice, options, out, log, why);
    cv_choice_clear(&choice);
    return status;
}
