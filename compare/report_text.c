#include "compare/report.h"

#include <math.h>

#include "common/cli.h"
#include "compare/format.h"
#include "compare/table.h"

enum { LIMIT_DIGITS = 12, SI_DIGITS = 7, PARAMETER_DIGITS = 6 };

static void print_parameters(FILE *out, const cmp_case *c)
{
    const cv_params *p = &c->from->params;
    const cv_number *const values[] = {&p->mu_s, &p->mu_b, &p->kappa_p, &p->kappa_b, &p->eta_s, &p->eta_N};
    static const char *const names[] = {"mu_s", "mu_b", "kappa_p", "kappa_b", "eta_s", "eta_N"};
    cmp_number_text text;
    fprintf(out, "\n%s %s\n ", c->from->is_track ? "track" : "case", c->from->name);
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        fprintf(out, " %s = %s%s", names[i], cmp_format_exact(&text, values[i], PARAMETER_DIGITS),
                i < 5 ? "," : "\n");
    if (c->from->is_track) {
        mpfr_t v;
        mpfr_init2(v, 128);
        cv_track_reference_velocity(v, &c->from->physical);
        fprintf(out, "  v_ref = %s m/s\n", cmp_format_mpfr(&text, v, SI_DIGITS));
        mpfr_clear(v);
    }
    fputc('\n', out);
}

/* Cells of one combination; the texts the pointers lead to. */
typedef struct {
    cmp_number_text mass, kg, limit, metres, kilometres, digits;
    cmp_damping_text damping;
    char count[64];
} cells;

/* The limit as the semianalytical list has it; the verdict says whether the other list has the same. */
static void fill_limit(cells *c, const cmp_level *level, size_t mass, const cv_case *from)
{
    const cmp_list *list = &level->lists[CMP_SEMIANALYTIC][mass];
    const size_t limit = cmp_list_limit(list);
    snprintf(c->limit.text, sizeof c->limit.text, "none");
    c->metres.text[0] = c->kilometres.text[0] = '\0';
    if (limit == list->count)
        return;
    mpfr_srcptr alpha = list->items[limit].alpha;
    cmp_format_mpfr(&c->limit, alpha, LIMIT_DIGITS);
    if (!from->is_track)
        return;
    mpfr_t v;
    mpfr_init2(v, 128);
    cmp_velocity(v, alpha, &from->physical, 0);
    cmp_format_mpfr(&c->metres, v, SI_DIGITS);
    cmp_velocity(v, alpha, &from->physical, 1);
    cmp_format_mpfr(&c->kilometres, v, SI_DIGITS);
    mpfr_clear(v);
}

static void fill_kg(cells *c, const cv_number *eta_M, const cv_case *from)
{
    mpfr_t kg;
    if (!from->is_track)
        return;
    mpfr_init2(kg, 128);
    cmp_mass(kg, eta_M, &from->physical);
    cmp_format_mpfr(&c->kg, kg, SI_DIGITS);
    mpfr_clear(kg);
}

static void add_mass(cmp_table *t, const cmp_level *level, size_t mass, const cv_case *from)
{
    cells c;
    const cmp_verdict *v = &level->results[mass].verdict;
    const size_t counts[] = {level->lists[0][mass].count, level->lists[1][mass].count};
    fill_limit(&c, level, mass, from);
    fill_kg(&c, &from->mass_ratios[mass], from);
    if (counts[0] == counts[1])
        snprintf(c.count, sizeof c.count, "%zu", counts[0]);
    else
        snprintf(c.count, sizeof c.count, "%zu/%zu", counts[0], counts[1]);
    const char *const damping = cmp_format_damping(&c.damping, &level->params, PARAMETER_DIGITS);
    const char *const eta_M = cmp_format_exact(&c.mass, &from->mass_ratios[mass], PARAMETER_DIGITS);
    const char *const digits = v->kind == CMP_AGREE ? cmp_format_digits(&c.digits, v->digits) : "-";
    const char *const verdict = cmp_kind_name(v->kind);
    if (from->is_track)
        cmp_table_add(t, (const char *const[]){damping, eta_M, c.kg.text, c.limit.text, c.metres.text,
                                               c.kilometres.text, c.count, digits, verdict});
    else
        cmp_table_add(t, (const char *const[]){damping, eta_M, c.limit.text, c.count, digits, verdict});
}

static cv_status print_table(FILE *out, const cmp_case *c, cv_message *why)
{
    static const char *const heading[] = {"damping",     "eta_M",  "stability limit",
                                          "transitions", "digits", "verdict"};
    static const char *const track_heading[] = {"damping", "eta_M",       "kg",     "stability limit", "m/s",
                                                "km/h",    "transitions", "digits", "verdict"};
    cmp_table t;
    cmp_table_init(&t, c->from->is_track ? "lrrlrrrrl" : "lrlrrl");
    cmp_table_add(&t, c->from->is_track ? track_heading : heading);
    for (size_t l = 0; l < c->level_count; l++)
        for (size_t m = 0; m < c->from->mass_count; m++)
            add_mass(&t, &c->levels[l], m, c->from);
    cv_status status = cmp_table_print(&t, out, 2, why);
    cmp_table_clear(&t);
    return status;
}

/* One line for a combination that has something to say beyond "none, 0" in its row. */
static void print_reason(FILE *out, const cmp_result *r, const char *damping, const char *eta_M)
{
    const cmp_verdict *v = &r->verdict;
    const int explained = v->reason.text[0] != '\0' && (v->kind != CMP_AGREE || r->counts.start > 0);
    if (!explained && r->searches <= 1)
        return;
    fprintf(out, "  %s, damping %s, eta_M %s: ", cmp_kind_name(v->kind), damping, eta_M);
    if (r->searches > 1)
        fprintf(out, "searched %d times, more densely each time%s", r->searches, explained ? "; " : "");
    fprintf(out, "%s\n", explained ? v->reason.text : "");
}

static void print_reasons(FILE *out, const cmp_case *c)
{
    cmp_damping_text damping;
    cmp_number_text mass;
    for (size_t l = 0; l < c->level_count; l++)
        for (size_t m = 0; m < c->from->mass_count; m++)
            print_reason(out, &c->levels[l].results[m],
                         cmp_format_damping(&damping, &c->levels[l].params, PARAMETER_DIGITS),
                         cmp_format_exact(&mass, &c->from->mass_ratios[m], PARAMETER_DIGITS));
}

static void add_transitions(cmp_table *t, const cmp_run *run, const cmp_level *level, const cv_case *from,
                            size_t mass)
{
    cmp_damping_text damping;
    char roots[64];
    cmp_number_text eta_M, alpha, q;
    for (int m = 0; m < CMP_METHODS; m++) {
        const cmp_list *list = &level->lists[m][mass];
        for (size_t i = 0; i < list->count; i++) {
            const cmp_transition *x = &list->items[i];
            snprintf(roots, sizeof roots, "%d -> %d", x->below, x->above);
            cmp_table_add(t, (const char *const[]){
                                 cmp_format_damping(&damping, &level->params, PARAMETER_DIGITS),
                                 cmp_format_exact(&eta_M, &from->mass_ratios[mass], PARAMETER_DIGITS),
                                 run->methods[m]->name,
                                 cmp_format_claimed(&alpha, x->alpha, x->alpha_error, run->file->digits),
                                 cmp_format_claimed(&q, x->q, x->q_error, run->file->digits), roots});
        }
    }
}

static cv_status print_transitions(FILE *out, const cmp_run *run, const cmp_case *c, cv_message *why)
{
    static const char *const heading[] = {"damping", "eta_M", "method", "alpha", "q", "unstable roots"};
    cmp_table t;
    cmp_table_init(&t, "lrlllr");
    cmp_table_add(&t, heading);
    for (size_t l = 0; l < c->level_count; l++)
        for (size_t m = 0; m < c->from->mass_count; m++)
            add_transitions(&t, run, &c->levels[l], c->from, m);
    fputc('\n', out);
    cv_status status = cmp_table_print(&t, out, 2, why);
    cmp_table_clear(&t);
    return status;
}

static cv_status print_printed(FILE *out, const cmp_printed *printed, cv_message *why)
{
    static const char *const heading[] = {"item", "where", "printed", "computed", "verdict"};
    if (printed->count == 0)
        return CV_OK;
    cmp_table t;
    cmp_table_init(&t, "lllll");
    cmp_table_add(&t, heading);
    for (size_t i = 0; i < printed->count; i++) {
        const cmp_printed_row *r = &printed->rows[i];
        cmp_table_add(&t, (const char *const[]){r->item, r->where, r->printed, r->computed,
                                                r->agrees ? "agrees" : "differs"});
    }
    fputs("\nthe print (Dimitrovova & Mazilu, J. Phys.: Conf. Ser. 2647 (2024) 252017)\n\n", out);
    cv_status status = cmp_table_print(&t, out, 2, why);
    cmp_table_clear(&t);
    return status;
}

static void print_summary(FILE *out, const cmp_run *run)
{
    cmp_summary s;
    cmp_number_text text;
    cmp_run_summary(&s, run);
    fprintf(out, "\nverdict: %s", cmp_kind_name(s.worst));
    fprintf(out, " (%zu combinations: %zu agree, %zu disagree, %zu undecided", s.total, s.of_kind[CMP_AGREE],
            s.of_kind[CMP_DISAGREE], s.of_kind[CMP_UNDECIDED]);
    if (isfinite(s.fewest_digits))
        fprintf(out, "; at least %s digits", cmp_format_digits(&text, s.fewest_digits));
    if (s.used > 0.0)
        fprintf(out, "; put back, |z - 1| is at most %.2g of what the bounds allow", s.used);
    fputs(")\n", out);
}

cv_status cmp_report_text(FILE *out, const cmp_run *run, const cmp_printed *printed, int with_transitions,
                          cv_message *why)
{
    cmp_number_text low, high;
    fprintf(out, "critvel-compare %s: %s against %s, %s <= alpha <= %s, %d digits\n", CV_VERSION,
            run->methods[0]->name, run->methods[1]->name, cmp_format_exact(&low, &run->file->alpha_min, 20),
            cmp_format_exact(&high, &run->file->alpha_max, 20), run->file->digits);
    for (size_t i = 0; i < run->case_count; i++) {
        print_parameters(out, &run->cases[i]);
        cv_status status = print_table(out, &run->cases[i], why);
        if (status == CV_OK && with_transitions)
            status = print_transitions(out, run, &run->cases[i], why);
        if (status != CV_OK)
            return status;
        print_reasons(out, &run->cases[i]);
    }
    cv_status status = print_printed(out, printed, why);
    print_summary(out, run);
    return status;
}
