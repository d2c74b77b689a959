/* critvel-semianalytic steady: the shape of the track under a moving constant force. */
#include <jansson.h>
#include <math.h>
#include <stdlib.h>

#include "semianalytic/commands.h"
#include "semianalytic/steady.h"

enum { POINTS_DEFAULT = 401, POINTS_MAX = 1000000, DIGITS = 15 };

typedef struct {
    long double from, to;
    long points;
} grid;

/* Defaults: 401 points in -20 .. 20. */
static cv_status grid_set(grid *g, const sa_options *options, cv_message *why)
{
    double points = options->points.given ? cv_number_get_double(&options->points.value) : POINTS_DEFAULT;

    g->from = options->from.given ? (long double)cv_number_get_double(&options->from.value) : -20;
    g->to = options->to.given ? (long double)cv_number_get_double(&options->to.value) : 20;
    if (!(points >= 2 && points <= POINTS_MAX && points == floor(points))) {
        return cv_fail(why, CV_BAD_INPUT, "option --points: must be a whole number from 2 to %d", POINTS_MAX);
    }
    if (!(g->from < g->to)) {
        return cv_fail(why, CV_BAD_INPUT, "option --from: must be less than --to");
    }
    g->points = (long)points;
    return CV_OK;
}

static long double grid_at(const grid *g, long i)
{
    return i == g->points - 1 ? g->to
                              : g->from + (g->to - g->from) * (long double)i / (long double)(g->points - 1);
}

static cv_status write_csv(FILE *out, const sa_steady *s, const grid *g, cv_message *why)
{
    int done = fputs("xi,w,u_s,u_b\n", out) >= 0;

    for (long i = 0; i < g->points && done; i++) {
        long double u[SA_FIELDS], xi = grid_at(g, i);
        sa_steady_at(u, s, xi);
        done = fprintf(out, "%.*Lg,%.*Lg,%.*Lg,%.*Lg\n", DIGITS, xi, DIGITS, u[0], DIGITS, u[1], DIGITS,
                       u[2]) > 0;
    }
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

static json_t *json_number(const cv_number *x)
{
    char *text = cv_number_text(x, 40);
    json_t *value = text ? json_string(text) : NULL;

    free(text);
    return value;
}

static cv_status write_json(FILE *out, const sa_steady *s, const grid *g, const cv_choice *choice,
                            const cv_number *alpha, cv_message *why)
{
    const char *const names[SA_FIELDS + 1] = {"xi", "w", "u_s", "u_b"};
    const cv_params *p = &choice->params;
    json_t *column[SA_FIELDS + 1];
    int done = 1;

    for (int f = 0; f <= SA_FIELDS; f++) {
        column[f] = json_array();
    }
    for (long i = 0; i < g->points; i++) {
        long double u[SA_FIELDS + 1] = {grid_at(g, i)};
        sa_steady_at(u + 1, s, u[0]);
        for (int f = 0; f <= SA_FIELDS; f++) {
            done &= json_array_append_new(column[f], json_real((double)u[f])) == 0;
        }
    }
    json_t *root = json_pack("{s:s, s:s, s:o, s:{s:o, s:o, s:o}, s:f}", "schema",
                             "critvel-semianalytic-steady/1", "case", choice->chosen->name, "alpha",
                             json_number(alpha), "damping", "eta_p", json_number(&p->eta_p), "eta_b",
                             json_number(&p->eta_b), "eta_f", json_number(&p->eta_f), "defect", s->defect);
    for (int f = 0; f <= SA_FIELDS; f++) {
        done &= json_object_set_new(root, names[f], column[f]) == 0;
    }
    done = done && json_dumpf(root, out, JSON_INDENT(2) | JSON_REAL_PRECISION(DIGITS)) == 0 &&
           fputc('\n', out) != EOF;
    json_decref(root);
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

cv_status sa_command_steady(const sa_options *options, const cv_arguments *arguments, FILE *out, FILE *log,
                            cv_message *why)
{
    const cv_selection *selection = &options->selection;
    cv_choice choice;
    sa_steady steady;
    grid g = {0};

    (void)log;
    cv_status status = cv_require(&selection->alpha, "alpha", why);
    if (status == CV_OK) {
        status = grid_set(&g, options, why);
    }
    if (status == CV_OK) {
        status = cv_choose(&choice, selection, arguments->path, why);
    }
    if (status != CV_OK) {
        return status;
    }
    status = sa_steady_solve(&steady, &choice.params, &selection->alpha.value, why);
    if (status == CV_OK) {
        status = selection->format == CV_FORMAT_JSON
                     ? write_json(out, &steady, &g, &choice, &selection->alpha.value, why)
                     : write_csv(out, &steady, &g, why);
    }
    cv_choice_clear(&choice);
    return status;
}
