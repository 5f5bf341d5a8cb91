#include "refine.h"

#include "constraint.h"
#include "sequence.h"

#include <math.h>
#include <string.h>

/* Time and the callbacks that may cancel, between rounds. */
int pia_refine_stopped(pia_fit *fit)
{
    pia_solve *solve = &fit->solve;
    solve->seconds = pia_seconds() - fit->began;
    if (solve->stop == PIA_STOP_NONE && pia_solve_cancelled(solve)) solve->stop = PIA_STOP_CANCELLED;
    if (solve->stop == PIA_STOP_NONE && solve->rules.time_limit > 0 && solve->seconds >= solve->rules.time_limit)
        solve->stop = PIA_STOP_TIME;
    if (solve->stop == PIA_STOP_NONE && fit->iterate.iteration - solve->first_iteration >= solve->rules.iterations)
        solve->stop = PIA_STOP_ITERATIONS;
    fit->paused = solve->stop == PIA_STOP_NONE && fit->iterate.iteration >= fit->refined_until;
    return solve->stop != PIA_STOP_NONE || fit->paused;
}

pia_status pia_refine_count(pia_fit *fit)
{
    pia_index every = fit->solve.rules.trace_every;
    fit->round++;
    fit->iterate.iteration++;
    fit->solve.seconds = pia_seconds() - fit->began;
    return every > 0 && fit->iterate.iteration % every == 0 ? pia_solve_trace(&fit->solve) : PIA_OK;
}

double pia_refine_parameter(const pia_fit *fit, int d, pia_index row)
{
    if (fit->kind == PIA_SCATTERED) return fit->parameter[0][2 * row + d];
    if (fit->directions == 1) return fit->parameter[0][row];
    return fit->parameter[d][d == 0 ? row / fit->count[1] : row % fit->count[1]];
}

int pia_refine_reached(const pia_fit *fit)
{
    return pia_refine_worst_of_all(fit) <= 1;
}

/* A tolerance that would do; where not all rows may deviate alike, how many times theirs. */
static void note_reachable(pia_fit *fit)
{
    int alike = pia_fit_is_tolerance_alike(fit);
    pia_fit_note_add(fit, "the tolerance cannot be had with these parameters%s: no knot is left that the data could hold; %g%s can",
                     fit->constraint_count > 0 ? " and constraints" : "",
                     alike ? fit->iterate.errors.max : pia_refine_worst(fit, 0, fit->rows), alike ? "" : " times it");
}

void pia_refine_reopen(pia_fit *fit)
{
    fit->stage = (pia_stage){.spares = 1, .feet = 1};
    fit->relaxation = 0;
    pia_zone_close(fit);
}

pia_status pia_refine(pia_fit *fit, pia_index iterations)
{
    pia_index done = fit->iterate.iteration;
    fit->solve.stop = fit->stage.settled;
    if (fit->stage.settled != PIA_STOP_NONE) return PIA_OK;
    fit->refined_until = iterations > INT64_MAX - done ? INT64_MAX : done + iterations;
    if (fit->round > 0) pia_iterate_measure(&fit->iterate);
    fit->paused = 0;
    fit->began = pia_seconds() - fit->solve.seconds;
    int adds_lines = fit->placement != NULL && fit->placement->adds_lines;
    pia_status status = adds_lines             ? pia_fit_dominant_columns(fit)
                        : fit->directions == 1 ? pia_refine_curve(fit)
                                               : pia_refine_surface(fit);
    if (status != PIA_OK) return status;
    if (fit->solve.stop == PIA_STOP_NONE && !fit->paused) {
        fit->solve.stop = fit->stage.settled = pia_refine_reached(fit) ? PIA_STOP_TOLERANCE : PIA_STOP_NO_KNOT_LEFT;
        if (fit->solve.stop == PIA_STOP_NO_KNOT_LEFT) note_reachable(fit);
        if (fit->solve.stop == PIA_STOP_NO_KNOT_LEFT) status = pia_refine_explain(fit);
    }
    if (status == PIA_OK && fit->solve.stop != PIA_STOP_NONE) status = pia_fit_bind(fit);
    if (status != PIA_OK) return status;
    fit->solve.seconds = pia_seconds() - fit->began;
    return fit->solve.rules.trace_every > 0 ? pia_solve_trace(&fit->solve) : PIA_OK;
}

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

double *pia_refine_knots(const pia_fit *fit, int d, const double *inside, pia_index count)
{
    int p = fit->degree[d];
    double low = fit->knots[d][p], high = fit->knots[d][fit->full[d]];
    pia_index control = fit->closed[d] ? count + 1 : count + p + 1, full = control + (fit->closed[d] ? p : 0);
    double *knots = pia_take(fit->context, full + p + 1, sizeof *knots);
    for (pia_index i = 0; knots != NULL && i < full + p + 1; i++) {
        pia_index k = i - p; /* 0: the first knot of the domain */
        pia_index period = fit->closed[d] ? (k >= 0 ? k / control : -((control - 1 - k) / control)) : 0;
        k -= period * control;
        knots[i] = k <= 0 ? low : k <= count ? inside[k - 1] : high;
        knots[i] += (double)period;
    }
    return knots;
}

pia_status pia_refine_place(pia_fit *fit, int d, const double *inside, pia_index count)
{
    double *knots = pia_refine_knots(fit, d, inside, count);
    if (knots == NULL) return PIA_E_MEMORY;
    pia_give(fit->context, fit->knots[d]);
    fit->knots[d] = knots;
    fit->full[d] = count + fit->degree[d] + 1;
    return fit->closed[d] && fit->kind != PIA_SCATTERED ? pia_fit_turn(fit, d) : PIA_OK;
}

/* The highest derivative on the span behind knot[degree], from divided differences of the control points that live there. */
static void highest_derivative(const double *knot, const double *points, int p, int dim, double *out)
{
    double difference[(PIA_MAX_DEGREE + 1) * PIA_MAX_DIM];
    memcpy(difference, points, (size_t)((p + 1) * dim) * sizeof *difference);
    for (int order = 1; order <= p; order++)
        for (int i = p; i >= order; i--) {
            double width = knot[i + p - order + 1] - knot[i];
            for (int d = 0; d < dim; d++) {
                double *to = &difference[i * dim + d];
                *to = width > 0 ? (p - order + 1) * (*to - difference[(i - 1) * dim + d]) / width : 0;
            }
        }
    memcpy(out, difference + p * dim, (size_t)dim * sizeof(double));
}

double pia_refine_knot_cost(const double *knot, const double *points, int degree, int dim)
{
    double before[PIA_MAX_DIM], after[PIA_MAX_DIM], square = 0;
    double left = knot[degree + 1] - knot[degree], right = knot[degree + 2] - knot[degree + 1];
    highest_derivative(knot, points, degree, dim, before);
    highest_derivative(knot + 1, points + dim, degree, dim, after);
    for (int d = 0; d < dim; d++) square += (after[d] - before[d]) * (after[d] - before[d]);
    return left + right > 0 ? sqrt(square) * pow(left * right / (left + right), degree) : 0;
}

/* The first and the last control point are the first and the last row, and stay. */
static pia_status pin_ends(pia_fit *fit)
{
    pia_index end[] = {0, fit->op->cols - 1}, row[] = {0, fit->rows - 1};
    pia_status status = PIA_OK;
    for (int k = 0; k < 2 && status == PIA_OK; k++) {
        status = pia_op_freeze(fit->op, end[k], 1);
        for (int d = 0; d < fit->dim; d++)
            fit->iterate.points[end[k] * fit->dim + d] = fit->points[row[k] * fit->dim + d] - fit->origin[d];
    }
    return status;
}

/* The correction of least squares, such that the constraints are met where the data allow that; else they are met afterwards. */
static pia_status correct(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    pia_iterate_gradient(iterate, iterate->adjust);
    iterate->normal->class->solve(iterate->normal, iterate->adjust, fit->dim);
    pia_op_mask(fit->op, iterate->adjust, fit->dim);
    pia_status status = fit->factored == 2 && iterate->constraints != NULL
                            ? pia_constraints_correct(iterate->constraints, iterate->normal, iterate->points, iterate->adjust)
                            : PIA_OK;
    for (pia_index i = 0; i < fit->op->cols * fit->dim; i++) iterate->points[i] += iterate->adjust[i];
    return status;
}

pia_status pia_refine_factor(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    pia_status status = pia_fit_bind(fit);
    if (status == PIA_OK) status = iterate->normal->class->factor(iterate->normal);
    if (status != PIA_OK) return status;
    fit->factored = 2;
    if (iterate->constraints == NULL) return PIA_OK;
    status = pia_constraints_factor(iterate->constraints, iterate->normal);
    if (status == PIA_E_UNAVAILABLE) fit->factored = 1;
    return status == PIA_E_UNAVAILABLE ? PIA_OK : status;
}

pia_status pia_refine_solve(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    memset(iterate->points, 0, (size_t)(fit->op->cols * fit->dim) * sizeof(double));
    iterate->errors_known = 0;
    pia_status status = fit->pinned ? pin_ends(fit) : PIA_OK;
    if (status == PIA_OK) status = pia_refine_factor(fit);
    for (int step = 0; step < 2 && status == PIA_OK; step++) status = correct(fit);
    if (status == PIA_OK && iterate->constraints != NULL) pia_constraints_finish(iterate->constraints, iterate->points);
    iterate->errors_known = 0;
    pia_iterate_measure(iterate);
    if (isnan(fit->solve.start_error)) fit->solve.start_error = iterate->errors.max;
    return status;
}
