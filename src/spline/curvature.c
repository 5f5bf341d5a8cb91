#include <math.h>

#include "evaluate.h"
#include "finite.h"
#include "kernel.h"

enum { GRAIN = 1 << 15 };

static double dot(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int c = 0; c < dim; c++) sum += a[c] * b[c];
    return sum;
}

/* |C' x C''| / |C'|^3, the area spanned by both taken from the part of C'' across C', so that any dimension will do. Where the curve
 * stands still there is no curvature: NAN. */
static double of_curve(const double *first, const double *second, int dim)
{
    double speed = sqrt(dot(first, first, dim));
    if (dim == 2) return (first[0] / speed * second[1] - first[1] / speed * second[0]) / speed / speed;
    double along = dot(first, second, dim) / speed, across = 0;
    for (int c = 0; c < dim; c++) {
        double part = second[c] - along * (first[c] / speed);
        across += part * part;
    }
    return sqrt(across) / speed / speed;
}

/* The two fundamental forms (do Carmo, 3-3). rows: S, Su, Sv, Suu, Suv, Svv, three components each. */
static void of_surface(const double *rows, double *mean, double *gaussian)
{
    const double *su = rows + 3, *sv = rows + 6;
    double normal[3] = {su[1] * sv[2] - su[2] * sv[1], su[2] * sv[0] - su[0] * sv[2], su[0] * sv[1] - su[1] * sv[0]};
    double area = sqrt(dot(normal, normal, 3));
    double e = dot(su, su, 3), f = dot(su, sv, 3), g = dot(sv, sv, 3);
    double l = dot(normal, rows + 9, 3) / area, m = dot(normal, rows + 12, 3) / area, n = dot(normal, rows + 15, 3) / area;
    *gaussian = (l * n - m * m) / (area * area);
    *mean = (e * n - 2 * f * m + g * l) / (2 * area * area);
}

typedef struct sweep {
    const pia_model *model;
    const double *parameters;
    pia_index count, chunks;
    double *out;
} sweep;

static void curvature_of_chunk(void *work, pia_index chunk)
{
    const sweep *s = work;
    int dim = s->model->dim;
    double rows[6 * PIA_MAX_DIM];
    pia_index hint[2] = {0, 0}, end = pia_chunk_begin(s->count, s->chunks, chunk + 1);
    for (pia_index i = pia_chunk_begin(s->count, s->chunks, chunk); i < end; i++) {
        pia_evaluate(s->model, s->parameters + i * s->model->directions, 2, hint, rows);
        if (s->model->directions == 1)
            s->out[i] = of_curve(rows + dim, rows + 2 * dim, dim);
        else
            of_surface(rows, &s->out[2 * i], &s->out[2 * i + 1]);
    }
}

pia_status pia_model_curvature(pia_context *context, const pia_model *model, const double *parameters, pia_index count, double *out)
{
    if (model == NULL || out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_curvature needs a model and out");
    if (model->directions == 2 && model->dim != 3)
        return pia_fail(context, PIA_E_SHAPE, "curvature of a surface needs dimension 3; this one has %d", model->dim);
    pia_status status = pia_check_finite(context, "parameter", parameters, count, model->directions);
    if (status != PIA_OK) return status;
    sweep s = {model, parameters, count, pia_chunk_count(count, GRAIN), out};
    pia_for_each(context, s.chunks, curvature_of_chunk, &s);
    return PIA_OK;
}
