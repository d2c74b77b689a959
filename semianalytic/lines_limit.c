/* Lines without damping put together from three kinds of parts: those traced in the map, runs along branch
 * curves (limit_curves.h) and vertical bridges at special velocities (limit_meeting.h). */
#include <math.h>
#include <stdlib.h>

#include "semianalytic/limit_curves.h"
#include "semianalytic/lines_parts.h"

static const size_t NONE = (size_t)-1;

/* An end of a part. */
typedef struct {
    const sa_line_sample *sample;
    long arc;          /* of a line: curve at whose rim it ends; of a run: its curve; -1: none */
    int on_waves;      /* at the rim: on the side of the waves */
    sa_run_end run;    /* RANGE where nothing joins */
    size_t partner;    /* the other end, 2 part + which; NONE */
    int bridged;       /* to the partner, or to infinite mass without one, along alpha = const */
    double bridge[2];  /* alpha, q of the bridge */
    double re;         /* Re zeta at which the bridge begins */
    int marks;         /* of the samples on the bridge */
    sa_line_end final; /* where there is no partner */
} part_end;

typedef struct {
    const sa_line_sample *sample;
    size_t count;
    int reversed;
    int is_run;
    part_end end[2]; /* beginning and end in the direction of the line */
} part;

typedef struct {
    sa_lines *lines;
    sa_curve_runs runs;
    sa_meeting *meeting; /* of every special velocity */
    size_t count;
    part *part;              /* open lines, then runs */
    sa_line_samples samples; /* the result */
    size_t line_count;
    sa_line *line;
    sa_line_end (*end)[2];
} joining;

static cv_status find_meetings(joining *j)
{
    sa_line_store *s = j->lines->store;
    size_t n = s->map.curves.special_count;
    cv_status status = CV_OK;
    j->meeting = calloc(n + 1, sizeof *j->meeting);
    if (j->meeting == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < n && status == CV_OK; ++i) {
        status = sa_meeting_find(&j->meeting[i], &s->map, s->track, i);
        if (status == CV_UNDECIDED)
            status = sa_lines_doubt(j->lines, j->meeting[i].alpha, j->meeting[i].q,
                                    "what lines do at a special velocity is not certain");
    }
    return status;
}

static int ascending(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

static const sa_line_sample *last_sample(const sa_line_store *s, size_t line, int at)
{
    return &s->samples.item[s->line[line].first + (at == 0 ? 0 : s->line[line].count - 1)];
}

static cv_status find_runs(joining *j)
{
    sa_line_store *s = j->lines->store;
    size_t n = 0;
    double *rim = calloc(2 * s->line_count + 1, sizeof *rim);
    if (rim == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < 2 * s->line_count; ++i)
        if (!s->line[i / 2].closed && s->end[i / 2][i % 2].kind == SA_END_CURVE)
            rim[n++] = last_sample(s, i / 2, (int)(i % 2))->alpha;
    qsort(rim, n, sizeof *rim, ascending);
    const double level[2] = {s->plot.re_low, s->plot.re_high};
    cv_status status =
        sa_curve_runs_find(&j->runs, &s->map, s->field, s->re_floor, j->meeting, level, n, rim);
    free(rim);
    if (status == CV_UNDECIDED)
        status = sa_lines_doubt(j->lines, s->map.curves.alpha_min, 0,
                                "Im zeta beside a branch curve is not certain");
    if (status == CV_OK && j->runs.hidden)
        status = sa_lines_doubt(j->lines, j->runs.hidden_at[0], j->runs.hidden_at[1],
                                "a line along waves that hardly move the rail");
    return status;
}

/* The curve at whose rim a line ends. */
static void find_arc(part_end *e, const sa_map *map)
{
    double nearest = 1e-10 * (1 + e->sample->q);
    e->arc = -1;
    for (int i = 0; i < (int)map->curves.arc_count; ++i) {
        double distance = sa_curve_distance(map, i, e->sample->alpha, e->sample->q);
        if (!(fabs(distance) < nearest))
            continue;
        nearest = fabs(distance);
        e->arc = i;
        e->on_waves = distance > 0;
    }
}

/* The closed column at which a line ends; its special velocity with the nearest q. */
static long special_of(const joining *j, const sa_line_sample *s)
{
    const sa_map *map = &j->lines->store->map;
    const double slack = 0.1;
    double nearest = INFINITY;
    long found = SA_COLUMN_PLAIN;
    for (size_t i = 0; i < map->count; ++i) {
        const sa_column *c = &map->column[i];
        double margin = slack * (c->alpha_high - c->alpha_low);
        if (!c->closed || s->alpha < c->alpha_low - margin || s->alpha > c->alpha_high + margin)
            continue;
        for (size_t k = 0; k < map->curves.special_count; ++k) {
            const sa_special *special = &map->curves.special[k];
            double distance = fabs(special->q - s->q);
            if (special->alpha < c->alpha_low || special->alpha > c->alpha_high || !(distance < nearest))
                continue;
            nearest = distance;
            found = (long)k;
        }
    }
    return found;
}

static void set_line_end(part_end *e, const joining *j, size_t line, int at)
{
    const sa_line_store *s = j->lines->store;
    *e =
        (part_end){.sample = last_sample(s, line, at), .arc = -1, .partner = NONE, .final = s->end[line][at]};
    e->re = e->sample->re;
    e->run.alpha = e->sample->alpha;
    if (e->final.kind == SA_END_CURVE) {
        e->run.kind = SA_RUN_RIM;
        find_arc(e, &s->map);
    } else if (e->final.kind == SA_END_SPECIAL) {
        e->run.kind = SA_RUN_SPECIAL;
        e->run.special = special_of(j, e->sample);
    }
}

static void set_run_end(part_end *e, const joining *j, const sa_curve_run *run, int upper)
{
    static const sa_end_kind kind[] = {SA_END_ALPHA_LOW, SA_END_CURVE, SA_END_MASS_HIGH, SA_END_SPECIAL,
                                       SA_END_MASS_HIGH};
    const sa_line_sample *s = &j->runs.samples.item[run->first + (upper ? run->count - 1 : 0)];
    *e = (part_end){.sample = s, .arc = run->arc, .on_waves = !run->zero_mass, .run = run->end[upper]};
    e->re = s->re;
    e->partner = NONE;
    e->final.kind = kind[e->run.kind];
    if (e->run.kind == SA_RUN_RANGE && upper)
        e->final.kind = SA_END_ALPHA_HIGH;
    if (e->run.kind == SA_RUN_SINKS)
        e->final = (sa_line_end){SA_END_MASS_HIGH, SA_BEYOND_ZERO, 0, s->alpha, s->q};
}

static cv_status make_parts(joining *j)
{
    const sa_line_store *s = j->lines->store;
    j->part = calloc(s->line_count + j->runs.count + 1, sizeof *j->part);
    if (j->part == NULL)
        return CV_FAILED;
    for (size_t i = 0; i < s->line_count; ++i) {
        if (s->line[i].closed)
            continue;
        part *p = &j->part[j->count++];
        *p = (part){.sample = &s->samples.item[s->line[i].first], .count = s->line[i].count};
        for (int k = 0; k < 2; ++k)
            set_line_end(&p->end[k], j, i, k);
    }
    for (size_t i = 0; i < j->runs.count; ++i) {
        const sa_curve_run *run = &j->runs.item[i];
        part *p = &j->part[j->count++];
        *p = (part){.sample = &j->runs.samples.item[run->first], .count = run->count, .is_run = 1};
        p->reversed = run->direction < 0;
        for (int k = 0; k < 2; ++k)
            set_run_end(&p->end[k], j, run, p->reversed ? !k : k);
    }
    return CV_OK;
}

static part_end *end_of(const joining *j, size_t end)
{
    return &j->part[end / 2].end[end % 2];
}

static int is_free(const joining *j, size_t end, sa_run_end_kind kind)
{
    const part_end *e = end_of(j, end);
    return e->run.kind == kind && e->partner == NONE && !e->bridged;
}

static void set_bridge(part_end *e, double alpha, double q, int marks)
{
    e->bridged = 1;
    e->bridge[0] = alpha;
    e->bridge[1] = q;
    e->marks = marks;
}

static void to_infinite_mass(part_end *e, double alpha, double q, int marks)
{
    set_bridge(e, alpha, q, marks);
    e->final = (sa_line_end){SA_END_MASS_HIGH, SA_BEYOND_VERTICAL, 0, alpha, q};
}

static void join(const joining *j, size_t a, size_t b, double alpha, double q, int marks)
{
    end_of(j, a)->partner = b;
    end_of(j, b)->partner = a;
    set_bridge(end_of(j, a), alpha, q, marks);
    set_bridge(end_of(j, b), alpha, q, marks);
}

/* Where a run begins or ends at a rim, a line comes to it. Where the waves hardly move the rail, Re zeta at
 * the rim may still be negative: then the line comes from infinite mass within the gap. */
static void join_rim(const joining *j, size_t run)
{
    const double near = 1e-8;
    part_end *e = end_of(j, run);
    size_t found = NONE;
    double nearest = near * e->run.alpha;
    for (size_t i = 0; i < 2 * j->count; ++i) {
        const part_end *f = end_of(j, i);
        double distance = fabs(f->run.alpha - e->run.alpha);
        if (j->part[i / 2].is_run || i % 2 == run % 2 || !is_free(j, i, SA_RUN_RIM) || f->arc != e->arc ||
            f->on_waves != e->on_waves || !(distance < nearest))
            continue;
        nearest = distance;
        found = i;
    }
    if (found != NONE)
        join(j, run, found, e->sample->alpha, e->sample->q, SA_MARK_CURVE);
    else if (!e->on_waves)
        to_infinite_mass(e, e->sample->alpha, e->sample->q, SA_MARK_CURVE);
}

static void join_rims(const joining *j)
{
    for (size_t i = 0; i < 2 * j->count; ++i)
        if (j->part[i / 2].is_run && is_free(j, i, SA_RUN_RIM))
            join_rim(j, i);
}

/* The free end that a terminal stands for; NONE */
static size_t find_terminal(const joining *j, const sa_terminal *t, size_t special)
{
    const double near = 0.05;
    for (size_t i = 0; i < 2 * j->count; ++i) {
        const part_end *e = end_of(j, i);
        int upper = j->part[i / 2].reversed ? i % 2 == 0 : i % 2 == 1; /* of a run, in alpha */
        if (!is_free(j, i, SA_RUN_SPECIAL) || e->run.special != (long)special)
            continue;
        if (t->kind == SA_TERMINAL_CURVE && j->part[i / 2].is_run && !e->on_waves && e->arc == t->arc &&
            upper == (t->side < 0))
            return i;
        if (t->kind == SA_TERMINAL_LINE && isfinite(e->sample->re) && fabs(e->sample->re / t->re - 1) < near)
            return i;
    }
    return NONE;
}

/* Finer cells may help. */
static cv_status part_missing(const joining *j, double alpha, double q)
{
    j->lines->store->torn = 1;
    return sa_lines_doubt(j->lines, alpha, q, "the parts of a line do not meet");
}

static cv_status cross_bridge(const joining *j, size_t special, const sa_bridge *b)
{
    const sa_meeting *m = &j->meeting[special];
    int marks = SA_MARK_VERTICAL | (b->side < 0 ? SA_MARK_BELOW : b->side > 0 ? SA_MARK_ABOVE : 0);
    size_t end[2];
    for (int i = 0; i < 2; ++i) {
        end[i] = b->end[i].kind == SA_TERMINAL_INFINITE ? NONE : find_terminal(j, &b->end[i], special);
        if (end[i] == NONE && b->end[i].kind != SA_TERMINAL_INFINITE &&
            !(b->end[i].kind == SA_TERMINAL_LINE && b->end[i].re < j->lines->store->re_floor) &&
            !(b->end[i].kind == SA_TERMINAL_CURVE && b->end[i].side < 0 &&
              m->alpha <= j->lines->store->map.curves.alpha_min))
            return part_missing(j, m->alpha, m->q);
        if (end[i] != NONE)
            end_of(j, end[i])->re = b->end[i].re;
    }
    if (end[0] != NONE && end[1] != NONE && end[0] % 2 == end[1] % 2)
        return part_missing(j, m->alpha, m->q);
    if (end[0] != NONE && end[1] != NONE)
        join(j, end[0], end[1], m->alpha, m->q, marks);
    else if (end[0] != NONE || end[1] != NONE)
        to_infinite_mass(end_of(j, end[0] != NONE ? end[0] : end[1]), m->alpha, m->q, marks);
    return CV_OK;
}

static cv_status cross_bridges(const joining *j)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < j->lines->store->map.curves.special_count; ++i)
        for (size_t k = 0; k < j->meeting[i].count && status == CV_OK; ++k)
            status = cross_bridge(j, i, &j->meeting[i].bridge[k]);
    return status;
}

/* A line at a rim without waves whose curve sends Re zeta to minus infinity, and what is left over. */
static cv_status settle_rest(const joining *j)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < 2 * j->count && status == CV_OK; ++i) {
        part_end *e = end_of(j, i);
        if (is_free(j, i, SA_RUN_RIM) && e->arc >= 0 && !e->on_waves)
            to_infinite_mass(e, e->sample->alpha, e->sample->q, SA_MARK_CURVE);
        else if (is_free(j, i, SA_RUN_SHEAR))
            to_infinite_mass(e, e->run.alpha, 0, SA_MARK_VERTICAL);
        else if (is_free(j, i, SA_RUN_RIM) || is_free(j, i, SA_RUN_SPECIAL))
            status = part_missing(j, e->sample->alpha, e->sample->q);
    }
    return status;
}

static cv_status add_vertical(joining *j, const part_end *e, double re, int marks)
{
    const sa_line_sample item = {
        .alpha = e->bridge[0], .q = e->bridge[1], .re = re, .marks = e->marks | marks};
    return sa_line_samples_add(&j->samples, &item);
}

/* The samples on a bridge: its ends, and the ends of the range of eta_M between. */
static cv_status add_bridge(joining *j, const part_end *e, double from, double to)
{
    const sa_line_plot *plot = &j->lines->store->plot;
    double cut[2] = {from < to ? plot->re_low : plot->re_high, from < to ? plot->re_high : plot->re_low};
    cv_status status = add_vertical(j, e, from, 0);
    for (int i = 0; i < 2 && status == CV_OK; ++i)
        if (cut[i] > fmin(from, to) && cut[i] < fmax(from, to))
            status = add_vertical(j, e, cut[i], SA_MARK_CUT);
    return status == CV_OK && from != to ? add_vertical(j, e, to, 0) : status;
}

static cv_status add_part(joining *j, const part *p)
{
    cv_status status = CV_OK;
    for (size_t i = 0; i < p->count && status == CV_OK; ++i)
        status = sa_line_samples_add(&j->samples, &p->sample[p->reversed ? p->count - 1 - i : i]);
    return status;
}

/* All parts from one on, with the bridges between. */
static cv_status unroll(joining *j, size_t first, char *used)
{
    const double floor = j->lines->store->re_floor;
    sa_line *line = &j->line[j->line_count];
    const part_end *begin = &j->part[first].end[0];
    cv_status status = CV_OK;
    size_t i = first;
    *line = (sa_line){.first = j->samples.count};
    if (begin->partner == NONE && begin->bridged)
        status = add_bridge(j, begin, floor, begin->re);
    j->end[j->line_count][0] = begin->final;
    while (status == CV_OK && !used[i]) {
        const part_end *e = &j->part[i].end[1];
        used[i] = 1;
        status = add_part(j, &j->part[i]);
        j->end[j->line_count][1] = e->final;
        double to = e->partner == NONE ? floor : end_of(j, e->partner)->re;
        if (status == CV_OK && e->bridged)
            status = add_bridge(j, e, e->re, to);
        line->closed = e->partner != NONE && e->partner / 2 == first;
        if (e->partner != NONE)
            i = e->partner / 2;
    }
    line->count = j->samples.count - line->first;
    ++j->line_count;
    return status;
}

static cv_status copy_closed(joining *j)
{
    const sa_line_store *s = j->lines->store;
    cv_status status = CV_OK;
    for (size_t i = 0; i < s->line_count && status == CV_OK; ++i) {
        const sa_line *from = &s->line[i];
        if (!from->closed)
            continue;
        j->line[j->line_count++] = (sa_line){j->samples.count, from->count, 1};
        for (size_t k = 0; k < from->count && status == CV_OK; ++k)
            status = sa_line_samples_add(&j->samples, &s->samples.item[from->first + k]);
    }
    return status;
}

static cv_status unroll_all(joining *j)
{
    size_t most = j->lines->store->line_count + j->count + 1;
    char *used = calloc(j->count + 1, 1);
    j->line = calloc(most, sizeof *j->line);
    j->end = calloc(most, sizeof *j->end);
    cv_status status = used != NULL && j->line != NULL && j->end != NULL ? CV_OK : CV_FAILED;
    for (int closed = 0; closed < 2; ++closed) /* open lines from their beginnings, then what is left */
        for (size_t i = 0; i < j->count && status == CV_OK; ++i)
            if (!used[i] && (closed || j->part[i].end[0].partner == NONE))
                status = unroll(j, i, used);
    free(used);
    return status == CV_OK ? copy_closed(j) : status;
}

/* The store takes the new lines over. */
static void hand_over(joining *j)
{
    sa_line_store *s = j->lines->store;
    free(s->samples.item);
    free(s->line);
    free(s->end);
    s->samples = j->samples;
    s->line = j->line;
    s->end = j->end;
    s->line_count = j->lines->line_count = j->line_count;
    j->samples.item = NULL;
    j->line = NULL;
    j->end = NULL;
}

cv_status sa_lines_complete_limit(sa_lines *lines)
{
    joining j = {.lines = lines};
    cv_status status = find_meetings(&j);
    if (status == CV_OK)
        status = find_runs(&j);
    if (status == CV_OK)
        status = make_parts(&j);
    if (status == CV_OK) {
        join_rims(&j);
        status = cross_bridges(&j);
    }
    if (status == CV_OK)
        status = settle_rest(&j);
    if (status == CV_OK)
        status = unroll_all(&j);
    if (status == CV_OK)
        hand_over(&j);
    sa_curve_runs_clear(&j.runs);
    free(j.meeting);
    free(j.part);
    free(j.samples.item);
    free(j.line);
    free(j.end);
    return status;
}
