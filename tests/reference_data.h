/* Reading data/reference_*.json: values from rigorous arithmetic (tests/reference/), with their checksum. */
#ifndef CRITVEL_TESTS_REFERENCE_DATA_H
#define CRITVEL_TESTS_REFERENCE_DATA_H

#include <inttypes.h>
#include <jansson.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/params.h"

/* 64-bit FNV-1a of the records' compact dump with sorted keys, as the generator writes it */
static inline void reference_checksum(char out[17], const json_t *records)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    char *text = json_dumps(records, JSON_COMPACT | JSON_SORT_KEYS);
    for (const char *c = text; c != NULL && *c != '\0'; c++)
        hash = (hash ^ (unsigned char)*c) * UINT64_C(0x100000001b3);
    free(text);
    snprintf(out, 17, "%016" PRIx64, hash);
}

/* The file, or NULL when it cannot be read, is of another schema, or its records are not those its checksum
 * and count were made of. The caller owns it. */
static inline json_t *reference_load(const char *path, const char *schema, const char *records)
{
    char sum[17];
    json_t *file = json_load_file(path, 0, NULL), *list = json_object_get(file, records);
    const char *found = json_string_value(json_object_get(file, "schema"));
    const char *stated = json_string_value(json_object_get(file, "checksum_fnv1a64"));
    reference_checksum(sum, list);
    if (found != NULL && stated != NULL && strcmp(found, schema) == 0 && strcmp(stated, sum) == 0 &&
        (size_t)json_integer_value(json_object_get(file, "count")) == json_array_size(list))
        return file;
    json_decref(file);
    return NULL;
}

static inline const char *reference_text(const json_t *record, const char *key)
{
    const char *text = json_string_value(json_object_get(record, key));
    if (text == NULL)
        abort();
    return text;
}

static inline void reference_number(cv_number *to, const json_t *record, const char *key)
{
    if (cv_number_parse(to, reference_text(record, key), NULL) != CV_OK)
        abort();
}

static inline void reference_params(cv_params *p, const json_t *record)
{
    const json_t *from = json_object_get(record, "parameters");
    reference_number(&p->mu_s, from, "mu_s");
    reference_number(&p->mu_b, from, "mu_b");
    reference_number(&p->kappa_p, from, "kappa_p");
    reference_number(&p->kappa_b, from, "kappa_b");
    reference_number(&p->eta_s, from, "eta_s");
    reference_number(&p->eta_N, from, "eta_N");
    reference_number(&p->eta_p, from, "eta_p");
    reference_number(&p->eta_b, from, "eta_b");
    reference_number(&p->eta_f, from, "eta_f");
}

#endif
