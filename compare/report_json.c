#include "compare/report.h"

#include <math.h>

#include <gmp.h>
#include <gsl/gsl_version.h>
#include <jansson.h>
#include <mpc.h>
#include <mpfr.h>

#include "common/cli.h"
#include "compare/format.h"

/* jansson passes NULL through: json_object_set_new of a NULL value returns -1 and json_dumpf of a NULL root
 * fails, but a lost member would go unnoticed, so every set is counted here. */
typedef struct {
    int failed;
    cmp_number_text text;
} writer;

static void set(writer *w, json_t *object, const char *key, json_t *value)
{
    w->failed |= json_object_set_new(object, key, value) != 0;
}

static void append(writer *w, json_t *array, json_t *value)
{
    w->failed |= json_array_append_new(array, value) != 0;
}

static void set_exact(writer *w, json_t *object, const char *key, const cv_number *x)
{
    set(w, object, key, json_string(cmp_format_exact(&w->text, x, 20)));
}

static json_t *json_libraries(writer *w)
{
    json_t *o = json_object();
    set(w, o, "gmp", json_string(gmp_version));
    set(w, o, "gsl", json_string(gsl_version));
    set(w, o, "jansson", json_string(jansson_version_str()));
    set(w, o, "mpc", json_string(mpc_get_version()));
    set(w, o, "mpfr", json_string(mpfr_get_version()));
    return o;
}

static json_t *json_program(writer *w)
{
    json_t *o = json_object();
    set(w, o, "version", json_string(CV_VERSION));
    set(w, o, "libraries", json_libraries(w));
    return o;
}

static json_t *json_parameters(writer *w, const cv_params *p)
{
    json_t *o = json_object();
    set_exact(w, o, "mu_s", &p->mu_s);
    set_exact(w, o, "mu_b", &p->mu_b);
    set_exact(w, o, "kappa_p", &p->kappa_p);
    set_exact(w, o, "kappa_b", &p->kappa_b);
    set_exact(w, o, "eta_s", &p->eta_s);
    set_exact(w, o, "eta_N", &p->eta_N);
    return o;
}

static json_t *json_damping(writer *w, const cv_params *p)
{
    json_t *o = json_object();
    set_exact(w, o, "eta_p", &p->eta_p);
    set_exact(w, o, "eta_b", &p->eta_b);
    set_exact(w, o, "eta_f", &p->eta_f);
    return o;
}

/* Velocities of a physical track beside the ratio alpha. */
static void set_velocity(writer *w, json_t *object, const char *prefix, const cmp_transition *t,
                         const cv_case *from, int digits)
{
    if (!from->is_track)
        return;
    char key[64];
    mpfr_t v;
    mpfr_init2(v, mpfr_get_prec(t->alpha));
    cmp_velocity(v, t->alpha, &from->physical, 0);
    snprintf(key, sizeof key, "%sm_s", prefix);
    set(w, object, key, json_string(cmp_format_mpfr(&w->text, v, digits)));
    cmp_velocity(v, t->alpha, &from->physical, 1);
    snprintf(key, sizeof key, "%skm_h", prefix);
    set(w, object, key, json_string(cmp_format_mpfr(&w->text, v, digits)));
    mpfr_clear(v);
}

static json_t *json_transition(writer *w, const cmp_transition *t, const cv_case *from, int digits)
{
    json_t *o = json_object();
    set(w, o, "alpha", json_string(cmp_format_claimed(&w->text, t->alpha, t->alpha_error, digits)));
    set(w, o, "q", json_string(cmp_format_claimed(&w->text, t->q, t->q_error, digits)));
    set(w, o, "alpha_error", json_string(cmp_format_mpfr(&w->text, t->alpha_error, 2)));
    set(w, o, "q_error", json_string(cmp_format_mpfr(&w->text, t->q_error, 2)));
    set(w, o, "unstable_roots_below", json_integer(t->below));
    set(w, o, "unstable_roots_above", json_integer(t->above));
    set(w, o, "decided", json_boolean(t->decided == CV_OK));
    set_velocity(w, o, "velocity_", t, from, digits);
    return o;
}

static json_t *json_list(writer *w, const cmp_list *list, const cv_case *from, int digits)
{
    json_t *o = json_object(), *all = json_array();
    const size_t limit = cmp_list_limit(list);
    for (size_t i = 0; i < list->count; i++)
        append(w, all, json_transition(w, &list->items[i], from, digits));
    set(w, o, "transitions", all);
    if (limit < list->count) {
        const cmp_transition *t = &list->items[limit];
        set(w, o, "stability_limit",
            json_string(cmp_format_claimed(&w->text, t->alpha, t->alpha_error, digits)));
        set_velocity(w, o, "stability_limit_", t, from, digits);
    } else {
        set(w, o, "stability_limit", json_null());
    }
    return o;
}

static json_t *json_digits(cmp_kind kind, double digits)
{
    return kind == CMP_AGREE && isfinite(digits) ? json_real(cmp_floor_tenth(digits)) : json_null();
}

static json_t *json_agreement(writer *w, const cmp_result *r)
{
    json_t *o = json_object();
    set(w, o, "verdict", json_string(cmp_kind_name(r->verdict.kind)));
    set(w, o, "digits", json_digits(r->verdict.kind, r->verdict.digits));
    set(w, o, "reason",
        r->verdict.reason.text[0] != '\0' ? json_string(r->verdict.reason.text) : json_null());
    set(w, o, "unstable_roots_at_start", r->counts.start >= 0 ? json_integer(r->counts.start) : json_null());
    set(w, o, "velocities_counted", json_integer((json_int_t)r->counts.samples));
    set(w, o, "searches", json_integer(r->searches));
    set(w, o, "largest_residual",
        mpfr_zero_p(r->worst.residual) ? json_null()
                                       : json_string(cmp_format_mpfr(&w->text, r->worst.residual, 2)));
    return o;
}

static json_t *json_mass(writer *w, const cmp_run *run, const cmp_case *c, const cmp_level *level,
                         size_t mass)
{
    json_t *o = json_object();
    set_exact(w, o, "eta_M", &c->from->mass_ratios[mass]);
    if (c->from->is_track) {
        mpfr_t kg;
        mpfr_init2(kg, 128);
        cmp_mass(kg, &c->from->mass_ratios[mass], &c->from->physical);
        set(w, o, "mass_kg", json_string(cmp_format_mpfr(&w->text, kg, 20)));
        mpfr_clear(kg);
    }
    for (int m = 0; m < CMP_METHODS; m++)
        set(w, o, run->methods[m]->name, json_list(w, &level->lists[m][mass], c->from, run->file->digits));
    set(w, o, "agreement", json_agreement(w, &level->results[mass]));
    return o;
}

static json_t *json_level(writer *w, const cmp_run *run, const cmp_case *c, const cmp_level *level)
{
    json_t *o = json_object(), *masses = json_array();
    set(w, o, "damping", json_damping(w, &level->params));
    for (size_t m = 0; m < c->from->mass_count; m++)
        append(w, masses, json_mass(w, run, c, level, m));
    set(w, o, "mass_ratios", masses);
    return o;
}

static json_t *json_case(writer *w, const cmp_run *run, const cmp_case *c)
{
    json_t *o = json_object(), *levels = json_array();
    set(w, o, "name", json_string(c->from->name));
    set(w, o, "parameters", json_parameters(w, &c->from->params));
    if (c->from->is_track) {
        mpfr_t v;
        mpfr_init2(v, 128);
        cv_track_reference_velocity(v, &c->from->physical);
        set(w, o, "reference_velocity_m_s", json_string(cmp_format_mpfr(&w->text, v, 20)));
        mpfr_clear(v);
    }
    for (size_t l = 0; l < c->level_count; l++)
        append(w, levels, json_level(w, run, c, &c->levels[l]));
    set(w, o, "levels", levels);
    return o;
}

static json_t *json_summary(writer *w, const cmp_summary *s)
{
    json_t *o = json_object();
    set(w, o, "combinations", json_integer((json_int_t)s->total));
    set(w, o, "agree", json_integer((json_int_t)s->of_kind[CMP_AGREE]));
    set(w, o, "disagree", json_integer((json_int_t)s->of_kind[CMP_DISAGREE]));
    set(w, o, "undecided", json_integer((json_int_t)s->of_kind[CMP_UNDECIDED]));
    set(w, o, "digits", json_digits(CMP_AGREE, s->fewest_digits));
    return o;
}

static json_t *json_printed(writer *w, const cmp_printed *printed)
{
    json_t *rows = json_array();
    for (size_t i = 0; i < printed->count; i++) {
        json_t *o = json_object();
        set(w, o, "item", json_string(printed->rows[i].item));
        set(w, o, "where", json_string(printed->rows[i].where));
        set(w, o, "printed", json_string(printed->rows[i].printed));
        set(w, o, "computed", json_string(printed->rows[i].computed));
        set(w, o, "verdict", json_string(printed->rows[i].agrees ? "agrees" : "differs"));
        append(w, rows, o);
    }
    return rows;
}

static json_t *json_range(writer *w, const cv_casefile *file)
{
    json_t *o = json_object();
    set_exact(w, o, "min", &file->alpha_min);
    set_exact(w, o, "max", &file->alpha_max);
    return o;
}

cv_status cmp_report_json(FILE *out, const cmp_run *run, const cmp_printed *printed, cv_message *why)
{
    writer w = {.failed = 0};
    cmp_summary summary;
    cmp_run_summary(&summary, run);
    json_t *root = json_object(), *cases = json_array();
    set(&w, root, "schema", json_string("critvel-compare/1"));
    set(&w, root, "program", json_program(&w));
    set(&w, root, "verdict", json_string(cmp_kind_name(summary.worst)));
    set(&w, root, "summary", json_summary(&w, &summary));
    set(&w, root, "digits", json_integer(run->file->digits));
    set(&w, root, "alpha", json_range(&w, run->file));
    for (size_t i = 0; i < run->case_count; i++)
        append(&w, cases, json_case(&w, run, &run->cases[i]));
    set(&w, root, "cases", cases);
    set(&w, root, "printed", json_printed(&w, printed));
    if (!w.failed && json_dumpf(root, out, JSON_INDENT(1) | JSON_REAL_PRECISION(12)) != 0)
        w.failed = 1;
    json_decref(root);
    return w.failed || fputc('\n', out) == EOF
               ? cv_fail(why, CV_FAILED, "the JSON report could not be written")
               : CV_OK;
}
