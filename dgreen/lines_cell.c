/* The velocities between two columns. */
#include <float.h>
#include <math.h>

#include "dgreen/lines_graph.h"
#include "dgreen/velocities.h"

enum { MAX_DEPTH = 60, MAX_CUTS = 1000 };
/* A minimum of |Im zeta| may fall this many times as fast as its slope says; it matters from this part of the
 * least x of the range on */
static const double DIP_SAFETY = 4, DIP_REACH = 0.25;
/* A minimum and the place where a pair was born are the same when their frequencies differ by less than this
 * part of the distance over which zeta changes */
static const double SAME_PLACE = 0.3;

typedef struct {
    dg_line_graph *g;
    const dg_line_column *left, *right;
    dg_line_pairs pairs;
    size_t met[2];                /* turning points that the left and the right column do not reach */
    double place[2][DG_LINE_MAX]; /* and the frequencies there */
} cell;

static int hidden(const dg_line_graph *g, const dg_crossing *c)
{
    return c->x < g->x_hidden;
}

/* The crossings i and i + 1 of one column that have no partners, and meet before the other column */
static cv_status meet(cell *c, const dg_line_column *here, const dg_line_column *there, size_t i, int side)
{
    dg_line_graph *g = c->g;
    const int node = here->first + (int)i;
    if (hidden(g, &here->curve.crossings[i]) && hidden(g, &here->curve.crossings[i + 1])) {
        g->nodes[node].exit[side] = g->nodes[node + 1].exit[side] = DG_LINE_TOP;
        return CV_OK;
    }
    const int beyond = side == DG_LINE_HIGHER; /* index of the column that does not have them */
    return dg_line_turn(&c->place[beyond][c->met[beyond]++], g, node, side, there->curve.at.alpha);
}

static cv_status leave(cell *c, const dg_line_column *here, size_t i, int side)
{
    if (!hidden(c->g, &here->curve.crossings[i]))
        return CV_UNDECIDED;
    c->g->nodes[here->first + (int)i].exit[side] = DG_LINE_TOP;
    return CV_OK;
}

static cv_status link_left(cell *c)
{
    const dg_curve *left = &c->left->curve, *right = &c->right->curve;
    const int alike = left->at.hard_count == right->at.hard_count;
    cv_status status = CV_OK;
    for (size_t i = 0; i < left->crossing_count && status == CV_OK; i++) {
        const int partner = c->pairs.of_left[i];
        if (partner >= 0)
            status = dg_line_follow(c->g, c->left->first + (int)i, c->right->first + partner, alike);
        else if (partner == DG_LINE_MEETS_NEXT)
            status = meet(c, c->left, c->right, i, DG_LINE_HIGHER);
        else if (partner == DG_LINE_ALONE)
            status = leave(c, c->left, i, DG_LINE_HIGHER);
    }
    return status;
}

static cv_status link_right(cell *c)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < c->right->curve.crossing_count && status == CV_OK; i++) {
        if (c->pairs.of_right[i] == DG_LINE_MEETS_NEXT)
            status = meet(c, c->right, c->left, i, DG_LINE_LOWER);
        else if (c->pairs.of_right[i] == DG_LINE_ALONE)
            status = leave(c, c->right, i, DG_LINE_LOWER);
    }
    return status;
}

/* Whether a minimum of |Im zeta| of one column may reach zero inside the cell without a turning point that
 * tells */
static int dips_matter(const cell *c, int which)
{
    const dg_curve *curve = which ? &c->right->curve : &c->left->curve;
    const double width = (c->right->curve.at.alpha - c->left->curve.at.alpha) * (which ? -1 : 1);
    for (size_t i = 0; i < curve->dip_count; i++) {
        const dg_dip *d = &curve->dips[i];
        if (d->re < DIP_REACH * c->g->x_hidden || d->im * d->d_im * width > 0 ||
            fabs(d->im) > DIP_SAFETY * fabs(d->d_im * width))
            continue;
        int known = 0;
        for (size_t k = 0; k < c->met[which]; k++)
            known |= fabs(c->place[which][k] - d->q) < SAME_PLACE * dg_station_scale(&curve->at, d->q);
        if (!known)
            return 1;
    }
    return 0;
}

/* One attempt without a column in between. CV_UNDECIDED: there must be one. */
static cv_status attempt(cell *c)
{
    if (!dg_line_align(&c->pairs, &c->left->curve, &c->right->curve, c->g->x_floor))
        return CV_UNDECIDED;
    cv_status status = link_left(c);
    if (status == CV_OK)
        status = link_right(c);
    if (status == CV_OK && (dips_matter(c, 0) || dips_matter(c, 1)))
        status = CV_UNDECIDED;
    return status;
}

/* Takes back what an attempt has done. */
static void undo(cell *c, size_t node_count)
{
    dg_line_graph *g = c->g;
    g->node_count = node_count;
    for (int side = 0; side < 2; side++) {
        const dg_line_column *column = side == DG_LINE_HIGHER ? c->left : c->right;
        for (size_t i = 0; i < column->curve.crossing_count; i++) {
            dg_line_node *n = &g->nodes[column->first + (int)i];
            n->link[side] = DG_LINE_NONE;
            n->exit[side] = DG_LINE_UNDECIDED;
        }
    }
}

static cv_status search(dg_line_graph *g, const dg_line_column *left, const dg_line_column *right, int depth);

/* A column between low and high: half way in the logarithm of the distance from a special velocity; where the
 * curve cannot be evaluated, elsewhere. */
static cv_status middle_column(dg_line_column *middle, dg_line_graph *g, double low, double high)
{
    static const double ELSEWHERE[] = {0.31, 0.69};
    cv_status status = dg_line_column_at(middle, g, dg_velocities_middle(g->probe.branches, low, high));
    for (int i = 0; i < 2 && status == CV_UNDECIDED; i++)
        status = dg_line_column_at(middle, g, low + ELSEWHERE[i] * (high - low));
    return status;
}

static cv_status cut(dg_line_graph *g, const dg_line_column *left, const dg_line_column *right, int depth)
{
    dg_line_column middle = {0};
    cv_status status = middle_column(&middle, g, left->curve.at.alpha, right->curve.at.alpha);
    g->cuts++;
    if (status == CV_OK) {
        status = search(g, left, &middle, depth - 1);
        if (status == CV_OK)
            status = search(g, &middle, right, depth - 1);
    } else if (status == CV_UNDECIDED) {
        status = dg_line_doubt_add(g, left->curve.at.alpha, right->curve.at.alpha, g->why->text);
        g->why->text[0] = '\0';
    }
    dg_curve_clear(&middle.curve);
    return status;
}

static cv_status search(dg_line_graph *g, const dg_line_column *left, const dg_line_column *right, int depth)
{
    cell c = {.g = g, .left = left, .right = right};
    const double low = left->curve.at.alpha, high = right->curve.at.alpha;
    const size_t before = g->node_count;
    const cv_status status = attempt(&c);
    if (status != CV_UNDECIDED)
        return status;
    undo(&c, before);
    if (depth == 0 || g->cuts == MAX_CUTS || high - low <= 8 * DBL_EPSILON * high)
        return dg_line_doubt_add(g, low, high, "crossings that cannot be followed");
    return cut(g, left, right, depth);
}

cv_status dg_line_cell(dg_line_graph *g, const dg_line_column *left, const dg_line_column *right)
{
    g->cuts = 0;
    return search(g, left, right, MAX_DEPTH);
}
