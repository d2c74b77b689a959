/* Figures 4 and 5: instability lines by damping, with the velocities of the moving force; a second panel
 * where many branches crowd. */
#include <math.h>
#include <stdlib.h>

#include "compare/figure_line_data.h"
#include "compare/format.h"

enum { STYLES = 4, DIGITS = 6, CROWD = 3 };
/* What counts as crowding: so many branches within that part of the range; and the room around them. */
static const double PART = 0.07, ROOM = 0.15;

/* All levels of the case in one part of the plane. */
typedef struct {
    const char *name; /* of the data blocks */
    cmp_line_range range;
    size_t *branches; /* by level */
    cmp_extents extents;
} panel;

static cv_status compute(panel *n, cmp_picture *p, const cmp_figure *f, cv_message *why)
{
    const size_t levels = cmp_figure_levels(f);
    cv_params params;
    cv_status status = CV_OK;
    n->branches = calloc(levels, sizeof *n->branches);
    if (n->branches == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_params_init(&params);
    for (size_t l = 0; l < levels && status == CV_OK; l++) {
        cmp_figure_params(&params, f, l);
        status = cmp_line_data(p, n->name, &n->branches[l], &n->extents, &params, &n->range, l, why);
    }
    cv_params_clear(&params);
    return status;
}

static void panel_clear(panel *n)
{
    free(n->branches);
    free(n->extents.ends);
}

/* The part with most branches that lie in it as a whole: 1, and zoom->begin, low and end; 0: nowhere a crowd.
 */
static int find_crowd(cmp_line_range *zoom, const panel *all)
{
    const cmp_extents *e = &all->extents;
    const double width = PART * (all->range.end - all->range.begin);
    size_t most = CROWD - 1;
    for (size_t i = 0; i < e->count; i++) {
        const double from = e->ends[i][0];
        double to = from;
        size_t n = 0;
        for (size_t j = 0; j < e->count; j++)
            if (e->ends[j][0] >= from && e->ends[j][1] <= from + width) {
                to = fmax(to, e->ends[j][1]);
                n++;
            }
        if (n > most && to > from) {
            most = n;
            *zoom = all->range;
            zoom->begin = fmax(all->range.low, from - ROOM * (to - from));
            zoom->end = fmin(all->range.end, to + ROOM * (to - from));
            zoom->low = zoom->begin;
        }
    }
    return most >= CROWD;
}

/* The lowest damping has the first style. */
static void plot(FILE *s, const panel *n, const cmp_figure *f, const cmp_velocities *v)
{
    const size_t levels = cmp_figure_levels(f);
    cv_params params;
    cv_params_init(&params);
    fprintf(s, "set xrange [%.6g:%.6g]\nplot NaN", n->range.begin, n->range.end);
    for (size_t l = 0; l < levels; l++) {
        cmp_damping_text damping;
        cmp_figure_params(&params, f, l);
        if (n->branches[l] > 0)
            fprintf(s, ", \\\n    data index '%s %zu' using 1:2 with lines linestyle %zu title 'damping %s'",
                    n->name, l + 1, 1 + (levels - 1 - l) % STYLES,
                    cmp_format_damping(&damping, &params, DIGITS));
    }
    cmp_velocities_plot(s, v, 1);
    fprintf(s, "\n");
    cv_params_clear(&params);
}

static void write_script(const cmp_picture *p, const cmp_figure *f, const cmp_velocities *v, const panel *all,
                         const panel *zoom)
{
    FILE *s = p->script;
    cmp_script_begin(p, zoom != NULL ? 17 : 8.6, 8);
    fprintf(s, "data = '%s.dat'\n", p->name);
    fprintf(s, "set xlabel 'velocity ratio  {/:Italic α}  (dimensionless)'\n"
               "set ylabel 'mass ratio  {/:Italic η}_M  (dimensionless)'\n");
    fprintf(s,
            "set logscale y\nset format y '10^{%%T}'\nbottom = %.10g; top = %.10g\nset yrange [bottom:top]\n",
            all->range.lightest, all->range.heaviest);
    fprintf(s, "set key outside top center horizontal maxcols 2\n");
    if (zoom != NULL)
        fprintf(s, "set multiplot layout 1,2\nset title 'a)' offset 0,-0.5\n");
    plot(s, all, f, v);
    if (zoom == NULL)
        return;
    fprintf(s, "set title 'b)'\n");
    plot(s, zoom, f, v);
    fprintf(s, "unset multiplot\n");
}

static cv_status draw(cmp_picture *p, const cmp_figure *f, const cmp_velocities *v, cv_message *why)
{
    panel all = {.name = "lines", .range = cmp_line_range_of(v, f->of)}, zoom = {.name = "zoom"};
    fprintf(p->data, "# %s", p->shows);
    cv_status status = compute(&all, p, f, why);
    const int zoomed = status == CV_OK && find_crowd(&zoom.range, &all);
    if (zoomed)
        status = compute(&zoom, p, f, why);
    cmp_velocities_data(p->data, v);
    if (status == CV_OK)
        write_script(p, f, v, &all, zoomed ? &zoom : NULL);
    panel_clear(&all);
    panel_clear(&zoom);
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
