#include "dgreen/command_json.h"

#include <stdlib.h>

json_t *dg_json_number(const cv_number *x)
{
    char *text = cv_number_text(x, 17);
    json_t *value = json_string(text);
    free(text);
    return value;
}

json_t *dg_json_damping(const cv_params *p)
{
    return json_pack("{s:o, s:o, s:o}", "eta_p", dg_json_number(&p->eta_p), "eta_b",
                     dg_json_number(&p->eta_b), "eta_f", dg_json_number(&p->eta_f));
}
