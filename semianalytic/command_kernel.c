/* critvel-semianalytic kernel: K(xi, q) and zeta(alpha, q) at one point. */
#include <jansson.h>
#include <stdlib.h>

#include "semianalytic/commands.h"
#include "semianalytic/decimal.h"
#include "semianalytic/kernel.h"
#include "semianalytic/quadrature.h"

/* What is printed. */
typedef struct {
    const cv_choice *choice;
    const sa_options *options;
    mpc_t zeta, kernel;
    double complex quadrature; /* where options->quadrature is set */
    double quadrature_error;
} answer;

/* relative to |K|; what double precision and a few milliseconds can do */
static const double quadrature_tolerance = 1e-10;

static json_t *json_complex(const mpc_t z, int digits)
{
    char *re = sa_decimal_text(mpc_realref(z), digits), *im = sa_decimal_text(mpc_imagref(z), digits);
    json_t *object = re != NULL && im != NULL ? json_pack("{s:s, s:s}", "re", re, "im", im) : NULL;
    free(re);
    free(im);
    return object;
}

static json_t *json_number(const cv_number *x)
{
    char *text = cv_number_text(x, 40);
    json_t *value = text != NULL ? json_string(text) : NULL;
    free(text);
    return value;
}

static json_t *json_parameters(const cv_params *p)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "mu_s", json_number(&p->mu_s), "mu_b",
                     json_number(&p->mu_b), "kappa_p", json_number(&p->kappa_p), "kappa_b",
                     json_number(&p->kappa_b), "eta_p", json_number(&p->eta_p), "eta_b",
                     json_number(&p->eta_b), "eta_f", json_number(&p->eta_f), "eta_s", json_number(&p->eta_s),
                     "eta_N", json_number(&p->eta_N));
}

static cv_status write_json(FILE *out, const answer *a, cv_message *why)
{
    const cv_selection *s = &a->options->selection;
    int digits = a->choice->digits;
    json_t *root =
        json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:i, s:o, s:o}", "schema", "critvel-semianalytic-kernel/1",
                  "case", a->choice->chosen->name, "parameters", json_parameters(&a->choice->params), "alpha",
                  json_number(&s->alpha.value), "frequency", json_number(&s->frequency.value), "xi",
                  json_number(&a->options->xi.value), "digits", digits, "zeta", json_complex(a->zeta, digits),
                  "K", json_complex(a->kernel, digits));
    if (root != NULL && a->options->quadrature)
        json_object_set_new(root, "quadrature",
                            json_pack("{s:f, s:f, s:f}", "re", creal(a->quadrature), "im",
                                      cimag(a->quadrature), "error", a->quadrature_error));
    if (root == NULL || json_dumpf(root, out, JSON_INDENT(2)) != 0 || fputc('\n', out) == EOF) {
        json_decref(root);
        return cv_fail(why, CV_FAILED, "out of memory");
    }
    json_decref(root);
    return CV_OK;
}

static int write_line(FILE *out, const char *label, const mpfr_t part, int digits)
{
    char *text = sa_decimal_text(part, digits);
    int done = text != NULL && fprintf(out, "%-8s %s\n", label, text) > 0;
    free(text);
    return done;
}

static cv_status write_text(FILE *out, const answer *a, cv_message *why)
{
    int digits = a->choice->digits;
    if (a->options->quadrature)
        fprintf(out, "%-8s %.12g\n%-8s %.12g\n%-8s %.1e\n", "Re K ~", creal(a->quadrature), "Im K ~",
                cimag(a->quadrature), "error ~", a->quadrature_error);
    if (write_line(out, "Re K", mpc_realref(a->kernel), digits) &&
        write_line(out, "Im K", mpc_imagref(a->kernel), digits) &&
        write_line(out, "Re zeta", mpc_realref(a->zeta), digits) &&
        write_line(out, "Im zeta", mpc_imagref(a->zeta), digits))
        return CV_OK;
    return cv_fail(why, CV_FAILED, "out of memory");
}

static cv_status evaluate(answer *a, const sa_options *options, cv_message *why)
{
    sa_track *track;
    cv_status status = sa_track_new(&track, &a->choice->params, why);
    if (status != CV_OK)
        return status;
    status =
        sa_kernel_digits(a->zeta, a->kernel, track, &options->selection.alpha.value,
                         &options->selection.frequency.value, &options->xi.value, a->choice->digits, why);
    if (status == CV_OK && options->quadrature)
        status = sa_quadrature_kernel(&a->quadrature, &a->quadrature_error, track,
                                      cv_number_get_double(&options->selection.alpha.value),
                                      cv_number_get_double(&options->selection.frequency.value),
                                      cv_number_get_double(&options->xi.value), quadrature_tolerance, why);
    sa_track_free(track);
    return status;
}

cv_status sa_command_kernel(const sa_options *options, const cv_arguments *arguments, FILE *out, FILE *log,
                            cv_message *why)
{
    cv_choice choice;
    answer a = {.choice = &choice, .options = options};
    (void)log;
    cv_status status = cv_require(&options->selection.alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_require(&options->selection.frequency, "frequency", why);
    if (status == CV_OK)
        status = cv_choose(&choice, &options->selection, arguments->path, why);
    if (status != CV_OK)
        return status;
    mpc_init2(a.zeta, MPFR_PREC_MIN);
    mpc_init2(a.kernel, MPFR_PREC_MIN);
    status = evaluate(&a, options, why);
    if (status == CV_OK)
        status =
            options->selection.format == CV_FORMAT_JSON ? write_json(out, &a, why) : write_text(out, &a, why);
    mpc_clear(a.zeta);
    mpc_clear(a.kernel);
    cv_choice_clear(&choice);
    return status;
}
