/* critvel-dgreen curve: the D-decomposition curves of figures 2 and 3. Text is CSV. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/command.h"
#include "dgreen/command_json.h"
#include "dgreen/stability_curve.h"

/* Re qbar of the second curve, unless it is typed. */
static const double DELTA = 0.01;

typedef struct {
    const cv_choice *choice;
    const cv_selection *selection;
    double delta;
    dg_stability_curve curve;
} answer;

/* Where the number of unstable roots is 0; with none on either side: NULL */
static const char *stable_side(const dg_cut *cut)
{
    return cut->right == 0 ? "right" : cut->left == 0 ? "left" : NULL;
}

/* The side of the crossing nearest to z = 1 that is stable, as in the paper's figures; NULL: no crossing */
static const dg_cut *nearest_cut(const dg_stability_curve *c)
{
    const dg_cut *nearest = NULL;
    for (size_t i = 0; i < c->cut_count; i++)
        if (nearest == NULL || fabs(log(c->cuts[i].x)) < fabs(log(nearest->x)))
            nearest = &c->cuts[i];
    return nearest;
}

static int write_line(const dg_polyline *line, const char *name, FILE *out)
{
    for (size_t i = line->count; i-- > 0;)
        if (fprintf(out, "%s,%.17g,%.17g,%.17g\n", name, -line->at[i].q, line->at[i].re, -line->at[i].im) < 0)
            return -1;
    for (size_t i = 0; i < line->count; i++)
        if (fprintf(out, "%s,%.17g,%.17g,%.17g\n", name, line->at[i].q, line->at[i].re, line->at[i].im) < 0)
            return -1;
    return 0;
}

static int write_summary(const answer *a, FILE *out)
{
    const dg_stability_curve *c = &a->curve;
    int length = 0;
    for (size_t i = 0; i <= c->cut_count && length >= 0; i++) {
        const int roots = i < c->cut_count ? c->cuts[i].left : 0;
        if (i > 0 && isinf(c->cuts[i - 1].x))
            break;
        length =
            fprintf(out, "# z from %.17g to %.17g: %d unstable roots\n",
                    i > 0 ? c->cuts[i - 1].x : c->x_floor, i < c->cut_count ? c->cuts[i].x : HUGE_VAL, roots);
    }
    for (size_t i = 0; i < c->cut_count && length >= 0; i++) {
        const char *side = stable_side(&c->cuts[i]);
        length = fprintf(out, "# crossing z = %.17g, q = %.17g, stable side: %s\n", c->cuts[i].x,
                         c->cuts[i].q, side ? side : "none");
    }
    if (length >= 0 && a->selection->mass_ratio.given)
        length = fprintf(out, "# z = 1: %d unstable roots, %s\n", c->unstable,
                         c->unstable > 0 ? "unstable" : "stable");
    return length;
}

static cv_status write_csv(const answer *a, FILE *out)
{
    return write_summary(a, out) < 0 || fprintf(out, "curve,q,re,im\n") < 0 ||
                   write_line(&a->curve.boundary, "boundary", out) < 0 ||
                   write_line(&a->curve.shifted, "shifted", out) < 0
               ? CV_FAILED
               : CV_OK;
}

/* JSON has no infinity: null */
static json_t *real_or_null(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

static json_t *line_json(const dg_polyline *line)
{
    json_t *list = json_array();
    for (size_t i = line->count; i-- > 0;)
        json_array_append_new(list, json_pack("[f, f, f]", -line->at[i].q, line->at[i].re, -line->at[i].im));
    for (size_t i = 0; i < line->count; i++)
        json_array_append_new(list, json_pack("[f, f, f]", line->at[i].q, line->at[i].re, line->at[i].im));
    return list;
}

static json_t *cuts_json(const dg_stability_curve *c)
{
    json_t *list = json_array();
    for (size_t i = 0; i < c->cut_count; i++) {
        const dg_cut *cut = &c->cuts[i];
        json_array_append_new(list,
                              json_pack("{s:f, s:o, s:i, s:i, s:s?}", "q", cut->q, "z", real_or_null(cut->x),
                                        "unstable_roots_left", cut->left, "unstable_roots_right", cut->right,
                                        "stable_side", stable_side(cut)));
    }
    return list;
}

static json_t *regions_json(const dg_stability_curve *c)
{
    json_t *list = json_array();
    for (size_t i = 0; i <= c->cut_count; i++) {
        const double low = i > 0 ? c->cuts[i - 1].x : c->x_floor;
        const double high = i < c->cut_count ? c->cuts[i].x : HUGE_VAL;
        if (isfinite(low))
            json_array_append_new(list, json_pack("{s:f, s:o, s:i}", "from", low, "to", real_or_null(high),
                                                  "unstable_roots", i < c->cut_count ? c->cuts[i].left : 0));
    }
    return list;
}

/* The verdict for z = 1; null without a mass ratio, when z stands for zeta */
static json_t *verdict_json(const answer *a)
{
    const dg_stability_curve *c = &a->curve;
    const dg_cut *nearest = nearest_cut(c);
    if (!a->selection->mass_ratio.given)
        return json_null();
    return json_pack("{s:i, s:i, s:s, s:s?}", "z", 1, "unstable_roots", c->unstable, "verdict",
                     c->unstable > 0 ? "unstable" : "stable", "stable_side_of_nearest_crossing",
                     nearest == NULL ? NULL : stable_side(nearest));
}

static cv_status write_json(const answer *a, FILE *out)
{
    const cv_params *p = &a->choice->params;
    const cv_selection *s = a->selection;
    json_t *root = json_pack(
        "{s:s, s:o, s:o, s:o, s:f, s:o, s:o, s:o, s:o, s:o}", "case", a->choice->chosen->name, "damping",
        dg_json_damping(p), "alpha", dg_json_number(&s->alpha.value), "eta_M",
        s->mass_ratio.given ? dg_json_number(&s->mass_ratio.value) : json_null(), "delta", a->delta, "point",
        verdict_json(a), "crossings", cuts_json(&a->curve), "regions", regions_json(&a->curve), "boundary",
        line_json(&a->curve.boundary), "shifted", line_json(&a->curve.shifted));
    const int failed = root == NULL || json_dumpf(root, out, JSON_INDENT(1)) != 0 || fputc('\n', out) == EOF;
    json_decref(root);
    return failed ? CV_FAILED : CV_OK;
}

static cv_status draw_and_write(answer *a, FILE *out, cv_message *why)
{
    dg_sampler sampler;
    const cv_selection *s = a->selection;
    const double alpha = cv_number_get_double(&s->alpha.value);
    const double factor = s->mass_ratio.given ? cv_number_get_double(&s->mass_ratio.value) : 1;
    if (!(alpha > 0 && a->delta > 0))
        return cv_fail(why, CV_BAD_INPUT, "--alpha and --delta must be positive");
    cv_status status = dg_sampler_init(&sampler, &a->choice->params, alpha, alpha, why);
    if (status != CV_OK)
        return status;
    status = dg_stability_curve_at(&a->curve, &sampler, alpha, factor, a->delta, why);
    if (status == CV_OK) {
        status = s->format == CV_FORMAT_JSON ? write_json(a, out) : write_csv(a, out);
        if (status != CV_OK)
            cv_fail(why, status, "cannot write: out of memory");
    }
    dg_stability_curve_clear(&a->curve);
    dg_sampler_clear(&sampler);
    return status;
}

cv_status dg_command_curve(const dg_options *options, const char *path, FILE *out, FILE *log, cv_message *why)
{
    const cv_selection *s = &options->selection;
    cv_choice choice;
    cv_message warning;
    cv_status status = cv_require(&s->alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_choose(&choice, s, path, why);
    if (status != CV_OK)
        return status;
    if (cv_params_warn(&choice.params, &warning))
        fprintf(log, "warning: %s\n", warning.text);
    answer a = {.choice = &choice, .selection = s, .delta = DELTA};
    if (options->delta.given)
        a.delta = cv_number_get_double(&options->delta.value);
    status = draw_and_write(&a, out, why);
    cv_choice_clear(&choice);
    return status;
}
