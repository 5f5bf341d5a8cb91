#include <math.h>

#include "deviation.h"
#include "kernel.h"
#include "select.h"

enum { GRAIN = 1 << 14 };

/* Part of a statistic: the largest distance, and the squares over the square of the overall largest one. */
typedef struct part {
    double largest, sum;
    pia_index index;
} part;

typedef struct statistic {
    const double *distances;
    pia_index count, chunks;
    double scale;
    part *parts; /* [chunks] */
} statistic;

static void find_largest(void *work, pia_index chunk)
{
    const statistic *s = work;
    part *p = &s->parts[chunk];
    p->index = pia_chunk_begin(s->count, s->chunks, chunk);
    for (pia_index i = p->index; i < pia_chunk_begin(s->count, s->chunks, chunk + 1); i++)
        if (s->distances[i] > s->distances[p->index]) p->index = i;
    p->largest = s->distances[p->index];
}

/* Adds with the rounding errors kept apart (Neumaier; the terms are at most 1, the sum grows). */
static void add(double value, double *sum, double *lost)
{
    double next = *sum + value;
    *lost += fabs(*sum) >= fabs(value) ? (*sum - next) + value : (value - next) + *sum;
    *sum = next;
}

static void sum_squares(void *work, pia_index chunk)
{
    const statistic *s = work;
    double sum = 0, lost = 0;
    for (pia_index i = pia_chunk_begin(s->count, s->chunks, chunk); i < pia_chunk_begin(s->count, s->chunks, chunk + 1); i++) {
        double ratio = s->distances[i] / s->scale;
        add(ratio * ratio, &sum, &lost);
    }
    s->parts[chunk].sum = sum + lost;
}

static void summarize(pia_context *context, statistic *s, pia_deviation *out)
{
    pia_for_each(context, s->chunks, find_largest, s);
    part largest = s->parts[0];
    for (pia_index c = 1; c < s->chunks; c++)
        if (s->parts[c].largest > largest.largest) largest = s->parts[c];
    s->scale = largest.largest > 0 ? largest.largest : 1;
    pia_for_each(context, s->chunks, sum_squares, s);
    double sum = 0, lost = 0;
    for (pia_index c = 0; c < s->chunks; c++) add(s->parts[c].sum, &sum, &lost);
    out->max_error = largest.largest;
    out->max_error_index = largest.index;
    out->rms_error = s->scale * sqrt((sum + lost) / (double)s->count);
}

/* Rank of the smallest value that `percent` of count values do not exceed. */
static pia_index nearest_rank(pia_index count, int percent)
{
    return count / 100 * percent + (count % 100 * percent + 99) / 100 - 1;
}

pia_status pia_deviation_summarize(pia_context *context, double *distances, pia_index count, pia_deviation *out)
{
    static const int percents[3] = {50, 90, 99};
    statistic s = {distances, count, pia_chunk_count(count, GRAIN), 1, NULL};
    s.parts = pia_take(context, s.chunks, sizeof *s.parts);
    if (s.parts == NULL) return pia_take_status(context, s.chunks, sizeof *s.parts);
    *out = (pia_deviation){.struct_size = sizeof *out, .point_count = count};
    summarize(context, &s, out);
    pia_give(context, s.parts);
    pia_index begin = 0;
    for (int k = 0; k < 3; k++) {
        pia_index rank = nearest_rank(count, percents[k]);
        out->percentile[k] = pia_select(distances + begin, count - begin, rank - begin);
        begin = rank;
    }
    return PIA_OK;
}
