/* critvel-dgreen lines: instability lines in a range of velocity and mass ratio. */
#include <jansson.h>
#include <math.h>
#include <stdlib.h>

#include "dgreen/command.h"
#include "dgreen/command_json.h"
#include "dgreen/lines.h"

/* Range of eta_M, unless it is typed */
static const double MASS_MIN = 1, MASS_MAX = 1e4;

typedef struct {
    const cv_choice *choice;
    dg_lines lines;
    dg_asymptote_list asymptotes; /* to the digits of the answer */
} answer;

static const char *kind(const dg_line *l)
{
    if (l->exits[0] == DG_LINE_CLOSED)
        return "closed";
    if (l->exits[0] == DG_LINE_UNDECIDED || l->exits[1] == DG_LINE_UNDECIDED)
        return "undecided";
    if (l->exits[0] == DG_LINE_INFINITE_MASS && l->exits[1] == DG_LINE_INFINITE_MASS)
        return "infinite mass at both ends";
    return l->zero_mass[0] || l->zero_mass[1] ? "to zero mass at infinite velocity" : "open";
}

static const char *exit_name(dg_line_exit e)
{
    static const char *const names[] = {
        [DG_LINE_CLOSED] = "closed",          [DG_LINE_INFINITE_MASS] = "infinite mass",
        [DG_LINE_TOP] = "greatest eta_M",     [DG_LINE_BOTTOM] = "smallest eta_M",
        [DG_LINE_ALPHA_MIN] = "lowest alpha", [DG_LINE_ALPHA_MAX] = "highest alpha",
        [DG_LINE_UNDECIDED] = "undecided"};
    return names[e];
}

/* N on the side with fewer unstable roots, least and most along the line; -1: counted nowhere */
static void stable_roots(int *least, int *most, const dg_line *l)
{
    *least = *most = -1;
    for (size_t i = 0; i < l->count; i++) {
        const int n = l->vertices[i].stable_roots;
        if (n >= 0 && (*least < 0 || n < *least))
            *least = n;
        if (n > *most)
            *most = n;
    }
}

static int write_end(const dg_line *l, int end, FILE *out)
{
    const dg_line_vertex *v = &l->vertices[end ? l->count - 1 : 0];
    int length = fprintf(out, "  %s  alpha = %.12g, eta_M = %.12g, q = %.12g (%s", end ? "to  " : "from",
                         v->alpha, v->mass_ratio, v->q, exit_name(l->exits[end]));
    if (length >= 0 && l->exits[end] == DG_LINE_INFINITE_MASS)
        length = l->asymptote_q[end] > 0 ? fprintf(out, " at alpha = %.12g, where zeta = 0 at q = %.12g",
                                                   l->asymptote[end], l->asymptote_q[end])
                                         : fprintf(out, " at alpha = %.12g, where q = 0", l->asymptote[end]);
    if (length >= 0 && l->zero_mass[end])
        length = fprintf(out, ", then to zero mass");
    return length < 0 ? length : fprintf(out, ")\n");
}

static int write_line(const dg_line *l, size_t number, FILE *out)
{
    int least, most;
    stable_roots(&least, &most, l);
    int length = fprintf(out, "\nline %zu: %s, %zu vertices\n", number, kind(l), l->count);
    if (length >= 0)
        length = write_end(l, 0, out);
    for (size_t i = 0; i < l->count && length >= 0; i++) {
        const dg_line_vertex *v = &l->vertices[i];
        if (v->turns)
            length = fprintf(out, "  turning point in alpha  alpha = %.12g, eta_M = %.6g, q = %.6g\n",
                             v->alpha, v->mass_ratio, v->q);
        if (i == l->least && length >= 0)
            length = fprintf(out, "  smallest eta_M  alpha = %.12g, eta_M = %.12g, q = %.12g\n", v->alpha,
                             v->mass_ratio, v->q);
    }
    if (length >= 0)
        length = write_end(l, 1, out);
    if (length >= 0 && least >= 0)
        length = least == most
                     ? fprintf(out, "  unstable roots  %d on the left, %d on the right\n", least + 2, least)
                     : fprintf(out, "  unstable roots  %d to %d on the left, two less on the right\n",
                               least + 2, most + 2);
    return length;
}

static cv_status write_text(const answer *a, FILE *out)
{
    const dg_lines *l = &a->lines;
    int length = fprintf(
        out,
        "%zu line%s for %.12g <= alpha <= %.12g, %.12g <= eta_M <= %.12g; two more roots are unstable "
        "on the left of each, alpha to the right, eta_M upwards\n",
        l->count, l->count == 1 ? "" : "s", l->alpha_min, l->alpha_max, l->mass_min, l->mass_max);
    for (size_t i = 0; i < l->count && length >= 0; i++)
        length = write_line(&l->lines[i], i + 1, out);
    if (length >= 0)
        length = fprintf(out, "\nasymptotes, q -> 0\n");
    for (size_t i = 0; i < a->asymptotes.count && length >= 0; i++)
        length = mpfr_fprintf(out, "  %.*Re%s\n", a->choice->digits - 1, a->asymptotes.items[i].alpha,
                              a->asymptotes.items[i].positive ? "" : "  (of negative masses)");
    if (length >= 0 && a->asymptotes.status != CV_OK)
        length = fprintf(out, "undecided: %s\n", a->asymptotes.why.text);
    for (size_t i = 0; i < l->doubt_count && length >= 0; i++)
        length = fprintf(out, "undecided: %s\n", l->doubts[i].why.text);
    return length < 0 ? CV_FAILED : CV_OK;
}

static cv_status write_csv(const answer *a, FILE *out)
{
    int length = fprintf(out, "line,alpha,q,eta_M,mark\n");
    for (size_t i = 0; i < a->lines.count; i++)
        for (size_t k = 0; k < a->lines.lines[i].count && length >= 0; k++) {
            const dg_line *l = &a->lines.lines[i];
            const dg_line_vertex *v = &l->vertices[k];
            length = fprintf(out, "%zu,%.17g,%.15g,%.15g,%s\n", i + 1, v->alpha, v->q, v->mass_ratio,
                             v->turns        ? "turning point"
                             : k == l->least ? "smallest eta_M"
                                             : "");
        }
    return length < 0 ? CV_FAILED : CV_OK;
}

static json_t *end_json(const dg_line *l, int end)
{
    const int infinite = l->exits[end] == DG_LINE_INFINITE_MASS;
    return json_pack("{s:s, s:b, s:o, s:o}", "exit", exit_name(l->exits[end]), "zero_mass_beyond",
                     l->zero_mass[end], "asymptote_alpha",
                     infinite ? json_real(l->asymptote[end]) : json_null(), "asymptote_q",
                     infinite ? json_real(l->asymptote_q[end]) : json_null());
}

static json_t *vertex_json(const dg_line_vertex *v)
{
    return json_pack("[f, f, f]", v->alpha, v->q, v->mass_ratio);
}

static json_t *line_json(const dg_line *l)
{
    int least, most;
    json_t *vertices = json_array(), *turns = json_array();
    stable_roots(&least, &most, l);
    for (size_t i = 0; i < l->count; i++) {
        json_array_append_new(vertices, vertex_json(&l->vertices[i]));
        if (l->vertices[i].turns)
            json_array_append_new(turns, vertex_json(&l->vertices[i]));
    }
    return json_pack("{s:s, s:o, s:o, s:s, s:i, s:i, s:o, s:o, s:o}", "kind", kind(l), "start",
                     end_json(l, 0), "end", end_json(l, 1), "more_unstable_side", "left",
                     "least_unstable_roots_right", least, "most_unstable_roots_right", most, "smallest_eta_M",
                     vertex_json(&l->vertices[l->least]), "turning_points", turns, "alpha_q_eta_M", vertices);
}

static json_t *asymptotes_json(const dg_asymptote_list *list, int digits)
{
    json_t *all = json_array();
    for (size_t i = 0; i < list->count; i++) {
        char *text = NULL;
        if (mpfr_asprintf(&text, "%.*Re", digits - 1, list->items[i].alpha) < 0)
            continue;
        json_array_append_new(
            all, json_pack("{s:s, s:b}", "alpha", text, "positive_masses", list->items[i].positive));
        mpfr_free_str(text);
    }
    return all;
}

static cv_status write_json(const answer *a, FILE *out)
{
    const dg_lines *l = &a->lines;
    json_t *all = json_array(), *doubts = json_array();
    for (size_t i = 0; i < l->count; i++)
        json_array_append_new(all, line_json(&l->lines[i]));
    for (size_t i = 0; i < l->doubt_count; i++)
        json_array_append_new(doubts,
                              json_pack("{s:f, s:f, s:s}", "alpha_low", l->doubts[i].alpha_low, "alpha_high",
                                        l->doubts[i].alpha_high, "reason", l->doubts[i].why.text));
    json_t *root = json_pack(
        "{s:s, s:s, s:o, s:[f, f], s:[f, f], s:b, s:o, s:o, s:b, s:o}", "schema", "critvel-dgreen-lines/1",
        "case", a->choice->chosen->name, "damping", dg_json_damping(&a->choice->params), "alpha_range",
        l->alpha_min, l->alpha_max, "eta_M_range", l->mass_min, l->mass_max, "decided", l->doubt_count == 0,
        "undecided", doubts, "asymptotes", asymptotes_json(&a->asymptotes, a->choice->digits),
        "asymptotes_decided", a->asymptotes.status == CV_OK, "lines", all);
    const int failed = root == NULL || json_dumpf(root, out, JSON_INDENT(1)) != 0 || fputc('\n', out) == EOF;
    json_decref(root);
    return failed ? CV_FAILED : CV_OK;
}

static cv_status find(answer *a, const dg_options *o, cv_message *why)
{
    const cv_casefile *file = &a->choice->file;
    const dg_grid *alphas = &o->alphas, *masses = &o->masses;
    const double alpha_min = cv_number_get_double(alphas->given ? &alphas->first : &file->alpha_min);
    const double alpha_max = cv_number_get_double(alphas->given ? &alphas->last : &file->alpha_max);
    cv_status status = dg_lines_find(&a->lines, &a->choice->params, alpha_min, alpha_max,
                                     masses->given ? cv_number_get_double(&masses->first) : MASS_MIN,
                                     masses->given ? cv_number_get_double(&masses->last) : MASS_MAX, why);
    if (status == CV_OK) {
        status = dg_lines_asymptotes(&a->asymptotes, &a->lines, a->choice->digits, why);
        if (status != CV_OK)
            dg_lines_clear(&a->lines);
    }
    return status;
}

static cv_status find_and_write(answer *a, const dg_options *o, FILE *out, cv_message *why)
{
    cv_status status = find(a, o, why);
    if (status != CV_OK)
        return status;
    status = o->selection.format == CV_FORMAT_JSON ? write_json(a, out)
             : o->csv                              ? write_csv(a, out)
                                                   : write_text(a, out);
    if (status != CV_OK)
        cv_fail(why, status, "cannot write: out of memory");
    else if (a->lines.doubt_count > 0)
        status = cv_fail(why, CV_UNDECIDED, "%s", a->lines.doubts[0].why.text);
    else if (a->asymptotes.status != CV_OK)
        status = cv_fail(why, CV_UNDECIDED, "%s", a->asymptotes.why.text);
    dg_asymptote_list_clear(&a->asymptotes);
    dg_lines_clear(&a->lines);
    return status;
}

cv_status dg_command_lines(const dg_options *options, const char *path, FILE *out, FILE *log, cv_message *why)
{
    cv_choice choice;
    cv_message warning;
    const cv_status status = cv_choose(&choice, &options->selection, path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "warning: %s\n", warning.text);
    answer a = {.choice = &choice};
    const cv_status done = find_and_write(&a, options, out, why);
    cv_choice_clear(&choice);
    return done;
}
