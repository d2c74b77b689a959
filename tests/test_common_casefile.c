/* The case file: what a valid one gives, and the exact message for each wrong one. */
#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/casefile.h"
#include "tests/seed.h"

/* A file of the given bytes with a name that is written to path. */
static void write_file(char path[64], const char *bytes, size_t n)
{
    snprintf(path, 64, "/tmp/critvel-test-XXXXXX");
    const int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    FILE *out = fdopen(fd, "wb");
    ck_assert_ptr_nonnull(out);
    ck_assert(fwrite(bytes, 1, n, out) == n);
    ck_assert_int_eq(fclose(out), 0);
}

static cv_status read_bytes(cv_casefile *f, const char *bytes, size_t n, cv_message *why, char path[64])
{
    write_file(path, bytes, n);
    const cv_status status = cv_casefile_read(f, path, why);
    unlink(path);
    return status;
}

static void read_valid(cv_casefile *f, const char *text)
{
    cv_message why = {""};
    char path[64];
    ck_assert_msg(read_bytes(f, text, strlen(text), &why, path) == CV_OK, "%s", why.text);
}

static void assert_text(const cv_number *x, const char *expected)
{
    char *text = cv_number_text(x, 20);
    ck_assert_str_eq(text, expected);
    free(text);
}

#define CASE "[case 1]\nmu_s = 6\nmu_b = 35\nkappa_p = 300\nkappa_b = 7\n"
#define RUN "[run]\ndamping = 0.1\nmass_ratio = 3\n"

START_TEST(example_of_the_design)
{
    cv_casefile f;
    read_valid(&f, "[run]\n"
                   "damping    = 0.1 0.05 1e-4 1e-10     ; eta_p = eta_b = eta_f\n"
                   "mass_ratio = 1 3 10 30 100 300 1000\n"
                   "alpha      = 0.02 2.0                ; velocity range searched\n"
                   "digits     = 30                      ; digits the answers must have\n"
                   "[case 1]\nmu_s = 6\nmu_b = 35\nkappa_p = 300\nkappa_b = 7\neta_s = 0\neta_N = 0\n"
                   "[case soft pad]\nmu_s = 3\nmu_b = 10\nkappa_p = 0.03\nkappa_b = 0.1\n");
    ck_assert_uint_eq(f.case_count, 2);
    ck_assert_int_eq(f.digits, 30);
    assert_text(&f.alpha_min, "0.02");
    assert_text(&f.alpha_max, "2");
    const cv_case *c = &f.cases[1];
    ck_assert_str_eq(c->name, "soft pad");
    ck_assert_int_eq(c->line, 13);
    ck_assert_int_eq(c->is_track, 0);
    ck_assert_uint_eq(c->level_count, 4);
    ck_assert_uint_eq(c->mass_count, 7);
    assert_text(&c->levels[3].eta_b, "1e-10");
    assert_text(&c->mass_ratios[6], "1000");
    assert_text(&c->params.kappa_p, "0.03");
    assert_text(&c->params.eta_f, "0.1"); /* level 0 */
    assert_text(&f.cases[0].params.mu_b, "35");
    cv_casefile_clear(&f);
}
END_TEST

START_TEST(defaults)
{
    cv_casefile f;
    read_valid(&f, RUN CASE);
    assert_text(&f.alpha_min, "0.02");
    assert_text(&f.alpha_max, "2");
    ck_assert_int_eq(f.digits, 20);
    ck_assert_int_eq(cv_number_sign(&f.cases[0].params.eta_s), 0);
    ck_assert_int_eq(cv_number_sign(&f.cases[0].params.eta_N), 0);
    cv_casefile_clear(&f);
}
END_TEST

START_TEST(unequal_dampings_and_run_at_the_end)
{
    cv_casefile f;
    cv_params p;
    read_valid(&f,
               CASE "[run]\nmass_ratio=3\ndamping_f = 0 0.3\ndamping_p = 0.1 0.2\ndamping_b: 1e-3 1e-4\n");
    ck_assert_uint_eq(f.cases[0].level_count, 2);
    cv_params_init(&p);
    cv_case_params(&p, &f.cases[0], 1);
    assert_text(&p.eta_p, "0.2");
    assert_text(&p.eta_b, "0.0001");
    assert_text(&p.eta_f, "0.3");
    assert_text(&p.kappa_b, "7");
    cv_params_clear(&p);
    cv_casefile_clear(&f);
}
END_TEST

/* Byte order mark, CR LF, blanks, indentation, comments of both kinds, no newline at the end. */
START_TEST(forms_of_text)
{
    cv_casefile f;
    read_valid(&f, "\xEF\xBB\xBF# head\r\n\r\n  [run] ; settings\r\n\tdamping=0.1\t0.2 # two\r\n"
                   "    mass_ratio   =3\r\n ; indented comment\r\n[track  K\xC3\xA4se;1#2 ]\r\n"
                   "  EI=1e6\r\n  m=100\r\n  k_p=1\r\n  m_s=1\r\n  k_b=1\r\n  m_b=1\r\n  k_f=64e6");
    ck_assert_uint_eq(f.case_count, 1);
    ck_assert_str_eq(f.cases[0].name, "K\xC3\xA4se;1#2");
    ck_assert_uint_eq(f.cases[0].level_count, 2);
    assert_text(&f.cases[0].levels[1].eta_f, "0.2");
    cv_casefile_clear(&f);
}
END_TEST

/* 700 numbers on one line: far more than inih's own buffer */
START_TEST(long_list)
{
    char text[8192] = "[run]\ndamping = 0.1 ; first\nmass_ratio =";
    for (int i = 1; i <= 700; ++i)
        snprintf(text + strlen(text), 32, " %d.%03d", i, i);
    strcat(text, " ; and a comment\n" CASE);
    cv_casefile f;
    read_valid(&f, text);
    ck_assert_uint_eq(f.cases[0].mass_count, 700);
    assert_text(&f.cases[0].mass_ratios[0], "1.001");
    assert_text(&f.cases[0].mass_ratios[699], "700.7");
    for (int i = 0; i < 700; ++i) {
        char expected[32];
        snprintf(expected, sizeof expected, "%d.%03d", i + 1, i + 1);
        cv_number x;
        cv_message why;
        cv_number_init(&x);
        ck_assert_int_eq(cv_number_parse(&x, expected, &why), CV_OK);
        ck_assert_int_eq(cv_number_compare(&x, &f.cases[0].mass_ratios[i]), 0);
        cv_number_clear(&x);
    }
    cv_casefile_clear(&f);
}
END_TEST

#define TRACK                                                                                                \
    "[track A]\nEI = 1e6\nm = 100\nk_f = 64e6\nk_p = 192e6\nk_b = 32e6\nm_s = 300\nm_b = 1050\n"             \
    "c_p = 16e3\nc_b = 8e3\nc_f = 1.6e-5\nk_s = 3.2e6\nN = -1.6e6\n"

/* The example of test_common_track.c: without [run] a track has its own damping and mass. */
START_TEST(track_of_its_own)
{
    cv_casefile f;
    read_valid(&f, TRACK "M = 5000\nP = 128e3\n");
    const cv_case *c = &f.cases[0];
    ck_assert_int_eq(c->is_track, 1);
    ck_assert_uint_eq(c->level_count, 1);
    assert_text(&c->levels[0].eta_p, "0.1");
    assert_text(&c->levels[0].eta_b, "0.05");
    assert_text(&c->levels[0].eta_f, "1e-10");
    ck_assert_uint_eq(c->mass_count, 1);
    assert_text(&c->mass_ratios[0], "100");
    assert_text(&c->params.eta_s, "0.2");
    assert_text(&c->physical.P, "128000");
    cv_casefile_clear(&f);
}
END_TEST

START_TEST(run_overrides_a_track)
{
    cv_casefile f;
    read_valid(&f, TRACK "M = 5000\n" RUN);
    assert_text(&f.cases[0].levels[0].eta_f, "0.1");
    assert_text(&f.cases[0].params.eta_f, "0.1");
    assert_text(&f.cases[0].mass_ratios[0], "3");
    cv_casefile_clear(&f);
}
END_TEST

START_TEST(cases_by_name)
{
    cv_casefile f;
    const cv_case *c;
    cv_message why;
    read_valid(&f, RUN CASE TRACK);
    ck_assert_int_eq(cv_casefile_find(&c, &f, NULL, &why), CV_OK);
    ck_assert_str_eq(c->name, "1");
    ck_assert_int_eq(cv_casefile_find(&c, &f, "A", &why), CV_OK);
    ck_assert_str_eq(c->name, "A");
    ck_assert_int_eq(cv_casefile_find(&c, &f, "2", &why), CV_BAD_INPUT);
    ck_assert_ptr_nonnull(strstr(why.text, "no case '2' in the file; there is: 1, A"));
    cv_casefile_clear(&f);
}
END_TEST

START_TEST(files_of_the_repository)
{
    cv_casefile f;
    cv_message why = {""};
    ck_assert_msg(cv_casefile_read(&f, "data/paper.ini", &why) == CV_OK, "%s", why.text);
    ck_assert_uint_eq(f.case_count, 4);
    ck_assert_uint_eq(f.cases[3].level_count * f.cases[3].mass_count, 28);
    cv_casefile_clear(&f);
    ck_assert_msg(cv_casefile_read(&f, "data/track.ini", &why) == CV_OK, "%s", why.text);
    for (size_t i = 0; i < f.case_count; ++i) {
        ck_assert_int_eq(f.cases[i].is_track, 1);
        ck_assert_msg(cv_params_warn(&f.cases[i].params, &why) == 0, "%s", why.text);
        ck_assert_int_gt(cv_number_sign(&f.cases[i].physical.M), 0);
    }
    cv_casefile_clear(&f);
}
END_TEST

typedef struct {
    const char *text;
    const char *message; /* after the path */
} wrong_file;

#define TEN "0123456789"
#define HUNDRED TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN

static const wrong_file wrong[] = {
    {"", ": the file is empty"},
    {"\n; nothing\n", ": no [case NAME] or [track NAME] section"},
    {RUN, ": no [case NAME] or [track NAME] section"},
    {"mu_s = 6\n", ":1: key before the first section"},
    {"[run\n", ":1: expected '[section]' and nothing else on the line"},
    {"\n[run] x\n", ":2: expected '[section]' and nothing else on the line"},
    {RUN "hello\n", ":4: expected 'key = value', found 'hello'"},
    {RUN "= 5\n", ":4: expected 'key = value', found '= 5'"},
    {RUN "[cases]\n", ":4: unknown section [cases]; expected [run], [case NAME] or [track NAME]"},
    {RUN "[]\n", ":4: unknown section []; expected [run], [case NAME] or [track NAME]"},
    {RUN "[case]\n", ":4: [case] without a name"},
    {RUN "[track  ]\n", ":4: [track] without a name"},
    {RUN CASE "[run]\n", ":9: duplicate section [run] (first on line 1)"},
    {RUN CASE CASE, ":9: duplicate name '1' (first on line 4)"},
    {RUN CASE "[track 1]\n", ":9: duplicate name '1' (first on line 4)"},
    {RUN "[case " HUNDRED "]\n", ":4: section name of more than 49 bytes"},
    {RUN CASE "mu_x = 1\n", ":9: unknown key 'mu_x' in [case 1]"},
    {RUN CASE "eta_p = 1\n", ":9: unknown key 'eta_p' in [case 1]"},
    {RUN "speed = 1\n" CASE, ":4: unknown key 'speed' in [run]"},
    {RUN "damping_x = 1\n" CASE, ":4: unknown key 'damping_x' in [run]"},
    {RUN CASE "mu_s = 6\n", ":9: duplicate key 'mu_s' (first on line 5)"},
    {RUN "[case 1]\nmu_s = 6\n\nmu_b = 35\nkappa_p = 300\n", ":4: missing key 'kappa_b' in [case 1]"},
    {RUN "[case 1]\n[case 2]\n", ":4: missing key 'mu_s' in [case 1]"},
    {RUN "[track T]\nm = 1\n", ":4: missing key 'EI' in [track T]"},
    {"[run]\nmass_ratio = 3\n" CASE, ":1: missing key 'damping' in [run], which [case 1] needs"},
    {CASE, ":1: missing key 'damping' in [run], which [case 1] needs"},
    {"[run]\ndamping = 0\n" CASE, ":1: missing key 'mass_ratio' in [run], which [case 1] needs"},
    {TRACK, ":1: missing key 'mass_ratio' in [run]; [track A] has no M either"},
    {"[run]\nmass_ratio = 3\ndamping_p = 1\ndamping_f = 1\n" CASE, ":1: missing key 'damping_b' in [run]"},
    {"[run]\nmass_ratio = 3\ndamping_p = 1\ndamping_b = 1\ndamping_f = 1 2\n" CASE,
     ":3: damping_p: 1 levels, another of the damping lists has 2"},
    {RUN "damping_p = 1\n" CASE, ":4: damping_p beside damping: give one or the other"},
    {RUN CASE "eta_s = 1x\n", ":9: eta_s: '1x' is not a decimal number"},
    {RUN CASE "eta_s = 1,5\n", ":9: eta_s: '1,5' is not a decimal number"},
    {RUN CASE "eta_s = nan\n", ":9: eta_s: 'nan' is not a decimal number"},
    {RUN CASE "eta_s = inf\n", ":9: eta_s: 'inf' is not a decimal number"},
    {RUN CASE "eta_s = 1e400\n", ":9: eta_s: '1e400' is outside 1e-300 .. 1e300"},
    {RUN CASE "eta_s = -1e-9\n", ":9: eta_s: must be >= 0"},
    {RUN CASE "eta_s = 1 2\n", ":9: eta_s: one number expected, 2 found"},
    {RUN CASE "eta_s =\n", ":9: eta_s: a number is missing"},
    {RUN CASE "eta_s = ; 5\n", ":9: eta_s: a number is missing"},
    {RUN "[case 1]\nmu_s = -6\n", ":5: mu_s: must be > 0"},
    {RUN "[case 1]\nkappa_p = 0\n", ":5: kappa_p: must be > 0"},
    {TRACK "M = 0\n", ":14: M: must be > 0"},
    {TRACK "M = 1\nP = -3\n", ":15: P: must be > 0"},
    {"[run]\ndamping = 0.1 -0.05\n", ":2: damping: must be >= 0"},
    {"[run]\ndamping =\n", ":2: damping: a number is missing"},
    {"[run]\ndamping = 0.1, 0.05\n", ":2: damping: '0.1,' is not a decimal number"},
    {"[run]\nmass_ratio = 3 0\n", ":2: mass_ratio: must be > 0"},
    {"[run]\nmass_ratio = ;\n", ":2: mass_ratio: a number is missing"},
    {RUN "alpha = 0.5\n", ":4: alpha: two numbers expected, 1 found"},
    {RUN "alpha = 0.1 0.2 0.3\n", ":4: alpha: two numbers expected, 3 found"},
    {RUN "alpha = 2 0.02\n", ":4: alpha: empty range, the first number must be the smaller"},
    {RUN "alpha = 0.5 0.50\n", ":4: alpha: empty range, the first number must be the smaller"},
    {RUN "alpha = 0 1\n", ":4: alpha: must be > 0"},
    {RUN "digits = 0\n", ":4: digits: '0' is not a whole number from 1 to 1000"},
    {RUN "digits = 100000\n", ":4: digits: '100000' is not a whole number from 1 to 1000"},
    {RUN "digits = 20.0\n", ":4: digits: '20.0' is not a whole number from 1 to 1000"},
    {RUN "digits = 99999999999999999999\n",
     ":4: digits: '99999999999999999999' is not a whole number from 1 to 1000"},
    {RUN "digits =\n", ":4: digits: '' is not a whole number from 1 to 1000"},
    {RUN CASE "eta_N = 1\n", ":9: eta_N is at or beyond buckling of the resting track (critical eta_N = "
                             "0.9340531776)"},
    {RUN CASE "eta_s = 2\neta_N = 1.9\n",
     ":10: eta_N is at or beyond buckling of the resting track (critical "
     "eta_N = 1.899472234)"},
    {RUN "mass = \1\n", ":4: not text (a control character or malformed UTF-8)"},
    {RUN "\n; caf\xE9\n", ":5: not text (a control character or malformed UTF-8)"},
    {RUN "; \xC0\x80\n", ":4: not text (a control character or malformed UTF-8)"},
    {RUN "; \xE0\x9F\xBF\n", ":4: not text (a control character or malformed UTF-8)"},
    {RUN "; \xF0\x8F\xBF\xBF\n", ":4: not text (a control character or malformed UTF-8)"},
    {RUN "; \xF4\x90\x80\x80\n", ":4: not text (a control character or malformed UTF-8)"},
    {RUN "; \xE2\x82\n", ":4: not text (a control character or malformed UTF-8)"},
    {RUN "; \xED\xA0\x80\n", ":4: not text (a control character or malformed UTF-8)"},
    {"[run]\rdamping = 1\r", ":1: not text (a control character or malformed UTF-8)"},
    {"\xFF\xFE[\0r\0", ":1: not text (a control character or malformed UTF-8)"},
    {RUN CASE "eta_s = 1" HUNDRED HUNDRED "\n", ":9: a word of more than 196 bytes"},
};

START_TEST(wrong_files)
{
    cv_casefile f;
    cv_message why = {""};
    char path[64];
    const cv_status status = read_bytes(&f, wrong[_i].text, strlen(wrong[_i].text), &why, path);
    ck_assert_msg(status == CV_BAD_INPUT, "status %d: %s", (int)status, wrong[_i].text);
    ck_assert_uint_gt(strlen(why.text), strlen(path));
    ck_assert_int_eq(strncmp(why.text, path, strlen(path)), 0);
    ck_assert_str_eq(why.text + strlen(path), wrong[_i].message);
}
END_TEST

static void assert_refused(const char *path, const char *part)
{
    cv_casefile f;
    cv_message why = {""};
    ck_assert_int_eq(cv_casefile_read(&f, path, &why), CV_BAD_INPUT);
    ck_assert_msg(strstr(why.text, part) != NULL, "%s", why.text);
    ck_assert_ptr_null(strchr(why.text, '\n'));
}

START_TEST(what_is_not_a_file)
{
    assert_refused("/nonexistent/file.ini", "/nonexistent/file.ini: cannot open: No such file or directory");
    assert_refused("/nonexistent/a\nb\033[31m.ini", "a?b?[31m.ini: cannot open");
    assert_refused("/tmp", "/tmp: is a directory");
    assert_refused("", ": cannot open: No such file or directory");
    assert_refused("/dev/zero", "/dev/zero: larger than 4194304 bytes");
    assert_refused("/dev/null", "/dev/null: the file is empty");
}
END_TEST

START_TEST(file_without_permission)
{
    char path[64];
    write_file(path, CASE, strlen(CASE));
    ck_assert_int_eq(chmod(path, 0), 0);
    if (access(path, R_OK) != 0) /* root reads everything */
        assert_refused(path, "cannot open: Permission denied");
    unlink(path);
}
END_TEST

START_TEST(nul_byte)
{
    static const char bytes[] = RUN CASE "eta_s = 1\0 2\n";
    cv_casefile f;
    cv_message why;
    char path[64];
    ck_assert_int_eq(read_bytes(&f, bytes, sizeof bytes - 1, &why, path), CV_BAD_INPUT);
    ck_assert_ptr_nonnull(strstr(why.text, ":9: not text"));
}
END_TEST

/* A line of a megabyte, in a value and in a comment, and a name that fills a message. */
START_TEST(huge_lines)
{
    enum { MEGABYTE = 1 << 20 };
    char *text = malloc(MEGABYTE + 300);
    ck_assert_ptr_nonnull(text);
    static const char *const beginnings[] = {RUN CASE "eta_s = 0.", RUN CASE "; ", RUN CASE "[case "};
    for (size_t i = 0; i < 3; ++i) {
        cv_casefile f;
        cv_message why;
        char path[64];
        strcpy(text, beginnings[i]);
        const size_t n = strlen(text);
        memset(text + n, '1', MEGABYTE);
        strcpy(text + n + MEGABYTE, "\n");
        ck_assert_int_eq(read_bytes(&f, text, strlen(text), &why, path), CV_BAD_INPUT);
        ck_assert_str_eq(why.text + strlen(path), ":9: line of more than 65536 bytes");
    }
    memset(text, 'x', 5000);
    text[0] = '/';
    strcpy(text + 5000, "/end.ini");
    assert_refused(text, "xxx/end.ini: cannot open: File name too long");
    free(text);
}
END_TEST

/* Files that would take long to search for duplicates are refused. */
START_TEST(too_many)
{
    char *text = NULL;
    size_t size;
    cv_casefile f;
    cv_message why;
    char path[64];
    FILE *out = open_memstream(&text, &size);
    for (int i = 0; i < 200000; ++i)
        fprintf(out, "[case %d]\n", i);
    fclose(out);
    ck_assert_int_eq(read_bytes(&f, text, size, &why, path), CV_BAD_INPUT);
    ck_assert_str_eq(why.text + strlen(path), ":10001: more than 10000 sections");
    free(text);
    out = open_memstream(&text, &size);
    fprintf(out, "[run]\n");
    for (int i = 0; i < 200000; ++i)
        fprintf(out, "key%d=1\n", i);
    fclose(out);
    ck_assert_int_eq(read_bytes(&f, text, size, &why, path), CV_BAD_INPUT);
    ck_assert_str_eq(why.text + strlen(path), ":1002: more than 1000 keys in a section");
    free(text);
}
END_TEST

/* A line of 65536 bytes is read, one more is not. */
START_TEST(longest_line)
{
    static const char end[] = "\n" RUN CASE;
    char text[65600 + sizeof end];
    for (size_t n = 65536; n <= 65537; ++n) {
        cv_casefile f;
        cv_message why;
        char path[64];
        memset(text, ';', n);
        strcpy(text + n, end);
        const cv_status status = read_bytes(&f, text, strlen(text), &why, path);
        ck_assert_int_eq(status, n == 65536 ? CV_OK : CV_BAD_INPUT);
        if (status == CV_OK)
            cv_casefile_clear(&f);
    }
}
END_TEST

/* The first and last characters of each length of UTF-8 */
START_TEST(characters_of_every_length)
{
    cv_casefile f;
    read_valid(&f, "; \xC2\x80 \xDF\xBF \xE0\xA0\x80 \xED\x9F\xBF \xEE\x80\x80 \xEF\xBF\xBF "
                   "\xF0\x90\x80\x80 \xF4\x8F\xBF\xBF\n" RUN CASE);
    cv_casefile_clear(&f);
}
END_TEST

/* A mutated file is read or refused with one line; the sanitizers watch the rest. */
START_TEST(random_mutations)
{
    static const char *const pieces[] = {
        "[run]\n", "[case 1]", "[track T]\n", "=",  ";", "#",        "\n",  "\r\n", "e999",    "-",      "0",
        " ",       "]",        "[",           "\t", ":", "\xC3\xA4", "nan", "mu_s", "damping", "M = 1\n"};
    static const char base[] = RUN "alpha = 0.1 1\n" CASE TRACK;
    seed_random r = seed_start("random_mutations");
    int valid = 0;
    for (int i = 0; i < 3000; ++i) {
        char text[2 * sizeof base + 200], path[64];
        memcpy(text, base, sizeof base);
        size_t n = sizeof base - 1;
        for (unsigned j = 1 + seed_below(&r, 5); j > 0 && n > 100; --j) {
            const size_t at = seed_below(&r, (unsigned)n), cut = seed_below(&r, 4) ? seed_below(&r, 8) : 60;
            const char *piece = pieces[seed_below(&r, sizeof pieces / sizeof pieces[0])];
            const size_t gone = at + cut > n ? n - at : cut, added = seed_below(&r, 3) ? strlen(piece) : 0;
            memmove(text + at + added, text + at + gone, n - at - gone);
            memcpy(text + at, piece, added);
            n += added - gone;
        }
        if (seed_below(&r, 4) == 0)
            text[seed_below(&r, (unsigned)n)] = (char)seed_below(&r, 256);
        cv_casefile f;
        cv_message why = {""};
        const cv_status status = read_bytes(&f, text, n, &why, path);
        if (status == CV_OK) {
            ++valid;
            ck_assert_uint_gt(f.case_count, 0);
            cv_casefile_clear(&f);
        } else {
            ck_assert_int_eq(status, CV_BAD_INPUT);
            ck_assert_int_eq(strncmp(why.text, path, strlen(path)), 0);
            ck_assert_ptr_null(strpbrk(why.text, "\n\r"));
        }
    }
    ck_assert_int_gt(valid, 0);
    ck_assert_int_lt(valid, 3000);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("common/casefile");
    TCase *c = tcase_create("casefile");
    tcase_add_test(c, example_of_the_design);
    tcase_add_test(c, defaults);
    tcase_add_test(c, unequal_dampings_and_run_at_the_end);
    tcase_add_test(c, forms_of_text);
    tcase_add_test(c, long_list);
    tcase_add_test(c, track_of_its_own);
    tcase_add_test(c, run_overrides_a_track);
    tcase_add_test(c, cases_by_name);
    tcase_add_test(c, files_of_the_repository);
    tcase_add_loop_test(c, wrong_files, 0, (int)(sizeof wrong / sizeof wrong[0]));
    tcase_add_test(c, what_is_not_a_file);
    tcase_add_test(c, file_without_permission);
    tcase_add_test(c, nul_byte);
    tcase_add_test(c, huge_lines);
    tcase_add_test(c, too_many);
    tcase_add_test(c, longest_line);
    tcase_add_test(c, characters_of_every_length);
    tcase_add_test(c, random_mutations);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
