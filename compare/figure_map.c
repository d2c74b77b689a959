/* Maps of stability: number of unstable roots and growth rate over velocity and mass ratio, by
 * D-decomposition.
 */
#include <math.h>
#include <stdlib.h>

#include "compare/figure_line_data.h"
#include "compare/format.h"
#include "dgreen/map.h"

enum { COLUMNS = 160, ROWS = 80, LEVELS_SHOWN = 4, DIGITS = 6 };

typedef struct {
    cmp_line_range range;
    double alphas[COLUMNS], masses[ROWS]; /* centres of the fields, even in alpha and in log eta_M */
} grid;

static void set_grid(grid *g)
{
    const cmp_line_range *r = &g->range;
    for (int i = 0; i < COLUMNS; i++)
        g->alphas[i] = r->begin + (r->end - r->begin) * (i + 0.5) / COLUMNS;
    for (int i = 0; i < ROWS; i++)
        g->masses[i] = r->lightest * pow(r->heaviest / r->lightest, (i + 0.5) / ROWS);
}

/* An undecided field stays empty. */
static void write_column(FILE *data, double alpha, const grid *g, const dg_map_cell *cells)
{
    for (int i = 0; i < ROWS; i++) {
        const dg_map_cell *c = &cells[i];
        fprintf(data, "%.10g %.10g ", alpha, g->masses[i]);
        if (c->count < 0)
            fprintf(data, "NaN NaN\n");
        else
            fprintf(data, "%d %.5g\n", c->count, c->growth);
    }
    fputc('\n', data);
}

/* *undecided: grows by the fields without number or growth rate. */
static cv_status write_level(FILE *data, size_t *undecided, const cv_params *params, const grid *g,
                             size_t level, cv_message *why)
{
    dg_sampler sampler;
    dg_map_cell cells[ROWS];
    cv_status status = dg_sampler_init(&sampler, params, g->alphas[0], g->alphas[COLUMNS - 1], why);
    if (status != CV_OK)
        return status;
    fprintf(data, "%s# map %zu\n# alpha, eta_M, unstable roots, growth rate\n", level > 0 ? "\n\n" : "",
            level + 1);
    for (int i = 0; i < COLUMNS && status == CV_OK; i++) {
        status = dg_map_row(cells, &sampler, g->alphas[i], ROWS, g->masses, why);
        if (status == CV_UNDECIDED) /* all cells are */
            status = CV_OK;
        if (status == CV_OK)
            write_column(data, g->alphas[i], g, cells);
        for (int j = 0; j < ROWS; j++)
            *undecided += cells[j].count < 0 || isnan(cells[j].growth);
    }
    dg_sampler_clear(&sampler);
    return status;
}

static void plot(FILE *s, const cmp_velocities *v, size_t level, const char *field, size_t branches)
{
    fprintf(s, "plot data index 'map %zu' using 1:(log10($2)):(%s) with image", level + 1, field);
    cmp_velocities_plot(s, v, 1);
    if (branches > 0)
        fprintf(s, ", \\\n    data index 'lines %zu' using 1:(log10($2)) with lines linestyle 1", level + 1);
    fprintf(s, "\n");
}

/* Two panels for a level: the number of roots, and the growth rate where there are some. */
static void write_panels(FILE *s, const cmp_velocities *v, const cv_params *params, size_t level,
                         size_t branches)
{
    cmp_damping_text damping;
    fprintf(s, "\nset title 'damping %s: number of unstable roots'\n",
            cmp_format_damping(&damping, params, DIGITS));
    fprintf(s, "set palette defined (0 '#ffffff', 1 '#f0b070', 2 '#b04020') maxcolors 3\n"
               "set cbrange [-1:5]\nset cbtics ('0' 0, '2' 2, '≥ 4' 4)\n");
    plot(s, v, level, "$3", branches);
    fprintf(s, "set title 'damping %s: growth rate'\n", damping.text);
    fprintf(
        s,
        "set palette defined (0 '#ffffff', 1 '#dce8f8', 2 '#80b0e0', 3 '#4060b0', 4 '#101040') maxcolors 5\n"
        "set cbrange [-5:0]\nset cbtics ('0' -4, '10^{-3}' -3, '10^{-2}' -2, '10^{-1}' -1)\n");
    plot(s, v, level, "growth($3, $4)", branches);
}

static cv_status draw(cmp_picture *p, const cmp_figure *f, const cmp_velocities *v, cv_message *why)
{
    grid g = {.range = cmp_line_range_of(v, f->of)};
    const cmp_line_range *r = &g.range;
    cv_params params;
    const size_t levels = cmp_figure_levels(f), shown = levels < LEVELS_SHOWN ? levels : LEVELS_SHOWN;
    set_grid(&g);
    cmp_script_begin(p, 17, 1 + 5.2 * (double)shown);
    fprintf(p->script, "data = '%s.dat'\nset multiplot layout %zu,2\n", p->name, shown);
    fprintf(p->script,
            "set xlabel 'velocity ratio  {/:Italic α}'\nset ylabel 'mass ratio  {/:Italic η}_M'\n");
    fprintf(p->script, "set xrange [%.10g:%.10g]\nbottom = %.10g; top = %.10g\nset yrange [bottom:top]\n",
            r->begin, r->end, log10(r->lightest), log10(r->heaviest));
    cmp_mass_tics(p->script, r->lightest, r->heaviest);
    fprintf(p->script,
            "set tics front\nunset key\n"
            "# fields that are undecided\n"
            "set object rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#c0c0c0'\n"
            "# log10 of the growth rate; the smallest ones share a colour, stable fields have their own\n"
            "growth(n, g) = n == 0 ? -4.5 : g < 2e-4 ? -3.5 : log10(g)\n");
    size_t undecided = 0;
    cv_status status = CV_OK;
    cv_params_init(&params);
    for (size_t l = 0; l < shown && status == CV_OK; l++) {
        size_t branches = 0;
        cmp_figure_params(&params, f, l);
        status = write_level(p->data, &undecided, &params, &g, l, why);
        if (status == CV_OK)
            status = cmp_line_data(p, "lines", &branches, NULL, &params, r, l, why);
        write_panels(p->script, v, &params, l, branches);
    }
    cv_params_clear(&params);
    if (undecided > 0) {
        char text[64];
        snprintf(text, sizeof text, "%zu fields of the map", undecided);
        cmp_picture_doubt(p, text);
    }
    cmp_velocities_data(p->data, v);
    fprintf(p->script, "unset multiplot\n");
    return status;
}

cv_status cmp_draw_map(cmp_picture *p, const cmp_figure *f, cv_message *why)
{
    cmp_velocities v = {.low = 0};
    char of[CMP_PICTURE_SHOWS];
    snprintf(p->shows, sizeof p->shows, "unstable roots and growth rate over velocity and mass ratio, %s",
             cmp_figure_case(of, f));
    cv_status status = cmp_velocities_find(&v, f, why);
    if (status == CV_OK)
        status = draw(p, f, &v, why);
    cmp_velocities_clear(&v);
    return status;
}
