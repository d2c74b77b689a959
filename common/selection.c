#include "common/selection.h"

static cv_optional_number *numbers(cv_selection *s, int i)
{
    cv_optional_number *const all[] = {&s->damping, &s->alpha, &s->frequency, &s->mass_ratio, NULL};
    return all[i];
}

void cv_selection_init(cv_selection *s)
{
    *s = (cv_selection){0};
    for (int i = 0; numbers(s, i) != NULL; ++i)
        cv_number_init(&numbers(s, i)->value);
}

void cv_selection_clear(cv_selection *s)
{
    for (int i = 0; numbers(s, i) != NULL; ++i)
        cv_number_clear(&numbers(s, i)->value);
}

cv_status cv_require(const cv_optional_number *option, const char *name, cv_message *why)
{
    return option->given ? CV_OK : cv_fail(why, CV_BAD_INPUT, "missing option --%s; see --help", name);
}

static cv_status check(const cv_selection *s, cv_message *why)
{
    if (cv_number_sign(&s->damping.value) < 0)
        return cv_fail(why, CV_BAD_INPUT, "--damping: must be >= 0");
    if (cv_number_sign(&s->alpha.value) < 0)
        return cv_fail(why, CV_BAD_INPUT, "--alpha: must be >= 0");
    if (s->mass_ratio.given && cv_number_sign(&s->mass_ratio.value) <= 0)
        return cv_fail(why, CV_BAD_INPUT, "--mass-ratio: must be > 0");
    return CV_OK;
}

cv_status cv_choose(cv_choice *out, const cv_selection *s, const char *path, cv_message *why)
{
    cv_status status = check(s, why);
    if (status == CV_OK)
        status = cv_casefile_read(&out->file, path, why);
    if (status != CV_OK)
        return status;
    status = cv_casefile_find(&out->chosen, &out->file, s->case_name, why);
    if (status != CV_OK) {
        cv_casefile_clear(&out->file);
        return status;
    }
    cv_params_init(&out->params);
    cv_case_params(&out->params, out->chosen, 0);
    if (s->damping.given) {
        cv_number_set(&out->params.eta_p, &s->damping.value);
        cv_number_set(&out->params.eta_b, &s->damping.value);
        cv_number_set(&out->params.eta_f, &s->damping.value);
    }
    out->digits = s->digits > 0 ? s->digits : out->file.digits;
    return CV_OK;
}

void cv_choice_clear(cv_choice *c)
{
    cv_params_clear(&c->params);
    cv_casefile_clear(&c->file);
}
