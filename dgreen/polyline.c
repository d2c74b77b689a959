#include "dgreen/polyline.h"

#include <math.h>
#include <stdlib.h>

enum { ROUNDS = 40, MAX_VERTICES = 20000 };
/* Largest turn between refined vertices, and largest sum of turns that leaving out may hide between two that
 * stay, in radians. Chords deviate from the first and last step they replace by at most that sum, so that
 * they turn by at most TURN + 2 HIDDEN < 15 degrees. */
static const double TURN = 0.11, HIDDEN = 0.05;
/* Steps smaller than this part of |z| are not refined, nor intervals smaller than this part of q. */
static const double SMALL = 1e-6, NARROW = 2e-15;

cv_status dg_polyline_push(dg_polyline *line, const dg_vertex *v, cv_message *why)
{
    if (line->count == line->room) {
        const size_t room = line->room ? 2 * line->room : 256;
        dg_vertex *grown = realloc(line->at, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
        line->at = grown;
        line->room = room;
    }
    line->at[line->count++] = *v;
    return CV_OK;
}

void dg_polyline_clear(dg_polyline *line)
{
    free(line->at);
    *line = (dg_polyline){0};
}

/* Angle between the steps a-b and b-c, 0 .. pi */
static double turn(const dg_vertex *a, const dg_vertex *b, const dg_vertex *c)
{
    const double x = b->re - a->re, y = b->im - a->im, u = c->re - b->re, v = c->im - b->im;
    return fabs(atan2(x * v - y * u, x * u + y * v));
}

static int bends(const dg_vertex *a, const dg_vertex *b, const dg_vertex *c)
{
    const double before = hypot(b->re - a->re, b->im - a->im), after = hypot(c->re - b->re, c->im - b->im);
    return !(fmin(before, after) <= SMALL * hypot(b->re, b->im)) && turn(a, b, c) > TURN;
}

/* Whether the step after vertex i is to be halved */
static int is_coarse(const dg_polyline *line, size_t i)
{
    const dg_vertex *v = &line->at[i];
    if (!(v[1].q - v->q > NARROW * v->q))
        return 0;
    return (i > 0 && bends(v - 1, v, v + 1)) || (i + 2 < line->count && bends(v, v + 1, v + 2));
}

static cv_status refine_once(dg_polyline *line, const dg_station *station, dg_vertex_rule *rule,
                             void *context, cv_message *why)
{
    dg_polyline finer = {0};
    cv_status status = CV_OK;
    for (size_t i = 0; i < line->count && status == CV_OK; i++) {
        status = dg_polyline_push(&finer, &line->at[i], why);
        if (status != CV_OK || i + 1 == line->count || !is_coarse(line, i))
            continue;
        dg_vertex middle = {dg_station_middle(station, line->at[i].q, line->at[i + 1].q), 0, 0};
        status = rule(&middle, context);
        if (status == CV_OK)
            status = dg_polyline_push(&finer, &middle, why);
        else
            cv_fail(why, status, "z not found at alpha = %.17g, q = %.17g", station->alpha, middle.q);
    }
    dg_polyline_clear(line);
    *line = finer;
    return status;
}

static int crosses(const dg_vertex *a, const dg_vertex *b)
{
    return (a->im > 0) != (b->im > 0);
}

/* The turn at vertex i; none at the ends */
static double turn_at(const dg_polyline *line, size_t i)
{
    return i > 0 && i + 1 < line->count ? turn(&line->at[i - 1], &line->at[i], &line->at[i + 1]) : 0;
}

/* A vertex where the line turns much, being too small to be refined there; its small steps stay small. */
static int beside_corner(const dg_polyline *line, size_t i)
{
    return turn_at(line, i - 1) > TURN || turn_at(line, i + 1) > TURN;
}

/* Leaves out vertices while the turns that vanish so add up to little. */
static cv_status thin(dg_polyline *line, cv_message *why)
{
    dg_polyline thinner = {0};
    double hidden = 0;
    cv_status status = CV_OK;
    for (size_t i = 0; i < line->count && status == CV_OK; i++) {
        const dg_vertex *v = &line->at[i];
        const int inside = i > 0 && i + 1 < line->count;
        if (inside && hidden + turn_at(line, i) <= HIDDEN && !crosses(v - 1, v) && !crosses(v, v + 1) &&
            !beside_corner(line, i)) {
            hidden += turn_at(line, i);
            continue;
        }
        hidden = 0;
        status = dg_polyline_push(&thinner, v, why);
    }
    dg_polyline_clear(line);
    *line = thinner;
    return status;
}

cv_status dg_polyline_shape(dg_polyline *line, const dg_station *station, dg_vertex_rule *rule, void *context,
                            cv_message *why)
{
    for (int round = 0; round < ROUNDS && line->count < MAX_VERTICES; round++) {
        const size_t before = line->count;
        const cv_status status = refine_once(line, station, rule, context, why);
        if (status != CV_OK)
            return status;
        if (line->count == before)
            break;
    }
    return thin(line, why);
}
