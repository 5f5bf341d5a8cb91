#include <float.h>
#include <math.h>

#include "evaluate.h"
#include "kernel.h"

enum { NODES = 5, GRAIN = 64, MOST_CHUNKS = 4096, DEEPEST = 45 };

/* Gauss-Legendre rule of ten points on [-1, 1]: the positive half (Abramowitz and Stegun, table 25.4). */
static const double node[NODES] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845, 0.9739065285171717};
static const double weight[NODES] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820, 0.1494513491505806,
                                     0.0666713443086881};

typedef struct sweep {
    const pia_model *model;
    pia_index count, chunks; /* spans from degree on, empty ones too */
    double scale;            /* of the control points: squares of speeds over it neither overflow nor vanish */
    double rounding;         /* of a point, over the scale: no piece is known better */
    double *part;            /* [chunks] */
} sweep;

static double speed(const sweep *s, double t, pia_index *hint)
{
    double rows[2 * PIA_MAX_DIM], sum = 0;
    int dim = s->model->dim;
    pia_evaluate(s->model, &t, 1, hint, rows);
    for (int c = 0; c < dim; c++) sum += rows[dim + c] / s->scale * (rows[dim + c] / s->scale);
    return sqrt(sum);
}

static double gauss(const sweep *s, double low, double high, pia_index *hint)
{
    double middle = low + (high - low) / 2, half = (high - low) / 2, sum = 0;
    for (int k = 0; k < NODES; k++)
        sum += weight[k] * (speed(s, middle - half * node[k], hint) + speed(s, middle + half * node[k], hint));
    return half * sum;
}

/* Halved until both halves together agree with the whole; a cusp is closed in on, where its share no longer counts. In a short span far
 * from the origin the speed itself is noise beyond the rounding of its ends, which no halving removes. */
static double integrate(const sweep *s, double low, double high, double whole, int depth, pia_index *hint)
{
    double middle = low + (high - low) / 2;
    double left = gauss(s, low, middle, hint), right = gauss(s, middle, high, hint);
    if (depth == DEEPEST || !(fabs(left + right - whole) > fmax(1e-12 * (left + right), s->rounding))) return left + right;
    return integrate(s, low, middle, left, depth + 1, hint) + integrate(s, middle, high, right, depth + 1, hint);
}

static void length_of_chunk(void *work, pia_index chunk)
{
    const sweep *s = work;
    const double *knots = s->model->knots[0] + s->model->degree[0];
    pia_index end = pia_chunk_begin(s->count, s->chunks, chunk + 1);
    double sum = 0;
    for (pia_index i = pia_chunk_begin(s->count, s->chunks, chunk); i < end; i++) {
        if (knots[i] == knots[i + 1]) continue;
        pia_index hint[2] = {i, 0};
        sum += integrate(s, knots[i], knots[i + 1], gauss(s, knots[i], knots[i + 1], hint), 0, hint);
    }
    s->part[chunk] = sum;
}

/* The longest side of the control points' box; *largest is their largest coordinate. */
static double find_scale(const pia_model *model, double *largest)
{
    double scale = 0;
    *largest = 0;
    int width = pia_model_width(model);
    for (int c = 0; c < model->dim; c++) {
        double low = INFINITY, high = -INFINITY;
        for (pia_index i = 0; i < model->control[0]; i++) {
            const double *point = model->points + i * width;
            double x = point[c] / (model->rational ? point[model->dim] : 1);
            low = fmin(low, x);
            high = fmax(high, x);
        }
        scale = fmax(scale, high - low);
        *largest = fmax(*largest, fmax(high, -low));
    }
    return scale;
}

pia_status pia_model_length(pia_context *context, const pia_model *model, double *out)
{
    if (model == NULL || out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_length needs a model and out");
    if (model->directions != 1) return pia_fail(context, PIA_E_ARGUMENT, "only a curve has a length; this model is a surface");
    double part[MOST_CHUNKS], sum = 0, largest;
    sweep s = {.model = model, .count = model->control[0] - model->degree[0], .part = part};
    s.scale = find_scale(model, &largest);
    s.chunks = pia_chunk_count(s.count, GRAIN);
    if (s.scale > 0) {
        s.rounding = 4 * (model->degree[0] + 1) * DBL_EPSILON * (largest / s.scale);
        pia_for_each(context, s.chunks, length_of_chunk, &s);
        for (pia_index k = 0; k < s.chunks; k++) sum += part[k];
    }
    *out = sum * s.scale;
    return PIA_OK;
}
