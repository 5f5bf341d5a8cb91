/* A grid: A = A_u (x) A_v, never formed. Values are contracted first along v, into an array [full control rows x data columns], then
 * along u, where the inner loop runs over whole contiguous data rows. */
#include "clones.h"
#include "kernel.h"
#include "op.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 8192, MAX_CHUNKS = 256 };

typedef struct pass {
    const pia_op *op;
    const pia_collocation *u, *v;
    pia_index lines, chunks; /* what is cut into chunks: rows of the array at hand */
    const double *in, *weights, *base;
    const pia_targets *targets;
    double factor;
    int dim;
    double *along, *out;
    pia_errors *errors;
} pass;

static pass pass_over(const pia_op *op, int dim, pia_index lines, pia_index width)
{
    pia_index chunks = pia_chunk_count(lines * width, GRAIN);
    if (chunks > lines) chunks = lines > 0 ? lines : 1;
    if (chunks > MAX_CHUNKS) chunks = MAX_CHUNKS;
    return (pass){.op = op, .u = op->line[0], .v = op->line[1], .lines = lines, .chunks = chunks, .along = op->along, .dim = dim};
}

/* along[i][s] = sum_j N_j(v_s) P[i][j], for a chunk of control rows i. */
static void along_v(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_collocation *v = p->v;
    double scratch[PIA_MAX_DEGREE + 1];
    int dim = p->dim;
    for (pia_index i = pia_chunk_begin(p->lines, p->chunks, chunk); i < pia_chunk_begin(p->lines, p->chunks, chunk + 1); i++)
        for (pia_index s = 0; s < v->full - v->degree; s++)
            for (pia_index row = v->begin[s]; row < v->begin[s + 1]; row++) {
                const double *value = pia_collocation_row(v, row, v->degree + s, scratch);
                const double *control = p->in + (i * v->full + s) * dim;
                double *to = p->along + (i * v->rows + row) * dim;
                for (int d = 0; d < dim; d++) to[d] = value[0] * control[d];
                for (int k = 1; k <= v->degree; k++)
                    for (int d = 0; d < dim; d++) to[d] += value[k] * control[k * dim + d];
            }
}

/* Data row `row` of A P into line [width]. */
PIA_CLONES static void data_row(const pass *p, pia_index row, pia_index span, pia_index width, double *line)
{
    double scratch[PIA_MAX_DEGREE + 1];
    const pia_collocation *u = p->u;
    const double *value = pia_collocation_row(u, row, span, scratch), *from = p->along + (span - u->degree) * width;
    for (pia_index k = 0; k < width; k++) line[k] = value[0] * from[k];
    for (int i = 1; i <= u->degree; i++) {
        from += width;
        for (pia_index k = 0; k < width; k++) line[k] += value[i] * from[k];
    }
}

static void apply_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    pia_index row = pia_chunk_begin(p->lines, p->chunks, chunk), to = pia_chunk_begin(p->lines, p->chunks, chunk + 1);
    pia_index width = p->v->rows * p->dim;
    for (; row < to; row++) data_row(p, row, pia_collocation_span(p->u, row), width, p->out + row * width);
}

/* Differences of data row `row` from the model's values in `line`; written over them, or to the output. */
PIA_CLONES static void difference_row(const pass *p, pia_index row, const double *line, pia_errors *e, double *worst)
{
    int dim = p->dim;
    for (pia_index s = 0; s < p->v->rows; s++) {
        pia_index at = row * p->v->rows + s;
        const double *target = p->targets->points + at * dim;
        double difference[PIA_MAX_DIM], square = 0;
        for (int d = 0; d < dim; d++) {
            difference[d] = target[d] - p->targets->origin[d] - line[s * dim + d];
            square += difference[d] * difference[d];
        }
        int hole = isnan(square);
        for (int d = 0; p->out != NULL && d < dim; d++) {
            double step = hole ? 0 : difference[d];
            p->out[at * dim + d] = p->base != NULL ? p->base[at * dim + d] + p->factor * step : step;
        }
        if (hole) continue;
        e->count++;
        e->sum_squares += square;
        e->weighted += p->weights != NULL ? p->weights[at] * square : square;
        if (square > *worst) {
            *worst = square;
            e->max_row = at;
        }
    }
}

static void residual_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    pia_index row = pia_chunk_begin(p->lines, p->chunks, chunk), to = pia_chunk_begin(p->lines, p->chunks, chunk + 1);
    pia_index width = p->v->rows * p->dim;
    double *line = p->along + p->u->full * width + chunk * width; /* one spare line a chunk */
    double worst = -1;
    pia_errors e = {0, -1, 0, 0, 0};
    for (; row < to; row++) {
        data_row(p, row, pia_collocation_span(p->u, row), width, line);
        difference_row(p, row, line, &e, &worst);
    }
    e.max = worst > 0 ? sqrt(worst) : 0;
    p->errors[chunk] = e;
}

static void contract_v(const pia_op *op, const double *full, int dim)
{
    pass p = pass_over(op, dim, op->full_count[0], op->line[1]->rows);
    p.in = full;
    pia_for_each(op->context, p.chunks, along_v, &p);
}

static void apply(const pia_op *op, const double *full, int dim, double *values)
{
    contract_v(op, full, dim);
    pass p = pass_over(op, dim, op->line[0]->rows, op->line[1]->rows);
    p.out = values;
    pia_for_each(op->context, p.chunks, apply_chunk, &p);
}

static pia_errors residual(const pia_op *op, const double *full, const pia_targets *targets, const double *base, double factor,
                           double *out)
{
    pia_errors errors[MAX_CHUNKS];
    contract_v(op, full, targets->dim);
    pass p = pass_over(op, targets->dim, op->line[0]->rows, op->line[1]->rows);
    p.targets = targets;
    p.weights = op->weights;
    p.base = base;
    p.factor = factor;
    p.out = out;
    p.errors = errors;
    pia_for_each(op->context, p.chunks, residual_chunk, &p);
    for (pia_index c = 1; c < p.chunks; c++) errors[0] = pia_errors_join(errors[0], errors[c]);
    return errors[0];
}

/* along[i] = sum over data rows r of N_i(u_r) values[r], for a chunk of control rows i; then full[i] = along[i] A_v. */
static void gather_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_collocation *u = p->u, *v = p->v;
    pia_index width = v->rows * p->dim;
    double scratch[PIA_MAX_DEGREE + 1];
    for (pia_index i = pia_chunk_begin(p->lines, p->chunks, chunk); i < pia_chunk_begin(p->lines, p->chunks, chunk + 1); i++) {
        double *line = p->along + i * width, *to = p->out + i * v->full * p->dim;
        memset(line, 0, (size_t)width * sizeof *line);
        for (pia_index s = i > u->degree ? i - u->degree : 0; s <= i && s < u->full - u->degree; s++)
            for (pia_index row = u->begin[s]; row < u->begin[s + 1]; row++) {
                double value = pia_collocation_row(u, row, u->degree + s, scratch)[i - s];
                const double *from = p->in + row * width, *w = p->weights != NULL ? p->weights + row * v->rows : NULL;
                for (pia_index k = 0; k < width; k++) line[k] += (w != NULL ? w[k / p->dim] * value : value) * from[k];
            }
        memset(to, 0, (size_t)(v->full * p->dim) * sizeof *to);
        for (pia_index s = 0; s < v->full - v->degree; s++)
            for (pia_index row = v->begin[s]; row < v->begin[s + 1]; row++) {
                const double *value = pia_collocation_row(v, row, v->degree + s, scratch);
                for (int k = 0; k <= v->degree; k++)
                    for (int d = 0; d < p->dim; d++) to[(s + k) * p->dim + d] += value[k] * line[row * p->dim + d];
            }
    }
}

static void gather(const pia_op *op, const double *values, const double *weights, int dim, double *full)
{
    pass p = pass_over(op, dim, op->full_count[0], op->line[1]->rows);
    p.in = values;
    p.weights = weights;
    p.out = full;
    pia_for_each(op->context, p.chunks, gather_chunk, &p);
}

static const pia_op_class grid = {"grid", apply, gather, residual, NULL};

pia_status pia_op_grid_open(pia_context *context, pia_collocation *u, pia_collocation *v, const double *weights, int dim, pia_op **out)
{
    pia_index unknowns[2] = {u->unknowns, v->unknowns}, fulls[2] = {u->full, v->full}, rows, size;
    pia_op *op;
    if (!pia_multiply(u->rows, v->rows, &rows) || !pia_multiply(u->full + MAX_CHUNKS, v->rows, &size) ||
        !pia_multiply(size, dim, &size))
        return pia_fail(context, PIA_E_SIZE, "a grid of %lld x %lld points does not fit in 64 bits", (long long)u->rows,
                        (long long)v->rows);
    pia_status status = pia_op_new(context, &grid, 2, unknowns, fulls, rows, weights, dim, &op);
    if (status != PIA_OK) return status;
    op->axis[0] = op->line[0] = u;
    op->axis[1] = op->line[1] = v;
    pass p = pass_over(op, dim, u->rows, v->rows);
    size = (u->full + p.chunks) * v->rows * dim; /* the contraction along v, and a spare line a chunk */
    op->along = pia_take(context, size, sizeof *op->along);
    if (op->along == NULL) {
        pia_op_close(op);
        return pia_take_status(context, size, sizeof *op->along);
    }
    *out = op;
    return PIA_OK;
}
