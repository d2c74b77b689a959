#include "compare/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_errno.h>

#include "compare/figure.h"
#include "compare/progress.h"

static const char HELP[] =
    "usage: critvel-compare figures [options] FILE -o DIR\n"
    "\n"
    "Draws the figures of the paper for the cases of the case file FILE, through gnuplot. Into the folder "
    "DIR go, "
    "for\n"
    "each picture, NAME.svg and NAME.pdf, its numbers NAME.dat, and the script NAME.gp, which draws it again "
    "after\n"
    "changes: gnuplot NAME.gp.\n"
    "\n"
    "  curve-right   figure 2: D-decomposition curves, the stable part to the right; stable and unstable\n"
    "  curve-left    figure 3: the same with the stable part to the left; curve: both\n"
    "  lines         figures 4, 5: instability lines by damping, over velocity and mass ratio\n"
    "  deflection    figures 6, 7: undamped steady deflection over the velocity of the moving force\n"
    "  map           number of unstable roots, and growth rate, over velocity and mass ratio by "
    "D-decomposition, and the\n"
    "                instability lines of the semianalytical method over them\n"
    "  steady        steady shapes of rail, sleepers and ballast under the moving force\n"
    "\n"
    "  -o DIR            the folder, made when it is missing\n"
    "  --case NAME       only the section [case NAME] or [track NAME]\n"
    "  --only LIST       names of the list above or numbers of the paper's figures, with commas: 6,7\n"
    "  --damping X       at eta_p = eta_b = eta_f = X (default: curve: the first level that shows it; map: "
    "all "
    "levels;\n"
    "                    steady: 0)\n"
    "  --alpha X         curve, steady: at this velocity (default: curve: the first multiple of 0.05, or "
    "0.01, "
    "that shows\n"
    "                    it; steady: below and above the lowest true resonance or pseudocritical velocity)\n"
    "  --mass-ratio X    curve: for this mass (default: one to either side of the crossing)\n"
    "  --format FORMAT   svg or pdf (default: both)\n"
    "  --threads N       at most N threads (default: one for each processor)\n"
    "  --help            this text\n"
    "  --version         the version\n"
    "\n"
    "example: critvel-compare figures data/paper.ini -o figures --only 6,7\n"
    "exit status: 0 all drawn, 1 a picture could not be computed, 2 bad usage or bad input, 3 no gnuplot, or "
    "an I/O\n"
    "failure\n";

static const struct {
    const char *name, *group, *numbers;
    cmp_figure_draw *draw;
} KINDS[] = {
    {"curve-right", "curve", "2", cmp_draw_curve_right},
    {"curve-left", "curve", "3", cmp_draw_curve_left},
    {"lines", "lines", "45", cmp_draw_lines},
    {"deflection", "deflection", "67", cmp_draw_deflection},
    {"map", "map", "", cmp_draw_map},
    {"steady", "steady", "", cmp_draw_steady},
};

enum { KIND_COUNT = sizeof KINDS / sizeof KINDS[0] };

typedef struct {
    cv_selection selection;
    const char *folder;
    unsigned kinds; /* bit by KINDS; 0: all */
    int formats;
    size_t threads;
} options;

static unsigned kinds_called(const char *word, size_t length)
{
    unsigned found = 0;
    for (unsigned i = 0; i < KIND_COUNT; i++) {
        const int named = (strlen(KINDS[i].name) == length && strncmp(KINDS[i].name, word, length) == 0) ||
                          (strlen(KINDS[i].group) == length && strncmp(KINDS[i].group, word, length) == 0) ||
                          (length == 1 && strchr(KINDS[i].numbers, word[0]) != NULL);
        found |= named ? 1u << i : 0;
    }
    return found;
}

static cv_status set_kinds(void *to, const char *text, cv_message *why)
{
    unsigned *kinds = to;
    for (const char *word = text;; word++) {
        const size_t length = strcspn(word, ",");
        const unsigned found = kinds_called(word, length);
        if (found == 0)
            return cv_fail(why, CV_BAD_INPUT, "there is no figure \"%.*s\"; see figures --help",
                           length < 60 ? (int)length : 60, word);
        *kinds |= found;
        word += length;
        if (*word == '\0')
            return CV_OK;
    }
}

static cv_status set_format(void *to, const char *text, cv_message *why)
{
    int *formats = to;
    *formats = strcmp(text, "svg") == 0 ? CMP_SVG : strcmp(text, "pdf") == 0 ? CMP_PDF : 0;
    return *formats != 0 ? CV_OK : cv_fail(why, CV_BAD_INPUT, "\"%.60s\" is neither svg nor pdf", text);
}

static const cv_option OPTIONS[] = {
    CV_OPTION_CASE(offsetof(options, selection)),
    CV_OPTION_DAMPING(offsetof(options, selection)),
    CV_OPTION_ALPHA(offsetof(options, selection)),
    CV_OPTION_MASS_RATIO(offsetof(options, selection)),
    {"o", cv_set_text, offsetof(options, folder), 0},
    {"only", set_kinds, offsetof(options, kinds), 0},
    {"format", set_format, offsetof(options, formats), 0},
    {"threads", cmp_set_threads, offsetof(options, threads), 0},
    {NULL, NULL, 0, 0},
};

/* A picture to draw, and what came of it. */
typedef struct {
    cmp_figure figure;
    unsigned kind;
    cmp_picture picture;
    cv_status status;
    cv_message why;
} task;

enum { NUMBER_SIZE = 24 };

typedef struct {
    size_t count;
    task *tasks;
    char (*slugs)[CMP_PICTURE_NAME / 2];
    cmp_album album;
} plan;

const char *cmp_figure_case(char *out, const cmp_figure *f)
{
    snprintf(out, CMP_PICTURE_SHOWS, "%s %.100s", f->of->is_track ? "track" : "case", f->of->name);
    return out;
}

size_t cmp_figure_levels(const cmp_figure *f)
{
    return f->set->damping.given ? 1 : f->of->level_count;
}

void cmp_figure_params(cv_params *out, const cmp_figure *f, size_t level)
{
    const cv_optional_number *damping = &f->set->damping;
    cv_case_params(out, f->of, damping->given ? 0 : level);
    if (damping->given) {
        cv_number_set(&out->eta_p, &damping->value);
        cv_number_set(&out->eta_b, &damping->value);
        cv_number_set(&out->eta_f, &damping->value);
    }
}

/* Letters, digits, '-' and '.' of the case's name, the rest as '-'; names that then are equal get the number
 * of the case. */
static void make_slug(char (*slugs)[CMP_PICTURE_NAME / 2], const cv_casefile *file, size_t i)
{
    static const char safe[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-.";
    const char *name = file->cases[i].name;
    int clash = 0;
    snprintf(slugs[i], sizeof slugs[i] - NUMBER_SIZE, "%s", name);
    for (char *c = slugs[i]; *c != '\0'; c++)
        if (strchr(safe, *c) == NULL)
            *c = '-';
    for (size_t j = 0; j < i; j++)
        clash |= strcmp(slugs[j], slugs[i]) == 0;
    if (clash)
        snprintf(slugs[i] + strlen(slugs[i]), NUMBER_SIZE, "-%zu", i + 1);
}

static cv_status plan_make(plan *p, const cv_casefile *file, const options *o, cv_message *why)
{
    const cv_case *only = NULL;
    cv_status status =
        o->selection.case_name != NULL ? cv_casefile_find(&only, file, o->selection.case_name, why) : CV_OK;
    if (status != CV_OK)
        return status;
    p->slugs = calloc(file->case_count, sizeof *p->slugs);
    p->tasks = calloc(file->case_count * KIND_COUNT, sizeof *p->tasks);
    if (p->slugs == NULL || p->tasks == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    for (size_t i = 0; i < file->case_count; i++)
        make_slug(p->slugs, file, i);
    for (unsigned k = 0; k < KIND_COUNT; k++)
        for (size_t i = 0; i < file->case_count; i++)
            if ((o->kinds == 0 || (o->kinds & 1u << k)) && (only == NULL || only == &file->cases[i]))
                p->tasks[p->count++] =
                    (task){.figure = {file, &file->cases[i], p->slugs[i], &o->selection}, .kind = k};
    return CV_OK;
}

static void plan_clear(plan *p)
{
    for (size_t i = 0; i < p->count; i++)
        cmp_picture_clear(&p->tasks[i].picture);
    free(p->tasks);
    free(p->slugs);
}

/* A picture that cannot be computed does not stop the others. */
static cv_status do_task(void *context, size_t index, cv_message *why)
{
    plan *p = context;
    task *t = &p->tasks[index];
    char name[CMP_PICTURE_NAME];
    snprintf(name, sizeof name, "%s-%s", KINDS[t->kind].name, t->figure.slug);
    cv_status status = cmp_picture_open(&t->picture, name, why);
    if (status != CV_OK)
        return status;
    t->status = KINDS[t->kind].draw(&t->picture, &t->figure, &t->why);
    if (t->status == CV_UNDECIDED || (t->status == CV_OK && t->picture.absent))
        return CV_OK;
    return t->status == CV_OK ? cmp_picture_publish(&t->picture, &p->album, why)
                              : cv_fail(why, t->status, "%s: %s", name, t->why.text);
}

/* CV_UNDECIDED: some could not be computed. */
static cv_status list_pictures(const plan *p, FILE *out)
{
    cv_status status = CV_OK;
    char of[CMP_PICTURE_SHOWS];
    int width = 0;
    for (size_t i = 0; i < p->count; i++)
        width = (int)fmax(width, (double)strlen(p->tasks[i].picture.name));
    for (size_t i = 0; i < p->count; i++) {
        const task *t = &p->tasks[i];
        const char *doubt = t->picture.doubt.text;
        if (t->status == CV_OK && !t->picture.absent)
            fprintf(out, "%-*s  %s%s%s\n", width, t->picture.name, t->picture.shows,
                    doubt[0] != '\0' ? "; undecided: " : "", doubt);
        else
            fprintf(out, "%-*s  not drawn, %s: %s\n", width, t->picture.name, cmp_figure_case(of, &t->figure),
                    t->status == CV_OK ? t->picture.shows : t->why.text);
        if (t->status != CV_OK || doubt[0] != '\0')
            status = CV_UNDECIDED;
    }
    return status;
}

static cv_status draw_all(const options *o, const cv_casefile *file, FILE *out, FILE *log, cv_message *why)
{
    plan p = {0};
    cmp_progress_line line = {log, "figures", 0};
    const cmp_listener listener = cmp_progress_listener(&line);
    cv_status status = plan_make(&p, file, o, why);
    if (status == CV_OK)
        status = cmp_album_open(&p.album, o->folder, o->formats, why);
    if (status == CV_OK)
        status = cmp_pool_run(o->threads, p.count, do_task, &p, &listener, why);
    if (line.shown)
        fputc('\n', log);
    if (status == CV_OK)
        status = list_pictures(&p, out);
    plan_clear(&p);
    return status;
}

static cv_status check(const options *o, cv_message *why)
{
    const cv_selection *s = &o->selection;
    if (o->folder == NULL)
        return cv_fail(why, CV_BAD_INPUT, "missing option -o DIR; see figures --help");
    if (cv_number_sign(&s->damping.value) < 0)
        return cv_fail(why, CV_BAD_INPUT, "--damping must not be negative");
    if (s->alpha.given && cv_number_sign(&s->alpha.value) <= 0)
        return cv_fail(why, CV_BAD_INPUT, "--alpha must be positive");
    if (s->mass_ratio.given && cv_number_sign(&s->mass_ratio.value) <= 0)
        return cv_fail(why, CV_BAD_INPUT, "--mass-ratio must be positive");
    return CV_OK;
}

static cv_status work(const void *typed, const cv_arguments *arguments, FILE *out, FILE *log, cv_message *why)
{
    const options *o = typed;
    cv_casefile file;
    cv_status status = check(o, why);
    if (status == CV_OK)
        status = cv_casefile_read(&file, arguments->path, why);
    if (status != CV_OK)
        return status;
    status = draw_all(o, &file, out, log, why);
    cv_casefile_clear(&file);
    return status;
}

int cmp_figures_main(int argc, char **argv)
{
    static const char *const commands[] = {"figures", NULL};
    const cv_program program = {"critvel-compare", HELP, commands, OPTIONS, work};
    options o = {.folder = NULL, .formats = CMP_SVG | CMP_PDF};
    gsl_set_error_handler_off();
    cv_selection_init(&o.selection);
    const int status = cv_main(&program, &o, argc, argv);
    cv_selection_clear(&o.selection);
    return status;
}
