/* One track with its instability lines and a counter of roots, for the tests of dgreen/lines.h. */
#ifndef CRITVEL_TESTS_DGREEN_LINES_FIXTURE_H
#define CRITVEL_TESTS_DGREEN_LINES_FIXTURE_H

#include <check.h>

#include "dgreen/count.h"
#include "dgreen/lines.h"
#include "tests/dgreen_points.h"

static const char *const case1 = "6 35 300 7 %s %s %s 0 0", *const case3 = "6 5 0.03 3 %s %s %s 0 0",
                         *const case4 = "3 10 0.03 0.1 %s %s %s 0 0";

/* One track with its lines in a range of alpha, 1 <= eta_M <= 1e4 unless said otherwise */
typedef struct {
    dg_track *track;
    double alpha_min, alpha_max;
    dg_lines lines;
    dg_counter *counter;
} fixture;

static inline void fixture_find(fixture *f, double mass_min, double mass_max)
{
    cv_message why = {""};
    ck_assert_msg(dg_lines_find(&f->lines, &f->track->exact, f->alpha_min, f->alpha_max, mass_min, mass_max,
                                &why) == CV_OK,
                  "%s", why.text);
    for (size_t i = 0; i < f->lines.doubt_count; i++)
        ck_abort_msg("%s", f->lines.doubts[i].why.text);
    ck_assert_int_eq(dg_counter_new(&f->counter, &f->track->exact, f->alpha_min, f->alpha_max, &why), CV_OK);
}

static inline void fixture_init(fixture *f, const char *format, const char *damping, double alpha_min,
                                double alpha_max)
{
    char text[200];
    snprintf(text, sizeof text, format, damping, damping, damping);
    f->track = track_of(text);
    f->alpha_min = alpha_min;
    f->alpha_max = alpha_max;
    fixture_find(f, 1, 1e4);
}

static inline void fixture_clear(fixture *f)
{
    dg_counter_free(f->counter);
    dg_lines_clear(&f->lines);
    dg_track_free(f->track);
}

static inline int by_winding(int *roots, const fixture *f, double alpha, double mass_ratio)
{
    cv_number m;
    cv_message why;
    size_t failed;
    char text[40];
    cv_number_init(&m);
    snprintf(text, sizeof text, "%.17g", mass_ratio);
    ck_assert_int_eq(cv_number_parse(&m, text, NULL), CV_OK);
    const cv_status status = dg_count_unstable(roots, &failed, f->counter, alpha, 1, &m, &why);
    cv_number_clear(&m);
    return status == CV_OK;
}

static inline int by_lines(const fixture *f, double alpha, double mass_ratio)
{
    int roots;
    cv_message why;
    ck_assert_msg(dg_lines_count(&roots, &f->lines, alpha, mass_ratio, &why) == CV_OK, "%s", why.text);
    return roots;
}

#endif
