/* What every reference data file shares: generator, versions, a checksum against corruption. */
#ifndef CRITVEL_REFERENCE_DATAFILE_H
#define CRITVEL_REFERENCE_DATAFILE_H

#include <jansson.h>

#include "arbtrack.h"

/* {"schema", "generator", "libraries", "conventions"}: the head of a file; the caller owns it. */
json_t *ref_file_head(const char *schema, const char *generator, const char *conventions);

/* {"mu_s": "6", ...} from the decimals as typed, in the order of the enum in arbtrack.h */
json_t *ref_file_params(const char *const text[REF_PARAMS]);

/* x with "digits" significant digits, right but for one unit in the last; "0" for an exact zero. */
json_t *ref_file_real(const arb_t x, slong digits);

/* Appends records under "name" with "count" and the 64-bit FNV-1a checksum of their compact dump with sorted
 * keys, and writes the file. Takes both references. Returns 0 or -1. */
int ref_file_write(json_t *head, const char *name, json_t *records, const char *path);

#endif
