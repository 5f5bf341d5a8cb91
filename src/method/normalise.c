#include "normalise.h"

#include <math.h>
#include <string.h>

/* A row without holes counts as a 1. */
static pia_status sum_in_a_pass(const pia_iterate *iterate, double *sums)
{
    const pia_op *op = iterate->op;
    double *one = pia_take(iterate->context, op->rows, sizeof *one);
    if (one == NULL) return pia_take_status(iterate->context, op->rows, sizeof *one);
    for (pia_index row = 0; row < op->rows; row++) {
        one[row] = 1;
        for (int d = 0; d < iterate->dim; d++)
            if (isnan(iterate->targets.points[row * iterate->dim + d])) one[row] = 0;
    }
    pia_op_gather(op, one, op->weights, 1, sums);
    pia_give(iterate->context, one);
    return PIA_OK;
}

pia_status pia_column_sums(const pia_iterate *iterate, double *sums)
{
    if (iterate->normal == NULL) return sum_in_a_pass(iterate, sums);
    memcpy(sums, iterate->normal->column_sum, (size_t)iterate->op->cols * sizeof *sums);
    return PIA_OK;
}

void pia_reciprocals(pia_index count, double *sums)
{
    for (pia_index c = 0; c < count; c++) sums[c] = sums[c] > 0 ? 1 / sums[c] : 0;
}

double pia_largest(pia_index count, const double *values)
{
    double largest = 0;
    for (pia_index c = 0; c < count; c++)
        if (values[c] > largest) largest = values[c];
    return largest;
}
