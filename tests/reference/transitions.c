/* Writes data/reference_transitions.json: for each track of a job file all (alpha, q) where eta_M zeta = 1,
 * each proved by interval Newton; that none is missing rests on brute force in double (lines.h) and on the
 * chain of root counts. A log for people goes to stdout as the jobs finish.
 *
 * Job file: one job a line, '#' starts a comment:
 *   name mu_s mu_b kappa_p kappa_b eta_s eta_N eta_p eta_b eta_f alpha_min alpha_max mass[,mass...] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "certify.h"
#include "datafile.h"
#include "lines.h"

enum { DIGITS = 45, MASSES = 32, LINE = 1024, HALVINGS = 50, FOUND = 256 };

typedef struct {
    char name[64], param[REF_PARAMS][64], alpha[2][64], mass_text[MASSES][64];
    size_t mass_count;
    double mass[MASSES];
    fmpq_t mass_exact[MASSES];
    ref_track track;
    ref_dtrack dtrack;
} job;

typedef struct {
    size_t mass;
    ref_transition at;
} found;

static int split_masses(job *j, char *text)
{
    j->mass_count = 0;
    for (char *m = strtok(text, ","); m != NULL && j->mass_count < MASSES; m = strtok(NULL, ",")) {
        snprintf(j->mass_text[j->mass_count], sizeof j->mass_text[0], "%s", m);
        j->mass[j->mass_count] = strtod(m, NULL);
        if (ref_decimal(j->mass_exact[j->mass_count++], m) != 0)
            return -1;
    }
    return j->mass_count > 0 ? 0 : -1;
}

static int parse_job(job *j, const char *line)
{
    char masses[LINE];
    int n = sscanf(line, "%63s %63s %63s %63s %63s %63s %63s %63s %63s %63s %63s %63s %1023s", j->name,
                   j->param[0], j->param[1], j->param[2], j->param[3], j->param[4], j->param[5], j->param[6],
                   j->param[7], j->param[8], j->alpha[0], j->alpha[1], masses);
    if (n != 13 || split_masses(j, masses) != 0)
        return -1;
    for (int i = 0; i < REF_PARAMS; i++)
        if (ref_decimal(&j->track.value[i], j->param[i]) != 0)
            return -1;
    ref_dtrack_set(&j->dtrack, &j->track);
    return 0;
}

/* Proves a candidate, halving its interval until Newton stays inside. */
static int settle(ref_transition *out, const job *j, ref_candidate c)
{
    for (int i = 0; i < HALVINGS; i++) {
        ref_real alpha, q;
        double reach = (double)(c.alpha[1] - c.alpha[0]) + 2e-16, a, f;
        ref_candidate_guess(&alpha, &q, &c);
        if (ref_certify(out, &j->track, j->mass_exact[c.mass], (double)alpha, (double)q, reach) == 0) {
            a = arf_get_d(arb_midref(out->alpha), ARF_RND_NEAR);
            f = arf_get_d(arb_midref(out->q), ARF_RND_NEAR);
            double slack = (double)(fabsl(c.q[1] - c.q[0]) + 1e-9 * c.q[0]);
            if (a >= c.alpha[0] * (1 - 1e-14) && a <= c.alpha[1] * (1 + 1e-14) &&
                f > fminl(c.q[0], c.q[1]) - slack && f < fmaxl(c.q[0], c.q[1]) + slack)
                return 0;
        }
        if (ref_candidate_halve(&c, &j->dtrack, j->mass[c.mass]) != 0)
            return -1;
    }
    return -1;
}

static int by_alpha(const void *x, const void *y)
{
    const found *a = x, *b = y;
    return arf_cmp(arb_midref(a->at.alpha), arb_midref(b->at.alpha));
}

static json_t *transition_record(const ref_transition *x, int below)
{
    char radius[32];
    snprintf(radius, sizeof radius, "%.0e", x->unique_radius);
    json_t *out = json_object();
    json_object_set_new(out, "alpha", ref_file_real(x->alpha, DIGITS));
    json_object_set_new(out, "q", ref_file_real(x->q, DIGITS));
    json_object_set_new(out, "unstable_roots_below", json_integer(below));
    json_object_set_new(out, "unstable_roots_above", json_integer(below + x->jump));
    json_object_set_new(out, "unique_radius", json_string(radius));
    return out;
}

/* The record of one mass ratio, with the chain of counts checked at both ends. Returns 0 or -1. */
static int mass_record(json_t *records, const job *j, size_t mass, const found *f, size_t count)
{
    ref_column first, last;
    double lo = strtod(j->alpha[0], NULL), hi = strtod(j->alpha[1], NULL), re_min = 0.5 / j->mass[mass];
    if (ref_scan(&first, &j->dtrack, lo, re_min) != 0 || ref_scan(&last, &j->dtrack, hi, re_min) != 0)
        return -1;
    int n = ref_scan_unstable(&first, j->mass[mass]), status = n < 0 ? -1 : 0;
    json_t *list = json_array();
    const char *text[REF_PARAMS];
    for (int i = 0; i < REF_PARAMS; i++)
        text[i] = j->param[i];
    printf("track %s  damping %s %s %s  eta_M %s\n", j->name, text[6], text[7], text[8], j->mass_text[mass]);
    for (size_t i = 0; i < count; i++) {
        if (f[i].mass != mass)
            continue;
        json_t *record = transition_record(&f[i].at, n);
        printf("   alpha %.32s  q %.32s  N %d -> %d\n", json_string_value(json_object_get(record, "alpha")),
               json_string_value(json_object_get(record, "q")), n, n + f[i].at.jump);
        json_array_append_new(list, record);
        n += f[i].at.jump;
        if (n < 0)
            status = -1;
    }
    if (n != ref_scan_unstable(&last, j->mass[mass]))
        status = -1;
    if (status != 0)
        printf("   COUNT CHAIN BROKEN: %d at the end, %d by crossings there\n", n,
               ref_scan_unstable(&last, j->mass[mass]));
    json_array_append_new(records, json_pack("{s:s, s:o, s:[s,s], s:s, s:o}", "track", j->name, "parameters",
                                             ref_file_params(text), "alpha_range", j->alpha[0], j->alpha[1],
                                             "eta_M", j->mass_text[mass], "transitions", list));
    return status;
}

/* Proves all candidates; those that turn out to be one and the same count once. Returns how many, or -1. */
static long settle_all(found f[FOUND], const job *j, const ref_candidates *list)
{
    long n = 0;
    int failed = 0;
    for (size_t i = 0; i < list->count && n < FOUND; i++) {
        f[n].mass = list->candidate[i].mass;
        ref_transition_init(&f[n].at);
        int same = 0;
        if (settle(&f[n].at, j, list->candidate[i]) != 0) {
            printf("   NOT PROVED: eta_M %s, alpha %.20Lg .. %.20Lg, q %.20Lg\n", j->mass_text[f[n].mass],
                   (long double)list->candidate[i].alpha[0], (long double)list->candidate[i].alpha[1],
                   (long double)list->candidate[i].q[0]);
            failed = 1;
            same = 1;
        }
        for (long k = 0; k < n && !same; k++)
            same = f[k].mass == f[n].mass && arb_overlaps(f[k].at.alpha, f[n].at.alpha) &&
                   arb_overlaps(f[k].at.q, f[n].at.q);
        if (same)
            ref_transition_clear(&f[n].at);
        else
            n++;
    }
    qsort(f, (size_t)n, sizeof *f, by_alpha);
    return failed || n == FOUND ? -n - 1 : n;
}

static int run_job(json_t *records, const job *j, double density)
{
    ref_candidates list;
    found f[FOUND];
    double damping =
        fmax(j->dtrack.value[REF_ETA_P], fmax(j->dtrack.value[REF_ETA_B], j->dtrack.value[REF_ETA_F]));
    for (int i = REF_ETA_P; i <= REF_ETA_F; i++)
        if (j->dtrack.value[i] > 0)
            damping = fmin(damping, j->dtrack.value[i]);
    ref_search s = {strtod(j->alpha[0], NULL),
                    strtod(j->alpha[1], NULL),
                    (size_t)(3000 * density),
                    12 * density,
                    fmin(1e-3, 0.003 * damping),
                    j->mass,
                    j->mass_count};
    clock_t start = clock();
    int status = ref_search_lines(&list, &j->dtrack, &s);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    long n = settle_all(f, j, &list);
    if (n < 0 || list.unresolved > 0)
        status = -1;
    n = n < 0 ? -n - 1 : n;
    for (size_t m = 0; m < j->mass_count; m++)
        status |= mass_record(records, j, m, f, (size_t)n);
    printf("# %s: %zu columns, %.0f s, %zu candidates, %ld transitions, %zu unresolved%s\n", j->name,
           list.columns, seconds, list.count, n, list.unresolved, status == 0 ? "" : "  FAILED");
    fflush(stdout);
    for (long i = 0; i < n; i++)
        ref_transition_clear(&f[i].at);
    ref_candidates_clear(&list);
    return status;
}

static int run_file(json_t *records, const char *path, double density)
{
    char line[LINE];
    int status = 0;
    job *j = malloc(sizeof *j);
    FILE *in = fopen(path, "r");
    if (in == NULL || j == NULL) {
        free(j);
        return -1;
    }
    ref_track_init(&j->track);
    for (int i = 0; i < MASSES; i++)
        fmpq_init(j->mass_exact[i]);
    while (fgets(line, sizeof line, in) != NULL) {
        if (line[0] == '#' || line[0] == '\n')
            continue;
        if (parse_job(j, line) != 0) {
            fprintf(stderr, "bad job: %s", line);
            status = -1;
        } else {
            status |= run_job(records, j, density);
        }
    }
    for (int i = 0; i < MASSES; i++)
        fmpq_clear(j->mass_exact[i]);
    ref_track_clear(&j->track);
    fclose(in);
    free(j);
    return status;
}

int main(int argc, char **argv)
{
    if (argc != 3 && argc != 4) {
        fprintf(stderr, "usage: reference-transitions JOBS FILE [DENSITY]\n");
        return 2;
    }
    json_t *records = json_array();
    int status = run_file(records, argv[1], argc == 4 ? strtod(argv[3], NULL) : 1);
    json_t *head = ref_file_head(
        "critvel-reference-transitions/1", "tests/reference/transitions.c",
        "eta_M zeta(alpha, q) = 1. Proved by ball arithmetic: each transition exists and is the only one "
        "within "
        "unique_radius; the sign of its jump. Brute force in double: that none is missing in alpha_range, "
        "and the "
        "number of unstable roots at its lower end. 45 digits, at most one unit off in the last.");
    return ref_file_write(head, "combinations", records, argv[2]) == 0 && status == 0 ? 0 : 3;
}
