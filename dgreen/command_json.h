/* Pieces of the programs' JSON. For command_*.c only. */
#ifndef CRITVEL_DGREEN_COMMAND_JSON_H
#define CRITVEL_DGREEN_COMMAND_JSON_H

#include <jansson.h>

#include "common/params.h"

/* The decimal of an exact number as a string; NULL when out of memory, which json_pack passes on. */
json_t *dg_json_number(const cv_number *x);

/* {"eta_p": ..., "eta_b": ..., "eta_f": ...} */
json_t *dg_json_damping(const cv_params *p);

#endif
