/* critvel-semianalytic resonances: resonance and pseudocritical velocities of the moving force. */
#include <jansson.h>
#include <math.h>
#include <stdlib.h>

#include "semianalytic/commands.h"
#include "semianalytic/decimal.h"
#include "semianalytic/pseudocritical.h"
#include "semianalytic/resonances.h"

/* Pseudocritical velocities are computed in long double: more digits than this are not claimed. */
enum { PSEUDOCRITICAL_DIGITS = 15 };

typedef struct {
    const cv_choice *choice;
    sa_resonance_list resonances;
    sa_pseudocritical_list pseudocritical;
} answer;

/* Digits that the error bound leaves, at most those asked for. Caller frees. */
static char *pseudocritical_text(const sa_pseudocritical *p, int digits)
{
    int held = (int)floor(-log10(p->error / (double)p->alpha));
    mpfr_t alpha;

    if (held > PSEUDOCRITICAL_DIGITS) {
        held = PSEUDOCRITICAL_DIGITS;
    }
    mpfr_init2(alpha, 64);
    mpfr_set_ld(alpha, p->alpha, MPFR_RNDN);
    char *text = sa_decimal_text(alpha, digits < held ? digits : held);
    mpfr_clear(alpha);
    return text;
}

static json_t *json_resonance(const sa_resonance *r, int digits)
{
    char *alpha = sa_decimal_text(r->alpha, digits), *p = sa_decimal_text(r->p, digits);
    json_t *object = alpha && p ? json_pack("{s:s, s:s, s:s, s:i}", "alpha", alpha, "kind",
                                            sa_resonance_kind_text(r->kind), "p", p, "branch", r->k + 1)
                                : NULL;
    free(alpha);
    free(p);
    return object;
}

static json_t *json_pseudocritical(const sa_pseudocritical *p, int digits)
{
    char *alpha = pseudocritical_text(p, digits);
    json_t *object = alpha
                         ? json_pack("{s:s, s:s, s:f, s:f, s:o}", "alpha", alpha, "of", sa_curve_text(p->of),
                                     "error", p->error, "deflection", p->deflection, "xi",
                                     isinf(p->distance) ? json_string(p->ahead ? "far ahead" : "far behind")
                                                        : json_real(p->ahead ? p->distance : -p->distance))
                         : NULL;
    free(alpha);
    return object;
}

static cv_status write_json(FILE *out, const answer *a, cv_message *why)
{
    const cv_casefile *file = &a->choice->file;
    int digits = a->choice->digits, done = 1;
    json_t *resonances = json_array(), *pseudocritical = json_array();

    for (size_t i = 0; i < a->resonances.count; i++) {
        done &= json_array_append_new(resonances, json_resonance(&a->resonances.item[i], digits)) == 0;
    }
    for (size_t i = 0; i < a->pseudocritical.count; i++) {
        done &= json_array_append_new(pseudocritical,
                                      json_pseudocritical(&a->pseudocritical.item[i], digits)) == 0;
    }
    char *low = cv_number_text(&file->alpha_min, 40), *high = cv_number_text(&file->alpha_max, 40);
    json_t *root =
        json_pack("{s:s, s:s, s:i, s:o, s:[s, s], s:o}", "schema", "critvel-semianalytic-resonances/1",
                  "case", a->choice->chosen->name, "digits", digits, "resonances", resonances,
                  "pseudocritical_range", low, high, "pseudocritical", pseudocritical);
    done = done && root && json_dumpf(root, out, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0 &&
           fputc('\n', out) != EOF;
    json_decref(root);
    free(low);
    free(high);
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

static int write_resonance(FILE *out, const sa_resonance *r, int digits)
{
    char *alpha = sa_decimal_text(r->alpha, digits), *p = sa_decimal_text(r->p, digits);
    int done = alpha && p && fprintf(out, "%-8s %s  p = %s\n", sa_resonance_kind_text(r->kind), alpha, p) > 0;

    free(alpha);
    free(p);
    return done;
}

static int write_pseudocritical(FILE *out, const sa_pseudocritical *p, int digits)
{
    char *alpha = pseudocritical_text(p, digits);
    int done =
        alpha && fprintf(out, "%-13s %-18s w = %-13.7g ", sa_curve_text(p->of), alpha, p->deflection) > 0;

    if (done && isinf(p->distance)) {
        done = fprintf(out, "far %s the force\n", p->ahead ? "ahead of" : "behind") > 0;
    } else if (done) {
        done = fprintf(out, "at xi = %.6g\n", p->ahead ? p->distance : -p->distance) > 0;
    }
    free(alpha);
    return done;
}

static cv_status write_text(FILE *out, const answer *a, cv_message *why)
{
    int digits = a->choice->digits, merging = 0;
    int done =
        fprintf(out, "case %s\n\nresonance velocities of the moving force\n", a->choice->chosen->name) > 0;

    for (size_t i = 0; i < a->resonances.count; i++) {
        done = done && write_resonance(out, &a->resonances.item[i], digits);
        merging |= a->resonances.item[i].kind == SA_RESONANCE_MERGING;
    }
    if (merging) {
        done = done && fputs("merging: a true and a false one that cannot be told from one double or none\n",
                             out) >= 0;
    }
    char *low = cv_number_text(&a->choice->file.alpha_min, 40);
    char *high = cv_number_text(&a->choice->file.alpha_max, 40);
    done = done && low && high &&
           fprintf(out, "\npseudocritical velocities, %s <= alpha <= %s%s\n", low, high,
                   a->pseudocritical.count == 0 ? ": none" : "") > 0;
    for (size_t i = 0; i < a->pseudocritical.count; i++) {
        done = done && write_pseudocritical(out, &a->pseudocritical.item[i], digits);
    }
    free(low);
    free(high);
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

cv_status sa_command_resonances(const sa_options *options, const cv_arguments *arguments, FILE *out,
                                FILE *log, cv_message *why)
{
    cv_choice choice;
    answer a = {.choice = &choice};
    cv_status status = cv_choose(&choice, &options->selection, arguments->path, why);

    (void)log;
    if (status != CV_OK) {
        return status;
    }
    status = sa_resonances(&a.resonances, &choice.params, choice.digits, why);
    if (status == CV_OK) {
        status = sa_pseudocritical_find(&a.pseudocritical, &choice.params,
                                        cv_number_get_double(&choice.file.alpha_min),
                                        cv_number_get_double(&choice.file.alpha_max), why);
    }
    if (status == CV_OK) {
        status =
            options->selection.format == CV_FORMAT_JSON ? write_json(out, &a, why) : write_text(out, &a, why);
    }
    sa_resonances_clear(&a.resonances);
    sa_pseudocritical_clear(&a.pseudocritical);
    cv_choice_clear(&choice);
    return status;
}
