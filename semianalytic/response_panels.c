#include "semianalytic/response_panels.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_bessel.h>
#include <math.h>
#include <stdlib.h>

#include "semianalytic/laplace.h"

static const double pi = 3.14159265358979323846;

/* Nodes in -1 .. 1, and the matrix from values to Legendre coefficients. */
typedef struct {
    double node[SA_PANEL_NODES], to_c[SA_PANEL_NODES][SA_PANEL_NODES];
} rule;

typedef struct {
    const sa_image *image;
    sa_image at_load; /* the same with xi = 0: the measure of what matters */
    rule rule;
    double tolerance; /* of the integral over one panel */
    sa_panels *out;
} build;

static int rule_set(rule *r)
{
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(SA_PANEL_NODES);
    if (table == NULL)
        return 0;
    for (size_t j = 0; j < SA_PANEL_NODES; j++) {
        double weight, before = 0, now = 1;
        gsl_integration_glfixed_point(-1, 1, j, &r->node[j], &weight, table);
        for (int n = 0; n < SA_PANEL_NODES; n++) {
            r->to_c[n][j] = (n + 0.5) * weight * now;
            double next = ((2 * n + 1) * r->node[j] * now - n * before) / (n + 1);
            before = now;
            now = next;
        }
    }
    gsl_integration_glfixed_table_free(table);
    return 1;
}

/* W = K(xi) / (i pi q (1 - eta_M zeta)) */
static cv_status image_at(double complex *w, const sa_image *image, double x)
{
    const double far = 1e4;
    sa_sheet sheet;
    const double complex q = CMPLX(x, -image->height);
    cv_status status = x < far ? sa_sheet_start(&sheet, image->track, image->alpha, q)
                               : sa_sheet_far(&sheet, image->track, image->alpha, q);
    if (status == CV_OK)
        *w = sa_sheet_kernel(&sheet, image->xi) /
             (CMPLX(0, pi) * q * (1 - image->mass * sa_sheet_zeta(NULL, &sheet)));
    return status;
}

static cv_status panel_set(sa_panel *p, const build *b, double from, double to)
{
    p->middle = (from + to) / 2;
    p->half = (to - from) / 2;
    for (int n = 0; n < SA_PANEL_NODES; n++)
        p->c[n] = 0;
    for (int j = 0; j < SA_PANEL_NODES; j++) {
        double complex w = 0;
        cv_status status = image_at(&w, b->image, p->middle + p->half * b->rule.node[j]);
        if (status != CV_OK)
            return status;
        for (int n = 0; n < SA_PANEL_NODES; n++)
            p->c[n] += b->rule.to_c[n][j] * w;
    }
    return CV_OK;
}

static cv_status append(sa_panels *list, const sa_panel *p)
{
    if (list->count == list->room) {
        size_t room = 2 * list->room + 64;
        sa_panel *more = realloc(list->panel, room * sizeof *more);
        if (more == NULL)
            return CV_FAILED;
        list->panel = more;
        list->room = room;
    }
    list->panel[list->count++] = *p;
    return CV_OK;
}

/* What the series leaves out is about its last terms; they fall off geometrically. */
static double left_out(const sa_panel *p)
{
    return 2 * p->half * (cabs(p->c[SA_PANEL_NODES - 1]) + cabs(p->c[SA_PANEL_NODES - 2]));
}

static cv_status panels_between(build *b, double from, double to, int depth)
{
    const double rounding = 1e-14;
    sa_panel p;
    if (b->out->count >= SA_PANELS_MAX)
        return CV_UNDECIDED;
    cv_status status = panel_set(&p, b, from, to);
    if (status != CV_OK)
        return status;
    double size = 2 * p.half * cabs(p.c[0]);
    if (left_out(&p) <= fmax(b->tolerance, rounding * size) || depth == 0) {
        b->out->error += left_out(&p) + rounding * size;
        return append(b->out, &p);
    }
    status = panels_between(b, from, p.middle, depth - 1);
    return status == CV_OK ? panels_between(b, p.middle, to, depth - 1) : status;
}

/* First panels grow with x, so that nothing hides between their nodes that is not narrow beside them. */
static cv_status all_panels(build *b)
{
    enum { DEPTH_MAX = 30 };
    const double growth = 0.35, xi = b->image->xi;
    const double largest = fmax(1e4, 1e7 / (1 + xi * xi)); /* e^{i p xi} oscillates as sqrt(2 x) xi */
    double from = 0;
    double complex w = 0;
    cv_status status = CV_OK;
    do {
        double to = from + growth * from + b->image->height;
        status = panels_between(b, from, to, DEPTH_MAX);
        from = to;
        if (status == CV_OK)
            status = image_at(&w, &b->at_load, from); /* beside it, W may be tiny before waves begin */
    } while (status == CV_OK && from < largest && !(cabs(w) * from < b->tolerance));
    b->out->end = from;
    b->out->tail = cabs(w);
    return status;
}

cv_status sa_panels_build(sa_panels *out, const sa_image *image, cv_message *why)
{
    const double share = 1e-14;
    build b = {.image = image, .at_load = *image, .out = out};
    double complex start = 0;
    b.at_load.xi = 0;
    *out = (sa_panels){0};
    if (!rule_set(&b.rule))
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = image_at(&start, &b.at_load, 0);
    b.tolerance = share * cabs(start) * image->height;
    if (status == CV_OK)
        status = all_panels(&b);
    if (status == CV_OK)
        return CV_OK;
    sa_panels_clear(out);
    return cv_fail(why, status, "K(xi, q) is not to be had along the line");
}

void sa_panels_clear(sa_panels *p)
{
    free(p->panel);
    *p = (sa_panels){0};
}

/* j_0(x) .. j_15(x): upward where that is stable */
static int bessel(double j[SA_PANEL_NODES], double x)
{
    if (x < 2 * SA_PANEL_NODES)
        return gsl_sf_bessel_jl_steed_array(SA_PANEL_NODES - 1, x, j) == 0;
    j[0] = sin(x) / x;
    j[1] = (j[0] - cos(x)) / x;
    for (int n = 1; n + 1 < SA_PANEL_NODES; n++)
        j[n + 1] = (2 * n + 1) / x * j[n] - j[n - 1];
    return 1;
}

/* The integral of P_n(u) e^{i omega u} over -1 .. 1 is 2 i^n j_n(omega). The rest beyond the last panel is
 * below |W| times the length 1/tau of half a wave, or end/1.5 for tau = 0. */
cv_status sa_panels_integrate(double complex *integral, double *error, const sa_panels *p, double tau)
{
    double j[SA_PANEL_NODES];
    *integral = 0;
    for (size_t k = 0; k < p->count; k++) {
        const sa_panel *panel = &p->panel[k];
        double complex sum = 0, power = 1;
        if (!bessel(j, panel->half * tau))
            return CV_FAILED;
        for (int n = 0; n < SA_PANEL_NODES; n++, power *= CMPLX(0, 1))
            sum += panel->c[n] * power * j[n];
        *integral += 2 * panel->half * sum * cexp(CMPLX(0, panel->middle * tau));
    }
    *error = p->error + p->tail * (tau * p->end > 2 ? 2 / tau : p->end);
    return CV_OK;
}
