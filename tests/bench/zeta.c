/* One evaluation of zeta(alpha, q) by either method: warm, cold, double-double (dgreen), 128 bits, 192 bits.
 * Workload of PERFORMANCE.md thinned to a few seconds: velocities 0.1 .. 1.5, frequencies log-spaced in 1e-3
 * .. 10, cases 1 and 3, damping 0.05 and 1e-10. Absolute times belong to the machine; the ratios, medians of
 * rounds that interleave the ways, do not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "common/params.h"
#include "dgreen/z.h"
#include "dgreen/z_mp.h"
#include "semianalytic/zeta.h"

enum { VELOCITIES = 20, FREQUENCIES = 400, THIN = 80, ROUNDS = 3, TRACKS = 4 };

typedef struct {
    sa_track *sa;
    sa_sweep *sweep;
    dg_track *dg;
    dg_follow *follow;
} bench;

static void check(cv_status status, const char *what)
{
    if (status != CV_OK) {
        fprintf(stderr, "%s: status %d\n", what, (int)status);
        exit(EXIT_FAILURE);
    }
}

static void parse(cv_number *to, const char *text)
{
    check(cv_number_parse(to, text, NULL), text);
}

/* Cases 1 and 3 of table 1 at two dampings. */
static void open_track(bench *b, int index)
{
    static const char *const tracks[2][4] = {{"6", "35", "300", "7"}, {"6", "5", "0.03", "3"}};
    static const char *const dampings[2] = {"0.05", "1e-10"};
    const char *const *track = tracks[index / 2], *damping = dampings[index % 2];
    cv_params p;
    cv_params_init(&p);
    parse(&p.mu_s, track[0]);
    parse(&p.mu_b, track[1]);
    parse(&p.kappa_p, track[2]);
    parse(&p.kappa_b, track[3]);
    parse(&p.eta_p, damping);
    parse(&p.eta_b, damping);
    parse(&p.eta_f, damping);
    check(sa_track_new(&b->sa, &p, NULL), "sa_track_new");
    check(dg_track_new(&b->dg, &p, NULL), "dg_track_new");
    check(dg_follow_new(&b->follow, NULL), "dg_follow_new");
    b->sweep = sa_sweep_new();
    cv_params_clear(&p);
}

static void close_track(bench *b)
{
    sa_track_free(b->sa);
    sa_sweep_free(b->sweep);
    dg_track_free(b->dg);
    dg_follow_free(b->follow);
}

/* One way of evaluating; the status is ignored: an undecided point costs what it costs. */
typedef void way(bench *b, double alpha, double q);

static void sa_warm(bench *b, double alpha, double q)
{
    sa_value v;
    (void)sa_zeta_double(&v, b->sweep, b->sa, alpha, q);
}

static void sa_cold(bench *b, double alpha, double q)
{
    sa_value v;
    sa_sweep *fresh = sa_sweep_new();
    (void)sa_zeta_double(&v, fresh, b->sa, alpha, q);
    sa_sweep_free(fresh);
}

static void dg_warm(bench *b, double alpha, double q)
{
    dg_value v;
    (void)dg_zeta_double(&v, b->follow, b->dg, alpha, CMPLX(0.0, q));
}

static void dg_cold(bench *b, double alpha, double q)
{
    dg_value v;
    dg_follow *fresh = NULL;
    check(dg_follow_new(&fresh, NULL), "dg_follow_new");
    (void)dg_zeta_double(&v, fresh, b->dg, alpha, CMPLX(0.0, q));
    dg_follow_free(fresh);
}

static void wide(bench *b, double alpha, double q, mpfr_prec_t bits, int dgreen)
{
    mpc_t zeta;
    mpfr_t a, f, re_error, im_error;
    mpc_init2(zeta, bits);
    mpfr_inits2(53, a, f, re_error, im_error, (mpfr_ptr)0);
    mpfr_set_d(a, alpha, MPFR_RNDN);
    mpfr_set_d(f, q, MPFR_RNDN);
    if (dgreen)
        (void)dg_zeta_mp(zeta, re_error, im_error, b->dg, a, f, bits);
    else
        (void)sa_zeta_mp(zeta, re_error, im_error, b->sweep, b->sa, a, f);
    mpfr_clears(a, f, re_error, im_error, (mpfr_ptr)0);
    mpc_clear(zeta);
}

static void dg_twofold(bench *b, double alpha, double q)
{
    dg_value v;
    (void)dg_zeta_above_double(&v, b->follow, b->dg, alpha, CMPLX(0.0, q), INFINITY, INFINITY);
}

static void sa_128(bench *b, double alpha, double q)
{
    wide(b, alpha, q, 128, 0);
}

static void sa_192(bench *b, double alpha, double q)
{
    wide(b, alpha, q, 192, 0);
}

static void dg_128(bench *b, double alpha, double q)
{
    wide(b, alpha, q, 128, 1);
}

static void dg_192(bench *b, double alpha, double q)
{
    wide(b, alpha, q, 192, 1);
}

static const struct {
    const char *name;
    way *evaluate;
    int thin; /* every THIN-th frequency only */
} WAYS[] = {{"semianalytic, double, warm", sa_warm, 0},
            {"semianalytic, double, cold", sa_cold, 1},
            {"semianalytic, 128 bits", sa_128, 1},
            {"semianalytic, 192 bits", sa_192, 1},
            {"dgreen, double, warm", dg_warm, 0},
            {"dgreen, double, cold", dg_cold, 1},
            {"dgreen, double-double", dg_twofold, 1},
            {"dgreen, 128 bits", dg_128, 1},
            {"dgreen, 192 bits", dg_192, 1}};

enum { WAY_COUNT = sizeof WAYS / sizeof *WAYS };

/* Microseconds per evaluation over one track. */
static double measure(bench *b, int w)
{
    struct timespec from, to;
    const int step = WAYS[w].thin ? THIN : 1;
    long evaluations = 0;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
    for (int i = 0; i < VELOCITIES; i++)
        for (int j = 0; j < FREQUENCIES; j += step, evaluations++)
            WAYS[w].evaluate(b, 0.1 + 1.4 * i / (VELOCITIES - 1),
                             pow(10.0, -3.0 + 4.0 * j / (FREQUENCIES - 1)));
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
    return (1e6 * (double)(to.tv_sec - from.tv_sec) + 1e-3 * (double)(to.tv_nsec - from.tv_nsec)) /
           (double)evaluations;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(void)
{
    double time[WAY_COUNT][ROUNDS] = {{0}}, median[WAY_COUNT];
    for (int round = 0; round < ROUNDS; round++)
        for (int track = 0; track < TRACKS; track++) {
            bench b;
            open_track(&b, track);
            for (int w = 0; w < WAY_COUNT; w++)
                time[w][round] += measure(&b, w) / TRACKS;
            close_track(&b);
        }
    printf("%-28s %10s %22s\n", "zeta(alpha, q)", "us", "x semianalytic warm");
    for (int w = 0; w < WAY_COUNT; w++) {
        qsort(time[w], ROUNDS, sizeof time[w][0], ascending);
        median[w] = time[w][ROUNDS / 2];
        printf("%-28s %10.2f %22.2f\n", WAYS[w].name, median[w], median[w] / median[0]);
    }
    mpfr_free_cache();
    return EXIT_SUCCESS;
}
