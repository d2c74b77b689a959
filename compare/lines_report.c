#include "compare/lines_report.h"

#include <math.h>

#include "common/cli.h"
#include "compare/format.h"
#include "compare/json_parts.h"
#include "compare/table.h"

enum { SHOWN = 10, DAMPING_DIGITS = 6, RANGE_DIGITS = 20 };

static const cmp_branch *any(const cmp_branch_pair *p)
{
    return p->by[0] != NULL ? p->by[0] : p->by[1];
}

static const char *found_by(const cmp_branch_pair *p, const cmp_lines_run *run)
{
    return p->by[0] != NULL && p->by[1] != NULL ? "both" : run->methods[p->by[0] == NULL]->name;
}

static const char *end_name(cmp_end_kind kind)
{
    static const char *const names[] = {"closed",    "alpha min", "alpha max",
                                        "eta_M min", "eta_M max", "undecided"};
    return names[kind];
}

static void end_text(char *out, size_t size, const cmp_line_end *e)
{
    if (e->zero_mass)
        snprintf(out, size, "%s, zero mass", end_name(e->kind));
    else if (isnan(e->asymptote))
        snprintf(out, size, "%s", end_name(e->kind));
    else
        snprintf(out, size, "asymptote %.*g", SHOWN, e->asymptote);
}

static void velocities(double *low, double *high, const cmp_branch *b)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (size_t i = 0; i < b->count; i++) {
        *low = fmin(*low, mpfr_get_d(b->vertices[i].alpha, MPFR_RNDN));
        *high = fmax(*high, mpfr_get_d(b->vertices[i].alpha, MPFR_RNDN));
    }
}

static void add_branch(cmp_table *t, const cmp_lines_run *run, const char *damping, const cmp_branch_pair *p)
{
    const cmp_branch *b = any(p);
    char low_text[32], high_text[32], least[32], begins[48], ends[48], points[32], difference[32];
    cmp_number_text digits;
    double low, high;
    velocities(&low, &high, b);
    snprintf(low_text, sizeof low_text, "%.*g", SHOWN, low);
    snprintf(high_text, sizeof high_text, "%.*g", SHOWN, high);
    snprintf(least, sizeof least, "%.*g", SHOWN, b->least_mass);
    end_text(begins, sizeof begins, &b->ends[0]);
    end_text(ends, sizeof ends, &b->ends[1]);
    snprintf(points, sizeof points, "%zu", p->vertices);
    snprintf(difference, sizeof difference, p->vertices > 0 ? "%.1e" : "-", p->difference);
    snprintf(digits.text, sizeof digits.text, "-");
    if (p->verdict.kind == CMP_AGREE && isfinite(p->verdict.digits))
        cmp_format_digits(&digits, p->verdict.digits);
    cmp_table_add(t,
                  (const char *const[]){damping, found_by(p, run), low_text, high_text, least, begins, ends,
                                        points, difference, digits.text, cmp_kind_name(p->verdict.kind)});
}

static cv_status print_branches(FILE *out, const cmp_lines_run *run, const cmp_lines_case *c, cv_message *why)
{
    static const char *const heading[] = {"damping",     "found by", "alpha from", "to",
                                          "least eta_M", "begins",   "ends",       "points",
                                          "difference",  "digits",   "verdict"};
    cmp_table t;
    cmp_table_init(&t, "llllrllrrrl");
    cmp_table_add(&t, heading);
    for (size_t l = 0; l < c->level_count; l++) {
        cmp_damping_text damping;
        cmp_format_damping(&damping, &c->levels[l].params, DAMPING_DIGITS);
        for (size_t i = 0; i < c->levels[l].pairs.count; i++)
            add_branch(&t, run, damping.text, &c->levels[l].pairs.pairs[i]);
    }
    cv_status status = cmp_table_print(&t, out, 2, why);
    cmp_table_clear(&t);
    return status;
}

static cv_status print_counts(FILE *out, const cmp_lines_run *run, const cmp_lines_case *c, cv_message *why)
{
    const char *const heading[] = {
        "damping",    "points", "near lines", "undecided", run->methods[0]->name, run->methods[1]->name,
        "mismatches", "verdict"};
    cmp_table t;
    cmp_table_init(&t, "lrrrrrrl");
    cmp_table_add(&t, heading);
    for (size_t l = 0; l < c->level_count; l++) {
        const cmp_line_samples *s = &c->levels[l].samples;
        const size_t numbers[] = {s->points,       s->near_lines,   s->undecided_points,
                                  s->undecided[0], s->undecided[1], s->mismatches};
        char text[6][32];
        cmp_damping_text damping;
        for (size_t i = 0; i < 6; i++)
            snprintf(text[i], sizeof text[i], "%zu", numbers[i]);
        cmp_table_add(&t, (const char *const[]){
                              cmp_format_damping(&damping, &c->levels[l].params, DAMPING_DIGITS), text[0],
                              text[1], text[2], text[3], text[4], text[5], cmp_kind_name(s->verdict.kind)});
    }
    fprintf(out, "\n  unstable roots counted by both methods, undecided also by method, seed %lu\n\n",
            run->task.seed);
    cv_status status = cmp_table_print(&t, out, 2, why);
    cmp_table_clear(&t);
    return status;
}

static void print_reason(FILE *out, const char *damping, const cmp_verdict *v)
{
    if (v->kind != CMP_AGREE)
        fprintf(out, "  %s, damping %s: %s\n", cmp_kind_name(v->kind), damping, v->reason.text);
}

/* What is not among the pairs and counts: a list that is in doubt. */
static void print_doubts(FILE *out, const cmp_lines_run *run, const cmp_lines_level *level,
                         const char *damping)
{
    for (int m = 0; m < CMP_METHODS; m++)
        if (level->lists[m].status != CV_OK)
            fprintf(out, "  undecided, damping %s: %s could not decide: %s\n", damping, run->methods[m]->name,
                    level->lists[m].why.text);
}

static void print_reasons(FILE *out, const cmp_lines_run *run, const cmp_lines_case *c)
{
    for (size_t l = 0; l < c->level_count; l++) {
        const cmp_lines_level *level = &c->levels[l];
        cmp_damping_text damping;
        cmp_format_damping(&damping, &level->params, DAMPING_DIGITS);
        print_doubts(out, run, level, damping.text);
        for (size_t i = 0; i < level->pairs.count; i++)
            print_reason(out, damping.text, &level->pairs.pairs[i].verdict);
        print_reason(out, damping.text, &level->samples.verdict);
    }
}

static void print_summary(FILE *out, const cmp_lines_run *run)
{
    size_t levels = 0, branches = 0, points = 0, mismatches = 0, undecided = 0;
    double digits = HUGE_VAL;
    cmp_number_text text;
    for (size_t i = 0; i < run->case_count; i++)
        for (size_t l = 0; l < run->cases[i].level_count; l++) {
            const cmp_lines_level *level = &run->cases[i].levels[l];
            levels++;
            branches += level->pairs.count;
            points += level->samples.points;
            mismatches += level->samples.mismatches;
            undecided += level->samples.undecided_points;
            digits = fmin(digits, level->verdict.digits);
        }
    fprintf(out, "\nverdict: %s (%zu levels, %zu branches; %zu points counted, %zu mismatches, %zu undecided",
            cmp_kind_name(run->worst), levels, branches, points, mismatches, undecided);
    if (run->worst == CMP_AGREE && isfinite(digits))
        fprintf(out, "; at least %s digits", cmp_format_digits(&text, digits));
    fputs(")\n", out);
}

cv_status cmp_lines_report_text(FILE *out, const cmp_lines_run *run, cv_message *why)
{
    cmp_number_text range[4];
    for (int i = 0; i < 4; i++)
        cmp_format_exact(&range[i], run->task.range[i], RANGE_DIGITS);
    fprintf(out, "critvel-compare %s lines: %s against %s, %s <= alpha <= %s, %s <= eta_M <= %s, %d digits\n",
            CV_VERSION, run->methods[0]->name, run->methods[1]->name, range[0].text, range[1].text,
            range[2].text, range[3].text, run->task.digits);
    for (size_t i = 0; i < run->case_count; i++) {
        const cmp_lines_case *c = &run->cases[i];
        fprintf(out, "\n%s %s\n\n", c->from->is_track ? "track" : "case", c->from->name);
        cv_status status = print_branches(out, run, c, why);
        if (status == CV_OK && run->task.points > 0)
            status = print_counts(out, run, c, why);
        if (status != CV_OK)
            return status;
        print_reasons(out, run, c);
    }
    print_summary(out, run);
    return CV_OK;
}

static json_t *json_end(const cmp_line_end *e)
{
    return json_pack("{s:s, s:b, s:o, s:f}", "at", end_name(e->kind), "to_zero_mass", e->zero_mass,
                     "asymptote", cmp_json_number(e->asymptote), "asymptote_q", e->asymptote_q);
}

static json_t *json_branch(const cmp_branch *b)
{
    double low, high;
    if (b == NULL)
        return json_null();
    velocities(&low, &high, b);
    return json_pack("{s:I, s:o, s:o, s:o, s:o, s:o}", "vertices", (json_int_t)b->count, "alpha_from",
                     cmp_json_number(low), "alpha_to", cmp_json_number(high), "least_eta_M",
                     cmp_json_number(b->least_mass), "begins", json_end(&b->ends[0]), "ends",
                     json_end(&b->ends[1]));
}

static json_t *json_pair(const cmp_lines_run *run, const cmp_branch_pair *p)
{
    return json_pack("{s:o, s:o, s:I, s:o, s:o, s:o}", run->methods[0]->name, json_branch(p->by[0]),
                     run->methods[1]->name, json_branch(p->by[1]), "points_compared", (json_int_t)p->vertices,
                     "largest_difference", p->vertices > 0 ? cmp_json_number(p->difference) : json_null(),
                     "plot_distance", cmp_json_number(p->plot_distance), "agreement",
                     cmp_json_verdict(&p->verdict));
}

static json_t *json_mismatches(const cmp_lines_run *run, const cmp_line_samples *s, int *failed)
{
    json_t *list = json_array();
    for (size_t i = 0; i < s->mismatches && i < CMP_MISMATCHES_KEPT; i++) {
        char alpha[32], eta_M[32];
        snprintf(alpha, sizeof alpha, "%.17g", s->kept[i].alpha);
        snprintf(eta_M, sizeof eta_M, "%.17g", s->kept[i].eta_M);
        *failed |= json_array_append_new(list, json_pack("{s:s, s:s, s:i, s:i}", "alpha", alpha, "eta_M",
                                                         eta_M, run->methods[0]->name, s->kept[i].roots[0],
                                                         run->methods[1]->name, s->kept[i].roots[1]));
    }
    return list;
}

static json_t *json_counts(const cmp_lines_run *run, const cmp_line_samples *s, int *failed)
{
    return json_pack("{s:I, s:I, s:I, s:{s:I, s:I}, s:I, s:o, s:o}", "points", (json_int_t)s->points,
                     "near_lines", (json_int_t)s->near_lines, "undecided", (json_int_t)s->undecided_points,
                     "undecided_by", run->methods[0]->name, (json_int_t)s->undecided[0],
                     run->methods[1]->name, (json_int_t)s->undecided[1], "mismatches",
                     (json_int_t)s->mismatches, "first_mismatches", json_mismatches(run, s, failed),
                     "agreement", cmp_json_verdict(&s->verdict));
}

static json_t *json_level(const cmp_lines_run *run, const cmp_lines_level *level, int *failed)
{
    json_t *branches = json_array();
    for (size_t i = 0; i < level->pairs.count; i++)
        *failed |= json_array_append_new(branches, json_pair(run, &level->pairs.pairs[i]));
    return json_pack("{s:o, s:o, s:o, s:o}", "damping", cmp_json_damping(&level->params), "branches",
                     branches, "counts", json_counts(run, &level->samples, failed), "agreement",
                     cmp_json_verdict(&level->verdict));
}

static json_t *json_case(const cmp_lines_run *run, const cmp_lines_case *c, int *failed)
{
    json_t *levels = json_array();
    for (size_t l = 0; l < c->level_count; l++)
        *failed |= json_array_append_new(levels, json_level(run, &c->levels[l], failed));
    return json_pack("{s:s, s:o}", "name", c->from->name, "levels", levels);
}

cv_status cmp_lines_report_json(FILE *out, const cmp_lines_run *run, cv_message *why)
{
    json_t *cases = json_array();
    cmp_number_text range[4];
    int failed = 0;
    for (int i = 0; i < 4; i++)
        cmp_format_exact(&range[i], run->task.range[i], RANGE_DIGITS);
    for (size_t i = 0; i < run->case_count; i++)
        failed |= json_array_append_new(cases, json_case(run, &run->cases[i], &failed));
    json_t *root = json_pack("{s:s, s:s, s:s, s:i, s:{s:s, s:s}, s:{s:s, s:s}, s:I, s:o}", "schema",
                             "critvel-compare-lines/1", "version", CV_VERSION, "verdict",
                             cmp_kind_name(run->worst), "digits", run->task.digits, "alpha", "min",
                             range[0].text, "max", range[1].text, "eta_M", "min", range[2].text, "max",
                             range[3].text, "seed", (json_int_t)run->task.seed, "cases", cases);
    return cmp_json_write(root, failed, out, why);
}
