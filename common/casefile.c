#include "common/casefile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/ini.h"
#include "common/run.h"
#include "common/values.h"

#define CASE_KEY(member, sign, required)                                                                     \
    {                                                                                                        \
#member, offsetof(cv_params, member), sign, required                                                 \
    }
#define TRACK_KEY(member, sign, required)                                                                    \
    {                                                                                                        \
#member, offsetof(cv_track, member), sign, required                                                  \
    }

static const cv_number_rule case_keys[] = {
    CASE_KEY(mu_s, 1, 1),    CASE_KEY(mu_b, 1, 1),  CASE_KEY(kappa_p, 1, 1),
    CASE_KEY(kappa_b, 1, 1), CASE_KEY(eta_s, 0, 0), CASE_KEY(eta_N, -1, 0),
};

static const cv_number_rule track_keys[] = {
    TRACK_KEY(EI, 1, 1),  TRACK_KEY(m, 1, 1),   TRACK_KEY(k_p, 1, 1), TRACK_KEY(c_p, 0, 0),
    TRACK_KEY(m_s, 1, 1), TRACK_KEY(k_b, 1, 1), TRACK_KEY(c_b, 0, 0), TRACK_KEY(m_b, 1, 1),
    TRACK_KEY(k_s, 0, 0), TRACK_KEY(k_f, 1, 1), TRACK_KEY(c_f, 0, 0), TRACK_KEY(N, -1, 0),
    TRACK_KEY(M, 1, 0),   TRACK_KEY(P, 1, 0),
};

enum {
    CASE_KEYS = sizeof case_keys / sizeof case_keys[0],
    TRACK_KEYS = sizeof track_keys / sizeof track_keys[0]
};

/* What is at hand while a file is read. */
typedef struct {
    const cv_ini *ini;
    const cv_ini_section *run_section; /* NULL: there is none */
    cv_run run;
    cv_message *why;
} builder;

static cv_status out_of_memory(cv_message *why)
{
    return cv_fail(why, CV_FAILED, "out of memory");
}

#define WRONG(b, line, ...) cv_ini_fail((b)->why, CV_BAD_INPUT, (b)->ini->path, line, __VA_ARGS__)

/* What follows "case " or "track " in the name of a section, "" when nothing does (strchr also finds the
 * terminator); NULL when it is neither. */
static const char *name_after(const char *section, const char *kind)
{
    const size_t n = strlen(kind);
    if (strncmp(section, kind, n) != 0 || strchr(" \t", section[n]) == NULL)
        return NULL;
    return section + n + strspn(section + n, " \t");
}

static int is_track(const cv_ini_section *s)
{
    return name_after(s->name, "track") != NULL;
}

static const char *case_name(const cv_ini_section *s)
{
    return name_after(s->name, is_track(s) ? "track" : "case");
}

/* The section of that number must be [run], the first of its kind, or a case with a name of its own. */
static cv_status classify(builder *b, size_t number)
{
    const cv_ini_section *s = &b->ini->sections[number];
    if (strcmp(s->name, "run") == 0) {
        if (b->run_section != NULL)
            return WRONG(b, s->line, "duplicate section [run] (first on line %d)", b->run_section->line);
        b->run_section = s;
        return CV_OK;
    }
    const char *name = case_name(s);
    if (name == NULL)
        return WRONG(b, s->line, "unknown section [%s]; expected [run], [case NAME] or [track NAME]",
                     s->name);
    if (*name == '\0')
        return WRONG(b, s->line, "[%s] without a name", s->name);
    for (const cv_ini_section *t = b->ini->sections; t < s; ++t)
        if (case_name(t) != NULL && strcmp(case_name(t), name) == 0)
            return WRONG(b, s->line, "duplicate name '%s' (first on line %d)", name, t->line);
    return CV_OK;
}

static cv_status add_level(cv_case *c, const cv_number *p, const cv_number *b, const cv_number *f,
                           cv_message *why)
{
    cv_level *larger = realloc(c->levels, (c->level_count + 1) * sizeof *larger);
    if (larger == NULL)
        return out_of_memory(why);
    c->levels = larger;
    cv_level *level = &c->levels[c->level_count++];
    cv_number_init(&level->eta_p);
    cv_number_init(&level->eta_b);
    cv_number_init(&level->eta_f);
    cv_number_set(&level->eta_p, p);
    cv_number_set(&level->eta_b, b);
    cv_number_set(&level->eta_f, f);
    return CV_OK;
}

/* The levels of [run], or of a track those it has itself. */
static cv_status set_levels(cv_case *c, const builder *b)
{
    const cv_number_list *lists = b->run.damping;
    if (lists[0].count == 0 && !c->is_track)
        return WRONG(b, b->run_section != NULL ? b->run_section->line : c->line,
                     "missing key 'damping' in [run], which [case %s] needs", c->name);
    if (lists[0].count == 0)
        return add_level(c, &c->params.eta_p, &c->params.eta_b, &c->params.eta_f, b->why);
    cv_status status = CV_OK;
    for (size_t i = 0; i < lists[0].count && status == CV_OK; ++i)
        status = add_level(c, &lists[0].items[i], &lists[1].items[i], &lists[2].items[i], b->why);
    return status;
}

/* The mass of a track as the only mass ratio. */
static cv_status mass_of_track(cv_number_list *list, const cv_case *c, cv_message *why)
{
    list->items = malloc(sizeof *list->items);
    if (list->items == NULL)
        return out_of_memory(why);
    list->count = 1;
    cv_number_init(&list->items[0]);
    const cv_status status = cv_track_mass_ratio(&list->items[0], &c->physical, why);
    if (status == CV_OK && !cv_number_fits_double(&list->items[0]))
        return cv_fail(why, CV_BAD_INPUT, "the mass ratio of [track %s] is outside 1e-300 .. 1e300", c->name);
    return status;
}

static cv_status set_mass_ratios(cv_case *c, const builder *b)
{
    cv_number_list list = {0};
    cv_status status;
    if (b->run.mass_ratios.count > 0)
        status = cv_number_list_copy(&list, &b->run.mass_ratios, b->why);
    else if (c->is_track && cv_number_sign(&c->physical.M) > 0)
        status = mass_of_track(&list, c, b->why);
    else
        return WRONG(b, b->run_section != NULL ? b->run_section->line : c->line,
                     c->is_track ? "missing key 'mass_ratio' in [run]; [track %s] has no M either"
                                 : "missing key 'mass_ratio' in [run], which [case %s] needs",
                     c->name);
    c->mass_ratios = list.items;
    c->mass_count = list.count;
    return status;
}

/* Line of the axial force, which buckles the track, or else of the section. */
static int blamed_line(const cv_ini_section *s)
{
    const cv_ini_entry *e = cv_ini_find(s, is_track(s) ? "N" : "eta_N");
    return e != NULL ? e->line : s->line;
}

static cv_status read_values(cv_case *c, const builder *b, const cv_ini_section *s)
{
    if (!c->is_track)
        return cv_values_section(&c->params, case_keys, CASE_KEYS, s, b->ini->path, b->why);
    cv_message reason;
    cv_status status = cv_values_section(&c->physical, track_keys, TRACK_KEYS, s, b->ini->path, b->why);
    if (status == CV_OK && (status = cv_track_to_params(&c->params, &c->physical, &reason)) != CV_OK)
        cv_ini_fail(b->why, status, b->ini->path, s->line, "%s", reason.text);
    return status;
}

static cv_status check_values(const cv_case *c, const builder *b, const cv_ini_section *s)
{
    cv_message reason;
    const cv_status status = cv_params_check(&c->params, &reason);
    if (status != CV_OK)
        cv_ini_fail(b->why, status, b->ini->path, blamed_line(s), "%s", reason.text);
    return status;
}

static cv_status read_case(cv_case *c, const builder *b, const cv_ini_section *s)
{
    c->name = strdup(case_name(s));
    if (c->name == NULL)
        return out_of_memory(b->why);
    cv_status status = read_values(c, b, s);
    if (status == CV_OK)
        status = set_levels(c, b);
    if (status == CV_OK)
        status = set_mass_ratios(c, b);
    if (status != CV_OK)
        return status;
    cv_case_params(&c->params, c, 0);
    return check_values(c, b, s);
}

/* Reads section s as the next case of out, which has room for it. */
static cv_status add_case(cv_casefile *out, const builder *b, const cv_ini_section *s)
{
    cv_case *c = &out->cases[out->case_count++];
    *c = (cv_case){.line = s->line, .is_track = is_track(s)};
    cv_params_init(&c->params);
    cv_track_init(&c->physical);
    return read_case(c, b, s);
}

static cv_status add_cases(cv_casefile *out, const builder *b)
{
    out->cases = malloc((b->ini->count + 1) * sizeof *out->cases);
    if (out->cases == NULL)
        return out_of_memory(b->why);
    for (size_t i = 0; i < b->ini->count; ++i) {
        const cv_ini_section *s = &b->ini->sections[i];
        const cv_status status = s == b->run_section ? CV_OK : add_case(out, b, s);
        if (status != CV_OK)
            return status;
    }
    if (out->case_count == 0)
        return WRONG(b, 0, "no [case NAME] or [track NAME] section");
    return CV_OK;
}

/* out is empty and, after a failure, still to be cleared. */
static cv_status build(cv_casefile *out, builder *b)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < b->ini->count && status == CV_OK; ++i)
        status = classify(b, i);
    if (status == CV_OK)
        status = cv_run_read(&b->run, b->run_section, b->ini->path, b->why);
    if (status != CV_OK)
        return status;
    cv_number_set(&out->alpha_min, &b->run.alpha.items[0]);
    cv_number_set(&out->alpha_max, &b->run.alpha.items[1]);
    out->digits = b->run.digits;
    out->path = strdup(b->ini->path);
    status = out->path != NULL ? add_cases(out, b) : out_of_memory(b->why);
    cv_run_clear(&b->run);
    return status;
}

cv_status cv_casefile_read(cv_casefile *out, const char *path, cv_message *why)
{
    cv_ini ini;
    cv_status status = cv_ini_read(&ini, path, why);
    if (status != CV_OK)
        return status;
    *out = (cv_casefile){0};
    cv_number_init(&out->alpha_min);
    cv_number_init(&out->alpha_max);
    builder b = {.ini = &ini, .why = why};
    status = build(out, &b);
    cv_ini_clear(&ini);
    if (status != CV_OK)
        cv_casefile_clear(out);
    return status;
}

static void clear_case(cv_case *c)
{
    for (size_t i = 0; i < c->level_count; ++i) {
        cv_number_clear(&c->levels[i].eta_p);
        cv_number_clear(&c->levels[i].eta_b);
        cv_number_clear(&c->levels[i].eta_f);
    }
    free(c->levels);
    for (size_t i = 0; i < c->mass_count; ++i)
        cv_number_clear(&c->mass_ratios[i]);
    free(c->mass_ratios);
    cv_params_clear(&c->params);
    cv_track_clear(&c->physical);
    free(c->name);
}

void cv_casefile_clear(cv_casefile *f)
{
    for (size_t i = 0; i < f->case_count; ++i)
        clear_case(&f->cases[i]);
    free(f->cases);
    free(f->path);
    cv_number_clear(&f->alpha_min);
    cv_number_clear(&f->alpha_max);
}

cv_status cv_casefile_find(const cv_case **out, const cv_casefile *f, const char *name, cv_message *why)
{
    char list[CV_MESSAGE_SIZE] = "";
    size_t used = 0;
    for (size_t i = 0; i < f->case_count; ++i) {
        if (name == NULL || strcmp(f->cases[i].name, name) == 0) {
            *out = &f->cases[i];
            return CV_OK;
        }
        if (used < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i > 0 ? ", " : "",
                                     f->cases[i].name);
    }
    return cv_ini_fail(why, CV_BAD_INPUT, f->path, 0, "no case '%.60s' in the file; there is: %s", name,
                       list);
}

void cv_case_params(cv_params *out, const cv_case *c, size_t level)
{
    if (out != &c->params)
        cv_params_set(out, &c->params);
    cv_number_set(&out->eta_p, &c->levels[level].eta_p);
    cv_number_set(&out->eta_b, &c->levels[level].eta_b);
    cv_number_set(&out->eta_f, &c->levels[level].eta_f);
}
