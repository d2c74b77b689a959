#include <math.h>
#include <stdlib.h>

#include "common/cli.h"
#include "compare/convergence.h"
#include "compare/format.h"
#include "compare/json_parts.h"
#include "compare/table.h"

enum { ALPHA_DIGITS = 14, PARAMETER_DIGITS = 20 };

/* One mass ratio of a case, studied. */
typedef struct {
    const cmp_convergence_run *run;
    size_t in_case, mass, count;
    cmp_convergence_row *rows;
    cmp_convergence study;
} view;

static const cmp_case *case_of(const view *v)
{
    return &v->run->run.cases[v->in_case];
}

static cv_status view_init(view *v, const cmp_convergence_run *run, size_t in_case, size_t mass,
                           cv_message *why)
{
    const cmp_case *c = &run->run.cases[in_case];
    const cmp_list **lists = calloc(c->level_count, sizeof *lists);
    double *damping = calloc(c->level_count, sizeof *damping);
    *v = (view){run, in_case, mass, c->level_count, calloc(c->level_count, sizeof *v->rows), {0}};
    const int complete = lists != NULL && damping != NULL && v->rows != NULL;
    for (size_t i = 0; i < c->level_count && complete; i++) {
        lists[i] = &c->levels[i].lists[CMP_SEMIANALYTIC][mass];
        damping[i] = cv_number_get_double(&c->levels[i].params.eta_p);
    }
    if (complete)
        cmp_convergence_study(&v->study, v->rows, v->count, lists, damping, &run->undamped[in_case][mass]);
    free(lists);
    free(damping);
    return complete ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

static void view_clear(view *v)
{
    free(v->rows);
}

static const cmp_transition *limit_of(const cmp_list *list)
{
    const size_t i = cmp_list_limit(list);
    return i < list->count ? &list->items[i] : NULL;
}

static const char *alpha_text(cmp_number_text *out, const cmp_transition *t)
{
    return t != NULL ? cmp_format_mpfr(out, t->alpha, ALPHA_DIGITS) : "none";
}

static const char *small_text(char *out, size_t size, const char *format, double x)
{
    snprintf(out, size, isfinite(x) ? format : "-", x);
    return out;
}

typedef struct {
    char text[16];
} level_text;

/* "1e-5" for a power of ten, which all levels are */
static const char *damping_text(level_text *out, const cmp_level *level)
{
    const double exponent = -log10(cv_number_get_double(&level->params.eta_p));
    snprintf(out->text, sizeof out->text, "1e-%.0f", exponent);
    return out->text;
}

static void add_row(cmp_table *t, const view *v, size_t i)
{
    const cmp_level *level = &case_of(v)->levels[i];
    const cmp_convergence_row *row = &v->rows[i];
    const cmp_verdict *verdict = &level->results[v->mass].verdict;
    cmp_number_text first, second, digits;
    level_text damping;
    char step[24], order[24], away[24], branch[24] = "-";
    if (row->branch > 0)
        snprintf(branch, sizeof branch, "%d", row->branch);
    cmp_table_add(t, (const char *const[]){damping_text(&damping, level), alpha_text(&first, row->limit),
                                           alpha_text(&second, limit_of(&level->lists[CMP_DGREEN][v->mass])),
                                           verdict->kind == CMP_AGREE
                                               ? cmp_format_digits(&digits, verdict->digits)
                                               : cmp_kind_name(verdict->kind),
                                           branch, small_text(step, sizeof step, "%.3e", row->step),
                                           small_text(order, sizeof order, "%.3f", row->order),
                                           small_text(away, sizeof away, "%.3e", row->to_limit)});
}

static const char *counts_text(cmp_limit_counts counts)
{
    static const char *const words[] = {"agree", "differ", "undecided"};
    return words[counts];
}

static void add_limit(cmp_table *t, const view *v)
{
    cmp_number_text alpha;
    cmp_table_add(t, (const char *const[]){
                         "0", alpha_text(&alpha, v->study.limit), "-",
                         v->study.limit != NULL ? counts_text(v->run->counts[v->in_case][v->mass]) : "-", "-",
                         "-", "-", "-"});
}

/* What became of the stability limit, in words. */
static void print_words(FILE *out, const view *v)
{
    const cmp_convergence *s = &v->study;
    const cmp_convergence_row *last = &v->rows[v->count - 1];
    const cmp_list *undamped = &v->run->undamped[v->in_case][v->mass];
    for (size_t i = 1; i < v->count; i++)
        if (v->rows[i].branch != v->rows[i - 1].branch) {
            cmp_number_text from, to;
            level_text before, after;
            fprintf(out, "  jumps to another branch from damping %s to %s: %s -> %s\n",
                    damping_text(&before, &case_of(v)->levels[i - 1]),
                    damping_text(&after, &case_of(v)->levels[i]), alpha_text(&from, v->rows[i - 1].limit),
                    alpha_text(&to, v->rows[i].limit));
        }
    if (undamped->status != CV_OK)
        fprintf(out, "  without damping the list of transitions is undecided: %s\n", undamped->why.text);
    if (s->limit == NULL)
        fputs("  without damping there is no stability limit in the range: the limit does not exist\n", out);
    else if (s->kind == CMP_NONE)
        fputs("  no stability limit in the range at the last level: nothing tends to the limit yet\n", out);
    else if (s->kind == CMP_ELSEWHERE)
        fprintf(
            out,
            "  does not converge within these levels: the last one is on another branch, %.3e away from the "
            "limit\n",
            last->to_limit);
    else {
        if (s->order > 0)
            fprintf(out, "  tends to the limit in order %.3f; %.3e away at the last level", s->order,
                    last->to_limit);
        else
            fprintf(out, "  on the branch of the limit, %.3e away at the last level, but in no order yet",
                    last->to_limit);
        fputs(mpfr_zero_p(s->limit->q)
                  ? "; the limit is a resonance velocity of the moving force (theory: order 2/11)\n"
                  : "\n",
              out);
    }
}

static cv_status print_mass(FILE *out, const view *v, cv_message *why)
{
    static const char *const heading[] = {"damping", "semianalytic", "dgreen", "digits",
                                          "branch",  "step",         "order",  "to limit"};
    cmp_number_text eta_M;
    cmp_table t;
    fprintf(out, "\neta_M = %s\n\n",
            cmp_format_exact(&eta_M, &case_of(v)->from->mass_ratios[v->mass], PARAMETER_DIGITS));
    cmp_table_init(&t, "lllrrrrr");
    cmp_table_add(&t, heading);
    for (size_t i = 0; i < v->count; i++)
        add_row(&t, v, i);
    add_limit(&t, v);
    cv_status status = cmp_table_print(&t, out, 2, why);
    cmp_table_clear(&t);
    if (status == CV_OK)
        print_words(out, v);
    return status;
}

cv_status cmp_convergence_text(FILE *out, const cmp_convergence_run *run, cv_message *why)
{
    cv_status status = CV_OK;
    fprintf(out,
            "critvel-compare %s convergence: stability limits at falling damping eta_p = eta_b = eta_f\n"
            "step: change of alpha from the level before, on the same branch; order: its exponent in the "
            "damping;\n"
            "damping 0: the limit q - i0, semianalytic; in the column of digits whether dgreen's winding "
            "next to it\n"
            "gives the same numbers of unstable roots\n",
            CV_VERSION);
    for (size_t c = 0; c < run->run.case_count; c++) {
        const cv_case *from = run->run.cases[c].from;
        fprintf(out, "\n%s %s\n", from->is_track ? "track" : "case", from->name);
        for (size_t m = 0; m < from->mass_count && status == CV_OK; m++) {
            view v;
            status = view_init(&v, run, c, m, why);
            if (status == CV_OK)
                status = print_mass(out, &v, why);
            view_clear(&v);
        }
    }
    fprintf(out, "\nverdict: %s\n", cmp_kind_name(cmp_convergence_verdict(run)));
    return status;
}

static json_t *json_alpha(const cmp_transition *t, int what)
{
    cmp_number_text text;
    return t != NULL ? json_string(cmp_format_mpfr(&text, what ? t->q : t->alpha, ALPHA_DIGITS))
                     : json_null();
}

static json_t *json_row(const view *v, size_t i)
{
    const cmp_level *level = &case_of(v)->levels[i];
    const cmp_convergence_row *row = &v->rows[i];
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "damping", cmp_json_damping(&level->params),
        "semianalytic", json_alpha(row->limit, 0), "q", json_alpha(row->limit, 1), "dgreen",
        json_alpha(limit_of(&level->lists[CMP_DGREEN][v->mass]), 0), "agreement",
        cmp_json_verdict(&level->results[v->mass].verdict), "branch",
        row->branch > 0 ? json_integer(row->branch) : json_null(), "step", cmp_json_number(row->step),
        "order", cmp_json_number(row->order), "to_limit", cmp_json_number(row->to_limit));
}

static json_t *json_mass(const view *v)
{
    static const char *const kinds[] = {"tends to the limit", "on another branch", "no limit"};
    cmp_number_text eta_M;
    const cmp_list *undamped = &v->run->undamped[v->in_case][v->mass];
    json_t *rows = json_array();
    int failed = 0;
    for (size_t i = 0; i < v->count; i++)
        failed |= json_array_append_new(rows, json_row(v, i));
    json_t *limit = json_pack("{s:o, s:o, s:b, s:s}", "alpha", json_alpha(v->study.limit, 0), "q",
                              json_alpha(v->study.limit, 1), "decided", undamped->status == CV_OK,
                              "counts_beside", counts_text(v->run->counts[v->in_case][v->mass]));
    json_t *all =
        json_pack("{s:s, s:o, s:o, s:s, s:i, s:o}", "eta_M",
                  cmp_format_exact(&eta_M, &case_of(v)->from->mass_ratios[v->mass], PARAMETER_DIGITS),
                  "levels", rows, "without_damping", limit, "convergence", kinds[v->study.kind], "jumps",
                  v->study.jumps, "order", cmp_json_number(v->study.order));
    if (!failed)
        return all;
    json_decref(all);
    return NULL;
}

static json_t *json_case(const cmp_convergence_run *run, size_t c, cv_status *status, cv_message *why)
{
    const cv_case *from = run->run.cases[c].from;
    json_t *masses = json_array();
    int failed = 0;
    for (size_t m = 0; m < from->mass_count && *status == CV_OK; m++) {
        view v;
        *status = view_init(&v, run, c, m, why);
        if (*status == CV_OK)
            failed |= json_array_append_new(masses, json_mass(&v));
        view_clear(&v);
    }
    json_t *all = json_pack("{s:s, s:o}", "name", from->name, "mass_ratios", masses);
    if (!failed)
        return all;
    json_decref(all);
    return NULL;
}

cv_status cmp_convergence_json(FILE *out, const cmp_convergence_run *run, cv_message *why)
{
    json_t *cases = json_array();
    cv_status status = CV_OK;
    int failed = 0;
    for (size_t c = 0; c < run->run.case_count; c++)
        failed |= json_array_append_new(cases, json_case(run, c, &status, why));
    json_t *root = json_pack("{s:s, s:s, s:o}", "schema", "critvel-compare-convergence/1", "verdict",
                             cmp_kind_name(cmp_convergence_verdict(run)), "cases", cases);
    if (status == CV_OK)
        return cmp_json_write(root, failed, out, why);
    json_decref(root);
    return status;
}
