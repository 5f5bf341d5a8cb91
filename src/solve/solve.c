#include "solve.h"

#include "constraint.h"
#include "kernel.h"
#include "stop.h"
#include "unmet.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum { MAX_HALVINGS = 24 };

/* A step is taken back when the error exceeds this many times the smallest one seen. Collocation matrices of high degree are far from
 * normal: errors may grow thirty-fold for hundreds of steps before they fall, and shorter steps would only stretch that. Real
 * divergence gets past this bound soon. */
static const double GROWTH = 1e4;

double pia_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int pia_solve_cancelled(pia_solve *solve)
{
    const pia_rules *rules = &solve->rules;
    return pia_interrupted(solve->iterate->context) || (rules->progress != NULL && rules->progress(rules->user));
}

static pia_status take_state(pia_context *context, size_t size, void **state)
{
    if (size == 0) return PIA_OK;
    *state = pia_take_zero(context, 1, size);
    return *state != NULL ? PIA_OK : PIA_E_MEMORY;
}

pia_status pia_solve_begin(pia_solve *solve, const pia_values *method_values, const pia_values *limiter_values)
{
    pia_iterate *iterate = solve->iterate;
    pia_status status = take_state(iterate->context, solve->method->state_size, &solve->method_state);
    if (status == PIA_OK && solve->limiter != NULL)
        status = take_state(iterate->context, solve->limiter->state_size, &solve->limiter_state);
    iterate->damping = 1;
    iterate->stalled = iterate->shortened = iterate->finished = 0;
    iterate->relative_gradient = NAN;
    iterate->adjust_max = 0;
    solve->reach = iterate->extent;
    if (iterate->points != NULL) solve->reach = fmax(solve->reach, pia_iterate_longest(iterate, iterate->points));
    solve->rate = solve->last_error = solve->best_error = NAN;
    solve->safe_error = INFINITY;
    solve->blocked = 0;
    solve->best_iteration = solve->window_iteration = iterate->iteration;
    solve->window_error = INFINITY;
    solve->standing = 0;
    if (!solve->begun) solve->start_error = NAN;
    solve->stop = PIA_STOP_NONE;
    solve->first_iteration = iterate->iteration;
    solve->begun = 1;
    if (status == PIA_OK && solve->method->begin != NULL) status = solve->method->begin(iterate, method_values, solve->method_state);
    if (status == PIA_OK && solve->limiter != NULL && solve->limiter->begin != NULL)
        status = solve->limiter->begin(iterate, limiter_values, solve->limiter_state);
    solve->ready = status == PIA_OK;
    return status;
}

static void end_states(pia_solve *solve)
{
    pia_iterate *iterate = solve->iterate;
    if (solve->method_state != NULL && solve->method->end != NULL) solve->method->end(iterate, solve->method_state);
    if (solve->limiter_state != NULL && solve->limiter->end != NULL) solve->limiter->end(iterate, solve->limiter_state);
    pia_give(iterate->context, solve->method_state);
    pia_give(iterate->context, solve->limiter_state);
    pia_give(iterate->context, solve->safe);
    solve->method_state = solve->limiter_state = NULL;
    solve->safe = NULL;
    solve->ready = 0;
}

pia_status pia_solve_restart(pia_solve *solve, const pia_values *method_values, const pia_values *limiter_values)
{
    end_states(solve);
    solve->iterate->errors_known = 0;
    return pia_solve_begin(solve, method_values, limiter_values);
}

void pia_solve_end(pia_solve *solve)
{
    if (solve->iterate == NULL) return;
    end_states(solve);
    pia_trace_clear(pia_memory_of(solve->iterate->context), &solve->trace);
}

/* What constraints there are is known for every iterate whose errors are. */
static void measure_constraints(pia_iterate *iterate)
{
    if (iterate->constraints != NULL)
        iterate->constraint_error = pia_constraints_violation(iterate->constraints, iterate->points, NULL);
}

pia_status pia_solve_trace(pia_solve *solve)
{
    const pia_iterate *iterate = solve->iterate;
    pia_trace_row row = {.iteration = iterate->iteration,
                         .control_count = pia_op_controls(iterate->op, 0) * pia_op_controls(iterate->op, 1),
                         .max_error = iterate->errors.max,
                         .rms_error = iterate->errors.count > 0 ? sqrt(iterate->errors.sum_squares / (double)iterate->errors.count) : 0,
                         .adjust_max = iterate->iteration > 0 ? iterate->adjust_max : 0,
                         .constraint_error = iterate->constraint_error,
                         .seconds = solve->seconds};
    pia_index count = solve->trace.count;
    if (count > 0 && solve->trace.row[count - 1].iteration == row.iteration) return PIA_OK;
    if (pia_trace_add(pia_memory_of(iterate->context), &solve->trace, &row)) return PIA_OK;
    return pia_fail(iterate->context, PIA_E_MEMORY, "out of memory for %lld rows of the trace; keep fewer",
                    (long long)solve->trace.count + 1);
}

/* Bookkeeping with the errors of the current iterate, and a row of the trace where one is due. */
static pia_status note_errors(pia_solve *solve)
{
    pia_iterate *iterate = solve->iterate;
    double error = iterate->errors.max;
    measure_constraints(iterate);
    if (isnan(solve->start_error)) solve->start_error = error;
    if (solve->last_error > 0 && error > 1e-12 * iterate->extent) {
        double rate = error / solve->last_error;
        solve->rate = isnan(solve->rate) ? rate : 0.8 * solve->rate + 0.2 * rate;
    }
    solve->last_error = error;
    if (!(error >= 0.999 * solve->best_error)) {
        solve->best_error = error;
        solve->best_iteration = iterate->iteration;
    }
    if (iterate->iteration - solve->window_iteration >= PIA_PATIENCE) {
        solve->standing = fabs(error - solve->window_error) < 0.01 * error;
        solve->window_error = error;
        solve->window_iteration = iterate->iteration;
    }
    pia_index every = solve->rules.trace_every;
    return every > 0 && iterate->iteration % every == 0 ? pia_solve_trace(solve) : PIA_OK;
}

/* True when the current iterate had to be taken back and the damping was halved. */
static int take_back(pia_solve *solve)
{
    pia_iterate *iterate = solve->iterate;
    if (isinf(solve->safe_error) || iterate->errors.max <= GROWTH * solve->safe_error) return 0;
    memcpy(iterate->points, solve->safe, (size_t)(iterate->op->cols * iterate->dim) * sizeof(double));
    iterate->errors_known = 0;
    iterate->damping /= 2;
    solve->last_error = NAN;
    if (iterate->damping < ldexp(1, -MAX_HALVINGS)) solve->stop = PIA_STOP_STALLED;
    return 1;
}

static double *exchange(double **pointer, double *value)
{
    double *before = *pointer;
    *pointer = value;
    return before;
}

/* From P to the next one; keep: P stays as the iterate to return to. After a fused step no number is moved. */
static pia_status update(pia_solve *solve, int fused, int keep)
{
    pia_iterate *iterate = solve->iterate;
    if (keep) {
        if (solve->safe == NULL) solve->safe = pia_take(iterate->context, iterate->op->cols * iterate->dim, sizeof(double));
        if (solve->safe == NULL) return PIA_E_MEMORY;
        solve->safe_error = iterate->errors.max;
    }
    if (keep && !fused) pia_copy(iterate->context, solve->safe, iterate->points, iterate->op->cols * iterate->dim);
    if (fused) {
        double *before = exchange(&iterate->points, iterate->adjust);
        iterate->adjust = keep ? exchange(&solve->safe, before) : before;
    } else if (solve->method->update != NULL) {
        pia_status status = solve->method->update(iterate, solve->method_state);
        if (status != PIA_OK) return status;
    } else {
        pia_iterate_add(iterate, iterate->points, iterate->adjust);
    }
    if (iterate->next_errors_known) iterate->errors = iterate->next_errors;
    iterate->errors_known = iterate->next_errors_known;
    iterate->next_errors_known = 0;
    iterate->iteration++;
    return PIA_OK;
}

/* Computes the step into D (or, fused, the next P); adjust_max is its size. */
static pia_status compute(pia_solve *solve, int fused)
{
    pia_iterate *iterate = solve->iterate;
    if (fused) return solve->method->step(iterate, solve->method_state);
    pia_status status = solve->method->adjust(iterate, solve->method_state);
    if (status == PIA_OK && !iterate->finished && solve->limiter != NULL) status = solve->limiter->limit(iterate, solve->limiter_state);
    if (status == PIA_OK && !iterate->finished) iterate->adjust_max = pia_iterate_longest(iterate, iterate->adjust);
    return status;
}

/* One iteration; sets solve->stop when a rule fires. */
static pia_status iterate_once(pia_solve *solve)
{
    pia_iterate *iterate = solve->iterate;
    const pia_method *method = solve->method;
    pia_status status = PIA_OK;
    int rows = (method->needs & PIA_NEEDS_ROWS) != 0;
    int fused = method->step != NULL && solve->limiter == NULL;
    if (pia_stop_needs_errors(solve) || (rows && !fused)) pia_iterate_measure(iterate);
    if (iterate->errors_known) {
        if (rows && take_back(solve)) return PIA_OK;
        status = note_errors(solve);
    }
    if (status != PIA_OK) return status;
    if (pia_solve_cancelled(solve)) solve->stop = PIA_STOP_CANCELLED;
    if (solve->stop == PIA_STOP_NONE) solve->stop = pia_stop_before(solve);
    if (solve->stop == PIA_STOP_NONE && iterate->stalled) solve->stop = PIA_STOP_STALLED;
    if (solve->stop != PIA_STOP_NONE) return PIA_OK;
    int known = iterate->errors_known;
    double last_change = iterate->adjust_max;
    status = compute(solve, fused);
    if (status != PIA_OK) return status;
    if (!known && iterate->errors_known) {
        if (rows && take_back(solve)) return PIA_OK;
        status = note_errors(solve);
    }
    if (status == PIA_OK) status = pia_unmet_watch(solve);
    if (status == PIA_OK && solve->stop == PIA_STOP_NONE) solve->stop = pia_stop_after(solve);
    if (solve->stop != PIA_STOP_NONE) {
        iterate->adjust_max = last_change;
        return status;
    }
    int keep = rows && solve->safe_error > 2 * iterate->errors.max; /* only where the error has halved since the last one kept */
    if (status == PIA_OK) status = update(solve, fused, keep);
    return status == PIA_OK && solve->revise != NULL ? solve->revise(iterate) : status;
}

void pia_solve_go_on(pia_solve *solve)
{
    if (solve->stop == PIA_STOP_ITERATIONS || solve->stop == PIA_STOP_CANCELLED || solve->stop == PIA_STOP_TIME)
        solve->stop = PIA_STOP_NONE;
}

pia_status pia_solve_step(pia_solve *solve, pia_index iterations)
{
    pia_iterate *iterate = solve->iterate;
    pia_index goal = iterations > INT64_MAX - iterate->iteration ? INT64_MAX : iterate->iteration + iterations;
    pia_status status = PIA_OK;
    double start = pia_seconds() - solve->seconds;
    pia_solve_go_on(solve);
    while (status == PIA_OK && solve->stop == PIA_STOP_NONE && iterate->iteration < goal) {
        status = iterate_once(solve);
        solve->seconds = pia_seconds() - start;
    }
    if (status != PIA_OK) return status;
    measure_constraints(iterate);
    if (solve->rules.trace_every > 0) {
        pia_iterate_measure(iterate);
        status = pia_solve_trace(solve);
    }
    solve->seconds = pia_seconds() - start;
    return status;
}
