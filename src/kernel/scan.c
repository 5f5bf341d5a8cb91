#include "scan.h"

#include "clones.h"
#include "kernel.h"

#include <math.h>

enum { TOGETHER = 4, LANES = TOGETHER * PIA_MAX_DIM, GRAIN = 65536, MAX_CHUNKS = 256 };

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

typedef struct order {
    const double *values;
    pia_index count, chunks;
    int *ordered; /* [chunks] */
} order;

PIA_CLONES static int never_falls(const double *values, pia_index count)
{
    int rises = 1;
    for (pia_index i = 1; i < count; i++) rises &= values[i] >= values[i - 1];
    return rises;
}

static void check_chunk(void *work, pia_index chunk)
{
    const order *o = work;
    pia_index from = pia_chunk_begin(o->count, o->chunks, chunk), to = pia_chunk_begin(o->count, o->chunks, chunk + 1);
    if (from > 0) from--; /* beside the last one of the chunk before */
    o->ordered[chunk] = never_falls(o->values + from, to - from);
}

int pia_scan_ordered(pia_context *context, const double *values, pia_index count)
{
    int ordered[MAX_CHUNKS];
    order o = {values, count, pia_chunk_count(count, GRAIN), ordered};
    if (count < 1) return 1;
    if (o.chunks > MAX_CHUNKS) o.chunks = MAX_CHUNKS;
    pia_for_each(context, o.chunks, check_chunk, &o);
    int all = isfinite(values[0]) && isfinite(values[count - 1]);
    for (pia_index c = 0; c < o.chunks; c++) all &= ordered[c];
    return all;
}
