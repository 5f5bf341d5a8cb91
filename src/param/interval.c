#include "interval.h"

#include <math.h>

#include "kernel.h"

#define INLINE static inline __attribute__((always_inline))

enum { GRAIN = 1 << 16, MAX_CHUNKS = 64 };

INLINE double distance(const double *a, const double *b, int dim, double scale)
{
    double sum = 0;
    for (int c = 0; c < dim; c++) {
        double d = (b[c] - a[c]) * scale;
        sum += d * d;
    }
    return sqrt(sum);
}

double pia_interval_chord(const pia_interval_source *s, pia_index i)
{
    pia_index next = i + 1 < s->count ? i + 1 : 0;
    return distance(s->points + i * s->dim, s->points + next * s->dim, s->dim, s->scale);
}

INLINE void chords(const pia_interval_source *s, pia_index begin, pia_index end, double *length, int dim)
{
    const double *p = s->points + begin * dim;
    for (pia_index i = begin; i < end; i++, p += dim) *length++ = distance(p, p + dim, dim, s->scale);
}

void pia_interval_chords(const pia_interval_source *s, pia_index begin, pia_index end, double *length)
{
    if (end == s->count) {
        end--;
        length[end - begin] = pia_interval_chord(s, end);
    }
    switch (s->dim) {
    case 1: chords(s, begin, end, length, 1); break;
    case 2: chords(s, begin, end, length, 2); break;
    case 3: chords(s, begin, end, length, 3); break;
    case 4: chords(s, begin, end, length, 4); break;
    default: chords(s, begin, end, length, s->dim); break;
    }
}

/* Two passes: sums inside each chunk, then the sum of the chunks before it is added and the total divided out. */
typedef struct accumulation {
    const pia_interval_source *source;
    pia_interval_rule *rule;
    double *parameters;
    pia_index intervals, chunks;
    double before[MAX_CHUNKS]; /* [chunks] total of a chunk, then the sum of those before it */
    double total;
} accumulation;

static void sum_chunk(void *work, pia_index chunk)
{
    accumulation *a = work;
    pia_index begin = pia_chunk_begin(a->intervals, a->chunks, chunk), end = pia_chunk_begin(a->intervals, a->chunks, chunk + 1);
    double *length = a->parameters + 1, sum = 0;
    enum { BLOCK = 512 };
    for (pia_index i = begin; i < end; i += BLOCK) {
        pia_index stop = end - i < BLOCK ? end : i + BLOCK;
        a->rule(a->source, i, stop, length + i);
        for (pia_index k = i; k < stop; k++) length[k] = sum += length[k];
    }
    a->before[chunk] = sum;
}

static void scale_chunk(void *work, pia_index chunk)
{
    accumulation *a = work;
    pia_index begin = pia_chunk_begin(a->intervals, a->chunks, chunk), end = pia_chunk_begin(a->intervals, a->chunks, chunk + 1);
    double *sum = a->parameters + 1, before = a->before[chunk], total = a->total;
    for (pia_index i = begin; i < end; i++) sum[i] = (sum[i] + before) / total;
}

/* Leaves unscaled sums in parameters[1..] and sets the total. */
static void sum_all(pia_context *context, accumulation *a)
{
    double sum = 0, closing = 0;
    pia_for_each(context, a->chunks, sum_chunk, a);
    for (pia_index c = 0; c < a->chunks; c++) {
        double chunk = a->before[c];
        a->before[c] = sum;
        sum += chunk;
    }
    if (a->source->closed) a->rule(a->source, a->source->count - 1, a->source->count, &closing);
    a->total = sum + closing;
}

/* The largest coordinate difference of neighbours; NaN or infinite when a coordinate is. */
static double largest_difference(const double *points, pia_index count, int dim)
{
    double largest = 0;
    for (pia_index i = 0; i < (count - 1) * dim; i++) {
        double d = fabs(points[i + dim] - points[i]);
        if (!isfinite(d)) return d;
        if (d > largest) largest = d;
    }
    return largest;
}

static pia_status all_equal(pia_context *context, pia_index count)
{
    return pia_fail(context, PIA_E_DATA, "all %lld points are equal: no curve runs through a single place", (long long)count);
}

/* Squares of ordinary coordinates are harmless; only what falls outside is scaled by its largest difference and summed again. */
static pia_status sum_safely(pia_context *context, accumulation *a, pia_interval_source *source)
{
    sum_all(context, a);
    if (a->total > 1e-60 && a->total < 1e60) return PIA_OK;
    double largest = largest_difference(source->points, source->count, source->dim);
    if (largest == 0) return all_equal(context, source->count);
    source->scale = 1 / largest;
    if (!(largest >= 1e-300 && isfinite(largest)))
        return pia_fail(context, PIA_E_DATA,
                        "distances of neighbouring points are not ordinary numbers (largest difference %g); scale the data", largest);
    sum_all(context, a);
    return PIA_OK;
}

pia_status pia_interval_accumulate(pia_context *context, const double *points, pia_index count, int dim, int closed,
                                   pia_interval_rule *rule, double *parameters)
{
    pia_interval_source source = {points, count, dim, closed, 1};
    accumulation a = {.source = &source, .rule = rule, .parameters = parameters, .intervals = count - 1};
    a.chunks = pia_chunk_count(count - 1, GRAIN);
    if (a.chunks > MAX_CHUNKS) a.chunks = MAX_CHUNKS;
    pia_status status = sum_safely(context, &a, &source);
    if (status != PIA_OK) return status;
    parameters[0] = 0;
    pia_for_each(context, a.chunks, scale_chunk, &a);
    return PIA_OK;
}

pia_status pia_interval_check_distinct(pia_context *context, const double *points, pia_index count, int dim)
{
    for (pia_index i = dim; i < count * dim; i++)
        if (points[i] != points[i - dim]) return PIA_OK;
    return all_equal(context, count);
}
