#include "dgreen/curve_station.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

cv_status dg_station_set(dg_station *s, const dg_branch_curves *b, double alpha, cv_message *why)
{
    if (s->points == NULL) {
        s->points = malloc((dg_branch_points_max(b) + 1) * sizeof *s->points);
        if (s->points == NULL)
            return cv_fail(why, CV_FAILED, "out of memory");
    }
    s->alpha = alpha;
    s->count = dg_branch_points_at(s->points, b, alpha);
    s->hard_count = 0;
    for (size_t i = 0; i < s->count; i++)
        s->hard_count += !s->points[i].soft;
    return CV_OK;
}

void dg_station_clear(dg_station *s)
{
    free(s->points);
    *s = (dg_station){0};
}

double dg_station_position(const dg_station *s, double q)
{
    double position = log(q);
    for (size_t i = 0; i < s->count; i++)
        if (!s->points[i].soft)
            position += asinh((q - s->points[i].q) / s->points[i].width);
    return position;
}

double dg_station_frequency(const dg_station *s, double position)
{
    double low = 1, high = 1;
    while (low > DBL_MIN && dg_station_position(s, low) > position)
        low /= 16;
    while (high < DBL_MAX / 16 && dg_station_position(s, high) < position)
        high *= 16;
    for (int i = 0; i < 200 && high - low > DBL_EPSILON * high; i++) {
        const double middle = dg_station_middle(s, low, high);
        *(dg_station_position(s, middle) < position ? &low : &high) = middle;
    }
    return low + (high - low) / 2;
}

double dg_station_scale(const dg_station *s, double q)
{
    double scale = q;
    for (size_t i = 0; i < s->count; i++)
        scale = fmin(scale, hypot(q - s->points[i].q, s->points[i].width));
    return scale;
}

const dg_branch_point *dg_station_nearest(const dg_station *s, double q)
{
    const dg_branch_point *nearest = NULL;
    for (size_t i = 0; i < s->count; i++)
        if (!s->points[i].soft && (nearest == NULL || fabs(q - s->points[i].q) < fabs(q - nearest->q)))
            nearest = &s->points[i];
    return nearest;
}

double dg_station_middle(const dg_station *s, double a, double b)
{
    double left = 0, left_width = 0, right = INFINITY, right_width = 0;
    for (size_t i = 0; i < s->count; i++) {
        const dg_branch_point *point = &s->points[i];
        if (point->q <= a) {
            left = point->q;
            left_width = point->width;
        } else if (point->q >= b) {
            right = point->q;
            right_width = point->width;
            break;
        }
    }
    double middle;
    if (a - left <= right - b)
        middle = left - left_width + sqrt((a - left + left_width) * (b - left + left_width));
    else
        middle = right + right_width - sqrt((right - a + right_width) * (right - b + right_width));
    return middle > a && middle < b ? middle : a + (b - a) / 2;
}
