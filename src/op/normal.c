#include "normal.h"

#include "energy.h"

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

/* A grid that turns out to be no Kronecker product, and with a thin plate it is none, is a surface like any other. */
static pia_status open_class(pia_normal *normal, const pia_targets *targets)
{
    const pia_op *op = normal->op;
    if (op->directions == 1) return pia_normal_curve_open(normal, targets);
    if (op->line[0] == NULL || op->frozen != NULL || normal->energy != NULL) return pia_normal_stencil_open(normal, targets);
    pia_status status = pia_normal_grid_open(normal, targets);
    if (status != PIA_E_UNAVAILABLE) return status;
    if (normal->class != NULL) normal->class->close(normal);
    return pia_normal_stencil_open(normal, targets);
}

pia_status pia_normal_open(pia_op *op, const pia_targets *targets, pia_normal **out)
{
    return pia_normal_open_fair(op, targets, 0, out);
}

pia_status pia_normal_open_fair(pia_op *op, const pia_targets *targets, double fairing, pia_normal **out)
{
    pia_normal *normal = pia_take_zero(op->context, 1, sizeof *normal);
    if (normal == NULL) return pia_take_status(op->context, 1, sizeof *normal);
    normal->op = op;
    pia_status status = take_arrays(normal, targets->dim);
    if (status == PIA_OK && fairing > 0) status = pia_energy_open(op, fairing, &normal->energy);
    if (status == PIA_OK) status = open_class(normal, targets);
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

void pia_normal_refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    normal->class->refresh(normal, targets, first_row, last_row);
}
