/* critvel-dgreen count: number of unstable roots at one velocity. */
#include <stdlib.h>

#include "dgreen/command.h"
#include "dgreen/command_json.h"
#include "dgreen/count.h"

/* The mass ratios: the one that was typed, or those of the case. */
static const cv_number *choose_masses(size_t *count, const cv_choice *choice, const cv_selection *s)
{
    *count = s->mass_ratio.given ? 1 : choice->chosen->mass_count;
    return s->mass_ratio.given ? &s->mass_ratio.value : choice->chosen->mass_ratios;
}

static cv_status write_text(const int *roots, const cv_number *masses, size_t count, FILE *out,
                            cv_message *why)
{
    for (size_t i = 0; i < count; i++) {
        char *text = cv_number_text(&masses[i], 17);
        const int length = text == NULL ? -1 : fprintf(out, "eta_M %s: %d unstable roots\n", text, roots[i]);
        free(text);
        if (length < 0)
            return cv_fail(why, CV_FAILED, "cannot write: out of memory");
    }
    return CV_OK;
}

static cv_status write_json(const int *roots, const cv_number *masses, size_t count, const cv_choice *choice,
                            const cv_number *alpha, FILE *out, cv_message *why)
{
    const cv_params *p = &choice->params;
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(
            list, json_pack("{s:o, s:i}", "eta_M", dg_json_number(&masses[i]), "unstable_roots", roots[i]));
    json_t *root = json_pack("{s:s, s:o, s:o, s:o}", "case", choice->chosen->name, "damping",
                             dg_json_damping(p), "alpha", dg_json_number(alpha), "mass_ratios", list);
    const int failed = root == NULL || json_array_size(list) != count ||
                       json_dumpf(root, out, JSON_INDENT(2)) != 0 || fputc('\n', out) == EOF;
    json_decref(root);
    return failed ? cv_fail(why, CV_FAILED, "cannot write JSON: out of memory") : CV_OK;
}

static cv_status count_and_write(const cv_choice *choice, const cv_selection *s, FILE *out, cv_message *why)
{
    size_t count, failed;
    dg_counter *counter = NULL;
    const cv_number *masses = choose_masses(&count, choice, s);
    const double alpha = cv_number_get_double(&s->alpha.value);
    int *roots = calloc(count, sizeof *roots);
    if (roots == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = cv_number_sign(&s->alpha.value) > 0
                           ? dg_counter_new(&counter, &choice->params, alpha, alpha, why)
                           : cv_fail(why, CV_BAD_INPUT, "--alpha must be positive");
    if (status == CV_OK)
        status = dg_count_unstable(roots, &failed, counter, alpha, count, masses, why);
    if (status == CV_OK)
        status = s->format == CV_FORMAT_JSON
                     ? write_json(roots, masses, count, choice, &s->alpha.value, out, why)
                     : write_text(roots, masses, count, out, why);
    dg_counter_free(counter);
    free(roots);
    return status;
}

cv_status dg_command_count(const dg_options *options, const char *path, FILE *out, FILE *log, cv_message *why)
{
    const cv_selection *s = &options->selection;
    cv_choice choice;
    cv_message warning;
    cv_status status = cv_require(&s->alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_choose(&choice, s, path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "warning: %s\n", warning.text);
    status = count_and_write(&choice, s, out, why);
    cv_choice_clear(&choice);
    return status;
}
