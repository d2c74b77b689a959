/* Figures 4 and 5: instability lines by damping, with the velocities of the moving force. */
#include <math.h>

#include "compare/figure_line_data.h"
#include "compare/format.h"

enum { STYLES = 4, DIGITS = 6 };

static void begin(const cmp_picture *p, const cmp_line_range *r)
{
    FILE *s = p->script;
    cmp_script_begin(p, 8.6, 8);
    fprintf(s, "data = '%s.dat'\n", p->name);
    fprintf(s, "set xlabel 'velocity ratio  {/:Italic α}  (dimensionless)'\n"
               "set ylabel 'mass ratio  {/:Italic η}_M  (dimensionless)'\n");
    fprintf(s, "set logscale y\nset format y '10^{%%T}'\n");
    fprintf(s, "set xrange [%.10g:%.10g]\nbottom = %.10g; top = %.10g\nset yrange [bottom:top]\n", r->begin,
            r->end, r->lightest, r->heaviest);
    fprintf(s, "set key outside top center horizontal maxcols 2\nplot ");
}

/* The lowest damping has the first style. */
static cv_status draw(cmp_picture *p, const cmp_figure *f, const cmp_velocities *v, cv_message *why)
{
    const cmp_line_range range = cmp_line_range_of(v, f->of);
    const size_t levels = cmp_figure_levels(f);
    cv_status status = CV_OK;
    cv_params params;
    begin(p, &range);
    fprintf(p->data, "# %s", p->shows);
    cv_params_init(&params);
    for (size_t l = 0; l < levels && status == CV_OK; l++) {
        size_t branches;
        cmp_damping_text damping;
        cmp_figure_params(&params, f, l);
        status = cmp_line_data(p, &branches, &params, &range, l, why);
        if (status == CV_OK && branches > 0)
            fprintf(p->script,
                    "data index 'lines %zu' using 1:2 with lines linestyle %zu title 'damping %s', \\\n    ",
                    l + 1, 1 + (levels - 1 - l) % STYLES, cmp_format_damping(&damping, &params, DIGITS));
    }
    cv_params_clear(&params);
    fprintf(p->script, "NaN");
    cmp_velocities_data(p->data, v);
    cmp_velocities_plot(p->script, v, 1);
    fprintf(p->script, "\n");
    return status;
}

cv_status cmp_draw_lines(cmp_picture *p, const cmp_figure *f, cv_message *why)
{
    cmp_velocities v = {.low = 0};
    char of[CMP_PICTURE_SHOWS];
    snprintf(p->shows, sizeof p->shows, "instability lines over velocity and mass ratio, %s",
             cmp_figure_case(of, f));
    cv_status status = cmp_velocities_find(&v, f, why);
    if (status == CV_OK)
        status = draw(p, f, &v, why);
    cmp_velocities_clear(&v);
    return status;
}
