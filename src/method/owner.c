#include "owner.h"

#include <math.h>

void pia_owner_adjust(pia_iterate *iterate, double factor)
{
    pia_index size = iterate->op->cols * iterate->dim;
    for (pia_index i = 0; i < size; i++) iterate->adjust[i] = factor * iterate->residual[i];
    pia_op_mask(iterate->op, iterate->adjust, iterate->dim);
}

void pia_owner_step(pia_iterate *iterate, double factor)
{
    iterate->errors = pia_op_move(iterate->op, iterate->points, &iterate->targets, factor, iterate->adjust);
    iterate->errors_known = 1;
    iterate->adjust_max = factor * iterate->errors.max;
}

/* Rough in the unknowns, the same on every machine: every eigenvector has a part in it. */
static void fill_start(double *x, pia_index count)
{
    uint64_t state = 0x9e3779b97f4a7c15u;
    for (pia_index i = 0; i < count; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        x[i] = (i % 2 == 0 ? 1 : -1) * (0.75 + 0.25 * (double)(state >> 40) / 16777216.0);
    }
}

pia_status pia_owner_smallest(pia_iterate *iterate, int passes, double *smallest)
{
    const pia_op *op = iterate->op;
    double *x = pia_take(iterate->context, op->cols, sizeof *x), *y = pia_take(iterate->context, op->rows, sizeof *y);
    if (x == NULL || y == NULL) {
        pia_give(iterate->context, x);
        pia_give(iterate->context, y);
        return PIA_E_MEMORY;
    }
    fill_start(x, op->cols);
    pia_op_mask(op, x, 1);
    double largest = 0, before = -1;
    for (int pass = 0; pass < passes && fabs(largest - before) > 1e-6 * largest; pass++) {
        double norm = 0;
        for (pia_index c = 0; c < op->cols; c++) norm += x[c] * x[c];
        norm = sqrt(norm);
        if (!(norm > 0)) break;
        for (pia_index c = 0; c < op->cols; c++) x[c] /= norm;
        pia_op_apply(op, x, 1, y);
        for (pia_index c = 0; c < op->cols; c++) x[c] -= y[c];
        pia_op_mask(op, x, 1);
        before = largest;
        largest = 0;
        for (pia_index c = 0; c < op->cols; c++) largest += x[c] * x[c];
        largest = sqrt(largest);
    }
    pia_give(iterate->context, x);
    pia_give(iterate->context, y);
    *smallest = largest < 1 ? 1 - largest : 0;
    return PIA_OK;
}
