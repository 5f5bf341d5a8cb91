#include "deviation.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluate.h"
#include "finite.h"
#include "kernel.h"
#include "select.h"

enum { GRAIN = 1 << 14 };

/* Euclidean length, whatever the scale: squares that overflow or vanish are taken again, divided by the largest component. */
static double length(const double *vector, int dim)
{
    double sum = 0, largest = 0;
    for (int c = 0; c < dim; c++) sum += vector[c] * vector[c];
    if (sum > DBL_MIN / DBL_EPSILON && sum <= DBL_MAX) return sqrt(sum);
    for (int c = 0; c < dim; c++) largest = fmax(largest, fabs(vector[c]));
    if (largest == 0) return 0;
    sum = 0;
    for (int c = 0; c < dim; c++) sum += vector[c] / largest * (vector[c] / largest);
    return largest * sqrt(sum);
}

typedef struct measurement {
    const pia_model *model;
    const double *points, *parameters;
    pia_index count, chunks;
    double *distances;
} measurement;

static void measure_chunk(void *work, pia_index chunk)
{
    const measurement *m = work;
    pia_index hint[2] = {0, 0}, end = pia_chunk_begin(m->count, m->chunks, chunk + 1);
    int dim = m->model->dim;
    double point[PIA_MAX_DIM];
    for (pia_index i = pia_chunk_begin(m->count, m->chunks, chunk); i < end; i++) {
        pia_evaluate(m->model, m->parameters + i * m->model->directions, 0, hint, point);
        for (int c = 0; c < dim; c++) point[c] = m->points[i * dim + c] - point[c];
        m->distances[i] = length(point, dim);
    }
}

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

static pia_status check(pia_context *context, const pia_model *model, const double *points, pia_index count, const double *parameters)
{
    pia_index values, bad;
    if (model == NULL || points == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_deviation needs a model and points");
    if (count < 1) return pia_fail(context, PIA_E_DATA, "no points: a deviation needs at least one");
    if (!pia_multiply(count, model->dim, &values))
        return pia_fail(context, PIA_E_SIZE, "%lld points of dimension %d do not fit in 64 bits", (long long)count, model->dim);
    if ((bad = pia_finite(points, values)) < values)
        return pia_fail(context, PIA_E_DATA, "point %lld has the coordinate %g; it must be finite", (long long)(bad / model->dim),
                        points[bad]);
    pia_index pairs = count * model->directions;
    if (parameters != NULL && (bad = pia_finite(parameters, pairs)) < pairs)
        return pia_fail(context, PIA_E_DATA, "parameter %lld is %g; it must be finite", (long long)(bad / model->directions),
                        parameters[bad]);
    return PIA_OK;
}

static pia_status measure(pia_context *context, const pia_model *model, const double *points, pia_index count, const double *parameters,
                          double *distances)
{
    if (parameters == NULL) return pia_model_closest(context, model, points, count, NULL, distances);
    measurement m = {model, points, parameters, count, pia_chunk_count(count, GRAIN), distances};
    pia_for_each(context, m.chunks, measure_chunk, &m);
    pia_index bad = pia_finite(distances, count);
    if (bad < count)
        return pia_fail(context, PIA_E_DATA, "the deviation of point %lld is no finite number; scale the data", (long long)bad);
    return PIA_OK;
}

/* Selection reorders, so the distances are worked on in a block of their own. */
pia_status pia_model_deviation(pia_context *context, const pia_model *model, const double *points, pia_index count,
                               const double *parameters, pia_deviation *out, double *distances)
{
    pia_deviation result;
    if (out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_deviation needs a place for its result");
    pia_status status = check(context, model, points, count, parameters);
    if (status != PIA_OK) return status;
    double *own = pia_take(context, count, sizeof *own);
    if (own == NULL) return pia_take_status(context, count, sizeof *own);
    status = measure(context, model, points, count, parameters, own);
    if (status == PIA_OK && distances != NULL) memcpy(distances, own, (size_t)count * sizeof *own);
    if (status == PIA_OK) status = pia_deviation_summarize(context, own, count, &result);
    pia_give(context, own);
    if (status != PIA_OK) return status;
    *out = result;
    out->foot_points = parameters == NULL;
    return PIA_OK;
}
