/* A curve: banded rows, one block of degree + 1 basis values each, walked span by span so that a span's control points stay in
 * registers. Chunks of spans hold about the same number of rows and depend on the problem alone. */
#include "kernel.h"
#include "op.h"
#include "span_sums.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 8192, MAX_CHUNKS = 256 };

typedef struct pass {
    const pia_op *op;
    const pia_collocation *line;
    pia_index chunks;
    const double *full, *weights, *in, *base;
    const pia_targets *targets;
    double factor;
    int dim;
    double *out;
    double *tail;       /* gather: [chunks x degree x dim] sums beyond a chunk's own columns */
    pia_errors *errors; /* [chunks] */
    const pia_chebyshev *chebyshev;
} pass;

static pia_index chunk_count(pia_index rows)
{
    pia_index chunks = pia_chunk_count(rows, GRAIN);
    return chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS;
}

/* First span of a chunk: the first one whose rows begin at or after the chunk's share of rows. */
static pia_index chunk_span(const pia_collocation *c, pia_index chunks, pia_index chunk)
{
    pia_index low = 0, high = c->full - c->degree, row = pia_chunk_begin(c->rows, chunks, chunk);
    if (chunk == chunks) return high;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (c->begin[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static inline __attribute__((always_inline)) void combine(const double *value, const double *control, int degree, int dim, double *sum)
{
    for (int d = 0; d < dim; d++) sum[d] = value[0] * control[d];
    for (int k = 1; k <= degree; k++)
        for (int d = 0; d < dim; d++) sum[d] += value[k] * control[k * dim + d];
}

static inline __attribute__((always_inline)) void apply_spans(const pass *p, pia_index chunk, int degree, int dim)
{
    const pia_collocation *c = p->line;
    pia_index from = chunk_span(c, p->chunks, chunk), to = chunk_span(c, p->chunks, chunk + 1);
    double scratch[PIA_MAX_DEGREE + 1];
    for (pia_index s = from; s < to; s++)
        for (pia_index row = c->begin[s]; row < c->begin[s + 1]; row++)
            combine(pia_collocation_row(c, row, degree + s, scratch), p->full + s * dim, degree, dim, p->out + row * dim);
}

static inline __attribute__((always_inline)) void plain_residual(const pass *p, pia_index s, int degree, int dim, pia_run_errors *e)
{
    const pia_collocation *c = p->line;
    double scratch[PIA_MAX_DEGREE + 1], sum[PIA_MAX_DIM];
    for (pia_index row = c->begin[s]; row < c->begin[s + 1]; row++) {
        const double *target = p->targets->points + row * dim;
        combine(pia_collocation_row(c, row, degree + s, scratch), p->full + s * dim, degree, dim, sum);
        double square = 0;
        for (int d = 0; d < dim; d++) {
            double difference = target[d] - p->targets->origin[d] - sum[d];
            square += difference * difference;
            if (p->out != NULL) p->out[row * dim + d] = p->base != NULL ? p->base[row * dim + d] + p->factor * difference : difference;
        }
        e->sum_squares += square;
        e->weighted += p->weights != NULL ? p->weights[row] * square : square;
        if (square > e->worst) {
            e->worst = square;
            e->index = row;
        }
    }
}

/* In a span of many rows the curve is a polynomial of the local parameter, and no basis function is evaluated. */
static void polynomial_residual(const pass *p, pia_index s, pia_run_errors *e)
{
    int width = p->line->degree + 1;
    double basis[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1)], curve[(PIA_MAX_DEGREE + 1) * PIA_MAX_DIM] = {0};
    pia_span_data data = {NULL, p->line, p->weights, p->targets};
    pia_run run = pia_span_run(&data, p->chebyshev, s, basis);
    for (int k = 0; k < width; k++)
        for (int j = 0; j < width; j++)
            for (int d = 0; d < p->dim; d++) curve[j * p->dim + d] += basis[k * width + j] * p->full[(s + k) * p->dim + d];
    pia_index first = p->line->begin[s];
    pia_run_residual(&run, curve, first, p->out != NULL ? p->out + first * p->dim : NULL, e);
}

static inline __attribute__((always_inline)) void residual_spans(const pass *p, pia_index chunk, int degree, int dim)
{
    const pia_collocation *c = p->line;
    pia_index from = chunk_span(c, p->chunks, chunk), to = chunk_span(c, p->chunks, chunk + 1);
    pia_run_errors e = {0, 0, -1, -1};
    for (pia_index s = from; s < to; s++)
        if (p->base == NULL && pia_span_is_full(c, s))
            polynomial_residual(p, s, &e);
        else
            plain_residual(p, s, degree, dim, &e);
    p->errors[chunk] = (pia_errors){.max = e.worst > 0 ? sqrt(e.worst) : 0,
                                    .max_row = e.index,
                                    .sum_squares = e.sum_squares,
                                    .weighted = e.weighted,
                                    .count = c->begin[to] - c->begin[from]};
}

static inline __attribute__((always_inline)) void gather_spans(const pass *p, pia_index chunk, int degree, int dim)
{
    const pia_collocation *c = p->line;
    pia_index from = chunk_span(c, p->chunks, chunk), to = chunk_span(c, p->chunks, chunk + 1);
    double scratch[PIA_MAX_DEGREE + 1], *tail = p->tail + chunk * degree * dim;
    memset(p->out + from * dim, 0, (size_t)((to - from) * dim) * sizeof *p->out);
    memset(tail, 0, (size_t)(degree * dim) * sizeof *tail);
    for (pia_index s = from; s < to; s++)
        for (pia_index row = c->begin[s]; row < c->begin[s + 1]; row++) {
            const double *value = pia_collocation_row(c, row, degree + s, scratch);
            double w = p->weights != NULL ? p->weights[row] : 1;
            for (int k = 0; k <= degree; k++) {
                double *to_column = s + k < to ? p->out + (s + k) * dim : tail + (s + k - to) * dim;
                for (int d = 0; d < dim; d++) to_column[d] += w * value[k] * p->in[row * dim + d];
            }
        }
}

/* The cubic in up to three dimensions is what nearly everybody fits: those loops are unrolled by giving the compiler the counts. */
#define PIA_UNROLL(body, p, chunk)                                                                                                     \
    do {                                                                                                                               \
        int degree_ = (p)->line->degree, dim_ = (p)->dim;                                                                              \
        if (degree_ == 3 && dim_ == 3)                                                                                                 \
            body(p, chunk, 3, 3);                                                                                                      \
        else if (degree_ == 3 && dim_ == 2)                                                                                            \
            body(p, chunk, 3, 2);                                                                                                      \
        else if (degree_ == 3 && dim_ == 1)                                                                                            \
            body(p, chunk, 3, 1);                                                                                                      \
        else                                                                                                                           \
            body(p, chunk, degree_, dim_);                                                                                             \
    } while (0)

static void apply_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    PIA_UNROLL(apply_spans, p, chunk);
}

static void residual_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    PIA_UNROLL(residual_spans, p, chunk);
}

static void gather_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    PIA_UNROLL(gather_spans, p, chunk);
}

static pass pass_over(const pia_op *op, int dim)
{
    return (pass){.op = op, .line = op->line[0], .chunks = chunk_count(op->rows), .dim = dim, .weights = op->weights};
}

static void apply(const pia_op *op, const double *full, int dim, double *values)
{
    pass p = pass_over(op, dim);
    p.full = full;
    p.out = values;
    pia_for_each(op->context, p.chunks, apply_chunk, &p);
}

static pia_errors residual(const pia_op *op, const double *full, const pia_targets *targets, const double *base, double factor,
                           double *out)
{
    pia_errors errors[MAX_CHUNKS];
    pass p = pass_over(op, targets->dim);
    p.full = full;
    p.targets = targets;
    p.base = base;
    p.factor = factor;
    p.out = out;
    p.errors = errors;
    pia_chebyshev chebyshev;
    pia_chebyshev_fill(p.line->degree, &chebyshev);
    p.chebyshev = &chebyshev;
    pia_for_each(op->context, p.chunks, residual_chunk, &p);
    for (pia_index c = 1; c < p.chunks; c++) errors[0] = pia_errors_join(errors[0], errors[c]);
    return errors[0];
}

static void gather(const pia_op *op, const double *values, const double *weights, int dim, double *full)
{
    pass p = pass_over(op, dim);
    p.in = values;
    p.weights = weights;
    p.out = full;
    p.tail = op->along;
    pia_for_each(op->context, p.chunks, gather_chunk, &p);
    int degree = p.line->degree;
    memset(full + (op->fulls - degree) * dim, 0, (size_t)(degree * dim) * sizeof *full);
    for (pia_index chunk = 0; chunk < p.chunks; chunk++) {
        double *to = full + chunk_span(p.line, p.chunks, chunk + 1) * dim;
        for (int k = 0; k < degree * dim; k++) to[k] += p.tail[chunk * degree * dim + k];
    }
}

static const pia_op_class curve = {"curve", apply, gather, residual, NULL};

pia_status pia_op_curve_open(pia_context *context, pia_collocation *line, const double *weights, int dim, pia_op **out)
{
    pia_op *op;
    pia_status status = pia_op_new(context, &curve, 1, &line->unknowns, &line->full, line->rows, weights, dim, &op);
    if (status != PIA_OK) return status;
    pia_index tails = chunk_count(line->rows) * line->degree * dim;
    op->axis[0] = op->line[0] = line;
    op->along = pia_take(context, tails, sizeof *op->along);
    if (op->along == NULL) {
        pia_op_close(op);
        return pia_take_status(context, tails, sizeof *op->along);
    }
    *out = op;
    return PIA_OK;
}
