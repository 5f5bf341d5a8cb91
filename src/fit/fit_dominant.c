/* Park 2011, surface fitting by dominant columns: least squares on the knots of the dominant rows and columns; while the error is too
 * large, the row and the column of the worst point become dominant too and everything is fitted anew. */
#include "sequence.h"

#include "refine.h"

/* Least squares, and its row of the trace. */
static pia_status refit(pia_fit *fit)
{
    pia_status status = pia_refine_solve(fit);
    return status == PIA_OK && fit->solve.rules.trace_every > 0 ? pia_solve_trace(&fit->solve) : status;
}

/* The iterations, counted here as refits, that were asked for. */
static int is_over(const pia_fit *fit)
{
    return fit->options.max_iterations != PIA_AUTO && fit->iterate.iteration >= fit->options.max_iterations;
}

pia_status pia_fit_dominant_columns(pia_fit *fit)
{
    pia_index picked = 1;
    pia_status status = refit(fit);
    while (status == PIA_OK && picked > 0 && !pia_refine_reached(fit) && !pia_refine_stopped(fit)) {
        if (is_over(fit)) {
            fit->solve.stop = PIA_STOP_ITERATIONS;
            break;
        }
        status = pia_sequence_pick(fit, 1, &picked);
        if (status != PIA_OK || picked == 0) break;
        fit->round++;
        fit->iterate.iteration++;
        status = pia_sequence_grow(fit, 0);
        if (status == PIA_OK) status = refit(fit);
    }
    return status;
}
