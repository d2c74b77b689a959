/* Which crossings of two neighbouring curves belong together: the cheapest edit script that turns one ordered
 * list into the other. Neighbours of opposite direction may meet (or be born) together; one alone may leave
 * through the floor. */
#include <math.h>

#include "dgreen/lines_graph.h"

/* Costs: weight of a difference of position; a pair that meets, and its ratio of x; one that leaves, and its
 * ratio to the floor */
static const double POSITION_WEIGHT = 0.2, MEET = 3, MEET_RATIO = 0.5, LEAVE = 2, LEAVE_RATIO = 1;

typedef struct {
    const dg_curve *left, *right;
    double x_floor;
    int alike; /* positions compare */
    double cost[DG_LINE_MAX + 1][DG_LINE_MAX + 1];
} table;

static double match(const table *t, size_t i, size_t j)
{
    const dg_crossing *a = &t->left->crossings[i], *b = &t->right->crossings[j];
    if (a->direction != b->direction)
        return INFINITY;
    const double apart = t->alike ? POSITION_WEIGHT * fabs(a->position - b->position) : 0;
    return fabs(log(a->x / b->x)) + apart;
}

static double meet(const dg_curve *c, size_t i)
{
    const dg_crossing *a = &c->crossings[i], *b = a + 1;
    return a->direction == b->direction ? HUGE_VAL : MEET + MEET_RATIO * fabs(log(a->x / b->x));
}

static double leave(const table *t, const dg_curve *c, size_t i)
{
    return LEAVE + LEAVE_RATIO * log(c->crossings[i].x / t->x_floor);
}

typedef enum { MATCH, MEET_LEFT, MEET_RIGHT, LEAVE_LEFT, LEAVE_RIGHT, MOVES } move;
static const size_t of_left[MOVES] = {1, 2, 0, 1, 0}, of_right[MOVES] = {1, 0, 2, 0, 1};

/* Cost of the first i crossings on the left and j on the right when the last step is m */
static double after(const table *t, size_t i, size_t j, move m)
{
    if (i < of_left[m] || j < of_right[m])
        return INFINITY;
    const size_t k = i - of_left[m], l = j - of_right[m];
    switch (m) {
    case MATCH:
        return t->cost[k][l] + match(t, k, l);
    case MEET_LEFT:
        return t->cost[k][l] + meet(t->left, k);
    case MEET_RIGHT:
        return t->cost[k][l] + meet(t->right, l);
    case LEAVE_LEFT:
        return t->cost[k][l] + leave(t, t->left, k);
    default:
        return t->cost[k][l] + leave(t, t->right, l);
    }
}

static move best(const table *t, size_t i, size_t j)
{
    move least = MATCH;
    for (move m = MATCH; m < MOVES; m++)
        if (after(t, i, j, m) < after(t, i, j, least))
            least = m;
    return least;
}

static void note(dg_line_pairs *p, size_t i, size_t j, move m)
{
    if (m == MATCH) {
        p->of_left[i] = (int)j;
        p->of_right[j] = (int)i;
    }
    if (m == MEET_LEFT) {
        p->of_left[i] = DG_LINE_MEETS_NEXT;
        p->of_left[i + 1] = DG_LINE_MEETS_LAST;
    }
    if (m == MEET_RIGHT) {
        p->of_right[j] = DG_LINE_MEETS_NEXT;
        p->of_right[j + 1] = DG_LINE_MEETS_LAST;
    }
    if (m == LEAVE_LEFT)
        p->of_left[i] = DG_LINE_ALONE;
    if (m == LEAVE_RIGHT)
        p->of_right[j] = DG_LINE_ALONE;
}

int dg_line_align(dg_line_pairs *p, const dg_curve *left, const dg_curve *right, double x_floor)
{
    size_t i = left->crossing_count, j = right->crossing_count;
    table t = {.left = left, .right = right, .x_floor = x_floor};
    t.alike = left->at.hard_count == right->at.hard_count;
    if (i > DG_LINE_MAX || j > DG_LINE_MAX)
        return 0;
    for (size_t k = 0; k <= i; k++)
        for (size_t l = 0; l <= j; l++)
            t.cost[k][l] = k == 0 && l == 0 ? 0 : after(&t, k, l, best(&t, k, l));
    while (i > 0 || j > 0) {
        const move m = best(&t, i, j);
        i -= of_left[m];
        j -= of_right[m];
        note(p, i, j, m);
    }
    return 1;
}
