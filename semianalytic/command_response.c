/* critvel-semianalytic response: deflection of the rail in time, beginning with the switching on of the load.
 */
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "semianalytic/commands.h"
#include "semianalytic/response.h"

enum { TIMES_MAX = 1000000, PLACES = 2 };

/* w at the load and, where xi is not 0, at xi */
typedef struct {
    const cv_choice *choice;
    const cv_selection *selection;
    const cv_optional_number *place;
    size_t count;
    double *tau;
    int places;
    double xi[PLACES], *w[PLACES], *error[PLACES];
} answer;

static cv_status number_at(double *to, const char *text, size_t length, cv_message *why)
{
    char copy[64];
    cv_number x;
    if (length == 0 || length >= sizeof copy)
        return cv_fail(why, CV_BAD_INPUT, "--time: '%.40s' is not a list of numbers or a:b:n", text);
    memcpy(copy, text, length);
    copy[length] = '\0';
    cv_number_init(&x);
    cv_status status = cv_number_parse(&x, copy, why);
    *to = cv_number_get_double(&x);
    cv_number_clear(&x);
    if (status == CV_OK && !(*to >= 0))
        return cv_fail(why, CV_BAD_INPUT, "--time: %s is negative", copy);
    return status;
}

/* t1,t2,... ; out has room for as many as there are commas, and one */
static cv_status read_list(answer *a, const char *text, char separator, cv_message *why)
{
    cv_status status = CV_OK;
    a->count = 0;
    for (const char *from = text; status == CV_OK && from != NULL;) {
        const char *end = strchr(from, separator);
        status = number_at(&a->tau[a->count++], from, end != NULL ? (size_t)(end - from) : strlen(from), why);
        from = end != NULL ? end + 1 : NULL;
    }
    return status;
}

static size_t occurrences(const char *text, char c)
{
    size_t n = 0;
    for (; *text != '\0'; text++)
        n += *text == c;
    return n;
}

/* a:b:n, n times from a to b */
static cv_status read_range(answer *a, const char *text, cv_message *why)
{
    cv_status status = read_list(a, text, ':', why);
    if (status != CV_OK)
        return status;
    const double from = a->tau[0], to = a->tau[1], n = a->tau[2];
    if (!(n >= 2 && n <= TIMES_MAX && n == floor(n) && to > from))
        return cv_fail(why, CV_BAD_INPUT, "--time: a:b:n needs a < b and an integer n, 2 <= n <= %d",
                       TIMES_MAX);
    double *tau = realloc(a->tau, (size_t)n * sizeof *tau);
    if (tau == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    a->tau = tau;
    a->count = (size_t)n;
    for (size_t i = 0; i < a->count; i++)
        tau[i] = from + (to - from) * (double)i / (n - 1);
    return CV_OK;
}

static cv_status read_times(answer *a, const char *text, cv_message *why)
{
    if (text == NULL)
        return cv_fail(why, CV_BAD_INPUT, "missing option --time");
    int range = occurrences(text, ':') > 0;
    if (range && occurrences(text, ':') != 2)
        return cv_fail(why, CV_BAD_INPUT, "--time: a range is a:b:n");
    a->tau = calloc(occurrences(text, range ? ':' : ',') + 1, sizeof *a->tau);
    if (a->tau == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    return range ? read_range(a, text, why) : read_list(a, text, ',', why);
}

static double latest(const answer *a)
{
    double tau = 1e-3;
    for (size_t i = 0; i < a->count; i++)
        tau = fmax(tau, a->tau[i]);
    return tau;
}

static cv_status compute_place(answer *a, int place, const sa_track *track, cv_message *why)
{
    sa_motion motion = {.alpha = cv_number_get_double(&a->selection->alpha.value),
                        .mass_ratio = cv_number_get_double(&a->selection->mass_ratio.value),
                        .xi = a->xi[place],
                        .tau_max = latest(a)};
    sa_response *response;
    a->w[place] = calloc(a->count, sizeof *a->w[place]);
    a->error[place] = calloc(a->count, sizeof *a->error[place]);
    if (a->w[place] == NULL || a->error[place] == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = sa_response_new(&response, track, &motion, why);
    if (status != CV_OK)
        return status;
    for (size_t i = 0; i < a->count && status == CV_OK; i++)
        status = sa_response_at(&a->w[place][i], &a->error[place][i], response, a->tau[i]);
    if (status != CV_OK)
        cv_fail(why, status, "no value at tau = %g", latest(a));
    sa_response_free(response);
    return status;
}

static cv_status compute(answer *a, cv_message *why)
{
    sa_track *track;
    cv_status status = sa_track_new(&track, &a->choice->params, why);
    if (status != CV_OK)
        return status;
    a->places = 1;
    if (a->place->given && cv_number_sign(&a->place->value) != 0)
        a->xi[a->places++] = cv_number_get_double(&a->place->value);
    for (int i = 0; i < a->places && status == CV_OK; i++)
        status = compute_place(a, i, track, why);
    sa_track_free(track);
    return status;
}

static cv_status write_json(FILE *out, const answer *a, cv_message *why)
{
    json_t *rows = json_array();
    int done = 1;
    for (int k = 0; k < a->places; k++)
        for (size_t i = 0; i < a->count; i++)
            done &= json_array_append_new(rows,
                                          json_pack("{s:f, s:f, s:f, s:f}", "xi", a->xi[k], "tau", a->tau[i],
                                                    "w", a->w[k][i], "error", a->error[k][i])) == 0;
    char *alpha = cv_number_text(&a->selection->alpha.value, 40);
    char *mass = cv_number_text(&a->selection->mass_ratio.value, 40);
    json_t *root = json_pack("{s:s, s:s, s:s, s:s, s:o}", "schema", "critvel-semianalytic-response/1", "case",
                             a->choice->chosen->name, "alpha", alpha, "eta_M", mass, "response", rows);
    done = done && root && json_dumpf(root, out, JSON_INDENT(1) | JSON_REAL_PRECISION(15)) == 0 &&
           fputc('\n', out) != EOF;
    json_decref(root);
    free(alpha);
    free(mass);
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

static cv_status write_csv(FILE *out, const answer *a, cv_message *why)
{
    int done = fputs(a->places > 1 ? "tau,w0,w0_error,w_xi,w_xi_error\n" : "tau,w0,w0_error\n", out) >= 0;
    for (size_t i = 0; i < a->count && done; i++) {
        done = fprintf(out, "%.15g", a->tau[i]) > 0;
        for (int k = 0; k < a->places && done; k++)
            done = fprintf(out, ",%.15g,%.1e", a->w[k][i], a->error[k][i]) > 0;
        done = done && fputc('\n', out) != EOF;
    }
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

static void clear(answer *a)
{
    free(a->tau);
    for (int k = 0; k < PLACES; k++) {
        free(a->w[k]);
        free(a->error[k]);
    }
}

cv_status sa_command_response(const sa_options *options, const cv_arguments *arguments, FILE *out, FILE *log,
                              cv_message *why)
{
    cv_choice choice;
    answer a = {.choice = &choice, .selection = &options->selection, .place = &options->xi};
    (void)log;
    cv_status status = cv_require(&options->selection.alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_choose(&choice, &options->selection, arguments->path, why);
    if (status != CV_OK)
        return status;
    status = read_times(&a, options->times, why);
    if (status == CV_OK)
        status = compute(&a, why);
    if (status == CV_OK)
        status =
            options->selection.format == CV_FORMAT_JSON ? write_json(out, &a, why) : write_csv(out, &a, why);
    clear(&a);
    cv_choice_clear(&choice);
    return status;
}
