/* What a fit tells: report, trace, notes, residuals, parameters. */
#include "fit.h"

#include "options.h"
#include "refine.h"
#include "sequence.h"

#include <math.h>
#include <string.h>

static pia_status step(pia_fit *fit, pia_index iterations)
{
    if (pia_fit_is_grouped(fit)) return pia_epia_step(fit, iterations);
    return fit->robust.loss != PIA_LOSS_NONE ? pia_fit_robust_step(fit, iterations) : pia_solve_step(&fit->solve, iterations);
}

pia_status pia_fit_step(pia_fit *fit, pia_index iterations, pia_report *report)
{
    if (iterations < 0) return pia_fail(fit->context, PIA_E_ARGUMENT, "%lld iterations are not a count", (long long)iterations);
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    pia_status status = fit->refining ? pia_refine(fit, iterations) : step(fit, iterations);
    if (status == PIA_OK && pia_fit_wants_correction(fit)) status = pia_fit_correct(fit);
    if (status == PIA_OK && fit->solve.stop != PIA_STOP_NONE) pia_fit_conclude(fit);
    if (status == PIA_OK && report != NULL) status = pia_fit_report(fit, report);
    return pia_fit_changed(fit, status);
}

pia_status pia_fit_run(pia_fit *fit, pia_report *report)
{
    return pia_fit_step(fit, INT64_MAX, report);
}

int pia_fit_dim(const pia_fit *fit)
{
    return fit->dim;
}

static pia_index data_row(const pia_fit *fit, pia_index row)
{
    return row >= 0 && fit->row != NULL ? fit->row[row] : row;
}

static void describe(const pia_fit *fit, pia_report *report)
{
    *report = (pia_report){.struct_size = sizeof *report,
                           .kind = fit->was_grid ? PIA_GRID : fit->kind,
                           .point_count = fit->rows,
                           .repaired_count = fit->dropped_count};
    pia_fit_names(fit, report);
    report->control_count = 1;
    for (int d = 0; d < 2; d++) {
        report->degree[d] = d < fit->directions ? fit->degree[d] : 0;
        report->control[d] = pia_op_controls(fit->op, d);
        report->control_count *= report->control[d];
    }
}

/* From the errors just measured. */
static int reached(pia_fit *fit)
{
    if (fit->refining) return pia_refine_worst(fit, 0, fit->rows) <= 1;
    if (fit->options.tolerance > 0 && fit->solve.rules.keeps != NULL) return fit->solve.rules.keeps(&fit->iterate);
    return fit->options.tolerance > 0 ? fit->iterate.errors.max <= fit->options.tolerance : PIA_AUTO;
}

static void describe_errors(pia_fit *fit, pia_report *report)
{
    const pia_errors *errors = &fit->iterate.errors;
    report->max_error_index = -1;
    report->max_error = report->rms_error = NAN;
    report->reached = report->worst_axis = PIA_AUTO;
    for (int d = 0; d < PIA_MAX_DIM; d++) report->axis_error[d] = NAN;
    if (!fit->iterate.errors_known) return;
    report->max_error = errors->max;
    report->max_error_index = data_row(fit, errors->max_row);
    report->rms_error = errors->count > 0 ? sqrt(errors->sum_squares / (double)errors->count) : 0;
    report->reached = reached(fit);
    if (fit->axis_tolerances != NULL) report->worst_axis = pia_fit_axis_errors(fit, report->axis_error);
    if (isnan(fit->solve.start_error)) fit->solve.start_error = errors->max;
}

void pia_fit_tell(pia_fit *fit, pia_report *out)
{
    const pia_iterate *iterate = &fit->iterate;
    pia_report full;
    pia_fit_measure_constraints(fit);
    describe(fit, &full);
    describe_errors(fit, &full);
    full.iterations = iterate->iteration;
    full.stop = fit->solve.stop;
    full.constraint_error = iterate->constraint_error;
    full.relative_gradient = iterate->relative_gradient;
    full.start_error = fit->solve.start_error;
    full.rate = fit->solve.rate;
    full.unsupported_count = fit->unsupported_count;
    if (iterate->normal != NULL && iterate->normal->weak > full.unsupported_count) full.unsupported_count = iterate->normal->weak;
    full.outlier_count = fit->robust.outliers;
    full.measure_distance = fit->refining && fit->options.measure_distance && iterate->project != NULL;
    full.round_count = fit->round;
    full.between_error = fit->refining && fit->solve.stop != PIA_STOP_NONE ? fit->between_error : NAN;
    full.seconds = fit->seconds + fit->solve.seconds;
    pia_options_write(out, &full, sizeof full);
}

pia_status pia_fit_report(pia_fit *fit, pia_report *report)
{
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    pia_iterate_measure(&fit->iterate);
    pia_fit_tell(fit, report);
    return PIA_OK;
}

int pia_fit_trace(const pia_fit *fit, pia_index index, pia_trace_row *out)
{
    if (index < 0 || index >= fit->solve.trace.count) return 0;
    *out = fit->solve.trace.row[index];
    return 1;
}

const char *pia_fit_note(const pia_fit *fit, pia_index index)
{
    if (index < 0 || index >= fit->notes.count + fit->outcome.count) return NULL;
    return index < fit->notes.count ? fit->notes.line[index] : fit->outcome.line[index - fit->notes.count];
}

pia_status pia_fit_residuals(pia_fit *fit, double *out)
{
    if (out == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "out is NULL");
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    pia_op_residual(fit->op, fit->iterate.points, &fit->iterate.targets, out);
    return PIA_OK;
}

pia_index pia_fit_parameter_count(const pia_fit *fit)
{
    return fit->kind == PIA_CURVE ? fit->rows : fit->kind == PIA_GRID ? fit->count[0] + fit->count[1] : 2 * fit->rows;
}

/* All parameters in one array: of a grid, u then v. */
static void copy_parameters(const pia_fit *fit, double *out)
{
    pia_index first = fit->kind == PIA_SCATTERED ? 2 * fit->rows : fit->count[0];
    memcpy(out, fit->parameter[0], (size_t)first * sizeof *out);
    if (fit->kind == PIA_GRID) memcpy(out + first, fit->parameter[1], (size_t)fit->count[1] * sizeof *out);
}

pia_status pia_fit_parameters(pia_fit *fit, const double **parameters, pia_index *count, const pia_index **row)
{
    if (parameters == NULL || count == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "parameters or count is NULL");
    *parameters = fit->parameter[0];
    *count = pia_fit_parameter_count(fit);
    if (fit->kind == PIA_GRID) {
        if (fit->all_parameters == NULL) fit->all_parameters = pia_take(fit->context, *count, sizeof(double));
        if (fit->all_parameters == NULL) return PIA_E_MEMORY;
        copy_parameters(fit, fit->all_parameters);
        *parameters = fit->all_parameters;
    }
    if (row != NULL) *row = fit->row;
    return PIA_OK;
}
