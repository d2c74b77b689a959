/* Figures 6 and 7: undamped steady deflection of the rail over the velocity of the moving force. */
#include <math.h>
#include <stdlib.h>

#include "compare/figure_velocities.h"

/* Panel a) shows nine tenths of the curves, and room above; the rest are peaks that go to infinity. */
static const double SHOWN = 0.9, ROOM = 1.5;
/* Panel b) goes so far to both sides of a pseudocritical velocity that panel a) does not hold. */
static const double AROUND = 0.12;
/* How near the curves go to a resonance velocity, relative. */
static const double NEAREST = 1e-7;
enum { STEPS = 600 };

typedef struct {
    double alpha, max, min, active;
    int last; /* before a resonance velocity: the curves break off */
} point;

typedef struct {
    cmp_velocities velocities;
    size_t count, room;
    point *points;
} curves;

static cv_status add_point(curves *c, const sa_undamped *s, cv_message *why)
{
    if (c->count == c->room) {
        const size_t room = c->room > 0 ? 2 * c->room : 1024;
        point *more = realloc(c->points, room * sizeof *more);
        if (more == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        c->points = more;
        c->room = room;
    }
    sa_summit max, min;
    long double active[4];
    sa_curve_at(&max, s, SA_CURVE_MAX);
    sa_curve_at(&min, s, SA_CURVE_MIN);
    sa_undamped_at(active, s, 0, 1, 0);
    c->points[c->count++] =
        (point){(double)s->alpha, (double)max.value, -(double)min.value, (double)active[0], 0};
    return CV_OK;
}

/* From one end to the other in steps that are a fraction of the distance to the nearest velocity where two
 * wave numbers meet, resonances among them; within 1e-11 of such a velocity there is no point. */
static cv_status follow(curves *c, const sa_dispersion *track, double from, double to, cv_message *why)
{
    for (double alpha = from;;) {
        sa_undamped s;
        double step = 1e-9 * alpha;
        if (sa_undamped_solve(&s, track, alpha, why) == CV_OK) {
            const cv_status status = add_point(c, &s, why);
            if (status != CV_OK)
                return status;
            step = fmin((c->velocities.high - c->velocities.low) / STEPS, fmax(step, 0.15 * (double)s.reach));
        }
        if (!(alpha < to))
            return CV_OK;
        alpha = fmin(alpha + step, to);
    }
}

/* Where the curves are interrupted: a resonance velocity, where they break off, or a pseudocritical one,
 * which becomes one of the points. */
typedef struct {
    double alpha;
    int resonance;
} stop;

static int by_alpha(const void *a, const void *b)
{
    const stop *x = a, *y = b;
    return (x->alpha > y->alpha) - (x->alpha < y->alpha);
}

/* Those between low and high, and high itself; the caller frees them. NULL: out of memory */
static stop *find_stops(size_t *count, const curves *c)
{
    stop *stops = calloc(c->velocities.resonances.count + c->velocities.peaks.count + 1, sizeof *stops);
    size_t n = 0;
    if (stops == NULL)
        return NULL;
    for (size_t i = 0; i < c->velocities.resonances.count; i++)
        stops[n++] = (stop){cmp_resonance_alpha(&c->velocities.resonances.item[i]), 1};
    for (size_t i = 0; i < c->velocities.peaks.count; i++)
        stops[n++] = (stop){(double)c->velocities.peaks.item[i].alpha, 0};
    qsort(stops, n, sizeof *stops, by_alpha);
    size_t kept = 0;
    for (size_t i = 0; i < n; i++)
        if (stops[i].alpha > c->velocities.low && stops[i].alpha < c->velocities.high)
            stops[kept++] = stops[i];
    stops[kept++] = (stop){c->velocities.high, 0};
    *count = kept;
    return stops;
}

static cv_status compute(curves *c, const cv_params *params, cv_message *why)
{
    sa_dispersion track;
    size_t count = 0;
    sa_dispersion_set(&track, params);
    cv_status status = CV_OK;
    stop *stops = find_stops(&count, c);
    if (stops == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    double from = c->velocities.low;
    for (size_t i = 0; i < count && status == CV_OK; i++) {
        const stop *s = &stops[i];
        status = follow(c, &track, from, s->resonance ? s->alpha * (1 - NEAREST) : s->alpha, why);
        if (s->resonance && c->count > 0)
            c->points[c->count - 1].last = 1;
        from = s->alpha * (1 + NEAREST);
    }
    free(stops);
    return status;
}

typedef struct {
    double size, width;
} share;

static int by_size(const void *a, const void *b)
{
    const share *x = a, *y = b;
    return (x->size > y->size) - (x->size < y->size);
}

/* The size > 0 that the curves do not exceed over that share of low .. high. */
static double quantile(const curves *c, double high, double wanted)
{
    share *all = malloc(c->count * sizeof *all);
    double total = 0, size = 1;
    size_t n = 0;
    for (size_t i = 0; all != NULL && i + 1 < c->count && c->points[i].alpha < high; i++) {
        if (c->points[i].last)
            continue;
        const point *p = &c->points[i];
        all[n++] = (share){fmax(p->max, -p->min), p[1].alpha - p->alpha};
        total += all[n - 1].width;
    }
    if (n > 1)
        qsort(all, n, sizeof *all, by_size);
    double sum = 0;
    for (size_t i = 0; i < n && sum < wanted * total; i++) {
        sum += all[i].width;
        size = all[i].size;
    }
    free(all);
    return size;
}

static const sa_pseudocritical *highest_peak(const curves *c)
{
    const sa_pseudocritical *highest = NULL;
    for (size_t i = 0; i < c->velocities.peaks.count; i++)
        if (highest == NULL || fabs(c->velocities.peaks.item[i].deflection) > fabs(highest->deflection))
            highest = &c->velocities.peaks.item[i];
    return highest;
}

static void write_data(FILE *data, const curves *c)
{
    fprintf(data, "# curves\n# alpha, largest and smallest w over the rail, w at the active point; all "
                  "dimensionless\n");
    for (size_t i = 0; i < c->count; i++) {
        const point *p = &c->points[i];
        fprintf(data, "%.12g %.8g %.8g %.8g\n", p->alpha, p->max, p->min, p->active);
        if (p->last && i + 1 < c->count)
            fputc('\n', data);
    }
    cmp_velocities_data(data, &c->velocities);
}

static void plot(const cmp_picture *p, const curves *c, double left, double right, double size)
{
    FILE *s = p->script;
    fprintf(s, "set xrange [%.10g:%.10g]\nbottom = %g; top = %g\nset yrange [bottom:top]\n", left, right,
            -size, size);
    fprintf(s, "plot 0 linestyle 8, \\\n"
               "    data index 'curves' using 1:2 with lines linestyle 1 title 'max', \\\n"
               "    data index 'curves' using 1:3 with lines linestyle 2 title 'min', \\\n"
               "    data index 'curves' using 1:4 with lines linestyle 3 title 'AP'");
    if (c->velocities.peaks.count > 0)
        fprintf(s, ", \\\n    data index 'pseudocritical' using 1:2 with points linestyle 9 title "
                   "'pseudocritical velocity'");
    cmp_velocities_plot(s, &c->velocities, 0);
    fprintf(s, "\n");
}

/* One panel, or two where a pseudocritical peak is higher than the first shows. */
static void write_script(const cmp_picture *p, const curves *c, double high, double size)
{
    const sa_pseudocritical *peak = highest_peak(c);
    const int zoomed = peak != NULL && fabs(peak->deflection) > size;
    cmp_script_begin(p, zoomed ? 17 : 8.6, 6.6);
    fprintf(p->script, "data = '%s.dat'\n", p->name);
    fprintf(p->script, "set xlabel 'velocity ratio  {/:Italic α}  (dimensionless)'\n"
                       "set ylabel 'deflection  {/:Italic w}  (dimensionless)'\n");
    fprintf(p->script, "set key outside top center horizontal maxcols 3\n");
    if (zoomed)
        fprintf(p->script, "set multiplot layout 1,2\nset title 'a)' offset 0,-0.5\n");
    plot(p, c, cmp_velocities_begin(&c->velocities, high), high, size);
    if (zoomed) {
        const double alpha = (double)peak->alpha;
        fprintf(p->script, "set title 'b)'\n");
        plot(p, c, alpha * (1 - AROUND), alpha * (1 + AROUND), cmp_round_up(1.05 * fabs(peak->deflection)));
        fprintf(p->script, "unset multiplot\n");
    }
}

cv_status cmp_draw_deflection(cmp_picture *p, const cmp_figure *f, cv_message *why)
{
    curves c = {.count = 0};
    char of[CMP_PICTURE_SHOWS];
    snprintf(p->shows, sizeof p->shows,
             "undamped steady deflection of the rail over the velocity of the force, %s",
             cmp_figure_case(of, f));
    cv_status status = cmp_velocities_find(&c.velocities, f, why);
    if (status == CV_OK)
        status = compute(&c, &f->of->params, why);
    if (status == CV_OK && c.count < 2)
        status = cv_fail(why, CV_UNDECIDED, "no velocity has a finite deflection");
    if (status == CV_OK) {
        const double end = cmp_velocities_end(&c.velocities);
        write_data(p->data, &c);
        write_script(p, &c, end, cmp_round_up(ROOM * quantile(&c, end, SHOWN)));
    }
    cmp_velocities_clear(&c.velocities);
    free(c.points);
    return status;
}
