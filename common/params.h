/* The dimensionless track of (5)-(6): what both solver trees see, and all they share. */
#ifndef CRITVEL_COMMON_PARAMS_H
#define CRITVEL_COMMON_PARAMS_H

#include "common/number.h"

/* All dimensionless; (5) and (6) of the paper. Each is exact. */
typedef struct {
    cv_number mu_s;    /* sleeper mass / rail mass, > 0 */
    cv_number mu_b;    /* ballast mass / rail mass, > 0 */
    cv_number kappa_p; /* pad stiffness / foundation stiffness, > 0 */
    cv_number kappa_b; /* ballast stiffness / foundation stiffness, > 0 */
    cv_number eta_p;   /* pad damping ratio, >= 0 */
    cv_number eta_b;   /* ballast damping ratio, >= 0 */
    cv_number eta_f;   /* foundation damping ratio, >= 0 */
    cv_number eta_s;   /* ballast shear stiffness ratio, >= 0 */
    cv_number eta_N;   /* axial force ratio, > 0 in compression; below buckling of the resting track */
} cv_params;

void cv_params_init(cv_params *p); /* all 0 */
void cv_params_clear(cv_params *p);
void cv_params_set(cv_params *to, const cv_params *from);

/* 1 when eta_p = eta_b = eta_f = 0 */
int cv_params_undamped(const cv_params *p);

/* CV_OK, or CV_BAD_INPUT with what is wrong: signs as above, and a resting track that buckles
 * (p^4/4 - eta_N p^2 + static support stiffness not positive for all real p). */
cv_status cv_params_check(const cv_params *p, cv_message *why);

/* Admissible ranges (31): writes a one-line warning that names the first values outside and returns 1, or
 * returns 0. Never an error: academic values are allowed. */
int cv_params_warn(const cv_params *p, cv_message *warning);

#endif
