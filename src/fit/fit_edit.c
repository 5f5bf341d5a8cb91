/* Edits of a running fit: parameters of the method, stop rules, data, control points, knots. The current iterate stays. */
#include "fit.h"

#include "number.h"
#include "options.h"
#include "refine.h"
#include "sequence.h"

#include <math.h>
#include <string.h>

pia_status pia_fit_whole(const pia_fit *fit)
{
    if (!fit->lost && fit->solve.ready) return PIA_OK;
    return pia_fail(fit->context, PIA_E_MEMORY, "memory ran out while the fit was changed; close it, or go on from a checkpoint");
}

pia_status pia_fit_changed(pia_fit *fit, pia_status status)
{
    if (status == PIA_E_MEMORY) fit->lost = 1;
    return status;
}

/* After an edit the errors are unknown, and history of accelerated methods no longer fits the problem. */
pia_status pia_fit_restart(pia_fit *fit)
{
    fit->robust.settled = fit->robust.round = 0;
    pia_refine_reopen(fit);
    return pia_solve_restart(&fit->solve, &fit->method_values, &fit->limiter_values);
}

pia_status pia_fit_refresh(pia_fit *fit, pia_index first_row, pia_index last_row)
{
    pia_iterate *iterate = &fit->iterate;
    pia_fit_mix_weights(fit);
    if (fit->normal != NULL) {
        pia_normal_refresh(fit->normal, &iterate->targets, first_row, last_row);
        iterate->right_norm = sqrt(pia_iterate_dot(iterate, fit->normal->right, fit->normal->right));
    }
    return fit->constraint_count > 0 ? pia_fit_bind(fit) : PIA_OK;
}

/* After a change of one row. Where groups of rows move the control points, only those near the row need to move. */
static pia_status refresh(pia_fit *fit, pia_index row)
{
    pia_status status = pia_fit_refresh(fit, row, row);
    if (status != PIA_OK) return status;
    if (!pia_fit_is_grouped(fit)) return pia_fit_restart(fit);
    status = pia_zone_edit(fit, row);
    return status == PIA_OK ? pia_solve_restart(&fit->solve, &fit->method_values, &fit->limiter_values) : status;
}

pia_status pia_fit_reassemble(pia_fit *fit)
{
    pia_index size = fit->op->cols * fit->dim;
    double *points = pia_take(fit->context, size, sizeof *points);
    if (points == NULL) return PIA_E_MEMORY;
    memcpy(points, fit->iterate.points, (size_t)size * sizeof *points);
    pia_status status = pia_fit_assemble(fit);
    if (status == PIA_OK) memcpy(fit->iterate.points, points, (size_t)size * sizeof *points);
    pia_give(fit->context, points);
    if (status == PIA_OK) status = pia_fit_support(fit);
    if (status == PIA_OK) status = pia_fit_bind(fit);
    return status == PIA_OK ? pia_fit_restart(fit) : status;
}

typedef enum rule_kind { NO_RULE, NUMBER, COUNT } rule_kind;

static rule_kind kind_of_rule(const char *name)
{
    static const char *const numbers[] = {"tolerance", "stop_change", "stop_gradient", "time_limit"};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (strcmp(name, numbers[i]) == 0) return NUMBER;
    return strcmp(name, "max_iterations") == 0 || strcmp(name, "trace_every") == 0 ? COUNT : NO_RULE;
}

static void set_rule(pia_fit *fit, const char *name, double number)
{
    pia_rules *rules = &fit->solve.rules;
    if (strcmp(name, "tolerance") == 0) {
        if (number != fit->options.tolerance) pia_refine_reopen(fit);
        rules->tolerance = fit->options.tolerance = number;
    } else if (strcmp(name, "max_iterations") == 0) {
        rules->iterations = fit->options.max_iterations = (pia_index)number;
    } else if (strcmp(name, "stop_change") == 0) {
        rules->change = number;
    } else if (strcmp(name, "stop_gradient") == 0) {
        rules->gradient = number;
    } else if (strcmp(name, "time_limit") == 0) {
        rules->time_limit = number;
    } else {
        rules->trace_every = (pia_index)number;
    }
    fit->solve.stop = PIA_STOP_NONE;
}

pia_status pia_fit_set(pia_fit *fit, const char *name, const char *value)
{
    if (name == NULL || value == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "name or value is NULL");
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    if (strcmp(name, "axis_tolerances") == 0) return pia_fit_set_axes(fit, value);
    double number;
    rule_kind kind = kind_of_rule(name);
    const char *end = pia_number_parse(value, value + strlen(value), &number);
    int possible = end != NULL && *end == '\0' && number >= 0 && number <= 9e18 && (kind == NUMBER || number == floor(number));
    if (kind != NO_RULE && !possible)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "%s=%s is impossible; give a %s of at least 0", name, value,
                        kind == COUNT ? "count" : "number");
    if (kind != NO_RULE) {
        set_rule(fit, name, number);
        return PIA_OK;
    }
    const pia_method *method = fit->solve.method;
    pia_status status = pia_values_set(fit->context, method->name, method->parameters, name, value, &fit->method_values);
    return status == PIA_OK ? pia_fit_restart(fit) : status;
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
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
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
    return pia_fit_changed(fit, refresh(fit, row));
}

/* Weights of 1 where the fit had none. */
static pia_status take_weights(pia_fit *fit)
{
    if (fit->weights != NULL) return PIA_OK;
    fit->weights = pia_take(fit->context, fit->rows, sizeof(double));
    if (fit->weights == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->rows; i++) fit->weights[i] = 1;
    return PIA_OK;
}

pia_status pia_fit_weigh_point(pia_fit *fit, pia_index data_row, double weight)
{
    pia_index row;
    if (fit->square || fit->iterate.groups != NULL)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "weights do not change what method %s does; use least squares",
                        fit->solve.method->name);
    if (!(weight >= 0) || isinf(weight)) return pia_fail(fit->context, PIA_E_DATA, "weight %g is not finite and >= 0", weight);
    pia_status status = find_row(fit, data_row, &row);
    int weighted = fit->weights != NULL;
    if (status == PIA_OK) status = take_weights(fit);
    if (status != PIA_OK) return status;
    fit->weights[row] = weight;
    return pia_fit_changed(fit, weighted ? refresh(fit, row) : pia_fit_reassemble(fit));
}

/* A row between the sorted ones of a curve; scattered rows go to the end. */
static void insert_row(pia_fit *fit, const double *point, const double *parameters, double weight, pia_index data_row)
{
    pia_index at = fit->rows, dim = fit->dim, wide = fit->kind == PIA_SCATTERED ? 2 : 1;
    while (fit->kind == PIA_CURVE && at > 0 && fit->parameter[0][at - 1] > parameters[0]) at--;
    size_t later = (size_t)(fit->rows - at);
    memmove(fit->own_points + (at + 1) * dim, fit->own_points + at * dim, later * (size_t)dim * sizeof(double));
    memmove(fit->parameter[0] + (at + 1) * wide, fit->parameter[0] + at * wide, later * (size_t)wide * sizeof(double));
    memmove(fit->row + at + 1, fit->row + at, later * sizeof *fit->row);
    if (fit->weights != NULL) {
        memmove(fit->weights + at + 1, fit->weights + at, later * sizeof(double));
        fit->weights[at] = weight;
    }
    memcpy(fit->own_points + at * dim, point, (size_t)dim * sizeof(double));
    memcpy(fit->parameter[0] + at * wide, parameters, (size_t)wide * sizeof(double));
    fit->row[at] = data_row;
    fit->rows++;
    fit->count[0]++;
}

static pia_status grow_array(pia_fit *fit, double **array, pia_index count, pia_index more)
{
    double *larger = pia_take(fit->context, count + more, sizeof *larger);
    if (larger == NULL) return PIA_E_MEMORY;
    memcpy(larger, *array, (size_t)count * sizeof *larger);
    pia_give(fit->context, *array);
    *array = larger;
    return PIA_OK;
}

static pia_status make_room(pia_fit *fit, pia_index more)
{
    pia_index wide = fit->kind == PIA_SCATTERED ? 2 : 1;
    pia_status status = pia_fit_own_rows(fit);
    pia_index *row = status == PIA_OK ? pia_take(fit->context, fit->rows + more, sizeof *row) : NULL;
    if (row == NULL) return PIA_E_MEMORY;
    memcpy(row, fit->row, (size_t)fit->rows * sizeof *row);
    pia_give(fit->context, fit->row);
    fit->row = row;
    status = grow_array(fit, &fit->own_points, fit->rows * fit->dim, more * fit->dim);
    fit->points = fit->own_points;
    if (status == PIA_OK) status = grow_array(fit, &fit->parameter[0], fit->rows * wide, more * wide);
    if (status == PIA_OK && fit->weights != NULL) status = grow_array(fit, &fit->weights, fit->rows, more);
    return status;
}

static pia_status check_more(pia_fit *fit, const pia_data *more)
{
    pia_context *context = fit->context;
    pia_index wide = fit->kind == PIA_SCATTERED ? 2 : 1;
    if (fit->square || fit->sequence != NULL || fit->kind == PIA_GRID || fit->function_graph)
        return pia_fail(context, PIA_E_ARGUMENT, "rows can be added to least-squares curves and scattered surfaces only");
    if (more->kind != fit->kind || more->dim != fit->dim || more->points == NULL || more->parameters == NULL || more->count[0] < 1)
        return pia_fail(context, PIA_E_SHAPE, "added rows need the kind and the %d components of the fit, and given parameters",
                        fit->dim);
    for (pia_index i = 0; i < more->count[0]; i++) {
        for (int d = 0; d < fit->dim; d++)
            if (!isfinite(more->points[i * fit->dim + d]))
                return pia_fail(context, PIA_E_DATA, "added row %lld: component %d is not finite", (long long)i, d);
        for (int d = 0; d < wide; d++) {
            double t = more->parameters[i * wide + d], low = fit->knots[d][fit->degree[d]], high = fit->knots[d][fit->full[d]];
            if (!(t >= low && t <= high))
                return pia_fail(context, PIA_E_DATA, "added row %lld: parameter %g lies outside the domain [%g, %g]", (long long)i, t,
                                low, high);
        }
        if (more->weights != NULL && !(more->weights[i] >= 0 && isfinite(more->weights[i])))
            return pia_fail(context, PIA_E_DATA, "added row %lld: weight %g is not finite and >= 0", (long long)i, more->weights[i]);
    }
    return PIA_OK;
}

pia_status pia_fit_add_points(pia_fit *fit, const pia_data *more)
{
    pia_data data;
    pia_data_init(&data);
    pia_status status = pia_fit_whole(fit);
    if (status == PIA_OK) status = pia_options_read(fit->context, "pia_data", &data, sizeof data, more);
    if (status == PIA_OK) status = check_more(fit, &data);
    if (status == PIA_OK && data.weights != NULL) status = take_weights(fit);
    if (status == PIA_OK) status = make_room(fit, data.count[0]);
    if (status != PIA_OK) return pia_fit_changed(fit, status);
    pia_index wide = fit->kind == PIA_SCATTERED ? 2 : 1;
    for (pia_index i = 0; i < data.count[0]; i++)
        insert_row(fit, data.points + i * fit->dim, data.parameters + i * wide, data.weights != NULL ? data.weights[i] : 1,
                   fit->given + i);
    fit->given += data.count[0];
    return pia_fit_changed(fit, pia_fit_reassemble(fit));
}

pia_status pia_fit_insert_knot(pia_fit *fit, int direction, double knot)
{
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    if (fit->square || fit->sequence != NULL)
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "knots of an interpolation and of control parameters follow the data; use least squares");
    if (direction < 0 || direction >= fit->directions)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "direction %d does not exist here", direction);
    if (fit->op->frozen != NULL) pia_fit_note_add(fit, "control points were freed: a knot was inserted");
    pia_model *now = NULL, *finer = NULL;
    pia_status status = pia_fit_model(fit, &now);
    if (status == PIA_OK) status = pia_model_insert_knots(fit->context, now, direction, &knot, 1, &finer);
    if (status == PIA_OK) status = pia_fit_adopt_knots(fit, finer);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    if (status == PIA_OK) status = pia_fit_adopt_control(fit, finer);
    if (status == PIA_OK) status = pia_fit_support(fit);
    if (status == PIA_OK) status = pia_fit_bind(fit);
    pia_model_destroy(now);
    pia_model_destroy(finer);
    return pia_fit_changed(fit, status == PIA_OK ? pia_fit_restart(fit) : status);
}

pia_status pia_fit_freeze(pia_fit *fit, const pia_index *control, pia_index count, int frozen)
{
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    for (pia_index i = 0; i < count; i++)
        if (control[i] < 0 || control[i] >= fit->op->fulls)
            return pia_fail(fit->context, PIA_E_ARGUMENT, "control point %lld does not exist; there are 0 to %lld",
                            (long long)control[i], (long long)fit->op->fulls - 1);
    pia_status status = PIA_OK;
    for (pia_index i = 0; i < count && status == PIA_OK; i++)
        status = pia_op_freeze(fit->op, pia_op_unknown(fit->op, control[i]), frozen);
    if (status != PIA_OK) return status;
    return pia_fit_changed(fit, fit->normal != NULL ? pia_fit_reassemble(fit) : pia_fit_restart(fit));
}
