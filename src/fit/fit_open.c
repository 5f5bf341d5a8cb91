/* The pipeline: data, choices, parameters, knots, operator, start, method. */
#include "fit.h"

#include "model.h"
#include "options.h"
#include "refine.h"
#include "sequence.h"
#include "square_grid.h"
#include "survey.h"
#include "windows.h"

#include <math.h>
#include <string.h>

void pia_data_init(pia_data *data)
{
    memset(data, 0, sizeof *data);
    data->struct_size = sizeof *data;
    data->kind = PIA_CURVE;
    data->count[1] = 1;
}

void pia_constraint_init(pia_constraint *constraint)
{
    memset(constraint, 0, sizeof *constraint);
    constraint->struct_size = sizeof *constraint;
    constraint->at_point = PIA_AUTO;
}

static int on_progress(void *user)
{
    pia_fit *fit = user;
    pia_report report = {.struct_size = sizeof report};
    pia_fit_report(fit, &report);
    return fit->options.progress(fit->options.user, &report);
}

void pia_fit_set_progress(pia_fit *fit, int (*progress)(void *user, const pia_report *so_far), void *user)
{
    fit->options.progress = progress;
    fit->options.user = user;
    fit->solve.rules.progress = progress != NULL ? on_progress : NULL;
    fit->solve.rules.user = fit;
}

/* Where knots are added while no control point moves, that is no reason to stop. */
static double default_change(const pia_fit *fit)
{
    int grows = fit->sequence != NULL && fit->sequence->grows && fit->options.tolerance > 0;
    return grows ? 0 : PIA_FIT_CHANGE * fit->extent;
}

static void set_rules(pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    fit->solve.rules = (pia_rules){
        .tolerance = o->tolerance,
        .keeps = pia_fit_is_tolerance_alike(fit) ? NULL : pia_fit_keeps_tolerances,
        .iterations = o->max_iterations != PIA_AUTO ? o->max_iterations
                      : fit->refining               ? INT64_MAX
                                                    : fit->solve.method->iterations,
        .change = o->stop_change < 0 ? default_change(fit) : o->stop_change,
        .gradient = o->stop_gradient < 0 ? 1e-12 : o->stop_gradient,
        .time_limit = o->time_limit,
        .trace_every = o->trace_every,
    };
    pia_fit_set_progress(fit, o->progress, o->user);
}

static void drop_assembly(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    pia_fit_unbind(fit);
    pia_fit_support_close(fit);
    pia_normal_close(fit->normal);
    pia_op_close(fit->op);
    fit->normal = NULL;
    fit->op = NULL;
    fit->factored = 0;
    for (int d = 0; d < 2; d++) pia_collocation_close(fit->context, &fit->line[d]);
    pia_give(fit->context, iterate->points);
    pia_give(fit->context, iterate->adjust);
    pia_give(fit->context, iterate->residual);
    *iterate = (pia_iterate){.context = fit->context, .iteration = iterate->iteration};
}

/* Whether the limit is all that is asked for. */
static int is_plain(const pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    int asked = o->tolerance > 0 || o->time_limit > 0 || o->trace_every > 0 || o->progress != NULL || o->max_iterations == 0;
    return fit->borrowed && !fit->careful && (fit->solve.method->needs & PIA_IS_FINITE) != 0 && !asked && o->start == NULL &&
           o->freeze_count == 0 && o->interpolate_count == 0 && o->constraint_count == 0 && o->join_count == 0;
}

int pia_fit_is_one_step(const pia_fit *fit)
{
    return fit->square && is_plain(fit) && (pia_windows_suit(fit->op) || pia_square_grid_suits(fit->op, fit->dim));
}

/* Whether least squares may come out in one step, which needs no start then. */
static int is_leap(const pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    return !fit->square && fit->kind == PIA_CURVE && is_plain(fit) && fit->solve.method->step != NULL && fit->solve.limiter == NULL &&
           !fit->refining && fit->sequence == NULL && fit->robust.loss == PIA_LOSS_NONE && !(o->fairing > 0) && !(o->correct > 0);
}

/* The `start` of an iterate. */
static pia_status start_late(void *owner)
{
    pia_fit *fit = owner;
    fit->iterate.points = pia_take(fit->context, fit->op->cols * fit->dim, sizeof(double));
    fit->iterate.start = NULL;
    return fit->iterate.points != NULL ? pia_fit_initial(fit) : PIA_E_MEMORY;
}

int pia_fit_is_trusting(const pia_fit *fit)
{
    int knots = fit->options.knots[0] != NULL && (fit->directions == 1 || fit->options.knots[1] != NULL);
    if (!fit->square || !fit->unseen || !is_plain(fit) || !knots || fit->solve.limiter != NULL) return 0;
    return fit->directions == 1 ? pia_windows_suit_rows(fit->rows, fit->degree[0]) : pia_square_grid_suits_counts(fit->count, fit->dim);
}

/* The step of a trusting fit has seen the points. Its control points count from nowhere. */
static pia_status look(void *owner, const pia_survey *survey)
{
    pia_fit *fit = owner;
    pia_status status = pia_fit_look(fit, survey);
    memset(fit->origin, 0, sizeof fit->origin);
    fit->iterate.extent = fit->extent;
    return status;
}

static pia_status take_iterate(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    pia_index size = fit->op->cols * fit->dim, iteration = iterate->iteration;
    *iterate = (pia_iterate){.context = fit->context, .op = fit->op, .dim = fit->dim, .owner = fit, .iteration = iteration};
    iterate->targets = (pia_targets){fit->points, fit->origin, fit->dim};
    iterate->square = fit->square;
    iterate->constraint_error = iterate->relative_gradient = NAN;
    int blank = pia_fit_is_one_step(fit); /* control points need not start as a copy of the data, nor count from their middle */
    if (blank) memset(fit->origin, 0, sizeof fit->origin);
    if (blank && fit->unseen) iterate->look = look;
    if (is_leap(fit)) iterate->start = start_late;
    blank |= iterate->start != NULL;
    if (!blank) iterate->points = pia_take(fit->context, size, sizeof(double));
    iterate->adjust = pia_take(fit->context, size, sizeof(double));
    if ((!blank && iterate->points == NULL) || iterate->adjust == NULL) return PIA_E_MEMORY;
    unsigned needs = fit->solve.method->needs;
    if (!fit->square && !pia_fit_is_grouped(fit)) {
        pia_status status = pia_fit_open_normal(fit);
        if (status != PIA_OK && (status != PIA_E_UNAVAILABLE || fit->options.fairing > 0)) return status;
    }
    iterate->extent = fit->extent; /* the pass over the points may have found it */
    int fused = fit->solve.method->step != NULL && fit->solve.limiter == NULL;
    if (((needs & PIA_NEEDS_ROWS) != 0 && !fused) || (!fit->square && iterate->normal == NULL) || fit->refining ||
        !pia_fit_is_tolerance_alike(fit)) {
        iterate->residual = pia_take(fit->context, fit->rows * fit->dim, sizeof(double));
        if (iterate->residual == NULL) return PIA_E_MEMORY;
    }
    if (fit->directions == 1 && !fit->borrowed_parameters && !fit->function_graph) iterate->project = pia_fit_project;
    if (fit->kind == PIA_SCATTERED) iterate->project = pia_fit_project_surface;
    return PIA_OK;
}

/* The scale of relative gradients, where the normal form has not given it. */
static pia_status scale_gradient(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    if (fit->square || pia_fit_is_grouped(fit)) return PIA_OK;
    if (iterate->normal != NULL) return PIA_OK;
    size_t bytes = (size_t)(fit->op->cols * fit->dim) * sizeof(double);
    memset(iterate->adjust, 0, bytes);
    pia_op_residual(fit->op, iterate->adjust, &iterate->targets, iterate->residual);
    pia_op_gather(fit->op, iterate->residual, fit->op->weights, fit->dim, iterate->adjust);
    iterate->right_norm = sqrt(pia_iterate_dot(iterate, iterate->adjust, iterate->adjust));
    return PIA_OK;
}

static pia_status freeze_asked(pia_fit *fit)
{
    for (pia_index i = 0; i < fit->options.freeze_count; i++) {
        pia_index control = fit->options.freeze[i];
        if (control < 0 || control >= fit->op->fulls)
            return pia_fail(fit->context, PIA_E_ARGUMENT, "control point %lld cannot be frozen; there are 0 to %lld",
                            (long long)control, (long long)fit->op->fulls - 1);
        pia_status status = pia_op_freeze(fit->op, pia_op_unknown(fit->op, control), 1);
        if (status != PIA_OK) return status;
    }
    fit->options.freeze_count = 0; /* from here on the operator knows */
    return PIA_OK;
}

/* What is frozen decides which normal form an operator has, so it is known before that is made; it stays while the control points do.
 */
pia_status pia_fit_assemble(pia_fit *fit)
{
    pia_index cols = fit->op != NULL ? fit->op->cols : 0;
    unsigned char *frozen = fit->op != NULL ? fit->op->frozen : NULL;
    if (fit->op != NULL) fit->op->frozen = NULL;
    drop_assembly(fit);
    pia_status status = pia_fit_operate(fit);
    if (status == PIA_OK && fit->op->cols == cols)
        fit->op->frozen = frozen;
    else
        pia_give(fit->context, frozen);
    if (status == PIA_OK) status = freeze_asked(fit);
    if (status == PIA_OK) status = take_iterate(fit);
    if (status == PIA_OK && pia_fit_is_grouped(fit)) status = pia_epia_group(fit);
    return status == PIA_OK ? scale_gradient(fit) : status;
}

/* Whether the normal form looks at the data while it sums them: that of a grid where it is a Kronecker product. */
static int is_seen_by_sums(const pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    if (fit->square || fit->refining || pia_fit_by_line(fit)) return 0;
    return fit->directions == 1 || (fit->weights == NULL && o->robust == NULL && o->freeze_count == 0 && !(o->fairing > 0));
}

static pia_status open_stages(pia_fit *fit, const pia_data *data)
{
    pia_status status = pia_fit_check_options(fit, data->kind == PIA_CURVE ? 1 : 2);
    for (int d = 0; d < 2 && fit->options.start != NULL; d++) fit->options.closed[d] |= fit->options.start->periodic[d];
    if (status == PIA_OK) status = pia_fit_take_data(fit, data);
    if (status == PIA_OK) status = pia_fit_choose(fit);
    if (status == PIA_OK && !is_seen_by_sums(fit) && !pia_fit_is_trusting(fit)) status = pia_fit_see(fit);
    if (status == PIA_OK) status = pia_fit_parametrize(fit, data);
    if (status == PIA_OK) status = pia_fit_place(fit);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    if (status == PIA_OK) status = pia_fit_initial(fit);
    if (status == PIA_OK && fit->iterate.groups != NULL) status = pia_epia_validate(fit);
    if (status == PIA_OK) status = freeze_asked(fit);
    if (status == PIA_OK) status = pia_fit_support(fit);
    if (status == PIA_OK) status = pia_fit_take_constraints(fit);
    if (status == PIA_OK) status = fit->refining ? pia_refine_begin(fit) : pia_fit_bind(fit);
    if (status != PIA_OK) return status;
    set_rules(fit);
    fit->solve.iterate = &fit->iterate;
    return pia_solve_begin(&fit->solve, &fit->method_values, &fit->limiter_values);
}

static pia_status open_fit(pia_context *context, const pia_data *data, const pia_fit_options *options, int borrowed, int careful,
                           pia_fit **out)
{
    if (context == NULL || data == NULL || out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "context, data or out is NULL");
    double start = pia_seconds();
    pia_data used;
    pia_data_init(&used);
    pia_status status = pia_options_read(context, "pia_data", &used, sizeof used, data);
    if (status != PIA_OK) return status;
    pia_fit *fit = pia_take_zero(context, 1, sizeof *fit);
    if (fit == NULL) return PIA_E_MEMORY;
    fit->context = context;
    fit->borrowed = borrowed;
    fit->careful = careful;
    pia_fit_options_init(&fit->options);
    status = pia_options_read(context, "pia_fit_options", &fit->options, sizeof fit->options, options);
    if (status == PIA_OK) status = open_stages(fit, &used);
    if (status != PIA_OK) {
        pia_fit_close(fit);
        return status;
    }
    fit->seconds = pia_seconds() - start;
    *out = fit;
    return PIA_OK;
}

pia_status pia_fit_open(pia_context *context, const pia_data *data, const pia_fit_options *options, pia_fit **out)
{
    return open_fit(context, data, options, 0, 1, out);
}

pia_status pia_fit_borrow(pia_context *context, const pia_data *data, const pia_fit_options *options, int careful, pia_fit **out)
{
    return open_fit(context, data, options, 1, careful, out);
}

void pia_fit_close(pia_fit *fit)
{
    if (fit == NULL) return;
    pia_context *context = fit->context;
    pia_solve_end(&fit->solve);
    pia_fit_constraints_close(fit);
    drop_assembly(fit);
    pia_sequence_close(fit);
    for (int d = 0; d < 2; d++) {
        pia_give(context, fit->knots[d]);
        if (!fit->borrowed_parameters) pia_give(context, fit->parameter[d]);
    }
    pia_give(context, fit->tolerances);
    pia_give(context, fit->inverse_tolerance);
    pia_give(context, fit->axis_tolerances);
    pia_give(context, fit->own_points);
    pia_give(context, fit->relaxed);
    pia_give(context, fit->all_parameters);
    pia_give(context, fit->row);
    pia_give(context, fit->corner);
    pia_give(context, fit->corner_row);
    pia_give(context, fit->dropped);
    pia_give(context, fit->weights);
    pia_fit_robust_close(fit);
    pia_notes_clear(pia_memory_of(context), &fit->notes);
    pia_notes_clear(pia_memory_of(context), &fit->outcome);
    pia_give(context, fit);
}
