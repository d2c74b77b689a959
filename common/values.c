#include "common/values.h"

#include <stdlib.h>
#include <string.h>

static cv_status out_of_memory(cv_message *why)
{
    return cv_fail(why, CV_FAILED, "out of memory");
}

void cv_number_list_clear(cv_number_list *list)
{
    for (size_t i = 0; i < list->count; ++i)
        cv_number_clear(&list->items[i]);
    free(list->items);
    *list = (cv_number_list){0};
}

cv_status cv_number_list_copy(cv_number_list *to, const cv_number_list *from, cv_message *why)
{
    to->items = malloc(from->count * sizeof *to->items);
    if (to->items == NULL)
        return out_of_memory(why);
    to->count = from->count;
    for (size_t i = 0; i < from->count; ++i) {
        cv_number_init(&to->items[i]);
        cv_number_set(&to->items[i], &from->items[i]);
    }
    return CV_OK;
}

static cv_status append_number(cv_number_list *list, const char *text, int least_sign, cv_message *why)
{
    cv_number *larger = realloc(list->items, (list->count + 1) * sizeof *larger);
    if (larger == NULL)
        return out_of_memory(why);
    list->items = larger;
    cv_number *x = &list->items[list->count++];
    cv_number_init(x);
    const cv_status status = cv_number_parse(x, text, why);
    if (status == CV_OK && cv_number_sign(x) < least_sign)
        return cv_fail(why, CV_BAD_INPUT, "must be %s 0", least_sign > 0 ? ">" : ">=");
    return status;
}

static cv_status append_words(cv_number_list *list, const char *words, int least_sign, cv_message *why)
{
    char *text = strdup(words), *rest = NULL;
    if (text == NULL)
        return out_of_memory(why);
    cv_status status = CV_OK;
    char *word = strtok_r(text, " \t", &rest);
    if (word == NULL)
        status = cv_fail(why, CV_BAD_INPUT, "a number is missing");
    for (; word != NULL && status == CV_OK; word = strtok_r(NULL, " \t", &rest))
        status = append_number(list, word, least_sign, why);
    free(text);
    return status;
}

cv_status cv_values_list(cv_number_list *list, const cv_ini_entry *e, int least_sign, const char *path,
                         cv_message *why)
{
    cv_message reason;
    const cv_status status = append_words(list, e->value, least_sign, &reason);
    if (status == CV_OK)
        return CV_OK;
    cv_number_list_clear(list);
    return cv_ini_fail(why, status, path, e->line, "%s: %s", e->key, reason.text);
}

static cv_status read_number(cv_number *to, const cv_ini_entry *e, int least_sign, const char *path,
                             cv_message *why)
{
    cv_number_list list = {0};
    cv_status status = cv_values_list(&list, e, least_sign, path, why);
    if (status == CV_OK && list.count != 1)
        status = cv_ini_fail(why, CV_BAD_INPUT, path, e->line, "%s: one number expected, %zu found", e->key,
                             list.count);
    if (status == CV_OK)
        cv_number_set(to, &list.items[0]);
    cv_number_list_clear(&list);
    return status;
}

cv_status cv_values_unknown_key(const cv_ini_section *s, const cv_ini_entry *e, const char *path,
                                cv_message *why)
{
    return cv_ini_fail(why, CV_BAD_INPUT, path, e->line, "unknown key '%s' in [%s]", e->key, s->name);
}

cv_status cv_values_section(void *base, const cv_number_rule *rules, size_t rule_count,
                            const cv_ini_section *s, const char *path, cv_message *why)
{
    for (size_t i = 0; i < s->count; ++i) {
        const cv_ini_entry *e = &s->entries[i];
        const cv_number_rule *r = rules;
        while (r < rules + rule_count && strcmp(r->key, e->key) != 0)
            ++r;
        if (r == rules + rule_count)
            return cv_values_unknown_key(s, e, path, why);
        cv_number *to = (cv_number *)(void *)((char *)base + r->offset);
        const cv_status status = read_number(to, e, r->least_sign, path, why);
        if (status != CV_OK)
            return status;
    }
    for (const cv_number_rule *r = rules; r < rules + rule_count; ++r)
        if (r->required && cv_ini_find(s, r->key) == NULL)
            return cv_ini_fail(why, CV_BAD_INPUT, path, s->line, "missing key '%s' in [%s]", r->key, s->name);
    return CV_OK;
}
