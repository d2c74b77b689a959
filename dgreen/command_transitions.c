/* critvel-dgreen transitions: all changes of the number of unstable roots over the velocity range. */
#include <jansson.h>
#include <stdlib.h>

#include "dgreen/command.h"
#include "dgreen/transitions.h"

typedef struct {
    const cv_choice *choice;
    size_t count;
    const cv_number *masses;
    dg_transition_list *lists;
    dg_effort effort;
} answer;

static cv_status write_list(const dg_transition_list *list, int digits, FILE *out)
{
    if (list->status != CV_OK && fprintf(out, "    undecided: %s\n", list->why.text) < 0)
        return CV_FAILED;
    for (size_t i = 0; i < list->count; i++) {
        const dg_transition *t = &list->items[i];
        if (mpfr_fprintf(out, "    alpha %.*Re  q %.*Re  %d -> %d%s\n", digits - 1, t->alpha, digits - 1,
                         t->frequency, t->count_below, t->count_above,
                         t->decided == CV_OK ? "" : "  (undecided)") < 0)
            return CV_FAILED;
    }
    return CV_OK;
}

static cv_status write_text(const answer *a, FILE *out, cv_message *why)
{
    for (size_t i = 0; i < a->count; i++) {
        char *mass = cv_number_text(&a->masses[i], 17);
        const int length = mass == NULL ? -1
                                        : fprintf(out, "eta_M %s: %d unstable roots at the lowest velocity\n",
                                                  mass, a->lists[i].count_at_min);
        free(mass);
        if (length < 0 || write_list(&a->lists[i], a->choice->digits, out) != CV_OK)
            return cv_fail(why, CV_FAILED, "cannot write: out of memory");
    }
    return CV_OK;
}

static json_t *decimal(mpfr_srcptr x, int digits)
{
    char *text = NULL;
    if (mpfr_asprintf(&text, "%.*Re", digits - 1, x) < 0)
        return NULL;
    json_t *value = json_string(text);
    mpfr_free_str(text);
    return value;
}

static json_t *number(const cv_number *x)
{
    char *text = cv_number_text(x, 17);
    json_t *value = json_string(text);
    free(text);
    return value;
}

static json_t *list_json(const dg_transition_list *list, const cv_number *mass, int digits)
{
    json_t *items = json_array(), *limit = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const dg_transition *t = &list->items[i];
        json_t *item = json_pack("{s:o, s:o, s:i, s:i, s:b}", "alpha", decimal(t->alpha, digits), "q",
                                 decimal(t->frequency, digits), "unstable_roots_below", t->count_below,
                                 "unstable_roots_above", t->count_above, "decided", t->decided == CV_OK);
        if (limit == NULL && t->count_below == 0)
            limit = decimal(t->alpha, digits);
        if (json_array_append_new(items, item) != 0) {
            json_decref(items);
            json_decref(limit);
            return NULL;
        }
    }
    return json_pack("{s:o, s:b, s:s*, s:i, s:o, s:o?}", "eta_M", number(mass), "decided",
                     list->status == CV_OK, "reason", list->status == CV_OK ? NULL : list->why.text,
                     "unstable_roots_at_alpha_min", list->count_at_min, "transitions", items,
                     "stability_limit", limit);
}

static cv_status write_json(const answer *a, FILE *out, cv_message *why)
{
    const cv_params *p = &a->choice->params;
    json_t *lists = json_array();
    int failed = lists == NULL;
    for (size_t i = 0; i < a->count && !failed; i++)
        failed = json_array_append_new(lists, list_json(&a->lists[i], &a->masses[i], a->choice->digits)) != 0;
    json_t *damping = json_pack("{s:o, s:o, s:o}", "eta_p", number(&p->eta_p), "eta_b", number(&p->eta_b),
                                "eta_f", number(&p->eta_f));
    json_t *effort = json_pack("{s:I, s:I, s:I}", "evaluations", (json_int_t)a->effort.evaluations,
                               "above_double", (json_int_t)a->effort.above_double, "largest_precision",
                               (json_int_t)a->effort.largest_precision);
    json_t *root = json_pack("{s:s, s:o, s:i, s:o, s:o}", "case", a->choice->chosen->name, "damping", damping,
                             "digits", a->choice->digits, "mass_ratios", lists, "effort", effort);
    failed = failed || root == NULL || json_dumpf(root, out, JSON_INDENT(2)) != 0 || fputc('\n', out) == EOF;
    json_decref(root);
    return failed ? cv_fail(why, CV_FAILED, "cannot write JSON: out of memory") : CV_OK;
}

static cv_status find_and_write(const cv_choice *choice, const cv_selection *s, FILE *out, cv_message *why)
{
    answer a = {choice,
                s->mass_ratio.given ? 1 : choice->chosen->mass_count,
                s->mass_ratio.given ? &s->mass_ratio.value : choice->chosen->mass_ratios,
                NULL,
                {0, 0, 0}};
    a.lists = calloc(a.count, sizeof *a.lists);
    if (a.lists == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = dg_find_transitions(a.lists, &a.effort, &choice->params, &choice->file.alpha_min,
                                           &choice->file.alpha_max, a.count, a.masses, choice->digits, 0, why);
    if (status == CV_OK)
        status = s->format == CV_FORMAT_JSON ? write_json(&a, out, why) : write_text(&a, out, why);
    for (size_t i = 0; i < a.count; i++) {
        if (status == CV_OK && a.lists[i].status != CV_OK)
            status = cv_fail(why, CV_UNDECIDED, "%s", a.lists[i].why.text);
        dg_transition_list_clear(&a.lists[i]);
    }
    free(a.lists);
    return status;
}

cv_status dg_command_transitions(const dg_options *options, const char *path, FILE *out, FILE *log,
                                 cv_message *why)
{
    const cv_selection *s = &options->selection;
    cv_choice choice;
    cv_message warning;
    const cv_status status = cv_choose(&choice, s, path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "warning: %s\n", warning.text);
    const cv_status done = find_and_write(&choice, s, out, why);
    cv_choice_clear(&choice);
    return done;
}
