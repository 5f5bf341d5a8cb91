/* Foot points near the current parameters: one safeguarded Newton step a row, never past the middle to a neighbour, so that the order
 * of the rows, and with it Schoenberg-Whitney, is kept. */
#include "fit.h"

#include "basis.h"

#include <math.h>

/* The parameter near t where (C - q) . C' = 0, by one Newton step on the squared distance; a gradient step where that is concave. */
static double newton_step(const pia_fit *fit, const double *full, pia_index span, double t, const double *q)
{
    double basis[3 * (PIA_MAX_DEGREE + 1)], value[3][PIA_MAX_DIM] = {{0}};
    int p = fit->degree[0], dim = fit->dim;
    pia_basis_derivatives(fit->knots[0], p, span, t, 2, basis);
    for (int order = 0; order < 3; order++)
        for (int k = 0; k <= p; k++)
            for (int d = 0; d < dim; d++) value[order][d] += basis[order * (p + 1) + k] * full[(span - p + k) * dim + d];
    double slope = 0, speed = 0, bend = 0;
    for (int d = 0; d < dim; d++) {
        double away = value[0][d] - (q[d] - fit->origin[d]);
        slope += away * value[1][d];
        speed += value[1][d] * value[1][d];
        bend += away * value[2][d];
    }
    double curvature = speed + bend > 0 ? speed + bend : speed;
    return curvature > 0 ? t - slope / curvature : t;
}

pia_status pia_fit_project(pia_iterate *iterate)
{
    pia_fit *fit = iterate->owner;
    pia_collocation *line = &fit->line[0];
    double *t = fit->parameter[0], before = t[0];
    const double *full = pia_op_full(fit->op, iterate->points, fit->dim);
    double low = fit->knots[0][fit->degree[0]], high = fit->knots[0][fit->full[0]];
    for (pia_index row = fit->closed[0] ? 0 : 1; row + (fit->closed[0] ? 0 : 1) < fit->rows; row++) {
        double old = t[row], left = row > 0 ? before + (old - before) / 2 : low;
        double right = row + 1 < fit->rows ? old + (t[row + 1] - old) / 2 : high - (high - old) / 2;
        double next = newton_step(fit, full, pia_collocation_span(line, row), old, fit->points + row * fit->dim);
        double margin = (right - left) * 1e-3;
        t[row] = fmin(fmax(next, left + margin), right - margin);
        before = old;
    }
    pia_collocation_rebucket(line);
    fit->parameters_moved = 1;
    iterate->errors_known = 0;
    return PIA_OK;
}
