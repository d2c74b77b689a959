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

/* asinh x = +-log(|x| + sqrt(x^2 + 1)): one logarithm for products as long as they are in the range of
 * doubles. */
double dg_station_position(const dg_station *s, double q)
{
    double position = 0, product = q;
    for (size_t i = 0; i < s->count; i++) {
        if (s->points[i].soft)
            continue;
        const double x = (q - s->points[i].q) / s->points[i].width, factor = fabs(x) + sqrt(x * x + 1);
        product = x < 0 ? product / factor : product * factor;
        if (!(product > 1e-200 && product < 1e200)) {
            position += log(product);
            product = 1;
        }
    }
    return position + log(product);
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
    double square = q * q;
    for (size_t i = 0; i < s->count; i++) {
        const double distance = q - s->points[i].q, width = s->points[i].width;
        const double own = distance * distance + width * width;
        square = own < square ? own : square;
    }
    return sqrt(square);
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
