/* Steady shapes of rail, sleepers and ballast under the moving force. */
#include <math.h>
#include <stdio.h>

#include "compare/figure_velocities.h"
#include "compare/format.h"
#include "semianalytic/steady.h"

enum { POINTS = 1201, DIGITS = 6 };
/* Half the width of the picture: so many of the longest wave or decay length that counts, but not more of the
 * shortest one than can be seen; and what counts. */
static const double LENGTHS = 3, SEEN = 20, COUNTS = 0.02;

static double reach_of(const sa_steady *s)
{
    double heaviest = 0, longest = 0, shortest = HUGE_VAL;
    for (int i = 0; i < s->count; i++)
        heaviest = fmax(heaviest, (double)cabsl(s->term[i].weight[0]));
    for (int i = 0; i < s->count; i++)
        if ((double)cabsl(s->term[i].weight[0]) >= COUNTS * heaviest) {
            const double length = 2 * M_PI / (double)cabsl(s->term[i].p);
            longest = fmax(longest, length);
            shortest = fmin(shortest, length);
        }
    return cmp_round_up(fmin(LENGTHS * longest, SEEN * shortest));
}

/* One panel: the shapes at one velocity. */
static cv_status draw_panel(cmp_picture *p, const cv_params *params, const cv_number *alpha, char panel,
                            int alone, cv_message *why)
{
    const char label[] = {panel, ')', ' ', '\0'};
    cmp_number_text text;
    sa_steady s;
    const cv_status status = sa_steady_solve(&s, params, alpha, why);
    if (status != CV_OK)
        return status;
    const double reach = reach_of(&s);
    cmp_format_exact(&text, alpha, DIGITS);
    fprintf(p->data, "%s# %c\n# xi, w, u_s, u_b at alpha = %s; all dimensionless\n",
            panel > 'a' ? "\n\n" : "", panel, text.text);
    for (int i = 0; i < POINTS; i++) {
        long double u[SA_FIELDS];
        const double xi = reach * (2.0 * i / (POINTS - 1) - 1);
        sa_steady_at(u, &s, xi);
        fprintf(p->data, "%.8g %.10Lg %.10Lg %.10Lg\n", xi, u[0], u[1], u[2]);
    }
    fprintf(p->script,
            "\nset title '%s{/:Italic α}  =  %s'\nset xrange [%g:%g]\n"
            "plot data index '%c' using 1:2 with lines linestyle 1 title 'rail  {/:Italic w}', \\\n"
            "    data index '%c' using 1:3 with lines linestyle 2 title 'sleepers  {/:Italic u}_s', \\\n"
            "    data index '%c' using 1:4 with lines linestyle 3 title 'ballast  {/:Italic u}_b'\n",
            alone ? "" : label, text.text, -reach, reach, panel, panel, panel);
    return CV_OK;
}

static void begin(const cmp_picture *p, int panels)
{
    FILE *s = p->script;
    cmp_script_begin(p, panels > 1 ? 17 : 8.6, 6.6);
    fprintf(s, "data = '%s.dat'\n", p->name);
    fprintf(s, "set xlabel 'distance from the force  {/:Italic ξ}  (dimensionless)'\n"
               "set ylabel 'deflection (dimensionless), downward' offset 1\nset yrange [] reverse\n"
               "set xzeroaxis linestyle 8\nset yzeroaxis linestyle 8\n"
               "set key outside top center horizontal\n");
    if (panels > 1)
        fprintf(s, "set multiplot layout 1,2\n");
}

/* The lowest velocity, true resonance or pseudocritical of max or min, at which the deflection has a peak; 0:
 * there is none. */
static double lowest_peak(const cmp_velocities *v)
{
    double lowest = HUGE_VAL;
    for (size_t i = 0; i < v->resonances.count; i++)
        if (v->resonances.item[i].kind != SA_RESONANCE_FALSE)
            lowest = fmin(lowest, cmp_resonance_alpha(&v->resonances.item[i]));
    for (size_t i = 0; i < v->peaks.count; i++)
        if (v->peaks.item[i].of != SA_CURVE_ACTIVE_POINT)
            lowest = fmin(lowest, (double)v->peaks.item[i].alpha);
    return isfinite(lowest) ? lowest : 0;
}

/* Half that velocity and a fifth above it, to two digits; some velocity when there is none. */
static cv_status choose_alphas(cv_number alphas[2], int *count, const cmp_figure *f, cv_message *why)
{
    cmp_velocities v = {.low = 0};
    cv_status status = cmp_velocities_find(&v, f, why);
    const double peak = lowest_peak(&v);
    *count = peak > 0 ? 2 : 1;
    for (int k = 0; k < *count && status == CV_OK; k++) {
        char text[32];
        snprintf(text, sizeof text, "%.2g", peak > 0 ? peak * (k == 0 ? 0.5 : 1.2) : 0.1);
        status = cv_number_parse(&alphas[k], text, why);
    }
    cmp_velocities_clear(&v);
    return status;
}

static void undamp(cv_params *params)
{
    cv_number zero;
    cv_number_init(&zero);
    cv_number_set(&params->eta_p, &zero);
    cv_number_set(&params->eta_b, &zero);
    cv_number_set(&params->eta_f, &zero);
    cv_number_clear(&zero);
}

static cv_status draw(cmp_picture *p, const cmp_figure *f, const cv_params *params, cv_message *why)
{
    cv_number alphas[2];
    int count = 1;
    cv_status status = CV_OK;
    cv_number_init(&alphas[0]);
    cv_number_init(&alphas[1]);
    if (f->set->alpha.given)
        cv_number_set(&alphas[0], &f->set->alpha.value);
    else
        status = choose_alphas(alphas, &count, f, why);
    begin(p, count);
    for (int i = 0; i < count && status == CV_OK; i++)
        status = draw_panel(p, params, &alphas[i], (char)('a' + i), count == 1, why);
    if (count > 1)
        fprintf(p->script, "unset multiplot\n");
    cv_number_clear(&alphas[0]);
    cv_number_clear(&alphas[1]);
    return status;
}

cv_status cmp_draw_steady(cmp_picture *p, const cmp_figure *f, cv_message *why)
{
    char of[CMP_PICTURE_SHOWS];
    cmp_damping_text damping;
    cv_params params;
    cv_params_init(&params);
    cmp_figure_params(&params, f, 0);
    if (!f->set->damping.given)
        undamp(&params);
    snprintf(p->shows, sizeof p->shows, "steady shapes under the moving force, %s, damping %.40s",
             cmp_figure_case(of, f), cmp_format_damping(&damping, &params, DIGITS));
    const cv_status status = draw(p, f, &params, why);
    cv_params_clear(&params);
    return status;
}
