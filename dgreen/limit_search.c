#include "dgreen/limit_search.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dgreen/winding.h"

/* Crossings are listed down to this part of 1/eta_M; distance from a special velocity, in parts of it;
 * velocities per decade of that distance; parts of an interval's end distance below which what differs is
 * left. */
static const double FLOOR = 0.3, BESIDE = 1e-9, RATIO = 30, NARROW = 1e-3;
enum { EVEN = 10, HUNT = 60 };

struct dg_limit_look {
    double alpha;
    size_t count;
    dg_crossing *crossings; /* above the lowest floor; owned */
    int *roots;             /* by mass; -1: not certain there. NULL: the curve cannot be had. Owned */
};

/* The curve at one velocity, for one mass ratio. */
typedef struct {
    double alpha;
    int roots;
    size_t count;
    dg_crossing *crossings; /* those above the floor but for infinite ones; owned */
    size_t infinite;
} column;

typedef struct {
    dg_limit_search *search;
    dg_limit_mass *mass;
    dg_curve curve;
    double low, high; /* of the interval between special velocities */
} hunt;

static cv_status push(hunt *h, const dg_find *find, int jump)
{
    dg_limit_mass *m = h->mass;
    if (m->count == m->room) {
        const size_t room = m->room ? 2 * m->room : 16;
        dg_limit_event *grown = realloc(m->events, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(h->search->why, CV_FAILED, "out of memory");
        m->events = grown;
        m->room = room;
    }
    m->events[m->count++] = (dg_limit_event){*find, jump};
    return CV_OK;
}

static void doubt(hunt *h, const char *reason, double a, double b)
{
    if (h->mass->status == CV_OK)
        h->mass->status =
            cv_fail(&h->mass->why, CV_UNDECIDED, "%s between alpha = %.17g and %.17g", reason, a, b);
}

static cv_status count_all(dg_limit_look *l, hunt *h)
{
    const dg_limit_search *s = h->search;
    cv_message ignored;
    l->roots = calloc(s->mass_count, sizeof *l->roots);
    if (l->roots == NULL)
        return cv_fail(s->why, CV_FAILED, "out of memory");
    for (size_t k = 0; k < s->mass_count; k++) {
        cv_status status = dg_curve_separate(&h->curve, &s->probe, s->masses[k].x, &ignored);
        if (status == CV_OK)
            status = dg_winding(&l->roots[k], &h->curve, s->masses[k].x, &ignored);
        if (status == CV_FAILED)
            return cv_fail(s->why, CV_FAILED, "out of memory");
        if (status != CV_OK)
            l->roots[k] = -1;
    }
    l->count = h->curve.crossing_count;
    l->crossings = calloc(l->count + 1, sizeof *l->crossings);
    if (l->crossings == NULL)
        return cv_fail(s->why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < l->count; i++)
        l->crossings[i] = h->curve.crossings[i];
    return CV_OK;
}

/* One curve serves all masses: it is sampled once at each velocity. */
static cv_status look_at(const dg_limit_look **out, hunt *h, double alpha)
{
    dg_limit_search *s = h->search;
    cv_message ignored;
    double floor = INFINITY;
    for (size_t i = 0; i < s->look_count; i++)
        if (s->looks[i].alpha == alpha) {
            *out = &s->looks[i];
            return CV_OK;
        }
    if (s->look_count == s->look_room) {
        const size_t room = 2 * s->look_room + 256;
        dg_limit_look *grown = realloc(s->looks, room * sizeof *grown);
        if (grown == NULL)
            return cv_fail(s->why, CV_FAILED, "out of memory");
        s->looks = grown;
        s->look_room = room;
    }
    dg_limit_look *l = &s->looks[s->look_count++];
    *l = (dg_limit_look){.alpha = alpha};
    *out = l;
    for (size_t k = 0; k < s->mass_count; k++)
        floor = fmin(floor, FLOOR * s->masses[k].x);
    cv_status status = dg_curve_at(&h->curve, &s->probe, alpha, floor, &ignored);
    if (status == CV_FAILED)
        return cv_fail(s->why, CV_FAILED, "out of memory");
    return status == CV_OK ? count_all(l, h) : CV_OK;
}

/* CV_UNDECIDED: the curve or N cannot be had at this velocity; c is then empty. */
static cv_status look(column *c, hunt *h, double alpha)
{
    const dg_limit_look *l;
    const size_t mass = (size_t)(h->mass - h->search->masses);
    *c = (column){.alpha = alpha};
    cv_status status = look_at(&l, h, alpha);
    if (status != CV_OK)
        return status;
    if (l->roots == NULL || l->roots[mass] < 0)
        return CV_UNDECIDED;
    c->roots = l->roots[mass];
    c->crossings = calloc(l->count + 1, sizeof *c->crossings);
    if (c->crossings == NULL)
        return cv_fail(h->search->why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < l->count; i++) {
        if (isinf(l->crossings[i].x))
            c->infinite++;
        else if (l->crossings[i].x > FLOOR * h->mass->x)
            c->crossings[c->count++] = l->crossings[i];
    }
    return CV_OK;
}

/* Near alpha where it cannot be had there: a transition to double precision. */
static cv_status look_near(column *c, hunt *h, double alpha, double room)
{
    enum { TRIES = 6 };
    cv_status status = look(c, h, alpha);
    for (int i = 1; i <= TRIES && status == CV_UNDECIDED; i++)
        status = look(c, h, alpha + (i % 2 ? 1 : -1) * room * i / (2 * TRIES + 2));
    return status;
}

/* Between a and b no crossing passes x unseen: they are the same ones, and each that may turn between them
 * stays clear of x. */
static int alike(const column *a, const column *b, double x)
{
    const double clear = 2;
    if (a->count != b->count || a->infinite != b->infinite)
        return 0;
    for (size_t i = 0; i < a->count; i++) {
        const dg_crossing *p = &a->crossings[i], *q = &b->crossings[i];
        const double way = b->alpha - a->alpha, most = fmax(fabs(p->dx), fabs(q->dx)) * way;
        const int turns = p->dx * q->dx <= 0, far = fmin(fabs(p->x - x), fabs(q->x - x)) > clear * most;
        if (p->direction != q->direction || (turns && !far && (p->x > x) == (q->x > x)))
            return 0;
    }
    return 1;
}

/* The crossing that is on one side of x in a and on the other in b; count: none or several */
static size_t passing(const column *a, const column *b, double x)
{
    size_t found = a->count, n = 0;
    for (size_t i = 0; i < a->count; i++)
        if ((a->crossings[i].x > x) != (b->crossings[i].x > x)) {
            found = i;
            n++;
        }
    return n == 1 ? found : a->count;
}

static cv_status add_transition(hunt *h, const column *a, size_t number, int change)
{
    const dg_crossing *c = &a->crossings[number];
    const double x = h->mass->x, way = (x - c->x) / c->dx;
    const double special = fmin(a->alpha - h->low, h->high - a->alpha);
    const double reach = fmin(fmax(special, DBL_EPSILON * a->alpha), fabs(c->x / c->dx));
    const dg_find find = {a->alpha + way, c->q + c->dq * way, c->dq, c->dx, c->scale, reach, change, 0};
    return push(h, &find, 0);
}

/* False position on x of the one crossing that passes, with halving. */
static cv_status close_in(hunt *h, column *a, column *b, size_t number)
{
    const double near = 1e-9, x = h->mass->x;
    const int change = b->roots - a->roots;
    cv_status status = CV_OK;
    for (int i = 0; i < HUNT && status == CV_OK; i++) {
        const double fa = log(a->crossings[number].x / x), fb = log(b->crossings[number].x / x);
        const double part = i % 3 == 2 ? 0.5 : fmin(fmax(fa / (fa - fb), 0.01), 0.99);
        column m;
        if (fmin(fabs(fa), fabs(fb)) < near || b->alpha - a->alpha < 4 * DBL_EPSILON * b->alpha)
            break;
        status = look_near(&m, h, a->alpha + part * (b->alpha - a->alpha), 1e-3 * (b->alpha - a->alpha));
        if (status != CV_OK)
            break;
        if (m.count != a->count) {
            free(m.crossings);
            status = CV_UNDECIDED;
            break;
        }
        column *replaced = (m.crossings[number].x > x) == (a->crossings[number].x > x) ? a : b;
        free(replaced->crossings);
        *replaced = m;
    }
    if (status == CV_FAILED)
        return status;
    const column *best =
        fabs(log(a->crossings[number].x / x)) < fabs(log(b->crossings[number].x / x)) ? a : b;
    return add_transition(h, best, number, change);
}

/* Halves the interval until nothing is left to find in it. Frees the crossings of neither end. */
static cv_status search(hunt *h, const column *a, const column *b)
{
    const double x = h->mass->x, way = b->alpha - a->alpha;
    const double end = fmax(fmin(a->alpha - h->low, h->high - b->alpha), BESIDE * a->alpha);
    const int same = alike(a, b, x), narrow = way < NARROW * fmin(end, h->high - h->low);
    if (a->roots == b->roots && (same || narrow))
        return CV_OK;
    const size_t number = same ? passing(a, b, x) : a->count;
    if (number < a->count) {
        column from = *a, to = *b;
        from.crossings = calloc(a->count + 1, sizeof *from.crossings);
        to.crossings = calloc(b->count + 1, sizeof *to.crossings);
        cv_status status = from.crossings != NULL && to.crossings != NULL ? CV_OK : CV_FAILED;
        if (status == CV_OK) {
            memcpy(from.crossings, a->crossings, a->count * sizeof *a->crossings);
            memcpy(to.crossings, b->crossings, b->count * sizeof *b->crossings);
            status = close_in(h, &from, &to, number);
        }
        free(from.crossings);
        free(to.crossings);
        return status;
    }
    if (way < 8 * DBL_EPSILON * b->alpha) {
        doubt(h, "N changes, and no crossing passes", a->alpha, b->alpha);
        return CV_OK;
    }
    column m;
    cv_status status = look_near(&m, h, a->alpha + way / 2, way);
    if (status == CV_UNDECIDED) {
        doubt(h, "the curve cannot be had", a->alpha, b->alpha);
        return CV_OK;
    }
    if (status == CV_OK)
        status = search(h, a, &m);
    if (status == CV_OK)
        status = search(h, &m, b);
    free(m.crossings);
    return status;
}

static int ascending(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

/* Velocities from low to high, graded towards both; room for them is allocated. */
static double *velocities(size_t *count, const hunt *h, double first)
{
    const double width = h->high - h->low, ratio = pow(RATIO, 1 / ldexp(1, h->search->look));
    const size_t most = 2 * (size_t)(log(width / first) / log(ratio) + 2) + (EVEN << h->search->look) + 2;
    double *at = calloc(most, sizeof *at);
    size_t n = 0;
    *count = 0;
    if (at == NULL)
        return NULL;
    at[n++] = h->low + first;
    at[n++] = h->high - first;
    for (double d = first * ratio; d < width / 2 && n + 2 < most; d *= ratio) {
        at[n++] = h->low + d;
        at[n++] = h->high - d;
    }
    for (int i = 1; i < EVEN << h->search->look && n < most; i++)
        at[n++] = h->low + width * i / (EVEN << h->search->look);
    qsort(at, n, sizeof *at, ascending);
    *count = n;
    return at;
}

/* Between two special velocities, of which one or both may be an end of the range; N at both ends in roots.
 */
static cv_status search_interval(int roots[2], hunt *h)
{
    const double first = fmin(BESIDE * h->high, (h->high - h->low) / 8);
    size_t n;
    double *at = velocities(&n, h, first);
    column a, b;
    if (at == NULL)
        return cv_fail(h->search->why, CV_FAILED, "out of memory");
    cv_status status = look_near(&a, h, at[0], first);
    roots[0] = roots[1] = a.roots;
    for (size_t i = 1; i < n && status == CV_OK; i++) {
        if (!(at[i] > a.alpha))
            continue;
        status = look_near(&b, h, at[i], fmin(first, at[i] - a.alpha));
        if (status == CV_OK)
            status = search(h, &a, &b);
        if (status != CV_OK)
            break;
        free(a.crossings);
        a = b;
        roots[1] = a.roots;
    }
    free(a.crossings);
    free(at);
    if (status == CV_UNDECIDED)
        doubt(h, "the curve cannot be had", h->low, h->high);
    return status == CV_UNDECIDED ? CV_OK : status;
}

static cv_status search_mass(dg_limit_search *s, dg_limit_mass *mass, double alpha_min, double alpha_max)
{
    size_t n;
    const dg_special_velocity *special = dg_special_velocities(&n, s->probe.branches);
    hunt h = {.search = s, .mass = mass, .high = alpha_min};
    int before = 0;
    cv_status status = CV_OK;
    for (size_t i = 0; i <= n && status == CV_OK; i++) {
        int roots[2] = {0, 0};
        h.low = h.high;
        h.high = i < n ? special[i].alpha : alpha_max;
        if (!(h.high - h.low > 4 * DBL_EPSILON * h.high))
            continue;
        status = search_interval(roots, &h);
        if (i == 0)
            mass->count_at_min = roots[0];
        else if (status == CV_OK && roots[0] != before) {
            const dg_find jump = {.alpha = h.low, .change = roots[0] - before};
            status = push(&h, &jump, 1);
            /* the changes of this interval are already listed */
            for (size_t k = mass->count - 1; k > 0 && mass->events[k - 1].find.alpha > h.low; k--) {
                const dg_limit_event swap = mass->events[k];
                mass->events[k] = mass->events[k - 1];
                mass->events[k - 1] = swap;
            }
        }
        before = roots[1];
    }
    dg_curve_clear(&h.curve);
    return status;
}

cv_status dg_limit_search_run(dg_limit_search *s, double alpha_min, double alpha_max)
{
    cv_status status = CV_OK;
    for (size_t k = 0; k < s->mass_count && status == CV_OK; k++)
        status = search_mass(s, &s->masses[k], alpha_min, alpha_max);
    for (size_t i = 0; i < s->look_count; i++) {
        free(s->looks[i].crossings);
        free(s->looks[i].roots);
    }
    free(s->looks);
    s->looks = NULL;
    return status;
}
