/* Constraints as conditions on a curve whose knots are thinned out. */
#include "refine.h"

#include "basis.h"
#include "constraint.h"
#include "knots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Derivative of the current curve, relative to the origin. */
static void derivative_at(const pia_fit *fit, double t, int order, double *out)
{
    double basis[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1)];
    int p = fit->degree[0], dim = fit->dim;
    const double *full = pia_op_full(fit->op, fit->iterate.points, dim);
    pia_index span = pia_knots_span(fit->knots[0], p, fit->full[0], t);
    pia_basis_derivatives(fit->knots[0], p, span, t, order, basis);
    for (int d = 0; d < dim; d++) {
        out[d] = 0;
        for (int k = 0; k <= p; k++) out[d] += basis[order * (p + 1) + k] * full[(span - p + k) * dim + d];
    }
}

static pia_draft_condition condition_of(const pia_fit *fit, const pia_fit_constraint *c, double *value)
{
    double low = fit->knots[0][fit->degree[0]], t = c->asked.at_parameter[0];
    pia_index row = c->asked.at_point != PIA_AUTO ? pia_fit_row(fit, c->asked.at_point) : -1;
    int order = c->asked.derivative[0];
    if (row >= 0) t = fit->parameter[0][row];
    if (fit->closed[0]) t -= floor(t - low);
    const double *asked = c->value != NULL ? c->value : fit->points + row * fit->dim;
    if (c->asked.direction_only)
        derivative_at(fit, t, order, value);
    else
        for (int d = 0; d < fit->dim; d++) value[d] = asked[d] - (order == 0 ? fit->origin[d] : 0);
    return (pia_draft_condition){t, order, value};
}

static int by_parameter(const void *a, const void *b)
{
    const pia_draft_condition *p = a, *q = b;
    if (p->parameter != q->parameter) return p->parameter < q->parameter ? -1 : 1;
    return p->order - q->order;
}

pia_status pia_refine_conditions(const pia_fit *fit, pia_draft_condition **conditions, pia_index *count, double **values)
{
    const pia_constraints *bound = fit->iterate.constraints;
    pia_index row = 0;
    *conditions = NULL;
    *values = NULL;
    *count = 0;
    if (bound == NULL) return PIA_OK;
    *conditions = pia_take(fit->context, fit->constraint_count, sizeof **conditions);
    *values = pia_take(fit->context, fit->constraint_count, (size_t)fit->dim * sizeof **values);
    if (*conditions == NULL || *values == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->constraint_count; i++) {
        if (fit->constraint[i].released || !pia_constraints_keeps(bound, row++)) continue;
        (*conditions)[*count] = condition_of(fit, &fit->constraint[i], *values + *count * fit->dim);
        ++*count;
    }
    qsort(*conditions, (size_t)*count, sizeof **conditions, by_parameter);
    return PIA_OK;
}
