#include "common/params.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* A member with its name, the sign it must have and its admissible range (31). */
typedef struct {
    const char *name;
    size_t offset;
    int least_sign;           /* 1: > 0, 0: >= 0, -1: any */
    const char *least, *most; /* NULL: (31) gives no range */
} rule;

#define RULE(member, sign, least, most)                                                                      \
    {                                                                                                        \
#member, offsetof(cv_params, member), sign, least, most                                              \
    }

static const rule rules[] = {
    RULE(mu_s, 1, "1", "6"),          RULE(mu_b, 1, "2.5", "50"), RULE(kappa_p, 1, "0.03", "50000"),
    RULE(kappa_b, 1, "0.1", "10000"), RULE(eta_p, 0, NULL, NULL), RULE(eta_b, 0, NULL, NULL),
    RULE(eta_f, 0, NULL, NULL),       RULE(eta_s, 0, "0", "100"), RULE(eta_N, -1, NULL, NULL),
};

enum { RULES = sizeof rules / sizeof rules[0] };

/* Relative error bound of critical_force below; far above the few rounding errors of a sum of two terms. */
static const double BUCKLING_MARGIN = 1e-12;

static cv_number *member(cv_params *p, const rule *r)
{
    return (cv_number *)(void *)((char *)p + r->offset);
}

static const cv_number *const_member(const cv_params *p, const rule *r)
{
    return (const cv_number *)(const void *)((const char *)p + r->offset);
}

void cv_params_init(cv_params *p)
{
    for (size_t i = 0; i < RULES; ++i)
        cv_number_init(member(p, &rules[i]));
}

void cv_params_clear(cv_params *p)
{
    for (size_t i = 0; i < RULES; ++i)
        cv_number_clear(member(p, &rules[i]));
}

void cv_params_set(cv_params *to, const cv_params *from)
{
    for (size_t i = 0; i < RULES; ++i)
        cv_number_set(member(to, &rules[i]), const_member(from, &rules[i]));
}

int cv_params_undamped(const cv_params *p)
{
    return cv_number_sign(&p->eta_p) == 0 && cv_number_sign(&p->eta_b) == 0 && cv_number_sign(&p->eta_f) == 0;
}

static cv_status check_member(const cv_number *x, const rule *r, cv_message *why)
{
    if (cv_number_sign(x) < r->least_sign)
        return cv_fail(why, CV_BAD_INPUT, "%s must be %s 0", r->name, r->least_sign > 0 ? ">" : ">=");
    if (!cv_number_fits_double(x))
        return cv_fail(why, CV_BAD_INPUT, "%s is outside 1e-300 .. 1e300", r->name);
    return CV_OK;
}

/* Static stiffness of the three layers in series, k(Y) = 1 / (1/kappa_p + 1/kappa_b + 1/(1 + eta_s Y)), Y =
 * p^2 */
typedef struct {
    double flexibility; /* 1/kappa_p + 1/kappa_b */
    double eta_s;
} support;

/* Y/4 + k(Y)/Y: the axial force at which the wave number sqrt(Y) buckles */
static double force_at(const support *s, double Y)
{
    const double k = 1 / (s->flexibility + 1 / (1 + s->eta_s * Y));
    return Y / 4 + k / Y;
}

/* The least of force_at over Y > 0 by golden sections in log Y. force_at is convex (k(Y)/Y is a sum of convex
 * terms a/Y + b/(c + d Y)), and its minimum satisfies Y^2 = 4 (k - Y k') with k - Y k' between k(0) and
 * 1/flexibility, which gives the bracket. An error of the position enters the value squared, so 100 sections
 * (a factor 1e-20 of a bracket below 700) leave only the rounding of force_at. */
static double critical_force(const support *s)
{
    const double golden = 0.61803398874989485;
    double a = log(2) + 0.5 * log(1 / (s->flexibility + 1));
    double b = log(2) + 0.5 * log(1 / s->flexibility);
    double x = b - golden * (b - a), y = a + golden * (b - a);
    double fx = force_at(s, exp(x)), fy = force_at(s, exp(y));
    for (int i = 0; i < 100; ++i) {
        if (fx < fy) {
            b = y, y = x, fy = fx;
            x = b - golden * (b - a), fx = force_at(s, exp(x));
        } else {
            a = x, x = y, fx = fy;
            y = a + golden * (b - a), fy = force_at(s, exp(y));
        }
    }
    return fmin(fx, fy);
}

/* sqrt(1 / (1/kappa_p + 1/kappa_b + 1)): the critical force without shear stiffness */
static void critical_force_exact(cv_number *out, const cv_params *p)
{
    mpq_t flexibility, t;
    mpq_inits(flexibility, t, NULL);
    mpq_set_ui(flexibility, 1, 1);
    mpq_inv(t, p->kappa_p.factor);
    mpq_add(flexibility, flexibility, t);
    mpq_inv(t, p->kappa_b.factor);
    mpq_add(flexibility, flexibility, t);
    mpq_mul(flexibility, flexibility, flexibility);
    mpq_set_ui(t, 1, 1);
    cv_number_set_root(out, t, flexibility);
    mpq_clears(flexibility, t, NULL);
}

static cv_status buckled(double critical, cv_message *why)
{
    return cv_fail(why, CV_BAD_INPUT,
                   "eta_N is at or beyond buckling of the resting track (critical eta_N = %.10g)", critical);
}

static cv_status check_buckling(const cv_params *p, cv_message *why)
{
    if (cv_number_sign(&p->eta_N) <= 0)
        return CV_OK;
    if (cv_number_sign(&p->eta_s) == 0 && cv_number_is_rational(&p->kappa_p) &&
        cv_number_is_rational(&p->kappa_b)) {
        cv_number critical;
        cv_number_init(&critical);
        critical_force_exact(&critical, p);
        const int below = cv_number_compare(&p->eta_N, &critical) < 0;
        const double value = cv_number_get_double(&critical);
        cv_number_clear(&critical);
        return below ? CV_OK : buckled(value, why);
    }
    const support s = {1 / cv_number_get_double(&p->kappa_p) + 1 / cv_number_get_double(&p->kappa_b),
                       cv_number_get_double(&p->eta_s)};
    const double critical = critical_force(&s);
    const int below = cv_number_get_double(&p->eta_N) < critical * (1 - BUCKLING_MARGIN);
    return below ? CV_OK : buckled(critical, why);
}

cv_status cv_params_check(const cv_params *p, cv_message *why)
{
    for (size_t i = 0; i < RULES; ++i) {
        const cv_status status = check_member(const_member(p, &rules[i]), &rules[i], why);
        if (status != CV_OK)
            return status;
    }
    return check_buckling(p, why);
}

/* -1, 0, 1: x below, inside, above the range of the rule */
static int outside(const cv_number *x, const rule *r)
{
    if (r->least == NULL)
        return 0;
    cv_number bound;
    cv_number_init(&bound);
    int side = 0;
    if (cv_number_parse(&bound, r->least, NULL) == CV_OK && cv_number_compare(x, &bound) < 0)
        side = -1;
    if (cv_number_parse(&bound, r->most, NULL) == CV_OK && cv_number_compare(x, &bound) > 0)
        side = 1;
    cv_number_clear(&bound);
    return side;
}

int cv_params_warn(const cv_params *p, cv_message *warning)
{
    enum { NAMED = 3 };
    int count = 0, length = 0;
    char list[CV_MESSAGE_SIZE] = "";
    for (size_t i = 0; i < RULES; ++i) {
        const rule *r = &rules[i];
        if (outside(const_member(p, r), r) == 0 || ++count > NAMED)
            continue;
        length += snprintf(list + length, sizeof list - (size_t)length, "%s%s = %.6g (%s .. %s)",
                           count > 1 ? ", " : "", r->name, cv_number_get_double(const_member(p, r)), r->least,
                           r->most);
    }
    if (count == 0)
        return 0;
    cv_fail(warning, CV_OK, "outside the admissible ranges (31): %s%s", list, count > NAMED ? ", ..." : "");
    return 1;
}
