/* One symmetric Gauss-Seidel sweep an iteration: every control point in turn takes the place that is best while the others stay, up the
 * curve and back. It needs the rows of H one by one. */
#include "method.h"

#include <string.h>

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    (void)state;
    if (iterate->normal != NULL && iterate->normal->class->sweep != NULL) return PIA_OK;
    return pia_fail(iterate->context, PIA_E_ARGUMENT, "gauss-seidel fits curves only; use cg, lspia or direct");
}

/* The gradient tells how far the iterate is; the sweep finds its own. */
static pia_status adjust(pia_iterate *iterate, void *state)
{
    (void)state;
    pia_index size = iterate->op->cols * iterate->dim;
    double *d = iterate->adjust;
    pia_iterate_gradient(iterate, d);
    memcpy(d, iterate->points, (size_t)size * sizeof *d);
    iterate->normal->class->sweep(iterate->normal, d, iterate->dim);
    for (pia_index i = 0; i < size; i++) d[i] -= iterate->points[i];
    return PIA_OK;
}

const pia_method pia_method_gauss_seidel = {
    .name = "gauss-seidel",
    .title = "symmetric Gauss-Seidel: every control point in turn takes its best place",
    .reference = "saad2003",
    .detail = "least squares; curves",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .begin = begin,
    .adjust = adjust,
};
