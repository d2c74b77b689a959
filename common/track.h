/* A physical track in SI units, and its dimensionless form by (3)-(6), (11). */
#ifndef CRITVEL_COMMON_TRACK_H
#define CRITVEL_COMMON_TRACK_H

#include "common/params.h"

/* SI units, each an exact decimal; distributed values, per metre of track (both rails or one, as long as all
 * are of the same kind). */
typedef struct {
    cv_number EI;  /* bending stiffness of the rail, N m^2, > 0 */
    cv_number m;   /* rail mass, kg/m, > 0 */
    cv_number k_p; /* pad stiffness, N/m^2, > 0 */
    cv_number c_p; /* pad damping, N s/m^2, >= 0 */
    cv_number m_s; /* sleeper mass, kg/m, > 0 */
    cv_number k_b; /* ballast stiffness, N/m^2, > 0 */
    cv_number c_b; /* ballast damping, N s/m^2, >= 0 */
    cv_number m_b; /* ballast mass, kg/m, > 0 */
    cv_number k_s; /* ballast shear stiffness, N, >= 0 */
    cv_number k_f; /* foundation stiffness, N/m^2, > 0 */
    cv_number c_f; /* foundation damping, N s/m^2, >= 0 */
    cv_number N;   /* axial force, N, > 0 in compression */
    cv_number M;   /* moving mass, kg, > 0, or 0 where none is given */
    cv_number P;   /* moving force, N, > 0, or 0 where none is given */
} cv_track;

void cv_track_init(cv_track *t);
void cv_track_clear(cv_track *t);

/* (5), (6) of the paper, exactly. The damping ratios are those of the track itself. CV_BAD_INPUT names the
 * quantity that has the wrong sign. */
cv_status cv_track_to_params(cv_params *out, const cv_track *t, cv_message *why);

/* eta_M of (11) = M chi / m, with chi of (3). */
cv_status cv_track_mass_ratio(cv_number *eta_M, const cv_track *t, cv_message *why);

/* v_ref of (4), m/s; chi of (3), 1/m; w_st of (3), m (0 without a force). Rounded at the precision of out. */
void cv_track_reference_velocity(mpfr_t v_ref, const cv_track *t);
void cv_track_chi(mpfr_t chi, const cv_track *t);
void cv_track_static_deflection(mpfr_t w_st, const cv_track *t);

/* The other direction: the physical track with the given EI, m and k_f whose dimensionless form is p and
 * whose mass has the ratio eta_M (NULL: M = 0); P = 0. All exact. */
cv_status cv_track_from_params(cv_track *out, const cv_params *p, const cv_number *eta_M, const cv_number *EI,
                               const cv_number *m, const cv_number *k_f, cv_message *why);

#endif
