#include "compare/lines.h"

#include <math.h>

/* In parts of the range: further apart the polylines are not of one line, whatever their chord errors. */
static const double PLOT_TOLERANCE = 5e-3;
/* Relative, for what a method states without a bound. */
static const double UNBOUNDED = 1e-6;
/* Where the other method looks for the point of a vertex, relative: first, and if nothing is there. */
static const double REACH[] = {1e-12, 1e-7, 1e-4};
enum { REACHES = sizeof REACH / sizeof *REACH };
/* Next to a turning point another arm of the line is near: there it looks within so many times the bound
 * first, but not nearer than this, relative. */
static const double BOUNDS = 1e3, NEAREST = 1e-24;

typedef struct {
    cmp_branch_pair *pair;
    const cmp_line_method *const *methods;
    void *const *handles;
    int digits;
    double log_range; /* of eta_M */
    cv_message *why;
} judge;

static const char *end_name(const cmp_line_end *e)
{
    static const char *const names[] = {"nowhere",           "the lowest velocity", "the highest velocity",
                                        "the smallest mass", "the greatest mass",   "an undecided end"};
    return names[e->kind];
}

static void judge_asymptotes(cmp_verdict *v, const cmp_line_end *a, const cmp_line_end *b)
{
    const double bound = a->asymptote_error + b->asymptote_error;
    const double allowed = isnan(bound) ? UNBOUNDED * fabs(a->asymptote) : bound;
    const double off = fabs(a->asymptote - b->asymptote), rounding = 4e-16 * fabs(a->asymptote);
    if (!(off <= allowed + rounding) ||
        !(fabs(a->asymptote_q - b->asymptote_q) <= UNBOUNDED * fabs(a->asymptote_q)))
        cmp_verdict_worsen(v, CMP_DISAGREE,
                           "eta_M grows to infinity at alpha = %.15g, q = %.10g and at %.15g, %.10g",
                           a->asymptote, a->asymptote_q, b->asymptote, b->asymptote_q);
}

static void judge_ends(const judge *j, const cmp_branch *a, const cmp_branch *b)
{
    cmp_verdict *v = &j->pair->verdict;
    for (int e = 0; e < 2; e++) {
        const cmp_line_end *x = &a->ends[e], *y = &b->ends[e];
        if (x->kind == CMP_END_UNDECIDED || y->kind == CMP_END_UNDECIDED)
            cmp_verdict_worsen(v, CMP_UNDECIDED, "an end of the branch is undecided by %s",
                               j->methods[x->kind != CMP_END_UNDECIDED]->name);
        else if (x->kind != y->kind)
            cmp_verdict_worsen(v, CMP_DISAGREE, "the branch %s at %s by %s, at %s by %s",
                               e == 0 ? "begins" : "ends", end_name(x), j->methods[0]->name, end_name(y),
                               j->methods[1]->name);
        else if ((isnan(x->asymptote) && x->open) || (isnan(y->asymptote) && y->open))
            continue; /* outside the range, and the one claims nothing */
        else if (isnan(x->asymptote) != isnan(y->asymptote))
            cmp_verdict_worsen(v, CMP_UNDECIDED, "only %s knows of the asymptote at alpha = %.15g",
                               j->methods[isnan(x->asymptote)]->name,
                               isnan(x->asymptote) ? y->asymptote : x->asymptote);
        else if (!isnan(x->asymptote))
            judge_asymptotes(v, x, y);
    }
}

static size_t turns(const cmp_branch *b)
{
    size_t n = 0;
    for (size_t i = 0; i < b->count; i++)
        n += b->vertices[i].turns && !(i > 0 && i + 1 == b->count && b->ends[0].kind == CMP_END_CLOSED);
    return n;
}

/* A least mass without a bound is that of a vertex: the polyline's chord error from the truth. */
static void judge_extremes(const judge *j, const cmp_branch *a, const cmp_branch *b)
{
    cmp_verdict *v = &j->pair->verdict;
    const double bound = a->least_mass_error + b->least_mass_error;
    const double off = fabs(log(a->least_mass / b->least_mass));
    if (!(off <= (isnan(bound) ? PLOT_TOLERANCE * j->log_range : bound + 4e-16)))
        cmp_verdict_worsen(v, CMP_DISAGREE, "smallest eta_M %.15g by %s, %.15g by %s", a->least_mass,
                           j->methods[0]->name, b->least_mass, j->methods[1]->name);
    if (turns(a) != turns(b))
        cmp_verdict_worsen(v, CMP_DISAGREE, "%zu turning points by %s, %zu by %s", turns(a),
                           j->methods[0]->name, turns(b), j->methods[1]->name);
    if (!(j->pair->plot_distance <= PLOT_TOLERANCE))
        cmp_verdict_worsen(v, CMP_DISAGREE, "the polylines are %.2g of the range apart",
                           j->pair->plot_distance);
}

static int usable(const cmp_line_point *p)
{
    return mpfr_regular_p(p->alpha) && mpfr_regular_p(p->q) && mpfr_regular_p(p->eta_M) &&
           mpfr_sgn(p->alpha) > 0 && mpfr_sgn(p->q) > 0 && mpfr_sgn(p->eta_M) > 0;
}

/* One coordinate of two points with absolute bounds; a bound of 0 is raised to a unit in the last place of
 * the more precise of the two. */
static void judge_one(cmp_verdict *v, const char *what, mpfr_srcptr x, double x_error, mpfr_srcptr y,
                      double y_error, int digits)
{
    mpfr_t a, b, unit;
    mpfr_inits2(53, a, b, unit, (mpfr_ptr)0);
    const mpfr_prec_t least = mpfr_get_prec(x) < mpfr_get_prec(y) ? mpfr_get_prec(x) : mpfr_get_prec(y);
    mpfr_set_ui_2exp(unit, 1, mpfr_get_exp(x) - (mpfr_exp_t)least, MPFR_RNDU);
    mpfr_set_d(a, x_error, MPFR_RNDU);
    mpfr_set_d(b, y_error, MPFR_RNDU);
    mpfr_max(a, a, unit, MPFR_RNDU);
    mpfr_max(b, b, unit, MPFR_RNDU);
    if (isnan(x_error) || isnan(y_error))
        mpfr_set_nan(a);
    cmp_judge_coordinate(v, what, (const mpfr_srcptr[]){x, y}, (const mpfr_srcptr[]){a, b}, digits);
    mpfr_clears(a, b, unit, (mpfr_ptr)0);
}

static double relative(mpfr_srcptr x, mpfr_srcptr y)
{
    mpfr_t d;
    mpfr_init2(d, 64);
    mpfr_sub(d, x, y, MPFR_RNDA);
    mpfr_div(d, d, x, MPFR_RNDA);
    const double r = fabs(mpfr_get_d(d, MPFR_RNDA));
    mpfr_clear(d);
    return r;
}

/* Two points at the same given coordinate. */
static void judge_points(const judge *j, int by_q, const cmp_line_point *a, const cmp_line_point *b)
{
    cmp_branch_pair *pair = j->pair;
    if (!by_q) {
        judge_one(&pair->verdict, "q", a->q, a->q_error, b->q, b->q_error, j->digits);
        pair->difference = fmax(pair->difference, relative(a->q, b->q));
    } else {
        judge_one(&pair->verdict, "alpha", a->alpha, a->alpha_error, b->alpha, b->alpha_error, j->digits);
        pair->difference = fmax(pair->difference, relative(a->alpha, b->alpha));
    }
    judge_one(&pair->verdict, "eta_M", a->eta_M, a->eta_M_error, b->eta_M, b->eta_M_error, j->digits);
    pair->difference = fmax(pair->difference, relative(a->eta_M, b->eta_M));
    pair->vertices++;
}

static int within(mpfr_srcptr claimed, mpfr_srcptr found, double bound)
{
    const double size = fabs(mpfr_get_d(found, MPFR_RNDN));
    return relative(found, claimed) * size <= (isnan(bound) ? UNBOUNDED * size : bound) + 4e-16 * size;
}

/* What a vertex claims against the point of its own method at the same coordinate: within its bounds where
 * that coordinate is exact, else not far off; undecided where the method does not vouch for it. A mass
 * without a bound is left to the distance of the polylines: it may change with alpha and q faster than
 * doubles resolve. */
static void judge_vertex(const judge *j, int m, int by_q, const cmp_line_point *vertex,
                         const cmp_line_point *own)
{
    const int exact = (by_q ? vertex->q_error : vertex->alpha_error) <= 0;
    const double bound = exact ? (by_q ? vertex->alpha_error : vertex->q_error) : (double)NAN;
    const double mass_bound = exact ? vertex->eta_M_error + own->eta_M_error : (double)NAN;
    if (!within(by_q ? vertex->alpha : vertex->q, by_q ? own->alpha : own->q, bound) ||
        !(isnan(vertex->eta_M_error) || within(vertex->eta_M, own->eta_M, mass_bound)))
        cmp_verdict_worsen(&j->pair->verdict, vertex->decided == CV_OK ? CMP_DISAGREE : CMP_UNDECIDED,
                           "the vertex of %s at alpha = %.15g, q = %.15g is not on its line",
                           j->methods[m]->name, mpfr_get_d(vertex->alpha, MPFR_RNDN),
                           mpfr_get_d(vertex->q, MPFR_RNDN));
}

/* The point of method m at the given coordinate next to where the other coordinate was claimed. *found: 0
 * where it has none, within any reach. */
static cv_status point_near(cmp_line_point *out, int *found, const judge *j, int m, int by_q,
                            const cmp_line_point *claim)
{
    mpfr_srcptr given = by_q ? claim->q : claim->alpha, start = by_q ? claim->alpha : claim->q;
    const double size = mpfr_get_d(start, MPFR_RNDN), bound = by_q ? claim->alpha_error : claim->q_error;
    cv_status status = CV_UNDECIDED;
    *found = 0;
    for (int r = claim->turns && !isnan(bound) ? -1 : 0; r < REACHES && !*found; r++) {
        const double reach = r < 0 ? fmax(BOUNDS * bound, NEAREST * size) : REACH[r] * size;
        status = j->methods[m]->point(j->handles[m], out, by_q, given, start, reach, j->digits, j->why);
        if (status != CV_OK && status != CV_UNDECIDED)
            return status;
        *found = status == CV_OK && out->decided == CV_OK && usable(out);
    }
    j->why->text[0] = '\0';
    return CV_OK;
}

/* The vertex already is a point to the digits asked for at an exact coordinate. */
static int has_digits(const cmp_line_point *v, int by_q, int digits)
{
    const double share = pow(10, -digits);
    const double given = by_q ? v->q_error : v->alpha_error, sought = by_q ? v->alpha_error : v->q_error;
    return given <= 0 && v->decided == CV_OK &&
           sought <= share * mpfr_get_d(by_q ? v->alpha : v->q, MPFR_RNDN) &&
           v->eta_M_error <= share * mpfr_get_d(v->eta_M, MPFR_RNDN);
}

static void not_found(const judge *j, int m, const cmp_line_point *at)
{
    cmp_verdict_worsen(&j->pair->verdict, CMP_UNDECIDED,
                       "%s does not put alpha = %.15g, q = %.15g on a line to %d digits", j->methods[m]->name,
                       mpfr_get_d(at->alpha, MPFR_RNDN), mpfr_get_d(at->q, MPFR_RNDN), j->digits);
}

/* A turning point without a bound may be so far beside the true one that its q has no point next to it; that
 * the other method has one there, too, is judged by their number and by the distance of the polylines. */
static int may_be_off(const cmp_line_point *vertex)
{
    return vertex->turns && isnan(vertex->alpha_error);
}

/* Vertex of method m's branch. */
static cv_status compare_vertex(const judge *j, int m, const cmp_line_point *vertex)
{
    cmp_line_point own, other;
    int found = 1, found_other = 0;
    const int by_q = vertex->turns || (vertex->q_error <= 0 && !(vertex->alpha_error <= 0));
    const int ready = has_digits(vertex, by_q, j->digits);
    const cmp_line_point *mine = ready ? vertex : &own;
    if (!usable(vertex)) {
        cmp_verdict_worsen(&j->pair->verdict, CMP_DISAGREE, "%s has a vertex that is not a point",
                           j->methods[m]->name);
        return CV_OK;
    }
    cmp_line_point_init(&own);
    cmp_line_point_init(&other);
    cv_status status = ready ? CV_OK : point_near(&own, &found, j, m, by_q, vertex);
    if (status == CV_OK && found)
        status = point_near(&other, &found_other, j, 1 - m, by_q, mine);
    if (status == CV_OK && found && !ready)
        judge_vertex(j, m, by_q, vertex, &own);
    if (status == CV_OK && found && found_other)
        judge_points(j, by_q, mine, &other);
    else if (status == CV_OK && !may_be_off(vertex))
        not_found(j, found ? 1 - m : m, vertex);
    cmp_line_point_clear(&own);
    cmp_line_point_clear(&other);
    return status;
}

static void judge_alone(const judge *j, const cmp_branches lists[], const cmp_branch *b)
{
    const int by = j->pair->by[0] == NULL;
    const int open = lists[0].status != CV_OK || lists[1].status != CV_OK;
    const cmp_line_point *v = b->count > 0 ? &b->vertices[b->count / 2] : NULL;
    cmp_verdict_worsen(&j->pair->verdict, open ? CMP_UNDECIDED : CMP_DISAGREE,
                       "only %s has the branch through alpha = %.10g, eta_M = %.10g", j->methods[by]->name,
                       v != NULL ? mpfr_get_d(v->alpha, MPFR_RNDN) : (double)NAN,
                       v != NULL ? mpfr_get_d(v->eta_M, MPFR_RNDN) : (double)NAN);
}

cv_status cmp_branches_judge(cmp_branch_pair *pair, const cmp_branches lists[CMP_METHODS],
                             const cmp_line_method *const methods[CMP_METHODS],
                             void *const handles[CMP_METHODS], int digits, cv_message *why)
{
    const double log_range = log(lists[0].mass_max / lists[0].mass_min);
    const judge j = {pair, methods, handles, digits, log_range, why};
    const cmp_branch *a = pair->by[0], *b = pair->by[1];
    if (a == NULL || b == NULL) {
        judge_alone(&j, lists, a != NULL ? a : b);
        return CV_OK;
    }
    judge_ends(&j, a, b);
    judge_extremes(&j, a, b);
    cv_status status = CV_OK;
    for (int m = 0; m < CMP_METHODS; m++)
        for (size_t i = 0; status == CV_OK && i < pair->by[m]->count; i++)
            status = compare_vertex(&j, m, &pair->by[m]->vertices[i]);
    return status;
}
