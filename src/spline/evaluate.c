#include "evaluate.h"

#include <string.h>

#include "basis.h"
#include "finite.h"
#include "kernel.h"
#include "knots.h"

enum { WIDTH = PIA_MAX_DEGREE + 1, GRAIN = 1 << 15 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

pia_index pia_derivative_row(int a, int b)
{
    pia_index order = (pia_index)a + b;
    return order * (order + 1) / 2 + b;
}

pia_index pia_derivative_rows(int directions, int order)
{
    return directions == 1 ? (pia_index)order + 1 : pia_derivative_row(0, order) + 1;
}

/* The basis at one parameter of one direction, with the derivatives that are not zero. */
typedef struct basis {
    pia_index first; /* control point of the first function */
    int count;       /* functions: degree + 1 */
    int order;       /* derivatives held */
    double value[WIDTH * WIDTH];
} basis;

static void find_basis(const pia_model *model, int d, double t, int order, pia_index *hint, basis *out)
{
    const double *knots = model->knots[d];
    int degree = model->degree[d];
    double low = knots[degree], high = knots[model->control[d]];
    t = t > low ? t : low;
    t = t < high ? t : high;
    *hint = pia_knots_span_near(knots, degree, model->control[d], t, *hint);
    out->first = *hint - degree;
    out->count = degree + 1;
    out->order = least(order, degree);
    if (order == 0)
        pia_basis_values(knots, degree, *hint, t, out->value);
    else
        pia_basis_derivatives(knots, degree, *hint, t, out->order, out->value);
}

/* out[c] = sum over k of weight[k] from[k * stride + c], c < inner. */
static inline void combine(const double *weight, int count, const double *from, pia_index stride, int inner, double *out)
{
    for (int c = 0; c < inner; c++) {
        double sum = weight[0] * from[c];
        for (int k = 1; k < count; k++) sum += weight[k] * from[k * stride + c];
        out[c] = sum;
    }
}

/* The quotient rule (The NURBS Book, Eq. 4.8): `out` holds the derivatives of w x, `weight` those of w up to `last`. */
static void divide_curve(const double *weight, int last, int order, int dim, double *out)
{
    for (int k = 0; k <= order; k++) {
        double *row = out + (pia_index)k * dim;
        double binomial = 1;
        for (int i = 1; i <= least(k, last); i++) {
            binomial = binomial * (k - i + 1) / i;
            for (int c = 0; c < dim; c++) row[c] -= binomial * weight[i] * row[c - (pia_index)i * dim];
        }
        for (int c = 0; c < dim; c++) row[c] /= weight[0];
    }
}

static void evaluate_curve(const pia_model *model, const double *parameter, int order, pia_index *hint, double *out)
{
    basis b;
    find_basis(model, 0, parameter[0], order, hint, &b);
    int width = pia_model_width(model), dim = model->dim;
    const double *points = model->points + b.first * width;
    double sum[PIA_MAX_WIDTH], weight[WIDTH];
    for (int k = 0; k <= b.order; k++) {
        combine(b.value + k * b.count, b.count, points, width, width, sum);
        for (int c = 0; c < dim; c++) out[(pia_index)k * dim + c] = sum[c];
        weight[k] = sum[width - 1];
    }
    for (pia_index i = (pia_index)(b.order + 1) * dim; i < ((pia_index)order + 1) * dim; i++) out[i] = 0;
    if (model->rational) divide_curve(weight, b.order, order, dim, out);
}

/* Derivatives of the weight of a surface: a in u and b in v at value[a * WIDTH + b], for a <= last[0] and b <= last[1]. */
typedef struct weights {
    int last[2];
    double value[WIDTH * WIDTH];
} weights;

/* row -= sum over (i, j) other than (0, 0) of binomial(a, i) binomial(b, j) w_ij S_(a-i)(b-j), divided by w (Eq. 4.20). */
static void divide_row(const weights *w, int a, int b, int dim, double *out)
{
    double *row = out + pia_derivative_row(a, b) * dim;
    double choose_a = 1;
    for (int i = 0; i <= least(a, w->last[0]); i++) {
        double choose = choose_a;
        for (int j = 0; j <= least(b, w->last[1]); j++) {
            const double *lower = out + pia_derivative_row(a - i, b - j) * dim;
            for (int c = 0; i + j > 0 && c < dim; c++) row[c] -= choose * w->value[i * WIDTH + j] * lower[c];
            choose = choose * (b - j) / (j + 1);
        }
        choose_a = choose_a * (a - i) / (i + 1);
    }
    for (int c = 0; c < dim; c++) row[c] /= w->value[0];
}

static void divide_surface(const weights *w, int order, int dim, double *out)
{
    for (int n = 0; n <= order; n++)
        for (int b = 0; b <= n; b++) divide_row(w, n - b, b, dim, out);
}

static void evaluate_surface(const pia_model *model, const double *parameter, int order, pia_index *hint, double *out)
{
    basis u, v;
    find_basis(model, 0, parameter[0], order, &hint[0], &u);
    find_basis(model, 1, parameter[1], order, &hint[1], &v);
    int width = pia_model_width(model), dim = model->dim;
    pia_index stride = model->control[1] * width;
    const double *points = model->points + u.first * stride + v.first * width;
    double line[WIDTH * PIA_MAX_WIDTH], sum[PIA_MAX_WIDTH];
    weights w;
    w.last[0] = u.order;
    w.last[1] = v.order;
    memset(out, 0, (size_t)pia_derivative_rows(2, order) * (size_t)dim * sizeof *out);
    for (int a = 0; a <= u.order; a++) {
        combine(u.value + a * u.count, u.count, points, stride, v.count * width, line);
        for (int b = 0; b <= least(order - a, v.order); b++) {
            combine(v.value + b * v.count, v.count, line, width, width, sum);
            memcpy(out + pia_derivative_row(a, b) * dim, sum, (size_t)dim * sizeof *out);
            w.value[a * WIDTH + b] = sum[width - 1];
        }
    }
    if (model->rational) divide_surface(&w, order, dim, out);
}

void pia_evaluate(const pia_model *model, const double *parameter, int order, pia_index *hint, double *out)
{
    if (model->directions == 1)
        evaluate_curve(model, parameter, order, hint, out);
    else
        evaluate_surface(model, parameter, order, hint, out);
}

typedef struct sweep {
    const pia_model *model;
    const double *parameters;
    pia_index count, chunks, stride;
    int order;
    double *out;
} sweep;

static void evaluate_chunk(void *work, pia_index chunk)
{
    const sweep *s = work;
    pia_index hint[2] = {0, 0};
    pia_index end = pia_chunk_begin(s->count, s->chunks, chunk + 1);
    for (pia_index i = pia_chunk_begin(s->count, s->chunks, chunk); i < end; i++)
        pia_evaluate(s->model, s->parameters + i * s->model->directions, s->order, hint, s->out + i * s->stride);
}

pia_status pia_model_eval(pia_context *context, const pia_model *model, const double *parameters, pia_index count, int derivatives,
                          double *out)
{
    if (model == NULL || out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_eval needs a model and out");
    if (derivatives < 0) return pia_fail(context, PIA_E_ARGUMENT, "derivative %d; orders count from 0", derivatives);
    pia_index stride, total;
    if (count < 0) return pia_fail(context, PIA_E_ARGUMENT, "%lld parameters; the count cannot be negative", (long long)count);
    if (!pia_multiply(pia_derivative_rows(model->directions, derivatives), model->dim, &stride) ||
        !pia_multiply(stride, count, &total) || !pia_multiply(total, sizeof *out, &total))
        return pia_fail(context, PIA_E_SIZE, "%lld parameters with derivatives up to %d do not fit in 64 bits; ask for less",
                        (long long)count, derivatives);
    pia_status status = pia_check_finite(context, "parameter", parameters, count, model->directions);
    if (status != PIA_OK) return status;
    sweep s = {model, parameters, count, pia_chunk_count(count, GRAIN), stride, derivatives, out};
    pia_for_each(context, s.chunks, evaluate_chunk, &s);
    return PIA_OK;
}
