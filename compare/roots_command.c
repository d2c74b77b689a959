/* critvel-compare roots */
#include "common/cli.h"
#include "compare/commands.h"
#include "compare/roots_report.h"

static const char HELP[] =
    "usage: critvel-compare roots FILE --alpha X --mass-ratio M [options]\n"
    "\n"
    "Finds the roots qbar of the characteristic equation z = 1 (growth rate Re qbar, mass-induced frequency\n"
    "Im qbar) at one velocity and mass ratio by both methods: all unstable ones, counted by the argument\n"
    "principle, and the nearest stable ones. Pairs them, puts each into the z of both methods, and says how\n"
    "many digits agree. Neither method claims to list all stable roots: one that only one of them lists "
    "must\n"
    "satisfy z = 1 of the other.\n"
    "\n"
    "  --alpha X         velocity ratio, > 0\n"
    "  --mass-ratio M    eta_M, > 0\n"
    "  --case NAME       the section [case NAME] or [track NAME]; default: the first\n"
    "  --damping X       eta_p = eta_b = eta_f = X instead of the first level of the file\n"
    "  --digits N        digits of each part; default: those of the file\n"
    "  --format FORMAT   text (default) or json (schema critvel-compare-roots/1)\n"
    "  --help            this text\n"
    "  --version         the version\n"
    "\n"
    "example: critvel-compare roots data/paper.ini --case 3 --damping 1e-4 --alpha 0.45 --mass-ratio 100\n"
    "exit status: 0 everything agrees, 1 a disagreement or an undecided result, 2 bad usage or bad input,\n"
    "3 internal or I/O failure\n";

static const cv_option OPTIONS[] = {CV_OPTION_CASE(0),  CV_OPTION_DAMPING(0),    CV_OPTION_DIGITS(0),
                                    CV_OPTION_ALPHA(0), CV_OPTION_MASS_RATIO(0), CV_OPTION_FORMAT(0),
                                    {NULL, NULL, 0, 0}};

static cv_status compare(const cv_selection *s, const cv_choice *choice, FILE *out, cv_message *why)
{
    static const cmp_root_method *const methods[] = {&cmp_roots_semianalytic, &cmp_roots_dgreen};
    cmp_roots roots;
    if (cv_params_undamped(&choice->params))
        return cv_fail(why, CV_BAD_INPUT,
                       "roots need damping: without it the branch points of z lie on the "
                       "imaginary axis");
    cv_status status = cmp_roots_compare(&roots, methods, &choice->params, &s->alpha.value,
                                         &s->mass_ratio.value, choice->digits, why);
    if (status != CV_OK)
        return status;
    const cmp_roots_report report = {choice, s, {methods[0]->name, methods[1]->name}, &roots};
    status = s->format == CV_FORMAT_JSON ? cmp_roots_report_json(out, &report, why)
                                         : cmp_roots_report_text(out, &report, why);
    if (status == CV_OK && roots.verdict.kind != CMP_AGREE)
        status = CV_UNDECIDED;
    cmp_roots_clear(&roots);
    return status;
}

static cv_status work(const void *typed, const cv_arguments *arguments, FILE *out, FILE *log, cv_message *why)
{
    const cv_selection *s = typed;
    cv_choice choice;
    cv_message warning;
    cv_status status = cv_require(&s->alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_require(&s->mass_ratio, "mass-ratio", why);
    if (status == CV_OK && cv_number_sign(&s->alpha.value) <= 0)
        status = cv_fail(why, CV_BAD_INPUT, "--alpha must be positive");
    if (status == CV_OK)
        status = cv_choose(&choice, s, arguments->path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "critvel-compare: warning: %s\n", warning.text);
    status = compare(s, &choice, out, why);
    cv_choice_clear(&choice);
    return status;
}

int cmp_roots_main(int argc, char **argv)
{
    static const char *const commands[] = {"roots", NULL};
    const cv_program program = {"critvel-compare", HELP, commands, OPTIONS, work};
    cv_selection selection;
    cv_selection_init(&selection);
    const int status = cv_main(&program, &selection, argc, argv);
    cv_selection_clear(&selection);
    return status;
}
