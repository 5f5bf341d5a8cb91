#include "normal.h"

#include "energy.h"
#include "kernel.h"

static pia_status take_arrays(pia_normal *normal, int dim)
{
    pia_context *context = normal->op->context;
    pia_index cols = normal->op->cols;
    normal->right = pia_take(context, cols, (size_t)dim * sizeof *normal->right);
    normal->diagonal = pia_take(context, cols, sizeof *normal->diagonal);
    normal->column_sum = pia_take(context, cols, sizeof *normal->column_sum);
    if (normal->right != NULL && normal->diagonal != NULL && normal->column_sum != NULL) return PIA_OK;
    return pia_take_status(context, cols, (size_t)dim * sizeof *normal->right);
}

/* A grid that turns out to be no Kronecker product, and with more than the data in it it is none, is a surface like any other. */
static pia_status open_class(pia_normal *normal, const pia_targets *targets, const pia_addition *addition)
{
    const pia_op *op = normal->op;
    if (op->directions == 1) return pia_normal_curve_open(normal, targets, addition);
    if (op->line[0] == NULL || op->frozen != NULL || normal->energy != NULL || normal->pull > 0)
        return pia_normal_stencil_open(normal, targets);
    pia_status status = pia_normal_grid_open(normal, targets, addition);
    if (status != PIA_E_UNAVAILABLE) return status;
    if (normal->class != NULL) normal->class->close(normal);
    return pia_normal_stencil_open(normal, targets);
}

pia_status pia_normal_open(pia_op *op, const pia_targets *targets, pia_normal **out)
{
    const pia_addition nothing = {0};
    return pia_normal_open_with(op, targets, &nothing, out);
}

pia_status pia_normal_open_with(pia_op *op, const pia_targets *targets, const pia_addition *addition, pia_normal **out)
{
    pia_normal *normal = pia_take_zero(op->context, 1, sizeof *normal);
    if (normal == NULL) return pia_take_status(op->context, 1, sizeof *normal);
    normal->op = op;
    normal->pull = addition->pull;
    normal->start = addition->start;
    pia_status status = take_arrays(normal, targets->dim);
    if (status == PIA_OK && addition->fairing > 0) status = pia_energy_open(op, addition->fairing, &normal->energy);
    if (status == PIA_OK) status = open_class(normal, targets, addition);
    if (status != PIA_OK) {
        pia_normal_close(normal);
        return status;
    }
    *out = normal;
    return PIA_OK;
}

void pia_normal_close(pia_normal *normal)
{
    if (normal == NULL) return;
    pia_context *context = normal->op->context;
    if (normal->class != NULL) normal->class->close(normal);
    pia_energy_close(normal->energy);
    pia_give(context, normal->right);
    pia_give(context, normal->diagonal);
    pia_give(context, normal->column_sum);
    pia_give(context, normal);
}

void pia_normal_add_pull(pia_normal *normal, int dim)
{
    for (pia_index c = 0; c < normal->op->cols; c++) {
        normal->diagonal[c] += normal->pull;
        normal->column_sum[c] += normal->pull;
        for (int d = 0; d < dim; d++) normal->right[c * dim + d] += normal->pull * normal->start[c * dim + d];
    }
    pia_op_mask(normal->op, normal->right, dim);
}

typedef struct move {
    pia_normal *normal;
    double shift[PIA_MAX_DIM];
    pia_index from, count, chunks;
    int dim;
} move;

static void move_chunk(void *work, pia_index chunk)
{
    const move *m = work;
    const double *sum = m->normal->column_sum;
    double *right = m->normal->right;
    pia_index end = m->from + pia_chunk_begin(m->count, m->chunks, chunk + 1);
    for (pia_index i = m->from + pia_chunk_begin(m->count, m->chunks, chunk); i < end; i++)
        for (int d = 0; d < m->dim; d++) right[i * m->dim + d] += m->shift[d] * sum[i];
}

void pia_normal_move(pia_normal *normal, const pia_targets *targets, pia_index from, pia_index to)
{
    enum { GRAIN = 8192 };
    move m = {.normal = normal, .from = from, .count = to - from, .chunks = pia_chunk_count(to - from, GRAIN), .dim = targets->dim};
    for (int d = 0; d < m.dim; d++) m.shift[d] = targets->points[d] - targets->origin[d];
    pia_for_each(normal->op->context, m.chunks, move_chunk, &m);
    pia_op_mask(normal->op, normal->right, m.dim);
}

void pia_normal_refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    normal->class->refresh(normal, targets, first_row, last_row);
}
