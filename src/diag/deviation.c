#include "deviation.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "evaluate.h"
#include "finite.h"
#include "kernel.h"

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

static pia_status check(pia_context *context, const pia_model *model, const double *points, pia_index count, const double *parameters,
                        const pia_deviation *out)
{
    if (model == NULL || out == NULL)
        return pia_fail(context, PIA_E_ARGUMENT, "pia_model_deviation needs a model and a place for its result");
    if (count == 0) return pia_fail(context, PIA_E_DATA, "no points: a deviation needs at least one");
    pia_status status = pia_check_finite(context, "point", points, count, model->dim);
    if (status != PIA_OK || parameters == NULL) return status;
    return pia_check_finite(context, "parameter", parameters, count, model->directions);
}

static pia_status measure(pia_context *context, const pia_model *model, const double *points, pia_index count, const double *parameters,
                          double *distances)
{
    if (parameters == NULL) return pia_model_closest(context, model, points, count, NULL, distances);
    measurement m = {model, points, parameters, count, pia_chunk_count(count, GRAIN), distances};
    pia_for_each(context, m.chunks, measure_chunk, &m);
    return pia_check_finite(context, "deviation", distances, count, 1);
}

/* Selection reorders, so the distances are worked on in a block of their own. */
pia_status pia_model_deviation(pia_context *context, const pia_model *model, const double *points, pia_index count,
                               const double *parameters, pia_deviation *out, double *distances)
{
    pia_deviation result;
    pia_status status = check(context, model, points, count, parameters, out);
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
