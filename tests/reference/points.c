/* Writes data/reference_zeta.json: zeta at exact points, both parts to 40 digits, from rigorous arithmetic.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arbtrack.h"
#include "datafile.h"
#include "dispersion.h"

enum { DIGITS = 42, BITS = 150, TEXT = 64 };

typedef struct {
    const char *name;
    const char *param[6]; /* mu_s mu_b kappa_p kappa_b eta_s eta_N */
} track_text;

static const track_text tracks[] = {
    {"1", {"6", "35", "300", "7", "0", "0"}},
    {"2", {"6", "35", "30", "7", "0", "0"}},
    {"3", {"6", "5", "0.03", "3", "0", "0"}},
    {"4", {"3", "10", "0.03", "0.1", "0", "0"}},
    {"shear, compression", {"3", "10", "5000", "100", "10", "0.3"}},
    {"stiff, tension", {"2.5", "20", "50000", "10000", "0", "-0.5"}},
    {"strong shear", {"1", "2.5", "40", "0.1", "100", "0.1"}},
    {"soft pad, weak shear", {"1.7", "50", "0.5", "20", "0.8", "-0.2"}},
};
enum { TRACKS = sizeof tracks / sizeof *tracks };

/* eta_p eta_b eta_f */
static const char *const dampings[][3] = {
    {"0", "0", "0"},          {"1e-10", "1e-10", "1e-10"}, {"1e-4", "1e-4", "1e-4"},
    {"0.05", "0.05", "0.05"}, {"0.2", "0.2", "0.2"},       {"1", "1", "1"},
    {"1e-10", "0.05", "0"},   {"0", "0", "1e-4"},          {"0.2", "1e-10", "1e-4"},
    {"0.3", "0", "0.07"},
};
enum { DAMPINGS = sizeof dampings / sizeof *dampings };

typedef struct {
    json_t *records;
    unsigned long long state; /* of the generator of the random points */
    int failed;
} run;

static double uniform(run *r)
{
    r->state = r->state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(r->state >> 11) * 0x1p-53;
}

static void full_params(const char *out[REF_PARAMS], const track_text *t, const char *const damping[3])
{
    for (int i = 0; i < 6; i++)
        out[i] = t->param[i];
    for (int i = 0; i < 3; i++)
        out[REF_ETA_P + i] = damping[i];
}

static int set_track(ref_track *out, const char *const text[REF_PARAMS])
{
    int status = 0;
    for (int i = 0; i < REF_PARAMS; i++)
        status |= ref_decimal(&out->value[i], text[i]);
    return status;
}

static void add_point(run *r, int track, int damping, const char *alpha, const char *q, const char *about)
{
    const char *text[REF_PARAMS];
    ref_track t;
    ref_zeta z;
    fmpq_t a, f;
    ref_track_init(&t);
    ref_zeta_init(&z);
    fmpq_init(a);
    fmpq_init(f);
    full_params(text, &tracks[track], dampings[damping]);
    if (set_track(&t, text) != 0 || ref_decimal(a, alpha) != 0 || ref_decimal(f, q) != 0 ||
        ref_zeta_point(&z, &t, a, f, BITS) != 0) {
        fprintf(stderr, "no value: track %s damping %d alpha %s q %s\n", tracks[track].name, damping, alpha,
                q);
        r->failed = 1;
    } else {
        json_t *record = json_pack("{s:s, s:s, s:o, s:s, s:s}", "track", tracks[track].name, "about", about,
                                   "parameters", ref_file_params(text), "alpha", alpha, "q", q);
        json_object_set_new(record, "zeta_re", ref_file_real(acb_realref(z.zeta), DIGITS));
        json_object_set_new(record, "zeta_im", ref_file_real(acb_imagref(z.zeta), DIGITS));
        json_object_set_new(record, "upper_roots", json_integer(z.upper));
        json_array_append_new(r->records, record);
    }
    fmpq_clear(a);
    fmpq_clear(f);
    ref_zeta_clear(&z);
    ref_track_clear(&t);
}

static void random_points(run *r, int track)
{
    char alpha[TEXT], q[TEXT];
    for (int d = 0; d < DAMPINGS; d++) {
        snprintf(alpha, TEXT, "%.4f", 0.02 + 1.98 * uniform(r) * uniform(r));
        snprintf(q, TEXT, "%.6f", exp(log(1e-3) + log(2e4) * uniform(r)));
        add_point(r, track, d, alpha, q, "random");
    }
}

/* Next to a branch point of the undamped track: q = q_b (1 + offset), to 17 digits. */
static void branch_points(run *r, int track)
{
    static const double offsets[] = {1e-12, -1e-12, 3e-10, -1e-10, 1e-7, -1e-3};
    char alpha[TEXT], q[TEXT];
    ref_track t;
    ref_dtrack d;
    double branch[64];
    const char *text[REF_PARAMS];
    ref_track_init(&t);
    full_params(text, &tracks[track], dampings[0]);
    r->failed |= set_track(&t, text);
    ref_dtrack_set(&d, &t);
    for (int i = 0; i < 6; i++) {
        snprintf(alpha, TEXT, "%.3f", 0.1 + 0.7 * uniform(r));
        size_t n = ref_branch_points(branch, 64, &d, strtod(alpha, NULL));
        if (n == 0)
            continue;
        snprintf(q, TEXT, "%.17g", branch[(size_t)(uniform(r) * (double)n)] * (1 + offsets[i]));
        add_point(r, track, i % 3, alpha, q, "next to a branch point");
    }
    ref_track_clear(&t);
}

static void chosen_points(run *r)
{
    static const struct {
        int track, damping;
        const char *alpha, *q, *about;
    } points[] = {
        {4, 0, "1", "0.3", "alpha^2 mu_b = eta_s"},
        {4, 1, "1", "0.3", "alpha^2 mu_b = eta_s"},
        {4, 3, "1", "5", "alpha^2 mu_b = eta_s"},
        {4, 6, "1", "0.01", "alpha^2 mu_b = eta_s"},
        {4, 1, "1.000000000001", "0.3", "alpha^2 mu_b close to eta_s"},
        {4, 1, "0.9999999999", "0.3", "alpha^2 mu_b close to eta_s"},
        {4, 3, "1.0000001", "0.02", "alpha^2 mu_b close to eta_s"},
        {4, 0, "0.99999999999999999999", "0.3", "alpha^2 mu_b close to eta_s"},
        {0, 0, "0.03", "0.01", "tiny radiation"},
        {0, 1, "0.03", "0.01", "tiny radiation"},
        {1, 0, "0.05", "0.002", "tiny radiation"},
        {2, 1, "0.05", "0.01", "tiny radiation"},
        {3, 0, "0.02", "0.001", "tiny radiation"},
        {4, 0, "0.2", "0.05", "tiny radiation"},
        {4, 1, "0.2", "0.05", "tiny radiation"},
        {6, 0, "0.5", "0.1", "tiny radiation"},
        {7, 1, "0.03", "0.001", "tiny radiation"},
        {0, 1, "0.8512796005931902", "1e-6", "resonance velocity, small q"},
        {2, 1, "0.4448552403514533", "1e-5", "resonance velocity, small q"},
        {3, 1, "0.4369501801477651", "1e-4", "resonance velocity, small q"},
        {0, 0, "2", "1000", "large q"},
        {5, 1, "2", "100000", "large q"},
        {0, 1, "0.001", "0.5", "small alpha"},
        {6, 3, "0.001", "0.5", "small alpha"},
        {0, 3, "0", "0.5", "alpha = 0"},
        {4, 1, "0", "0.5", "alpha = 0"},
    };
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        add_point(r, points[i].track, points[i].damping, points[i].alpha, points[i].q, points[i].about);
}

int main(int argc, char **argv)
{
    run r = {json_array(), 20241124ULL, 0};
    if (argc != 2) {
        fprintf(stderr, "usage: reference-points FILE\n");
        return 2;
    }
    for (int track = 0; track < TRACKS; track++) {
        random_points(&r, track);
        branch_points(&r, track);
    }
    chosen_points(&r);
    json_t *head =
        ref_file_head("critvel-reference-zeta/1", "tests/reference/points.c",
                      "zeta = q^2 K(0,q)/(2 pi), real q > 0; damping 0 is the limit q -> q - i0; both parts "
                      "enclosed by ball arithmetic, printed to 42 digits (at most one unit off in the last)");
    return ref_file_write(head, "points", r.records, argv[1]) == 0 && !r.failed ? 0 : 3;
}
