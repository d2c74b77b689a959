/* The case file: an INI file with one [run] section and any number of [case NAME] (dimensionless) and
 * [track NAME] (SI units) sections; README describes it. Every number is an exact decimal. */
#ifndef CRITVEL_COMMON_CASEFILE_H
#define CRITVEL_COMMON_CASEFILE_H

#include <stddef.h>

#include "common/track.h"

/* One damping level: the three ratios, as they were typed. For a [track] section without damping lists in
 * [run] the level holds the track's own ratios of (6), which need not be decimals. */
typedef struct {
    cv_number eta_p, eta_b, eta_f;
} cv_level;

typedef struct {
    char *name;       /* what follows "case " or "track " in the section name; unique in the file */
    int line;         /* of the section's header */
    int is_track;     /* 1: physical holds the SI values and reports add m/s and km/h */
    cv_params params; /* with the dampings of level 0; (5)-(6) exact */
    cv_track physical;
    size_t level_count; /* the damping levels of this case, at least one */
    cv_level *levels;
    size_t mass_count; /* the mass ratios eta_M of this case, at least one, all > 0 */
    cv_number *mass_ratios;
} cv_case;

typedef struct {
    char *path;
    cv_number alpha_min, alpha_max; /* velocity range searched, 0 < alpha_min < alpha_max */
    int digits;                     /* 1 .. CV_DIGITS_MAX, default 20 */
    size_t case_count;              /* at least one */
    cv_case *cases;                 /* in the order of the file */
} cv_casefile;

enum { CV_DIGITS_MAX = 1000 };

/* Reads and checks the whole file: the result is complete and valid, or nothing is allocated and the message
 * is "file:line: what is wrong". CV_BAD_INPUT for anything the user can mend, CV_FAILED for lack of memory or
 * a read error. */
cv_status cv_casefile_read(cv_casefile *out, const char *path, cv_message *why);
void cv_casefile_clear(cv_casefile *f);

/* The case of that name; NULL name: the only or first case. CV_BAD_INPUT lists the names there are. */
cv_status cv_casefile_find(const cv_case **out, const cv_casefile *f, const char *name, cv_message *why);

/* params of a case at one of its levels. out must be initialised. */
void cv_case_params(cv_params *out, const cv_case *c, size_t level);

#endif
