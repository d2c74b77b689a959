/* Figures 2 and 3: D-decomposition curves, stable and unstable, stable part to the right or to the left. */
#include <math.h>
#include <stdlib.h>

#include "compare/curve_pick.h"
#include "compare/curve_smooth.h"
#include "compare/figure_velocities.h"
#include "compare/format.h"
#include "dgreen/stability_curve.h"

/* The part of the plane that is shown, around z = 1. */
static const double LEFT = -0.3, RIGHT = 2.2, TOP = 1.2;
/* It is lower where the curve is flat: so many times its height at FAR, or that of the loop before z = 1. */
static const double FAR = 1.8, TIMES_FAR = 3, TIMES_LOOP = 2;
/* How far delta moves the curve where it crosses the real axis, as part of the height. */
static const double SHIFT = 0.1;
enum { DIGITS = 6 };

static const dg_cut *nearest_cut(const dg_stability_curve *c)
{
    const dg_cut *nearest = NULL;
    for (size_t i = 0; i < c->cut_count; i++)
        if (nearest == NULL || fabs(log(c->cuts[i].x)) < fabs(log(nearest->x)))
            nearest = &c->cuts[i];
    return nearest;
}

static double choose_top(const dg_stability_curve *c, const dg_cut *cut)
{
    double loop = 0, far = TOP;
    for (size_t i = 0; i + 1 < c->boundary.count; i++) {
        const dg_vertex *a = &c->boundary.at[i], *b = a + 1;
        if (cut != NULL && a->q < cut->q && a->re > 0 && a->re < FAR)
            loop = fmax(loop, fabs(a->im));
        if ((a->re < FAR) != (b->re < FAR))
            far = fmin(far, fabs(a->im + (b->im - a->im) * (FAR - a->re) / (b->re - a->re)));
    }
    const double top = fmax(TIMES_FAR * far, TIMES_LOOP * loop);
    return top > 0 ? fmin(TOP, cmp_round_up(top)) : TOP;
}

/* delta to one digit, so that z moves by "shift" at that crossing. */
static double choose_delta(const dg_stability_curve *c, const dg_cut *nearest, double shift)
{
    size_t i = 1;
    while (nearest != NULL && i + 1 < c->boundary.count && c->boundary.at[i].q < nearest->q)
        i++;
    if (nearest == NULL || i >= c->boundary.count)
        return 0.01;
    const dg_vertex *a = &c->boundary.at[i - 1], *b = &c->boundary.at[i];
    const double delta = shift * (b->q - a->q) / hypot(b->re - a->re, b->im - a->im);
    const double unit = pow(10, floor(log10(delta)));
    return delta > 0 && isfinite(delta) ? unit * floor(delta / unit + 0.5) : 0.01;
}

static void write_line(FILE *data, const dg_polyline *line, const char *name, char panel)
{
    fprintf(data, "\n\n# %c %s\n# q, Re z, Im z\n", panel, name);
    for (size_t i = line->count; i-- > 0;)
        fprintf(data, "%.10g %.8g %.8g\n", -line->at[i].q, line->at[i].re, -line->at[i].im);
    for (size_t i = 0; i < line->count; i++)
        fprintf(data, "%.10g %.8g %.8g\n", line->at[i].q, line->at[i].re, line->at[i].im);
}

/* The parts of the positive real axis without unstable roots; the last goes on to infinity: 1e4 is
 * as far as gnuplot can draw. */
static void write_stable_parts(FILE *data, const dg_stability_curve *c, char panel)
{
    fprintf(data, "\n\n# %c stable\n# ends of the parts, Im z\n", panel);
    for (size_t i = 0; i <= c->cut_count; i++) {
        const double from = i > 0 ? c->cuts[i - 1].x : c->x_floor;
        const double to = i < c->cut_count && isfinite(c->cuts[i].x) ? c->cuts[i].x : 1e4;
        const int roots = i < c->cut_count ? c->cuts[i].left : 0;
        if (roots == 0 && isfinite(from))
            fprintf(data, "%.10g 0\n%.10g 0\n\n", from, to);
    }
}

typedef struct {
    cmp_picture *picture;
    const cv_params *params;
    double alpha;
    double delta, top; /* 0 until they are chosen, then the same for both panels */
    dg_sampler sampler;
} drawing;

static void plot(FILE *s, char panel, double delta)
{
    fprintf(s,
            "plot data index '%c stable' using 1:2 with lines linestyle 10 title 'stable part of the real "
            "axis', \\\n"
            "    data index '%c boundary' using 2:3 with lines linestyle 1 title '{/:Italic z}(±i{/:Italic "
            "q})', \\\n"
            "    data index '%c shifted' using 2:3 with lines linestyle 3 title '{/:Italic z}({/:Italic δ} ± "
            "i{/:Italic q}),  {/:Italic δ} = %g', \\\n"
            "    '+' using (1):(0) every ::0::0 with points linestyle 9 title '(1, 0)'\n",
            panel, panel, panel, delta);
}

/* One panel: the curves of one mass. */
static cv_status draw_panel(drawing *d, double eta_M, char panel, int alone, cv_message *why)
{
    const char label[] = {panel, ')', ' ', '\0'};
    dg_stability_curve c = {.unstable = 0};
    cv_status status = CV_OK;
    if (d->delta == 0) {
        status = dg_stability_curve_at(&c, &d->sampler, d->alpha, eta_M, 0.01, why);
        const dg_cut *cut = nearest_cut(&c);
        d->top = choose_top(&c, cut);
        d->delta = choose_delta(&c, cut, SHIFT * d->top);
        fprintf(d->picture->script, "set yrange [%g:%g]\n", -d->top, d->top);
    }
    if (status == CV_OK)
        status = dg_stability_curve_at(&c, &d->sampler, d->alpha, eta_M, d->delta, why);
    if (status == CV_OK) {
        cmp_window w = {d->alpha, eta_M, 0, LEFT, RIGHT, d->top};
        status = cmp_curve_smooth(&c.boundary, &d->sampler, &w, why);
        w.delta = d->delta;
        if (status == CV_OK)
            status = cmp_curve_smooth(&c.shifted, &d->sampler, &w, why);
    }
    if (status == CV_OK) {
        write_line(d->picture->data, &c.boundary, "boundary", panel);
        write_line(d->picture->data, &c.shifted, "shifted", panel);
        write_stable_parts(d->picture->data, &c, panel);
        fprintf(d->picture->script, "\nset title '%s{/:Italic η}_M = %.6g:  %s (%d unstable roots)'\n",
                alone ? "" : label, eta_M, c.unstable > 0 ? "unstable" : "stable", c.unstable);
        plot(d->picture->script, panel, d->delta);
    }
    dg_stability_curve_clear(&c);
    return status;
}

static void begin(drawing *d, int panels)
{
    FILE *s = d->picture->script;
    fprintf(d->picture->data, "# %s\n", d->picture->shows);
    cmp_script_begin(d->picture, panels > 1 ? 17 : 8.6, 7.2);
    fprintf(s, "set style line 10 linecolor rgb '#b0b0b0' linewidth 5\n");
    fprintf(s, "data = '%s.dat'\n", d->picture->name);
    fprintf(s,
            "set xlabel 'Re {/:Italic z}  (dimensionless)'\nset ylabel 'Im {/:Italic z}  (dimensionless)'\n");
    fprintf(s, "set xrange [%g:%g]\n", LEFT, RIGHT);
    fprintf(s, "set xzeroaxis linestyle 8\nset yzeroaxis linestyle 8\nset key outside top center horizontal "
               "maxcols 2\n");
    fprintf(s, "set multiplot layout 1,%d title ", panels);
    cmp_script_text(s, d->picture->shows);
    fprintf(s, " font sprintf(',%%g', size) offset 0,0.4\n");
}

static cv_status draw_panels(drawing *d, const double *masses, int count, cv_message *why)
{
    begin(d, count);
    cv_status status = CV_OK;
    for (int i = 0; i < count && status == CV_OK; i++)
        status = draw_panel(d, masses[i], (char)('a' + i), count == 1, why);
    fprintf(d->picture->script, "unset multiplot\n");
    return status;
}

/* The stable mass first, as in the paper. */
static cv_status draw(cmp_picture *p, const cmp_figure *f, cmp_stable_side side, const cmp_curve_pick *pick,
                      cv_message *why)
{
    const cv_optional_number *mass = &f->set->mass_ratio;
    const int right = side == CMP_STABLE_RIGHT;
    const double masses[] = {mass->given ? cv_number_get_double(&mass->value)
                             : right     ? pick->lighter
                                         : pick->heavier,
                             right ? pick->heavier : pick->lighter};
    char of[CMP_PICTURE_SHOWS];
    cmp_damping_text *damping = malloc(sizeof *damping);
    if (damping == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    snprintf(p->shows, sizeof p->shows,
             "D-decomposition, stable part to the %s, %s, damping %.40s, alpha = %g",
             right ? "right" : "left", cmp_figure_case(of, f),
             cmp_format_damping(damping, &pick->params, DIGITS), pick->alpha);
    free(damping);
    drawing d = {.picture = p, .params = &pick->params, .alpha = pick->alpha, .delta = 0};
    cv_status status = dg_sampler_init(&d.sampler, &pick->params, d.alpha, d.alpha, why);
    if (status != CV_OK)
        return status;
    status = draw_panels(&d, masses, mass->given ? 1 : 2, why);
    dg_sampler_clear(&d.sampler);
    return status;
}

static cv_status draw_side(cmp_picture *p, const cmp_figure *f, cmp_stable_side side, cv_message *why)
{
    const cv_selection *set = f->set;
    cmp_curve_pick pick;
    cv_params_init(&pick.params);
    cv_status status =
        cmp_curve_pick_find(&pick, f->file, f->of, set->damping.given ? &set->damping.value : NULL,
                            set->alpha.given ? cv_number_get_double(&set->alpha.value) : 0, side, why);
    if (status == CV_OK)
        status = draw(p, f, side, &pick, why);
    else if (status == CV_UNDECIDED) {
        p->absent = 1;
        snprintf(p->shows, sizeof p->shows, "%.200s", why->text);
        why->text[0] = '\0';
        status = CV_OK;
    }
    cv_params_clear(&pick.params);
    return status;
}

cv_status cmp_draw_curve_right(cmp_picture *p, const cmp_figure *f, cv_message *why)
{
    return draw_side(p, f, CMP_STABLE_RIGHT, why);
}

cv_status cmp_draw_curve_left(cmp_picture *p, const cmp_figure *f, cv_message *why)
{
    return draw_side(p, f, CMP_STABLE_LEFT, why);
}
