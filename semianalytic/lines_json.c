#include <jansson.h>
#include <stdlib.h>

#include "semianalytic/decimal.h"
#include "semianalytic/lines_report.h"

/* A string that jansson copies; json_null() never, NULL when out of memory. */
static json_t *take_text(char *text)
{
    json_t *value = text != NULL ? json_string(text) : NULL;
    free(text);
    return value;
}

static json_t *number_text(const cv_number *x)
{
    return take_text(cv_number_text(x, 40));
}

static json_t *decimal(const mpfr_t x, double error, int digits)
{
    return take_text(sa_lines_decimal(x, error, digits));
}

/* Adds "value" under "key" and takes it over; 0 when out of memory. */
static int add(json_t *object, const char *key, json_t *value)
{
    return value != NULL && json_object_set_new(object, key, value) == 0;
}

static json_t *marks_of(const sa_line_vertex *v)
{
    static const char *const text[] = {"least eta_M", "most eta_M", "turning point",
                                       "cut",         "vertical",   "branch curve"};
    json_t *marks = json_array();
    for (int i = 0; i < 6 && marks != NULL; ++i)
        if ((v->marks & 1 << i) && json_array_append_new(marks, json_string(text[i])) != 0)
            json_array_clear(marks);
    return marks;
}

static json_t *vertex_of(const sa_line_vertex *v, int digits)
{
    json_t *object = json_object();
    int done = add(object, "alpha", decimal(v->alpha, v->alpha_error, digits)) &&
               add(object, "q", decimal(v->q, v->q_error, digits)) &&
               add(object, "eta_M", decimal(v->eta_M, v->eta_M_error, digits));
    if (v->marks != 0)
        done = done && add(object, "marks", marks_of(v));
    if (v->decided != CV_OK)
        done = done && add(object, "decided", json_false());
    if (done)
        return object;
    json_decref(object);
    return NULL;
}

static json_t *end_of(const sa_line_end *end, const sa_lines *lines, int digits)
{
    json_t *object = json_object();
    int done = add(object, "at", json_string(sa_end_kind_text(end->kind))) &&
               add(object, "beyond", json_string(sa_beyond_text(end->beyond)));
    if (end->beyond == SA_BEYOND_ASYMPTOTE) {
        const sa_asymptote *a = &lines->asymptotes.item[end->number];
        done = done && add(object, "alpha", decimal(a->alpha, a->alpha_error, digits));
    } else if (end->beyond == SA_BEYOND_BRANCH) {
        done = done && add(object, "branch", json_integer((json_int_t)end->number + 1));
    } else if (end->beyond == SA_BEYOND_ZERO || end->beyond == SA_BEYOND_VERTICAL) {
        done = done && add(object, "alpha", json_real(end->zero_alpha)) &&
               add(object, "q", json_real(end->zero_q));
    }
    if (done)
        return object;
    json_decref(object);
    return NULL;
}

static json_t *vertices_of(const sa_branch *b, int digits)
{
    json_t *list = json_array();
    for (size_t i = 0; i < b->count && list != NULL; ++i)
        if (json_array_append_new(list, vertex_of(&b->vertex[i], digits)) != 0) {
            json_decref(list);
            return NULL;
        }
    return list;
}

static json_t *roots_of(const sa_branch *b)
{
    if (b->counted != CV_OK)
        return json_null();
    return json_pack("{s:i, s:i, s:i}", "vertex", (int)b->counted_at, "left", b->roots_left, "right",
                     b->roots_right);
}

static json_t *branch_of(const sa_branch *b, size_t number, const sa_lines *lines, int digits)
{
    json_t *object = json_object();
    int done = add(object, "branch", json_integer((json_int_t)number + 1)) &&
               add(object, "line", json_integer((json_int_t)b->line + 1)) &&
               add(object, "kind", json_string(sa_line_kind_text(b->kind))) &&
               add(object, "start", end_of(&b->start, lines, digits)) &&
               add(object, "end", end_of(&b->end, lines, digits)) &&
               add(object, "unstable_roots", roots_of(b)) && add(object, "vertices", vertices_of(b, digits));
    if (done)
        return object;
    json_decref(object);
    return NULL;
}

static json_t *branches_of(const sa_lines *lines, int digits)
{
    json_t *list = json_array();
    for (size_t i = 0; i < lines->count && list != NULL; ++i)
        if (json_array_append_new(list, branch_of(&lines->branch[i], i, lines, digits)) != 0) {
            json_decref(list);
            return NULL;
        }
    return list;
}

static json_t *asymptote_of(const sa_lines *lines, size_t i, int digits)
{
    const sa_asymptote *a = &lines->asymptotes.item[i];
    int at_end;
    long branch = sa_lines_branch_of(&at_end, lines, i);
    json_t *object = json_object();
    int done = add(object, "alpha", decimal(a->alpha, a->alpha_error, digits)) &&
               add(object, "has_line", json_boolean(a->has_line)) &&
               add(object, "branch", branch < 0 ? json_null() : json_integer(branch + 1)) &&
               add(object, "branch_end", branch < 0 ? json_null() : json_string(at_end ? "end" : "start")) &&
               add(object, "decided", json_boolean(a->decided == CV_OK));
    if (done)
        return object;
    json_decref(object);
    return NULL;
}

static json_t *asymptotes_of(const sa_lines *lines, int digits)
{
    json_t *list = json_array();
    for (size_t i = 0; i < lines->asymptotes.count && list != NULL; ++i)
        if (json_array_append_new(list, asymptote_of(lines, i, digits)) != 0) {
            json_decref(list);
            return NULL;
        }
    return list;
}

static json_t *resonances_of(const sa_resonance_list *resonances, int digits)
{
    json_t *list = json_array();
    for (size_t i = 0; i < resonances->count && list != NULL; ++i) {
        const sa_resonance *r = &resonances->item[i];
        json_t *object = json_object();
        int done = add(object, "alpha", take_text(sa_decimal_text(r->alpha, digits))) &&
                   add(object, "kind", json_string(sa_resonance_kind_text(r->kind)));
        if (!done || json_array_append(list, object) != 0) {
            json_decref(list);
            list = NULL;
        }
        json_decref(object);
    }
    return list;
}

static json_t *places_of(const sa_lines *lines)
{
    json_t *list = json_array();
    for (size_t i = 0; i < lines->place_count && list != NULL; ++i)
        if (json_array_append_new(
                list, json_pack("{s:f, s:f}", "alpha", lines->place[i][0], "q", lines->place[i][1])) != 0) {
            json_decref(list);
            return NULL;
        }
    return list;
}

static json_t *range_of(const cv_number *low, const cv_number *high)
{
    return json_pack("[o, o]", number_text(low), number_text(high));
}

cv_status sa_lines_write_json(FILE *out, const sa_lines_report *r)
{
    const sa_lines *lines = r->lines;
    json_t *root = json_object(), *damping = json_object();
    int done = add(damping, "eta_p", number_text(&r->params->eta_p)) &&
               add(damping, "eta_b", number_text(&r->params->eta_b)) &&
               add(damping, "eta_f", number_text(&r->params->eta_f));
    done = add(root, "schema", json_string("critvel-semianalytic-lines/1")) &&
           add(root, "case", json_string(r->case_name)) && add(root, "damping", damping) && done &&
           add(root, "alpha_range", range_of(r->range.alpha_min, r->range.alpha_max)) &&
           add(root, "eta_M_range", range_of(r->range.mass_min, r->range.mass_max)) &&
           add(root, "digits", json_integer(r->digits)) &&
           add(root, "decided", json_boolean(lines->decided == CV_OK)) &&
           add(root, "reason", lines->decided == CV_OK ? json_null() : json_string(lines->reason.text)) &&
           add(root, "undecided_places", places_of(lines)) &&
           add(root, "asymptotes", asymptotes_of(lines, r->digits)) &&
           add(root, "resonances", resonances_of(r->resonances, r->digits)) &&
           add(root, "branches", branches_of(lines, r->digits));
    done = done && json_dumpf(root, out, JSON_INDENT(1) | JSON_REAL_PRECISION(15)) == 0 &&
           fputc('\n', out) != EOF;
    json_decref(root);
    return done ? CV_OK : CV_FAILED;
}
