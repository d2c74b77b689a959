#include "dgreen/branch_points_curves.h"

#include <math.h>
#include <stdlib.h>

/* Wave numbers: the first positive one is small beside every wave of a track that reaches alpha_min; the last
 * is where the tables end when a branch creeps towards the shear wave speed for ever. */
static const double P_FIRST = 1e-4, P_LIMIT = 2048;
enum { PER_DECADE = 24, MAX_REFINEMENTS = 16 };
/* Interpolation error of the group velocity that is allowed in a table, relative to its size */
static const double TABLE_TOLERANCE = 1e-3;
static const double PEAK_CURVATURE = 1;

static dg_wave_sample sample_at(const dg_track *t, int branch, double p)
{
    dg_wave w;
    dg_wave_at(&w, t, p, branch);
    return (dg_wave_sample){p, w.group, w.curvature};
}

static cv_status push(dg_wave_table *table, dg_wave_sample s, cv_message *why)
{
    if (table->count == table->room) {
        const size_t room = table->room ? 2 * table->room : 256;
        dg_wave_sample *grown = realloc(table->at, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        table->at = grown;
        table->room = room;
    }
    table->at[table->count++] = s;
    return CV_OK;
}

/* Pushes what lies between the last sample of the table and s, and s. */
static cv_status push_refined(dg_wave_table *table, const dg_track *t, int branch, dg_wave_sample s,
                              int depth, cv_message *why)
{
    const dg_wave_sample a = table->at[table->count - 1];
    const double h = s.p - a.p;
    const dg_wave_sample m = sample_at(t, branch, a.p + h / 2);
    const double expected = (a.group + s.group) / 2 + h * (a.curvature - s.curvature) / 8;
    const double allowed = TABLE_TOLERANCE * (fabs(a.group) + fabs(s.group));
    if (depth == 0 || fabs(m.group - expected) <= allowed)
        return push(table, s, why);
    const cv_status status = push_refined(table, t, branch, m, depth - 1, why);
    return status == CV_OK ? push_refined(table, t, branch, s, depth - 1, why) : status;
}

/* The zero of the curvature between two samples, by bisection. */
static dg_wave_sample inflection(const dg_track *t, int branch, const dg_wave_sample *a,
                                 const dg_wave_sample *b)
{
    double low = a->p, high = b->p;
    dg_wave_sample m = *a;
    for (int i = 0; i < 100 && high - low > 1e-15 * high; i++) {
        m = sample_at(t, branch, (low + high) / 2);
        if ((m.curvature > 0) == (a->curvature > 0))
            low = m.p;
        else
            high = m.p;
    }
    m.curvature = 0;
    return m;
}

/* Beyond p no branch has a group velocity in the range any more. */
static double last_wave_number(const dg_track *t, double alpha_min, double alpha_max)
{
    const double shear = sqrt(t->eta_s / t->mu_b);
    double p = 8;
    for (; p < P_LIMIT; p *= 2) {
        int open = sample_at(t, DG_WAVE_BRANCHES - 1, p).group < 2 * alpha_max;
        for (int k = 0; k < DG_WAVE_BRANCHES - 1; k++) {
            const double group = fabs(sample_at(t, k, p).group);
            open |= group > alpha_min / 2 && !(fabs(group - shear) < 1e-6 * shear);
        }
        if (!open)
            break;
    }
    return p;
}

static cv_status fill_table(dg_branch_curves *b, int branch, double p_last, cv_message *why)
{
    dg_wave_table raw = {0}, *table = &b->tables[branch];
    const dg_track *t = b->track;
    cv_status status = push(&raw, sample_at(t, branch, 0), why);
    const int steps = (int)ceil(PER_DECADE * log10(p_last / P_FIRST));
    for (int i = 0; i <= steps && status == CV_OK; i++) {
        const double p = P_FIRST * pow(10, (double)i / PER_DECADE);
        status = push_refined(&raw, t, branch, sample_at(t, branch, p), MAX_REFINEMENTS, why);
    }
    for (size_t i = 0; i < raw.count && status == CV_OK; i++) {
        if (i > 0 && raw.at[i].curvature * raw.at[i - 1].curvature < 0)
            status = push(table, inflection(t, branch, &raw.at[i - 1], &raw.at[i]), why);
        if (status == CV_OK)
            status = push(table, raw.at[i], why);
    }
    free(raw.at);
    return status;
}

static cv_status add_families(dg_branch_curves *b, int branch, size_t first, size_t last, cv_message *why)
{
    const dg_wave_table *table = &b->tables[branch];
    const double one = table->at[first].group, other = table->at[last].group;
    for (int sign = 1; sign >= -1; sign -= 2) {
        const double low = fmax(fmin(sign * one, sign * other), 0), high = fmax(sign * one, sign * other);
        if (!(high > low))
            continue;
        if (b->family_count == DG_MAX_FAMILIES)
            return cv_fail(why, CV_FAILED, "dispersion branches with more than %d stretches",
                           DG_MAX_FAMILIES);
        b->families[b->family_count++] = (dg_family){branch, sign, first, last, low, high};
    }
    return CV_OK;
}

/* The group velocities on both sides of a peak of the curvature, where that has fallen to a small part, and
 * as far again beyond. */
static void set_groups(dg_bend *bend, const dg_wave_table *table, size_t peak)
{
    static const double SMALL = 0.03;
    const double small = SMALL * fabs(table->at[peak].curvature);
    size_t first = peak, last = peak;
    while (first > 0 && fabs(table->at[first].curvature) > small)
        first--;
    while (last + 1 < table->count && fabs(table->at[last].curvature) > small)
        last++;
    const double one = table->at[first].group, other = table->at[last].group, room = fabs(other - one) / 4;
    bend->group_low = fmin(one, other) - room;
    bend->group_high = fmax(one, other) + room;
}

static void add_bend(dg_branch_curves *b, int branch, size_t i, int cusp)
{
    const dg_wave_sample *at = &b->tables[branch].at[i];
    dg_wave w;
    if (b->bend_count == DG_MAX_BENDS)
        return; /* bends only guide the sampling */
    dg_wave_at(&w, b->track, at->p, branch);
    const double third = (at[1].curvature - at[-1].curvature) / (at[1].p - at[-1].p);
    dg_bend *bend = &b->bends[b->bend_count++];
    *bend = (dg_bend){branch, cusp, at->p, w.omega, w.group, cusp ? third : at->curvature, 0, 0};
    if (!cusp)
        set_groups(bend, &b->tables[branch], i);
}

static cv_status cut_table(dg_branch_curves *b, int branch, cv_message *why)
{
    const dg_wave_table *table = &b->tables[branch];
    size_t first = 0;
    cv_status status = CV_OK;
    for (size_t i = 1; i + 1 < table->count && status == CV_OK; i++) {
        const double before = fabs(table->at[i - 1].curvature), here = fabs(table->at[i].curvature);
        if (here == 0) {
            status = add_families(b, branch, first, i, why);
            add_bend(b, branch, i, 1);
            first = i;
        } else if (here > before && here > fabs(table->at[i + 1].curvature) && here > PEAK_CURVATURE) {
            add_bend(b, branch, i, 0);
        }
    }
    return status == CV_OK ? add_families(b, branch, first, table->count - 1, why) : status;
}

cv_status dg_branch_curves_fill(dg_branch_curves *b, double alpha_min, double alpha_max, cv_message *why)
{
    const double p_last = last_wave_number(b->track, alpha_min, alpha_max);
    for (int k = 0; k < DG_WAVE_BRANCHES; k++) {
        cv_status status = fill_table(b, k, p_last, why);
        if (status == CV_OK)
            status = cut_table(b, k, why);
        if (status != CV_OK)
            return status;
    }
    return CV_OK;
}

/* The samples between which group passes target, by bisection in the table. */
static size_t table_cell(const dg_wave_table *table, const dg_family *f, double target, int rising)
{
    size_t low = f->first, high = f->last;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if ((table->at[middle].group < target) == rising)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Newton's method ends at steps below CLOSE, or where those below ROUNDING (relative) no longer become
 * shorter: q_b, which is stationary in p, is then as good as it gets. */
static const double CLOSE = 4e-16, ROUNDING = 1e-9;

/* Where the group velocity between two samples is expected to be the target: linear interpolation, inside */
static double first_guess(const dg_wave_sample *at, double target)
{
    const double part = (target - at[0].group) / (at[1].group - at[0].group);
    return at[0].p + (part > 0.02 && part < 0.98 ? part : 0.5) * (at[1].p - at[0].p);
}

/* Near q_b, Delta = (d Delta/dq) (q - q_b + omega'' (p - p_b)^2/2), so that the residue there is 4 q^2 R over
 * (d Delta/dq) sqrt(2 omega'' (q - q_b)), and |q - q_b| is at least the width. */
static double peak_of(const dg_track *t, double p, double q, const dg_wave *w, double width)
{
    return 4 * q * q * dg_wave_strength(t, p, w) / sqrt(2 * fabs(w->curvature) * width);
}

void dg_family_point(dg_branch_point *out, const dg_branch_curves *b, size_t family, double alpha)
{
    const dg_family *f = &b->families[family];
    const dg_wave_table *table = &b->tables[f->branch];
    const double target = f->sign * alpha;
    const int rising = table->at[f->last].group > table->at[f->first].group;
    const size_t cell = table_cell(table, f, target, rising);
    const dg_wave_sample *at = &table->at[cell];
    double low = at[0].p, high = at[1].p, step = INFINITY;
    double p = first_guess(at, target);
    dg_wave w = {.omega = 0};
    for (int i = 0; i < 200; i++) {
        dg_wave_near(&w, b->track, p, f->branch, w.omega);
        *((w.group < target) == rising ? &low : &high) = p;
        const double newton = (target - w.group) / w.curvature;
        const int shorter = fabs(newton) < fabs(step) / 2;
        if (fabs(newton) <= CLOSE * p || (!shorter && fabs(newton) <= ROUNDING * p))
            break;
        const double next = p + newton;
        step = newton;
        if (shorter && next > low && next < high) {
            p = next;
            w.omega += w.group * newton;
        } else {
            p = (low + high) / 2;
        }
    }
    const double q = alpha * f->sign * p - w.omega;
    const double width = fmax(dg_wave_shift(b->track, p, &w), 1e-18);
    *out = (dg_branch_point){fabs(q),
                             q,
                             f->sign * p,
                             width,
                             peak_of(b->track, p, q, &w, width),
                             (int)family,
                             0,
                             w.curvature > 0 ? 1 : -1,
                             0};
}
