#include "refine.h"

#include <math.h>
#include <string.h>

pia_status pia_refine_install(pia_fit *fit, const double *knots, pia_index control)
{
    int p = fit->degree[0];
    pia_index full = control + (fit->closed[0] ? p : 0);
    double *copy = pia_take(fit->context, full + p + 1, sizeof *copy);
    if (copy == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < full + p + 1; i++) copy[i] = fit->closed[0] ? knots[i % control] + (double)(i / control) : knots[i];
    pia_give(fit->context, fit->knots[0]);
    fit->knots[0] = copy;
    fit->full[0] = full;
    pia_status status = fit->closed[0] ? pia_fit_turn(fit, 0) : PIA_OK;
    return status == PIA_OK ? pia_fit_assemble(fit) : status;
}

pia_status pia_refine_solve(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    size_t bytes = (size_t)(fit->op->cols * fit->dim) * sizeof(double);
    memset(iterate->points, 0, bytes);
    iterate->errors_known = 0;
    pia_status status = iterate->normal->class->factor(iterate->normal);
    for (int step = 0; step < 2 && status == PIA_OK; step++) {
        pia_iterate_gradient(iterate, iterate->adjust);
        iterate->normal->class->solve(iterate->normal, iterate->adjust, fit->dim);
        for (pia_index i = 0; i < fit->op->cols * fit->dim; i++) iterate->points[i] += iterate->adjust[i];
    }
    iterate->errors_known = 0;
    pia_iterate_measure(iterate);
    if (isnan(fit->solve.start_error)) fit->solve.start_error = iterate->errors.max;
    return status;
}
