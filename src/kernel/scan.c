#include "scan.h"

#include "clones.h"
#include "kernel.h"

#include <math.h>

enum { TOGETHER = 4, LANES = TOGETHER * PIA_MAX_DIM };

/* Rows are taken four at a time as one array of 4 dim lanes, so that the inner loop has no stride. A value that is not finite times 0
 * is NaN and stays in its sum. */
PIA_INLINE void scan_lanes(const double *points, pia_index groups, int lanes, double *low, double *high, double *sum)
{
    for (int l = 0; l < lanes; l++) {
        low[l] = high[l] = points[l];
        sum[l] = 0;
    }
    for (pia_index g = 0; g < groups; g++, points += lanes)
        for (int l = 0; l < lanes; l++) {
            low[l] = points[l] < low[l] ? points[l] : low[l];
            high[l] = points[l] > high[l] ? points[l] : high[l];
            sum[l] += points[l] * 0;
        }
}

PIA_CLONES static void scan_groups(const double *points, pia_index groups, int dim, double *low, double *high, double *sum)
{
    switch (dim) {
    case 1: scan_lanes(points, groups, TOGETHER, low, high, sum); break;
    case 2: scan_lanes(points, groups, 2 * TOGETHER, low, high, sum); break;
    case 3: scan_lanes(points, groups, 3 * TOGETHER, low, high, sum); break;
    default: scan_lanes(points, groups, dim * TOGETHER, low, high, sum); break;
    }
}

static void join_lane(double low, double high, double sum, double *to_low, double *to_high, double *total)
{
    *to_low = fmin(*to_low, low);
    *to_high = fmax(*to_high, high);
    *total += sum;
}

int pia_scan_box(const double *points, pia_index rows, int dim, double *low, double *high)
{
    double lane_low[LANES], lane_high[LANES], lane_sum[LANES], total = 0;
    pia_index groups = rows / TOGETHER;
    for (int d = 0; d < dim; d++) {
        low[d] = INFINITY;
        high[d] = -INFINITY;
    }
    if (groups > 0) scan_groups(points, groups, dim, lane_low, lane_high, lane_sum);
    for (int l = 0; groups > 0 && l < dim * TOGETHER; l++)
        join_lane(lane_low[l], lane_high[l], lane_sum[l], &low[l % dim], &high[l % dim], &total);
    for (pia_index i = groups * TOGETHER * dim; i < rows * dim; i++)
        join_lane(points[i], points[i], points[i] * 0, &low[i % dim], &high[i % dim], &total);
    return !isnan(total);
}

/* Item i is the pair of values i, i + 1. */
PIA_CLONES static int never_falls(const void *data, pia_index from, pia_index to)
{
    const double *values = data;
    int all = 1;
    for (pia_index i = from; i < to; i++) all &= values[i] <= values[i + 1];
    return all;
}

PIA_CLONES static int always_rises(const void *data, pia_index from, pia_index to)
{
    const double *values = data;
    int all = 1;
    for (pia_index i = from; i < to; i++) all &= values[i] < values[i + 1];
    return all;
}

/* What lies between finite values in order is finite. */
static int ends_are_finite(const double *values, pia_index count)
{
    return count < 1 || (isfinite(values[0]) && isfinite(values[count - 1]));
}

int pia_scan_ordered(pia_context *context, const double *values, pia_index count)
{
    return ends_are_finite(values, count) && pia_all(context, count - 1, never_falls, values);
}

int pia_scan_rising(pia_context *context, const double *values, pia_index count)
{
    return ends_are_finite(values, count) && pia_all(context, count - 1, always_rises, values);
}
