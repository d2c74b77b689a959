#include "common/run.h"

#include <stdlib.h>
#include <string.h>

#include "common/cli.h"

enum { DEFAULT_DIGITS = 20, DAMPINGS = 3 };

static const char *const damping_keys[DAMPINGS] = {"damping_p", "damping_b", "damping_f"};

void cv_run_clear(cv_run *run)
{
    for (int i = 0; i < DAMPINGS; ++i)
        cv_number_list_clear(&run->damping[i]);
    cv_number_list_clear(&run->mass_ratios);
    cv_number_list_clear(&run->alpha);
}

static cv_status read_alpha(cv_number_list *alpha, const cv_ini_entry *e, const char *path, cv_message *why)
{
    const cv_status status = cv_values_list(alpha, e, 1, path, why);
    if (status != CV_OK)
        return status;
    if (alpha->count != 2)
        return cv_ini_fail(why, CV_BAD_INPUT, path, e->line, "alpha: two numbers expected, %zu found",
                           alpha->count);
    if (cv_number_compare(&alpha->items[0], &alpha->items[1]) >= 0)
        return cv_ini_fail(why, CV_BAD_INPUT, path, e->line,
                           "alpha: empty range, the first number must be the smaller");
    return CV_OK;
}

static cv_status read_digits(int *digits, const cv_ini_entry *e, const char *path, cv_message *why)
{
    cv_message reason;
    const cv_status status = cv_set_digits(digits, e->value, &reason);
    if (status != CV_OK)
        return cv_ini_fail(why, status, path, e->line, "digits: %s", reason.text);
    return CV_OK;
}

/* damping = ... is written to all three lists, damping_p and so on to its own. */
static cv_status read_damping(cv_run *run, const cv_ini_section *s, const cv_ini_entry *e, const char *path,
                              cv_message *why)
{
    const int all = strcmp(e->key, "damping") == 0;
    for (int i = 0; i < DAMPINGS; ++i) {
        if (!all && strcmp(e->key, damping_keys[i]) != 0)
            continue;
        if (!all && cv_ini_find(s, "damping") != NULL)
            return cv_ini_fail(why, CV_BAD_INPUT, path, e->line, "%s beside damping: give one or the other",
                               e->key);
        const cv_status status = cv_values_list(&run->damping[i], e, 0, path, why);
        if (status != CV_OK || !all)
            return status;
    }
    return all ? CV_OK : cv_values_unknown_key(s, e, path, why);
}

static cv_status read_entry(cv_run *run, const cv_ini_section *s, const cv_ini_entry *e, const char *path,
                            cv_message *why)
{
    if (strcmp(e->key, "alpha") == 0)
        return read_alpha(&run->alpha, e, path, why);
    if (strcmp(e->key, "digits") == 0)
        return read_digits(&run->digits, e, path, why);
    if (strcmp(e->key, "mass_ratio") == 0)
        return cv_values_list(&run->mass_ratios, e, 1, path, why);
    return read_damping(run, s, e, path, why);
}

/* Either none of the three lists is there, or all are, as long as each other. */
static cv_status check_dampings(const cv_run *run, const cv_ini_section *s, const char *path, cv_message *why)
{
    size_t most = 0;
    for (int i = 0; i < DAMPINGS; ++i)
        if (run->damping[i].count > most)
            most = run->damping[i].count;
    for (int i = 0; i < DAMPINGS; ++i) {
        const cv_ini_entry *e = cv_ini_find(s, damping_keys[i]);
        const size_t count = run->damping[i].count;
        if (count == 0 && most > 0)
            return cv_ini_fail(why, CV_BAD_INPUT, path, s->line, "missing key '%s' in [run]",
                               damping_keys[i]);
        if (count < most && e != NULL)
            return cv_ini_fail(why, CV_BAD_INPUT, path, e->line,
                               "%s: %zu levels, another of the damping lists has %zu", e->key, count, most);
    }
    return CV_OK;
}

static cv_status read_section(cv_run *run, const cv_ini_section *s, const char *path, cv_message *why)
{
    for (size_t i = 0; i < s->count; ++i) {
        const cv_status status = read_entry(run, s, &s->entries[i], path, why);
        if (status != CV_OK)
            return status;
    }
    return check_dampings(run, s, path, why);
}

static cv_status default_alpha(cv_number_list *alpha, cv_message *why)
{
    char key[] = "alpha", value[] = "0.02 2.0";
    const cv_ini_entry e = {key, value, 0};
    return read_alpha(alpha, &e, "default", why);
}

cv_status cv_run_read(cv_run *out, const cv_ini_section *s, const char *path, cv_message *why)
{
    *out = (cv_run){.digits = DEFAULT_DIGITS};
    cv_status status = s != NULL ? read_section(out, s, path, why) : CV_OK;
    if (status == CV_OK && out->alpha.count == 0)
        status = default_alpha(&out->alpha, why);
    if (status != CV_OK)
        cv_run_clear(out);
    return status;
}
