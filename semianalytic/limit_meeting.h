/* Vertical parts of the instability lines in the limit of vanishing damping: what lines do at a special
 * velocity of the branch curves (branch_curves.h), where two waves of no group velocity have the same q.
 *
 * Near a branch point at q_b zeta = T + B with B smooth and, for a wave of Doppler sign S = sign(q - alpha p)
 * that exists where sigma (q - q_b) > 0 and decays at the rate e,
 *
 *     T = -i S A / sqrt(X - i sigma e),   X = sigma (q - q_b),   A > 0,
 *     Im T = -S F(X),   F(X) = A Re 1/sqrt(X - i e) > 0, with one maximum ~ A / sqrt(e).
 *
 * On the side without waves (X < 0) Re T = sigma S A / sqrt(-X): where Im B has the sign S there a line runs
 * along the curve, at X ~ -e^(2/3), with Re zeta = sigma S infinity: at eta_M = 0 when sigma S > 0.
 *
 * Where two curves meet, X_1 and X_2 are independent coordinates and Im zeta = -S_1 F_1(X_1) - S_2 F_2(X_2) +
 * Im B. For S_1 = -S_2 the lines F_1 = F_2 are two: with i the stronger wave (larger A^2 / e) and o the
 * other,
 *
 *     X_i, X_o > 0, A_i^2 X_o = A_o^2 X_i, where T cancels and Re zeta = Re B,  to  curve o at X_i > 0;
 *     curve i at X_o > 0  to  the sector X_i, X_o < 0,
 *
 * and in that sector, farther than e^(2/3) away, the line comes to the curve with S = sign Im B. For equal S
 * there is only a line in that sector, from one curve to the other, when Im B has the sign S. Along each of
 * these Re zeta goes from one of Re B, +- infinity to another while (alpha, q) hardly moves: it is vertical.
 *
 * A resonance velocity is the meeting of a curve with its own reflection q -> -q. For sigma S > 0 (a minimum
 * of the phase velocity, a true one) a line comes from infinite mass to the curve above it; and, where Im B >
 * 0, another one from the curve below goes to infinite mass. For sigma S < 0 Re zeta is negative. Near a cusp
 * Im zeta has one sign, and no line. The two vertical parts that may be at one velocity lie on either side of
 * it: Re T = 0 where |X_1| : |X_2| = A_1^2 : A_2^2, once with X_1, X_2 > 0 and once with X_1, X_2 < 0.
 *
 * At the shear speed a curve comes to q = 0 with A -> 0.
 *
 * Which wave is stronger depends on eta_p : eta_b : eta_f, here 1 : 1 : 1; nothing else does. */
#ifndef CRITVEL_SEMIANALYTIC_LIMIT_MEETING_H
#define CRITVEL_SEMIANALYTIC_LIMIT_MEETING_H

#include "semianalytic/map.h"
#include "semianalytic/zeta.h"

typedef enum {
    SA_TERMINAL_INFINITE, /* infinite mass: Re zeta goes on to 0 and below */
    SA_TERMINAL_LINE,     /* a line Im zeta = 0 that ends here with Re zeta = Re B */
    SA_TERMINAL_CURVE     /* at eta_M = 0 along a branch curve */
} sa_terminal_kind;

typedef struct {
    sa_terminal_kind kind;
    int arc, side; /* of the curve; side -1: below the special velocity, 1: above */
    double re;     /* Re zeta there: 0, Re B, INFINITY */
} sa_terminal;

/* From one terminal to the other at constant alpha and q; no way where both have Re zeta = INFINITY. */
typedef struct {
    sa_terminal end[2];
    int side; /* on which side of the special velocity this is for small damping; 0: not known */
} sa_bridge;

enum { SA_BRIDGES_MAX = 2 };

typedef struct {
    double alpha, q;
    int arc[2]; /* curves that meet; -1: none */
    size_t count;
    sa_bridge bridge[SA_BRIDGES_MAX];
} sa_meeting;

/* What happens at map->curves.special[number] as the dampings of the undamped track tend to zero.
 * CV_UNDECIDED: two things on which it depends are equal in double precision; CV_FAILED: a library failed. */
cv_status sa_meeting_find(sa_meeting *out, const sa_map *map, const sa_track *track, size_t number);

#endif
