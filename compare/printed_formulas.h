/* The formulas of the paper that are wrong as printed, each evaluated as printed and as derived. */
#ifndef CRITVEL_COMPARE_PRINTED_FORMULAS_H
#define CRITVEL_COMPARE_PRINTED_FORMULAS_H

#include "compare/method.h"
#include "compare/printed_file.h"

typedef struct {
    double as_printed, derived;
} cmp_formula_values;

/* key: that of a section [formula key] of data/printed.ini.
 *   static      w(0)/w_st of a resting force on a track so stiff that only the foundation gives, K(0,0)/pi by
 * (13) without mass; as printed four times that. The answer of a Winkler foundation is 1, by (3). eigenvalue
 * z = eta_M zeta at an eigenvalue of a discretised moving-frame beam with the mass on it; a root, z = 1, if
 * the equation is right. (13) as printed has its root at eta_M zeta = 1/4: it gives 4 eta_M zeta. L11 the
 * symbol of (17) under D_xi -> i p; derived: 4 (D1 + D2) of (8). CV_FAILED for another key. */
cv_status cmp_formula(cmp_formula_values *out, const char *key, const cmp_method *method,
                      const cv_number *alpha_min, const cv_number *alpha_max, const cmp_printed_file *file,
                      cv_message *why);

#endif
