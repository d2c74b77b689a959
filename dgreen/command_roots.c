/* critvel-dgreen roots: mass-induced frequencies and growth rates at one velocity. */
#include <stdlib.h>

#include "dgreen/command.h"
#include "dgreen/command_json.h"
#include "dgreen/mass_roots.h"

static char *decimal(mpfr_srcptr x, int digits)
{
    char *text = NULL;
    return mpfr_asprintf(&text, "%.*Re", digits - 1, x) < 0 ? NULL : text;
}

static cv_status write_text(const dg_mass_roots *roots, int digits, FILE *out)
{
    if (fprintf(out, "%d unstable roots\n", roots->unstable_count) < 0)
        return CV_FAILED;
    for (size_t i = 0; i < roots->count; i++) {
        const dg_mass_root *r = &roots->items[i];
        if (mpfr_fprintf(out, "%s  re %.*Re  im %.*Re\n", mpfr_sgn(r->re) > 0 ? "unstable" : "stable  ",
                         digits - 1, r->re, digits - 1, r->im) < 0)
            return CV_FAILED;
    }
    return CV_OK;
}

static json_t *root_json(const dg_mass_root *r, int digits)
{
    char *re = decimal(r->re, digits), *im = decimal(r->im, digits);
    json_t *item = re == NULL || im == NULL
                       ? NULL
                       : json_pack("{s:s, s:s, s:b, s:f}", "re", re, "im", im, "unstable",
                                   mpfr_sgn(r->re) > 0, "log10_error", r->log_error);
    mpfr_free_str(re);
    mpfr_free_str(im);
    return item;
}

static cv_status write_json(const dg_mass_roots *roots, const cv_choice *choice, const cv_selection *s,
                            FILE *out)
{
    const cv_params *p = &choice->params;
    json_t *list = json_array();
    for (size_t i = 0; i < roots->count; i++)
        json_array_append_new(list, root_json(&roots->items[i], choice->digits));
    json_t *root = json_pack("{s:s, s:o, s:o, s:o, s:i, s:i, s:o}", "case", choice->chosen->name, "damping",
                             dg_json_damping(p), "alpha", dg_json_number(&s->alpha.value), "eta_M",
                             dg_json_number(&s->mass_ratio.value), "digits", choice->digits, "unstable_roots",
                             roots->unstable_count, "roots", list);
    const int failed = root == NULL || json_array_size(list) != roots->count ||
                       json_dumpf(root, out, JSON_INDENT(2)) != 0 || fputc('\n', out) == EOF;
    json_decref(root);
    return failed ? CV_FAILED : CV_OK;
}

static cv_status find_and_write(const cv_choice *choice, const cv_selection *s, FILE *out, cv_message *why)
{
    dg_sampler sampler;
    dg_mass_roots roots;
    const double alpha = cv_number_get_double(&s->alpha.value);
    if (!(alpha > 0))
        return cv_fail(why, CV_BAD_INPUT, "--alpha must be positive");
    cv_status status = dg_sampler_init(&sampler, &choice->params, alpha, alpha, why);
    if (status != CV_OK)
        return status;
    status = dg_find_mass_roots(&roots, &sampler, &s->alpha.value, &s->mass_ratio.value, choice->digits, why);
    if (status == CV_OK) {
        status = s->format == CV_FORMAT_JSON ? write_json(&roots, choice, s, out)
                                             : write_text(&roots, choice->digits, out);
        if (status != CV_OK)
            cv_fail(why, status, "cannot write: out of memory");
        dg_mass_roots_clear(&roots);
    }
    dg_sampler_clear(&sampler);
    return status;
}

cv_status dg_command_roots(const dg_options *options, const char *path, FILE *out, FILE *log, cv_message *why)
{
    const cv_selection *s = &options->selection;
    cv_choice choice;
    cv_message warning;
    cv_status status = cv_require(&s->alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_require(&s->mass_ratio, "mass-ratio", why);
    if (status == CV_OK)
        status = cv_choose(&choice, s, path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "warning: %s\n", warning.text);
    status = find_and_write(&choice, s, out, why);
    cv_choice_clear(&choice);
    return status;
}
