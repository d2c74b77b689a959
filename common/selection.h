/* FILE and the options that choose a point from it: --case, --damping, --alpha, --frequency, --mass-ratio,
 * --digits, --format. */
#ifndef CRITVEL_COMMON_SELECTION_H
#define CRITVEL_COMMON_SELECTION_H

#include "common/casefile.h"
#include "common/cli.h"

/* What was typed. A program puts one first in its options structure. */
typedef struct {
    const char *case_name; /* NULL: the first case of the file */
    int digits;            /* 0: as the file says */
    cv_format format;
    cv_optional_number damping;    /* overrides eta_p, eta_b and eta_f */
    cv_optional_number alpha;      /* velocity ratio */
    cv_optional_number frequency;  /* q, dimensionless */
    cv_optional_number mass_ratio; /* eta_M */
} cv_selection;

/* Rows of a cv_option table for the cv_selection at offset base; a program lists those it takes, e.g.
 *   static const cv_option options[] = {CV_OPTION_CASE(0), CV_OPTION_DIGITS(0), {NULL, NULL, 0, 0}}; */
#define CV_SELECTION_ROW(base, name, setter, member)                                                         \
    {                                                                                                        \
        name, setter, (base) + offsetof(cv_selection, member), 0                                             \
    }
#define CV_OPTION_CASE(base) CV_SELECTION_ROW(base, "case", cv_set_text, case_name)
#define CV_OPTION_DIGITS(base) CV_SELECTION_ROW(base, "digits", cv_set_digits, digits)
#define CV_OPTION_FORMAT(base) CV_SELECTION_ROW(base, "format", cv_set_format, format)
#define CV_OPTION_DAMPING(base) CV_SELECTION_ROW(base, "damping", cv_set_number, damping)
#define CV_OPTION_ALPHA(base) CV_SELECTION_ROW(base, "alpha", cv_set_number, alpha)
#define CV_OPTION_FREQUENCY(base) CV_SELECTION_ROW(base, "frequency", cv_set_number, frequency)
#define CV_OPTION_MASS_RATIO(base) CV_SELECTION_ROW(base, "mass-ratio", cv_set_number, mass_ratio)

void cv_selection_init(cv_selection *s);
void cv_selection_clear(cv_selection *s);

/* What the file and the selection give together. */
typedef struct {
    cv_casefile file;
    const cv_case *chosen; /* inside file */
    cv_params params;      /* of the chosen case: at --damping if that was given, else at its first level */
    int digits;
} cv_choice;

/* Reads the file at path and applies the selection. CV_BAD_INPUT also for --damping < 0, --alpha < 0 and
 * --mass-ratio <= 0. On failure nothing is allocated. */
cv_status cv_choose(cv_choice *out, const cv_selection *s, const char *path, cv_message *why);
void cv_choice_clear(cv_choice *c);

/* CV_BAD_INPUT "missing option --name" unless given. */
cv_status cv_require(const cv_optional_number *option, const char *name, cv_message *why);

#endif
