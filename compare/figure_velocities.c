#include "compare/figure_velocities.h"

#include <math.h>

cv_status cmp_velocities_find(cmp_velocities *out, const cmp_figure *f, cv_message *why)
{
    out->low = cv_number_get_double(&f->file->alpha_min);
    out->high = cv_number_get_double(&f->file->alpha_max);
    cv_status status = sa_resonances(&out->resonances, &f->of->params, 15, why);
    if (status == CV_OK)
        status = sa_pseudocritical_find(&out->peaks, &f->of->params, out->low, out->high, why);
    return status;
}

void cmp_velocities_clear(cmp_velocities *v)
{
    sa_resonances_clear(&v->resonances);
    sa_pseudocritical_clear(&v->peaks);
}

double cmp_resonance_alpha(const sa_resonance *r)
{
    return mpfr_get_d(r->alpha, MPFR_RNDN);
}

double cmp_round_up(double x)
{
    static const double steps[] = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    const double power = pow(10, floor(log10(x)));
    size_t i = 0;
    while (steps[i] * power < x * (1 - 1e-12) && steps[i] < 10)
        i++;
    return steps[i] * power;
}

double cmp_velocities_end(const cmp_velocities *v)
{
    double last = v->low;
    for (size_t i = 0; i < v->resonances.count; i++) {
        const double alpha = cmp_resonance_alpha(&v->resonances.item[i]);
        last = alpha < v->high ? fmax(last, alpha) : last;
    }
    for (size_t i = 0; i < v->peaks.count; i++)
        if (v->peaks.item[i].of != SA_CURVE_ACTIVE_POINT)
            last = fmax(last, (double)v->peaks.item[i].alpha);
    return fmin(v->high, last > v->low ? cmp_round_up(1.4 * last) : v->high);
}

double cmp_velocities_begin(const cmp_velocities *v, double end)
{
    return v->low < 0.2 * end ? 0 : v->low;
}

void cmp_mass_range(double *lightest, double *heaviest, const cv_case *c)
{
    double low = HUGE_VAL, high = 0;
    for (size_t i = 0; i < c->mass_count; i++) {
        low = fmin(low, cv_number_get_double(&c->mass_ratios[i]));
        high = fmax(high, cv_number_get_double(&c->mass_ratios[i]));
    }
    const double missing = fmax(1, sqrt(1000 * low / high));
    *lightest = fmin(fmax(low / missing, 1e-10), 1e7);
    *heaviest = fmin(fmax(high * missing, 1e-7), 1e10);
}

void cmp_mass_tics(FILE *script, double lightest, double heaviest)
{
    const int first = (int)ceil(log10(lightest) - 1e-9), last = (int)floor(log10(heaviest) + 1e-9);
    for (int i = first; i <= last; i++)
        fprintf(script, "%s'10^{%d}' %d%s", i == first ? "set ytics (" : "", i, i, i < last ? ", " : ")\n");
}

static size_t resonances_of(const cmp_velocities *v, sa_resonance_kind kind)
{
    size_t n = 0;
    for (size_t i = 0; i < v->resonances.count; i++)
        n += v->resonances.item[i].kind == kind;
    return n;
}

static void write_kind(FILE *data, const cmp_velocities *v, sa_resonance_kind kind)
{
    if (resonances_of(v, kind) == 0)
        return;
    fprintf(data, "\n\n# %s\n# alpha\n", sa_resonance_kind_text(kind));
    for (size_t i = 0; i < v->resonances.count; i++)
        if (v->resonances.item[i].kind == kind)
            fprintf(data, "%.15g\n", cmp_resonance_alpha(&v->resonances.item[i]));
}

void cmp_velocities_data(FILE *data, const cmp_velocities *v)
{
    write_kind(data, v, SA_RESONANCE_TRUE);
    write_kind(data, v, SA_RESONANCE_FALSE);
    write_kind(data, v, SA_RESONANCE_MERGING);
    if (v->peaks.count > 0)
        fprintf(data, "\n\n# pseudocritical\n# alpha, w, of which curve\n");
    for (size_t i = 0; i < v->peaks.count; i++) {
        const sa_pseudocritical *p = &v->peaks.item[i];
        fprintf(data, "%.15Lg %.10g \"%s\"\n", p->alpha, p->deflection, sa_curve_text(p->of));
    }
}

static void plot_kind(FILE *s, const cmp_velocities *v, sa_resonance_kind kind, int style)
{
    if (resonances_of(v, kind) > 0)
        fprintf(
            s,
            ", \\\n    data index '%s' using 1:(bottom):(0):(top - bottom) with vectors nohead linestyle %d "
            "title 'resonance velocity (%s)'",
            sa_resonance_kind_text(kind), style, sa_resonance_kind_text(kind));
}

static int has_peaks_of_rail(const cmp_velocities *v)
{
    for (size_t i = 0; i < v->peaks.count; i++)
        if (v->peaks.item[i].of != SA_CURVE_ACTIVE_POINT)
            return 1;
    return 0;
}

void cmp_velocities_plot(FILE *script, const cmp_velocities *v, int with_peaks)
{
    plot_kind(script, v, SA_RESONANCE_TRUE, 5);
    plot_kind(script, v, SA_RESONANCE_FALSE, 6);
    plot_kind(script, v, SA_RESONANCE_MERGING, 6);
    if (with_peaks && has_peaks_of_rail(v))
        fprintf(script, ", \\\n    data index 'pseudocritical' using (strcol(3) eq 'active point' ? NaN : "
                        "$1):(bottom):(0):(top - bottom) with vectors nohead linestyle 7 title "
                        "'pseudocritical velocity'");
}
