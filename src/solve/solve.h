/* The only loop. It knows stop rules, time, cancellation, the trace and progress; a method knows its step, a limiter how to shorten
 * it. Steps of interpolating methods that make the error grow are taken back and damped, so that no iterate runs away. */
#ifndef PIA_SOLVE_SOLVE_H
#define PIA_SOLVE_SOLVE_H

#include "iterate.h"
#include "limit.h"
#include "method.h"
#include "trace.h"

enum { PIA_PATIENCE = 400 };

typedef struct pia_rules {
    double tolerance;                   /* largest deviation; 0: none */
    int (*keeps)(pia_iterate *iterate); /* NULL, or whether the current P keeps a tolerance that is not the same for all rows */
    pia_index iterations;               /* most updates since the start or the last edit */
    double change;                      /* stop when no control point moves more, units of the points; 0: never */
    double gradient;                    /* stop at this relative gradient; 0: never */
    double time_limit;                  /* seconds in all; 0: none */
    pia_index trace_every;              /* 0: no trace */
    int (*progress)(void *user);        /* NULL: none; non-zero cancels */
    void *user;
} pia_rules;

typedef struct pia_solve {
    pia_iterate *iterate;
    const pia_method *method;
    const pia_limiter *limiter; /* NULL: none */
    void *method_state, *limiter_state;
    pia_rules rules;
    pia_trace trace;
    pia_stop stop;
    double seconds;     /* spent so far */
    double start_error; /* largest deviation of iterate 0; NAN until measured */
    double reach;       /* size of the problem, units of the points: the extent, or how far the first control points are */
    double rate;        /* observed factor of the error an iteration, smoothed; NAN until known */
    double *safe;       /* the iterate to return to when steps grow or constraints cannot be met [cols x dim]; NULL until needed */
    double safe_error;  /* its largest deviation, or violation */
    pia_index blocked;  /* limited steps in a row that have not met the constraints better by a tenth */
    double last_error;
    double best_error; /* smallest error so far, and when it was reached */
    pia_index best_iteration;
    double window_error; /* the error when the current window of PIA_PATIENCE iterations began */
    pia_index window_iteration;
    int standing;              /* the last window changed the error by less than a hundredth */
    pia_index first_iteration; /* where it began, or was last edited: the count that max_iterations limits starts here */
    int begun;
    int ready; /* 1: method and limiter have begun; 0: memory ran out as they did */
    /* NULL, or what may change the problem after an update (insert a knot), while R, errors and adjust_max are still those of the
     * iterate before it. It calls pia_solve_restart where it did. */
    pia_status (*revise)(pia_iterate *iterate);
} pia_solve;

/* Allocates the states and begins method and limiter. */
pia_status pia_solve_begin(pia_solve *solve, const pia_values *method_values, const pia_values *limiter_values);
/* At most `iterations` updates; fewer when a rule fires. Ends with solve->stop, PIA_STOP_NONE when the count ran out first. */
pia_status pia_solve_step(pia_solve *solve, pia_index iterations);
/* Forgets a stop that came from outside: a count, the clock, the callback. They speak again where they still hold. */
void pia_solve_go_on(pia_solve *solve);
/* A row of the trace for the current iterate, whose errors are known; nothing when the last row is its row already. */
pia_status pia_solve_trace(pia_solve *solve);
/* Before going on after an edit: forgets the stop reason and what was known of the errors; history of accelerated methods starts anew.
 */
pia_status pia_solve_restart(pia_solve *solve, const pia_values *method_values, const pia_values *limiter_values);
void pia_solve_end(pia_solve *solve);

/* Whether the progress callback or the context asks to stop. */
int pia_solve_cancelled(pia_solve *solve);

/* Monotonic seconds. */
double pia_seconds(void);

#endif
