/* critvel-dgreen z: zeta at one point. */
#include <jansson.h>
#include <mpc.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/command.h"
#include "dgreen/z_mp.h"

/* The answer: the parts as decimals with the digits claimed; z is there when a mass ratio was given. */
typedef struct {
    char *zeta_re, *zeta_im, *z_re, *z_im;
} answer;

static void answer_clear(answer *a)
{
    mpfr_free_str(a->zeta_re);
    mpfr_free_str(a->zeta_im);
    if (a->z_re != NULL)
        mpfr_free_str(a->z_re);
    if (a->z_im != NULL)
        mpfr_free_str(a->z_im);
}

static char *decimal(mpfr_srcptr x, int digits)
{
    char *text = NULL;
    const int length =
        mpfr_zero_p(x) ? mpfr_asprintf(&text, "0") : mpfr_asprintf(&text, "%.*Re", digits - 1, x);
    return length < 0 ? NULL : text;
}

static cv_status write_digits(answer *a, const cv_choice *choice, const cv_selection *s, cv_message *why)
{
    dg_track *track;
    cv_status status = dg_track_new(&track, &choice->params, why);
    if (status != CV_OK)
        return status;
    mpc_t zeta;
    mpc_init2(zeta, 53);
    status = dg_zeta_digits(zeta, track, &s->alpha.value, NULL, &s->frequency.value, choice->digits, why);
    if (status == CV_OK) {
        a->zeta_re = decimal(mpc_realref(zeta), choice->digits);
        a->zeta_im = decimal(mpc_imagref(zeta), choice->digits);
    }
    if (status == CV_OK && s->mass_ratio.given) {
        mpfr_t mass;
        mpfr_init2(mass, mpfr_get_prec(mpc_realref(zeta)));
        cv_number_get_mpfr(mass, &s->mass_ratio.value);
        mpc_mul_fr(zeta, zeta, mass, MPC_RNDNN);
        mpfr_clear(mass);
        a->z_re = decimal(mpc_realref(zeta), choice->digits);
        a->z_im = decimal(mpc_imagref(zeta), choice->digits);
    }
    mpc_clear(zeta);
    dg_track_free(track);
    return status;
}

/* Decimal of a parameter, or its digits where it has none. */
static json_t *number(const cv_number *x, int digits)
{
    char *text = cv_number_text(x, digits);
    json_t *value = json_string(text);
    free(text);
    return value;
}

static cv_status write_json(const answer *a, const cv_choice *choice, const cv_selection *s, FILE *out,
                            cv_message *why)
{
    const cv_params *p = &choice->params;
    const int digits = choice->digits;
    json_t *damping = json_pack("{s:o, s:o, s:o}", "eta_p", number(&p->eta_p, digits), "eta_b",
                                number(&p->eta_b, digits), "eta_f", number(&p->eta_f, digits));
    json_t *root =
        json_pack("{s:s, s:o, s:o, s:o, s:i, s:{s:s, s:s}}", "case", choice->chosen->name, "damping", damping,
                  "alpha", number(&s->alpha.value, digits), "frequency", number(&s->frequency.value, digits),
                  "digits", digits, "zeta", "re", a->zeta_re, "im", a->zeta_im);
    int failed = root == NULL;
    if (!failed && a->z_re != NULL) {
        json_t *mass = number(&s->mass_ratio.value, digits);
        failed = json_object_set_new(root, "mass_ratio", mass) != 0 ||
                 json_object_set_new(root, "z", json_pack("{s:s, s:s}", "re", a->z_re, "im", a->z_im)) != 0;
    }
    failed = failed || json_dumpf(root, out, JSON_INDENT(2)) != 0 || fputc('\n', out) == EOF;
    json_decref(root);
    return failed ? cv_fail(why, CV_FAILED, "cannot write JSON: out of memory") : CV_OK;
}

static cv_status write_text(const answer *a, FILE *out, cv_message *why)
{
    int length = fprintf(out, "zeta  re  %s\nzeta  im  %s\n", a->zeta_re, a->zeta_im);
    if (length >= 0 && a->z_re != NULL)
        length = fprintf(out, "z     re  %s\nz     im  %s\n", a->z_re, a->z_im);
    return length < 0 ? cv_fail(why, CV_FAILED, "cannot write: out of memory") : CV_OK;
}

static cv_status write_answer(const cv_choice *choice, const cv_selection *s, FILE *out, cv_message *why)
{
    answer a = {NULL, NULL, NULL, NULL};
    cv_status status = write_digits(&a, choice, s, why);
    if (status != CV_OK)
        return status;
    status = s->format == CV_FORMAT_JSON ? write_json(&a, choice, s, out, why) : write_text(&a, out, why);
    answer_clear(&a);
    return status;
}

cv_status dg_command_z(const dg_options *options, const char *path, FILE *out, FILE *log, cv_message *why)
{
    const cv_selection *s = &options->selection;
    cv_choice choice;
    cv_message warning;
    cv_status status = cv_require(&s->alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_require(&s->frequency, "frequency", why);
    if (status == CV_OK)
        status = cv_choose(&choice, s, path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "warning: %s\n", warning.text);
    status = write_answer(&choice, s, out, why);
    cv_choice_clear(&choice);
    return status;
}
