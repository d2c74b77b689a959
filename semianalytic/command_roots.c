/* critvel-semianalytic roots: mass-induced frequencies and growth rates. */
#include <jansson.h>
#include <math.h>
#include <stdlib.h>

#include "semianalytic/commands.h"
#include "semianalytic/decimal.h"
#include "semianalytic/roots.h"

/* how far to the left stable roots are listed unless --depth says so */
static const double default_depth = 1;

typedef struct {
    const cv_choice *choice;
    const cv_selection *selection;
    double depth;
    sa_root_list list;
} answer;

/* Digits that the error leaves of a part, at most those asked for. */
static int held(const mpfr_t part, const sa_root *r, int digits)
{
    if (r->decided == CV_OK || mpfr_zero_p(part) || !(r->error > 0))
        return digits;
    int n = (int)floor(log10(fabs(mpfr_get_d(part, MPFR_RNDN)) / r->error)) - 1;
    return n < 1 ? 1 : n < digits ? n : digits;
}

static int is_unstable(const sa_root *r)
{
    return mpfr_sgn(r->re) > 0;
}

static json_t *json_root(const sa_root *r, int digits)
{
    char *re = sa_decimal_text(r->re, held(r->re, r, digits));
    char *im = sa_decimal_text(r->im, held(r->im, r, digits));
    json_t *object = re && im ? json_pack("{s:s, s:s, s:b, s:f, s:b}", "re", re, "im", im, "unstable",
                                          is_unstable(r), "error", r->error, "decided", r->decided == CV_OK)
                              : NULL;
    free(re);
    free(im);
    return object;
}

static cv_status write_json(FILE *out, const answer *a, cv_message *why)
{
    json_t *roots = json_array();
    int done = 1;
    for (size_t i = 0; i < a->list.count; i++)
        done &= json_array_append_new(roots, json_root(&a->list.items[i], a->choice->digits)) == 0;
    char *alpha = cv_number_text(&a->selection->alpha.value, 40);
    char *mass = cv_number_text(&a->selection->mass_ratio.value, 40);
    json_t *root = json_pack("{s:s, s:s, s:s, s:s, s:i, s:f, s:i, s:b, s:o}", "schema",
                             "critvel-semianalytic-roots/1", "case", a->choice->chosen->name, "alpha", alpha,
                             "eta_M", mass, "digits", a->choice->digits, "depth", a->depth, "unstable_roots",
                             a->list.unstable_roots, "decided", a->list.decided == CV_OK, "roots", roots);
    done = done && root && json_dumpf(root, out, JSON_INDENT(2) | JSON_REAL_PRECISION(3)) == 0 &&
           fputc('\n', out) != EOF;
    json_decref(root);
    free(alpha);
    free(mass);
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

static int write_root(FILE *out, const sa_root *r, int digits)
{
    char *re = sa_decimal_text(r->re, held(r->re, r, digits));
    char *im = sa_decimal_text(r->im, held(r->im, r, digits));
    int done =
        re && im &&
        fprintf(out, "%-9s Re qbar = %s\n%-9s Im qbar = %s%s\n", is_unstable(r) ? "unstable" : "stable", re,
                "", im, r->decided == CV_OK ? "" : "  (fewer digits than asked for)") > 0;
    free(re);
    free(im);
    return done;
}

static cv_status write_text(FILE *out, const answer *a, cv_message *why)
{
    int done = fprintf(out, "case %s: %d unstable roots, conjugates counted\n", a->choice->chosen->name,
                       a->list.unstable_roots) > 0;
    for (size_t i = 0; i < a->list.count; i++)
        done = done && write_root(out, &a->list.items[i], a->choice->digits);
    return done ? CV_OK : cv_fail(why, CV_FAILED, "out of memory");
}

static cv_status find(answer *a, cv_message *why)
{
    sa_track *track;
    cv_status status = sa_track_new(&track, &a->choice->params, why);
    if (status != CV_OK)
        return status;
    status = sa_roots_find(&a->list, track, &a->selection->alpha.value, &a->selection->mass_ratio.value,
                           a->depth, a->choice->digits, why);
    sa_track_free(track);
    return status;
}

cv_status sa_command_roots(const sa_options *options, const cv_arguments *arguments, FILE *out, FILE *log,
                           cv_message *why)
{
    cv_choice choice;
    answer a = {.choice = &choice, .selection = &options->selection, .depth = default_depth};
    (void)log;
    if (options->depth.given)
        a.depth = cv_number_get_double(&options->depth.value);
    cv_status status = cv_require(&options->selection.alpha, "alpha", why);
    if (status == CV_OK)
        status = cv_require(&options->selection.mass_ratio, "mass-ratio", why);
    if (status == CV_OK)
        status = cv_choose(&choice, &options->selection, arguments->path, why);
    if (status != CV_OK)
        return status;
    status = find(&a, why);
    if (status == CV_OK) {
        const cv_status decided = a.list.decided;
        status =
            options->selection.format == CV_FORMAT_JSON ? write_json(out, &a, why) : write_text(out, &a, why);
        if (status == CV_OK && decided != CV_OK)
            status = cv_fail(why, decided, "%s", a.list.reason.text);
        sa_roots_clear(&a.list);
    }
    cv_choice_clear(&choice);
    return status;
}
