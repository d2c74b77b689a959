#include "datafile.h"

#include <flint/flint.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

json_t *ref_file_head(const char *schema, const char *generator, const char *conventions)
{
    return json_pack("{s:s, s:s, s:{s:s, s:s, s:s}, s:s}", "schema", schema, "generator", generator,
                     "libraries", "arb", arb_version, "flint", FLINT_VERSION, "mpfr", mpfr_get_version(),
                     "conventions", conventions);
}

json_t *ref_file_params(const char *const text[REF_PARAMS])
{
    json_t *out = json_object();
    for (int i = 0; i < REF_PARAMS; i++)
        json_object_set_new(out, ref_param_names[i], json_string(text[i]));
    return out;
}

json_t *ref_file_real(const arb_t x, slong digits)
{
    if (arb_is_zero(x))
        return json_string("0");
    char *text = arb_get_str(x, digits, ARB_STR_NO_RADIUS);
    json_t *out = json_string(text);
    flint_free(text);
    return out;
}

static int checksum(char out[17], const json_t *records)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    char *text = json_dumps(records, JSON_COMPACT | JSON_SORT_KEYS);
    if (text == NULL)
        return -1;
    for (const char *c = text; *c != '\0'; c++)
        hash = (hash ^ (unsigned char)*c) * UINT64_C(0x100000001b3);
    free(text);
    snprintf(out, 17, "%016llx", (unsigned long long)hash);
    return 0;
}

int ref_file_write(json_t *head, const char *name, json_t *records, const char *path)
{
    char sum[17];
    int status = checksum(sum, records);
    if (status == 0)
        status = json_object_set_new(head, "count", json_integer((json_int_t)json_array_size(records))) |
                 json_object_set_new(head, "checksum_fnv1a64", json_string(sum)) |
                 json_object_set(head, name, records) | json_dump_file(head, path, JSON_INDENT(1));
    json_decref(records);
    json_decref(head);
    return status == 0 ? 0 : -1;
}
