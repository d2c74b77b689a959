/* Steady shapes against the Fourier integral itself (GSL quadrature), put back into (7), and the limits of
 * small damping and of a resting force; the subcommands steady and resonances as a user sees them. */
#include <check.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <jansson.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "semianalytic/commands.h"
#include "semianalytic/steady.h"
#include "tests/random_track.h"

static const double paper_case[4][6] = {
    {6, 35, 300, 7, 0, 0}, {6, 35, 30, 7, 0, 0}, {6, 5, 0.03, 3, 0, 0}, {3, 10, 0.03, 0.1, 0, 0}};

static void choose(cv_params *params, gsl_rng *rng, int track, const double eta[3])
{
    if (track < 4) {
        set_track(params, paper_case[track]);
    } else {
        random_track(params, rng);
    }
    set_decimal(&params->eta_p, eta[0]);
    set_decimal(&params->eta_b, eta[1]);
    set_decimal(&params->eta_f, eta[2]);
}

/* (8)-(10) at q = 0 for complex p, s = -i alpha p */
typedef struct {
    complex double D1, D2, D3, D4, D567;
} entries;

static entries entries_at(const cv_params *t, double alpha, complex double p)
{
    complex double s = -(complex double)_Complex_I * alpha * p;
    double eta_N = cv_number_get_double(&t->eta_N), eta_s = cv_number_get_double(&t->eta_s);

    return (entries){p * p * p * p / 4 + s * s - eta_N * p * p,
                     2 * cv_number_get_double(&t->eta_p) * s + cv_number_get_double(&t->kappa_p),
                     cv_number_get_double(&t->mu_s) * s * s,
                     2 * cv_number_get_double(&t->eta_b) * s + cv_number_get_double(&t->kappa_b),
                     cv_number_get_double(&t->mu_b) * s * s + 2 * cv_number_get_double(&t->eta_f) * s + 1 +
                         eta_s * p * p};
}

typedef struct {
    const cv_params *track;
    double alpha, xi;
    int field;
} integrand_data;

/* (2/pi) Re(field/force e^{ip xi}) by Cramer's rule on (7) */
static double integrand(double p, void *data)
{
    const integrand_data *t = data;
    entries e = entries_at(t->track, t->alpha, p);
    complex double a = e.D1 + e.D2, b = e.D2 + e.D3 + e.D4, c = e.D4 + e.D567;
    complex double det = a * (b * c - e.D4 * e.D4) - e.D2 * e.D2 * c;
    complex double top[3] = {b * c - e.D4 * e.D4, e.D2 * c, e.D2 * e.D4};

    return 2 / M_PI * creal(top[t->field] / det * cexp((complex double)_Complex_I * p * t->xi));
}

START_TEST(shapes_are_the_fourier_integral)
{
    gsl_rng *rng = random_start("quadrature", 41);
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(4000);
    cv_params params;
    cv_number alpha;

    cv_params_init(&params);
    cv_number_init(&alpha);
    for (int i = 0; i < 60; i++) {
        const double eta[3] = {log_uniform(rng, 0.02, 0.3), log_uniform(rng, 0.02, 0.3),
                               log_uniform(rng, 0.02, 0.3)};
        integrand_data data = {&params, log_uniform(rng, 0.05, 1.5), 0, i % 3};
        gsl_function function = {integrand, &data};
        sa_steady s;
        choose(&params, rng, i / 4, eta);
        set_decimal(&alpha, data.alpha);
        data.alpha = cv_number_get_double(&alpha);
        data.xi = 8 * gsl_rng_uniform(rng) - 4;
        ck_assert_int_eq(sa_steady_solve(&s, &params, &alpha, NULL), CV_OK);
        long double u[SA_FIELDS], top[SA_FIELDS];
        sa_steady_at(u, &s, data.xi);
        sa_steady_at(top, &s, 0);
        double total = 0, part, error, low = 0, sum_error = 0;
        for (double high = 0.5; high < 2000; low = high, high *= 2) {
            int status = gsl_integration_qag(&function, low, high, 1e-11, 1e-10, 4000, GSL_INTEG_GAUSS61,
                                             work, &part, &error);
            ck_assert_msg(status == GSL_SUCCESS || error < 1e-9, "quadrature: %s", gsl_strerror(status));
            total += part;
            sum_error += error;
        }
        /* the tail beyond 1024 is below 8/(3 pi 1024^3) */
        ck_assert_msg(fabs(total - (double)u[data.field]) <= 1e-8 * fabs((double)top[0]) + 3e-9 + sum_error,
                      "track %d field %d alpha %g xi %g: %.12g, integral %.12g", i / 4, data.field,
                      data.alpha, data.xi, (double)u[data.field], total);
    }
    gsl_integration_workspace_free(work);
    cv_params_clear(&params);
    cv_number_clear(&alpha);
    gsl_rng_free(rng);
}
END_TEST

/* Each term solves the three equations; those of the two sides meet at the force (defect). Two roots lie
 * ahead when alpha^2 mu_b > eta_s, else three: the count is constant in Re qbar > 0 and, with damping, at
 * qbar = 0. */
START_TEST(shapes_solve_the_equations)
{
    gsl_rng *rng = random_start("equations", 42);
    cv_params params;
    cv_number alpha;

    cv_params_init(&params);
    cv_number_init(&alpha);
    for (int i = 0; i < 300; i++) {
        const double eta[3] = {log_uniform(rng, 1e-10, 0.5), log_uniform(rng, 1e-10, 0.5),
                               i % 2 ? log_uniform(rng, 1e-10, 0.5) : 0};
        sa_steady s;
        choose(&params, rng, i / 4, eta);
        set_decimal(&alpha, log_uniform(rng, 0.02, 3));
        if (sa_steady_solve(&s, &params, &alpha, NULL) != CV_OK) {
            ck_abort_msg("track %d: no steady shape", i / 4);
        }
        ck_assert_msg(s.defect <= 1e-12, "track %d alpha %g: defect %g", i / 4, cv_number_get_double(&alpha),
                      s.defect);
        int ahead = 0;
        for (int j = 0; j < s.count; j++) {
            ahead += s.term[j].ahead;
            const sa_steady_term *term = &s.term[j];
            complex double p = (complex double)term->p * (term->ahead ? 1 : -1);
            complex double w = (complex double)term->weight[0], v = (complex double)term->weight[1];
            complex double u = (complex double)term->weight[2];
            entries e = entries_at(&params, cv_number_get_double(&alpha), p);
            complex double row[3] = {e.D1 * w + e.D2 * (w - v), e.D3 * v - e.D2 * (w - v) + e.D4 * (v - u),
                                     e.D567 * u - e.D4 * (v - u)};
            double size = (cabs(p * p * p * p) + cabs(e.D2) + cabs(e.D3) + cabs(e.D4) + cabs(e.D567) + 1) *
                          (cabs(w) + cabs(v) + cabs(u));
            ck_assert_double_ge((double)cimagl(term->p), 0);
            for (int r = 0; r < 3; r++) {
                ck_assert_msg(cabs(row[r]) <= 1e-10 * size, "track %d row %d: %g of %g", i / 4, r,
                              cabs(row[r]), size);
            }
        }
        double velocity = cv_number_get_double(&alpha);
        int is_fast =
            velocity * velocity * cv_number_get_double(&params.mu_b) > cv_number_get_double(&params.eta_s);
        ck_assert_int_eq(ahead, is_fast ? 2 : 3);
    }
    cv_params_clear(&params);
    cv_number_clear(&alpha);
    gsl_rng_free(rng);
}
END_TEST

/* Without damping: the limit of small damping, which fixes on which side each wave runs. */
START_TEST(undamped_is_the_limit_of_small_damping)
{
    const double none[3] = {0, 0, 0}, small[3] = {1e-9, 1e-9, 1e-9};
    const char *const velocity[] = {"0.05", "0.14", "0.3", "0.42", "0.6", "0.9", "1.7"};
    cv_params params;
    cv_number alpha;

    cv_params_init(&params);
    cv_number_init(&alpha);
    for (int track = 0; track < 4; track++) {
        for (size_t i = 0; i < sizeof velocity / sizeof velocity[0]; i++) {
            sa_steady undamped, damped;
            ck_assert_int_eq(cv_number_parse(&alpha, velocity[i], NULL), CV_OK);
            choose(&params, NULL, track, none);
            ck_assert_int_eq(sa_steady_solve(&undamped, &params, &alpha, NULL), CV_OK);
            choose(&params, NULL, track, small);
            ck_assert_int_eq(sa_steady_solve(&damped, &params, &alpha, NULL), CV_OK);
            ck_assert_double_le(undamped.defect, 1e-14);
            for (double xi = -7; xi < 8; xi += 1.3) {
                long double u[SA_FIELDS], v[SA_FIELDS];
                sa_steady_at(u, &undamped, xi);
                sa_steady_at(v, &damped, xi);
                for (int f = 0; f < SA_FIELDS; f++) {
                    ck_assert_msg(fabsl(u[f] - v[f]) <= 1e-6L * (1 + fabsl(u[f])),
                                  "case %d alpha %s xi %g: %Lg, %Lg", track + 1, velocity[i], xi, u[f], v[f]);
                }
            }
        }
    }
    cv_params_clear(&params);
    cv_number_clear(&alpha);
}
END_TEST

/* (3): deflection 1 under a resting force on a Winkler foundation; all layers follow a rigid connection. */
START_TEST(resting_force)
{
    const double rigid[6] = {1, 2.5, 1e12, 1e12, 0, 0};
    cv_params params;
    cv_number alpha;
    sa_steady s;
    long double u[SA_FIELDS];

    cv_params_init(&params);
    cv_number_init(&alpha);
    set_track(&params, rigid);
    set_decimal(&params.eta_b, 0.3);
    ck_assert_int_eq(sa_steady_solve(&s, &params, &alpha, NULL), CV_OK);
    sa_steady_at(u, &s, 0);
    for (int f = 0; f < SA_FIELDS; f++) {
        ck_assert(fabsl(u[f] - 1) < 1e-5L);
    }
    ck_assert(fabsl(u[0] - 1) < 1e-11L);
    cv_params_clear(&params);
    cv_number_clear(&alpha);
}
END_TEST

/* Runs a command on a file with case 3; *text is allocated. */
static cv_status run(sa_command *command, sa_options *options, char **text, cv_message *why)
{
    char path[] = "/tmp/critvel-test-XXXXXX";
    size_t size = 0;
    int descriptor = mkstemp(path);
    FILE *file = fdopen(descriptor, "w");

    fputs("[run]\nalpha = 0.02 2\ndigits = 20\ndamping = 0.1\nmass_ratio = 1\n[case 3]\nmu_s = 6\nmu_b = "
          "5\nkappa_p = 0.03\n"
          "kappa_b = 3\neta_s = 0\neta_N = 0\n",
          file);
    fclose(file);
    FILE *out = open_memstream(text, &size);
    const cv_arguments arguments = {"", path};
    cv_status status = command(options, &arguments, out, stderr, why);
    fclose(out);
    remove(path);
    return status;
}

static void options_init(sa_options *o)
{
    memset(o, 0, sizeof *o);
    cv_selection_init(&o->selection);
    cv_number_init(&o->xi.value);
    cv_number_init(&o->from.value);
    cv_number_init(&o->to.value);
    cv_number_init(&o->points.value);
}

static void options_clear(sa_options *o)
{
    cv_selection_clear(&o->selection);
    cv_number_clear(&o->xi.value);
    cv_number_clear(&o->from.value);
    cv_number_clear(&o->to.value);
    cv_number_clear(&o->points.value);
}

static void give(cv_optional_number *option, const char *text)
{
    option->given = 1;
    ck_assert_int_eq(cv_number_parse(&option->value, text, NULL), CV_OK);
}

START_TEST(steady_command)
{
    sa_options options;
    cv_message why = {""};
    char *text;

    options_init(&options);
    give(&options.selection.alpha, "0.4");
    give(&options.selection.damping, "0");
    give(&options.points, "3");
    ck_assert_int_eq(run(sa_command_steady, &options, &text, &why), CV_OK);
    ck_assert_ptr_nonnull(strstr(text, "xi,w,u_s,u_b\n-20,43.55"));
    ck_assert_ptr_nonnull(strstr(text, "\n0,99.32187748"));
    free(text);
    options.selection.format = CV_FORMAT_JSON;
    ck_assert_int_eq(run(sa_command_steady, &options, &text, &why), CV_OK);
    json_t *root = json_loads(text, 0, NULL);
    ck_assert_uint_eq(json_array_size(json_object_get(root, "u_b")), 3);
    ck_assert_double_eq_tol(json_real_value(json_array_get(json_object_get(root, "w"), 1)), 99.32187748,
                            1e-8);
    json_decref(root);
    free(text);
    /* resonance velocity: infinite without damping, undecided rather than a number */
    give(&options.selection.alpha, "0.44485524035145314175775797");
    ck_assert_int_eq(run(sa_command_steady, &options, &text, &why), CV_UNDECIDED);
    free(text);
    give(&options.selection.alpha, "0.4");
    give(&options.points, "1");
    ck_assert_int_eq(run(sa_command_steady, &options, &text, &why), CV_BAD_INPUT);
    free(text);
    options_clear(&options);
}
END_TEST

/* DESIGN.md section 6: the keys that scripts stand on. */
START_TEST(resonances_command)
{
    sa_options options;
    cv_message why = {""};
    char *text;

    options_init(&options);
    options.selection.format = CV_FORMAT_JSON;
    options.selection.digits = 25;
    ck_assert_int_eq(run(sa_command_resonances, &options, &text, &why), CV_OK);
    json_t *root = json_loads(text, 0, NULL);
    const json_t *resonances = json_object_get(root, "resonances"),
                 *pseudo = json_object_get(root, "pseudocritical");
    ck_assert_uint_eq(json_array_size(resonances), 3);
    const json_t *first = json_array_get(resonances, 0), *second = json_array_get(resonances, 1);
    ck_assert_str_eq(json_string_value(json_object_get(first, "kind")), "true");
    ck_assert_str_eq(json_string_value(json_object_get(second, "kind")), "false");
    const char *alpha = json_string_value(json_object_get(first, "alpha"));
    ck_assert_int_eq(strncmp(alpha, "0.444855", 8), 0);
    ck_assert_uint_eq(strlen(alpha), 27);
    ck_assert_ptr_nonnull(json_object_get(first, "p"));
    int of_max = 0;
    for (size_t i = 0; i < json_array_size(pseudo); i++) {
        const json_t *item = json_array_get(pseudo, i);
        if (strcmp(json_string_value(json_object_get(item, "of")), "max") == 0) {
            ck_assert_double_eq_tol(strtod(json_string_value(json_object_get(item, "alpha")), NULL), 0.404,
                                    5e-4);
            of_max++;
        }
    }
    ck_assert_int_eq(of_max, 1);
    json_decref(root);
    free(text);
    options.selection.format = CV_FORMAT_TEXT;
    ck_assert_int_eq(run(sa_command_resonances, &options, &text, &why), CV_OK);
    ck_assert_ptr_nonnull(strstr(text, "true     0.44485524035145314175775"));
    free(text);
    options_clear(&options);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("semianalytic steady");
    TCase *tests = tcase_create("steady");

    gsl_set_error_handler_off();
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, shapes_are_the_fourier_integral);
    tcase_add_test(tests, shapes_solve_the_equations);
    tcase_add_test(tests, undamped_is_the_limit_of_small_damping);
    tcase_add_test(tests, resting_force);
    tcase_add_test(tests, steady_command);
    tcase_add_test(tests, resonances_command);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
