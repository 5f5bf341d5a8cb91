/* Edits of a running fit: parameters of the method, stop rules, data, control points, knots. The current iterate stays. */
#include "fit.h"

#include "number.h"

#include <math.h>
#include <string.h>

/* After an edit the errors are unknown, and history of accelerated methods no longer fits the problem. */
static pia_status restart(pia_fit *fit)
{
    return pia_solve_restart(&fit->solve, &fit->method_values, &fit->limiter_values);
}

/* The normal form of the data as they are now. */
static pia_status renew_normal(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    if (iterate->normal == NULL) return PIA_OK;
    pia_normal *renewed;
    pia_status status = pia_normal_open(fit->op, &iterate->targets, &renewed);
    if (status != PIA_OK) return status;
    pia_normal_close(iterate->normal);
    iterate->normal = renewed;
    iterate->right_norm = sqrt(pia_iterate_dot(iterate, renewed->right, renewed->right));
    return PIA_OK;
}

static int set_rule(pia_fit *fit, const char *name, double number)
{
    pia_rules *rules = &fit->solve.rules;
    if (strcmp(name, "tolerance") == 0)
        rules->tolerance = fit->options.tolerance = number;
    else if (strcmp(name, "max_iterations") == 0)
        rules->iterations = (pia_index)number;
    else if (strcmp(name, "stop_change") == 0)
        rules->change = number;
    else if (strcmp(name, "stop_gradient") == 0)
        rules->gradient = number;
    else if (strcmp(name, "time_limit") == 0)
        rules->time_limit = number;
    else if (strcmp(name, "trace_every") == 0)
        rules->trace_every = (pia_index)number;
    else
        return 0;
    fit->solve.stop = PIA_STOP_NONE;
    return 1;
}

pia_status pia_fit_set(pia_fit *fit, const char *name, const char *value)
{
    if (name == NULL || value == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "name or value is NULL");
    double number;
    const char *end = pia_number_parse(value, value + strlen(value), &number);
    if (end != NULL && *end == '\0' && number >= 0 && number <= 9e18 && set_rule(fit, name, number)) return PIA_OK;
    const pia_method *method = fit->solve.method;
    pia_status status = pia_values_set(fit->context, method->name, method->parameters, name, value, &fit->method_values);
    return status == PIA_OK ? restart(fit) : status;
}

/* The row used for a data row; -1 where it was dropped or never there. */
static pia_index used_row(const pia_fit *fit, pia_index data_row)
{
    if (fit->row == NULL) return data_row >= 0 && data_row < fit->rows ? data_row : -1;
    for (pia_index i = 0; i < fit->rows; i++)
        if (fit->row[i] == data_row) return i;
    return -1;
}

static pia_status find_row(pia_fit *fit, pia_index data_row, pia_index *row)
{
    *row = used_row(fit, data_row);
    if (*row >= 0) return PIA_OK;
    return pia_fail(fit->context, PIA_E_ARGUMENT, "data row %lld is not part of this fit; it has %lld rows%s", (long long)data_row,
                    (long long)fit->rows, fit->dropped_count > 0 ? ", some were dropped" : "");
}

pia_status pia_fit_move_point(pia_fit *fit, pia_index data_row, const double *point)
{
    pia_index row;
    pia_status status = find_row(fit, data_row, &row);
    if (status != PIA_OK) return status;
    for (int d = 0; d < fit->dim; d++)
        if (point == NULL || !isfinite(point[d])) return pia_fail(fit->context, PIA_E_DATA, "the new point is not finite");
    memcpy(fit->own_points + row * fit->dim, point, (size_t)fit->dim * sizeof(double));
    status = renew_normal(fit);
    return status == PIA_OK ? restart(fit) : status;
}

pia_status pia_fit_freeze(pia_fit *fit, const pia_index *control, pia_index count, int frozen)
{
    for (pia_index i = 0; i < count; i++)
        if (control[i] < 0 || control[i] >= fit->op->fulls)
            return pia_fail(fit->context, PIA_E_ARGUMENT, "control point %lld does not exist; there are 0 to %lld",
                            (long long)control[i], (long long)fit->op->fulls - 1);
    pia_status status = PIA_OK;
    for (pia_index i = 0; i < count && status == PIA_OK; i++)
        status = pia_op_freeze(fit->op, pia_op_unknown(fit->op, control[i]), frozen);
    return status == PIA_OK ? restart(fit) : status;
}
