#include "op.h"

#include <string.h>

static pia_status take_work(pia_op *op)
{
    pia_index size;
    if (!op->identity) {
        if (!pia_multiply(op->fulls, op->dim, &size)) return PIA_E_SIZE;
        op->full = pia_take(op->context, size, sizeof *op->full);
        if (op->full == NULL) return pia_take_status(op->context, size, sizeof *op->full);
    }
    return PIA_OK;
}

pia_status pia_op_new(pia_context *context, const pia_op_class *class, int directions, const pia_index *unknowns,
                      const pia_index *fulls, pia_index rows, const double *weights, int dim, pia_op **out)
{
    pia_op *op = pia_take_zero(context, 1, sizeof *op);
    if (op == NULL) return pia_take_status(context, 1, sizeof *op);
    op->class = class;
    op->context = context;
    op->directions = directions;
    op->rows = rows;
    op->weights = weights;
    op->dim = dim;
    op->identity = 1;
    op->cols = op->fulls = 1;
    op->count[1] = op->full_count[1] = 1;
    int fits = 1;
    for (int d = 0; d < directions; d++) {
        op->count[d] = unknowns[d];
        op->full_count[d] = fulls[d];
        op->identity &= unknowns[d] == fulls[d];
        fits &= pia_multiply(op->cols, unknowns[d], &op->cols) & pia_multiply(op->fulls, fulls[d], &op->fulls);
    }
    pia_status status = fits ? take_work(op) : pia_fail(context, PIA_E_SIZE, "the control points do not fit in 64 bits; ask for fewer");
    if (status != PIA_OK) {
        pia_op_close(op);
        return status;
    }
    *out = op;
    return PIA_OK;
}

void pia_op_close(pia_op *op)
{
    if (op == NULL) return;
    if (op->class->close != NULL) op->class->close(op);
    pia_give(op->context, op->frozen);
    pia_give(op->context, op->full);
    pia_give(op->context, op->along);
    pia_give(op->context, op);
}

pia_index pia_op_unknown(const pia_op *op, pia_index control)
{
    if (op->identity) return control;
    if (op->directions == 1) return pia_collocation_unknown(op->axis[0], control);
    pia_index i = control / op->full_count[1], j = control % op->full_count[1];
    return pia_collocation_unknown(op->axis[0], i) * op->count[1] + pia_collocation_unknown(op->axis[1], j);
}

void pia_op_expand(const pia_op *op, const double *x, int dim, double *full)
{
    for (pia_index i = 0; i < op->fulls; i++) memcpy(full + i * dim, x + pia_op_unknown(op, i) * dim, (size_t)dim * sizeof *full);
}

void pia_op_reduce(const pia_op *op, const double *full, int dim, double *x)
{
    memset(x, 0, (size_t)(op->cols * dim) * sizeof *x);
    for (pia_index i = 0; i < op->fulls; i++) {
        double *to = x + pia_op_unknown(op, i) * dim;
        for (int k = 0; k < dim; k++) to[k] += full[i * dim + k];
    }
}

const double *pia_op_full(const pia_op *op, const double *x, int dim)
{
    if (op->identity) return x;
    pia_op_expand(op, x, dim, op->full);
    return op->full;
}

void pia_op_apply(const pia_op *op, const double *x, int dim, double *values)
{
    op->class->apply(op, pia_op_full(op, x, dim), dim, values);
}

void pia_op_gather(const pia_op *op, const double *values, const double *weights, int dim, double *x)
{
    op->class->gather(op, values, weights, dim, op->identity ? x : op->full);
    if (!op->identity) pia_op_reduce(op, op->full, dim, x);
    pia_op_mask(op, x, dim);
}

pia_errors pia_op_residual(const pia_op *op, const double *x, const pia_targets *targets, double *residual)
{
    return op->class->residual(op, pia_op_full(op, x, targets->dim), targets, NULL, 1, residual);
}

pia_errors pia_op_move(const pia_op *op, const double *x, const pia_targets *targets, double factor, double *next)
{
    int dim = targets->dim;
    pia_errors errors = op->class->residual(op, pia_op_full(op, x, dim), targets, x, factor, next);
    for (pia_index c = 0; op->frozen != NULL && c < op->cols; c++)
        if (op->frozen[c]) memcpy(next + c * dim, x + c * dim, (size_t)dim * sizeof *next);
    return errors;
}

pia_index pia_op_controls(const pia_op *op, int direction)
{
    if (direction >= op->directions) return 1;
    const pia_collocation *line = op->line[direction];
    return line != NULL && line->map == PIA_MAP_DOUBLED ? line->full : op->count[direction];
}

void pia_op_mask(const pia_op *op, double *x, int dim)
{
    if (op->frozen == NULL) return;
    for (pia_index c = 0; c < op->cols; c++)
        if (op->frozen[c]) memset(x + c * dim, 0, (size_t)dim * sizeof *x);
}

pia_status pia_op_freeze(pia_op *op, pia_index unknown, int frozen)
{
    if (op->frozen == NULL) {
        op->frozen = pia_take_zero(op->context, op->cols, 1);
        if (op->frozen == NULL) return pia_take_status(op->context, op->cols, 1);
    }
    op->frozen[unknown] = frozen != 0;
    return PIA_OK;
}

pia_errors pia_errors_join(pia_errors earlier, pia_errors later)
{
    int tie = later.max == earlier.max && later.max_row >= 0 && later.max_row < earlier.max_row;
    if (later.max > earlier.max || earlier.max_row < 0 || tie) {
        earlier.max = later.max;
        earlier.max_row = later.max_row;
    }
    earlier.sum_squares += later.sum_squares;
    earlier.weighted += later.weighted;
    earlier.count += later.count;
    return earlier;
}
