/* What a line does beyond the highest velocity of the range. */
#include <math.h>

#include "dgreen/lines_graph.h"

/* The line is followed to this many times the highest velocity, in steps of at most this part of alpha and at
 * least of the other; x and the position may change by so much in one step. */
static const double HIGHEST = 50, LARGEST_STEP = 0.03, LEAST_STEP = 1e-5, LOG_X = 0.5, POSITION = 1;
/* It runs to zero mass when, beyond so many times the highest velocity, x grows and is this many times the
 * greatest one of the range. */
static const double FAR = 3, GROWN = 100;

typedef struct {
    dg_probe probe;
    dg_station station;
    dg_followed last, here;
    size_t hard_count; /* at here */
} follower;

/* The crossing at alpha, where the last two lead: by position, or by log q where the branch points differ */
static cv_status step(dg_followed *next, follower *f, double alpha)
{
    const dg_followed *a = &f->last, *b = &f->here;
    dg_followed beyond = *b;
    beyond.alpha = 2 * alpha - b->alpha;
    if (a->alpha < b->alpha) {
        const double part = (beyond.alpha - b->alpha) / (b->alpha - a->alpha);
        beyond.at.position += part * (b->at.position - a->at.position);
        beyond.at.q *= pow(b->at.q / a->at.q, part);
    }
    next->alpha = alpha;
    cv_status status = dg_station_set(&f->station, f->probe.branches, alpha, NULL);
    const size_t hard_count = f->station.hard_count;
    const int alike = hard_count == f->hard_count;
    if (status == CV_OK)
        status = dg_crossing_between(next, &f->station, &f->probe, b, &beyond, alike, NULL);
    if (status != CV_OK || !(fabs(log(next->at.x / b->at.x)) < LOG_X) ||
        (alike && fabs(next->at.position - b->at.position) > POSITION))
        return CV_UNDECIDED;
    f->hard_count = hard_count;
    return CV_OK;
}

static int follow(follower *f, double alpha_far, double alpha_end, double x_end)
{
    double part = LARGEST_STEP / 8;
    while (f->here.alpha < alpha_end && part > LEAST_STEP) {
        dg_followed next;
        if (step(&next, f, f->here.alpha * (1 + part)) != CV_OK) {
            part /= 4;
            continue;
        }
        f->last = f->here;
        f->here = next;
        part = fmin(1.5 * part, LARGEST_STEP);
        if (f->here.alpha > alpha_far && f->here.at.x > x_end && f->here.at.x > f->last.at.x)
            return 1;
    }
    return 0;
}

int dg_line_runs_to_zero_mass(const dg_line_graph *g, const dg_followed *h)
{
    dg_branch_curves *branches = NULL;
    const double alpha_end = HIGHEST * g->alpha_max;
    if (dg_branch_curves_new(&branches, g->track, 0.9 * g->alpha_max, alpha_end * (1 + LARGEST_STEP), NULL) !=
        CV_OK)
        return 0;
    follower f = {.probe = {g->track, g->follow, branches, 0}, .last = *h, .here = *h};
    int reached = dg_station_set(&f.station, branches, h->alpha, NULL) == CV_OK;
    f.hard_count = f.station.hard_count;
    f.here.at.position = f.last.at.position = dg_station_position(&f.station, h->at.q);
    reached = reached && follow(&f, FAR * g->alpha_max, alpha_end, GROWN * g->x_max);
    dg_station_clear(&f.station);
    dg_branch_curves_free(branches);
    return reached;
}
