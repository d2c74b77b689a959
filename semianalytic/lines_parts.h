/* Parts of sa_lines_find. */
#ifndef CRITVEL_SEMIANALYTIC_LINES_PARTS_H
#define CRITVEL_SEMIANALYTIC_LINES_PARTS_H

#include "semianalytic/lines.h"
#include "semianalytic/map_search.h"
#include "semianalytic/resonances.h"

/* The picture in which polylines must be accurate. */
typedef struct {
    double alpha_span, log_span; /* natural logarithm of eta_M */
    double re_low, re_high;      /* 1 / mass_max, 1 / mass_min */
} sa_line_plot;

/* A point of a line in double precision. */
typedef struct {
    double alpha, q, re, re_alpha, re_q, im_alpha, im_q;
    int marks;
    enum { SA_TURN_UNTRIED, SA_TURN_SETTLED, SA_TURN_UNSETTLED } turn; /* settled: exact, as far as known */
    double alpha_rest, alpha_error; /* of a settled turning point: alpha + alpha_rest, within alpha_error */
} sa_line_sample;

typedef struct {
    size_t count, room;
    sa_line_sample *item;
} sa_line_samples;

cv_status sa_line_samples_add(sa_line_samples *list, const sa_line_sample *item);

/* A stretch of an edge between cells of the map with one zero of Im zeta on it. Edges that are one and the
 * same line seen from two blocks have the same ids and fixed coordinate. */
typedef struct {
    enum { SA_EDGE_NONE, SA_EDGE_ALONG_U, SA_EDGE_ALONG_T, SA_EDGE_COLUMN } kind;
    long id[4];           /* column, side_u, strip, side_t; SA_EDGE_COLUMN: number of the boundary */
    double fixed;         /* the other coordinate */
    double low, high, at; /* of the stretch and of the zero: u, t, or q for SA_EDGE_COLUMN */
} sa_line_edge;

/* Cells are at least 1e-9 wide; corners found by different sums agree to rounding. */
#define SA_SAME_EDGE 1e-11

/* One segment of the map as samples, in the direction of the line. */
typedef struct {
    size_t first, count;  /* of the samples */
    sa_line_edge edge[2]; /* that hold the first and the last */
} sa_line_piece;

typedef struct {
    const sa_map *map;
    sa_line_plot plot;
    double re_floor; /* Re zeta down to which lines are wanted */
    sa_field *sharp; /* places samples in the plot better than the search needs; not counted as its effort */
    sa_line_samples samples;
    size_t piece_count, piece_room;
    sa_line_piece *piece;
    size_t place_count; /* where cells could not be resolved */
    double (*place)[2];
} sa_line_trace;

/* Limits of a search, as in sa_search */
typedef struct {
    unsigned long cells, beyond_double;
} sa_line_effort;

/* All pieces; finer cells the larger "refinement", within the effort. trace must be zero but for map, plot
 * and re_floor; clear it on any status. CV_UNDECIDED: the search came to no end. */
cv_status sa_lines_trace(sa_line_trace *trace, sa_field *field, int refinement, const sa_line_effort *effort);
void sa_line_trace_clear(sa_line_trace *trace);
cv_status sa_line_place_add(double (**place)[2], size_t *count, double alpha, double q);

/* A whole line; its samples are consecutive and without repetition. */
typedef struct {
    size_t first, count;
    int closed;
} sa_line;

/* Joins the pieces whose ends are at the same place. lines and samples are allocated here. */
cv_status sa_lines_chain(sa_line **line, size_t *line_count, sa_line_samples *samples,
                         const sa_line_trace *trace);

/* Everything in double precision, with what is needed to refine and to count. */
struct sa_line_store {
    cv_params params;
    sa_track *track;
    sa_map map;
    sa_field *field, *sharp; /* the second to place samples, see sa_line_trace */
    sa_sweep *sweep;
    sa_line_plot plot;
    double re_floor;
    cv_number alpha_min, alpha_max, mass_min, mass_max;
    sa_line_samples samples;
    size_t line_count;
    sa_line *line;
    sa_line_end (*end)[2];        /* of each line; kind SA_END_MASS_HIGH where it runs to infinite mass */
    int torn;                     /* the search has left something out: finer cells may help */
    sa_resonance_list resonances; /* of undamped tracks, to the digits asked for */
};

/* Finds out how the lines end, and joins those that are one line below the floor of Re zeta; what is
 * undecided is reported by sa_lines_doubt. */
cv_status sa_lines_ends(sa_lines *lines);

/* Makes one line of those whose ends go on as each other (SA_BEYOND_BRANCH with the number of the line). */
cv_status sa_lines_join(sa_lines *lines);

/* Without damping: joins the lines along branch curves and at special velocities, where they have vertical
 * parts. Marks of samples there are SA_MARK_CURVE and SA_MARK_VERTICAL. After sa_lines_ends. */
cv_status sa_lines_complete_limit(sa_lines *lines);

/* Something is undecided at this place, which is listed; the first one becomes the reason. */
cv_status sa_lines_doubt(sa_lines *lines, double alpha, double q, const char *what);

/* Cuts the lines into branches with refined vertices. */
cv_status sa_lines_cut(sa_lines *lines, int digits);

/* Which samples to keep (1) so that the polyline through them stays near all: first, last, marked ones and as
 * few others as needed. */
void sa_line_simplify(char *kept, const sa_line_sample *sample, size_t count, const sa_line_plot *plot);

/* The vertex for sample[0], whose neighbours are sample[-1] and sample[1] where it is an extreme. end: at
 * which end of the range it is, SA_END_CLOSED for none. */
cv_status sa_line_refine(sa_line_vertex *out, const sa_line_store *store, const sa_line_sample *sample,
                         sa_end_kind end, int digits);

/* The local extreme next to a sample marked so: of eta_M, or (SA_MARK_TURN) of alpha. *bend, NULL allowed: 1
 * where the extreme of alpha is a minimum, -1 a maximum. out is initialised here; out->decided is
 * CV_UNDECIDED where there is none. */
cv_status sa_line_extreme(sa_line_vertex *out, int *bend, const sa_line_store *store,
                          const sa_line_sample *sample, int digits);

/* Which coordinate is best given at a sample. */
sa_line_given sa_line_best_given(const sa_line_sample *sample);

/* Makes a turning point of alpha next to sample k of the line exact, which is then settled; samples beyond it
 * are removed. CV_UNDECIDED: there is none, or it is not found to more digits than a double has; the sample
 * is then unsettled. */
cv_status sa_line_settle_turn(const sa_line_store *store, sa_line *line, size_t k);

/* 1 on a vertical part or a branch curve: no point of Im zeta = 0 of an undamped track. */
int sa_line_in_limit(const sa_line_sample *sample);

/* Numbers of roots on both sides of a branch. */
cv_status sa_branch_count(sa_branch *branch, const sa_line_store *store);

#endif
