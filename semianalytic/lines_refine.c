#include <math.h>

#include "semianalytic/lines_parts.h"
#include "semianalytic/transitions_parts.h"

sa_line_given sa_line_best_given(const sa_line_sample *sample)
{
    return fabs(sample->im_q) * sample->q >= fabs(sample->im_alpha) * sample->alpha ? SA_GIVEN_ALPHA
                                                                                    : SA_GIVEN_Q;
}

/* The point found is the one that the sample stands for: near ... */
static int is_near(const sa_line_vertex *v, const sa_line_sample *s)
{
    const double near = 1e-4, near_mass = 0.02;
    double alpha = mpfr_get_d(v->alpha, MPFR_RNDN), q = mpfr_get_d(v->q, MPFR_RNDN);
    return fabs(alpha - s->alpha) < near * s->alpha && fabs(q - s->q) < near * s->q &&
           fabs(mpfr_get_d(v->eta_M, MPFR_RNDN) * s->re - 1) < near_mass;
}

/* ... and on the same line. */
static int same_point(const sa_line_vertex *v, const sa_line_sample *s, sa_line_given which, int rises)
{
    double slope = which == SA_GIVEN_ALPHA ? s->im_q : s->im_alpha;
    return is_near(v, s) && (rises > 0) == (slope > 0);
}

/* At an end of the range of alpha, which need not be a double. */
static cv_status at_velocity(sa_line_vertex *out, const sa_line_store *store, const sa_line_sample *s,
                             const cv_number *velocity, int digits)
{
    int rises;
    mpfr_t alpha;
    mpfr_init2(alpha, 4 * digits + 128);
    cv_number_get_mpfr(alpha, velocity);
    cv_status status =
        sa_line_point(out, &rises, store->sweep, store->track, SA_GIVEN_ALPHA, alpha, s->q, digits);
    if (status == CV_OK && !same_point(out, s, SA_GIVEN_ALPHA, rises))
        out->decided = CV_UNDECIDED;
    out->marks = SA_MARK_CUT;
    mpfr_clear(alpha);
    return status;
}

/* At an end of the range of eta_M: a transition. */
static cv_status at_mass(sa_line_vertex *out, const sa_line_store *store, const sa_line_sample *s,
                         const cv_number *mass, int digits)
{
    const sa_candidate from = {0, s->alpha, s->q, {{s->re_alpha, s->re_q}, {s->im_alpha, s->im_q}}};
    sa_transition item;
    cv_status status = sa_transition_refine(&item, store->sweep, store->track, &from, mass, digits);
    *out = (sa_line_vertex){.alpha_error = item.alpha_error,
                            .q_error = item.q_error,
                            .decided = item.decided,
                            .marks = SA_MARK_CUT};
    mpfr_init2(out->alpha, mpfr_get_prec(item.alpha));
    mpfr_init2(out->q, mpfr_get_prec(item.q));
    mpfr_init2(out->eta_M, 4 * digits + 128);
    mpfr_set(out->alpha, item.alpha, MPFR_RNDN);
    mpfr_set(out->q, item.q, MPFR_RNDN);
    cv_number_get_mpfr(out->eta_M, mass);
    mpfr_clears(item.alpha, item.q, (mpfr_ptr)0);
    return status;
}

static cv_status on_line(sa_line_vertex *out, const sa_line_store *store, const sa_line_sample *s, int digits)
{
    int rises;
    mpfr_t given;
    sa_line_given which = sa_line_best_given(s);
    mpfr_init2(given, 53);
    mpfr_set_d(given, which == SA_GIVEN_ALPHA ? s->alpha : s->q, MPFR_RNDN);
    cv_status status = sa_line_point(out, &rises, store->sweep, store->track, which, given,
                                     which == SA_GIVEN_ALPHA ? s->q : s->alpha, digits);
    if (status == CV_OK && !same_point(out, s, which, rises))
        out->decided = CV_UNDECIDED;
    mpfr_clear(given);
    return status;
}

int sa_line_in_limit(const sa_line_sample *sample)
{
    return (sample->marks & (SA_MARK_VERTICAL | SA_MARK_CURVE)) != 0;
}

static void set_bound(sa_line_vertex *v, int digits)
{
    const double most = pow(10, -digits);
    int held = v->alpha_error < most * mpfr_get_d(v->alpha, MPFR_RNDN) &&
               v->q_error <= most * mpfr_get_d(v->q, MPFR_RNDN) &&
               v->eta_M_error <= most * mpfr_get_d(v->eta_M, MPFR_RNDN);
    v->decided = held ? CV_OK : CV_UNDECIDED;
}

/* A resonance velocity to the digits. */
static void set_resonance(sa_line_vertex *v, const sa_resonance_list *list)
{
    const double same = 1e-13;
    for (size_t i = 0; i < list->count; ++i) {
        const sa_resonance *r = &list->item[i];
        double alpha = mpfr_get_d(r->alpha, MPFR_RNDN);
        if (!(fabs(alpha - mpfr_get_d(v->alpha, MPFR_RNDN)) < same * alpha))
            continue;
        mpfr_set_prec(v->alpha, mpfr_get_prec(r->alpha));
        mpfr_set(v->alpha, r->alpha, MPFR_RNDN);
        v->alpha_error = ldexp(alpha, -(int)r->bits);
        v->q_error = 0;
    }
}

/* On a vertical part, or on a branch curve. */
static void in_limit(sa_line_vertex *out, const sa_line_store *store, const sa_line_sample *s,
                     sa_end_kind end, int digits)
{
    const double rounding = 4e-15, gap = s->marks & SA_MARK_CUT ? 1e-5 : 1e-11, smooth = 1e-4;
    int vertical = (s->marks & SA_MARK_VERTICAL) != 0;
    *out = (sa_line_vertex){.marks = s->marks, .alpha_error = (vertical ? rounding : gap) * s->alpha};
    out->q_error = (vertical ? rounding : gap) * (1 + s->q);
    mpfr_init_set_d(out->alpha, s->alpha, MPFR_RNDN);
    mpfr_init_set_d(out->q, s->q, MPFR_RNDN);
    mpfr_init2(out->eta_M, 4 * digits + 128);
    if (end == SA_END_MASS_LOW || end == SA_END_MASS_HIGH) {
        cv_number_get_mpfr(out->eta_M, end == SA_END_MASS_LOW ? &store->mass_min : &store->mass_max);
    } else {
        mpfr_set_d(out->eta_M, 1 / s->re, MPFR_RNDN);
        out->eta_M_error = smooth / s->re;
    }
    if (vertical && s->q == 0)
        set_resonance(out, &store->resonances);
    set_bound(out, digits);
}

cv_status sa_line_refine(sa_line_vertex *out, const sa_line_store *store, const sa_line_sample *sample,
                         sa_end_kind end, int digits)
{
    if (sa_line_in_limit(sample)) {
        in_limit(out, store, sample, end, digits);
        return CV_OK;
    }
    switch (end) {
    case SA_END_ALPHA_LOW:
        return at_velocity(out, store, sample, &store->alpha_min, digits);
    case SA_END_ALPHA_HIGH:
        return at_velocity(out, store, sample, &store->alpha_max, digits);
    case SA_END_MASS_LOW:
        return at_mass(out, store, sample, &store->mass_min, digits);
    case SA_END_MASS_HIGH:
        return at_mass(out, store, sample, &store->mass_max, digits);
    default:
        break;
    }
    if (sample->marks == 0)
        return on_line(out, store, sample, digits);
    cv_status status = sa_line_extreme(out, NULL, store, sample, digits);
    if (status == CV_OK && !is_near(out, sample))
        out->decided = CV_UNDECIDED;
    return status;
}
